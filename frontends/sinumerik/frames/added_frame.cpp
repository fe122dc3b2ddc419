// ADDFRAME: a frame is put behind the whole chain of frames by changing one of them (motion reference 8; function
// manual K2, "additive frame"). T stands for the frame named, I for what lies inside of it: T:I becomes T:I:F, so T
// becomes T:I:F:inverse(I).
#include <algorithm>
#include <utility>

#include "base/saturate.h"
#include "base/text.h"
#include "dialects/sinumerik/frames.h"
#include "frontends/sinumerik/state/statements.h"
#include "frontends/sinumerik/statements/row_parts.h"

namespace cnctrans::sinumerik {

using syntax::Expr;
using syntax::ExprKind;

namespace {

constexpr int done = 0, no_such_frame = 1, not_configured = 2;

/// What the text of the second argument names.
struct Target {
  std::string_view active;  ///< the frame in force that counts
  bool stored = false;      ///< what is written waits for its selection
  bool indexed = false;
};
struct TargetRow {
  std::string_view name;
  Target target;
};
constexpr TargetRow targets[] = {{"$P_PFRAME", {"$P_PFRAME"}},
                                 {"$P_IFRAME", {"$P_IFRAME"}},
                                 {"$P_UIFR", {"$P_IFRAME", true, true}},
                                 {"$P_CHBFRAME", {"$P_CHBFRAME", false, true}},
                                 {"$P_CHBFR", {"$P_CHBFRAME", true, true}},
                                 {"$P_NCBFRAME", {"$P_NCBFRAME", false, true}},
                                 {"$P_NCBFR", {"$P_NCBFRAME", true, true}}};

std::optional<Target> target_of(std::string_view name) {
  for (const auto& row : targets) {
    if (row.name == name) return row.target;
  }
  for (const auto& f : control_frames) {
    if (name == f.active) return Target{f.active};
    if (name == f.stored) return Target{f.active, true};
  }
  return std::nullopt;
}

bool of_other_mode(std::string_view name) {  // $P_ISO1FRAME to $P_ISO4FRAME, $P_ISO1FR to $P_ISO4FR
  return name.starts_with("$P_ISO") && (name.ends_with("FRAME") || name.ends_with("FR"));
}

Expr named(std::string_view name, int index, WordPos pos) {
  Expr e;
  e.kind = ExprKind::variable;
  e.text = name;
  e.pos = pos;
  if (index >= 0) {
    Expr i;
    i.kind = ExprKind::number;
    i.number = index;
    i.text = std::to_string(index);
    i.pos = pos;
    e.args.push_back(std::move(i));
  }
  return e;
}

}  // namespace

bool StatementLowering::has_control_frame(std::string_view active) const {
  const auto& data = c_.machine.profile->data;
  const auto it = data.find(std::string(control_frames_datum));
  const unsigned mask = it != data.end() ? saturate<unsigned>(it->second) : usual_control_frames;
  return std::any_of(std::begin(control_frames), std::end(control_frames),
                     [&](const ControlFrame& f) { return f.active == active && (mask >> f.bit & 1U) != 0; });
}

/// What lies inside of the frame, in the order of the chain.
std::vector<Expr> StatementLowering::frames_inside(std::string_view active, int index, WordPos pos) const {
  std::vector<Expr> out;
  constexpr std::string_view outer[] = {"$P_PARTFRAME", "$P_SETFRAME", "$P_EXTFRAME"};
  const auto* const at = std::find(std::begin(outer), std::end(outer), active);
  if (at != std::end(outer)) {
    for (const auto* f = at + 1; f != std::end(outer); ++f) {
      if (has_control_frame(*f)) out.push_back(named(*f, -1, pos));
    }
    out.push_back(named("$P_ACTBFRAME", -1, pos));
  }
  if (active == "$P_CHBFRAME" && c_.said.contains("$P_BFRAME")) {
    for (int i = index + 1; i < row_frames_each; ++i) out.push_back(named("$P_CHBFRAME", i, pos));
  }
  if (active != "$P_IFRAME" && active != "$P_PFRAME") out.push_back(named("$P_IFRAME", -1, pos));
  if (active != "$P_PFRAME") out.push_back(named("$P_PFRAME", -1, pos));
  return out;
}

/// The frame with the added one behind all that stand inside of it. Null: one of these can't be read.
ir::ExprPtr StatementLowering::behind_frames(ir::ExprPtr frame, ir::ExprPtr added, const std::vector<Expr>& inside,
                                             WordPos pos) {
  const auto chain = [pos](ir::ExprPtr outer, ir::ExprPtr inner) {
    if (!outer) return inner;
    return make_expr(ir::Call{ir::Function::frame_chain, {std::move(outer), std::move(inner)}}, ir::Type::frame, pos);
  };
  ir::ExprPtr whole;
  for (const Expr& e : inside) {
    const auto f = exprs_.frame_name(e);
    if (!f) return nullptr;
    whole = chain(std::move(whole), f->whole);
  }
  if (!whole) return chain(std::move(frame), std::move(added));
  frame = chain(chain(std::move(frame), whole), std::move(added));
  return chain(std::move(frame),
               make_expr(ir::Call{ir::Function::frame_inverse, {std::move(whole)}}, ir::Type::frame, pos));
}

/// STATE=ADDFRAME(FRAME,"name"): 0 done, 1 no such frame, 2 the machine does not have it.
bool StatementLowering::add_frame(const Expr& state, const Expr& call, WordPos pos, Parts& parts) {
  const auto answer = [&](int code) {
    Expr number = named({}, code, pos).args.front();
    return assign(state, number, pos, parts);
  };
  if (call.args.size() != 2) {
    c_.error("SIN-012", pos, "ADDFRAME() takes a frame and the name of a frame of the chain as a text");
    return false;
  }
  const Expr& text = call.args[1];
  if (text.kind != ExprKind::string)
    return refuse("frame.measured", text.pos, "ADDFRAME() into a frame whose name is computed is not carried yet");
  std::string name = to_upper_ascii(text.text);
  int index = -1;
  if (const auto open = name.find('['); open != std::string::npos && name.ends_with(']')) {
    const std::string digits = name.substr(open + 1, name.size() - open - 2);
    constexpr std::size_t longest = 2;
    const bool number =
        !digits.empty() && digits.size() <= longest && digits.find_first_not_of("0123456789") == std::string::npos;
    index = number ? std::stoi(digits) : -2;
    name.resize(open);
  }
  const auto target = target_of(name);
  if (!target && of_other_mode(name)) return answer(not_configured);
  if (!target || target->indexed != (index >= 0)) {
    c_.warning("SIN-130", text.pos,
               "the chain of frames has no " + text.text + ": ADDFRAME() answers 1 and does nothing",
               "write the name as the control spells it, with the number where there are several: $P_UIFR[1]");
    return answer(no_such_frame);
  }
  const bool of_control = std::any_of(std::begin(control_frames), std::end(control_frames),
                                      [&](const ControlFrame& f) { return f.active == target->active; });
  if (of_control && !has_control_frame(target->active)) {
    c_.warning("SIN-131", text.pos,
               "the machine " + c_.machine.profile->name + " has no " + text.text +
                   " in its chain of frames: ADDFRAME() answers 2 and does nothing",
               "where it has, its profile says so: \"data\": { \"" + std::string(control_frames_datum) + "\": ... }");
    return answer(not_configured);
  }
  if (target->active == "$P_NCBFRAME")
    return refuse("frame.measured", text.pos, "ADDFRAME() into a frame of all channels is not carried yet",
                  "whether its frame turns decides whether the control takes it");
  const RowFrame* row = row_frame(target->active);
  if (row != nullptr && row->row >= ir::frame_rows::neutral)
    return refuse("frame.measured", text.pos, "ADDFRAME() into " + text.text + " is not carried yet");
  if (c_.tool_frame)
    return refuse("frame.measured", pos, "ADDFRAME() while a frame of the tool is in force is not carried yet");
  const auto written = exprs_.frame_name(named(name, index, text.pos));
  const auto whole = exprs_.frame_name(named(target->active, target->active == "$P_CHBFRAME" ? index : -1, text.pos));
  ir::ExprPtr value = written && whole ? whole->whole : nullptr;
  ir::ExprPtr added = value ? exprs_.frame(call.args[0]) : nullptr;
  if (!added) return false;
  value = behind_frames(std::move(value), std::move(added), frames_inside(target->active, index, pos), pos);
  if (!value) return false;
  c_.framed = true;
  const auto& system = std::get<ir::SystemRef>(written->whole->node);
  if (row != nullptr) c_.said.emplace("$P_BFRAME");
  if (target->stored && c_.first_time("ADDFRAME")) {
    c_.note("SIN-132", text.pos,
            text.text + " gets what makes the whole chain of now with the frame behind it, as soon as it is selected");
  }
  ir::Assign::Item item;
  item.system = system;
  item.to_system = true;
  item.pos = pos;
  item.value = std::move(value);
  parts.assign.items.push_back(std::move(item));
  return answer(done);
}

}  // namespace cnctrans::sinumerik
