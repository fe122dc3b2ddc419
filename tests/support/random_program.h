// Random IR programs over every kind of node and every field: for print/read properties, and to throw at passes and
// checks that must not crash on any of them. They are well-formed in shape, seldom in sense.
#pragma once

#include <algorithm>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "base/text.h"
#include "ir/fields_statement.h"
#include "ir/program.h"
#include "ir/text/enum_names.h"
#include "ir/text/text_names.h"

namespace cnctrans::test {

struct RandomOptions {
  int routines = 3;
  int statements = 12;    ///< in a body, at most
  int depth = 3;          ///< of nested bodies
  bool places = false;    ///< spans and word places
  bool odd_texts = true;  ///< texts with quotes, control bytes, bytes that are no UTF-8
};

class RandomProgram {
 public:
  explicit RandomProgram(unsigned seed, RandomOptions options = {}) : random_(seed), options_(options) {}

  ir::Program make() {
    fill_frame();
    for (int i = 0; i < options_.routines; ++i) {
      auto& r = program_.routines.emplace_back();
      ir::detail::fields(*this, r);
      r.kind = i == 0 ? ir::RoutineKind::main : ir::RoutineKind::sub;
      r.file = 0;
      r.header = line();
      r.header.joined = false;
      r.body = random_body(0);
    }
    ir::number_statements(program_);
    return std::move(program_);
  }

  // --- visitor of fields() ---
  void word(std::string_view) {}
  template <class T>
  void item(std::string_view, T& x) {
    fill(x);
  }
  template <class T>
  void opt(std::string_view, T& x) {
    if (chance(50)) fill(x);
  }
  template <class T, class D>
  void opt(std::string_view, T& x, const D&) {
    if (chance(50)) fill(x);
  }
  template <class E>
  void bare(std::string_view, E& x, E) {
    if (chance(40)) fill(x);
  }
  void flag(std::string_view, bool& x) { x = chance(40); }
  void flag_off(std::string_view, std::string_view, bool& x) { x = chance(60); }
  template <class T>
  void given(std::string_view, bool& has, T& x) {
    has = chance(50);
    if (has) fill(x);
  }
  void axis(std::string_view, ir::AxisId& id) { id = random_axis(); }
  void axis_opt(std::string_view, ir::AxisId& id) {
    if (chance(50)) id = random_axis();
  }
  void pos(WordPos& p) {
    if (options_.places && chance(70)) p = {below(90) + 1, below(12)};
  }
  void place(std::string_view, WordPos& p) { pos(p); }
  void quoted(std::string_view, std::string_view& x) {
    if (chance(50)) fill(x);
  }
  void code(bool& is_explicit, std::string_view& x) {
    is_explicit = chance(50);
    if (chance(50)) fill(x);
  }
  template <class T>
  void words(std::string_view, std::vector<T>& list) {
    fill_list(list);
  }
  template <class T>
  void each(std::string_view, std::vector<T>& list) {
    fill_list(list);
  }
  void exprs(std::string_view, std::vector<ir::ExprPtr>& list) { fill_list(list); }
  void pairs(std::string_view, std::vector<std::pair<std::string, ir::Value>>& list) {
    for (unsigned n = below(3); n != 0; --n) {
      auto& p = list.emplace_back();
      fill(p.first);
      fill(p.second);
    }
  }
  template <class T>
  void group(std::string_view, T& x) {
    if (chance(60)) fill(x);
  }
  template <class T>
  void pointer(std::string_view, std::shared_ptr<const T>& p) {
    if (!chance(50)) return;
    auto made = std::make_shared<T>();
    fill(*made);
    p = std::move(made);
  }
  template <class T>
  void target(std::string_view name, std::shared_ptr<const T>& p) {
    pointer(name, p);
  }
  void label(std::string_view, ir::LabelRef& l) {
    l.is_number = chance(50);
    l.text = l.is_number ? std::to_string(below(4) * 10) : label_name();
    if (chance(10)) l.text = text();
    if (!chance(15)) return;
    l.computed = expr(2);
    if (chance(60)) l.text.clear();
  }
  void routine_name(std::string_view, ir::RoutineName& n) {
    if (chance(70)) n.number = below(50);
    if (chance(50)) n.text = text();
  }
  void space(std::string_view, ir::SpaceId& id) { id = random_space(); }
  void setting(ir::ModalSet& x) {
    fill(x.setting);
    x.value = static_cast<std::uint8_t>(chance(90) ? below(2) : below(200));
  }
  void action(ir::ActionData& data) { fill_variant(data, below(std::variant_size_v<ir::ActionData::variant>)); }
  void cycle(std::variant<ir::HoleCycle, ir::NamedCycle>& node) { fill_variant(node, below(2)); }
  void block(ir::Block& b) {
    fill_list(b.actions);
    b.has_motion = chance(60);
    if (b.has_motion) fill(b.motion);
    b.repeat_given = chance(10) ? 1 : 0;
    if (b.repeat_given != 0) fill(b.repeat);
  }
  void body(std::string_view, ir::Body& b, ir::LineInfo& end_line) {
    b = random_body(depth_);
    end_line = line();
  }
  void then_else(ir::If& x) {
    x.then_body = random_body(depth_);
    x.has_else = chance(50);
    if (x.has_else) {
      x.else_body = random_body(depth_);
      x.else_line = line();
    }
    x.end_line = line();
  }
  void assignments(std::string_view, std::vector<ir::Assign::Item>& items) {
    for (unsigned n = below(3); n != 0; --n) {
      auto& it = items.emplace_back();
      it.to_system = chance(20);
      if (it.to_system) {
        it.system = system(1);
      } else {
        it.target = variable(1);
      }
      it.value = expr(2);
      pos(it.pos);
    }
  }
  void arguments(std::string_view, std::vector<ir::Argument>& list) { fill_list(list); }
  void declared(std::string_view, std::vector<ir::Declare::Item>& items) {
    for (unsigned n = below(3); n != 0; --n) {
      auto& it = items.emplace_back();
      fill(it.name);
      fill_list(it.dimensions);
      fill_list(it.initial);
    }
  }
  void cases(std::string_view, std::vector<std::pair<ir::ExprPtr, ir::Jump>>& list) {
    for (unsigned n = below(3); n != 0; --n) {
      auto& c = list.emplace_back();
      c.first = expr(2);
      fill(c.second);
    }
  }

