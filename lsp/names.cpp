#include "lsp/names.h"

#include <algorithm>
#include <optional>

#include "base/text.h"
#include "ir/edit/labels.h"
#include "ir/edit/lines.h"
#include "ir/edit/rewrite.h"

namespace cnctrans::lsp {

namespace {

bool digit(char c) {
  return c >= '0' && c <= '9';
}
bool letter(char c) {
  return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '_' || c == '$';
}

/// Where a block number ends at the front of a line: behind skip marks, N and digits; without N for conversational
/// ones.
std::size_t behind_number(std::string_view line, bool by_n) {
  std::size_t i = line.find_first_not_of(" \t/");
  if (i == std::string_view::npos) return 0;
  const std::size_t begin = i;
  const bool marked = line[i] == 'N' || line[i] == 'n' || line[i] == ':';
  if (marked) ++i;
  if (by_n && !marked) return begin;
  const std::size_t digits = i;
  while (i < line.size() && digit(line[i])) ++i;
  return i > digits ? i : begin;
}

/// The number `digits` (without zeros at its front) at `i`, blanks and zeros before it; its end, or npos.
std::size_t number_at(std::string_view line, std::size_t i, std::string_view digits) {
  while (i < line.size() && line[i] == '0' && i + 1 < line.size() && digit(line[i + 1])) ++i;
  if (line.substr(i, digits.size()) != digits) return std::string_view::npos;
  const std::size_t end = i + digits.size();
  return end < line.size() && (digit(line[end]) || line[end] == '.') ? std::string_view::npos : end;
}

/// A word in any case, alone.
std::size_t find_word(std::string_view line, std::string_view word, std::size_t from) {
  const auto fits = [&](std::size_t i) {
    if (i + word.size() > line.size() || !iequals_ascii(line.substr(i, word.size()), word)) return false;
    const char before = i == 0 ? ' ' : line[i - 1], after = i + word.size() < line.size() ? line[i + word.size()] : ' ';
    return !letter(before) && !digit(before) && !letter(after) && !digit(after);
  };
  for (std::size_t i = from; i < line.size(); ++i) {
    if (fits(i)) return i;
  }
  return std::string_view::npos;
}

class Finder {
 public:
  Finder(const ir::Program& program, FileId file, const SourceText& source, const Language& language)
      : program_(program), file_(file), source_(source), language_(language) {}

  std::vector<Occurrence> find() {
    for (std::size_t i = 0; i < program_.routines.size(); ++i) {
      routine_ = static_cast<int>(i);
      add_routine(program_.routines[i]);
    }
    std::stable_sort(out_.begin(), out_.end(), [](const Occurrence& a, const Occurrence& b) {
      return std::pair(a.span.line, a.span.column) < std::pair(b.span.line, b.span.column);
    });
    const auto same_place = [](const Occurrence& a, const Occurrence& b) { return a.span == b.span && a.key == b.key; };
    out_.erase(std::unique(out_.begin(), out_.end(), same_place), out_.end());
    return std::move(out_);
  }

 private:
  std::string_view text(std::uint32_t line) const { return source_.line_text(line); }

  Occurrence* add(NameKind kind, std::string key, std::string shown, std::uint32_t line, std::size_t begin,
                  std::size_t end) {
    if (end == std::string_view::npos || end <= begin) return nullptr;
    Occurrence o;
    o.kind = kind;
    o.key = std::move(key);
    o.shown = std::move(shown);
    o.span = {file_, line, static_cast<std::uint32_t>(begin + 1), line, static_cast<std::uint32_t>(end + 1)};
    out_.push_back(std::move(o));
    return &out_.back();
  }

