#include "frontends/sinumerik/context.h"

#include "dialects/sinumerik/limits.h"

namespace cnctrans::sinumerik {

MachineFacts::MachineFacts(const machine::Profile& p) : profile(&p) {
  axis_of.fill(ir::axis::none);
  for (const auto& a : p.axes) {
    if (a.name.size() == 1 && a.name[0] >= 'A' && a.name[0] <= 'Z') axis_of[static_cast<std::size_t>(a.name[0] - 'A')] = a.id;
  }
  for (const auto& m : p.m_codes) {
    if (m.code >= 0 && m.code < m_limit) m_codes[static_cast<std::size_t>(m.code)] = &m;
  }
  tool_word_changes = p.option("sinumerik.tool_change", "m6") == "immediate";
  undefined_names_are_global = p.option("sinumerik.undefined_names", "error") == "global";
}

ir::AxisId MachineFacts::axis(char letter) const {
  const char capital = letter >= 'a' && letter <= 'z' ? static_cast<char>(letter - 'a' + 'A') : letter;
  return capital >= 'A' && capital <= 'Z' ? axis_of[static_cast<std::size_t>(capital - 'A')] : ir::axis::none;
}

ir::AxisId MachineFacts::axis(std::string_view name) const {
  if (name.size() == 1) return axis(name[0]);
  for (const auto& a : profile->axes) {
    if (a.name == name) return a.id;
  }
  return ir::axis::none;
}

std::vector<ir::VariableSpace> make_spaces() {
  const auto named = [](ir::Scope scope, ir::Type type) {
    ir::VariableSpace s;
    s.scope = scope;
    s.type = type;
    s.starts_at_zero = scope == ir::Scope::routine;
    return s;
  };
  ir::VariableSpace r;
  r.prefix = "R";
  ir::SpaceSegment segment;
  segment.lo = 0;
  segment.hi = r_parameter_max;
  r.segments.push_back(segment);
  return {std::move(r),
          named(ir::Scope::routine, ir::Type::real),
          named(ir::Scope::routine, ir::Type::integer),
          named(ir::Scope::routine, ir::Type::boolean),
          named(ir::Scope::routine, ir::Type::string),
          named(ir::Scope::routine, ir::Type::axis),
          named(ir::Scope::global, ir::Type::real),
          named(ir::Scope::global, ir::Type::integer),
          named(ir::Scope::global, ir::Type::boolean),
          named(ir::Scope::global, ir::Type::string)};
}

std::optional<ir::SpaceId> space_of(ir::Type type, bool global) {
  switch (type) {
    case ir::Type::real: return global ? space::global_real : space::real;
    case ir::Type::integer: return global ? space::global_integer : space::integer;
    case ir::Type::boolean: return global ? space::global_boolean : space::boolean;
    case ir::Type::string: return global ? space::global_string : space::string;
    case ir::Type::axis:
      if (!global) return space::axis;
      return std::nullopt;
    case ir::Type::frame: break;
  }
  return std::nullopt;
}

void FileContext::error(std::string_view code, WordPos pos, std::string message, std::string hint) {
  ++errors;
  diagnostics.error(code, word_span(line, pos), std::move(message), std::move(hint));
}
void FileContext::warning(std::string_view code, WordPos pos, std::string message, std::string hint) {
  diagnostics.warning(code, word_span(line, pos), std::move(message), std::move(hint));
}
void FileContext::note(std::string_view code, WordPos pos, std::string message, std::string hint) {
  diagnostics.note(code, word_span(line, pos), std::move(message), std::move(hint));
}
std::string_view FileContext::slice(WordPos pos) const {
  if (pos.column == 0 || pos.column > text.size()) return {};
  return text.substr(pos.column - 1, pos.length);
}

}  // namespace cnctrans::sinumerik
