// The reader of the textual IR: recursive descent over characters, a visitor of ir/fields.h that fills what it visits.
// Only for the .cpp files of ir/.
#pragma once

#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostics.h"
#include "ir/fields_statement.h"
#include "ir/text/enum_names.h"
#include "ir/text/text_names.h"

namespace cnctrans::ir::detail {

class Reader {
 public:
  Reader(std::string_view text, FileId file, Diagnostics& diagnostics)
      : text_(text), file_(file), diagnostics_(diagnostics) {}

  Program read_program();

  // --- visitor of fields() ---
  void word(std::string_view text);
  template <class T>
  void item(std::string_view, T& x) {
    read(x);
  }
  template <class T>
  void opt(std::string_view name, T& x) {
    if (accept_word(name)) read(x);
  }
  template <class T, class D>
  void opt(std::string_view name, T& x, const D&) {
    if (accept_word(name)) read(x);
  }
  template <class E>
  void bare(std::string_view, E& x, E) {
    if (const auto e = enum_value<E>(peek_word())) {
      x = *e;
      take_word();
    }
  }
  void flag(std::string_view name, bool& x) { x = accept_word(name); }
  void flag_off(std::string_view keyword, std::string_view, bool& x) { x = !accept_word(keyword); }
  template <class T>
  void given(std::string_view name, bool& has, T& x) {
    has = accept_word(name);
    if (has) read(x);
  }
  void axis(std::string_view, AxisId& id);
  void axis_opt(std::string_view name, AxisId& id) {
    if (accept_word(name)) axis(name, id);
  }
  void pos(WordPos& p);
  void place(std::string_view name, WordPos& p) {
    if (accept_word(name)) pos(p);
  }
  void quoted(std::string_view, std::string_view& text) {
    if (accept_word("as")) read(text);
  }
  void code(bool& is_explicit, std::string_view& text);
  template <class T>
  void words(std::string_view, std::vector<T>& list) {
    while (ok() && axis_from_text(program_, peek_word())) read(list.emplace_back());
  }
  template <class T>
  void each(std::string_view name, std::vector<T>& list) {
    while (accept_word(name)) read(list.emplace_back());
  }
  void exprs(std::string_view name, std::vector<ExprPtr>& list);
  void pairs(std::string_view name, std::vector<std::pair<std::string, Value>>& list);
  template <class T>
  void group(std::string_view name, T& x) {
    if (accept_word(name)) read(x);
  }
  template <class T>
  void pointer(std::string_view name, std::shared_ptr<const T>& p) {
    if (accept_word(name)) p = made<T>();
  }
  template <class T>
  void target(std::string_view, std::shared_ptr<const T>& p) {
    if (!accept_word("nothing")) p = made<T>();
  }
  void label(std::string_view name, LabelRef& l);
  void routine_name(std::string_view name, RoutineName& n);
  void space(std::string_view name, SpaceId& id);
  void setting(ModalSet& x);
  void action(ActionData& data);
  void cycle(std::variant<HoleCycle, NamedCycle>& node);
  void block(Block& b);
  void body(std::string_view name, Body& b, LineInfo& end_line);
  void then_else(If& x);
  void assignments(std::string_view name, std::vector<Assign::Item>& items);
  void arguments(std::string_view name, std::vector<Argument>& list);
  void declared(std::string_view name, std::vector<Declare::Item>& items);
  void cases(std::string_view name, std::vector<std::pair<ExprPtr, Jump>>& list);

 private:
  // --- characters and tokens (parse_text.cpp) ---
  [[nodiscard]] bool ok() const { return !failed_; }
  void fail(const std::string& what);
  void skip_blanks();
  [[nodiscard]] bool at_end() const { return at_ >= text_.size(); }
  [[nodiscard]] char peek_raw(std::size_t ahead = 0) const {
    return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\0';
  }
  char peek() {
    skip_blanks();
    return peek_raw();
  }
  bool accept(std::string_view punctuation);
  bool expect(std::string_view punctuation);
  std::string_view peek_word();
  std::string_view take_word();
  bool accept_word(std::string_view text);
  bool accept_adjacent(char c);
  std::uint16_t blank_lines();
  /// Comments and the line end; what else stands there is a fault. The next line is read afresh.
  bool finish_line(LineInfo* line);

  // --- values, as they stand after their keyword ---
  template <class Int>
  void read_integer(Int& x);
  void read(std::int32_t& x) { read_integer(x); }
  void read(std::int64_t& x) { read_integer(x); }
  void read(std::uint32_t& x) { read_integer(x); }
  void read(std::uint8_t& x) { read_integer(x); }
  void read(double& x);
  void read(std::string& x);
  void read(std::string_view& x);
  void read(Value& x);
  void read(ExprPtr& x) { x = expression(0); }
  void read(VarRef& x);
  template <class E>
  requires std::is_enum_v<E>
  void read(E& x) {
    if (const auto e = enum_value<E>(peek_word())) {
      x = *e;
      take_word();
    } else {
      fail("unknown word");
    }
  }
  template <class T>
  requires std::is_class_v<T>
  void read(T& x) { fields(*this, x); }
  template <class T>
  std::shared_ptr<const T> made() {
    auto p = std::make_shared<T>();
    read(*p);
    return p;
  }

  // --- expressions (parse_text_expr.cpp) ---
  ExprPtr expression(int lowest);
  ExprPtr operand();
  ExprPtr with_suffix(Expr e);
  ExprPtr index();
  void index_list(std::string_view close, std::vector<ExprPtr>& list);
  void number_node(Number& n);
  void call_or_system(std::string_view name, Expr& e);
  bool sign_before_number() const;

  // --- statements and the program (parse_text_statement.cpp, parse_text.cpp) ---
  void line_prefix(LineInfo& line);
  void span(Span& s);
  void block_number(LineInfo& line);
  void labels(LineInfo& line);
  void comments(LineInfo& line);
  bool open_body(LineInfo& line);
  void read_body(Body& b, LineInfo& closing);
  Statement read_statement(LineInfo&& line);
  bool motion_or_action(Block& b);
  void read_routine(LineInfo&& header);
  void read_space();
  void top_line();

  std::string_view text_;
  FileId file_;
  Diagnostics& diagnostics_;
  Program program_;
  std::vector<std::string> handles_;
  std::size_t at_ = 0;
  std::size_t line_start_ = 0;
  std::uint32_t line_ = 1;
  int depth_ = 0;
  bool failed_ = false;
  bool has_places_ = false;
  LineInfo* opening_ = nullptr;
};

}  // namespace cnctrans::ir::detail
