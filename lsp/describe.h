// A block in words: what it does, what its cycle is told, what holds before it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "ir/analysis/dataflow.h"
#include "ir/program.h"

namespace cnctrans::lsp {

struct DescribeContext {
  const ir::Program& program;
  const ir::Facts& facts;  ///< before the statement
  std::string_view line;   ///< its text, for expressions as they are written
  bool diameter = false;   ///< X words are diameters on this machine
};
std::string value_text(const ir::Value& value, const DescribeContext& context);
/// One sentence each, in the order in which they happen.
std::vector<std::string> describe(const ir::Statement& statement, const DescribeContext& context);
std::vector<std::string> describe_cycle(const ir::Cycle& cycle, const DescribeContext& context);
/// "G1, plane XY, absolute, mm, F200, X10 Y20": what holds before it.
std::string describe_facts(const DescribeContext& context);

}  // namespace cnctrans::lsp
