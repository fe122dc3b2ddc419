// A program as a row of items: statements in the order of the text, with what only the ways through the program can
// complete beside them.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "dialects/heidenhain/cycles.h"
#include "dialects/heidenhain/leads.h"
#include "dialects/heidenhain/old_cycles.h"
#include "dialects/heidenhain/patterns.h"
#include "ir/cycles/milling/mill_contour.h"
#include "ir/program.h"

namespace cnctrans::frontends::heidenhain {

enum class ItemKind : std::uint8_t {
  plain,    ///< the statement as it is
  label,    ///< LBL n
  sub_end,  ///< LBL 0
  call,     ///< CALL LBL n
  repeat,   ///< CALL LBL n REP k
  jump,     ///< FN 9 to FN 12
  program,  ///< CALL PGM
  end,      ///< M2, M30, END PGM
  cycle,    ///< CYCL DEF of a cycle that is called; no statement
  pole      ///< CC
};
/// What a block does with the machining cycle behind its motion.
enum class CycleCall : std::uint8_t {
  none,
  once,   ///< M99, CYCL CALL
  modal,  ///< M89: also behind every later positioning block
  ends    ///< M99: the last one of M89, too
};

/// The value of a cycle parameter.
struct QValue {
  enum class Kind : std::uint8_t { value, rapid, tool_feed, per_rev, per_tooth, linked } kind = Kind::value;
  ir::Value value;
  Span where;
  bool of_tool_feed = false;  ///< FAUTO: the value is F of the TOOL CALL above
  double of_speed = 0;        ///< FU: the value is this times its S
};
/// What a TOOL CALL leaves behind it.
struct ToolState {
  std::optional<ir::Value> feed, speed;
  std::optional<double> radius;  ///< as TOOL DEF says it, in the unit of the program
  bool oversize = false;         ///< TOOL CALL has DR
};
/// A numbered part of an old cycle: what stands behind `1.3`.
struct OldPartValue {
  struct Letter {
    std::string address;  ///< capitals; empty: a number alone
    ir::Value value;
    bool has_value = false;
    bool negative = false;  ///< a minus without a number: DR-
  };
  std::vector<Letter> letters;
  std::string text;  ///< all of it
};
struct CycleDefinition {
  Span where;
  const dialects::heidenhain::CycleRow* row = nullptr;  ///< of Q parameters
  const dialects::heidenhain::OldCycle* old = nullptr;  ///< of numbered parts
  std::int64_t number = 0;
  std::map<std::int16_t, QValue> values;
  std::map<int, OldPartValue> parts;
  std::vector<std::string> labels;  ///< cycle 14, of a cycle that works on contours
  /// A pocket, and its islands behind it; mm.
  std::vector<std::vector<ir::cycles::MillContour>> areas;
  std::string area_fault;
  bool refused = false;                                        ///< said at the definition; its calls say nothing more
  int side = 0;                                                ///< of a contour that is followed: RL 1, RR -1
  ir::AxisId around = ir::axis::none, along = ir::axis::none;  ///< the axes of a developed contour: rotary and linear
};

struct Pole {
  std::vector<ir::FrameWord> words;  ///< in the plane
  std::vector<bool> incremental;     ///< of each word: from the tool
  std::optional<ir::Plane> other;    ///< it lies in a plane along the tool axis
};

/// APPR and DEP: the way onto a contour and off it (reference 6).
struct Lead {
  dialects::heidenhain::LeadForm form = dialects::heidenhain::LeadForm::tangent_line;
  bool departure = false;
  bool rapid = false;
  ir::Value size;   ///< LEN or R
  ir::Value angle;  ///< CCA
  int side = 0;     ///< APPR: RL 1, RR -1, R0 0
  Span where;
};

/// FL, FLT, FC, FCT (reference 7.1).
struct FreeElement {
  bool arc = false, tangent = false, rapid = false;
  bool begins = false, closes = false;  ///< CLSD+, CLSD-
  int sense = 0;                        ///< DR: 1, -1
  std::map<std::string, double> words;
  std::optional<std::pair<double, double>> pole;  ///< FPOL
  Span where;
};

/// A figure of PATTERN DEF: `POS1 (X+25 Y+33.5 Z+0)`.
struct Figure {
  dialects::heidenhain::FigureKind kind = dialects::heidenhain::FigureKind::point;
  std::map<std::string, ir::Value> words;  ///< by address
};
struct Pattern {
  Span where;
  std::vector<Figure> figures;
};

/// What holds along the text and decides how a line is read: the tilted plane, the contours (14) and data (20, 270) of
/// the SL cycles, FU, and M126.
enum class AlongText : std::uint8_t { tilt, contours, data, train, per_rev, shortest };
inline constexpr std::size_t along_text = 6;
using Along = std::array<std::int16_t, along_text>;

struct Item {
  ItemKind kind = ItemKind::plain;
  ir::Statement statement;
  std::string label;       ///< label, call, repeat, jump: number without leading zeros, or the name in capitals
  bool number = false;     ///< `label` is a number
  std::string label_text;  ///< QS5: the text that names the label
  std::string text_found;  ///< ... and what it is; a copy of that label may have another name
  int index = -1;          ///< cycle: of the definition; pole: of the pole
  bool moves = false;      ///< a positioning block
  bool by_pole = false;    ///< the centre of its arc is CC
  bool polar = false;      ///< its words are polar
  int other_pole = -1;     ///< of the CC in another plane about which its end was counted
  std::optional<double> tool_radius;  ///< of a cycle call: what TOOL DEF says, in the unit of the program
  bool contour = false;               ///< stands in a label of cycle 14
  int free = -1;                      ///< of the element of a free contour, before it is solved
  int lead = -1;                      ///< of the APPR or DEP, before it is written out
  bool leads_on = false;              ///< a move of an APPR that does not end on the contour
  int pattern = -1;                   ///< PATTERN DEF, or (Arrival::several) a table of points
  bool at_pattern = false;            ///< CYCL CALL PAT
  int selects = -1;                   ///< SEL PGM: index of the name
  bool calls_selected = false;        ///< CALL SELECTED PGM
  std::optional<std::pair<ir::Value, ir::Value>> place;  ///< CYCL CALL: of the tool in the plane, where it is known
  std::optional<ir::Value> height;                       ///< of a cycle call: of the tool, where it is known
  CycleCall call = CycleCall::none;
  std::optional<ir::Value> shift;         ///< CYCL CALL POS: along the tool axis
  int plunge = -1;                        ///< M103: index of the share that holds from here on
  std::vector<ir::VarRef> writes;         ///< variables
  int tool = -1;                          ///< TOOL CALL: index of what it leaves
  bool defines_none = false;              ///< CALL PGM: the program is known to define no cycle
  int held = -1;                          ///< of a call: index of what holds at it (Lowering)
  Along before{};                         ///< by AlongText: the state with which it was read
  Along sets{-1, -1, -1, -1, -1, -1};     ///< the state from here on; -1: as before
  std::array<bool, along_text> relies{};  ///< `before` has decided what the item is
  bool tool_feed = false;                 ///< F AUTO: its F is that of the TOOL CALL above
};

struct Flat {
  std::vector<Item> items;
  std::vector<CycleDefinition> cycles;
  std::vector<Pole> poles;
  std::vector<Lead> leads;
  std::vector<FreeElement> elements;
  std::vector<Pattern> patterns;
  std::vector<ToolState> tools;                   ///< each once
  std::vector<std::optional<ir::Value>> plunges;  ///< percent of F for what goes into the material; none: all of it
  std::vector<std::string> programs;              ///< names in SEL PGM, each once
};

/// What the ways of the program bring to an item.
struct Arrival {
  static constexpr int none = -1, several = -2;
  bool reached = false;
  int cycle = none;                    ///< index of the definition in force
  int pole = none;                     ///< of the CC in force
  bool moved = false;                  ///< since that CC
  bool written = false;                ///< a variable of that CC, since then
  int from = none;                     ///< the item that says where the tool stands seen from that CC
  bool changed = false;                ///< a variable, since that item
  int modal = 0;                       ///< M89: 0 off, 1 on, several
  int plane = 0;                       ///< ir::Plane, or several
  int pattern = none;                  ///< index of the PATTERN DEF in force
  int overlay = none;                  ///< index of the 220 or 221 that ran since the definition
  int tool = none;                     ///< index of what the last TOOL CALL has left
  int plunge = none;                   ///< index of the share of M103
  std::array<int, along_text> text{};  ///< by AlongText; 0 at the start
  int selected = none;                 ///< index of the name of SEL PGM
  bool selected_outside = false;       ///< a program of another file ran since
  bool outside = false;                ///< a program of another file ran since the definition
  bool rewritten = false;              ///< a parameter of the cycle was assigned since its definition
  /// Of the parameters QS that were assigned; nullopt: not known, or not the same on all ways.
  std::map<std::string, std::optional<std::string>> texts;
  bool operator==(const Arrival&) const = default;
};

}  // namespace cnctrans::frontends::heidenhain
