#include "backends/linuxcnc/capabilities.h"

#include <array>

#include "dialects/linuxcnc/limits.h"

namespace cnctrans::backends::linuxcnc {
namespace {

namespace facts = dialects::linuxcnc;
using ir::BinaryOp;
using ir::Function;

void statements(ir::Capabilities& c) {  // "O Codes"
  c.structured_if = c.while_loop = c.until_loop = c.for_loop = c.for_step = c.endless_loop = true;
  c.assignment_joins_words = c.several_assignments = false;
  c.label_max = facts::line_number_max;
  c.call_count = c.repeat_range = true;  // the blocks are written again, in a loop
  c.repeat_max = facts::o_word_max;
  c.repeat_count_expression = true;
  c.named_routines = true;
  c.early_return = true;
  c.end_in_sub_ends_all = true;
  c.routine_number_max = facts::o_word_max;
  c.output = ir::OutputForm::one_file_with_subs;
  c.skip_levels = 1;
  c.skip_on_structures = false;
  c.block_length = facts::line_length;
}

void expressions(ir::Capabilities& c) {  // "Expressions"
  c.word_expression = c.word_indirect = c.relation_as_value = true;
  c.unary = {ir::UnaryOp::negate, ir::UnaryOp::logical_not};
  c.binary = {BinaryOp::add,         BinaryOp::subtract,   BinaryOp::multiply,    BinaryOp::divide,
              BinaryOp::modulo,      BinaryOp::eq,         BinaryOp::ne,          BinaryOp::lt,
              BinaryOp::le,          BinaryOp::gt,         BinaryOp::ge,          BinaryOp::power,
              BinaryOp::logical_and, BinaryOp::logical_or, BinaryOp::logical_xor, BinaryOp::int_divide};
  c.functions = {Function::sin,   Function::cos,        Function::tan,       Function::asin,  Function::acos,
                 Function::atan,  Function::atan2,      Function::arg,       Function::sqrt,  Function::square,
                 Function::exp,   Function::ln,         Function::log10,     Function::abs,   Function::sign,
                 Function::trunc, Function::ceil,       Function::floor,     Function::round, Function::min,
                 Function::max,   Function::to_boolean, Function::to_integer};
  c.word_decimals = c.word_decimals_inch = 6;
  ir::VariableSpace numbers;
  numbers.prefix = "#";
  numbers.segments = {
      {facts::shared_parameter_min, facts::shared_parameter_max, ir::Scope::global, false, false, false}};
  numbers.starts_at_zero = true;
  c.spaces = {numbers};
  c.pools = {{"#", facts::shared_parameter_min, facts::shared_parameter_max, ir::Scope::global, false, false}};
}

void words(ir::Capabilities& c, bool lathe) {  // "G-Codes", "Order of Execution"
  c.motions.insert({ir::MotionKind::thread, ir::MotionKind::probe_toward, ir::MotionKind::probe_away});
  c.frame_uses = {ir::FrameUse::normal, ir::FrameUse::machine};
  c.own_block = [](const ir::Action& a) {
    const auto* m = std::get_if<ir::ModalSet>(&a.data);
    // F and S of the same line would be taken before these.
    const bool early = m != nullptr && (m->setting == ir::Setting::units || m->setting == ir::Setting::diameter);
    return early || std::holds_alternative<ir::Dwell>(a.data) || std::holds_alternative<ir::FrameOp>(a.data) ||
           std::holds_alternative<ir::SpindleOrient>(a.data);
  };
  c.centers = {ir::CenterMode::from_start};
  c.center_scales = {{ir::CenterMode::from_start, ir::WordScale::radius}};
  c.helix_turns = true;
  c.diameter_switch = lathe;
  c.dwell_min = 0;
  c.dwell_max = 9999999;
  c.inverse_time = false;  // every line would need its own F
  c.work_offset_rows = facts::zero_offset_row - 1;
  c.frame_rotation = false;
  c.frames[ir::FrameSlot::shift] = {ir::FrameCombine::replace, ir::FrameCombine::replace_named,
                                    ir::FrameCombine::clear};
  c.shift_survives_end = true;
  c.feed_memory = ir::FeedMemory::cleared;
}

ir::Capabilities make(bool lathe) {
  ir::Capabilities c;
  c.dialect = "linuxcnc";
  statements(c);
  expressions(c);
  words(c, lathe);
  return c;
}

}  // namespace

const ir::Capabilities& capabilities(bool lathe) {
  static const std::array<ir::Capabilities, 2> both{make(false), make(true)};
  return both[lathe ? 1 : 0];
}

}  // namespace cnctrans::backends::linuxcnc
