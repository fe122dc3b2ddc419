#include "support.h"

#include "base/text.h"
#include "dialects/options.h"

namespace cnctrans::test {

using namespace ir;  // NOLINT: the vocabulary of the whole file

namespace {

VariableSpace numbered(std::string prefix, std::vector<SpaceSegment> segments) {
  VariableSpace s;
  s.prefix = std::move(prefix);
  s.segments = std::move(segments);
  return s;
}

std::set<BinaryOp> arithmetic() {
  return {BinaryOp::add, BinaryOp::subtract, BinaryOp::multiply, BinaryOp::divide};
}
std::set<BinaryOp> relations() {
  return {BinaryOp::eq, BinaryOp::ne, BinaryOp::lt, BinaryOp::le, BinaryOp::gt, BinaryOp::ge};
}
template <class T>
std::set<T> join(std::set<T> a, const std::set<T>& b) {
  a.insert(b.begin(), b.end());
  return a;
}

}  // namespace

Capabilities chain_target() {
  Capabilities c;
  c.dialect = "chain";
  c.repeat_range = true;
  c.conditions = ConditionForm::single_relation;
  c.searches = {Search::whole_first};
  c.label_max = 32767;
  c.expressions = ExpressionForm::left_to_right;
  c.unary = {UnaryOp::negate};
  c.binary = join(arithmetic(), relations());
  c.functions = {Function::sin, Function::cos, Function::atan, Function::sqrt, Function::trunc};
  c.spaces = {
      numbered("L", {{0, 19, Scope::global, false, false, false}, {100, 199, Scope::global, false, false, true}})};
  c.spaces[0].starts_at_zero = true;
  c.pools = {{"L", 0, 19, Scope::global, true}, {"L", 100, 199, Scope::global, false}};
  c.centers = {CenterMode::follows_distance};
  c.center_scales = {{CenterMode::follows_distance, WordScale::modal}};
  c.radius_major = false;
  c.full_circle_needs_end = true;
  c.diameter_switch = false;
  c.fixed_diameter = DiameterMode::diameter;
  c.exact_stop_modal = false;
  c.exact_stop_block = true;
  c.dwell_min = 0.01;
  c.dwell_max = 99.99;
  c.frame_uses = {FrameUse::normal, FrameUse::machine};
  c.frames = {{FrameSlot::shift, {FrameCombine::replace_named}}, {FrameSlot::rotation, {FrameCombine::replace}}};
  c.word_decimals = 3;
  return c;
}

Capabilities letters_target() {
  Capabilities c;
  c.dialect = "letters";
  c.one_line_if_action = true;
  c.repeat_range = true;
  c.searches = {Search::whole_first};
  c.unary = {UnaryOp::negate, UnaryOp::logical_not};
  c.binary = join(join(arithmetic(), relations()), {BinaryOp::power, BinaryOp::modulo, BinaryOp::logical_and,
                                                    BinaryOp::logical_or, BinaryOp::logical_xor});
  c.functions = {Function::sin,  Function::cos,   Function::tan,  Function::asin, Function::acos,
                 Function::atan, Function::arg,   Function::sqrt, Function::abs,  Function::trunc,
                 Function::ceil, Function::round, Function::log10};
  c.relation_as_value = true;
  c.word_indirect = true;
  c.constant_decimals = 5;
  c.constant_max = 999999.99999;
  c.arguments = ArgumentForm::letters;
  c.local_levels = true;
  c.call_count = false;
  c.spaces = {
      numbered("P", {{0, 25, Scope::level, false, false, false}, {100, 299, Scope::global, true, false, false}})};
  c.pools = {
      {"P", 100, 199, Scope::global, false}, {"P", 0, 25, Scope::level, false}, {"P", 200, 299, Scope::global, true}};
  c.centers = {CenterMode::from_start, CenterMode::absolute};
  c.center_scales = {{CenterMode::absolute, WordScale::modal}};
  c.full_circle_needs_end = true;
  c.helix_pitch = true;
  c.dwell_unit = 0.01;
  c.dwell_min = 0.01;
  c.length_comp_switch = true;
  c.retract_plane_switch = true;
  c.feed_memory = FeedMemory::per_mode;
  c.frame_uses = {FrameUse::normal, FrameUse::machine};
  c.frames = {{FrameSlot::shift, {FrameCombine::replace_named, FrameCombine::clear}},
              {FrameSlot::rotation, {FrameCombine::add, FrameCombine::clear}}};
  c.skip_levels = 3;
  c.skip_several = true;
  return c;
}

Capabilities structured_target() {
  Capabilities c;
  c.dialect = "structured";
  c.structured_if = c.while_loop = c.until_loop = c.for_loop = c.endless_loop = c.switch_jump = true;
  c.repeat_range = c.repeat_needs_identifiers = c.repeat_count_expression = true;
  c.modal_call = c.modal_cycle_by_call = c.declares_variables = true;
  c.searches = {Search::forward, Search::backward, Search::forward_then_backward};
  c.identifier_labels = c.duplicate_labels = true;
  c.word_expression = c.word_indirect = c.relation_as_value = true;
  c.unary = {UnaryOp::negate, UnaryOp::logical_not};
  c.binary = join(join(arithmetic(), relations()),
                  {BinaryOp::logical_and, BinaryOp::logical_or, BinaryOp::logical_xor, BinaryOp::int_divide});
  c.functions = {Function::sin,   Function::cos,   Function::tan,    Function::asin, Function::acos,
                 Function::atan2, Function::sqrt,  Function::square, Function::abs,  Function::trunc,
                 Function::ceil,  Function::round, Function::exp,    Function::ln};
  c.compare = Compare::relative_1e12;
  c.arguments = ArgumentForm::positional;
  c.local_levels = true;
  c.shared_level_calls = false;
  c.named_routines = c.early_return = true;
  c.end_in_sub_ends_all = false;
  VariableSpace names;
  names.scope = Scope::routine;
  names.starts_at_zero = true;
  c.spaces = {numbered("R", {{0, 99, Scope::global, true, false, false}}), names};
  c.pools = {{"R", 0, 99, Scope::global, false}};
  c.distance_per_word = true;
  c.centers = {CenterMode::from_start, CenterMode::absolute};
  c.center_scales = {{CenterMode::absolute, WordScale::modal}};
  c.helix_turns = true;
  c.exact_stop_block = true;
  c.feed_memory = FeedMemory::cleared;
  c.frame_uses = {FrameUse::normal, FrameUse::machine, FrameUse::machine_with_length};
  c.frame_chain = true;
  c.frames = {{FrameSlot::chain, {FrameCombine::replace, FrameCombine::compose, FrameCombine::clear}}};
  c.skip_levels = 8;
  c.skip_on_structures = false;
  c.native_cycle = [](const Cycle&) { return true; };
  return c;
}

machine::Profile profile(const std::string& name) {
  std::string error;
  auto p = dialects::load_profile(name, &error);
  return p ? *p : machine::Profile{};
}

Program read(const std::string& text) {
  Diagnostics diagnostics;
  Program p = from_text("program \"\"\n" + text, 0, diagnostics);
  number_statements(p);
  return p;
}

namespace {

template <class Run>
Passed with_context(const std::string& text, const Capabilities& target, const std::string& source,
                    const std::string& target_machine, const Run& run) {
  Passed out;
  out.program = from_text("program \"\"\n" + text, 0, out.diagnostics);
  number_statements(out.program);
  const machine::Profile from = profile(source), to = profile(target_machine);
  const LegaliseContext context{target, from, to, {}, out.diagnostics, &out.report};
  out.good = run(out.program, context) && !out.diagnostics.has_errors();
  out.text = to_text(out.program);
  return out;
}

}  // namespace

Passed run_pass(const std::string& pass, const std::string& text, const Capabilities& target, const std::string& source,
                const std::string& target_machine) {
  return with_context(text, target, source, target_machine,
                      [&pass](Program& p, const LegaliseContext& c) { return ir::run_pass(pass, p, c); });
}

Passed legalise(const std::string& text, const Capabilities& target, const std::string& source,
                const std::string& target_machine) {
  return with_context(text, target, source, target_machine,
                      [](Program& p, const LegaliseContext& c) { return ir::legalise(p, c); });
}

bool has_code(const Diagnostics& diagnostics, const std::string& code) {
  for (const auto& d : diagnostics.all()) {
    if (d.code == code) return true;
  }
  return false;
}

std::string all(const Diagnostics& diagnostics) {
  std::string text;
  for (const auto& d : diagnostics.all()) text += d.code + ": " + d.message + "\n";
  return text;
}

std::vector<std::string> trace(const Program& program, const machine::Profile& machine) {
  interpreter::TraceRecorder recorder;
  Diagnostics diagnostics;
  interpreter::Options options;
  options.max_steps = 100000;
  options.max_events = 10000;
  interpreter::run(program, machine, options, recorder, diagnostics);
  FileTable files;
  std::vector<std::string> lines;
  for (auto e : recorder.events) {
    e.file = 0;
    e.line = 0;
    for (auto& v : e.to.value) v = std::round(v * 1e6) / 1e6 + 0.0;
    e.center_u = std::round(e.center_u * 1e6) / 1e6 + 0.0;
    e.center_v = std::round(e.center_v * 1e6) / 1e6 + 0.0;
    lines.push_back(interpreter::to_json(e, files, program.axis_names));
  }
  for (const auto& d : diagnostics.all()) lines.push_back(d.code + " " + d.message);
  return lines;
}

std::string difference(const std::string& text, const Capabilities& target, const std::string& source,
                       const std::string& target_machine) {
  Passed passed = legalise(text, target, source, target_machine);
  if (!passed.good) return "refused: " + all(passed.diagnostics) + passed.text;
  const auto before = trace(read(text), profile(source));
  const auto after = trace(passed.program, profile(target_machine));
  if (before.size() <= 1) return "the source does nothing: " + (before.empty() ? std::string() : before[0]);
  for (std::size_t i = 0; i < std::max(before.size(), after.size()); ++i) {
    const std::string a = i < before.size() ? before[i] : "(nothing)", b = i < after.size() ? after[i] : "(nothing)";
    if (a != b) return "event " + std::to_string(i) + "\n  source " + a + "\n  target " + b + "\n" + passed.text;
  }
  return {};
}

}  // namespace cnctrans::test
