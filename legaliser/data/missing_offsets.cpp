// A target with one work offset whose values a program may write. Where all moves of the source are with one offset of
// its table, the target's stands for it. Where they are with several, variables at the head hold the values of each,
// and a selection writes them into the one.
#include "legaliser/data/missing_offsets.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "base/saturate.h"
#include "base/text.h"
#include "ir/edit/rewrite.h"
#include "legaliser/analysis/facts.h"
#include "legaliser/data/given_data.h"
#include "legaliser/edit/editor.h"

namespace cnctrans::ir::passes {

namespace {

constexpr std::int32_t only_row = 1;

std::optional<std::int32_t> selected(const Action& a) {
  const auto* w = std::get_if<WorkOffset>(&a.data);
  if (w == nullptr) return std::nullopt;
  if (w->off) return 0;
  return w->index.literal() ? saturate<std::int32_t>(w->index.number) : -1;
}

const SystemRef* row_datum(const ExprPtr& e) {
  const auto* ref = std::get_if<SystemRef>(&e->node);
  return ref != nullptr && ref->datum == Datum::work_offset ? ref : nullptr;
}

class MissingOffsets {
 public:
  MissingOffsets(Program& program, const LegaliseContext& context) : program_(program), context_(context) {}

  void run() {
    look();
    if (rows_.empty() || *rows_.rbegin() <= only_row) return;
    if (!good_ || program_.main() == nullptr) return refuse_data();
    std::set<std::int32_t> used;
    if (!uses_data_) used = rows_of_moves();
    if (used.size() == 1 && used.contains(*rows_.rbegin()) && rows_.size() == 1) return rename();
    copy();
  }

 private:
  void look() {
    for (const auto& r : program_.routines) {
      for_each_statement(r.body, [this](const Statement& s) {
        if (const auto* b = std::get_if<Block>(&s.node)) {
          for (const auto& a : b->actions) {
            const auto row = selected(a);
            if (row && *row != 0) rows_.insert(*row);
            good_ = good_ && row != -1;
          }
          for (const auto& c : b->motion.coords) axes_.insert(c.axis);
        }
        each_expression(s, [this](const ExprPtr& e) {
          walk(e, [this](const ExprPtr& x) {
            if (const auto* ref = row_datum(x)) add(*ref);
          });
        });
        const auto* a = std::get_if<Assign>(&s.node);
        for (std::size_t i = 0; a != nullptr && i < a->items.size(); ++i) {
          if (a->items[i].to_system && a->items[i].system.datum == Datum::work_offset) add(a->items[i].system);
        }
      });
    }
  }
  void add(const SystemRef& ref) {
    uses_data_ = true;
    const auto row = row_of(ref);
    good_ = good_ && row && context_.target.data_form && context_.target.data_form(in_only_row(ref.axis));
    if (row) rows_.insert(*row);
    axes_.insert(ref.axis);
  }
  static std::optional<std::int32_t> row_of(const SystemRef& ref) {
    const auto row = ref.args.size() == 1 ? constant_value(ref.args[0]) : std::nullopt;
    return row ? std::optional(saturate<std::int32_t>(*row)) : std::nullopt;
  }
  static SystemRef in_only_row(AxisId a) {
    SystemRef ref;
    ref.datum = Datum::work_offset;
    ref.axis = a;
    ref.args.push_back(number(only_row));
    return ref;
  }

  /// What is in force where the tool moves, or where the program asks for its place; -1: that depends.
  std::set<std::int32_t> rows_of_moves() {
    const FactsOf facts(program_, context_);
    std::set<std::int32_t> used;
    for (const auto& r : program_.routines) {
      for_each_statement(r.body, [&](const Statement& s) {
        std::optional<std::int32_t> row = facts.before(s).work_offset;
        if (const auto* b = std::get_if<Block>(&s.node)) {
          for (const auto& a : b->actions) {
            if (const auto now = selected(a)) row = now;
          }
        }
        if (feels(s) && facts.before(s).reachable) used.insert(row.value_or(-1));
      });
    }
    return used;
  }
  static bool feels(const Statement& s) {
    bool reads = false;
    each_expression(s, [&reads](const ExprPtr& e) {
      walk(e, [&reads](const ExprPtr& x) { reads = reads || std::holds_alternative<SystemRef>(x->node); });
    });
    const auto* b = std::get_if<Block>(&s.node);
    if (b == nullptr || reads) return reads;
    return (b->has_motion && b->motion.moves() && b->motion.frame == FrameUse::normal) ||
           std::any_of(b->actions.begin(), b->actions.end(), [](const Action& a) {
             return std::holds_alternative<CycleDefine>(a.data) || std::holds_alternative<OpaqueWord>(a.data);
           });
  }

