#include "dialects/sinumerik/g_functions.h"

#include <array>

#include "base/text.h"
#include "ir/modal.h"

namespace cnctrans::sinumerik {

namespace {

template <class Enum>
constexpr std::uint8_t u(Enum e) {
  return static_cast<std::uint8_t>(e);
}

// In the order of the reference's table (section 15). G505 to G599 follow from a rule and are added below.
constexpr GFunction printed[] = {
    {"G0", 0, 1, 1, true, GUse::motion, u(ir::MotionKind::rapid)},
    {"G1", 1, 1, 2, true, GUse::motion, u(ir::MotionKind::linear)},
    {"G2", 2, 1, 3, true, GUse::motion, u(ir::MotionKind::arc_cw)},
    {"G3", 3, 1, 4, true, GUse::motion, u(ir::MotionKind::arc_ccw)},
    {"CIP", -1, 1, 5, true, GUse::motion, u(ir::MotionKind::arc_through_point)},
    {"ASPLINE", -1, 1, 6, true, GUse::motion, u(ir::MotionKind::spline_akima)},
    {"BSPLINE", -1, 1, 7, true, GUse::motion, u(ir::MotionKind::spline_b)},
    {"CSPLINE", -1, 1, 8, true, GUse::motion, u(ir::MotionKind::spline_cubic)},
    {"POLY", -1, 1, 9, true, GUse::motion, u(ir::MotionKind::polynomial)},
    {"G33", 33, 1, 10, true, GUse::motion, u(ir::MotionKind::thread)},
    {"G331", 331, 1, 11, true, GUse::motion, u(ir::MotionKind::tap_rigid)},
    {"G332", 332, 1, 12, true, GUse::motion, u(ir::MotionKind::tap_rigid_out)},
    {"OEMIPO1", -1, 1, 13, true, GUse::unsupported},
    {"OEMIPO2", -1, 1, 14, true, GUse::unsupported},
    {"CT", -1, 1, 15, true, GUse::motion, u(ir::MotionKind::arc_tangent)},
    {"G34", 34, 1, 16, true, GUse::motion, u(ir::MotionKind::thread_variable)},
    {"G35", 35, 1, 17, true, GUse::motion, u(ir::MotionKind::thread_variable), 1},
    {"INVCW", -1, 1, 18, true, GUse::unsupported},
    {"INVCCW", -1, 1, 19, true, GUse::unsupported},
    {"G335", 335, 1, 20, true, GUse::unsupported},
    {"G336", 336, 1, 21, true, GUse::unsupported},
    {"G4", 4, 2, 1, false, GUse::dwell},
    {"G63", 63, 2, 2, false, GUse::approach, u(ir::MotionKind::tap_floating)},
    {"G74", 74, 2, 3, false, GUse::approach, u(ir::MotionKind::reference_point)},
    {"G75", 75, 2, 4, false, GUse::approach, u(ir::MotionKind::fixed_point)},
    {"REPOSL", -1, 2, 5, false, GUse::unsupported},
    {"REPOSQ", -1, 2, 6, false, GUse::unsupported},
    {"REPOSH", -1, 2, 7, false, GUse::unsupported},
    {"REPOSA", -1, 2, 8, false, GUse::unsupported},
    {"REPOSQA", -1, 2, 9, false, GUse::unsupported},
    {"REPOSHA", -1, 2, 10, false, GUse::unsupported},
    {"G147", 147, 2, 11, false, GUse::joint},
    {"G247", 247, 2, 12, false, GUse::joint},
    {"G347", 347, 2, 13, false, GUse::joint},
    {"G148", 148, 2, 14, false, GUse::joint},
    {"G248", 248, 2, 15, false, GUse::joint},
    {"G348", 348, 2, 16, false, GUse::joint},
    {"G5", 5, 2, 17, false, GUse::inclined, 1},
    {"G7", 7, 2, 18, false, GUse::inclined},
    {"G751", 751, 2, 0, false, GUse::own_block},
    {"TRANS", -1, 3, 1, false, GUse::frame, u(FrameVerb::trans)},
    {"ROT", -1, 3, 2, false, GUse::frame, u(FrameVerb::rot)},
    {"SCALE", -1, 3, 3, false, GUse::frame, u(FrameVerb::scale)},
    {"MIRROR", -1, 3, 4, false, GUse::frame, u(FrameVerb::mirror)},
    {"ATRANS", -1, 3, 5, false, GUse::frame, u(FrameVerb::atrans)},
    {"AROT", -1, 3, 6, false, GUse::frame, u(FrameVerb::arot)},
    {"ASCALE", -1, 3, 7, false, GUse::frame, u(FrameVerb::ascale)},
    {"AMIRROR", -1, 3, 8, false, GUse::frame, u(FrameVerb::amirror)},
    {"G25", 25, 3, 10, false, GUse::limit},
    {"G26", 26, 3, 11, false, GUse::limit, 1},
    {"G110", 110, 3, 12, false, GUse::pole},
    {"G111", 111, 3, 13, false, GUse::pole, 1},
    {"G112", 112, 3, 14, false, GUse::pole, 2},
    {"G58", 58, 3, 15, false, GUse::frame, u(FrameVerb::g58)},
    {"G59", 59, 3, 16, false, GUse::frame, u(FrameVerb::g59)},
    {"ROTS", -1, 3, 17, false, GUse::frame, u(FrameVerb::rots)},
    {"AROTS", -1, 3, 18, false, GUse::frame, u(FrameVerb::arots)},
    {"STARTFIFO", -1, 4, 1, true, GUse::timing},
    {"STOPFIFO", -1, 4, 2, true, GUse::timing},
    {"FIFOCTRL", -1, 4, 3, true, GUse::timing},
    {"G17", 17, 6, 1, true, GUse::setting, u(ir::Setting::plane), u(ir::Plane::xy)},
    {"G18", 18, 6, 2, true, GUse::setting, u(ir::Setting::plane), u(ir::Plane::zx)},
    {"G19", 19, 6, 3, true, GUse::setting, u(ir::Setting::plane), u(ir::Plane::yz)},
    {"G40", 40, 7, 1, true, GUse::setting, u(ir::Setting::comp), u(ir::CompSide::off)},
    {"G41", 41, 7, 2, true, GUse::setting, u(ir::Setting::comp), u(ir::CompSide::left)},
    {"G42", 42, 7, 3, true, GUse::setting, u(ir::Setting::comp), u(ir::CompSide::right)},
    {"G500", 500, 8, 1, true, GUse::work_offset},
    {"G54", 54, 8, 2, true, GUse::work_offset, 1},
    {"G55", 55, 8, 3, true, GUse::work_offset, 2},
    {"G56", 56, 8, 4, true, GUse::work_offset, 3},
    {"G57", 57, 8, 5, true, GUse::work_offset, 4},
    {"G53", 53, 9, 1, false, GUse::suppress},
    {"SUPA", -1, 9, 2, false, GUse::suppress},
    {"G153", 153, 9, 3, false, GUse::suppress},
    {"G60", 60, 10, 1, true, GUse::path, u(ir::PathMode::exact_stop)},
    {"G64", 64, 10, 2, true, GUse::path, u(ir::PathMode::continuous)},
    {"G641", 641, 10, 3, true, GUse::path, u(ir::PathMode::continuous), 1},
    {"G642", 642, 10, 4, true, GUse::path, u(ir::PathMode::continuous), 1},
    {"G643", 643, 10, 5, true, GUse::path, u(ir::PathMode::continuous), 1},
    {"G644", 644, 10, 6, true, GUse::path, u(ir::PathMode::continuous), 1},
    {"G645", 645, 10, 7, true, GUse::path, u(ir::PathMode::continuous), 1},
    {"G9", 9, 11, 1, false, GUse::exact_stop_block},
    {"G601", 601, 12, 1, true, GUse::timing},
    {"G602", 602, 12, 2, true, GUse::timing},
    {"G603", 603, 12, 3, true, GUse::timing},
    {"G70", 70, 13, 1, true, GUse::units, u(ir::Units::inch)},
    {"G71", 71, 13, 2, true, GUse::units, u(ir::Units::metric)},
    {"G700", 700, 13, 3, true, GUse::units, u(ir::Units::inch), 1},
    {"G710", 710, 13, 4, true, GUse::units, u(ir::Units::metric), 1},
    {"G90", 90, 14, 1, true, GUse::setting, u(ir::Setting::distance), u(ir::Distance::absolute)},
    {"G91", 91, 14, 2, true, GUse::setting, u(ir::Setting::distance), u(ir::Distance::incremental)},
    {"G93", 93, 15, 1, true, GUse::feed, u(ir::FeedMode::inverse_time)},
    {"G94", 94, 15, 2, true, GUse::feed, u(ir::FeedMode::per_minute)},
    {"G95", 95, 15, 3, true, GUse::feed, u(ir::FeedMode::per_rev)},
    {"G96", 96, 15, 4, true, GUse::feed, u(ir::FeedMode::per_rev), 2},
    {"G97", 97, 15, 5, true, GUse::feed, u(ir::FeedMode::per_rev), 1},
    {"G931", 931, 15, 6, true, GUse::unsupported},
    {"G961", 961, 15, 7, true, GUse::feed, u(ir::FeedMode::per_minute), 2},
    {"G971", 971, 15, 8, true, GUse::feed, u(ir::FeedMode::per_minute), 1},
    {"G942", 942, 15, 9, true, GUse::unsupported},
    {"G952", 952, 15, 10, true, GUse::unsupported},
    {"G962", 962, 15, 11, true, GUse::unsupported},
    {"G972", 972, 15, 12, true, GUse::unsupported},
    {"G973", 973, 15, 13, true, GUse::unsupported},
    {"CFC", -1, 16, 1, true, GUse::setting, u(ir::Setting::feed_point), u(ir::FeedPoint::contact)},
    {"CFTCP", -1, 16, 2, true, GUse::setting, u(ir::Setting::feed_point), u(ir::FeedPoint::centre)},
    {"CFIN", -1, 16, 3, true, GUse::timing},
    {"NORM", -1, 17, 1, true, GUse::compensation},
    {"KONT", -1, 17, 2, true, GUse::compensation},
    {"KONTT", -1, 17, 3, true, GUse::compensation},
    {"KONTC", -1, 17, 4, true, GUse::compensation},
    {"G450", 450, 18, 1, true, GUse::compensation},
    {"G451", 451, 18, 2, true, GUse::compensation},
    {"BNAT", -1, 19, 1, true, GUse::setting, u(ir::Setting::spline_start), u(ir::SplineEnd::natural)},
    {"BTAN", -1, 19, 2, true, GUse::setting, u(ir::Setting::spline_start), u(ir::SplineEnd::tangent)},
    {"BAUTO", -1, 19, 3, true, GUse::setting, u(ir::Setting::spline_start), u(ir::SplineEnd::free)},
    {"ENAT", -1, 20, 1, true, GUse::setting, u(ir::Setting::spline_end), u(ir::SplineEnd::natural)},
    {"ETAN", -1, 20, 2, true, GUse::setting, u(ir::Setting::spline_end), u(ir::SplineEnd::tangent)},
    {"EAUTO", -1, 20, 3, true, GUse::setting, u(ir::Setting::spline_end), u(ir::SplineEnd::free)},
    {"BRISK", -1, 21, 1, true, GUse::timing},
    {"SOFT", -1, 21, 2, true, GUse::timing},
    {"DRIVE", -1, 21, 3, true, GUse::timing},
    {"CUT2D", -1, 22, 1, true, GUse::compensation},
    {"CUT2DF", -1, 22, 2, true, GUse::compensation},
    {"CUT3DC", -1, 22, 3, true, GUse::unsupported},
    {"CUT3DF", -1, 22, 4, true, GUse::unsupported},
    {"CUT3DFS", -1, 22, 5, true, GUse::unsupported},
    {"CUT3DFF", -1, 22, 6, true, GUse::unsupported},
    {"CUT3DCC", -1, 22, 7, true, GUse::unsupported},
    {"CUT3DCCD", -1, 22, 8, true, GUse::unsupported},
    {"CDOF", -1, 23, 1, true, GUse::compensation},
    {"CDON", -1, 23, 2, true, GUse::compensation},
    {"CDOF2", -1, 23, 3, true, GUse::compensation},
    {"FFWOF", -1, 24, 1, true, GUse::timing},
    {"FFWON", -1, 24, 2, true, GUse::timing},
    {"ORIWKS", -1, 25, 1, true, GUse::timing},
    {"ORIMKS", -1, 25, 2, true, GUse::timing},
    {"RMB", -1, 26, 1, true, GUse::timing},
    {"RMI", -1, 26, 2, true, GUse::timing},
    {"RME", -1, 26, 3, true, GUse::timing},
    {"RMN", -1, 26, 4, true, GUse::timing},
    {"ORIC", -1, 27, 1, true, GUse::timing},
    {"ORID", -1, 27, 2, true, GUse::timing},
    {"WALIMON", -1, 28, 1, true, GUse::timing},
    {"WALIMOF", -1, 28, 2, true, GUse::timing},
    {"DIAMOF", -1, 29, 1, true, GUse::setting, u(ir::Setting::diameter), u(ir::DiameterMode::radius)},
    {"DIAMON", -1, 29, 2, true, GUse::setting, u(ir::Setting::diameter), u(ir::DiameterMode::diameter)},
    {"DIAM90", -1, 29, 3, true, GUse::setting, u(ir::Setting::diameter), u(ir::DiameterMode::absolute_only)},
    // In cycles only; what is displayed is no matter here.
    {"DIAMCYCOF", -1, 29, 4, true, GUse::setting, u(ir::Setting::diameter), u(ir::DiameterMode::radius)},
    {"COMPOF", -1, 30, 1, true, GUse::timing},
    {"COMPON", -1, 30, 2, true, GUse::timing},
    {"COMPCURV", -1, 30, 3, true, GUse::timing},
    {"COMPCAD", -1, 30, 4, true, GUse::timing},
    {"G810", 810, 31, 1, true, GUse::unsupported},
    {"G811", 811, 31, 2, true, GUse::unsupported},
    {"G812", 812, 31, 3, true, GUse::unsupported},
    {"G813", 813, 31, 4, true, GUse::unsupported},
    {"G814", 814, 31, 5, true, GUse::unsupported},
    {"G815", 815, 31, 6, true, GUse::unsupported},
    {"G816", 816, 31, 7, true, GUse::unsupported},
    {"G817", 817, 31, 8, true, GUse::unsupported},
    {"G818", 818, 31, 9, true, GUse::unsupported},
    {"G819", 819, 31, 10, true, GUse::unsupported},
    {"G820", 820, 32, 1, true, GUse::unsupported},
    {"G821", 821, 32, 2, true, GUse::unsupported},
    {"G822", 822, 32, 3, true, GUse::unsupported},
    {"G823", 823, 32, 4, true, GUse::unsupported},
    {"G824", 824, 32, 5, true, GUse::unsupported},
    {"G825", 825, 32, 6, true, GUse::unsupported},
    {"G826", 826, 32, 7, true, GUse::unsupported},
    {"G827", 827, 32, 8, true, GUse::unsupported},
    {"G828", 828, 32, 9, true, GUse::unsupported},
    {"G829", 829, 32, 10, true, GUse::unsupported},
    {"FTOCOF", -1, 33, 1, true, GUse::timing},
    {"FTOCON", -1, 33, 2, true, GUse::unsupported},
    {"OSOF", -1, 34, 1, true, GUse::timing},
    {"OSC", -1, 34, 2, true, GUse::timing},
    {"OSS", -1, 34, 3, true, GUse::timing},
    {"OSSE", -1, 34, 4, true, GUse::timing},
    {"OSD", -1, 34, 5, true, GUse::timing},
    {"OST", -1, 34, 6, true, GUse::timing},
    {"SPOF", -1, 35, 1, true, GUse::timing},
    {"SON", -1, 35, 2, true, GUse::unsupported},
    {"PON", -1, 35, 3, true, GUse::unsupported},
    {"SONS", -1, 35, 4, true, GUse::unsupported},
    {"PONS", -1, 35, 5, true, GUse::unsupported},
    {"PDELAYON", -1, 36, 1, true, GUse::timing},
    {"PDELAYOF", -1, 36, 2, true, GUse::timing},
    {"FNORM", -1, 37, 1, true, GUse::timing},
    {"FLIN", -1, 37, 2, true, GUse::timing},
    {"FCUB", -1, 37, 3, true, GUse::timing},
    {"SPIF1", -1, 38, 1, true, GUse::timing},
    {"SPIF2", -1, 38, 2, true, GUse::timing},
    {"CPRECOF", -1, 39, 1, true, GUse::timing},
    {"CPRECON", -1, 39, 2, true, GUse::timing},
    {"CUTCONOF", -1, 40, 1, true, GUse::compensation},
    {"CUTCONON", -1, 40, 2, true, GUse::compensation},
    {"LFOF", -1, 41, 1, true, GUse::timing},
    {"LFON", -1, 41, 2, true, GUse::timing},
    {"TCOABS", -1, 42, 1, true, GUse::timing},
    {"TCOFR", -1, 42, 2, true, GUse::unsupported},
    {"TCOFRZ", -1, 42, 3, true, GUse::unsupported},
    {"TCOFRY", -1, 42, 4, true, GUse::unsupported},
    {"TCOFRX", -1, 42, 5, true, GUse::unsupported},
    {"G140", 140, 43, 1, true, GUse::compensation},
    {"G141", 141, 43, 2, true, GUse::compensation},
    {"G142", 142, 43, 3, true, GUse::compensation},
    {"G143", 143, 43, 4, true, GUse::compensation},
    {"G340", 340, 44, 1, true, GUse::compensation},
    {"G341", 341, 44, 2, true, GUse::compensation},
    {"SPATH", -1, 45, 1, true, GUse::setting, u(ir::Setting::path_reference), u(ir::PathReference::arc_length)},
    {"UPATH", -1, 45, 2, true, GUse::setting, u(ir::Setting::path_reference), u(ir::PathReference::parameter)},
    {"LFTXT", -1, 46, 1, true, GUse::timing},
    {"LFWP", -1, 46, 2, true, GUse::timing},
    {"LFPOS", -1, 46, 3, true, GUse::timing},
    {"G290", 290, 47, 1, true, GUse::timing},
    {"G291", 291, 47, 2, true, GUse::own_block},
    {"G460", 460, 48, 1, true, GUse::compensation},
    {"G461", 461, 48, 2, true, GUse::compensation},
    {"G462", 462, 48, 3, true, GUse::compensation},
    {"CP", -1, 49, 1, true, GUse::timing},
    {"PTP", -1, 49, 2, true, GUse::joint},
    {"PTPG0", -1, 49, 3, true, GUse::joint},
    {"ORIEULER", -1, 50, 1, true, GUse::timing},
    {"ORIRPY", -1, 50, 2, true, GUse::timing},
    {"ORIVIRT1", -1, 50, 3, true, GUse::timing},
    {"ORIVIRT2", -1, 50, 4, true, GUse::timing},
    {"ORIAXPOS", -1, 50, 5, true, GUse::timing},
    {"ORIRPY2", -1, 50, 6, true, GUse::timing},
    {"ORIVECT", -1, 51, 1, true, GUse::timing},
    {"ORIAXES", -1, 51, 2, true, GUse::timing},
    {"ORIPATH", -1, 51, 3, true, GUse::timing},
    {"ORIPLANE", -1, 51, 4, true, GUse::timing},
    {"ORICONCW", -1, 51, 5, true, GUse::timing},
    {"ORICONCCW", -1, 51, 6, true, GUse::timing},
    {"ORICONIO", -1, 51, 7, true, GUse::timing},
    {"ORICONTO", -1, 51, 8, true, GUse::timing},
    {"ORICURVE", -1, 51, 9, true, GUse::timing},
    {"ORIPATHS", -1, 51, 10, true, GUse::timing},
    {"PAROTOF", -1, 52, 1, true, GUse::timing},
    {"PAROT", -1, 52, 2, true, GUse::table_frame},
    {"TOROTOF", -1, 53, 1, true, GUse::tool_frame, 3, 0},
    {"TOROT", -1, 53, 2, true, GUse::tool_frame, 2, 0},
    {"TOROTZ", -1, 53, 3, true, GUse::tool_frame, 2, 0},
    {"TOROTY", -1, 53, 4, true, GUse::tool_frame, 1, 0},
    {"TOROTX", -1, 53, 5, true, GUse::tool_frame, 0, 0},
    {"TOFRAME", -1, 53, 6, true, GUse::tool_frame, 2, 1},
    {"TOFRAMEZ", -1, 53, 7, true, GUse::tool_frame, 2, 1},
    {"TOFRAMEY", -1, 53, 8, true, GUse::tool_frame, 1, 1},
    {"TOFRAMEX", -1, 53, 9, true, GUse::tool_frame, 0, 1},
    {"ORIROTA", -1, 54, 1, true, GUse::timing},
    {"ORIROTR", -1, 54, 2, true, GUse::timing},
    {"ORIROTT", -1, 54, 3, true, GUse::timing},
    {"ORIROTC", -1, 54, 4, true, GUse::timing},
    {"RTLION", -1, 55, 1, true, GUse::timing},
    {"RTLIOF", -1, 55, 2, true, GUse::timing},
    {"TOWSTD", -1, 56, 1, true, GUse::compensation},
    {"TOWMCS", -1, 56, 2, true, GUse::compensation},
    {"TOWWCS", -1, 56, 3, true, GUse::compensation},
    {"TOWBCS", -1, 56, 4, true, GUse::compensation},
    {"TOWTCS", -1, 56, 5, true, GUse::compensation},
    {"TOWKCS", -1, 56, 6, true, GUse::compensation},
    {"FENDNORM", -1, 57, 1, true, GUse::timing},
    {"G62", 62, 57, 2, true, GUse::timing},
    {"G621", 621, 57, 3, true, GUse::timing},
    {"DYNNORM", -1, 59, 1, true, GUse::timing},
    {"DYNPOS", -1, 59, 2, true, GUse::timing},
    {"DYNROUGH", -1, 59, 3, true, GUse::timing},
    {"DYNSEMIFIN", -1, 59, 4, true, GUse::timing},
    {"DYNFINISH", -1, 59, 5, true, GUse::timing},
    {"WALCS0", -1, 60, 1, true, GUse::timing},
    {"WALCS1", -1, 60, 2, true, GUse::timing},
    {"WALCS2", -1, 60, 3, true, GUse::timing},
    {"WALCS3", -1, 60, 4, true, GUse::timing},
    {"WALCS4", -1, 60, 5, true, GUse::timing},
    {"WALCS5", -1, 60, 6, true, GUse::timing},
    {"WALCS6", -1, 60, 7, true, GUse::timing},
    {"WALCS7", -1, 60, 8, true, GUse::timing},
    {"WALCS8", -1, 60, 9, true, GUse::timing},
    {"WALCS9", -1, 60, 10, true, GUse::timing},
    {"WALCS10", -1, 60, 11, true, GUse::timing},
    {"ORISOF", -1, 61, 1, true, GUse::timing},
    {"ORISON", -1, 61, 2, true, GUse::timing},
    {"RMBBL", -1, 62, 1, true, GUse::timing},
    {"RMIBL", -1, 62, 2, true, GUse::timing},
    {"RMEBL", -1, 62, 3, true, GUse::timing},
    {"RMNBL", -1, 62, 4, true, GUse::timing},
};

constexpr int first_offset = 505;
constexpr int last_offset = 599;
constexpr std::array<std::string_view, last_offset - first_offset + 1> offset_names = {
    "G505", "G506", "G507", "G508", "G509", "G510", "G511", "G512", "G513", "G514", "G515", "G516", "G517", "G518",
    "G519", "G520", "G521", "G522", "G523", "G524", "G525", "G526", "G527", "G528", "G529", "G530", "G531", "G532",
    "G533", "G534", "G535", "G536", "G537", "G538", "G539", "G540", "G541", "G542", "G543", "G544", "G545", "G546",
    "G547", "G548", "G549", "G550", "G551", "G552", "G553", "G554", "G555", "G556", "G557", "G558", "G559", "G560",
    "G561", "G562", "G563", "G564", "G565", "G566", "G567", "G568", "G569", "G570", "G571", "G572", "G573", "G574",
    "G575", "G576", "G577", "G578", "G579", "G580", "G581", "G582", "G583", "G584", "G585", "G586", "G587", "G588",
    "G589", "G590", "G591", "G592", "G593", "G594", "G595", "G596", "G597", "G598", "G599",
};

constexpr std::size_t row_count = std::size(printed) + offset_names.size();

constexpr std::array<GFunction, row_count> make_rows() {
  std::array<GFunction, row_count> g_rows{};
  std::size_t at = 0;
  for (const auto& r : printed) g_rows[at++] = r;
  for (int n = first_offset; n <= last_offset; ++n) {  // G505 is row 5, index 6 of group 8
    g_rows[at++] = GFunction{offset_names[static_cast<std::size_t>(n - first_offset)],
                             static_cast<std::int16_t>(n),
                             8,
                             static_cast<std::uint8_t>(n - 499),
                             true,
                             GUse::work_offset,
                             static_cast<std::uint8_t>(n - 500)};
  }
  return g_rows;
}
constexpr auto g_rows = make_rows();

constexpr int number_limit = 1000;
constexpr std::array<std::int16_t, number_limit> make_by_number() {
  std::array<std::int16_t, number_limit> by{};
  for (auto& b : by) b = -1;
  for (std::size_t i = 0; i < g_rows.size(); ++i) {
    if (g_rows[i].number >= 0) by[static_cast<std::size_t>(g_rows[i].number)] = static_cast<std::int16_t>(i);
  }
  return by;
}
constexpr auto by_number = make_by_number();

}  // namespace

std::span<const GFunction> g_functions() {
  return g_rows;
}

const GFunction* g_function(std::int32_t number) {
  if (number < 0 || number >= number_limit) return nullptr;
  const std::int16_t at = by_number[static_cast<std::size_t>(number)];
  return at < 0 ? nullptr : &g_rows[static_cast<std::size_t>(at)];
}

const GFunction* g_function(std::string_view name) {
  for (const auto& r : g_rows) {
    if (r.number < 0 && iequals_ascii(name, r.name)) return &r;
  }
  return nullptr;
}

const GFunction* g_function(std::int32_t group, std::int32_t index) {
  if (index == 0) return nullptr;
  for (const auto& r : g_rows) {
    if (r.group == group && r.index == index) return &r;
  }
  return nullptr;
}

std::string_view missing_feature(const GFunction& g) {
  if (g.use != GUse::unsupported && g.use != GUse::own_block) return {};
  constexpr std::uint8_t motion_group = 1;
  constexpr std::uint8_t splines_from = 6, splines_to = 8, polynomial = 9;
  constexpr std::uint8_t oem = 31, more_oem = 32, language = 47;
  if (g.number == 751) return "block.word";
  if (g.group == oem || g.group == more_oem || g.name.starts_with("OEM")) return "machine.makers_own";
  if (g.group == language) return "language.other_mode";
  if (g.name.starts_with("INVC")) return "motion.involute";
  if (g.group != motion_group) return g.group >= 49 && g.group <= 53 ? "motion.transformation" : "language.statement";
  if (g.index >= splines_from && g.index <= splines_to) return "motion.spline";
  return g.index == polynomial ? "motion.polynomial" : "language.statement";
}

}  // namespace cnctrans::sinumerik
