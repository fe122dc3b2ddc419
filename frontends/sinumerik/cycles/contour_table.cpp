// Tables of prepared contours: CONTPRON to EXECUTE fills one, EXECTAB runs a row of it, INTERSEC asks where two rows
// cut (motion reference 19).
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/saturate.h"
#include "base/text.h"
#include "frontends/sinumerik/state/statements.h"
#include "frontends/sinumerik/statements/row_parts.h"
#include "ir/frame_rows.h"

namespace cnctrans::sinumerik {

using syntax::Block;
using syntax::Expr;
using syntax::ExprKind;
using syntax::Word;

namespace {

constexpr int columns = 11, column_of_extremes = 7;

ir::ExprPtr place(ir::AxisId axis, WordPos pos) {
  ir::SystemRef ref;
  ref.datum = ir::Datum::programmed_position;
  ref.axis = axis;
  ref.text = "$P_EP";
  return make_expr(std::move(ref), ir::Type::real, pos);
}

}  // namespace

bool StatementLowering::is_contour_table(const Expr& e) const {
  const Symbol* symbol = c_.symbol(e.text);
  return symbol != nullptr && symbol->type == ir::Type::real && symbol->dimensions == 2 && symbol->sizes[1] == columns;
}

// --- filling a table --------------------------------------------------------------------------------------------

/// CONTPRON(TAB,"L",COUNT): from here on the elements are gathered; what the text does not tell leaves the table
/// unknown.
void StatementLowering::begin_contour(const std::vector<Expr>& args, WordPos pos) {
  contour_.reset();
  const auto* axis = c_.machine.profile->axis(ir::axis::x);
  const bool diameter = axis != nullptr && axis->diameter &&
                        c_.diameter.value_or(c_.machine.profile->power_on.diameter) != ir::DiameterMode::radius;
  const bool forward =
      args.size() < 4 || args[3].kind == ExprKind::missing || (args[3].kind == ExprKind::number && args[3].number == 0);
  const bool fits = args.size() >= 3 && is_contour_table(args[0]) && args[0].args.empty() &&
                    args[1].kind == ExprKind::string && args[1].text.size() == 1 && forward && c_.plane && !diameter &&
                    c_.units_by_text && !c_.units_called && !c_.increments;
  if (!fits) return;
  Contour made;
  made.table = args[0].text;
  made.count = args[2];
  made.type = to_upper_ascii(args[1].text)[0];
  made.plane = *c_.plane;
  made.metric = c_.units_by_text == ir::Units::metric;
  made.motion = c_.motion;
  const auto axes = ir::plane_axes(*c_.plane);
  made.at = {{place(axes.u, pos), std::nullopt}, {place(axes.v, pos), std::nullopt}};
  contour_ = std::move(made);
}

/// A number that the text tells, an AC() or IC() round it.
std::optional<double> StatementLowering::contour_value(const Block& block, const Word& w, Attribute& attribute) {
  if (w.extension >= 0 || !w.has_value) return std::nullopt;
  if (!w.is_expression) return w.number;
  const ir::Value value = exprs_.value(block, w, attribute);
  return value.literal() ? std::optional(value.number) : ir::constant_value(value.expr);
}

void StatementLowering::contour_block(const Block& block) {
  if (!contour_) return;
  Contour& c = *contour_;
  const auto unknown = [this] { contour_.reset(); };
  if (!block.statements.empty() || block.skip_mask != 0 || !block.labels.empty()) return unknown();
  const auto axes = ir::plane_axes(c.plane);
  ContourElement e;
  e.start = e.end = c.at;
  bool moves = false;
  std::optional<double> radius;
  std::array<std::optional<double>, 3> centre;
  std::array<bool, 3> absolute{};
  for (const Word& w : block.words) {
    const std::string name = to_upper_ascii(w.address);
    Attribute attribute = Attribute::none;
    const auto value = contour_value(block, w, attribute);
    if (!value) return unknown();
    const ir::AxisId axis = c_.machine.axis(name);
    if (name == "G") {
      if (*value >= 0 && *value <= 3) {
        c.motion = static_cast<ir::MotionKind>(g_function(saturate<std::int32_t>(*value))->a);
      } else if (*value != 90 && *value != 9 && *value != 60 && *value != 64) {
        return unknown();
      }
    } else if (axis == axes.u || axis == axes.v) {
      if (attribute != Attribute::none && attribute != Attribute::ac) return unknown();
      ContourCoordinate& to = axis == axes.u ? e.end.u : e.end.v;
      to.expr = ir::number(*value);
      to.number = *value;
      moves = true;
    } else if (name == "I" || name == "J" || name == "K") {
      const auto i = static_cast<std::size_t>(name[0] - 'I');
      if (attribute != Attribute::none && attribute != Attribute::ac && attribute != Attribute::ic) return unknown();
      centre[i] = *value;
      absolute[i] = attribute == Attribute::ac;
    } else if (name == "CR") {
      radius = *value;
    } else if (name == "RND" || name == "CHR" || name == "CHF") {
      using Corner = ContourElement::Corner;
      e.corner = name == "RND" ? Corner::round : name == "CHR" ? Corner::leg : Corner::chord;
      e.size = *value;
    } else if (axis != ir::axis::none) {
      c.other_axis = true;  // no axis of the plane
    } else if (name != "F") {
      return unknown();
    }
  }
  constexpr std::pair<ir::MotionKind, int> codes[] = {{ir::MotionKind::rapid, 0},
                                                      {ir::MotionKind::linear, 1},
                                                      {ir::MotionKind::arc_cw, 2},
                                                      {ir::MotionKind::arc_ccw, 3}};
  const auto* code =
      std::find_if(std::begin(codes), std::end(codes), [&](const auto& k) { return k.first == c.motion; });
  if (code == std::end(codes)) return unknown();
  e.code = code->second;
  if (!moves && e.arc()) return unknown();
  if (!moves) return;
  if (e.arc()) {
    if (!e.start.known() || !e.end.known()) return unknown();
    const double u = *e.start.u.number, v = *e.start.v.number;
    const double du = *e.end.u.number - u, dv = *e.end.v.number - v;
    if (radius) {  // left or right of the chord
      const double chord = std::hypot(du, dv), rest = *radius * *radius - chord * chord / 4;
      if (chord == 0 || rest < 0) return unknown();
      const double side = std::sqrt(rest) / chord * ((e.code == 3) == (*radius > 0) ? 1 : -1);
      e.centre_u = u + du / 2 - dv * side;
      e.centre_v = v + dv / 2 + du * side;
    } else {
      const auto at = [&](ir::AxisId axis, double from) {
        return absolute[axis] ? *centre[axis] : from + centre[axis].value_or(0);
      };
      e.centre_u = at(axes.u, u);
      e.centre_v = at(axes.v, v);
    }
  }
  c.at = e.end;
  c.elements.push_back(std::move(e));
}

/// EXECUTE(ERR): true when the text tells the whole table.
bool StatementLowering::contour_known() {
  if (!contour_) return false;
  Contour& c = *contour_;
  const bool longitudinal = c.type == 'L' || c.type == 'G';
  const Symbol* table = c_.symbol(c.table);
  const bool good = (longitudinal || c.elements.size() == 1) && !c.elements.empty() && cut_corners(c.elements) &&
                    is_one_flank(c.elements, c.type == 'G') && c.elements.size() + 1 < table->sizes[0];
  if (!good) contour_.reset();
  return good;
}

/// The cells as the control fills them: pointers to the element before and behind, its codes, ends, angle and centre.
void StatementLowering::fill_table(const Expr& error, WordPos pos, const ir::LineInfo& info) {
  const Contour c = std::move(*contour_);
  contour_.reset();
  const WordPos part{pos.column, 0};  // of the statement, which has its own text
  ir::Assign out;
  const auto put = [&](ir::VarRef target, ir::ExprPtr value) {
    ir::Assign::Item item;
    item.target = std::move(target);
    item.value = std::move(value);
    item.pos = part;
    out.items.push_back(std::move(item));
  };
  Expr table;
  table.text = c.table;
  table.pos = pos;
  const auto cell = [&](std::size_t row, int column) {
    return std::get<ir::VarRef>(exprs_.element(table, {static_cast<int>(row), column})->node);
  };
  const auto number = [&](std::size_t row, int column, double value) { put(cell(row, column), ir::number(value)); };
  const std::size_t last = c.elements.size() - 1;
  constexpr int hundred_metric = 10;
  for (std::size_t i = 0; i <= last; ++i) {
    const ContourElement& e = c.elements[i];
    number(i, 0, static_cast<double>(i == 0 ? last : i - 1));
    number(i, 1, static_cast<double>(i == 0 ? last : i == last ? 0 : i + 1));
    number(i, 2, (c.metric ? hundred_metric : 0) + e.code);
    put(cell(i, 3), e.start.u.expr);
    put(cell(i, 4), e.start.v.expr);
    put(cell(i, 5), e.end.u.expr);
    put(cell(i, 6), e.end.v.expr);
    put(cell(i, 8), greatest_angle(e));
    number(i, 9, e.arc() ? e.centre_u : 0);
    number(i, 10, e.arc() ? e.centre_v : 0);
  }
  number(last + 1, 0, 0);
  number(last + 1, 1, 0);
  const auto give = [&](const Expr& e, double value) {
    ir::Type type = ir::Type::real;
    if (e.kind == ExprKind::missing) return;
    if (auto target = exprs_.variable(e, type)) put(std::move(*target), ir::number(value));
  };
  const bool ok_is_one = c_.machine.options.contour_ok == ContourOk::one;
  for (const Expr* e : {static_cast<const Expr*>(&c.count), &error}) c_.unknown_names.erase(e->text);
  c_.unknown_names.erase(c.table);
  give(c.count, 0);
  give(error, ok_is_one ? 1 : 0);
  const bool angle = c.type == 'L' || c.type == 'G';
  c_.prepared[c.table] = angle ? 1U << column_of_extremes : 1U << column_of_extremes | 1U << 8U;
  c_.note("SIN-137", pos,
          "the table " + c.table + " has " + std::to_string(last + 1) + " elements, no relief cut; " + error.text +
              " is " + (ok_is_one ? "1" : "0") + " where all went well" +
              (c.other_axis ? "; words of axes outside of the plane count for nothing" : ""),
          "the option sinumerik.contour_ok of the profile says which number that is");
  ir::LineInfo own = further_line(info);
  emit(own, std::move(out));
}

// --- a row as a move --------------------------------------------------------------------------------------------

namespace {

/// To the end of the element in a row of the table; `cell` reads one of its columns.
template <typename Cell>
ir::Block element_move(ir::MotionKind kind, bool modal, const ir::PlaneAxes& axes, WordPos pos, const Cell& cell) {
  ir::Block out;
  out.has_motion = true;
  ir::Motion& m = out.motion;
  m.kind = kind;
  m.explicit_code = true;
  m.keeps_modal = modal;
  m.code_pos = pos;
  int column = 5;
  for (const ir::AxisId axis : {axes.u, axes.v}) {
    ir::CoordWord w;
    w.axis = axis;
    w.mode = ir::WordMode::absolute;
    w.value = ir::Value(cell(column++));
    w.pos = pos;
    m.coords.push_back(std::move(w));
  }
  column = 9;
  for (const ir::AxisId axis : {axes.u, axes.v}) {
    if (kind != ir::MotionKind::arc_cw && kind != ir::MotionKind::arc_ccw) break;
    ir::CenterWord w;
    w.axis = axis;
    w.mode = ir::CenterMode::absolute;
    w.scale = ir::WordScale::modal;
    w.value = ir::Value(cell(column++));
    w.pos = pos;
    m.centers.push_back(std::move(w));
  }
  return out;
}

}  // namespace

/// EXECTAB(TAB[I]): to the end of the element, by the motion code that its row has.
bool StatementLowering::run_element(const Block& block, const ir::LineInfo& info) {
  const bool one = block.statements.size() == 1 && block.words.empty() && block.statements.front().keyword == "()" &&
                   block.statements.front().text == "EXECTAB";
  if (!one) return false;
  const auto& s = block.statements.front();
  const bool fits = s.args.size() == 1 && is_contour_table(s.args[0]) && s.args[0].args.size() == 1;
  const auto keep = [&](std::string_view feature) {
    add_opaque(block, info, feature, false);
    return true;
  };
  if (!fits) {
    c_.error("SIN-012", s.pos, "EXECTAB() takes an element of a table REAL [n,11]: EXECTAB(TAB[0])");
    return keep("contour.table");
  }
  if (!c_.plane) {
    refuse("contour.table", s.pos, "EXECTAB() where the text does not tell the plane is not carried yet");
    return keep("contour.table");
  }
  ir::ExprPtr row = exprs_.lower_as(s.args[0].args[0], ir::Type::integer);
  if (!row) return keep(feature_);
  const auto cell = [&](int column) {
    ir::VarRef ref;
    const Symbol* symbol = c_.symbol(s.args[0].text);
    ref.space = symbol->space;
    ref.name = s.args[0].text;
    ref.indices = {row, ir::number(column)};
    return make_expr(std::move(ref), ir::Type::real, s.pos);
  };
  if (c_.unknown_names.contains(s.args[0].text)) {
    refuse("contour.table", s.pos, "EXECTAB() of a contour that the text does not tell is not carried yet");
    return keep("contour.table");
  }
  c_.read_names.insert(s.args[0].text);
  c_.warning("SIN-138", s.pos,
             "EXECTAB() is a move from where the tool stands to the end of the element, with the feed in force; the "
             "motion code in force before it stays");
  constexpr ir::MotionKind kinds[] = {ir::MotionKind::rapid, ir::MotionKind::linear, ir::MotionKind::arc_cw,
                                      ir::MotionKind::arc_ccw};
  // The units digit of column 2.
  const auto tens = ir::call(ir::Function::trunc, {ir::binary(ir::BinaryOp::divide, cell(2), ir::number(10))});
  const auto code =
      ir::binary(ir::BinaryOp::subtract, cell(2), ir::binary(ir::BinaryOp::multiply, tens, ir::number(10)));
  ir::LineInfo plain;
  plain.span = info.span;
  const auto put = [&](ir::MotionKind kind) {
    ir::LineInfo line = further_line(info);
    emit(line, element_move(kind, c_.motion == kind, ir::plane_axes(*c_.plane), s.pos, cell));
  };
  for (std::size_t i = 0; i + 1 < std::size(kinds); ++i) {
    ir::Statement branch;
    branch.line = i == 0 ? info : plain;
    ir::If node;
    node.condition = is_number(code, static_cast<int>(i), s.pos);
    branch.node = std::move(node);
    structure_->open(std::move(branch));
    put(kinds[i]);
    structure_->else_branch(plain);
  }
  put(kinds[3]);
  for (std::size_t i = 0; i + 1 < std::size(kinds); ++i)
    structure_->close(frontends::StructureBuilder::Kind::if_, plain);
  return true;
}

// --- where two rows cut -----------------------------------------------------------------------------------------

/// OK=INTERSEC(T1[I],T2[K],P,MODE): worked out by the run, from the rows as they are then.
bool StatementLowering::crossing(const ir::VarRef& target, const Expr& call, WordPos pos, ir::Assign& out) {
  const auto row_of = [&](std::size_t i) {
    return i < call.args.size() && is_contour_table(call.args[i]) && call.args[i].args.size() == 1;
  };
  const Symbol* point = call.args.size() > 2 ? c_.symbol(call.args[2].text) : nullptr;
  const bool fits = call.args.size() >= 3 && call.args.size() <= 4 && row_of(0) && row_of(1) && point != nullptr &&
                    point->type == ir::Type::real && point->dimensions == 1 && call.args[2].args.empty();
  if (!fits) {
    c_.error("SIN-012", pos, "INTERSEC() takes two elements of tables REAL [n,11], an array REAL [2] and a mode");
    return false;
  }
  ir::SystemRef ref;
  ref.text = "INTERSEC";
  ref.datum = ir::Datum::frame_settable;
  ref.args = {ir::number(ir::frame_rows::crossing), ir::number(0)};
  for (const std::size_t table : {std::size_t{0}, std::size_t{1}}) {
    const Expr& e = call.args[table];
    if (c_.unknown_names.contains(e.text))
      return refuse("contour.table", e.pos, "INTERSEC() of a contour that the text does not tell is not carried yet");
    c_.read_names.insert(e.text);
    const ir::ExprPtr row = exprs_.lower_as(e.args[0], ir::Type::integer);
    if (!row) return false;
    for (const int column : {2, 3, 4, 5, 6, 9, 10}) {
      ir::VarRef cell;
      cell.space = c_.symbol(e.text)->space;
      cell.name = e.text;
      cell.indices = {row, ir::number(column)};
      ref.args.push_back(make_expr(std::move(cell), ir::Type::real, e.pos));
    }
  }
  c_.warning(
      "SIN-139", pos,
      "INTERSEC() gives the point that lies on both elements, their ends included; two such points stop the run");
  const auto add = [&](ir::VarRef to, int what, ir::Type type) {
    ir::SystemRef one = ref;
    one.args[1] = ir::number(what);
    one.args.push_back(what == 0 ? ir::number(0) : exprs_.element(call.args[2], {what - 1}));
    ir::Assign::Item item;
    item.target = std::move(to);
    item.value = exprs_.convert(make_expr(std::move(one), ir::Type::real, pos), type, pos);
    item.pos = pos;
    out.items.push_back(std::move(item));
  };
  // The point first: the answer may be told to a variable that chooses a row.
  for (const int k : {0, 1}) add(std::get<ir::VarRef>(exprs_.element(call.args[2], {k})->node), k + 1, ir::Type::real);
  add(target, 0, ir::Type::boolean);
  return true;
}

}  // namespace cnctrans::sinumerik
