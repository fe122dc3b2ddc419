// A program for the Fagor writer, read from "elsewhere" unless said otherwise; and Fagor text read and written again.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "backends/fagor/backend.h"
#include "base/source.h"
#include "dialects/options.h"
#include "frontends/fagor/program/frontend.h"
#include "machine/profile.h"
#include "tests/support/build_ir.h"

namespace cnctrans::test {

inline machine::Profile profile_of(const std::string& name) {
  std::string error;
  auto loaded = dialects::load_profile(name, &error);
  EXPECT_TRUE(loaded) << error;
  return loaded ? *loaded : machine::Profile{};
}

inline std::string codes_of(const Diagnostics& diagnostics) {
  std::string all;
  for (const Diagnostic& d : diagnostics.all()) all += (all.empty() ? "" : " ") + d.code;
  return all;
}

struct Build {
  ir::Program program;
  backends::WriteOptions options;
  machine::Profile profile;
  Diagnostics diagnostics;

  explicit Build(const std::string& machine = "fagor-mill") : profile(profile_of(machine)) {
    program.dialect = "elsewhere";
    program.lathe = profile.kind == machine::Kind::lathe;
    program.spaces = backends::fagor::make_backend()->capabilities().spaces;
    program.routines.emplace_back();
    program.routines[0].name.text = "PART";
    options.main_stem = "000100";
  }
  ir::Body& body() { return program.routines.back().body; }
  template <class Node>
  ir::Statement& add(Node node) {
    ir::Statement s;
    s.node = std::move(node);
    body().push_back(std::move(s));
    return body().back();
  }
  ir::Routine& routine(std::int64_t number, std::string text = {}) {
    program.routines.emplace_back();
    program.routines.back().kind = ir::RoutineKind::sub;
    program.routines.back().name = {number, std::move(text)};
    return program.routines.back();
  }
  std::vector<backends::OutputFile> files() {
    options.profile = &profile;
    ir::number_statements(program);
    return backends::fagor::make_backend()->write(program, options, diagnostics);
  }
  std::string text() { return files().front().text; }
  /// Without the header and the M30 that ends a program without an end.
  std::string lines() {
    std::string t = text();
    t.erase(0, t.find('\n') + 1);
    if (t.size() >= 4 && t.substr(t.size() - 4) == "M30\n") t.erase(t.size() - 4);
    return t;
  }
  [[nodiscard]] std::string codes() const { return codes_of(diagnostics); }
};

/// The lines of one block; a finding fails the test.
inline std::string lines_of(ir::Block block, const std::string& machine = "fagor-mill") {
  Build b(machine);
  b.add(std::move(block));
  std::string text = b.lines();
  EXPECT_TRUE(b.diagnostics.empty()) << b.codes();
  return text;
}
inline std::string lines_of(ir::Action a, const std::string& machine = "fagor-mill") {
  return lines_of(actions({std::move(a)}), machine);
}
/// The codes of the findings of one block that can't be said.
inline std::string refused(ir::Block block, const std::string& machine = "fagor-mill") {
  Build b(machine);
  b.add(std::move(block));
  (void)b.text();
  EXPECT_TRUE(b.diagnostics.has_errors());
  return b.codes();
}

inline ir::ExprPtr P(std::int64_t n) {
  return ir::numbered(0, n);
}

/// Fagor text, read and written again.
struct Rewrite {
  std::string text;
  std::string file;
  std::string codes;
};
inline Rewrite rewrite(std::string text, const std::string& machine = "fagor-mill",
                       const std::string& name = "000100.PIM") {
  const machine::Profile profile = profile_of(machine);
  const auto source = SourceText::from_string(name, std::move(text));
  frontends::ReadOptions read;
  read.profile = &profile;
  Diagnostics diagnostics;
  const ir::Program program = frontends::fagor::make_frontend()->read(source, 1, read, diagnostics, nullptr);
  backends::WriteOptions write;
  write.profile = &profile;
  write.main_stem = source->stem();
  const auto files = backends::fagor::make_backend()->write(program, write, diagnostics);
  return {files.at(0).text, files.at(0).name, codes_of(diagnostics)};
}

}  // namespace cnctrans::test
