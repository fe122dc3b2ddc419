#include "dialects/sinumerik/beside.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <string>

#include "dialects/sinumerik/capitals.h"

namespace cnctrans::sinumerik {

namespace {

constexpr auto procedure = static_cast<std::uint8_t>(BesideForm::procedure);
constexpr auto address = static_cast<std::uint8_t>(BesideForm::address);
constexpr auto indexed = static_cast<std::uint8_t>(BesideForm::indexed);
constexpr auto code = static_cast<std::uint8_t>(BesideForm::code);

constexpr BesideRow words_beside[] = {
    {"ALF", "beside.realtime", address, false, true},
    {"AXCTSWE", "beside.data", procedure},
    {"AXCTSWED", "beside.data", procedure},
    {"CANCEL", "beside.realtime", procedure, false, true},
    {"CHANDATA", "beside.data", procedure, false, true},
    {"CORROF", "beside.compensation", procedure, false, true},
    {"COUPDEF", "beside.coupling", procedure, false, true},
    {"COUPDEL", "beside.coupling", procedure, false, true},
    {"COUPOF", "beside.coupling", procedure, false, true},
    {"COUPOFS", "beside.coupling", procedure, false, true},
    {"COUPON", "beside.coupling", procedure},
    {"COUPONC", "beside.coupling", procedure},
    {"COUPRES", "beside.coupling", procedure, false, true},
    {"CPROT", "beside.data", procedure},
    {"CTABDEL", "beside.coupling", procedure, false, true},
    {"CTABLOCK", "beside.coupling", procedure, false, true},
    {"CTABUNLOCK", "beside.coupling", procedure, false, true},
    {"CUT3DC", "beside.compensation", code},
    {"CUT3DCC", "beside.compensation", code},
    {"CUT3DCCD", "beside.compensation", code},
    {"CUT3DF", "beside.compensation", code},
    {"CUT3DFF", "beside.compensation", code},
    {"CUT3DFS", "beside.compensation", code},
    {"CUTMOD", "beside.compensation", address, false, true},
    {"DELDL", "beside.compensation", procedure | code, false, true},
    {"DELETE", "beside.data", procedure, true, true},
    {"DELT", "beside.tool_management", procedure, true},
    {"DELTOOLENV", "beside.tool_management", procedure, true},
    {"DILF", "beside.realtime", address, false, true},
    {"DL", "beside.compensation", address},
    {"DRFOF", "beside.compensation", procedure, false, true},
    {"DZERO", "beside.tool_management", procedure, true},
    {"EGDEF", "beside.coupling", procedure, false, true},
    {"EGDEL", "beside.coupling", procedure, false, true},
    {"EGOFC", "beside.coupling", procedure, false, true},
    {"EGOFS", "beside.coupling", procedure, false, true},
    {"EGON", "beside.coupling", procedure},
    {"EGONSYN", "beside.coupling", procedure},
    {"EGONSYNE", "beside.coupling", procedure},
    {"FCTDEF", "beside.realtime", procedure},
    {"FD", "beside.realtime", address},
    {"FDA", "beside.realtime", indexed},
    {"FILEDATE", "beside.data", procedure, true, true},
    {"FILEINFO", "beside.data", procedure, true, true},
    {"FILESIZE", "beside.data", procedure, true, true},
    {"FILESTAT", "beside.data", procedure, true, true},
    {"FILETIME", "beside.data", procedure, true, true},
    {"FMA", "beside.realtime", indexed},
    {"FPR", "beside.data", procedure},
    {"FPRAOF", "beside.data", procedure, false, true},
    {"FPRAON", "beside.data", procedure},
    {"FTOCON", "beside.compensation", code},
    {"FXS", "beside.realtime", indexed},
    {"FXST", "beside.realtime", indexed},
    {"FXSW", "beside.realtime", indexed},
    {"GETEXET", "beside.tool_management", procedure, true, true},
    {"GETFREELOC", "beside.tool_management", procedure, true, true},
    {"GETSELT", "beside.tool_management", procedure, true, true},
    {"GETT", "beside.tool_management", procedure, true, true},
    {"GWPSOF", "beside.data", procedure, false, true},
    {"GWPSON", "beside.data", procedure},
    {"ISD", "beside.compensation", address, false, true},
    {"LEADOF", "beside.coupling", procedure, false, true},
    {"LEADON", "beside.coupling", procedure},
    {"LIFTFAST", "beside.realtime", procedure},
    {"LOCK", "beside.realtime", procedure, false, true},
    {"MASLDEF", "beside.coupling", procedure, false, true},
    {"MASLDEL", "beside.coupling", procedure, false, true},
    {"MASLOF", "beside.coupling", procedure, false, true},
    {"MASLOFS", "beside.coupling", procedure, false, true},
    {"MASLON", "beside.coupling", procedure},
    {"MEAC", "beside.realtime", indexed},
    {"MVTOOL", "beside.tool_management", procedure, true},
    {"NEWT", "beside.tool_management", procedure, true},
    {"NPROT", "beside.data", procedure},
    {"OFFN", "beside.compensation", address},
    {"OS", "beside.realtime", indexed},
    {"OSB", "beside.realtime", indexed},
    {"OSCILL", "beside.realtime", indexed},
    {"OSCTRL", "beside.realtime", indexed},
    {"OSE", "beside.realtime", indexed},
    {"OSNSC", "beside.realtime", indexed},
    {"OSP1", "beside.realtime", indexed},
    {"OSP2", "beside.realtime", indexed},
    {"OST1", "beside.realtime", indexed},
    {"OST2", "beside.realtime", indexed},
    {"POLF", "beside.realtime", procedure | indexed, false, true},
    {"POLFA", "beside.realtime", procedure | indexed, false, true},
    {"POLFMASK", "beside.realtime", procedure, false, true},
    {"POLFMLIN", "beside.realtime", procedure, false, true},
    {"PON", "beside.realtime", code},
    {"PONS", "beside.realtime", code},
    {"POSM", "beside.tool_management", procedure, true},
    {"PUNCHACC", "beside.realtime", procedure},
    {"PUTFTOC", "beside.compensation", procedure},
    {"PUTFTOCF", "beside.compensation", procedure},
    {"QECLRNOF", "beside.compensation", procedure, false, true},
    {"QECLRNON", "beside.compensation", procedure},
    {"READ", "beside.data", procedure, true, true},
    {"RESET", "beside.realtime", procedure, false, true},
    {"RESETMON", "beside.tool_management", procedure, true, true},
    {"SETDNO", "beside.tool_management", procedure, true},
    {"SETMTH", "beside.tool_management", procedure, true},
    {"SETPIECE", "beside.tool_management", procedure, true, true},
    {"SETTA", "beside.tool_management", procedure, true},
    {"SETTIA", "beside.tool_management", procedure, true},
    {"SON", "beside.realtime", code},
    {"SONS", "beside.realtime", code},
    {"SPN", "beside.realtime", address},
    {"SPP", "beside.realtime", address},
    {"SR", "beside.realtime", address},
    {"SRA", "beside.realtime", indexed},
    {"ST", "beside.realtime", address},
    {"STA", "beside.realtime", indexed},
    {"STOPREOF", "beside.realtime", procedure, false, true},
    {"TANG", "beside.coupling", procedure, false, true},
    {"TANGDEL", "beside.coupling", procedure, false, true},
    {"TANGOF", "beside.coupling", procedure, false, true},
    {"TANGON", "beside.coupling", procedure},
    {"TCA", "beside.tool_management", procedure, true},
    {"TCARR", "beside.data", address},
    {"TCI", "beside.tool_management", procedure, true},
    {"TCOFR", "beside.data", code, false, true},
    {"TCOFRX", "beside.data", code, false, true},
    {"TCOFRY", "beside.data", code, false, true},
    {"TCOFRZ", "beside.data", code, false, true},
    {"TFGREF", "beside.data", indexed},
    {"TLIFT", "beside.coupling", procedure, false, true},
    {"TMOF", "beside.tool_management", procedure, true, true},
    {"TMON", "beside.tool_management", procedure, true, true},
    {"TOFF", "beside.compensation", indexed | address},
    {"TOFFL", "beside.compensation", indexed | address},
    {"TOFFOF", "beside.compensation", procedure, false, true},
    {"TOFFON", "beside.compensation", procedure},
    {"TOFFR", "beside.compensation", indexed | address},
    {"TRAILOF", "beside.coupling", procedure, false, true},
    {"TRAILON", "beside.coupling", procedure},
    {"UNLOCK", "beside.realtime", procedure, false, true},
    {"WAITC", "beside.coupling", procedure, false, true},
    {"WAITENC", "beside.data", procedure},
    {"WRITE", "beside.data", procedure, true, true},
};

constexpr Definition all_definitions[] = {{"CPROTDEF", "EXECUTE", "beside.data"},
                                          {"CONTDCON", "EXECUTE", "beside.data", true},
                                          {"CONTPRON", "EXECUTE", "beside.data", true},
                                          {"CTABDEF", "CTABEND", "beside.coupling"},
                                          {"NPROTDEF", "EXECUTE", "beside.data"}};

constexpr std::string_view machine_errors = "beside.machine_errors";

constexpr std::string_view machine_tuning = "beside.machine_tuning";

struct DatumRow {
  std::string_view name;  ///< the name, or its beginning when it ends in `*`
  std::string_view feature;
};
/// Setting data and machine data that the reference does not name count like the others, unless their name tells that
/// they are about axes, codes or coordinates.
constexpr DatumRow data[] = {
    {"$AN_CEC*", machine_errors},
    {"$AA_ENC_COMP*", machine_errors},
    {"$AA_QEC*", machine_errors},
    {"$SN_CEC_TABLE*", machine_errors},
    {"$SA_TEMP_COMP*", machine_errors},
    {"$MA_BACKLASH*", machine_errors},
    {"$MA_CEC*", machine_errors},
    {"$MA_ENC_COMP*", machine_errors},
    {"$MA_FRICT*", machine_errors},
    {"$MA_TEMP_COMP*", machine_errors},
    {"$MA_COMPRESS_*", machine_tuning},
    {"$MC_COMPRESS_*", machine_tuning},
    {"$MN_IMD_*", machine_tuning},
    {"$MC_IMD_*", machine_tuning},
    {"$MA_IMD_*", machine_tuning},
    {"$MA_FFW_*", machine_tuning},
    {"$MA_MAX_AX_ACCEL*", machine_tuning},
    {"$MA_MAX_AX_JERK*", machine_tuning},
    {"$MA_POSCTRL_*", machine_tuning},
    {"$MA_VELO_FFW_*", machine_tuning},
    {"$SC_*", "beside.data"},
    {"$SN_*", "beside.data"},
    {"$SA_*", "beside.data"},
    {"$MC_*", "beside.data"},
    {"$MN_*", "beside.data"},
    {"$MA_*", "beside.data"},
    {"$MD_*", "beside.data"},
    {"$SNS_MEA_*", "beside.data"},
    {"$SCS_MEA_*", "beside.data"},
    {"$MNS_MEA_*", "beside.data"},
    {"$A_OUT", "beside.realtime"},
    {"$A_OUTA", "beside.realtime"},
    {"$A_DB*", "beside.realtime"},
    {"$A_DLB", "beside.realtime"},
    {"$A_DLW", "beside.realtime"},
    {"$A_DLD", "beside.realtime"},
    {"$A_DLR", "beside.realtime"},
    {"$AC_TIMER", "beside.realtime"},
    {"$AC_FIFO*", "beside.realtime"},
    {"$AC_OVR", "beside.realtime"},
    {"$AA_OVR", "beside.realtime"},
    {"$AC_VC", "beside.realtime"},
    {"$AA_VC", "beside.realtime"},
    {"$AC_PROG_NET_TIME_TRIGGER", "beside.realtime"},
    {"$AA_OFF", "beside.compensation"},
    {"$AA_TOFF", "beside.compensation"},
    {"$AA_LEAD_S*", "beside.coupling"},
};
/// Setting data that decide what a programmed word means.
constexpr std::string_view of_the_path[] = {
    "$SC_DEFAULT_FEED",     "$SC_DEFAULT_SCALE_FACTOR_AXIS", "$SC_DEFAULT_SCALE_FACTOR_P",
    "$SC_FEEDRATE_SCALING", "$SC_FRAME_OFFSET_INCR_PROG",    "$SC_THREAD_START_ANGLE",
    "$SC_TOFRAME_MODE",     "$SC_TOOL_OFFSET_INCR_PROG",     "$SA_SCALE_FACTOR",
};

/// Parts of the names of machine data that decide what a programmed word means or where the machine is.
constexpr std::string_view machine_data_of_the_path[] = {
    "AXCONF",  "BASE_FUNCTION", "CUTTING_EDGE", "DIAMETER", "EXTERN", "FIX_POINT", "FRAME",   "GCODE",
    "GEOAX",   "INDEX_AX",      "INT_INCR",     "IS_ROT",   "MIRROR", "MODULO",    "REFP_",   "RESET_MODE",
    "SCALING", "SPIND_ASSIGN",  "TOOL_CHANGE",  "TRAANG",   "TRACYL", "TRAFO",     "TRANSMIT"};

/// As std::string_view::compare, `name` in any case.
int compare(std::string_view capitals, std::string_view name) {
  const std::size_t n = std::min(capitals.size(), name.size());
  for (std::size_t i = 0; i < n; ++i) {
    const char c = capital(name[i]);
    if (capitals[i] != c) return capitals[i] < c ? -1 : 1;
  }
  return capitals.size() == name.size() ? 0 : capitals.size() < name.size() ? -1 : 1;
}

bool of_name(char c) {
  return (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '$';
}

}  // namespace

std::span<const BesideRow> beside_rows() {
  return words_beside;
}

const BesideRow* beside(std::string_view name) {
  const auto* at = std::lower_bound(std::begin(words_beside), std::end(words_beside), name,
                                    [](const BesideRow& r, std::string_view n) { return compare(r.name, n) < 0; });
  return at == std::end(words_beside) || compare(at->name, name) != 0 ? nullptr : at;
}

const BesideRow* beside(std::string_view name, BesideForm form) {
  const auto* row = beside(name);
  return row != nullptr && (row->forms & static_cast<std::uint8_t>(form)) != 0 ? row : nullptr;
}

std::string_view beside_datum(std::string_view capitals) {
  if (capitals.starts_with("$$")) capitals.remove_prefix(1);  // the same datum, read or set in the main run
  if (std::find(std::begin(of_the_path), std::end(of_the_path), capitals) != std::end(of_the_path)) return {};
  if (capitals.starts_with("$M")) {
    for (const auto& part : machine_data_of_the_path) {
      if (capitals.find(part) != std::string_view::npos) return {};
    }
  }
  for (const auto& row : data) {
    const bool beginning = row.name.back() == '*';
    if (beginning ? capitals.starts_with(row.name.substr(0, row.name.size() - 1)) : capitals == row.name)
      return row.feature;
  }
  return {};
}

bool is_setting(std::string_view capitals) {
  if (capitals.starts_with("$$")) capitals.remove_prefix(1);
  constexpr std::string_view kinds[] = {"$MN_", "$MC_", "$MA_", "$SN_", "$SC_", "$SA_"};
  return std::any_of(std::begin(kinds), std::end(kinds), [&](auto k) { return capitals.starts_with(k); });
}

std::span<const Definition> definitions() {
  return all_definitions;
}

const Definition* definition(std::string_view begin) {
  for (const auto& d : all_definitions) {
    if (d.begin == begin) return &d;
  }
  return nullptr;
}

// --- synchronised actions ---------------------------------------------------------------------------------------

namespace {

/// The words of the action behind DO, one by one: name, index, and whether a value follows.
class ActionText {
 public:
  explicit ActionText(std::string_view text) {
    for (const char c : text) text_ += capital(c);
    std::size_t at = 0;
    while ((at = text_.find("DO", at)) != std::string::npos) {
      const bool begins = at == 0 || !of_name(text_[at - 1]);
      at += 2;
      if (begins && (at == text_.size() || !of_name(text_[at]))) break;
    }
    at_ = std::min(at, text_.size());
  }
  std::string_view name, index;
  bool set = false;   ///< NAME=, NAME[..]=
  bool call = false;  ///< NAME(..)
  bool next() {
    while (at_ < text_.size() && !of_name(text_[at_])) ++at_;
    if (at_ == text_.size()) return false;
    const std::size_t from = at_;
    while (at_ < text_.size() && of_name(text_[at_])) ++at_;
    name = std::string_view(text_).substr(from, at_ - from);
    index = {};
    skip_blanks();
    if (peek() == '[') index = in_brackets('[', ']');
    skip_blanks();
    set = peek() == '=' && (at_ + 1 == text_.size() || text_[at_ + 1] != '=');
    call = peek() == '(';
    if (call) in_brackets('(', ')');
    if (set) value();
    return true;
  }