  // --- labels
  void add_label(const std::string& name, bool is_number, std::uint32_t line, std::size_t begin, std::size_t end,
                 bool defines) {
    Occurrence* o = add(NameKind::label, ir::label_key(name, is_number),
                        is_number && language_.numbered_by_n ? "N" + name : name, line, begin, end);
    if (o == nullptr) return;
    o->routine = routine_;
    o->defines = defines;
    o->numbered = is_number;
  }
  static std::string plain_number(std::string_view digits) {
    const auto first = digits.find_first_not_of('0');
    return std::string(first == std::string_view::npos ? "0" : digits.substr(first));
  }
  /// `LBL 5`: the number behind the word.
  bool add_called_label(const std::string& number, std::uint32_t line, bool defines) {
    constexpr std::string_view word = "LBL";
    const std::string_view t = text(line);
    const std::size_t at = find_word(t, word, 0);
    if (at == std::string_view::npos) return false;
    const std::size_t begin = std::min(t.find_first_not_of(' ', at + word.size()), t.size());
    const std::size_t end = number_at(t, begin, number);
    if (end == std::string_view::npos) return false;
    add_label(number, true, line, begin, end, defines);
    return true;
  }
  void add_line(const ir::LineInfo& line) {
    if (line.span.file != file_ || !line.span.known() || line.joined) return;
    const std::string_view t = text(line.span.line);
    if (!line.number.empty() && !language_.numbered_by_n)
      add_called_label(plain_number(line.number), line.span.line, true);
    if (!line.number.empty() && language_.numbered_by_n) {
      const std::size_t end = behind_number(t, true), begin = t.find_first_not_of(" \t/");
      if (begin != std::string_view::npos && end > begin)
        add_label(plain_number(line.number), true, line.span.line, t.find_first_of("Nn:", begin), end, true);
    }
    for (const auto label : line.labels) {
      const std::size_t at = find_word(t, label, 0);
      if (at != std::string_view::npos)
        add_label(to_upper_ascii(label), false, line.span.line, at, at + label.size(), true);
    }
  }
  void add_reference(const ir::LabelRef& ref, const ir::LineInfo& line) {
    if (ref.computed || ref.text.empty()) return;
    for (std::uint32_t n = line.span.line; n <= std::max(line.span.line, line.span.end_line); ++n) {
      const std::string_view t = text(n);
      const std::size_t from = behind_number(t, language_.numbered_by_n);
      if (!ref.is_number) {
        const std::size_t at = find_word(t, ref.text, from);
        if (at == std::string_view::npos) continue;
        add_label(ref.text, false, n, at, at + ref.text.size(), false);
        return;
      }
      if (!language_.numbered_by_n) {
        if (add_called_label(ref.text, n, false)) return;
        continue;
      }
      for (std::size_t i = from; i < t.size(); ++i) {
        if (t[i] != 'N' && t[i] != 'n') continue;
        if (const std::size_t end = number_at(t, i + 1, ref.text); end != std::string_view::npos) {
          add_label(ref.text, true, n, i, end, false);
          return;
        }
      }
    }
  }

  // --- subprograms
  void add_routine_name(const ir::RoutineName& name, std::uint32_t line, bool defines) {
    if (name.empty() || line == 0) return;
    const std::string_view t = text(line);
    const std::size_t from = behind_number(t, language_.numbered_by_n);
    std::size_t begin = std::string_view::npos, end = begin;
    if (!name.text.empty()) {
      begin = find_word(t, name.text, from);
      if (begin == std::string_view::npos && defines) begin = to_upper_ascii(t).find(to_upper_ascii(name.text));
      end = begin == std::string_view::npos ? begin : begin + name.text.size();
    }
    if (end == std::string_view::npos && name.number >= 0) {
      const std::string digits = std::to_string(name.number);
      for (std::size_t i = from; i < t.size() && end == std::string_view::npos; ++i) {
        if (!digit(t[i]) || (i > 0 && (digit(t[i - 1]) || t[i - 1] == '.'))) continue;
        begin = i;
        end = number_at(t, i, digits);
      }
    }
    Occurrence* o =
        add(NameKind::routine, "/" + (name.text.empty() ? std::to_string(name.number) : to_upper_ascii(name.text)),
            shown_name(name), line, begin, end);
    if (o == nullptr) return;
    o->defines = defines;
    o->numbered = name.text.empty();
  }