  // --- pieces, for tests of their own ---
  ir::ExprPtr expr(int depth) {
    if (chance(4)) return nullptr;
    return expr_not_null(depth);
  }
  std::string text() {
    static const std::vector<std::string> plain{"", "A", "M03", "10.500", "FLANGE", "N10", "two words", "G01", "-7"};
    static const std::vector<std::string> odd{"say \"hi\"",       "back\\slash", "tab\tbell\x07", "\xe9t\xe9",
                                              "Bohrung \xc3\xb8", "line\nend",   "; ( ) { }",     "\\x41"};
    const auto& from = options_.odd_texts && chance(40) ? odd : plain;
    return from[below(static_cast<unsigned>(from.size()))];
  }

 private:
  unsigned below(std::size_t n) { return static_cast<unsigned>(random_() % n); }
  bool chance(unsigned percent) { return below(100) < percent; }

  template <class E>
  requires std::is_enum_v<E>
  void fill(E& x) { x = static_cast<E>(below(ir::detail::EnumText<E>::count)); }
  void fill(bool& x) { x = chance(50); }
  void fill(double& x) { x = real(); }
  void fill(std::uint8_t& x) { x = static_cast<std::uint8_t>(below(200)); }
  void fill(std::uint32_t& x) { x = below(1000); }
  void fill(std::int32_t& x) { x = static_cast<std::int32_t>(below(200)) - 20; }
  void fill(std::int64_t& x) { x = static_cast<std::int64_t>(below(2000)) - 20; }
  void fill(std::string& x) { x = text(); }
  void fill(std::string_view& x) {
    x = program_.keep(text());
    if (x.empty()) x = {};
  }
  void fill(ir::ExprPtr& x) { x = expr(3); }
  void fill(ir::VarRef& x) { x = variable(2); }
  void fill(ir::Value& x) {
    if (chance(30)) {
      x.expr = expr_not_null(3);
      return;
    }
    x.number = real();
    if (chance(60)) x.text = program_.keep(shortest(x.number));
    if (chance(10)) x.text = program_.keep(text());
    if (x.text.empty()) x.text = {};
  }
  template <class T>
  requires std::is_class_v<T>
  void fill(T& x) { ir::detail::fields(*this, x); }
  template <class T>
  void fill_list(std::vector<T>& list) {
    for (unsigned n = below(3); n != 0; --n) fill(list.emplace_back());
  }
  template <std::size_t i = 0, class... Kinds>
  void fill_variant(std::variant<Kinds...>& v, std::size_t index) {
    if constexpr (i < sizeof...(Kinds)) {
      if (index == i) {
        fill(v.template emplace<i>());
      } else {
        fill_variant<i + 1>(v, index);
      }
    }
  }

  double real() {
    static const std::vector<double> odd{0, -0.5, 1e-7, 123456789012345.0, 0.1 + 0.2, 1e20, -3.25, 1.0 / 3};
    if (chance(20)) return odd[below(odd.size())];
    return (static_cast<double>(below(200000)) - 100000) / (chance(50) ? 1000.0 : 1.0);
  }
  ir::AxisId random_axis() {
    if (chance(5)) return chance(50) ? ir::axis::none : ir::AxisId{20};
    return static_cast<ir::AxisId>(below(ir::axis::first_extra + program_.axis_names.size()));
  }
  ir::SpaceId random_space() { return static_cast<ir::SpaceId>(below(program_.spaces.size() + (chance(5) ? 2 : 0))); }
  std::string label_name() {
    static const std::vector<std::string> names{"LOOP", "END_1", "N5", "lower", "HERE"};
    return names[below(names.size())];
  }

