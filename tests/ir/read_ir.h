// Programs for tests, from the textual IR.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "ir/text/text.h"

namespace cnctrans::ir {

/// The program of a text (the `program` line may be left out), its statements numbered from 1 in text order.
inline Program read_ir(const std::string& text) {
  Diagnostics diagnostics;
  Program p = from_text(text, 1, diagnostics);
  for (const auto& d : diagnostics.all()) ADD_FAILURE() << "line " << d.span.line << ": " << d.message;
  number_statements(p);
  return p;
}

/// A main routine of these lines; P and R are spaces of variables.
inline Program read_main(const std::string& lines) {
  return read_ir("space R \"R\" segment 0 99\nspace P \"P\" segment 0 99\nroutine main 1 {\n" + lines + "}\n");
}

}  // namespace cnctrans::ir
