// The printer of the textual IR: a visitor of ir/fields.h that appends to `out`. Only for the .cpp files of ir/.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/text.h"
#include "ir/fields_statement.h"
#include "ir/text/enum_names.h"
#include "ir/text/text.h"
#include "ir/text/text_names.h"

namespace cnctrans::ir::detail {

class Printer {
 public:
  Printer(const Program& program, const PrintOptions& options)
      : program_(program), options_(options), handles_(space_handles(program)) {}

  std::string out;

  void program();
  void routine(const Routine& r);
  void statement(const Statement& s);
  void statements(const Body& body);
  /// An expression; `primary`: in parentheses unless it is one operand.
  void expression(const ExprPtr& e, bool primary);

  // --- visitor of fields() ---
  void word(std::string_view text) { put(text); }
  template <class T>
  void item(std::string_view, const T& x) {
    value(x);
  }
  template <class T, class D = T>
  void opt(std::string_view name, const T& x, const D& fallback = D{}) {
    if (is_default(x, fallback)) return;
    put(name);
    value(x);
  }
  template <class E>
  void bare(std::string_view, E x, E fallback) {
    if (x != fallback) value(x);
  }
  void flag(std::string_view name, bool x) {
    if (x) put(name);
  }
  void flag_off(std::string_view keyword, std::string_view, bool x) {
    if (!x) put(keyword);
  }
  template <class T>
  void given(std::string_view name, bool has, const T& x) {
    if (!has) return;
    put(name);
    value(x);
  }
  void axis(std::string_view, AxisId id) { put(axis_text(program_, id)); }
  void axis_opt(std::string_view name, AxisId id) {
    if (id == axis::none) return;
    put(name);
    put(axis_text(program_, id));
  }
  void pos(WordPos p);
  void place(std::string_view name, WordPos p);
  void quoted(std::string_view, std::string_view text) {
    if (text.empty()) return;
    put("as");
    value(text);
  }
  void code(bool is_explicit, std::string_view text);
  template <class T>
  void words(std::string_view, const std::vector<T>& list) {
    for (const auto& x : list) value(x);
  }
  template <class T>
  void each(std::string_view name, const std::vector<T>& list) {
    for (const auto& x : list) {
      put(name);
      value(x);
    }
  }
  void exprs(std::string_view name, const std::vector<ExprPtr>& list);
  void pairs(std::string_view name, const std::vector<std::pair<std::string, Value>>& list);
  template <class T>
  void group(std::string_view name, const T& x) {
    if (rendered(x) == rendered(T{})) return;
    put(name);
    value(x);
  }
  template <class P>
  void pointer(std::string_view name, const P& p) {
    if (!p) return;
    put(name);
    value(*p);
  }
  template <class P>
  void target(std::string_view, const P& p) {
    if (p) {
      value(*p);
    } else {
      put("nothing");
    }
  }
  void label(std::string_view name, const LabelRef& l);
  void routine_name(std::string_view name, const RoutineName& n);
  void space(std::string_view, SpaceId id) { put(handle(id)); }
  void setting(const ModalSet& x);
  void action(const ActionData& data);
  void cycle(const std::variant<HoleCycle, NamedCycle>& node);
  void block(const Block& b);
  void body(std::string_view name, const Body& b, const LineInfo& end_line);
  void then_else(const If& x);
  void assignments(std::string_view name, const std::vector<Assign::Item>& items);
  void arguments(std::string_view name, const std::vector<Argument>& list);
  void declared(std::string_view name, const std::vector<Declare::Item>& items);
  void cases(std::string_view name, const std::vector<std::pair<ExprPtr, Jump>>& list);

 private:
  // One value, as it stands after its keyword.
  void value(const Value& v);
  void value(const ExprPtr& e) { expression(e, false); }
  void value(const VarRef& v) { put(variable_text(v)); }
  void value(const std::string& text) { put(detail::quoted(text)); }
  void value(std::string_view text) { put(detail::quoted(text)); }
  void value(double x) { put(shortest(x)); }
  void value(std::uint8_t x) { put(std::to_string(x)); }
  void value(std::int32_t x) { put(std::to_string(x)); }
  void value(std::uint32_t x) { put(std::to_string(x)); }
  void value(std::int64_t x) { put(std::to_string(x)); }
  template <class E>
  requires std::is_enum_v<E>
  void value(E x) { put(enum_name(x)); }
  template <class T>
  requires std::is_class_v<T>
  void value(const T& x) { fields(*this, x); }
  static bool is_default(const Value& v, const Value&) { return v.literal() && v.number == 0 && v.text.empty(); }
  static bool is_default(const ExprPtr& e, const ExprPtr&) { return e == nullptr; }
  static bool is_default(std::string_view a, std::string_view b) { return a == b; }
  template <class T, class D>
  requires(!std::is_class_v<T>) static bool is_default(T a, D b) { return a == static_cast<T>(b); }
  template <class T>
  std::string rendered(const T& x) const {
    Printer other(program_, options_, handles_);
    other.value(x);
    return other.out;
  }
  Printer(const Program& program, const PrintOptions& options, const std::vector<std::string>& handles)
      : program_(program), options_(options), handles_(handles) {}

  void put(std::string_view text);  ///< with a blank before it where one is needed
  void glue(std::string_view text) { out += text; }
  void open_line(const LineInfo& line);
  void close_line(const LineInfo& line);
  void line_prefix(const LineInfo& line);

  std::string handle(SpaceId id) const;
  std::string variable_text(const VarRef& v) const;
  std::string index_text(const ExprPtr& e) const;
  std::string suffix(const Expr& e) const;
  std::string expr_text(const ExprPtr& e, bool primary) const;
  std::string list_text(const std::vector<ExprPtr>& list) const;

  const Program& program_;
  PrintOptions options_;
  std::vector<std::string> handles_;
  int depth_ = 0;
  const LineInfo* opening_ = nullptr;  ///< line of the statement being printed: its comments follow the brace
};

/// A label name as it stands in the text: bare capitals, else quoted.
std::string label_text(std::string_view text);

}  // namespace cnctrans::ir::detail
