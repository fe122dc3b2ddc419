#include "frontends/fagor/state/state.h"

#include "dialects/fagor/limits.h"

namespace cnctrans::fagor {

std::vector<ir::VariableSpace> make_spaces() {
  ir::VariableSpace p;
  p.prefix = "P";
  for (const auto& range : dialects::fagor::parameter_ranges) {
    ir::SpaceSegment s;
    s.lo = range.lo;
    s.hi = range.hi;
    s.scope = range.local ? ir::Scope::level : ir::Scope::global;
    s.persistent = !range.local;
    p.segments.push_back(s);
  }
  return {p};
}

LowerState::LowerState(const machine::Profile& profile, Diagnostics& diagnostics)
    : profile_(&profile),
      diagnostics_(&diagnostics),
      options_(dialects::fagor::options_of(profile)),
      lathe_(profile.kind == machine::Kind::lathe) {
  units_by_text = profile.power_on.units;
  for (const auto& axis : profile.axes) {
    if (axis.id < axes_.size()) axes_[axis.id] = true;
  }
  for (std::size_t code = 0; code < g_rows_.size(); ++code)
    g_rows_[code] = dialects::fagor::find_g(static_cast<int>(code), lathe_);
  for (const auto& m : profile.m_codes) {
    if (m.code >= 0 && m.code < static_cast<std::int32_t>(m_rows_.size()))
      m_rows_[static_cast<std::size_t>(m.code)] = &m;
  }
  start_routine(false);
}

const machine::MCode* LowerState::m(int code) const {
  if (code >= 0 && code < static_cast<int>(m_rows_.size())) return m_rows_[static_cast<std::size_t>(code)];
  return profile_->m_code(code);
}

void LowerState::error(std::string_view code, WordPos pos, std::string message, std::string hint) {
  ++errors_;
  diagnostics_->error(code, word_span(line_, pos), std::move(message), std::move(hint));
}
void LowerState::warning(std::string_view code, WordPos pos, std::string message, std::string hint) {
  diagnostics_->warning(code, word_span(line_, pos), std::move(message), std::move(hint));
}
void LowerState::note(std::string_view code, WordPos pos, std::string message, std::string hint) {
  diagnostics_->note(code, word_span(line_, pos), std::move(message), std::move(hint));
}

void LowerState::start_routine(bool subroutine) {
  plane_ = profile_->power_on.plane;
  plane_from_caller_ = in_subroutine_ = subroutine;
  turned_ = false;
  comp_by_text = ir::CompSide::off;
  surface_by_text = ir::Surface::none;
  surface_plane_by_text = false;
  motion_by_text = ir::MotionKind::modal;
  motion_sure = comp_begins = comp_sure = plane_changed = false;
  constants_.clear();
  constants_known_ = true;
  spindle_ = 1;
  longitudinal_ = ir::axis::none;
  spindle_sure_ = longitudinal_sure_ = !subroutine;
  cycle_by_text = nullptr;
}

void LowerState::go_back_to(const LowerState& before) {
  FileFacts found = std::move(facts);
  const auto line = line_;
  const auto errors = errors_;
  *this = before;
  facts = std::move(found);
  line_ = line;
  errors_ = errors;
  labelled();
  if (!flow_planes_.empty()) take_flow_plane();
}

void LowerState::plane_code(ir::Plane plane, bool turned, bool of_surface) {
  plane_ = plane;
  turned_ = turned;
  if (turned && !of_surface && !facts.first_turned_plane.known()) facts.first_turned_plane = line_;
  plane_from_caller_ = false;
  facts.planes[static_cast<std::size_t>(plane)] = true;
  longitudinal_ = ir::axis::none;
  longitudinal_sure_ = true;
}

void LowerState::take_flow_plane() {
  const auto it = flow_planes_.find(line_.line);
  if (it == flow_planes_.end()) return;
  plane_ = it->second;
  plane_from_caller_ = false;
}

void LowerState::spindle_code(std::uint8_t number) {
  spindle_ = number;
  spindle_sure_ = true;
  facts.second_spindle = facts.second_spindle || number != 1;
}

void LowerState::longitudinal_code(ir::AxisId axis) {
  longitudinal_ = axis;
  longitudinal_sure_ = true;
  facts.longitudinal = true;
}

std::uint8_t LowerState::spindle() {
  if (!spindle_sure_) facts.text_uses.push_back({line_, false, in_subroutine_});
  return spindle_;
}

ir::AxisId LowerState::longitudinal() {
  if (!longitudinal_sure_) facts.text_uses.push_back({line_, true, in_subroutine_});
  if (longitudinal_ != ir::axis::none) return longitudinal_;
  return ir::plane_axes(plane_by_text()).w;
}

const double* LowerState::constant(std::int64_t parameter) const {
  const auto it = constants_.find(parameter);
  return constants_known_ && it != constants_.end() ? &it->second : nullptr;
}

void LowerState::assigned(std::int64_t parameter, const double* value) {
  if (value != nullptr) {
    constants_[parameter] = *value;
  } else {
    constants_.erase(parameter);
  }
}

ir::Plane LowerState::plane_by_text() {
  facts.plane_uses.push_back({line_, plane_, plane_from_caller_});
  return plane_;
}

}  // namespace cnctrans::fagor
