#include "frontends/heidenhain/program/structure.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "base/saturate.h"
#include "base/text.h"

namespace cnctrans::frontends::heidenhain {

namespace {

class Structure {
 public:
  Structure(Lowering& lowering, const Flow& flow, std::vector<std::vector<ir::Statement>> statements)
      : lowering_(lowering), flow_(flow), flat_(lowering.flat()), statements_(std::move(statements)) {}

  void build(ir::Routine main, ir::Program& program) {
    main_name_ = main.name.text;
    judge_labels();
    const auto& roots = flow_.roots();
    for (std::size_t r = 1; r < roots.size(); ++r) judge(r);
    owner_.assign(flat_.items.size(), 0);
    for (const auto& [r, sub] : subs_) {
      for (int i = sub.first; i <= sub.last; ++i) owner_[static_cast<std::size_t>(i)] = static_cast<int>(r);
    }
    link();
    for (const auto& [r, sub] : subs_) {
      for (const int i : sub.returns) put_return(static_cast<std::size_t>(i));
    }
    fill(main, 0, 0, static_cast<int>(flat_.items.size()) - 1);
    program.routines.push_back(std::move(main));
    for (const auto& [r, sub] : subs_) {
      ir::Routine routine;
      const Item& label = flat_.items[static_cast<std::size_t>(sub.first)];
      routine.kind = ir::RoutineKind::sub;
      routine.locality = ir::Locality::file_local;
      routine.name = routine_name(label);
      routine.file = program.routines[0].file;
      routine.header.span = label.statement.line.span;
      fill(routine, static_cast<int>(r), sub.first, sub.last);
      if (sub.falls_into != 0) fall(routine, sub);
      program.routines.push_back(std::move(routine));
    }
  }

 private:
  /// A label may be called like its program, which is another thing to call.
  [[nodiscard]] ir::RoutineName routine_name(const Item& label) const {
    ir::RoutineName name;
    if (label.number)
      name.number = saturate<std::int64_t>(parse_decimal(label.label).value_or(0));
    else
      name.text = label.label == main_name_ ? label.label + "_1" : label.label;
    return name;
  }

