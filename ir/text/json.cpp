// JSON form of a program, for tools. Every field of every node is there, under the names of ir/fields.h.
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/source.h"
#include "base/text.h"
#include "ir/fields_statement.h"
#include "ir/text/enum_names.h"
#include "ir/text/text.h"
#include "ir/text/text_names.h"

namespace cnctrans::ir {
namespace detail {
namespace {

using Json = nlohmann::ordered_json;

class JsonWriter {
 public:
  explicit JsonWriter(const Program& program) : program_(program) {}

  Json out = Json::object();

  Json program();

  // --- visitor of fields() ---
  void word(std::string_view) {}
  template <class T>
  void item(std::string_view name, const T& x) {
    set(name, value(x));
  }
  template <class T, class D = T>
  void opt(std::string_view name, const T& x, const D& = D{}) {
    set(name, value(x));
  }
  template <class E>
  void bare(std::string_view name, E x, E) {
    set(name, value(x));
  }
  void flag(std::string_view name, bool x) { set(name, x); }
  void flag_off(std::string_view, std::string_view name, bool x) { set(name, x); }
  template <class T>
  void given(std::string_view name, bool has, const T& x) {
    if (has) set(name, value(x));
  }
  void axis(std::string_view name, AxisId id) { set(name, axis_text(program_, id)); }
  void axis_opt(std::string_view name, AxisId id) { axis(name, id); }
  void pos(WordPos p) { place("pos", p); }
  void place(std::string_view name, WordPos p) {
    if (p != WordPos{}) set(name, Json::array({p.column, p.length}));
  }
  void quoted(std::string_view name, std::string_view text) { set(name, value(text)); }
  void code(bool is_explicit, std::string_view text) {
    set("explicit_code", is_explicit);
    set("code_text", value(text));
  }
  template <class T>
  void words(std::string_view name, const std::vector<T>& list) {
    set(name, array(list));
  }
  template <class T>
  void each(std::string_view name, const std::vector<T>& list) {
    set(name, array(list));
  }
  void exprs(std::string_view name, const std::vector<ExprPtr>& list) { set(name, array(list)); }
  void pairs(std::string_view name, const std::vector<std::pair<std::string, Value>>& list) {
    Json a = Json::array();
    for (const auto& [key, x] : list) a.push_back(Json::array({value(key), value(x)}));
    set(name, std::move(a));
  }
  template <class T>
  void group(std::string_view name, const T& x) {
    set(name, value(x));
  }
  template <class P>
  void pointer(std::string_view name, const P& p) {
    set(name, p ? value(*p) : Json(nullptr));
  }
  template <class P>
  void target(std::string_view name, const P& p) {
    pointer(name, p);
  }
  void label(std::string_view name, const LabelRef& l) {
    set(name, Json{{"text", value(l.text)}, {"is_number", l.is_number}, {"computed", value(l.computed)}});
  }
  void routine_name(std::string_view name, const RoutineName& n) {
    set(name, Json{{"number", n.number}, {"text", value(n.text)}});
  }
  void space(std::string_view name, SpaceId id) { set(name, id); }
  void setting(const ModalSet& x) {
    set("setting", value(x.setting));
    const auto text = setting_value_name(x.setting, x.value);
    set("value", text.empty() ? Json(x.value) : value(text));
  }
  void action(const ActionData& data) {
    set("kind", action_names[data.index()]);
    std::visit([this](const auto& x) { fields(*this, x); }, data);
  }
  void cycle(const std::variant<HoleCycle, NamedCycle>& node) {
    set("cycle", node.index() == 0 ? "hole" : "named");
    std::visit([this](const auto& x) { fields(*this, x); }, node);
  }
  void block(const Block& b) {
    set("actions", array(b.actions));
    if (b.has_motion) set("motion", value(b.motion));
    if (b.repeat_given != 0) set("repeat", value(b.repeat));
  }
  void body(std::string_view name, const Body& b, const LineInfo& end_line) {
    set(name, array(b));
    set("end_line", value(end_line));
  }
  void then_else(const If& x) {
    set("then", array(x.then_body));
    const bool has_else = x.has_else || !x.else_body.empty();
    set("has_else", has_else);
    if (has_else) {
      set("else", array(x.else_body));
      set("else_line", value(x.else_line));
    }
    set("end_line", value(x.end_line));
  }
  void assignments(std::string_view name, const std::vector<Assign::Item>& items);
  void arguments(std::string_view name, const std::vector<Argument>& list) { set(name, array(list)); }
  void declared(std::string_view name, const std::vector<Declare::Item>& items);
  void cases(std::string_view name, const std::vector<std::pair<ExprPtr, Jump>>& list);

 private:
  void set(std::string_view name, Json x) { out[std::string(name)] = std::move(x); }
  static Json value(std::string_view text) { return to_utf8(text); }
  static Json value(const std::string& text) { return to_utf8(text); }
  static Json value(double x) { return std::isfinite(x) ? Json(x) : Json(shortest(x)); }
  static Json value(bool x) { return x; }
  static Json value(std::uint8_t x) { return x; }
  static Json value(std::int32_t x) { return x; }
  static Json value(std::uint32_t x) { return x; }
  static Json value(std::int64_t x) { return x; }
  template <class E>
  requires std::is_enum_v<E>
  static Json value(E x) { return Json(std::string(enum_name(x))); }
  Json value(const Value& v) const {
    if (v.expr) return value(v.expr);
    Json j{{"number", value(v.number)}};
    if (!v.text.empty()) j["text"] = value(v.text);
    return j;
  }
  Json value(const ExprPtr& e) const;
  Json value(const VarRef& v) const;
  Json value(const SystemRef& s) const;
  Json value(const LineInfo& line) const;
  Json value(const Statement& s) const;
  template <class T>
  requires std::is_class_v<T> Json value(const T& x)
  const {
    JsonWriter other(program_);
    fields(other, x);
    return std::move(other.out);
  }
  template <class T>
  Json array(const std::vector<T>& list) const {
    Json a = Json::array();
    for (const auto& x : list) a.push_back(value(x));
    return a;
  }