  /// What is read or written of a row that gets no place.
  void refuse_data() const {
    const auto lacks = [](const SystemRef& ref) {
      return ref.datum == Datum::work_offset && row_of(ref).value_or(only_row) > only_row;
    };
    for (const auto& r : program_.routines) {
      for_each_statement(r.body, [&](const Statement& s) {
        const SystemRef* found = nullptr;
        each_expression(s, [&](const ExprPtr& e) {
          walk(e, [&](const ExprPtr& x) {
            const auto* ref = row_datum(x);
            if (ref != nullptr && lacks(*ref)) found = ref;
          });
        });
        const auto* a = std::get_if<Assign>(&s.node);
        for (std::size_t i = 0; a != nullptr && i < a->items.size(); ++i) {
          if (a->items[i].to_system && lacks(a->items[i].system)) found = &a->items[i].system;
        }
        if (found != nullptr)
          context_.diagnostics.error("TRN-122", s.line.span,
                                     "the target has no counterpart of " + quoted(name_of_datum(*found, program_)),
                                     "work with one work offset, or with shifts");
      });
    }
  }
  void rename() {
    const std::int32_t row = *rows_.begin();
    const Statement* first = nullptr;
    for (auto& r : program_.routines) {
      for_each_statement(r.body, [&](Statement& s) { first = select_only(s) && first == nullptr ? &s : first; });
    }
    context_.diagnostics.warning("TRN-340", first->line.span,
                                 "the target has one work offset: it stands for work offset " + std::to_string(row) +
                                     " of the source, the only one that the program moves with",
                                 "set it to the values of that offset before the program runs");
    if (context_.report != nullptr)
      context_.report->renamed.push_back({Renamed::Kind::variable, std::string(offset_name), std::to_string(row), {}});
  }
  static bool select_only(Statement& s) {
    auto* b = std::get_if<Block>(&s.node);
    bool found = false;
    for (std::size_t i = 0; b != nullptr && i < b->actions.size(); ++i) {
      const auto row = selected(b->actions[i]);
      if (!row || *row <= 0) continue;
      std::get<WorkOffset>(b->actions[i].data).index = Value{double(only_row)};
      found = true;
    }
    return found;
  }

  // --- several ------------------------------------------------------------------------------------------------

  void copy() {
    rows_.insert(only_row);
    const auto main = static_cast<std::size_t>(program_.main() - program_.routines.data());
    Editor head(program_, program_.routines[main], context_);
    const LineInfo where = first_selection();
    if (!take(head, where)) return refuse_data();
    const FactsOf facts(program_, context_);
    const bool from_start = starts_with_another(facts, program_.routines[main].body);
    for (auto& r : program_.routines) {
      Editor editor(program_, r, context_);
      const bool is_main = &r == &program_.routines[main];
      rewrite_body(r.body, [&](Statement&& s, Body& out) {
        data(s);
        const auto* end = std::get_if<End>(&s.node);
        if (end != nullptr && is_main && !end->returns_from_sub && facts.before(s).work_offset != only_row)
          return editor.put(out, one(written(s.line, only_row)), std::move(s));
        std::optional<std::int32_t> row;
        if (const auto* b = std::get_if<Block>(&s.node)) {
          for (const auto& a : b->actions) {
            const auto now = selected(a);
            if (now && *now > 0) row = now;
          }
        }
        if (!row) return out.push_back(std::move(s));
        select_only(s);
        Body before = one(written(s.line, *row));
        editor.put(out, std::move(before), std::move(s));
      });
    }
    auto& body = program_.routines[main].body;
    Body first = values(where);
    if (from_start) first.push_back(written(where, only_row));
    body.insert(below_head(body), std::make_move_iterator(first.begin()), std::make_move_iterator(first.end()));
    number_statements(program_);
  }
  static Body one(Statement s) {
    Body b;
    b.push_back(std::move(s));
    return b;
  }
  LineInfo first_selection() const {
    LineInfo found;
    bool any = false;
    for (const auto& r : program_.routines) {
      for_each_statement(r.body, [&](const Statement& s) {
        const auto* b = std::get_if<Block>(&s.node);
        for (std::size_t i = 0; b != nullptr && !any && i < b->actions.size(); ++i) {
          any = selected(b->actions[i]).value_or(0) > only_row;
          if (any) found.span = s.line.span;
        }
      });
    }
    return found;
  }
  /// The program moves before it selects one.
  static bool starts_with_another(const FactsOf& facts, const Body& body) {
    bool found = false;
    for_each_statement(body, [&](const Statement& s) {
      const auto* b = std::get_if<Block>(&s.node);
      const bool selects = b != nullptr && std::any_of(b->actions.begin(), b->actions.end(),
                                                       [](const Action& a) { return selected(a).has_value(); });
      found = found || (feels(s) && !selects && facts.before(s).work_offset.value_or(0) == 0);
    });
    return found;
  }