  struct Sub {
    int first = 0, last = 0;   ///< items, the label and LBL 0 included
    int falls_into = 0;        ///< root of the subprogram whose text goes on behind it
    std::vector<int> returns;  ///< LBL 0 before its last one
  };
  static ir::Opaque left_out(const Item& item) {
    ir::Opaque o;
    o.text = "LBL " + item.label;
    o.feature = "language.statement";
    return o;
  }
  /// The text goes on in the next subprogram.
  void fall(ir::Routine& routine, const Sub& sub) {
    const auto next = subs_.find(static_cast<std::size_t>(sub.falls_into));
    const int start = flow_.roots()[static_cast<std::size_t>(sub.falls_into)].start;
    const Item& label = flat_.items[static_cast<std::size_t>(start)];
    ir::Statement s;
    s.line.span = routine.header.span;
    if (next == subs_.end()) {
      at(label).refuse("HEI-025", {}, "the subprogram " + label.label + " is not carried");
      s.line.span = label.statement.line.span;
      s.node = left_out(label);
    } else {
      ir::CallRoutine call;
      call.routine = routine_name(label);
      s.node = std::move(call);
    }
    routine.body.push_back(std::move(s));
  }
  Report& at(const Item& item) {
    lowering_.report().start(item.statement.line.span);
    return lowering_.report();
  }
  void judge_labels() {
    for (const int i : flow_.doubled())
      at(flat_.items[static_cast<std::size_t>(i)]).refuse("HEI-010", {}, "the label stands twice in the file");
  }
  /// M2 or M30, not the end of the text.
  [[nodiscard]] bool ends_program(int i) const {
    const Item& item = flat_.items[static_cast<std::size_t>(i)];
    const auto* end = std::get_if<ir::End>(&item.statement.node);
    return item.kind == ItemKind::end && end != nullptr && end->text != "END PGM";
  }
  /// How the subprogram of a root stands in the text.
  void judge(std::size_t r) {
    const auto& roots = flow_.roots();
    const auto& root = roots[r];
    const Item& label = flat_.items[static_cast<std::size_t>(root.start)];
    int last = root.ends.empty() ? -1 : root.ends.back();
    bool whole = true;
    for (int i = 0; i < static_cast<int>(flat_.items.size()); ++i) {
      if (!root.reached[static_cast<std::size_t>(i)]) continue;
      if (i < root.start) whole = false;
      if (ends_program(i)) last = std::max(last, i);  // a way may end the program
    }
    for (int i = last + 1; i < static_cast<int>(flat_.items.size()); ++i)
      whole = whole && !root.reached[static_cast<std::size_t>(i)];
    if (last < 0) {
      at(label).refuse("HEI-025", {}, "the subprogram has no LBL 0", "end it with LBL 0");
      return;
    }
    if (!whole) {
      at(label).keep("HEI-025", {}, "the subprogram is left by a jump: that is not carried", "language.statement");
      return;
    }
    bool shared = false;
    for (int i = root.start; i <= last; ++i) shared = shared || roots[0].reached[static_cast<std::size_t>(i)];
    std::vector<int> returns = root.ends;
    if (!returns.empty() && returns.back() == last) returns.pop_back();
    if (shared && (!returns.empty() || root.ends.empty())) {
      at(label).keep("HEI-025", {}, "a subprogram with several ends that the main program runs through is not carried",
                     "language.statement");
      return;
    }
    if (shared) {
      ranges_[root.start] = last;
      return;
    }
    Sub sub{root.start, last, 0, std::move(returns)};
    for (std::size_t other = 1; other < roots.size(); ++other) {
      const int start = roots[other].start;
      if (start > root.start && start <= last &&
          (sub.falls_into == 0 || start < roots[static_cast<std::size_t>(sub.falls_into)].start))
        sub.falls_into = static_cast<int>(other);
    }
    if (sub.falls_into != 0) sub.last = roots[static_cast<std::size_t>(sub.falls_into)].start - 1;
    subs_[r] = sub;
  }
  /// Calls get their routine, ranges their end, jumps and repeats are judged.
  void link() {
    for (std::size_t i = 0; i < flat_.items.size(); ++i) {
      const Item& item = flat_.items[i];
      const bool uses = item.kind == ItemKind::call || item.kind == ItemKind::repeat || item.kind == ItemKind::jump;
      if (!uses) continue;
      const int to = flow_.label(item);
      const auto refuse = [&](std::string_view code, std::string text) {
        at(item).refuse(code, {}, std::move(text));
        statements_[i].front().node = left_out(item);
      };
      if (to < 0) {
        refuse("HEI-010", "there is no label " + item.label + " in this file");
        continue;
      }
      const int here = owner_[i], there = owner_[static_cast<std::size_t>(to)];
      if (item.kind == ItemKind::call) {
        const auto range = ranges_.find(to);
        if (range != ranges_.end()) {
          if (here != 0) {
            refuse("HEI-025", "a subprogram that the main program runs through is called from another one");
            continue;
          }
          ir::Repeat repeat;
          repeat.first.text = item.label;
          repeat.first.is_number = item.number;
          repeat.last.text = end_label(range->second, item.label);
          statements_[i].front().node = std::move(repeat);
          continue;
        }
        const bool known =
            std::any_of(subs_.begin(), subs_.end(), [to](const auto& s) { return s.second.first == to; });
        if (!known) {
          refuse("HEI-025", "the subprogram " + item.label + " is not carried");
          continue;
        }
        std::get<ir::CallRoutine>(statements_[i].front().node).routine =
            routine_name(flat_.items[static_cast<std::size_t>(to)]);
        continue;
      }
      if (here != there) {
        refuse("HEI-025", "a jump or a repeat from one program part into another subprogram is not carried");
        continue;
      }
      if (item.kind == ItemKind::repeat && to > static_cast<int>(i))
        refuse("HEI-011", "CALL LBL REP goes back to a label; this one stands behind it");
    }
  }
  /// LBL 0 at the end of a part that is also run through.
  std::string end_label(int item, const std::string& of) {
    const std::string name = "END" + of;
    auto& list = statements_[static_cast<std::size_t>(item)];
    if (list.empty()) list.push_back(flat_.items[static_cast<std::size_t>(item)].statement);
    auto& labels = list.front().line.labels;
    const std::string_view kept = lowering_.keep(name);
    if (std::find(labels.begin(), labels.end(), kept) == labels.end()) labels.push_back(kept);
    list.front().node = ir::Label{};
    return name;
  }
  /// LBL 0 before the end of a subprogram.
  void put_return(std::size_t item) {
    auto& list = statements_[item];
    if (list.empty()) list.push_back(flat_.items[item].statement);
    list.front().node = ir::Return{};
  }
  [[nodiscard]] bool is_target(const Item& label) const {
    return std::any_of(flat_.items.begin(), flat_.items.end(), [&](const Item& i) {
      return (i.kind == ItemKind::jump || i.kind == ItemKind::repeat) && i.label == label.label &&
             i.number == label.number;
    });
  }
  void fill(ir::Routine& routine, int owner, int first, int last) {
    bool ended = false;  // nothing but a label comes behind a program end
    for (int i = first; i <= last; ++i) {
      const Item& item = flat_.items[static_cast<std::size_t>(i)];
      if (owner_[static_cast<std::size_t>(i)] != owner) continue;
      if (owner != 0 && i == first && !is_target(item) && item.statement.line.comments.empty()) continue;
      if (item.kind == ItemKind::label) ended = false;
      auto& list = statements_[static_cast<std::size_t>(i)];
      const auto* end = list.empty() ? nullptr : std::get_if<ir::End>(&list.front().node);
      if (ended && end != nullptr && end->text == "END PGM") continue;
      if (item.kind == ItemKind::end && item.statement.line.skip_mask == 0) ended = true;
      for (auto& s : list) routine.body.push_back(std::move(s));
    }
  }

  std::string main_name_;
  Lowering& lowering_;
  const Flow& flow_;
  const Flat& flat_;
  std::vector<std::vector<ir::Statement>> statements_;
  std::map<std::size_t, Sub> subs_;  ///< by root
  std::map<int, int> ranges_;        ///< label item -> LBL 0 of parts that the main program runs through
  std::vector<int> owner_;           ///< root of every item, 0: the main program
};

}  // namespace

void build_routines(Lowering& lowering, const Flow& flow, std::vector<std::vector<ir::Statement>> statements,
                    ir::Routine main, ir::Program& program) {
  Structure(lowering, flow, std::move(statements)).build(std::move(main), program);
}

}  // namespace cnctrans::frontends::heidenhain
