// Actions of a block: settings, spindle, tool, coolant, dwell.
#include <algorithm>
#include <cmath>

#include "interpreter/machine/block_machine.h"
#include "interpreter/trace/run_codes.h"

namespace cnctrans::interpreter {

namespace {

template <class T>
const T* first_of(const ir::Block& b) {
  for (const auto& a : b.actions) {
    if (const auto* t = std::get_if<T>(&a.data)) return t;
  }
  return nullptr;
}

bool commands_spindle(const ir::Block& b, int number, bool after) {
  return std::any_of(b.actions.begin(), b.actions.end(), [number, after](const ir::Action& a) {
    if ((a.order == ir::Order::after) != after) return false;
    if (const auto* r = std::get_if<ir::SpindleRun>(&a.data)) return r->number == number;
    if (const auto* o = std::get_if<ir::SpindleOrient>(&a.data)) return o->number == number;
    return false;
  });
}

std::string_view coolant_name(ir::CoolantState s) {
  switch (s) {
    case ir::CoolantState::flood: return "flood";
    case ir::CoolantState::mist: return "mist";
    case ir::CoolantState::second: return "second";
    case ir::CoolantState::off: break;
  }
  return "off";
}

}  // namespace

/// Carries out one action at its place; what settings_first() has done already is only shown here.
struct ActionRunner {
  BlockMachine& m;
  const ir::Block& b;
  bool after;

