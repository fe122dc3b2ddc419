#include "translator/translation/draft.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <tuple>

#include "base/text.h"
#include "base/transliterate.h"
#include "ir/analysis/call_graph.h"
#include "ir/edit/rewrite.h"
#include "legaliser/data/given_data.h"
#include "legaliser/edit/refuse.h"

namespace cnctrans::translator {

namespace {

using ir::passes::frame_space;
using ir::passes::has_name;
using ir::passes::map_expr;
using ir::passes::name_of_datum;

std::pair<FileId, std::uint32_t> line_of(const Span& at) {
  return {at.file, at.line};
}

/// Letters, digits and _ of the name of a datum.
std::string plain_name(const std::string& datum) {
  std::string name(placeholder_mark);
  for (const char c : datum) {
    const bool plain = (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    if (plain)
      name += c;
    else if (name.back() != '_')
      name += '_';
  }
  while (name.back() == '_') name.pop_back();
  constexpr std::size_t longest = 24;
  return name.substr(0, longest);
}

class Placeholders {
 public:
  Placeholders(ir::Program& work, const ir::LegaliseContext& context) : work_(work), context_(context) {}

  std::vector<ToDo> run() {
    for (auto& r : work_.routines) {
      ir::for_each_statement(r.body, [this](ir::Statement& s) { statement(s); });
    }
    declare();
    for (auto& [datum, places] : written_) {
      list_.push_back({"TRN-122", "the target has no counterpart of '" + datum + "', which the program sets",
                       "set what stands for " + datum +
                           " on the target in its place, or take the lines out; a file of names says it for all "
                           "programs (--names, \"data\")",
                       std::move(places), false});
    }
    return std::move(list_);
  }

 private:
  void statement(ir::Statement& s) {
    ir::passes::StatementVisitor visit;
    visit.expression = [&](const ir::ExprPtr& e) {
      return map_expr(e, [&](const ir::ExprPtr& x) {
        const auto* ref = std::get_if<ir::SystemRef>(&x->node);
        if (ref == nullptr || ref->datum != ir::Datum::other || x->type == ir::Type::string) return x;
        if (has_name(*ref, context_) || given(*ref)) return x;
        return ir::variable(place_of(name_of_datum(*ref, work_), s), x->type);
      });
    };
    ir::passes::visit_statement(s, visit);
    const auto* a = std::get_if<ir::Assign>(&s.node);
    for (std::size_t i = 0; a != nullptr && i < a->items.size(); ++i) {
      const auto& item = a->items[i];
      if (item.to_system && item.system.datum == ir::Datum::other && !has_name(item.system, context_) &&
          !given(item.system))
        written_[name_of_datum(item.system, work_)].push_back(s.line.span);
    }
  }
  [[nodiscard]] bool given(const ir::SystemRef& ref) const {
    return context_.names != nullptr && ir::passes::name_given_to(ref, work_, *context_.names).has_value();
  }
  ir::VarRef place_of(const std::string& datum, const ir::Statement& s) {
    auto it = std::find_if(list_.begin(), list_.end(), [&](const ToDo& t) { return t.code == datum; });
    if (it == list_.end()) {
      std::string name = plain_name(datum);
      while (!taken_.insert(name).second) name += '1';
      places_.push_back(name);
      it = list_.insert(list_.end(), ToDo{datum, {}, {}, {}, true});
    }
    it->places.push_back(s.line.span);
    const auto at = static_cast<std::size_t>(it - list_.begin());
    return {frame_space(work_), places_[at], nullptr, {}};
  }
  /// Each begins with 0, at the head of the main program.
  void declare() {
    const auto main = std::find_if(work_.routines.begin(), work_.routines.end(),
                                   [](const ir::Routine& r) { return r.kind == ir::RoutineKind::main; });
    if (list_.empty() || work_.routines.empty()) return;
    ir::Body& body = (main != work_.routines.end() ? *main : work_.routines.front()).body;
    auto at = std::find_if_not(body.begin(), body.end(), ir::passes::is_remark);
    for (std::size_t i = 0; i < list_.size(); ++i) {
      const std::string datum = list_[i].code;
      ir::Statement set = ir::passes::make_assign({}, {frame_space(work_), places_[i], nullptr, {}}, ir::number(0));
      ir::CommentText remark;
      remark.text = work_.keep("TO DO " + std::to_string(i + 1) + ": stands for " + datum);
      set.line.comments.push_back(remark);
      at = body.insert(at, std::move(set)) + 1;
      list_[i].code = "TRN-122";
      list_[i].message = "the target has no counterpart of '" + datum + "': a variable stands for it, set to 0";
      list_[i].hint = "set that variable, or put in its place what stands for " + datum +
                      " on the target; a file of names says it for all programs (--names, \"data\")";
      context_.diagnostics.error(list_[i].code, list_[i].places.front(), list_[i].message, list_[i].hint);
    }
  }

  ir::Program& work_;
  const ir::LegaliseContext& context_;
  std::vector<ToDo> list_;  ///< `code` is the datum until all are known
  std::vector<std::string> places_;
  std::map<std::string, std::vector<Span>> written_;  ///< data that the program sets
  std::set<std::string> taken_;
};

/// The block says nothing but a word that no reader understands.
bool is_unread_word(const ir::Statement& s) {
  const auto* b = std::get_if<ir::Block>(&s.node);
  return b != nullptr && !b->has_motion && b->actions.size() == 1 &&
         std::holds_alternative<ir::OpaqueWord>(b->actions.front().data) && b->actions.front().order != ir::Order::with;
}

/// What a reader could not read is taken to leave everything as it was: what follows is not blamed for it.
template <class Change>
void each_kept(ir::Program& work, const Change& change) {
  for (auto& r : work.routines) {
    ir::for_each_statement(r.body, [&change](ir::Statement& s) {
      if (is_unread_word(s)) {
        ir::Opaque o;
        o.text = std::string(std::get<ir::OpaqueWord>(std::get<ir::Block>(s.node).actions.front().data).word);
        s.node = std::move(o);
      }
      if (auto* o = std::get_if<ir::Opaque>(&s.node); o != nullptr && !o->harmless) change(*o);
    });
  }
}

bool moves_or_branches(const ir::Statement& s) {
  return !std::holds_alternative<ir::Assign>(s.node) && !std::holds_alternative<ir::Message>(s.node) &&
         !std::holds_alternative<ir::Declare>(s.node) && !std::holds_alternative<ir::Label>(s.node) &&
         !ir::passes::is_remark(s);
}

std::string places_text(const std::vector<Span>& places) {
  constexpr std::size_t shown = 8;
  const auto lines = lines_of(places);
  if (lines.empty()) return "whole program";
  std::string text = lines.size() == 1 ? "line" : "lines";
  for (std::size_t i = 0; i < std::min(lines.size(), shown); ++i) text += ' ' + std::to_string(lines[i].line);
  if (lines.size() > shown) text += " and " + std::to_string(lines.size() - shown) + " more";
  return text;
}

/// What a person has to decide.
std::string decision(const Diagnostic& d) {
  if (d.code == "RUN-102")
    return "say in the file of names how it is called on the target and whether it leaves everything as it is "
           "(--names, "
           "\"routines\"), or name the folder it is in with --lib; else write what it does in place of the calls";
  if (d.code == "RUN-103" || d.code == "TRN-205" || d.hint.empty())
    return "write by hand what the lines do, or take them out; what follows is written as if they left functions, tool "
           "and zero point as they were";
  return d.hint;
}

}  // namespace

std::vector<Span> lines_of(std::vector<Span> places) {
  std::stable_sort(places.begin(), places.end(), [](const Span& a, const Span& b) { return line_of(a) < line_of(b); });
  std::erase_if(places, [](const Span& s) { return !s.known(); });
  places.erase(
      std::unique(places.begin(), places.end(), [](const Span& a, const Span& b) { return line_of(a) == line_of(b); }),
      places.end());
  return places;
}

void pass_over_unread(ir::Program& work) {
  each_kept(work, ir::passes::pass_over);
}

std::vector<ToDo> put_placeholders(ir::Program& work, const ir::LegaliseContext& context) {
  each_kept(work, [](ir::Opaque& o) { o.feature.clear(); });
  return Placeholders(work, context).run();
}

std::vector<ToDo> to_do_of(std::vector<ToDo> placeholders, const Diagnostics& read, const Diagnostics& written,
                           const std::vector<std::vector<Span>>& calls, const std::vector<Span>& left_out) {
  std::vector<ToDo> list = std::move(placeholders);
  const std::size_t kept = list.size();
  std::set<std::pair<FileId, std::uint32_t>> told;
  for (const ToDo& t : list) {
    if (t.placeholder) continue;
    for (const Span& s : t.places) told.insert(line_of(s));
  }
  // "the target has no counterpart of 'PLCM[40]'": it is among them.
  const auto known = [&](const Diagnostic& d) {
    const auto same = [&d](const ToDo& t) {
      const auto end = t.message.find('\'', t.message.find('\'') + 1);
      return t.code == d.code && d.message.compare(0, end + 1, t.message, 0, end + 1) == 0;
    };
    return std::any_of(list.begin(), list.begin() + static_cast<std::ptrdiff_t>(kept), same);
  };
  const auto add = [&](const Diagnostic& d, std::string message) {
    auto it =
        std::find_if(list.begin(), list.end(), [&](const ToDo& t) { return t.code == d.code && t.message == message; });
    if (known(d)) return;
    if (it == list.end()) it = list.insert(list.end(), ToDo{d.code, std::move(message), decision(d), {}, false});
    const auto of_call = std::find_if(calls.begin(), calls.end(), [&d](const auto& places) {
      return d.code == "RUN-102" && std::find(places.begin(), places.end(), d.span) != places.end();
    });
    const std::vector<Span> places = of_call != calls.end() ? *of_call : std::vector<Span>{d.span};
    for (const Span& s : places) {
      it->places.push_back(s);
      told.insert(line_of(s));
    }
  };
  for (const auto* said : {&read, &written}) {
    for (const auto& d : said->all()) {
      const bool said_before =
          d.code == "RUN-103" && told.count(line_of(d.span)) != 0;  // the reader has given a reason
      if (d.severity == Severity::error && !said_before) add(d, d.message);
    }
  }
  // What the writer left out of itself, and no error has told.
  constexpr std::string_view end = "; the line is left out";
  std::set<std::pair<FileId, std::uint32_t>> open;
  for (const Span& s : left_out) {
    if (told.count(line_of(s)) == 0) open.insert(line_of(s));
  }
  for (const auto& d : written.all()) {
    if (d.severity == Severity::error || open.erase(line_of(d.span)) == 0) continue;
    const bool ends = std::string_view(d.message).ends_with(end);
    add(d, ends ? d.message.substr(0, d.message.size() - end.size()) : d.message);
  }
  return list;
}

backends::ToDoLines to_do_lines(const std::vector<ToDo>& list, const ir::Program& work) {
  std::set<std::pair<FileId, std::uint32_t>> stops;
  for (const auto& r : work.routines) {
    ir::for_each_statement(r.body, [&stops](const ir::Statement& s) {
      if (moves_or_branches(s)) stops.insert(line_of(s.line.span));
    });
  }
  backends::ToDoLines lines;
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (list[i].placeholder) continue;
    for (const Span& s : list[i].places)
      lines.emplace(line_of(s), backends::ToDoLine{i + 1, stops.count(line_of(s)) != 0});
  }
  return lines;
}

void put_to_do(ir::Program& work, const std::vector<ToDo>& list, std::size_t lines, const std::string& source) {
  if (work.routines.empty()) return;
  const auto main = std::find_if(work.routines.begin(), work.routines.end(),
                                 [](const ir::Routine& r) { return r.kind == ir::RoutineKind::main; });
  ir::Body& body = (main != work.routines.end() ? *main : work.routines.front()).body;
  std::vector<std::string> texts{"DRAFT of " + to_ascii(std::filesystem::path(source).filename().string(), nullptr) +
                                 (lines == 0   ? ": every line is translated"
                                  : lines == 1 ? ": 1 line is not translated"
                                               : ": " + std::to_string(lines) + " lines are not translated") +
                                 ". Not to be run before all that follows is done"};
  constexpr std::size_t most = 40;
  for (std::size_t i = 0; i < std::min(list.size(), most); ++i) {
    texts.push_back("TO DO " + std::to_string(i + 1) + ", " + places_text(list[i].places) + ": " + list[i].message);
    if (!list[i].hint.empty()) texts.push_back("   decide: " + list[i].hint);
  }
  if (list.size() > most) texts.push_back("and " + std::to_string(list.size() - most) + " more, in the report");
  auto at = body.begin();
  for (auto& text : texts) {
    ir::Statement remark = ir::passes::make_comment(to_ascii(text, nullptr), work);
    if (!body.empty()) remark.line.span.file = body.front().line.span.file;
    at = body.insert(at, std::move(remark)) + 1;
  }
  ir::number_statements(work);
}

std::string draft_name(const std::string& name) {
  const auto slash = name.rfind('/');
  const auto dot = name.rfind('.');
  if (dot == std::string::npos || (slash != std::string::npos && dot < slash)) return name + ".draft";
  const std::string stem = name.substr(0, dot);
  return stem.ends_with(".draft") ? name : stem + ".draft" + name.substr(dot);
}

}  // namespace cnctrans::translator
