// What the functions of texts give: one meaning for a run and for a pass that knows the text.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "ir/expr.h"

namespace cnctrans::ir {

/// A number as a text shows it.
std::string number_text(double value);
/// The number that a text writes, also with an exponent: 1234.5EX-7.
std::optional<double> number_in(std::string_view text);
/// Lengths, places, codes and numbers: functions that make a number of a text, and of a second one where they search.
/// nullopt: it is no such function, or the text writes no number.
std::optional<double> number_of_text(Function f, std::string_view text, std::string_view second);
/// From character `start` (0: the first) on, `length` of them at most; neither is negative.
std::string part_of_text(std::string_view text, double start, double length);
std::string lower_case_text(std::string text);
/// Up to the first character 0, which ends a text wherever it stands.
std::string ended_text(std::string text);
std::string joined_text(std::string left, std::string_view right);
/// The text of one character: for code 0 the mark that ends a text. nullopt: no code of a character.
std::optional<std::string> character_text(double code);

/// The text of a tree that has only literals; a number in it is shown. nullopt: it depends on more.
std::optional<std::string> constant_text(const ExprPtr& e);
/// A node over literal texts or axes that gives a number or a truth value; nullopt: it is none.
std::optional<double> constant_of_texts(const ExprPtr& e);

}  // namespace cnctrans::ir
