// Codes and looks of the Sinumerik writer (reference-language 14, 15; style sheet: README).
#pragma once

#include <array>
#include <string_view>

#include "backends/common/style.h"
#include "dialects/sinumerik/limits.h"

namespace cnctrans::backends::sinumerik {

using ir::Setting;

/// Feed mode and spindle mode are one group on this control (G94 G95 G96 G97...) and are written by feed_code().
inline constexpr std::array modal_codes{
    ModalCode{Setting::plane, code_value(ir::Plane::xy), "G17"},
    ModalCode{Setting::plane, code_value(ir::Plane::zx), "G18"},
    ModalCode{Setting::plane, code_value(ir::Plane::yz), "G19"},
    ModalCode{Setting::distance, code_value(ir::Distance::absolute), "G90"},
    ModalCode{Setting::distance, code_value(ir::Distance::incremental), "G91"},
    ModalCode{Setting::units, code_value(ir::Units::metric), "G710"},
    ModalCode{Setting::units, code_value(ir::Units::inch), "G700"},
    ModalCode{Setting::diameter, code_value(ir::DiameterMode::radius), "DIAMOF"},
    ModalCode{Setting::diameter, code_value(ir::DiameterMode::diameter), "DIAMON"},
    ModalCode{Setting::diameter, code_value(ir::DiameterMode::absolute_only), "DIAM90"},
    ModalCode{Setting::path_mode, code_value(ir::PathMode::continuous), "G64"},
    ModalCode{Setting::path_mode, code_value(ir::PathMode::exact_stop), "G60"},
    ModalCode{Setting::comp, code_value(ir::CompSide::off), "G40"},
    ModalCode{Setting::comp, code_value(ir::CompSide::left), "G41"},
    ModalCode{Setting::comp, code_value(ir::CompSide::right), "G42"},
    ModalCode{Setting::spline_start, code_value(ir::SplineEnd::free), "BAUTO"},
    ModalCode{Setting::spline_start, code_value(ir::SplineEnd::natural), "BNAT"},
    ModalCode{Setting::spline_start, code_value(ir::SplineEnd::tangent), "BTAN"},
    ModalCode{Setting::spline_end, code_value(ir::SplineEnd::free), "EAUTO"},
    ModalCode{Setting::spline_end, code_value(ir::SplineEnd::natural), "ENAT"},
    ModalCode{Setting::spline_end, code_value(ir::SplineEnd::tangent), "ETAN"},
    ModalCode{Setting::path_reference, code_value(ir::PathReference::arc_length), "SPATH"},
    ModalCode{Setting::path_reference, code_value(ir::PathReference::parameter), "UPATH"},
    ModalCode{Setting::feed_point, code_value(ir::FeedPoint::centre), "CFTCP"},
    ModalCode{Setting::feed_point, code_value(ir::FeedPoint::contact), "CFC"},
};

inline constexpr std::array motion_codes{
    MotionCode{ir::MotionKind::rapid, "G0"},
    MotionCode{ir::MotionKind::linear, "G1"},
    MotionCode{ir::MotionKind::arc_cw, "G2"},
    MotionCode{ir::MotionKind::arc_ccw, "G3"},
    MotionCode{ir::MotionKind::arc_through_point, "CIP"},
    MotionCode{ir::MotionKind::arc_tangent, "CT"},
    MotionCode{ir::MotionKind::spline_akima, "ASPLINE"},
    MotionCode{ir::MotionKind::spline_b, "BSPLINE"},
    MotionCode{ir::MotionKind::spline_cubic, "CSPLINE"},
    MotionCode{ir::MotionKind::polynomial, "POLY"},
    MotionCode{ir::MotionKind::thread, "G33"},
    MotionCode{ir::MotionKind::thread_variable, "G34"},
    MotionCode{ir::MotionKind::reference_point, "G74"},
    MotionCode{ir::MotionKind::probe_toward, "MEAS=1 G1"},
    MotionCode{ir::MotionKind::probe_away, "MEAS=-1 G1"},
    MotionCode{ir::MotionKind::tap_rigid, "G331"},
    MotionCode{ir::MotionKind::tap_rigid_out, "G332"},
    MotionCode{ir::MotionKind::tap_floating, "G63"},
};

inline constexpr std::array<std::string_view, 10> skip_marks{"/", "/1", "/2", "/3", "/4", "/5", "/6", "/7", "/8", "/9"};

inline constexpr Style style{
    .dialect = "sinumerik",
    .comment = {.open = ";", .close = {}, .blank_after_open = true, .gap = 2},
    .modal_codes = modal_codes,
    .motion_codes = motion_codes,
    .falling_thread = "G35",
    .kept_decimals = 15,  // words take any number of places
    .made_decimals = 6,
    .line_length = cnctrans::sinumerik::block_characters - 2,
    .indent = 2,
    .exact_stop_block = "G9",
    .preparation_stop = "STOPRE",
    .radius_address = "CR",
    .skip_marks = skip_marks,
};

/// One code for feed mode and spindle mode together; empty: the control has none.
inline constexpr std::string_view feed_code(ir::FeedMode feed, ir::SpindleMode spindle) {
  const bool css = spindle == ir::SpindleMode::css;
  switch (feed) {
    case ir::FeedMode::per_minute: return css ? "G961" : "G94";
    case ir::FeedMode::per_rev: return css ? "G96" : "G95";
    case ir::FeedMode::inverse_time: break;
  }
  return css ? "" : "G93";
}

/// Type words of DEF and PROC.
inline constexpr std::string_view type_word(ir::Type type) {
  switch (type) {
    case ir::Type::integer: return "INT";
    case ir::Type::boolean: return "BOOL";
    case ir::Type::string: return "STRING[80]";
    case ir::Type::axis: return "AXIS";
    case ir::Type::frame: return "FRAME";
    case ir::Type::real: break;
  }
  return "REAL";
}

}  // namespace cnctrans::backends::sinumerik