 private:
  [[nodiscard]] char peek() const { return at_ < text_.size() ? text_[at_] : '\0'; }
  void skip_blanks() {
    while (peek() == ' ' || peek() == '\t') ++at_;
  }
  std::string_view in_brackets(char open, char close) {
    const std::size_t from = at_ + 1;
    int depth = 0;
    for (; at_ < text_.size(); ++at_) {
      if (text_[at_] == '"') at_ = std::min(text_.find('"', at_ + 1), text_.size() - 1);
      if (text_[at_] == open) ++depth;
      if (text_[at_] == close && --depth == 0) break;
    }
    const std::size_t to = at_;
    if (at_ < text_.size()) ++at_;
    return std::string_view(text_).substr(from, to - std::min(from, to));
  }
  /// An expression ends at the blank behind it: `DO $A_OUT[1]=1 M7`.
  void value() {
    ++at_;
    bool open = true;  // an operand is due
    while (at_ < text_.size()) {
      skip_blanks();
      const char c = peek();
      if (c == '(' || c == '[') {
        if (!open && c == '(' && text_[at_ - 1] == ' ') return;
        in_brackets(c, c == '(' ? ')' : ']');
        open = false;
      } else if (of_name(c) || c == '.' || c == '"' || c == '\'') {
        if (!open) return;
        const std::size_t from = at_;
        while (at_ < text_.size() &&
               (of_name(text_[at_]) || text_[at_] == '.' || text_[at_] == '"' || text_[at_] == '\''))
          ++at_;
        const std::string_view word = std::string_view(text_).substr(from, at_ - from);
        open = word == "NOT" || word == "B_NOT";
        skip_blanks();
        for (const std::string_view op : {"DIV", "MOD", "AND", "OR", "XOR", "B_AND", "B_OR", "B_XOR"}) {
          const std::size_t end = at_ + op.size();
          if (text_.compare(at_, op.size(), op) != 0 || (end < text_.size() && of_name(text_[end]))) continue;
          at_ = end;
          open = true;
        }
      } else if (c == '\0') {
        return;
      } else {
        ++at_;
        open = true;
      }
    }
  }

