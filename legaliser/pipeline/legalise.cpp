#include "legaliser/legalise.h"

#include <algorithm>

#include "ir/edit/lines.h"
#include "legaliser/pipeline/pipeline.h"

namespace cnctrans::ir {

namespace {

bool run(const Pass& pass, Program& program, const LegaliseContext& context) {
  const std::size_t before = context.diagnostics.error_count();
  pass.run(program, context);
  return context.diagnostics.error_count() == before;
}

const Pass* find_pass(std::string_view name) {
  const auto passes = pipeline();
  const auto it = std::find_if(passes.begin(), passes.end(), [name](const Pass& p) { return p.name == name; });
  return it != passes.end() ? &*it : nullptr;
}

}  // namespace

bool legalise(Program& program, const LegaliseContext& context) {
  std::set<const char*> source_numbers;
  for (const auto& r : program.routines) {
    passes::each_line(r.body, [&](const LineInfo& line) {
      if (!line.number.empty()) source_numbers.insert(line.number.data());
    });
  }
  LegaliseContext numbered = context;
  numbered.source_numbers = &source_numbers;
  bool good = true;
  for (const Pass& pass : pipeline()) {
    if (!context.options.only.empty() && pass.name != context.options.only) continue;
    good = run(pass, program, numbered) && good;
    if (context.behind_pass) context.behind_pass(pass.name, program);
  }
  number_statements(program);
  return good;
}

bool is_pass(std::string_view name) {
  return find_pass(name) != nullptr;
}

bool run_pass(std::string_view name, Program& program, const LegaliseContext& context) {
  const Pass* pass = find_pass(name);
  return pass != nullptr && run(*pass, program, context);
}

}  // namespace cnctrans::ir
