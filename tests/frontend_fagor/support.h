// Reads Fagor text from a string and shows it as IR text.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "dialects/options.h"
#include "frontends/fagor/program/frontend.h"
#include "ir/text/text.h"

namespace cnctrans::fagor::test {

struct Reading {
  ir::Program program;
  Diagnostics diagnostics;
  frontends::ReadStats stats;

  /// Statements of a routine, one text each, nested ones in their parent's text.
  [[nodiscard]] std::vector<std::string> statements(std::size_t routine = 0) const {
    std::vector<std::string> out;
    for (const auto& s : program.routines.at(routine).body) {
      std::string t = ir::to_text(s, program);
      while (!t.empty() && t.back() == '\n') t.pop_back();
      out.push_back(std::move(t));
    }
    return out;
  }
  /// Codes of the findings, in order.
  [[nodiscard]] std::string codes() const {
    std::string out;
    for (const auto& d : diagnostics.all()) out += (out.empty() ? "" : " ") + d.code;
    return out;
  }
};

inline Reading read(std::string text, const std::string& profile = "fagor-mill",
                    frontends::Reader reader = frontends::Reader::both, const std::string& name = "000100.PIM") {
  std::string error;
  const auto machine = dialects::load_profile(profile, &error);
  Reading r;
  if (!machine) return r;
  const auto source = SourceText::from_string(name, std::move(text));
  frontends::ReadOptions options;
  options.reader = reader;
  options.profile = &*machine;
  r.program = frontends::fagor::make_frontend()->read(source, 1, options, r.diagnostics, &r.stats);
  r.program.texts->hold(source);
  return r;
}

/// One block as IR text; with the codes of what was found, if anything: `... | FAG-004`.
inline std::string line(const std::string& text, const std::string& profile = "fagor-mill") {
  const Reading r = read(text, profile);
  std::string out;
  for (const auto& s : r.statements()) out += (out.empty() ? "" : "\n") + s;
  const std::string codes = r.codes();
  return codes.empty() ? out : out + " | " + codes;
}

}  // namespace cnctrans::fagor::test