  // --- variables
  struct Spelling {
    std::string prefix, digits;  ///< or the name in `prefix`
    std::string key, shown;
    bool local = false;
  };
  [[nodiscard]] std::optional<Spelling> spelling(const ir::VarRef& v) const {
    if (v.space >= program_.spaces.size()) return std::nullopt;
    const ir::VariableSpace& space = program_.spaces[v.space];
    Spelling s;
    if (space.named()) {
      if (v.name.empty()) return std::nullopt;
      s = {v.name, "", "." + to_upper_ascii(v.name), v.name, space.scope == ir::Scope::routine};
      return s;
    }
    const auto index = ir::passes::constant_index(v);
    if (!index) return std::nullopt;
    s = {space.prefix, std::to_string(*index), space.prefix + std::to_string(*index),
         space.prefix + std::to_string(*index), false};
    for (const auto& segment : space.segments) {
      if (*index >= segment.lo && *index <= segment.hi)
        s.local = segment.scope == ir::Scope::level || segment.scope == ir::Scope::routine;
    }
    return s;
  }
  /// The end of the name at `begin` of a line, or npos.
  static std::size_t spelt_at(std::string_view t, std::size_t begin, const Spelling& s) {
    if (begin + s.prefix.size() > t.size() || !iequals_ascii(t.substr(begin, s.prefix.size()), s.prefix))
      return std::string_view::npos;
    std::size_t i = begin + s.prefix.size();
    if (s.digits.empty()) return i < t.size() && (letter(t[i]) || digit(t[i])) ? std::string_view::npos : i;
    i = std::min(t.find_first_not_of(' ', i), t.size());
    if (i < t.size() && (t[i] == '[' || t[i] == '(')) {  // R[1]
      const std::size_t end = number_at(t, i + 1, s.digits);
      return end < t.size() && (t[end] == ']' || t[end] == ')') ? end + 1 : std::string_view::npos;
    }
    return number_at(t, i, s.digits);
  }
  void add_variable(const ir::VarRef& v, const ir::LineInfo& line, WordPos pos, bool writes, bool defines) {
    const auto s = spelling(v);
    if (!s || line.span.file != file_) return;
    const auto try_at = [&](std::uint32_t n, std::size_t begin) {
      const std::size_t end = spelt_at(text(n), begin, *s);
      if (end == std::string_view::npos) return false;
      Occurrence* o = add(NameKind::variable, s->key, s->shown, n, begin, end);
      if (o == nullptr) return false;
      o->routine = s->local ? routine_ : -1;
      o->writes = writes;
      o->defines = defines;
      o->numbered = !s->digits.empty();
      return true;
    };
    if (pos.column != 0 && try_at(line.span.line, pos.column - 1)) return;
    for (std::uint32_t n = line.span.line; n <= std::max(line.span.line, line.span.end_line); ++n) {
      const std::string_view t = text(n);
      for (std::size_t i = behind_number(t, language_.numbered_by_n); i < t.size(); ++i) {
        const bool begins = i == 0 || (!letter(t[i - 1]) && !digit(t[i - 1])) || !s->digits.empty();
        if (begins && try_at(n, i)) return;
      }
    }
  }

