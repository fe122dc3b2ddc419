// What a run of the source has seen before its statements: for a program whose inputs all stand in its text, that is
// all that can be there.
#pragma once

#include <map>

#include "ir/analysis/dataflow.h"

namespace cnctrans::ir::passes {

class SeenFacts {
 public:
  /// Control comes to the statement of the source that stands there, and this holds.
  void visit(const Span& where, const Facts& now);
  /// What the analysis does not know, and every visit has seen the same.
  void complete(const Program& program, FactTable& table) const;

 private:
  struct Before {
    bool operator()(const Span& a, const Span& b) const;
  };
  std::map<Span, Facts, Before> seen_;
};

}  // namespace cnctrans::ir::passes