  ir::VarRef variable(int depth) {
    ir::VarRef v;
    v.space = random_space();
    if (chance(60)) v.index = chance(70) ? ir::number(below(300)) : expr_not_null(depth - 1);
    if (chance(40)) v.name = text();
    for (unsigned n = chance(20) ? below(3) : 0; n != 0; --n) v.indices.push_back(expr_not_null(depth - 1));
    return v;
  }
  ir::SystemRef system(int depth) {
    ir::SystemRef s;
    fill(s.datum);
    if (chance(50)) s.axis = random_axis();
    s.text = text();
    s.given = chance(20);
    for (unsigned n = below(3); n != 0; --n) s.args.push_back(expr(depth - 1));
    return s;
  }
  ir::ExprPtr expr_not_null(int depth) {
    ir::Expr e;
    const unsigned kind = below(depth > 0 ? 8 : 4);
    if (kind == 0 || kind == 1) {
      ir::Number n{real(), {}, false};
      n.integer = ir::detail::natural_integer(n.value) != chance(10);
      if (chance(60)) n.text = chance(80) ? shortest(n.value) : text();
      e.node = std::move(n);
    } else if (kind == 2) {
      e.node = ir::String{text()};
    } else if (kind == 3) {
      e.node = ir::AxisName{random_axis()};
    } else if (kind == 4) {
      e.node = variable(depth);
    } else if (kind == 5) {
      e.node = system(depth);
    } else if (kind == 6 && chance(40)) {
      ir::Unary u;
      fill(u.op);
      u.operand = expr_not_null(depth - 1);
      e.node = std::move(u);
    } else if (kind == 6) {
      ir::Binary b;
      fill(b.op);
      b.left = expr_not_null(depth - 1);
      b.right = expr_not_null(depth - 1);
      if (chance(30)) b.compare = ir::Compare::relative_1e12;
      e.node = std::move(b);
    } else {
      ir::Call c;
      fill(c.function);
      for (unsigned n = below(4); n != 0; --n) c.args.push_back(expr_not_null(depth - 1));
      if (chance(30)) fill(c.half);
      e.node = std::move(c);
    }
    e.type = ir::detail::natural_type(e);
    if (chance(10)) fill(e.type);
    pos(e.pos);
    return std::make_shared<const ir::Expr>(std::move(e));
  }

  ir::LineInfo line() {
    ir::LineInfo l;
    if (options_.places) l.span = {below(3), below(900) + 1, below(80) + 1, below(900) + 1, below(80)};
    if (chance(50)) l.number = program_.keep(chance(90) ? std::to_string(below(6) * 10) : "00" + text());
    if (!l.number.empty() && chance(20)) l.number_mark = chance(80) ? ':' : '%';
    for (unsigned n = chance(20) ? below(3) : 0; n != 0; --n) {
      l.labels.push_back(program_.keep(chance(90) ? label_name() : text()));
    }
    if (chance(15)) l.skip_mask = static_cast<std::uint16_t>(below(65536));
    for (unsigned n = chance(30) ? below(3) : 0; n != 0; --n) {
      auto& c = l.comments.emplace_back();
      fill(c.text);
      fill(c.place);
      pos(c.pos);
    }
    l.joined = chance(10);
    if (chance(10)) l.blank_lines_before = static_cast<std::uint16_t>(below(3));
    return l;
  }
  ir::Body random_body(int depth) {
    ir::Body b;
    const int saved = std::exchange(depth_, depth + 1);
    for (unsigned n = below(static_cast<std::size_t>(options_.statements / (depth + 1) + 1)); n != 0; --n) {
      auto& s = b.emplace_back();
      s.line = line();
      fill_variant(s.node, statement_kind(depth));
    }
    depth_ = saved;
    return b;
  }
  std::size_t statement_kind(int depth) {
    constexpr std::size_t first_structured = 2;
    constexpr std::size_t last_structured = 6;
    std::size_t kind = chance(40) ? 0 : below(ir::detail::statement_names.size());
    if (depth >= options_.depth && kind >= first_structured && kind <= last_structured) kind = 0;
    return kind;
  }

  void fill_frame() {
    ir::detail::fields(*this, program_);
    program_.axis_names = {"Q1", "SP2", "odd name"};
    static const std::vector<std::string> prefixes{"P", "", "L", "", "P", "x y"};
    for (std::size_t n = 1 + below(prefixes.size()); n != 0; --n) {
      auto& s = program_.spaces.emplace_back();
      ir::detail::fields(*this, s);
      s.prefix = prefixes[n - 1];
    }
    fill_list(program_.files);
  }

  std::mt19937 random_;
  RandomOptions options_;
  ir::Program program_;
  int depth_ = 0;
};

inline ir::Program random_program(unsigned seed, RandomOptions options = {}) {
  return RandomProgram(seed, options).make();
}

}  // namespace cnctrans::test
