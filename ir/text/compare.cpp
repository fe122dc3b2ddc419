// Two programs are the same when their printed forms are, places, files and the language they came from left out.
#include "ir/text/text.h"
#include "ir/text/text_printer.h"

namespace cnctrans::ir {
namespace {

/// What is compared of the program besides its routines.
std::string frame_text(const Program& p) {
  Program frame;
  frame.spaces = p.spaces;
  frame.axis_names = p.axis_names;
  frame.unit_hint = p.unit_hint;
  frame.lathe = p.lathe;
  return to_text(frame);
}

std::string routine_text(const Program& p, const Routine& r) {
  Routine copy = r;
  copy.file = 0;
  detail::Printer printer(p, {});
  printer.routine(copy);
  return std::move(printer.out);
}

std::string_view take_text_line(std::string_view& text) {
  const auto end = text.find('\n');
  const auto line = text.substr(0, end);
  text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  return line;
}

std::string_view trimmed(std::string_view line) {
  const auto first = line.find_first_not_of(' ');
  return first == std::string_view::npos ? std::string_view{} : line.substr(first);
}

bool same_text(std::string_view a, std::string_view b, const std::string& place, std::string* where) {
  if (a == b) return true;
  if (where == nullptr) return false;
  std::size_t number = 0;
  std::string_view line_a;
  std::string_view line_b;
  while (line_a == line_b && !(a.empty() && b.empty())) {
    ++number;
    line_a = take_text_line(a);
    line_b = take_text_line(b);
  }
  const auto shown = [](std::string_view line) {
    return line.empty() ? std::string("an empty line") : std::string(trimmed(line));
  };
  *where = place + ", line " + std::to_string(number) + ": " + shown(line_a) + " | " + shown(line_b);
  return false;
}

}  // namespace

bool same_program(const Program& a, const Program& b, std::string* where) {
  if (!same_text(frame_text(a), frame_text(b), "program", where)) return false;
  for (std::size_t i = 0; i < a.routines.size() && i < b.routines.size(); ++i) {
    const auto& name = a.routines[i].name;
    const std::string place = "routine " + (name.text.empty() ? std::to_string(name.number) : name.text);
    if (!same_text(routine_text(a, a.routines[i]), routine_text(b, b.routines[i]), place, where)) return false;
  }
  if (a.routines.size() == b.routines.size()) return true;
  if (where != nullptr) {
    *where = std::to_string(a.routines.size()) + " routines | " + std::to_string(b.routines.size()) + " routines";
  }
  return false;
}

}  // namespace cnctrans::ir
