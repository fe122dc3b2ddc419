// How the kinds of faults are made: of words, and of blocks.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/text.h"
#include "tests/mutation/faults.h"
#include "tests/mutation/words.h"

namespace cnctrans::mutation {

using splice::Chance;

struct Place {
  const Lines& lines;
  const std::string& dialect;
  bool lathe;
  Chance& chance;

  [[nodiscard]] const std::string& any(std::size_t& at) const {
    at = chance.below(lines.size());
    return lines[at];
  }
  [[nodiscard]] bool comment(const std::string& line) const {
    const auto text = trim(line);
    return text.empty() || text.front() == ';' || (dialect == "num" && text.front() == '(');
  }
};
using Maybe = std::optional<Fault>;

constexpr int most_looks = 60;  ///< for a line where a fault has a place

std::string put(const std::string& line, std::size_t from, std::size_t end, const std::string& text);
/// nullopt: nothing is changed.
Maybe changed(std::size_t at, const std::string& line, std::string now);
Maybe inserted(const Place& p, std::size_t at, std::string line);
/// One of the names, which blanks separate.
bool among(const std::string& name, std::string_view names);

// Of words.
using Fits = std::function<bool(const Word&)>;
bool geometric(const Word& w);
bool any_word(const Word& w);
std::string number(double v);
double number_of(const std::string& text);
std::string other_value(const std::string& text, Chance& chance);
std::string other_sign(const std::string& text, Chance& chance);
/// The number of a word of one of the lines becomes another text.
Maybe value(const Place& p, const Fits& fits, const std::function<std::string(const std::string&, Chance&)>& other);
/// A code of one of `codes` becomes another one of them, goes, or comes where none is.
Maybe code(const Place& p, const char* letter, const std::vector<int>& codes);
Maybe without_word(const Place& p, const Fits& fits);

// Of blocks.
Maybe order(const Place& p);
Maybe missing_block(const Place& p);
Maybe doubled_block(const Place& p);
Maybe inserted_way(const Place& p);
Maybe label(const Place& p);
Maybe count(const Place& p);
Maybe cycle_value(const Place& p);
Maybe cycle_without(const Place& p);
Maybe cycle_with(const Place& p);
Maybe message(const Place& p);
Maybe dwell(const Place& p);
Maybe expression(const Place& p);
Maybe skip_mark(const Place& p);

}  // namespace cnctrans::mutation
