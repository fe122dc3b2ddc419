#include "backends/fagor/tables.h"

#include <array>
#include <deque>
#include <string>
#include <vector>

#include "dialects/fagor/limits.h"
#include "dialects/fagor/operators.h"

namespace cnctrans::backends::fagor {
namespace {

namespace facts = dialects::fagor;
using facts::Use;

/// One digit as shops write it: G1, but G04, G05, G07.
std::string code_text(int code) {
  const bool two_digits = code == 4 || code == 5 || code == 7;
  return (two_digits ? "G0" : "G") + std::to_string(code);
}

struct Row {
  const facts::GCode* code;
  std::string_view word;
};

/// The G functions of one model with their words.
struct Words {
  std::deque<std::string> texts;
  std::vector<Row> rows;
  std::vector<ModalCode> modal;
  std::vector<MotionCode> motions;
};

bool is_setting(Use use) {
  return use == Use::setting || use == Use::setting_after || use == Use::compensation;
}

ir::MotionKind motion_of(const facts::GCode& g) {
  switch (g.use) {
    case Use::motion: return g.motion;
    case Use::tangent_arc: return ir::MotionKind::arc_tangent;
    case Use::three_point_arc: return ir::MotionKind::arc_through_point;
    case Use::home: return ir::MotionKind::reference_point;
    case Use::straight: return g.motion;
    default: return ir::MotionKind::modal;
  }
}

Words make_words(bool lathe) {
  Words w;
  const int model = static_cast<int>(lathe ? facts::Model::lathe : facts::Model::mill);
  for (const facts::GCode& g : facts::g_codes()) {
    if ((static_cast<int>(g.model) & model) == 0) continue;
    const std::string_view word = w.texts.emplace_back(code_text(g.code));
    w.rows.push_back({&g, word});
    if (is_setting(g.use)) w.modal.push_back({g.setting, g.value, word});
    if (g.use == Use::plane) w.modal.push_back({ir::Setting::plane, g.value, word});
    if (motion_of(g) != ir::MotionKind::modal) w.motions.push_back({motion_of(g), word});
  }
  return w;
}

const Words& words(bool lathe) {
  static const Words of_lathe = make_words(true);
  static const Words of_mill = make_words(false);
  return lathe ? of_lathe : of_mill;
}

constexpr std::array<std::string_view, 3> skip_marks{"/", "/2", "/3"};

bool is_word(std::string_view text) {
  return !text.empty() && text.front() >= 'A' && text.front() <= 'Z';
}

std::vector<BinaryText> binary_texts() {
  std::vector<BinaryText> out;
  for (const auto& o : facts::operators) out.push_back({o.op, o.word, level_of(o.level), is_word(o.word)});
  // Between numbers the same words act on 32 bits.
  const auto bitwise = [&](ir::BinaryOp bit, ir::BinaryOp logical) {
    const auto* o = facts::find_operator(logical);
    out.push_back({bit, o->word, level_of(o->level), true});
  };
  bitwise(ir::BinaryOp::bit_and, ir::BinaryOp::logical_and);
  bitwise(ir::BinaryOp::bit_or, ir::BinaryOp::logical_or);
  bitwise(ir::BinaryOp::bit_xor, ir::BinaryOp::logical_xor);
  return out;
}

std::vector<FunctionText> function_texts() {
  std::vector<FunctionText> out;
  for (const auto& f : facts::functions) out.push_back({f.function, f.word});
  return out;
}

}  // namespace

Style make_style(bool lathe, bool inch, bool foreign) {
  Style s;
  s.dialect = dialect_name;
  s.comment.open = ";";
  s.comment.trim = true;
  s.approaches_cycles = !lathe;
  s.comment.ascii = true;
  s.modal_codes = words(lathe).modal;
  s.motion_codes = words(lathe).motions;
  s.kept_decimals = s.made_decimals = inch ? facts::decimals_inch : facts::decimals_mm;
  s.order_by_rank = foreign;
  s.blank_line = ";";  // an empty block is an error of the control
  s.only_label = ";";
  s.preparation_stop = g_word(lathe, Use::dwell);
  s.radius_address = "R";
  s.skip_marks = skip_marks;
  return s;
}

std::string_view g_word(bool lathe, Use use, int value) {
  for (const Row& r : words(lathe).rows) {
    if (r.code->use == use && r.code->value == value) return r.word;
  }
  return {};
}

const ExpressionStyle& expression_style() {
  static const std::vector<BinaryText> binary = binary_texts();
  static const std::array<UnaryText, 3> unary{UnaryText{ir::UnaryOp::negate, "-", level_of(facts::prefix_level)},
                                              UnaryText{ir::UnaryOp::logical_not, "NOT", level_of(facts::prefix_level)},
                                              UnaryText{ir::UnaryOp::bit_not, "NOT", level_of(facts::prefix_level)}};
  static const std::vector<FunctionText> functions = function_texts();
  static const ExpressionStyle style = [] {
    ExpressionStyle s;
    s.binary = binary;
    s.unary = unary;
    s.functions = functions;
    return s;
  }();
  return style;
}

}  // namespace cnctrans::backends::fagor