  bool operator()(const ir::ModalSet& a) const {
    if (a.setting == ir::Setting::comp) m.set_comp(static_cast<ir::CompSide>(a.value));
    if (after && a.setting != ir::Setting::comp) m.set_modal(a, b);
    if (a.setting == ir::Setting::spindle_mode) m.emit_if_running(b, m.spindles_.master_number(), after);
    return true;
  }
  bool operator()(const ir::SetFeed& a) const {
    m.set_feed(a);
    return true;
  }
  bool operator()(const ir::SetSpindle& a) const {
    if (after) m.set_spindle_value(a);
    m.emit_if_running(b, a.number, after);
    return true;
  }
  bool operator()(const ir::SpindleLimit& a) const {
    if (after) m.set_spindle_limit(a);
    m.emit_if_running(b, a.number, after);
    return true;
  }
  bool operator()(const ir::SpindleRun& a) const {
    m.run_spindle(a.number, a.state);
    return true;
  }
  bool operator()(const ir::SpindleOrient& a) const {
    const double angle = m.value(a.angle);
    auto* s = m.spindle(a.number);
    if (m.failure_.set || s == nullptr) return false;
    s->orient(angle + (a.incremental ? s->angle : 0));
    m.emit_spindle(a.number);
    return true;
  }
  bool operator()(const ir::SpindleGear& /*a*/) const { return true; }
  bool operator()(const ir::MasterSpindle& a) const {  // the other one goes on as it turns
    const auto* s = m.spindle(a.number);
    if (s == nullptr) return false;
    m.spindles_.make_master(a.number);
    m.modal_.spindle_mode = s->mode;
    return true;
  }
  bool operator()(const ir::ToolSelect& a) const {
    const bool changed_here = first_of<ir::ToolChange>(b) != nullptr;
    if (changed_here) return true;  // one event, at the change
    const bool own = first_of<ir::ToolOffset>(b) != nullptr;
    if (!m.select_tool(a, own)) return false;
    if (a.changes) m.tool_.offset_of_change(own);
    m.emit_tool(a.changes);
    return true;
  }
  bool operator()(const ir::ToolChange& /*a*/) const {
    const auto* t = first_of<ir::ToolSelect>(b);
    const bool own = first_of<ir::ToolOffset>(b) != nullptr;
    if (t != nullptr && !m.select_tool(*t, own)) return false;
    if (t != nullptr || !m.tool_.came_with_t()) {
      m.tool_.offset_of_change(own);
      m.emit_tool(true);
    }
    return true;
  }
  bool operator()(const ir::ToolOffset& a) const {
    std::int32_t number = 0;
    if (!m.whole(m.value(a.number), "offset number", number)) return false;
    m.tool_.select_offset(number);
    auto& e = m.plain(EventKind::offset);
    e.number = number;
    m.emitter_.emit(e);
    return true;
  }
  bool operator()(const ir::WorkOffset& a) const { return m.set_work_offset(a); }
  bool operator()(const ir::FrameOp& a) const { return a.change == nullptr || m.change_frame(*a.change); }
  bool operator()(const ir::PoleSet& a) const {
    m.set_pole(a);
    return true;
  }
  bool operator()(const ir::Dwell& a) const {
    // By the parts of a second where they are whole: 150.5 hundredths are 1.505 s.
    const double parts = a.scale < 1 ? std::round(1 / a.scale) : 0;
    const double amount = parts > 1 && parts * a.scale == 1 ? m.value(a.value) / parts : m.value(a.value) * a.scale;
    if (m.failure_.set) return false;
    m.emit_dwell(amount, a.revolutions);
    return true;
  }
  bool operator()(const ir::ExactStopBlock& /*a*/) const {
    m.now_.feed_stop = true;
    return true;
  }
  bool operator()(const ir::Coolant& a) const {
    m.emit_coolant(coolant_name(a.state));
    return true;
  }
  bool operator()(const ir::MachineFunction& a) const { return m.machine_function(a); }
  bool operator()(const ir::Stop& a) const {
    m.emit_stop(a.optional);
    return true;
  }
  bool operator()(const ir::CycleDefine& a) const { return m.define_cycle(a); }
  bool operator()(const ir::CycleCancel& /*a*/) const {
    m.cycle_.hole.reset();
    return true;
  }
  bool operator()(const ir::Corner& a) const {
    m.set_corner(a);
    return true;
  }
  bool operator()(const ir::TangentialEnd& a) const {
    m.set_tangential(a);
    return true;
  }
  bool operator()(const ir::PreparationStop& /*a*/) const { return m.split_curve(); }
  bool operator()(const ir::SplineAxes& a) const {
    m.curve_.axes.clear();
    for (const auto& axis : a.axes) {
      if (!m.check_axis(axis.axis)) return false;
      m.curve_.axes.push_back(axis.axis);
    }
    return true;
  }
  bool operator()(const ir::SurfaceSet& a) const { return m.set_surface(a); }
  bool operator()(const ir::OpaqueWord& /*a*/) const {
    return true;
  }  // its diagnostic decides whether the program runs
};

/// Modal settings hold for the whole block wherever they stand in it; a speed belongs to the command of its block.
bool BlockMachine::settings_first(const ir::Block& b) {
  for (const auto& a : b.actions) {
    if (a.order == ir::Order::after) continue;
    if (const auto* m = std::get_if<ir::ModalSet>(&a.data)) set_modal(*m, b);
  }
  for (const auto& a : b.actions) {
    if (a.order == ir::Order::after) continue;
    if (const auto* s = std::get_if<ir::SetSpindle>(&a.data)) set_spindle_value(*s);
    if (const auto* l = std::get_if<ir::SpindleLimit>(&a.data)) set_spindle_limit(*l);
  }
  return !failure_.set;
}

bool BlockMachine::actions(const ir::Block& b, bool after) {
  for (const auto& a : b.actions) {
    if ((a.order == ir::Order::after) != after) continue;
    if (!std::visit(ActionRunner{*this, b, after}, a.data) || failure_.set) return false;
  }
  return !failure_.set;
}

void BlockMachine::set_modal(const ir::ModalSet& m, const ir::Block& b) {
  switch (m.setting) {
    case ir::Setting::comp: return;  // shown at its place
    case ir::Setting::feed_mode: {
      const auto now = static_cast<ir::FeedMode>(m.value);
      if (now != modal_.feed_mode && m.feed_memory != ir::FeedMemory::per_mode) {
        const bool shared = m.feed_memory == ir::FeedMemory::shared;
        feed_[m.value] = shared ? feed_now() : 0;
        feed_degrees_[m.value] = shared ? feed_degrees() : 0;
      }
      modal_.feed_mode = now;
      return;
    }
    case ir::Setting::spindle_mode:
      set_spindle_mode(static_cast<ir::SpindleMode>(m.value), first_of<ir::SetSpindle>(b) != nullptr);
      return;
    case ir::Setting::units: modal_.units_feed_too = m.feed_too; break;
    case ir::Setting::plane:
      if (profile_.policies.polar_plane_resets_pole) {
        polar_.pole = {};
        polar_.pole_set = false;
      }
      if (profile_.policies.cycle_plane_function == machine::CyclePlaneFunction::ends &&
          m.value != static_cast<std::uint8_t>(modal_.plane))
        cycle_.hole.reset();
      break;
    default: break;
  }
  modal_.set(m.setting, m.value);
  if (m.setting == ir::Setting::length_comp) tool_.length_compensation_said();
  set_units();
}

void BlockMachine::set_units() {
  if (profile_.policies.machine_data_units == machine::MachineDataUnits::with_feed)
    data_modal_ = modal_.units == ir::Units::inch && modal_.units_feed_too;
  for (const auto a : axes_) {
    auto& axis = axis_[a];
    const double length = axis.rotary ? 1 : unit();
    const bool all = axis.diameter && modal_.diameter == ir::DiameterMode::diameter;
    const bool absolute = axis.diameter && modal_.diameter != ir::DiameterMode::radius;
    axis.scale_absolute = absolute ? length / 2 : length;
    axis.scale_incremental = all ? length / 2 : length;
  }
}

void BlockMachine::set_comp(ir::CompSide side) {
  if (side == modal_.comp) return;
  modal_.comp = side;
  auto& e = plain(EventKind::comp);
  e.state = ir::name(side);
  emitter_.emit(e);
}

/// The feed of the block alone, which wins in it, or the one beside it, which counts from the next block on.
void BlockMachine::feeds(const ir::Block& b, bool of_block) {
  for (const auto& a : b.actions) {
    const auto* f = std::get_if<ir::SetFeed>(&a.data);
    if (f != nullptr && f->block_only == of_block) set_feed(*f);
  }
}

void BlockMachine::set_feed(const ir::SetFeed& f) {
  const auto mode = static_cast<std::size_t>(modal_.feed_mode);
  feed_degrees_[mode] = value(f.value);
  if (feed_degrees_[mode] < 0) failure_.fail(code::number_range, "a feed is not negative");
  feed_[mode] = feed_degrees_[mode] * feed_unit();
}

// --- spindle ---------------------------------------------------------------------------------------------------

Spindle* BlockMachine::spindle(int number) {
  auto* s = spindles_.find(number);
  if (s == nullptr) failure_.fail(code::spindle_number, "there is no spindle " + std::to_string(number));
  return s;
}

void BlockMachine::set_spindle_value(const ir::SetSpindle& set) {
  auto* s = spindle(set.number);
  if (s == nullptr) return;
  const bool feet = s->mode == ir::SpindleMode::css && modal_.units == ir::Units::inch && modal_.units_feed_too;
  const double speed = value(set.value);
  if (speed < 0) failure_.fail(code::number_range, "a spindle speed is not negative");
  s->set_speed(speed * (feet ? 0.3048 : 1));
}

void BlockMachine::set_spindle_limit(const ir::SpindleLimit& l) {
  auto* s = spindle(l.number);
  if (s != nullptr && !l.lower) s->set_limit(value(l.value));
}

void BlockMachine::set_spindle_mode(ir::SpindleMode mode, bool with_value) {
  modal_.spindle_mode = mode;
  spindles_.master().set_mode(mode, with_value, 2 * std::abs(p_[ir::axis::x]));
}

void BlockMachine::run_spindle(int number, ir::SpindleState state) {
  auto* s = spindle(number);
  if (s == nullptr) return;
  s->run(state);
  emit_spindle(number);
}

void BlockMachine::orient_master(double angle) {
  spindles_.master().orient(angle);
  emit_master();
}

void BlockMachine::emit_spindle(int number) {
  auto& e = plain(EventKind::spindle);
  e.number = number;
  spindles_[number].show(e);
  emitter_.emit(e);
}

/// A change of speed, mode or limit shows while the spindle turns, once, and not beside a command of the same block
/// that is carried out at the same time.
void BlockMachine::emit_if_running(const ir::Block& b, int number, bool after) {
  auto* s = spindle(number);
  if (s != nullptr && s->turns() && s->changed() && !commands_spindle(b, number, after)) emit_spindle(number);
}

// --- tool, coolant, machine functions --------------------------------------------------------------------------

/// `number` rounded to a whole one. `what`: said where no such number exists.
bool BlockMachine::whole(double number, std::string_view what, std::int32_t& out) {
  if (failure_.set) return false;
  if (!(std::abs(number) < 2147483647.0)) {
    return failure_.fail(code::number_range, "there is no " + std::string(what) + " of " + number_text(number));
  }
  out = static_cast<std::int32_t>(std::lround(number));
  return true;
}

/// `own_offset`: a D stands beside it.
bool BlockMachine::select_tool(const ir::ToolSelect& t, bool own_offset) {
  std::int32_t number = 0;  // of a name: as the tools of the machine have it, else 0
  if (!whole(value(t.number), "tool number", number)) return false;
  tool_.select(number, std::string(t.name), t.changes);
  tool_.offset_of_selected(own_offset);
  return true;
}

void BlockMachine::emit_tool(bool change) {
  auto& e = plain(EventKind::tool);
  tool_.show(e, change);
  emitter_.emit(e);
  e.text.clear();
}

void BlockMachine::emit_coolant(std::string_view state) {
  auto& e = plain(EventKind::coolant);
  e.state = state;
  emitter_.emit(e);
}

void BlockMachine::emit_dwell(double amount, bool revolutions) {
  if (!(amount > 0)) return;
  auto& e = plain(EventKind::dwell);
  e.amount = amount;
  e.revolutions = revolutions;
  e.number = spindles_.master_number();
  emitter_.emit(e);
}

void BlockMachine::emit_stop(bool optional) {
  auto& e = plain(EventKind::stop);
  e.optional_stop = optional;
  emitter_.emit(e);
}

bool BlockMachine::machine_function(const ir::MachineFunction& f) {
  if (f.auxiliary) return true;  // an auxiliary output has no event
  std::int32_t code = f.code;
  if (f.computed && !whole(value(f.value), "M function", code)) return false;
  if (const auto* m = profile_.m_code(code); m != nullptr && m->meaning != machine::MMeaning::machine_function) {
    return profile_function(*m);
  }
  auto& e = plain(EventKind::m);
  e.number = code;
  emitter_.emit(e);
  return true;
}

bool BlockMachine::profile_function(const machine::MCode& m) {
  using machine::MMeaning;
  switch (m.meaning) {
    case MMeaning::stop: emit_stop(false); break;
    case MMeaning::optional_stop: emit_stop(true); break;
    case MMeaning::spindle_cw: run_spindle(1, ir::SpindleState::cw); break;
    case MMeaning::spindle_ccw: run_spindle(1, ir::SpindleState::ccw); break;
    case MMeaning::spindle_stop: run_spindle(1, ir::SpindleState::off); break;
    case MMeaning::spindle_orient:
      spindles_[1].orient(spindles_[1].angle);
      emit_spindle(1);
      break;
    case MMeaning::tool_change:
      if (tool_.came_with_t()) break;
      tool_.offset_of_change(false);
      emit_tool(true);
      break;
    case MMeaning::coolant_off: emit_coolant("off"); break;
    case MMeaning::coolant_flood: emit_coolant("flood"); break;
    case MMeaning::coolant_mist: emit_coolant("mist"); break;
    case MMeaning::coolant_second: emit_coolant("second"); break;
    case MMeaning::program_end:
    case MMeaning::subprogram_end:
      return failure_.fail(code::not_carried,
                           "M" + std::to_string(m.code) + " ends the program and cannot be computed");
    case MMeaning::gear:
    case MMeaning::none:
    case MMeaning::machine_function: break;
  }
  return true;
}

// --- corners, cycles: what the block says; carried out in path.cpp and cycles.cpp -------------------------------

void BlockMachine::set_corner(const ir::Corner& c) {
  Pending p;
  p.corner = c.kind;
  p.size = value(c.value) * unit();
  if (c.feed != nullptr) {
    p.has_feed = true;
    p.feed = value(*c.feed) * feed_unit();
  }
  if (c.modal) {
    modal_corner_.size = std::max(0.0, p.size);
    modal_corner_.has_feed = p.has_feed;
    modal_corner_.feed = p.feed;
  } else if (p.size > 0) {
    now_.corner = p;
  } else {
    now_.sharp = true;  // a corner of 0 in its block: none, whatever holds for the others
  }
}

void BlockMachine::set_tangential(const ir::TangentialEnd& t) {
  Pending p;
  p.tangential = true;
  p.exit = t.end == ir::TangentEnd::exit;
  p.size = value(t.radius) * unit();
  now_.corner = p;
}

}  // namespace cnctrans::interpreter
