// The support matrix of docs/dialects/num.md is made from the code tables and the registry of missing features. With
// CNCTRANS_WRITE_DOCS set the test writes it.
#include <gtest/gtest.h>

#include "dialects/num/gcodes.h"
#include "dialects/num/mcodes.h"
#include "dialects/num/variables.h"
#include "dialects/num/words.h"
#include "ir/check/missing_features.h"
#include "tests/language/matrix.h"

namespace cnctrans {
namespace {

namespace facts = dialects::num;

std::string reason(std::string_view key) {
  return "refused: " + std::string(ir::missing_feature(key).title) + " (`" + std::string(key) + "`)";
}

std::string refused_because(std::int16_t code, std::string_view key) {
  EXPECT_FALSE(facts::g_reason(code).empty()) << "G" << code << " is refused without a reason";
  return "refused: " + std::string(facts::g_reason(code)) + " (`" + std::string(key) + "`)";
}

std::string g_table() {
  std::string s = "| G | Function | Machine | Reference | Support |\n|---|---|---|---|---|\n";
  for (const auto& g : facts::g_codes) {
    const auto missing = facts::missing_feature(g);
    const auto remark = facts::g_remark(g.code);
    const char* machine = g.machine == facts::GMachine::both   ? ""
                          : g.machine == facts::GMachine::mill ? "mill"
                                                               : "lathe";
    s += "| G" + std::to_string(g.code) + " | " + std::string(g.title) + " | " + machine + " | " +
         std::string(g.section) + " | " +
         (!missing.empty()  ? refused_because(g.code, missing)
          : !remark.empty() ? "carried; " + std::string(remark)
                            : "carried") +
         " |\n";
  }
  s += "| G" + std::to_string(facts::g_macro_first) + "-G" + std::to_string(facts::g_macro_last) +
       " | macro %10xxx of the machine | | 13.7 | carried when the file brings the macro along, else " +
       reason("language.macro") + " |\n";
  return s;
}

std::string m_table() {
  std::string s = "| M | Function | Acts |\n|---|---|---|\n";
  for (const auto& m : facts::m_codes) {
    s += "| M" + std::to_string(m.code) + " | " + std::string(m.title) + " | " +
         (m.order == ir::Order::after ? "after" : "before") + " |\n";
  }
  return s;
}

std::string e_table() {
  std::string s = "| Parameter | Meaning | Access | Unit | Support |\n|---|---|---|---|---|\n";
  for (const auto& e : facts::e_parameters) {
    const char* unit = e.unit == facts::EUnit::none     ? ""
                       : e.unit == facts::EUnit::length ? "0.001 mm"
                                                        : "0.001 mm or 0.0001 degrees";
    const std::string support = e.meaning == facts::EMeaning::machine
                                    ? "value from the profile's data or --set (else RUN-044); writing: NUM-044"
                                : e.meaning == facts::EMeaning::tool_note ? "kept as a number (NUM-041)"
                                : e.meaning == facts::EMeaning::display   ? "kept as text, no effect (NUM-034)"
                                                                          : "carried";
    s += "| E" + std::to_string(e.lo) + (e.hi == e.lo ? "" : "-E" + std::to_string(e.hi)) +
         (e.step == 1 ? "" : " in steps of " + std::to_string(e.step)) + " | " + std::string(e.title) + " | " +
         (e.writable ? "read, write" : "read") + " | " + unit + " | " + support + " |\n";
  }
  return s;
}

std::string statement_table() {
  std::string carried, refused;
  for (const auto w : facts::statement_words) carried += (carried.empty() ? "`" : " `") + std::string(w) + "`";
  for (const auto w : facts::carried_words) refused += (refused.empty() ? "`" : " `") + std::string(w) + "`";
  return "| Words | Support |\n|---|---|\n| " + carried + " | carried (10xx and later) |\n| " + refused + " | " +
         reason("language.statement") + " |\n";
}

TEST(SupportMatrix, OfNumIsTheOneOfTheTables) {
  const std::string made = "\n### G functions\n\n" + g_table() + "\n### M functions\n\n" + m_table() +
                           "\n### Statements\n\n" + statement_table() + "\n### E parameters\n\n" + e_table() +
                           "\n### Options of a machine profile\n\n" + option_table("num.") + "\n";
  expect_support_matrix("num.md", made);
}

}  // namespace
}  // namespace cnctrans
