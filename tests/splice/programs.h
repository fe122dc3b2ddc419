// The programs that are spliced: those of the tests and of the examples, as lists of lines.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace cnctrans::splice {

struct Program {
  std::string dialect;
  bool lathe = false;
  std::string name;  ///< where it comes from
  std::vector<std::string> lines;
  std::uint64_t mark = 0;  ///< of its name, for pick()

  [[nodiscard]] std::string text() const;
  [[nodiscard]] std::string machine() const { return dialect + (lathe ? "-lathe" : "-mill"); }
  [[nodiscard]] std::string file_name() const;
};

/// One of them at random, the same one for the same draw as long as it is there: a program that is added is drawn now
/// and then, and all other draws stay.
const Program& pick(const std::vector<Program>& programs, std::uint64_t draw);

/// Every program of a language in tests/pairs, tests/identity, tests/golden, tests/catalogue and examples below `root`.
std::vector<Program> programs_of(const std::string& root, const std::string& dialect);

/// The snippet of a pair in the frame of a program.
Program framed(const std::string& dialect, bool lathe, const std::string& snippet);

/// Lines that frame a program or a part of it: headers, ends, definitions. They stay as they are.
bool frames(std::string_view line);

/// A line taken apart: `/2 N10 G0 X5`.
struct LineParts {
  std::string skip, number, rest;
};
LineParts parts_of(std::string_view line);
std::string joined(const LineParts& parts);

}  // namespace cnctrans::splice
