// Reads NUM text and gives the IR as text: one statement a line, without places.
#pragma once

#include <string>
#include <string_view>

#include "base/source.h"
#include "dialects/options.h"
#include "frontends/num/program/frontend.h"
#include "ir/text/text.h"

namespace cnctrans::frontends::num::testing {

struct Outcome {
  ir::Program program;
  std::string codes;     ///< codes of the diagnostics, with blanks between
  std::string messages;  ///< rendered
};

inline machine::Profile profile(const std::string& name) {
  std::string error;
  return dialects::load_profile(name, &error).value_or(machine::Profile{});
}

inline Outcome read(std::string_view text, const machine::Profile& p, Reader reader = Reader::both) {
  Outcome o;
  FileTable files;
  const SourcePtr source = SourceText::from_string("7.xpi", std::string(text));
  const FileId file = files.add(source);
  Diagnostics d;
  o.program = make_frontend()->read(source, file, {reader, &p}, d, nullptr);
  for (const auto& x : d.all()) o.codes += (o.codes.empty() ? "" : " ") + x.code;
  o.messages = render_text(d, files);
  return o;
}
inline Outcome read(std::string_view text, const std::string& machine_name = "num-mill") {
  return read(text, profile(machine_name));
}

/// The body of the main program as text.
inline std::string body(const Outcome& o) {
  std::string s;
  for (const auto& r : o.program.routines) {
    for (const auto& st : r.body) s += ir::to_text(st, o.program) + "\n";
  }
  return s;
}

}  // namespace cnctrans::frontends::num::testing
