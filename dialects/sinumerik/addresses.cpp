#include "dialects/sinumerik/addresses.h"

#include <algorithm>
#include <array>
#include <iterator>

#include "base/text.h"
#include "dialects/sinumerik/asked.h"
#include "dialects/sinumerik/beside.h"
#include "dialects/sinumerik/cycles.h"
#include "dialects/sinumerik/g_functions.h"
#include "dialects/sinumerik/operators.h"

namespace cnctrans::sinumerik {

namespace {

using enum NamedWord;

constexpr NamedWordRow words[] = {
    // arcs, polar, contour elements (14.3, 14.4)
    {"CR", arc_radius},
    {"AR", opening_angle},
    {"TURN", turns},
    {"RP", polar_radius},
    {"AP", polar_angle},
    {"ANG", line_angle},
    {"ANG1", unsupported},
    {"ANG2", unsupported},
    {"RND", round},
    {"RNDM", round_modal},
    {"CHR", chamfer_leg},
    {"CHF", chamfer_chord},
    {"FRC", corner_feed},
    {"FRCM", corner_feed_modal},
    // threads, spindles (14.3, 14.7)
    {"SF", thread_start},
    {"DITS", timing},
    {"DITE", timing},
    {"LIMS", spindle_limit},
    {"SPOS", spindle_position},
    {"SPOSA", spindle_position},
    {"SVC", cutting_speed},
    {"FZ", tooth_feed},
    // frames
    {"RPL", rotation_in_plane},
    // feed, dynamics, tolerances (motion 5)
    {"ADIS", timing},
    {"ADISPOS", timing},
    {"CTOL", timing},
    {"OTOL", timing},
    {"STOLF", timing},
    {"ORIS", timing},
    {"OVR", timing},
    {"OVRRAP", timing},
    {"ACC", timing},
    {"FB", block_feed},
    // radius compensation and tool data
    {"DISC", compensation},
    {"OFFN", compensation},
    {"DISR", joint},
    {"DISCL", joint},
    {"FAD", joint},
    {"TOFFL", compensation},
    {"TOFFR", compensation},
    {"TOFF", compensation},
    {"DL", compensation},
    // orientation, splines, polynomials, probing, oscillation
    {"LEAD", orientation},
    {"TILT", orientation},
    {"THETA", orientation},
    {"NUT", orientation},
    {"PW", point_weight},
    {"SD", spline_degree},
    {"PL", interval},
    {"STAT", joint},
    {"TU", joint},
    {"MEAS", probe},
    {"MEAW", probe_to_end},
    {"FP", fixed_point},
    {"DISPR", unsupported},
    {"PRIO", unsupported},
};

constexpr ProcedureRow procedure_rows[] = {
    {"DIAMONA", Procedure::axis_setting},
    {"DIAMOFA", Procedure::axis_setting},
    {"DIAM90A", Procedure::axis_setting},
    {"SCC", Procedure::axis_setting},
    {"MSG", Procedure::message},
    {"SETAL", Procedure::set_alarm},
    {"STOPRE", Procedure::stop_preparation},
    {"RET", Procedure::repeat_return},
    {"GOTOS", Procedure::program_start},
    {"WORKPIECE", Procedure::screen},
    {"GROUP_BEGIN", Procedure::screen},
    {"GROUP_END", Procedure::screen},
    {"GROUP_ADDEND", Procedure::screen},
    {"SEFORM", Procedure::screen},
    {"MMC", Procedure::screen},
    {"E_HEAD", Procedure::screen},
    {"ENDPROC", Procedure::screen},
    {"FGROUP", Procedure::timing},
    {"CYCLE832", Procedure::timing},
    {"BRISKA", Procedure::timing},
    {"SOFTA", Procedure::timing},
    {"DRIVEA", Procedure::timing},
    {"JERKA", Procedure::timing},
    {"DISPLOF", Procedure::timing},
    {"DISPLON", Procedure::timing},
    {"SBLOF", Procedure::timing},
    {"SBLON", Procedure::timing},
    {"WAITP", Procedure::timing},
    {"WAITS", Procedure::timing},
    {"SPCON", Procedure::timing},
    {"SPCOF", Procedure::timing},
    {"WRTPR", Procedure::timing},
    {"IPTRLOCK", Procedure::timing},
    {"IPTRUNLOCK", Procedure::timing},
    {"DELAYFSTON", Procedure::timing},
    {"DELAYFSTOF", Procedure::timing},
    {"FINEA", Procedure::timing},
    {"COARSEA", Procedure::timing},
    {"IPOENDA", Procedure::timing},
    {"ADISPOSA", Procedure::timing},
    {"IPOBRKA", Procedure::timing},
    {"SETMS", Procedure::master_spindle},
    {"GEOAX", Procedure::geometry_axes},
    {"TRANSMIT", Procedure::transformation},
    {"TRACYL", Procedure::transformation},
    {"TRAANG", Procedure::transformation},
    {"TRAORI", Procedure::transformation},
    {"TRACON", Procedure::transformation},
    {"TRAFOOF", Procedure::transformation},
    {"PRESETON", Procedure::preset},
    {"SPLINEPATH", Procedure::spline_axes},
    {"POLYPATH", Procedure::polynomial_path},
    {"EXECUTE", Procedure::unsupported},
    {"EXECTAB", Procedure::unsupported},
    {"CALCDAT", Procedure::unsupported},
    {"INTERSEC", Procedure::unsupported},
    {"EXECSTRING", Procedure::unsupported},
    {"CALLPATH", Procedure::timing},
    {"NEWCONF", Procedure::timing},
    {"GET", Procedure::timing},
    {"GETD", Procedure::timing},
    {"RELEASE", Procedure::timing},
    {"AXTOCHAN", Procedure::timing},
    {"INIT", Procedure::coordination},
    {"START", Procedure::coordination},
    {"WAITM", Procedure::coordination},
    {"WAITMC", Procedure::coordination},
    {"WAITE", Procedure::coordination},
    {"SETM", Procedure::timing},
    {"CLEARM", Procedure::timing},
    {"SETINT", Procedure::coordination},
    {"DISABLE", Procedure::timing},
    {"ENABLE", Procedure::timing},
    {"CLRINT", Procedure::timing},
    {"ORIRESET", Procedure::coordination},
};

constexpr std::string_view keywords[] = {
    "IF",     "ELSE",    "ENDIF",   "LOOP",     "ENDLOOP", "FOR",      "TO",      "ENDFOR",    "WHILE",   "ENDWHILE",
    "REPEAT", "REPEATB", "UNTIL",   "ENDLABEL", "CASE",    "OF",       "DEFAULT", "GOTO",      "GOTOB",   "GOTOF",
    "GOTOC",  "GOTOS",   "DEF",     "REDEF",    "DEFINE",  "AS",       "EXTERN",  "PROC",      "CALL",    "PCALL",
    "MCALL",  "EXTCALL", "ISOCALL", "BLOCK",    "WHEN",    "WHENEVER", "FROM",    "EVERY",     "DO",      "ID",
    "IDS",    "VAR",     "INT",     "REAL",     "BOOL",    "CHAR",     "STRING",  "AXIS",      "FRAME",   "NCK",
    "CHAN",   "TRUE",    "FALSE",   "SET",      "REP",     "SAVE",     "PREPRO",  "ACTBLOCNO", "NO_AXIS", "SYNR",
    "SYNW",   "SYNRW",   "INIPO",   "INIRE",    "INICF",   "PRLOC",    "PHU",     "LLI",       "ULI",     "APR",
    "APW",    "APX",     "APRP",    "APRB",     "APWP",    "APWB",     "POS",     "POSA",      "POSP",    "FA",
    "FL",     "FPO",     "AX",      "IP",       "PO",      "MEASA",    "MEAWA"};

/// Functions, procedures and addresses that the control has and that are not carried yet, in alphabetical order: a name
/// of these is never a variable.
constexpr std::string_view predefined[] = {
    "ADDFRAME", "BLSYNC",     "CALCPOSI",   "CHECKSUM",  "CHKDM",    "CHKDNO",    "CTABFNO",   "CTABFPOL", "CTABFSEG",
    "CTABID",   "CTABISLOCK", "CTABMEMTYP", "CTABMPOL",  "CTABMSEG", "CTABNO",    "CTABNOMEM", "CTABPOL",  "CTABPOLID",
    "CTABSEG",  "CTABSEGID",  "DELDTG",     "DIACYCOFA", "DIAMCHAN", "DIAMCHANA", "FOCOF",     "FOCON",    "FTOC",
    "GETACTT",  "GETACTTD",   "GETTCOR",    "GETTENV",   "ICYCOF",   "ICYCON",    "LENTOAX",   "MEASURE",  "MOV",
    "OMA1",     "OMA2",       "OMA3",       "OMA4",      "OMA5",     "POSRANGE",  "RDISABLE",  "SETTCOR",  "SIRELAY",
    "SIRELIN",  "SIRELOUT",   "SIRELTIME",  "SYNFCT",    "TOOLENV",  "WALCS"};

/// Functions of axes and frames, in alphabetical order: frontends/sinumerik/values/system_data.cpp and lower_frames.cpp
/// carry them.
constexpr std::string_view carried_functions[] = {
    "AXNAME",  "AXSTRING", "AXTOSPI",  "CALCDAT", "CFINE",      "CMIRROR",  "CROT",
    "CROTS",   "CRPL",     "CSCALE",   "CTAB",    "CTABEXISTS", "CTABINV",  "CTABPERIOD",
    "CTABSEV", "CTABSSV",  "CTABTEP",  "CTABTEV", "CTABTMAX",   "CTABTMIN", "CTABTSP",
    "CTABTSV", "CTRANS",   "INVFRAME", "ISAXIS",  "MEAFRAME",   "MODAXVAL", "SPI"};

}  // namespace

std::span<const NamedWordRow> named_words() {
  return words;
}

const NamedWordRow* named_word(std::string_view name) {
  for (const auto& r : words) {
    if (iequals_ascii(name, r.name)) return &r;
  }
  return nullptr;
}

bool is_timing_of_axis(std::string_view capitals) {
  constexpr std::string_view names[] = {"ACC",      "ACCLIMA", "OVRA", "VELOLIM", "VELOLIMA", "JERKLIM",
                                        "JERKLIMA", "SCPARA",  "ATOL", "FGREF",   "ADISPOSA"};
  for (const auto& n : names) {
    if (n == capitals) return true;
  }
  return false;
}

Attribute attribute(std::string_view name) {
  struct Row {
    std::string_view name;
    Attribute attribute;
  };
  constexpr Row rows[] = {{"AC", Attribute::ac},
                          {"IC", Attribute::ic},
                          {"DC", Attribute::dc},
                          {"ACP", Attribute::acp},
                          {"ACN", Attribute::acn},
                          {"DAC", Attribute::dac},
                          {"DIC", Attribute::dic},
                          {"RAC", Attribute::rac},
                          {"RIC", Attribute::ric},
                          {"CAC", Attribute::unsupported},
                          {"CIC", Attribute::unsupported},
                          {"CDC", Attribute::unsupported},
                          {"CACP", Attribute::unsupported},
                          {"CACN", Attribute::unsupported},
                          {"GP", Attribute::unsupported},
                          {"QU", Attribute::unsupported},
                          {"PO", Attribute::unsupported}};
  for (const auto& r : rows) {
    if (r.name == name) return r.attribute;
  }
  return Attribute::none;
}

Attribute attribute(double number) {
  using enum Attribute;
  constexpr std::array by_number{none, ac, ic, dc, acp, acn, unsupported, unsupported, dac, dic, rac, ric};
  for (std::size_t i = 0; i < by_number.size(); ++i) {
    if (static_cast<double>(i) == number) return by_number[i];
  }
  return unsupported;
}

std::span<const ProcedureRow> procedures() {
  return procedure_rows;
}

Procedure procedure(std::string_view capitals) {
  for (const auto& r : procedure_rows) {
    if (r.name == capitals) return r.use;
  }
  return Procedure::none;
}

std::string_view procedure_missing_feature(std::string_view capitals) {
  struct Row {
    std::string_view name, feature;
  };
  constexpr Row rows[] = {{"ADDFRAME", "frame.measured"}, {"CHKDM", "machine.tools"},
                          {"CHKDNO", "machine.tools"},    {"EXECSTRING", "language.computed_block"},
                          {"EXECTAB", "contour.table"},   {"EXECUTE", "contour.table"},
                          {"GETACTT", "machine.tools"},   {"GETACTTD", "machine.tools"},
                          {"GETTCOR", "machine.tools"},   {"GETTENV", "machine.tools"},
                          {"INTERSEC", "contour.table"},  {"LENTOAX", "machine.tools"},
                          {"OMA1", "machine.makers_own"}, {"OMA2", "machine.makers_own"},
                          {"OMA3", "machine.makers_own"}, {"OMA4", "machine.makers_own"},
                          {"OMA5", "machine.makers_own"}, {"SETTCOR", "machine.tools"},
                          {"TOOLENV", "machine.tools"}};
  for (const auto& r : rows) {
    if (r.name == capitals) return r.feature;
  }
  const bool transformation = capitals.rfind("TRA", 0) == 0 && capitals.rfind("TRAIL", 0) != 0;
  return transformation ? "motion.transformation" : "language.statement";
}

bool is_predefined(std::string_view capitals) {
  return std::binary_search(std::begin(predefined), std::end(predefined), capitals);
}

std::span<const std::string_view> predefined_names() {
  return predefined;
}
std::span<const std::string_view> axis_and_frame_functions() {
  return carried_functions;
}

bool is_reserved(std::string_view capitals) {
  if (is_predefined(capitals) || asked_function(capitals) != nullptr || beside(capitals) != nullptr ||
      definition(capitals) != nullptr)
    return true;
  if (std::binary_search(std::begin(carried_functions), std::end(carried_functions), capitals)) return true;
  for (const auto& k : keywords) {
    if (k == capitals) return true;
  }
  return g_function(capitals) != nullptr || named_word(capitals) != nullptr || procedure(capitals) != Procedure::none ||
         attribute(capitals) != Attribute::none || expression_function(capitals) != nullptr ||
         is_word_operator(capitals) || cycle(capitals) != nullptr;
}

}  // namespace cnctrans::sinumerik