  void add_statement(const ir::Statement& s) {
    if (s.line.span.file != file_) return;
    ir::passes::each_expression(s, [&](const ir::ExprPtr& whole) {
      ir::walk(whole, [&](const ir::ExprPtr& e) {
        if (const auto* v = std::get_if<ir::VarRef>(&e->node)) add_variable(*v, s.line, e->pos, false, false);
      });
    });
    if (const auto* a = std::get_if<ir::Assign>(&s.node)) {
      for (const auto& item : a->items) {
        if (!item.to_system) add_variable(item.target, s.line, item.pos, true, false);
      }
    } else {
      ir::passes::each_target(s, [&](const ir::VarRef& v) { add_variable(v, s.line, {}, true, false); });
    }
    if (const auto* d = std::get_if<ir::Declare>(&s.node)) {
      for (const auto& item : d->items) add_variable({d->space, item.name, nullptr, {}}, s.line, {}, false, true);
    } else if (const auto* j = std::get_if<ir::Jump>(&s.node)) {
      add_reference(j->target, s.line);
    } else if (const auto* w = std::get_if<ir::Switch>(&s.node)) {
      for (const auto& c : w->cases) add_reference(c.second.target, s.line);
      for (const auto& f : w->fallback) add_reference(f.target, s.line);
    } else if (const auto* r = std::get_if<ir::Repeat>(&s.node)) {
      if (r->has_program) {
        add_routine_name(r->program, s.line.span.line, false);
      } else {
        add_reference(r->first, s.line);
        add_reference(r->last, s.line);
      }
    } else if (const auto* c = std::get_if<ir::CallRoutine>(&s.node)) {
      if (!c->computed) add_routine_name(c->routine, s.line.span.line, false);
    } else if (const auto* m = std::get_if<ir::ModalCall>(&s.node)) {
      if (!m->call.computed) add_routine_name(m->call.routine, s.line.span.line, false);
    }
  }

  void add_routine(const ir::Routine& r) {
    if (r.header.span.file == file_ && r.header.span.known()) add_routine_name(r.name, r.header.span.line, true);
    for (const auto& p : r.parameters) {
      if (r.header.span.known()) add_variable(p.variable, r.header, {}, true, true);
    }
    ir::passes::each_line(r.body, [this](const ir::LineInfo& line) { add_line(line); });
    ir::for_each_statement(r.body, [this](const ir::Statement& s) { add_statement(s); });
  }

  const ir::Program& program_;
  FileId file_;
  const SourceText& source_;
  const Language& language_;
  int routine_ = -1;
  std::vector<Occurrence> out_;
};

}  // namespace

std::string shown_name(const ir::RoutineName& name) {
  if (!name.text.empty()) return name.text;
  return name.number >= 0 ? std::to_string(name.number) : std::string();
}

std::vector<Occurrence> find_names(const ir::Program& program, FileId file, const SourceText& source,
                                   const Language& language) {
  return Finder(program, file, source, language).find();
}

bool same_name(const Occurrence& a, const Occurrence& b) {
  return a.kind == b.kind && a.key == b.key && a.routine == b.routine;
}

bool has_computed_labels(const ir::Program& program) {
  bool found = false;
  for (const auto& r : program.routines) {
    ir::for_each_statement(r.body, [&found](const ir::Statement& s) {
      if (const auto* j = std::get_if<ir::Jump>(&s.node)) found = found || j->target.computed != nullptr;
      if (const auto* w = std::get_if<ir::Switch>(&s.node)) {
        for (const auto& c : w->cases) found = found || c.second.target.computed != nullptr;
      }
      if (const auto* p = std::get_if<ir::Repeat>(&s.node)) found = found || p->first.computed || p->last.computed;
    });
  }
  return found;
}

bool has_computed_variables(const ir::Program& program) {
  bool found = false;
  const auto look = [&](const ir::VarRef& v) {
    found = found ||
            (v.space < program.spaces.size() && !program.spaces[v.space].named() && !ir::passes::constant_index(v));
  };
  for (const auto& r : program.routines) {
    ir::for_each_statement(r.body, [&](const ir::Statement& s) {
      ir::passes::each_target(s, look);
      ir::passes::each_expression(s, [&](const ir::ExprPtr& whole) {
        ir::walk(whole, [&](const ir::ExprPtr& e) {
          if (const auto* v = std::get_if<ir::VarRef>(&e->node)) look(*v);
        });
      });
    });
  }
  return found;
}

}  // namespace cnctrans::lsp