  std::string text_;
  std::size_t at_ = 0;
};

constexpr std::string_view procedures_of_actions[] = {"CANCEL",  "DELDTG",   "FTOC",   "LEADOF", "LEADON", "LOCK",
                                                      "MOV",     "RDISABLE", "RESET",  "SETAL",  "SYNFCT", "STOPREOF",
                                                      "TRAILOF", "TRAILON",  "UNLOCK", "FXS"};
constexpr std::string_view words_of_actions[] = {"M",    "H",    "S",     "FA",   "FXS", "FXST",
                                                 "FXSW", "SPOS", "SPOSA", "OVRA", "ACC"};
constexpr std::string_view moves_of_actions[] = {"MOV", "POS", "POSA", "MEASA", "MEAWA", "MEAC"};

template <std::size_t n>
bool in(const std::string_view (&list)[n], std::string_view name) {
  return std::find(std::begin(list), std::end(list), name) != std::end(list);
}

}  // namespace

std::string_view beside_action(std::string_view text, const std::function<bool(std::string_view)>& is_machine_axis) {
  ActionText action(text);
  bool any = false;
  while (action.next()) {
    any = true;
    const std::string_view name = action.name;
    if (action.set && name[0] == '$') {
      if (beside_datum(name).empty()) return {};
      continue;
    }
    if (in(moves_of_actions, name)) {
      const bool measures = name.starts_with("MEA");
      if (!measures && is_machine_axis(action.index)) return {};
      continue;
    }
    if (in(procedures_of_actions, name)) continue;
    const std::size_t letters = name.find_first_of("0123456789");
    const std::string_view word = name.substr(0, letters);
    if (in(words_of_actions, word)) continue;
    if (name == "G70" || name == "G71" || name == "G700" || name == "G710") continue;
    return {};
  }
  return any ? "beside.realtime" : std::string_view{};
}

}  // namespace cnctrans::sinumerik