  bool take(Editor& editor, const LineInfo& where) {
    const auto& machine = context_.source_machine;
    for (const auto& a : machine.axes) {
      const auto own = context_.target_machine.axis(a.id) == nullptr || !context_.target.data_form
                           ? std::nullopt
                           : context_.target.data_form(in_only_row(a.id));
      if (!own || !own->writable || (a.rotary && !axes_.contains(a.id))) continue;
      for (const auto row : rows_) {
        const auto v = editor.take(where);
        if (!v) return false;
        places_[{row, a.id}] = {*v, own->units};
      }
    }
    return !places_.empty();
  }
  /// The values of each row, for the operator to change.
  Body values(const LineInfo& where) const {
    Body out;
    std::string list;
    for (const auto row : rows_) {
      Assign a;
      std::string remark = "work offset " + std::to_string(row) + ":";
      for (const auto& [key, place] : places_) {
        if (key.first != row) continue;
        double value = 0;
        if (const auto it = context_.source_machine.work_offsets.find(row);
            it != context_.source_machine.work_offsets.end() && it->second.contains(key.second))
          value = it->second.at(key.second);
        a.items.push_back(item(place.variable, number(std::nearbyint(value * place.units))));
        remark += ' ' + std::string(program_.axis_name(key.second));
        list += (list.empty() ? "" : ", ") + variable_text(place.variable, program_);
      }
      Statement s = made(where, std::move(a));
      s.line.skip_mask = 0;
      CommentText comment;
      comment.text = program_.keep(remark + ", in steps of " + shortest(1 / places_.begin()->second.units));
      s.line.comments.push_back(comment);
      out.push_back(std::move(s));
    }
    context_.diagnostics.warning(
        "TRN-341", where.span,
        "the target has one work offset, the program moves with " + std::to_string(rows_.size()) +
            ": each selection writes its values from " + list,
        "write the values of each offset at the head; a run that is broken off leaves those of "
        "the last one in force");
    return out;
  }
  static Assign::Item item(const VarRef& v, ExprPtr value) {
    Assign::Item i;
    i.target = v;
    i.value = std::move(value);
    return i;
  }
  Statement written(const LineInfo& like, std::int32_t row) const {
    Assign a;
    for (const auto& [key, place] : places_) {
      if (key.first != row) continue;
      Assign::Item i;
      i.to_system = true;
      i.system = in_only_row(key.second);
      i.value = in_units(place);
      a.items.push_back(std::move(i));
    }
    return made(like, std::move(a));
  }

  struct Place {
    VarRef variable;
    double units = 1;
  };
  /// The variable counts in the steps of the target's datum.
  static ExprPtr in_units(const Place& place) {
    return binary(BinaryOp::divide, variable(place.variable, Type::integer), number(place.units));
  }
  const Place* place_of(const SystemRef& ref) const {
    const auto it = places_.find({row_of(ref).value_or(0), ref.axis});
    return it == places_.end() ? nullptr : &it->second;
  }
  /// Rows that the program reads and writes are its variables now.
  void data(Statement& s) const {
    visit_statement(s, {[this](const ExprPtr& e) {
                          return map_expr(e, [this](const ExprPtr& x) {
                            const auto* ref = row_datum(x);
                            const auto* place = ref != nullptr ? place_of(*ref) : nullptr;
                            return place != nullptr ? in_units(*place) : x;
                          });
                        },
                        {}});
    auto* a = std::get_if<Assign>(&s.node);
    for (std::size_t k = 0; a != nullptr && k < a->items.size(); ++k) {
      auto& i = a->items[k];
      const auto* place = i.to_system && i.system.datum == Datum::work_offset ? place_of(i.system) : nullptr;
      if (place == nullptr) continue;
      i.to_system = false;
      i.system = {};
      i.target = place->variable;
      const auto scaled = binary(BinaryOp::multiply, i.value, number(place->units));
      const auto known = constant_value(scaled);
      i.value = known ? number(std::nearbyint(*known)) : call(Function::round, {scaled});
    }
  }

  Program& program_;
  const LegaliseContext& context_;
  std::set<std::int32_t> rows_;  ///< that the program selects, reads or writes
  std::set<AxisId> axes_;        ///< that it moves, or whose offsets it names
  bool good_ = true, uses_data_ = false;
  std::map<std::pair<std::int32_t, AxisId>, Place> places_;
};

}  // namespace

void place_missing_offsets(Program& program, const LegaliseContext& context) {
  if (context.target.work_offset_rows != only_row || program.dialect == context.target.dialect) return;
  MissingOffsets(program, context).run();
}

}  // namespace cnctrans::ir::passes
