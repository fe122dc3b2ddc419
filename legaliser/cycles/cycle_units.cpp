// A cycle whose program changes from inches to millimetres, or back, while it is in force: its words stay what they
// were, in the new unit.
#include <cmath>
#include <utility>

#include "ir/cycles/milling/milling.h"
#include "legaliser/cycles/cycle_pass.h"

namespace cnctrans::ir::passes {

namespace {

void rescale(Value& v, double factor) {
  if (v.is(0)) return;
  v = v.literal() ? Value(std::round(v.number * factor * 1e9) / 1e9) : scale(v, factor);
}

HoleCycle in_unit(HoleCycle c, double factor) {
  for (Level* l : {&c.surface, &c.reference, &c.bottom, &c.retract, &c.pecks.first_to}) rescale(l->value, factor);
  for (Value* v : {&c.pecks.first, &c.pecks.minimum, &c.pecks.lift, &c.pecks.reapproach, &c.pitch, &c.shift_u,
                   &c.shift_v, &c.shift_w})
    rescale(*v, factor);
  if (c.pecks.law != PeckLaw::geometric) rescale(c.pecks.degression, factor);
  if (c.has_feed) rescale(c.feed, factor);
  if (c.has_feed_out) rescale(c.feed_out, factor);
  for (auto& [word, v] : c.mill.words) {
    const auto* p = cycles::find_mill_parameter(word);
    if (p != nullptr && p->quantity != cycles::MillQuantity::plain) rescale(v, factor);
  }
  return c;
}

}  // namespace

bool CyclePass::follow_units(Statement& s, const Block& b, const Facts& facts, Body& pieces, Body& out) {
  const auto now = setting_in<Units>(b, facts, Setting::units);
  if (now == active_->units || !facts.reachable) return false;
  const auto* hole = std::get_if<HoleCycle>(&active_->source->node);
  if (!now || !active_->units || hole == nullptr || !sure(facts) || !surely_on(facts)) {
    refuse(s, program_, context_, "TRN-331",
           "the unit of lengths changes while a cycle is in force, and in which unit its words are meant here is not "
           "known",
           "define the cycle again behind the change");
    for (auto& p : pieces) out.push_back(std::move(p));
    out.push_back(std::move(s));
    return true;
  }
  if (refuse_stale(s, out)) return true;
  auto made = std::make_shared<Cycle>();
  made->node = in_unit(*hole, *now == Units::inch ? 1 / 25.4 : 25.4);
  active_->source = std::move(made);
  active_->units = now;
  const bool was_on = active_->on_target || active_->maybe_on_target;
  active_->native = nullptr;
  active_->needs = {};
  active_->needs.scale = feed_scale_;
  if (auto native = native_form(active_->source, b, facts, context_, in_units(active_->defined_at, b, facts),
                                sense_.now(), &active_->needs))
    active_->native = *native;
  lacking_ = lacking_ || !active_->native;
  if (was_on && !(by_call_ && active_->native)) pieces.push_back(off_statement(s.line, by_call_));
  if (by_call_ && active_->native) {  // the words of the new call count in the unit that this block chooses
    for (const auto& a : b.actions) {
      const auto* set = std::get_if<ModalSet>(&a.data);
      if (set != nullptr && set->setting == Setting::units) pieces.push_back(make_block(s.line, action(*set)));
    }
    pieces.push_back(on_statement(s.line, active_->native));
  }
  active_->on_target = by_call_ && active_->native != nullptr;
  active_->maybe_on_target = false;
  return false;
}

}  // namespace cnctrans::ir::passes
