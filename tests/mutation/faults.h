// One fault in the text of a translation.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tests/splice/chance.h"

namespace cnctrans::mutation {

using Lines = std::vector<std::string>;

/// Some lines that follow each other become others.
struct Fault {
  std::string kind;
  Lines before, after;
  std::size_t at = 0;  ///< line of the first of `before`, from 0
};

/// The kinds of faults, in the order of the table.
const std::vector<std::string>& kinds();

/// A fault of a kind in a program of a language; nullopt: the program has no place for one.
std::optional<Fault> fault(const std::string& kind, const Lines& lines, const std::string& dialect, bool lathe,
                           splice::Chance& chance);

/// The lines with the fault in them: at its place, else where `before` stands first. nullopt: nowhere.
std::optional<Lines> with_fault(const Lines& lines, const Fault& fault);

}  // namespace cnctrans::mutation