  const Program& program_;
};

Json JsonWriter::value(const VarRef& v) const {
  Json j{{"space", v.space}};
  if (v.space < program_.spaces.size()) j["prefix"] = value(program_.spaces[v.space].prefix);
  if (!v.name.empty()) j["name"] = value(v.name);
  if (v.index) j["index"] = value(v.index);
  if (!v.indices.empty()) j["indices"] = array(v.indices);
  return j;
}

Json JsonWriter::value(const SystemRef& s) const {
  Json j{{"datum", value(s.datum)}, {"axis", axis_text(program_, s.axis)}, {"text", value(s.text)}};
  if (!s.args.empty()) j["args"] = array(s.args);
  if (s.given) j["given"] = true;
  return j;
}

Json JsonWriter::value(const ExprPtr& e) const {
  if (!e) return nullptr;
  Json j;
  if (const auto* n = std::get_if<Number>(&e->node)) {
    j = Json{{"number", value(n->value)}, {"text", value(n->text)}, {"integer", n->integer}};
  } else if (const auto* s = std::get_if<String>(&e->node)) {
    j = Json{{"string", value(s->text)}};
  } else if (const auto* a = std::get_if<AxisName>(&e->node)) {
    j = Json{{"axis", axis_text(program_, a->axis)}};
  } else if (const auto* v = std::get_if<VarRef>(&e->node)) {
    j = Json{{"variable", value(*v)}};
  } else if (const auto* y = std::get_if<SystemRef>(&e->node)) {
    j = Json{{"system", value(*y)}};
  } else if (const auto* u = std::get_if<Unary>(&e->node)) {
    j = Json{{"unary", value(u->op)}, {"operand", value(u->operand)}};
  } else if (const auto* b = std::get_if<Binary>(&e->node)) {
    j = Json{{"binary", value(b->op)}, {"left", value(b->left)}, {"right", value(b->right)}};
    j["compare"] = value(b->compare);
  } else if (const auto* c = std::get_if<Call>(&e->node)) {
    j = Json{{"call", value(c->function)}, {"args", array(c->args)}, {"half", value(c->half)}};
  }
  j["type"] = value(e->type);
  if (e->pos != WordPos{}) j["pos"] = Json::array({e->pos.column, e->pos.length});
  return j;
}

Json JsonWriter::value(const LineInfo& line) const {
  Json j = Json::object();
  const Span& s = line.span;
  if (s != Span{}) j["span"] = Json::array({s.file, s.line, s.column, s.end_line, s.end_column});
  if (!line.number.empty()) {
    j["number"] = value(line.number);
    j["mark"] = std::string(1, line.number_mark);
  }
  if (!line.labels.empty()) j["labels"] = array(line.labels);
  if (line.skip_mask != 0) j["skip_mask"] = line.skip_mask;
  for (const auto& c : line.comments) {
    Json comment{{"text", value(c.text)}, {"place", value(c.place)}};
    if (c.pos != WordPos{}) comment["pos"] = Json::array({c.pos.column, c.pos.length});
    j["comments"].push_back(std::move(comment));
  }
  if (line.joined) j["joined"] = true;
  if (line.blank_lines_before != 0) j["blank_lines_before"] = line.blank_lines_before;
  return j;
}

Json JsonWriter::value(const Statement& s) const {
  JsonWriter other(program_);
  other.set("kind", statement_names[s.node.index()]);
  other.set("line", value(s.line));
  std::visit([&other](const auto& x) { fields(other, x); }, s.node);
  return std::move(other.out);
}

void JsonWriter::assignments(std::string_view name, const std::vector<Assign::Item>& items) {
  Json a = Json::array();
  for (const auto& it : items) {
    Json j = it.to_system ? Json{{"system", value(it.system)}} : Json{{"target", value(it.target)}};
    j["value"] = value(it.value);
    if (it.pos != WordPos{}) j["pos"] = Json::array({it.pos.column, it.pos.length});
    a.push_back(std::move(j));
  }
  set(name, std::move(a));
}

void JsonWriter::declared(std::string_view name, const std::vector<Declare::Item>& items) {
  Json a = Json::array();
  for (const auto& it : items) {
    a.push_back(Json{{"name", value(it.name)}, {"dimensions", array(it.dimensions)}, {"initial", array(it.initial)}});
  }
  set(name, std::move(a));
}

void JsonWriter::cases(std::string_view name, const std::vector<std::pair<ExprPtr, Jump>>& list) {
  Json a = Json::array();
  for (const auto& [key, jump] : list) a.push_back(Json{{"case", value(key)}, {"jump", value(jump)}});
  set(name, std::move(a));
}

Json JsonWriter::program() {
  fields(*this, program_);
  set("axis_names", array(program_.axis_names));
  set("spaces", array(program_.spaces));
  set("files", array(program_.files));
  Json routines = Json::array();
  for (const auto& r : program_.routines) {
    Json j = value(r);
    j["header"] = value(r.header);
    j["body"] = array(r.body);
    routines.push_back(std::move(j));
  }
  set("routines", std::move(routines));
  return std::move(out);
}

}  // namespace
}  // namespace detail

std::string to_json(const Program& program) {
  return detail::JsonWriter(program).program().dump(1);
}

}  // namespace cnctrans::ir
