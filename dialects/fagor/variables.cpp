#include "dialects/fagor/variables.h"

#include <array>

namespace cnctrans::dialects::fagor {

namespace {

using ir::Datum;

// Name, axis letter follows, index, access from the part program, reading stops block preparation, IR datum, unit,
// type.
constexpr std::array<VariableInfo, 280> variable_table = {{
    // §11.2.2: Tools
    {"TOOL", false, Index::none, Access::read, false, Datum::tool_number, Unit::none, ir::Type::integer},
    {"TOD", false, Index::none, Access::read, false, Datum::offset_number, Unit::none, ir::Type::integer},
    {"NXTOOL", false, Index::none, Access::read, false, Datum::next_tool, Unit::none, ir::Type::integer},
    {"NXTOD", false, Index::none, Access::read, false, Datum::other, Unit::none, ir::Type::integer},
    {"TMZP", false, Index::always, Access::read, false, Datum::other, Unit::none, ir::Type::integer},
    {"PTOOL", false, Index::none, Access::read, false, Datum::other, Unit::none, ir::Type::integer},
    {"PNXTOOL", false, Index::none, Access::read, false, Datum::other, Unit::none, ir::Type::integer},
    {"TLFD", false, Index::always, Access::read_write, false, Datum::other, Unit::none, ir::Type::integer},
    {"TLFF", false, Index::always, Access::read_write, false, Datum::other, Unit::none, ir::Type::integer},
    {"TLFN", false, Index::always, Access::read_write, false, Datum::other, Unit::none, ir::Type::integer},
    {"TLFR", false, Index::always, Access::read_write, false, Datum::other, Unit::none, ir::Type::integer},
    {"TMZT", false, Index::always, Access::read_write, false, Datum::other, Unit::none, ir::Type::integer},
    {"HTOR", false, Index::none, Access::read_write, false, Datum::tool_radius, Unit::length, ir::Type::real},
    {"TOX", false, Index::always, Access::read_write, false, Datum::tool_length, Unit::length, ir::Type::real},
    {"TOZ", false, Index::always, Access::read_write, false, Datum::tool_length, Unit::length, ir::Type::real},
    {"TOF", false, Index::always, Access::read_write, false, Datum::tool_nose, Unit::none, ir::Type::integer},
    {"TOR", false, Index::always, Access::read_write, false, Datum::tool_radius, Unit::length, ir::Type::real},
    {"TOI", false, Index::always, Access::read_write, false, Datum::tool_wear, Unit::length, ir::Type::real},
    {"TOK", false, Index::always, Access::read_write, false, Datum::tool_wear, Unit::length, ir::Type::real},
    {"NOSEA", false, Index::always, Access::read_write, false, Datum::other, Unit::angle, ir::Type::real},
    {"NOSEW", false, Index::always, Access::read_write, false, Datum::tool_nose_width, Unit::length, ir::Type::real},
    {"CUTA", false, Index::always, Access::read_write, false, Datum::other, Unit::angle, ir::Type::real},
    // §11.2.3: Zero offsets
    {"ORG", true, Index::maybe, Access::read_write, false, Datum::work_offset, Unit::length, ir::Type::real},
    {"PORGF", false, Index::none, Access::read, false, Datum::pole_first, Unit::length, ir::Type::real},
    {"PORGS", false, Index::none, Access::read, false, Datum::pole_second, Unit::length, ir::Type::real},
    {"PLCOF", true, Index::none, Access::read_write, true, Datum::other, Unit::length, ir::Type::real},
    {"ADIOF", true, Index::none, Access::read, false, Datum::other, Unit::length, ir::Type::real},
    {"ADDORG", true, Index::none, Access::read, false, Datum::programmed_shift, Unit::length, ir::Type::real},
    {"EXTORG", false, Index::none, Access::read, true, Datum::active_offset, Unit::none, ir::Type::integer},
    // §11.2.4: Machine parameters
    {"MPG", false, Index::always, Access::read, false, Datum::other, Unit::none, ir::Type::integer},
    {"MP", true, Index::always, Access::read, false, Datum::other, Unit::none, ir::Type::integer},
    {"MPS", false, Index::always, Access::read, false, Datum::other, Unit::none, ir::Type::integer},
    {"MPSS", false, Index::always, Access::read, false, Datum::other, Unit::none, ir::Type::integer},
    {"MPAS", false, Index::always, Access::read, false, Datum::other, Unit::none, ir::Type::integer},
    {"MPLC", false, Index::always, Access::read, false, Datum::other, Unit::none, ir::Type::integer},
    // §11.2.5: Work zones
    {"FZONE", false, Index::none, Access::read, false, Datum::other, Unit::none, ir::Type::integer},
    {"FZLO", true, Index::none, Access::read, false, Datum::other, Unit::length, ir::Type::real},
    {"FZUP", true, Index::none, Access::read, false, Datum::other, Unit::length, ir::Type::real},
    {"SZONE", false, Index::none, Access::read, false, Datum::other, Unit::none, ir::Type::integer},
    {"SZLO", true, Index::none, Access::read, false, Datum::other, Unit::length, ir::Type::real},
    {"SZUP", true, Index::none, Access::read, false, Datum::other, Unit::length, ir::Type::real},
    {"TZONE", false, Index::none, Access::read, false, Datum::other, Unit::none, ir::Type::integer},
    {"TZLO", true, Index::none, Access::read, false, Datum::other, Unit::length, ir::Type::real},
    {"TZUP", true, Index::none, Access::read, false, Datum::other, Unit::length, ir::Type::real},
    {"FOZONE", false, Index::none, Access::read, false, Datum::other, Unit::none, ir::Type::integer},
    {"FOZLO", true, Index::none, Access::read, false, Datum::other, Unit::length, ir::Type::real},
    {"FOZUP", true, Index::none, Access::read, false, Datum::other, Unit::length, ir::Type::real},
    {"FIZONE", false, Index::none, Access::read, false, Datum::other, Unit::none, ir::Type::integer},
    {"FIZLO", true, Index::none, Access::read, false, Datum::other, Unit::length, ir::Type::real},
    {"FIZUP", true, Index::none, Access::read, false, Datum::other, Unit::length, ir::Type::real},
    // §11.2.6: Feedrates
    {"FREAL", false, Index::none, Access::read, false, Datum::other, Unit::feed, ir::Type::real},
    {"FREAL", true, Index::none, Access::read, false, Datum::other, Unit::feed, ir::Type::real},
    {"FTEO", true, Index::none, Access::read, false, Datum::other, Unit::feed, ir::Type::real},
    {"FEED", false, Index::none, Access::read, false, Datum::feed_per_minute, Unit::feed, ir::Type::real},
    {"DNCF", false, Index::none, Access::read, false, Datum::other, Unit::feed, ir::Type::real},
    {"PLCF", false, Index::none, Access::read, false, Datum::other, Unit::feed, ir::Type::real},
    {"PRGF", false, Index::none, Access::read, false, Datum::feed_per_minute, Unit::feed, ir::Type::real},
    {"FPREV", false, Index::none, Access::read, false, Datum::feed_per_rev, Unit::feed_per_rev, ir::Type::real},
    {"DNCFPR", false, Index::none, Access::read, false, Datum::other, Unit::feed_per_rev, ir::Type::real},
    {"PLCFPR", false, Index::none, Access::read, false, Datum::other, Unit::feed_per_rev, ir::Type::real},
    {"PRGFPR", false, Index::none, Access::read, false, Datum::feed_per_rev, Unit::feed_per_rev, ir::Type::real},
    {"PRGFIN", false, Index::none, Access::read, false, Datum::feed_inverse_time, Unit::inverse_time, ir::Type::real},
    {"FRO", false, Index::none, Access::read, false, Datum::other, Unit::percent, ir::Type::real},
    {"PRGFRO", false, Index::none, Access::read_write, false, Datum::other, Unit::percent, ir::Type::real},
    {"DNCFRO", false, Index::none, Access::read, false, Datum::other, Unit::percent, ir::Type::real},
    {"PLCFRO", false, Index::none, Access::read, false, Datum::other, Unit::percent, ir::Type::real},
    {"CNCFRO", false, Index::none, Access::read, false, Datum::other, Unit::percent, ir::Type::real},
    {"PLCCFR", false, Index::none, Access::read, false, Datum::other, Unit::percent, ir::Type::real},
    // §11.2.7: Coordinates
    {"PPOS", true, Index::none, Access::read, false, Datum::programmed_position, Unit::length, ir::Type::real},
    {"POS", true, Index::none, Access::read, true, Datum::machine_position, Unit::length, ir::Type::real},
    {"TPOS", true, Index::none, Access::read, true, Datum::machine_position, Unit::length, ir::Type::real},
    {"APOS", true, Index::none, Access::read, true, Datum::work_position, Unit::length, ir::Type::real},
    {"ATPOS", true, Index::none, Access::read, true, Datum::work_position, Unit::length, ir::Type::real},
    {"FLWE", true, Index::none, Access::read, true, Datum::other, Unit::length, ir::Type::real},
    {"DIST", true, Index::none, Access::read_write, true, Datum::other, Unit::length, ir::Type::real},
    {"LIMPL", true, Index::none, Access::read_write, false, Datum::other, Unit::length, ir::Type::real},
    {"LIMMI", true, Index::none, Access::read_write, false, Datum::other, Unit::length, ir::Type::real},
    {"DPLY", true, Index::none, Access::read, false, Datum::work_position, Unit::length, ir::Type::real},
    {"DRPO", true, Index::none, Access::read, false, Datum::machine_position, Unit::length, ir::Type::real},
    {"GPOS", true, Index::always, Access::read, false, Datum::other, Unit::length, ir::Type::real},
    // §11.2.8: Handwheels
    {"HANPF", false, Index::none, Access::read, false, Datum::other, Unit::none, ir::Type::integer},
    {"HANPS", false, Index::none, Access::read, false, Datum::other, Unit::none, ir::Type::integer},
    {"HANPT", false, Index::none, Access::read, false, Datum::other, Unit::none, ir::Type::integer},
    {"HANPFO", false, Index::none, Access::read, false, Datum::other, Unit::none, ir::Type::integer},
    {"HANDSE", false, Index::none, Access::read, false, Datum::other, Unit::none, ir::Type::integer},
    {"HANFCT", false, Index::none, Access::read, false, Datum::other, Unit::none, ir::Type::integer},
    {"HBEVAR", false, Index::none, Access::read, false, Datum::other, Unit::none, ir::Type::integer},
    {"MASLAN", false, Index::none, Access::read_write, false, Datum::other, Unit::angle, ir::Type::real},
    {"MASCFI", false, Index::none, Access::read_write, false, Datum::other, Unit::length, ir::Type::real},
    {"MASCSE", false, Index::none, Access::read_write, false, Datum::other, Unit::length, ir::Type::real},
    // §11.2.9: Feedback
    {"ASIN", true, Index::none, Access::read, false, Datum::other, Unit::none, ir::Type::integer},
    {"BSIN", true, Index::none, Access::read, false, Datum::other, Unit::none, ir::Type::integer},
    {"ASINS", false, Index::none, Access::read, false, Datum::other, Unit::none, ir::Type::integer},
    {"BSINS", false, Index::none, Access::read, false, Datum::other, Unit::none, ir::Type::integer},
    {"SASINS", false, Index::none, Access::read, false, Datum::other, Unit::none, ir::Type::integer},
    {"SBSINS", false, Index::none, Access::read, false, Datum::other, Unit::none, ir::Type::integer},
    // §11.2.10: Main spindle
    {"SREAL", false, Index::none, Access::read, true, Datum::other, Unit::rpm, ir::Type::real},
    {"FTEOS", false, Index::none, Access::read, false, Datum::other, Unit::rpm, ir::Type::real},
    {"SPEED", false, Index::none, Access::read, false, Datum::rpm, Unit::rpm, ir::Type::real},
    {"DNCS", false, Index::none, Access::read, false, Datum::other, Unit::rpm, ir::Type::real},
    {"PLCS", false, Index::none, Access::read, false, Datum::other, Unit::rpm, ir::Type::real},
    {"PRGS", false, Index::none, Access::read, false, Datum::rpm, Unit::rpm, ir::Type::real},
    {"CSS", false, Index::none, Access::read, false, Datum::cutting_speed, Unit::cutting_speed, ir::Type::real},
    {"DNCCSS", false, Index::none, Access::read, false, Datum::other, Unit::cutting_speed, ir::Type::real},
    {"PLCCSS", false, Index::none, Access::read, false, Datum::other, Unit::cutting_speed, ir::Type::real},
    {"PRGCSS", false, Index::none, Access::read, false, Datum::cutting_speed, Unit::cutting_speed, ir::Type::real},
    {"SSO", false, Index::none, Access::read, false, Datum::other, Unit::percent, ir::Type::real},
    {"PRGSSO", false, Index::none, Access::read_write, false, Datum::other, Unit::percent, ir::Type::real},
    {"DNCSSO", false, Index::none, Access::read, false, Datum::other, Unit::percent, ir::Type::real},
    {"PLCSSO", false, Index::none, Access::read, false, Datum::other, Unit::percent, ir::Type::real},
    {"CNCSSO", false, Index::none, Access::read, false, Datum::other, Unit::percent, ir::Type::real},
    {"SLIMIT", false, Index::none, Access::read, false, Datum::spindle_limit, Unit::rpm, ir::Type::real},
    {"DNCSL", false, Index::none, Access::read, false, Datum::other, Unit::rpm, ir::Type::real},
    {"PLCSL", false, Index::none, Access::read, false, Datum::other, Unit::rpm, ir::Type::real},
    {"PRGSL", false, Index::none, Access::read, false, Datum::spindle_limit, Unit::rpm, ir::Type::real},
    {"MDISL", false, Index::none, Access::read, false, Datum::other, Unit::rpm, ir::Type::real},
    {"POSS", false, Index::none, Access::read, true, Datum::other, Unit::angle, ir::Type::real},
    {"RPOSS", false, Index::none, Access::read, true, Datum::other, Unit::angle, ir::Type::real},
    {"TPOSS", false, Index::none, Access::read, true, Datum::other, Unit::angle, ir::Type::real},
    {"RTPOSS", false, Index::none, Access::read, true, Datum::other, Unit::angle, ir::Type::real},
    {"DRPOS", false, Index::none, Access::read, false, Datum::other, Unit::angle, ir::Type::real},
    {"PRGSP", false, Index::none, Access::read, false, Datum::other, Unit::angle, ir::Type::real},
    {"FLWES", false, Index::none, Access::read, true, Datum::other, Unit::angle, ir::Type::real},
    {"SYNCER", false, Index::none, Access::read, false, Datum::other, Unit::angle, ir::Type::real},
    // §11.2.11: Second spindle
    {"SSREAL", false, Index::none, Access::read, true, Datum::other, Unit::rpm, ir::Type::real},
    {"SFTEOS", false, Index::none, Access::read, false, Datum::other, Unit::rpm, ir::Type::real},
    {"SSPEED", false, Index::none, Access::read, false, Datum::other, Unit::rpm, ir::Type::real},
    {"SDNCS", false, Index::none, Access::read, false, Datum::other, Unit::rpm, ir::Type::real},
    {"SPLCS", false, Index::none, Access::read, false, Datum::other, Unit::rpm, ir::Type::real},
    {"SPRGS", false, Index::none, Access::read, false, Datum::other, Unit::rpm, ir::Type::real},
    {"SCSS", false, Index::none, Access::read, false, Datum::other, Unit::cutting_speed, ir::Type::real},
    {"SDNCCS", false, Index::none, Access::read, false, Datum::other, Unit::cutting_speed, ir::Type::real},
    {"SPLCCS", false, Index::none, Access::read, false, Datum::other, Unit::cutting_speed, ir::Type::real},
    {"SPRGCS", false, Index::none, Access::read, false, Datum::other, Unit::cutting_speed, ir::Type::real},
    {"SSSO", false, Index::none, Access::read, false, Datum::other, Unit::percent, ir::Type::real},
    {"SPRGSO", false, Index::none, Access::read_write, false, Datum::other, Unit::percent, ir::Type::real},
    {"SDNCSO", false, Index::none, Access::read, false, Datum::other, Unit::percent, ir::Type::real},
    {"SPLCSO", false, Index::none, Access::read, false, Datum::other, Unit::percent, ir::Type::real},
    {"SCNCSO", false, Index::none, Access::read, false, Datum::other, Unit::percent, ir::Type::real},
    {"SSLIMI", false, Index::none, Access::read, false, Datum::other, Unit::rpm, ir::Type::real},
    {"SDNCSL", false, Index::none, Access::read, false, Datum::other, Unit::rpm, ir::Type::real},
    {"SPLCSL", false, Index::none, Access::read, false, Datum::other, Unit::rpm, ir::Type::real},
    {"SPRGSL", false, Index::none, Access::read, false, Datum::other, Unit::rpm, ir::Type::real},
    {"SPOSS", false, Index::none, Access::read, true, Datum::other, Unit::angle, ir::Type::real},
    {"SRPOSS", false, Index::none, Access::read, true, Datum::other, Unit::angle, ir::Type::real},
    {"STPOSS", false, Index::none, Access::read, true, Datum::other, Unit::angle, ir::Type::real},
    {"SRTPOS", false, Index::none, Access::read, true, Datum::other, Unit::angle, ir::Type::real},
    {"SDRPOS", false, Index::none, Access::read, false, Datum::other, Unit::angle, ir::Type::real},
    {"SPRGSP", false, Index::none, Access::read, false, Datum::other, Unit::angle, ir::Type::real},
    {"SFLWES", false, Index::none, Access::read, true, Datum::other, Unit::angle, ir::Type::real},
    // §11.2.12: Live tool
    {"ASPROG", false, Index::none, Access::read, false, Datum::other, Unit::rpm, ir::Type::real},
    {"LIVRPM", false, Index::none, Access::read, false, Datum::other, Unit::rpm, ir::Type::real},
    // §11.2.13: PLC
    {"PLCMSG", false, Index::none, Access::read, false, Datum::other, Unit::none, ir::Type::integer},
    {"PLCI", false, Index::always, Access::read_write, true, Datum::other, Unit::none, ir::Type::integer},
    {"PLCO", false, Index::always, Access::read_write, true, Datum::other, Unit::none, ir::Type::integer},
    {"PLCM", false, Index::always, Access::read_write, true, Datum::other, Unit::none, ir::Type::integer},
    {"PLCR", false, Index::always, Access::read_write, true, Datum::other, Unit::none, ir::Type::integer},
    {"PLCT", false, Index::always, Access::read_write, true, Datum::other, Unit::none, ir::Type::integer},
    {"PLCC", false, Index::always, Access::read_write, true, Datum::other, Unit::none, ir::Type::integer},
    {"PLCMM", false, Index::always, Access::read_write, true, Datum::other, Unit::none, ir::Type::integer},
    // §11.2.14: Local and global parameters
    {"CALLP", false, Index::none, Access::read, false, Datum::call_has_argument, Unit::none, ir::Type::integer},
    {"GUP", false, Index::always, Access::none, false, Datum::other, Unit::none, ir::Type::integer},
    {"LUP", false, Index::none, Access::none, false, Datum::other, Unit::none, ir::Type::integer},
    // §11.2.15: Sercos
    {"SETGE", true, Index::none, Access::write, false, Datum::other, Unit::none, ir::Type::integer},
    {"SETGES", false, Index::none, Access::write, false, Datum::other, Unit::none, ir::Type::integer},
    {"SSETGS", false, Index::none, Access::write, false, Datum::other, Unit::none, ir::Type::integer},
    {"SVAR", true, Index::always, Access::read_write, false, Datum::other, Unit::none, ir::Type::integer},
    {"SVARS", false, Index::always, Access::read_write, false, Datum::other, Unit::none, ir::Type::integer},
    {"SSVARS", false, Index::always, Access::read_write, false, Datum::other, Unit::none, ir::Type::integer},
    {"TSVAR", true, Index::always, Access::read, false, Datum::other, Unit::none, ir::Type::integer},
    {"TSVARS", false, Index::always, Access::read, false, Datum::other, Unit::none, ir::Type::integer},
    {"TSSVAR", false, Index::always, Access::read, false, Datum::other, Unit::none, ir::Type::integer},
    // §11.2.16: Software and hardware configuration
    {"HARCON", false, Index::none, Access::read, false, Datum::other, Unit::none, ir::Type::integer},
    {"HARCOA", false, Index::none, Access::read, false, Datum::other, Unit::none, ir::Type::integer},
    {"IDHARH", false, Index::none, Access::read, false, Datum::other, Unit::none, ir::Type::integer},
    {"IDHARL", false, Index::none, Access::read, false, Datum::other, Unit::none, ir::Type::integer},
    {"SOFCON", false, Index::none, Access::read, false, Datum::other, Unit::none, ir::Type::integer},
    {"HDMEGA", false, Index::none, Access::read, false, Datum::other, Unit::none, ir::Type::integer},
    {"KEYIDE", false, Index::none, Access::read, false, Datum::other, Unit::none, ir::Type::integer},
    {"MODEL", false, Index::none, Access::read, false, Datum::other, Unit::none, ir::Type::integer},
    // §11.2.17: Telediagnosis
    {"HARSWA", false, Index::none, Access::read, false, Datum::other, Unit::none, ir::Type::integer},
    {"HARSWB", false, Index::none, Access::read, false, Datum::other, Unit::none, ir::Type::integer},
    {"HARTST", false, Index::none, Access::read, false, Datum::other, Unit::none, ir::Type::integer},
    {"MEMTST", false, Index::none, Access::read, false, Datum::other, Unit::none, ir::Type::integer},
    {"NODE", false, Index::none, Access::read, false, Datum::other, Unit::none, ir::Type::integer},
    {"VCHECK", false, Index::none, Access::read, false, Datum::other, Unit::none, ir::Type::integer},
    {"IONODE", false, Index::none, Access::read, false, Datum::other, Unit::none, ir::Type::integer},
    {"IOSLOC", false, Index::none, Access::read, false, Datum::other, Unit::none, ir::Type::integer},
    {"IOSREM", false, Index::none, Access::read, false, Datum::other, Unit::none, ir::Type::integer},
    // §11.2.18: Operating mode
    {"OPMODE", false, Index::none, Access::read, false, Datum::other, Unit::none, ir::Type::integer},
    {"OPMODA", false, Index::none, Access::read, false, Datum::other, Unit::none, ir::Type::integer},
    {"OPMODB", false, Index::none, Access::read, false, Datum::other, Unit::none, ir::Type::integer},
    {"OPMODC", false, Index::none, Access::read, false, Datum::other, Unit::none, ir::Type::integer},
    // §11.2.19: Other
    {"NBTOOL", false, Index::none, Access::read, false, Datum::other, Unit::none, ir::Type::integer},
    {"PRGN", false, Index::none, Access::read, false, Datum::other, Unit::none, ir::Type::integer},
    {"BLKN", false, Index::none, Access::read, false, Datum::other, Unit::none, ir::Type::integer},
    {"GS", false, Index::always, Access::read, false, Datum::active_modal, Unit::none, ir::Type::integer},
    {"GGSA", false, Index::none, Access::none, false, Datum::other, Unit::none, ir::Type::integer},
    {"GGSB", false, Index::none, Access::none, false, Datum::other, Unit::none, ir::Type::integer},
    {"GGSC", false, Index::none, Access::none, false, Datum::other, Unit::none, ir::Type::integer},
    {"GGSD", false, Index::none, Access::none, false, Datum::other, Unit::none, ir::Type::integer},
    {"GGSE", false, Index::none, Access::none, false, Datum::other, Unit::none, ir::Type::integer},
    {"GGSF", false, Index::none, Access::none, false, Datum::other, Unit::none, ir::Type::integer},
    {"GGSG", false, Index::none, Access::none, false, Datum::other, Unit::none, ir::Type::integer},
    {"GGSH", false, Index::none, Access::none, false, Datum::other, Unit::none, ir::Type::integer},
    {"GGSI", false, Index::none, Access::none, false, Datum::other, Unit::none, ir::Type::integer},
    {"GGSJ", false, Index::none, Access::none, false, Datum::other, Unit::none, ir::Type::integer},
    {"GGSK", false, Index::none, Access::none, false, Datum::other, Unit::none, ir::Type::integer},
    {"GGSL", false, Index::none, Access::none, false, Datum::other, Unit::none, ir::Type::integer},
    {"GGSM", false, Index::none, Access::none, false, Datum::other, Unit::none, ir::Type::integer},
    {"GGSN", false, Index::none, Access::none, false, Datum::other, Unit::none, ir::Type::integer},
    {"GGSO", false, Index::none, Access::none, false, Datum::other, Unit::none, ir::Type::integer},
    {"GGSP", false, Index::none, Access::none, false, Datum::other, Unit::none, ir::Type::integer},
    {"GGSQ", false, Index::none, Access::none, false, Datum::other, Unit::none, ir::Type::integer},
    {"MS", false, Index::always, Access::read, false, Datum::spindle_state, Unit::none, ir::Type::integer},
    {"GMS", false, Index::none, Access::none, false, Datum::other, Unit::none, ir::Type::integer},
    {"PLANE", false, Index::none, Access::read, false, Datum::active_plane, Unit::none, ir::Type::integer},
    {"LONGAX", false, Index::none, Access::read, false, Datum::other, Unit::none, ir::Type::integer},
    {"MIRROR", false, Index::none, Access::read, false, Datum::mirrored_axes, Unit::none, ir::Type::integer},
    {"SCALE", false, Index::none, Access::read, false, Datum::scale_factor, Unit::none, ir::Type::real},
    {"SCALE", true, Index::none, Access::read, false, Datum::axis_scale, Unit::none, ir::Type::real},
    {"ORGROT", false, Index::none, Access::read, false, Datum::rotation_angle, Unit::angle, ir::Type::real},
    {"PRBST", false, Index::none, Access::read, true, Datum::other, Unit::none, ir::Type::integer},
    {"CLOCK", false, Index::none, Access::read, true, Datum::other, Unit::time, ir::Type::real},
    {"TIME", false, Index::none, Access::read, true, Datum::other, Unit::time, ir::Type::real},
    {"DATE", false, Index::none, Access::read, true, Datum::other, Unit::none, ir::Type::integer},
    {"CYTIME", false, Index::none, Access::read, true, Datum::cycle_time, Unit::time, ir::Type::real},
    {"TIMER", false, Index::none, Access::read_write, true, Datum::other, Unit::time, ir::Type::real},
    {"PARTC", false, Index::none, Access::read_write, true, Datum::part_count, Unit::none, ir::Type::integer},
    {"FIRST", false, Index::none, Access::read, false, Datum::other, Unit::none, ir::Type::integer},
    {"KEY", false, Index::none, Access::read_write, true, Datum::other, Unit::none, ir::Type::integer},
    {"KEYSRC", false, Index::none, Access::read_write, false, Datum::other, Unit::none, ir::Type::integer},
    {"ANAI", false, Index::always, Access::read, true, Datum::other, Unit::volts, ir::Type::real},
    {"ANAO", false, Index::always, Access::read_write, true, Datum::other, Unit::volts, ir::Type::real},
    {"CNCERR", false, Index::none, Access::none, false, Datum::other, Unit::none, ir::Type::integer},
    {"PLCERR", false, Index::none, Access::none, false, Datum::other, Unit::none, ir::Type::integer},
    {"DNCERR", false, Index::none, Access::none, false, Datum::other, Unit::none, ir::Type::integer},
    {"DNCSTA", false, Index::none, Access::none, false, Datum::other, Unit::none, ir::Type::integer},
    {"AXICOM", false, Index::none, Access::read, false, Datum::other, Unit::none, ir::Type::integer},
    {"TANGAN", false, Index::none, Access::read, false, Datum::other, Unit::angle, ir::Type::real},
    {"TPIOUT", true, Index::none, Access::read, false, Datum::other, Unit::length, ir::Type::real},
    {"TIMEG", false, Index::none, Access::read, false, Datum::other, Unit::time, ir::Type::real},
    {"SELPRO", false, Index::none, Access::read_write, true, Datum::other, Unit::none, ir::Type::integer},
    {"DIAM", false, Index::none, Access::read_write, false, Datum::diameter_on, Unit::none, ir::Type::integer},
    {"PRBMOD", false, Index::none, Access::read_write, false, Datum::other, Unit::none, ir::Type::integer},
    {"RIP", false, Index::none, Access::none, false, Datum::other, Unit::none, ir::Type::integer},
    {"TEMPI", false, Index::always, Access::read, false, Datum::other, Unit::temperature, ir::Type::real},
    {"TIPPRB", false, Index::none, Access::read, false, Datum::other, Unit::length, ir::Type::real},
    {"PANEDI", false, Index::none, Access::read, false, Datum::other, Unit::none, ir::Type::integer},
    {"DATEDI", false, Index::none, Access::read, false, Datum::other, Unit::none, ir::Type::integer},
    {"FBDIF", true, Index::none, Access::read, false, Datum::other, Unit::length, ir::Type::real},
    {"CYCLEV", false, Index::none, Access::read, false, Datum::other, Unit::none, ir::Type::integer},
    {"CYCEDI", false, Index::none, Access::read, false, Datum::other, Unit::none, ir::Type::integer},
    {"DISBLO", false, Index::none, Access::read, false, Datum::other, Unit::none, ir::Type::integer},
    {"MIXPO", true, Index::none, Access::read, false, Datum::other, Unit::length, ir::Type::real},
    {"FLWAC", true, Index::none, Access::read, false, Datum::other, Unit::length, ir::Type::real},
    {"RADIOC", false, Index::none, Access::read, false, Datum::other, Unit::length, ir::Type::real},
    {"DISABMOD", false, Index::none, Access::read, false, Datum::other, Unit::none, ir::Type::integer},
    {"CYCCHORDERR", false, Index::none, Access::read_write, false, Datum::other, Unit::length, ir::Type::real},
    // mill model: Mill model
    {"TOL", false, Index::always, Access::read_write, false, Datum::tool_length, Unit::length, ir::Type::real},
    {"TOY", false, Index::always, Access::read_write, false, Datum::other, Unit::length, ir::Type::real},
    {"TOJ", false, Index::always, Access::read_write, false, Datum::other, Unit::length, ir::Type::real},
    // mill model: Inclined plane
    {"GTRATY", false, Index::none, Access::read, false, Datum::other, Unit::length, ir::Type::real},
    {"ORGROX", false, Index::none, Access::read, false, Datum::other, Unit::length, ir::Type::real},
    {"ORGROY", false, Index::none, Access::read, false, Datum::other, Unit::length, ir::Type::real},
    {"ORGROZ", false, Index::none, Access::read, false, Datum::other, Unit::length, ir::Type::real},
    {"ORGROA", false, Index::none, Access::read, false, Datum::other, Unit::angle, ir::Type::real},
    {"ORGROB", false, Index::none, Access::read, false, Datum::other, Unit::angle, ir::Type::real},
    {"ORGROC", false, Index::none, Access::read, false, Datum::other, Unit::angle, ir::Type::real},
    {"ORGROI", false, Index::none, Access::read, false, Datum::other, Unit::angle, ir::Type::real},
    {"ORGROJ", false, Index::none, Access::read, false, Datum::other, Unit::angle, ir::Type::real},
    {"ORGROK", false, Index::none, Access::read, false, Datum::other, Unit::angle, ir::Type::real},
    {"ORGROQ", false, Index::none, Access::read, false, Datum::other, Unit::angle, ir::Type::real},
    {"ORGROR", false, Index::none, Access::read, false, Datum::other, Unit::angle, ir::Type::real},
    {"ORGROS", false, Index::none, Access::read, false, Datum::other, Unit::angle, ir::Type::real},
    // §12.9: User channel
    {"DW", false, Index::always, Access::read_write, false, Datum::other, Unit::none, ir::Type::integer},
    {"DWH", false, Index::always, Access::read_write, false, Datum::other, Unit::none, ir::Type::integer},
    {"DWB", false, Index::always, Access::read_write, false, Datum::other, Unit::none, ir::Type::integer},
    {"SK", false, Index::always, Access::read_write, false, Datum::other, Unit::none, ir::Type::integer},
    {"IB", false, Index::always, Access::read_write, false, Datum::other, Unit::none, ir::Type::integer},
}};

}  // namespace

std::span<const VariableInfo> variables() {
  return variable_table;
}

std::string_view name(Unit u) {
  switch (u) {
    case Unit::none: return "";
    case Unit::length: return "length";
    case Unit::angle: return "angle";
    case Unit::feed: return "feed";
    case Unit::feed_per_rev: return "feed per revolution";
    case Unit::inverse_time: return "inverse time";
    case Unit::percent: return "percent";
    case Unit::rpm: return "rpm";
    case Unit::cutting_speed: return "cutting speed";
    case Unit::time: return "time";
    case Unit::volts: return "volts";
    case Unit::temperature: return "temperature";
  }
  return "";
}

VariableName find_variable(std::string_view name) {
  for (const auto& v : variable_table) {
    if (!v.axis && v.name == name) return {&v, ir::axis::none};
  }
  if (name.size() < 2) return {};
  const ir::AxisId axis = ir::fixed_axis(name.back());
  if (axis == ir::axis::none) return {};
  name.remove_suffix(1);
  for (const auto& v : variable_table) {
    if (v.axis && v.name == name) return {&v, axis};
  }
  return {};
}

}  // namespace cnctrans::dialects::fagor
