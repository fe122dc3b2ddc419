// The support matrix of docs/dialects/heidenhain.md is made from the tables of the dialect. With CNCTRANS_WRITE_DOCS
// set the test writes it.
#include <gtest/gtest.h>

#include "dialects/heidenhain/cycles.h"
#include "dialects/heidenhain/functions.h"
#include "dialects/heidenhain/leads.h"
#include "dialects/heidenhain/m_codes.h"
#include "dialects/heidenhain/old_cycles.h"
#include "dialects/heidenhain/patterns.h"
#include "dialects/heidenhain/sentences.h"
#include "dialects/heidenhain/tilts.h"
#include "dialects/heidenhain/variables.h"
#include "tests/language/matrix.h"

namespace cnctrans {
namespace {

namespace facts = dialects::heidenhain;

constexpr const char* kept_there = "kept as text: a run stops there, a translation refuses it";

/// Support of the cycles with numbered parts that no run carries out.
bool old_cycle_is_kept(facts::OldKind kind) {
  return kind == facts::OldKind::point_file;
}

std::string sentence_table() {
  std::string read, kept;
  for (const auto& s : facts::sentences) {
    using enum facts::Sentence;
    const bool as_text = s.sentence == carried || s.sentence == probe;
    std::string& list = as_text ? kept : read;
    list += (list.empty() ? "`" : ", `") + std::string(s.words) + "`";
  }
  std::string leads, tilts, figures;
  for (const auto& l : facts::leads) leads += (leads.empty() ? "" : " ") + std::string(l.word);
  for (const auto& t : facts::tilts) tilts += (tilts.empty() ? "" : " ") + std::string(t.word);
  for (const auto& f : facts::figures) figures += (figures.empty() ? "" : " ") + std::string(f.word);
  return "| Sentences | Support |\n|---|---|\n| " + read + " | carried |\n| " + kept + " | " + kept_there +
         " |\n| APPR, DEP with " + leads + " | carried: the lines and arcs that they are |\n| PLANE " + tilts +
         " with STAY | carried; with TURN or MOVE about one axis carried, else " + kept_there +
         " |\n| PATTERN DEF with " + figures + " | carried |\n";
}

std::string cycle_table() {
  std::string s = "| Cycle | Title | Called | Support |\n|---|---|---|---|\n";
  const auto row = [&s](int number, std::string_view title, bool called, std::string_view support) {
    s += "| " + std::to_string(number) + " | " + std::string(title) + " | " + (called ? "yes" : "acts at once") +
         " | " + std::string(support) + " |\n";
  };
  for (const auto& c : facts::old_cycles)
    row(c.number, c.title, c.called,
        old_cycle_is_kept(c.kind)             ? kept_there
        : c.kind == facts::OldKind::tolerance ? "kept as text: the programmed path is the same"
                                              : "carried");
  for (const auto& c : facts::cycle_rows) {
    using enum facts::CycleKind;
    row(c.number, c.title, c.called,
        c.kind == facts::CycleKind::carried                  ? std::string(kept_there)
        : c.contours != dialects::heidenhain::Contours::none ? "carried: works on the contours of cycle 14"
        : c.kind == mill                                     ? "carried: `" + std::string(c.name) + "`"
        : c.kind == pattern                                  ? "carried: `" + std::string(c.name) + "`"
                                                             : "carried");
  }
  return s;
}

std::string m_table() {
  std::string s = "| M | Function | Acts | Support |\n|---|---|---|---|\n";
  for (const auto& m : facts::m_codes) {
    using enum facts::MUse;
    const char* support = m.use == tip    ? "run with the positions of the tip (HEI-009); no other control gets it"
                          : m.use == path ? kept_there
                          : m.use == kept ? "kept as text: the path is the same"
                          : m.use == compensated || m.use == rotary_feed ? "left out with a warning"
                          : m.use == retract ? "carried with MB and a distance, in a block of its own"
                                             : "carried";
    s += "| M" + std::to_string(m.code) + " | " + std::string(m.title) + " | " +
         (m.order == ir::Order::after ? "after" : "before") + " | " + support + " |\n";
  }
  return s;
}

std::string fn_table() {
  std::string s = "| FN | Word | Support |\n|---|---|---|\n";
  for (const auto& f : facts::fn_rows) {
    s += "| " + std::to_string(f.number) + " | " + (f.word.empty() ? "=" : std::string(f.word)) + " | " +
         (f.use == facts::FnUse::kept ? "kept as text: the path is the same" : "carried") + " |\n";
  }
  std::string words;
  for (const auto& f : facts::functions) words += std::string(f.word) + " ";
  for (const auto w : {facts::negate_word, facts::fraction_word, facts::sign_word, facts::pi_word})
    words += std::string(w) + " ";
  for (const auto& f : facts::text_functions) words += std::string(f.word) + " ";
  words += std::string(facts::text_order_word) + " ";
  for (const auto& o : facts::operators) words += "`" + std::string(o.text) + "` ";
  return s + "| | formulas: " + words + "`||` | carried |\n";
}

std::string variable_table() {
  std::string s = "| Variables | Meaning | Support |\n|---|---|---|\n";
  for (const auto& r : facts::q_ranges)
    s += "| Q" + std::to_string(r.lo) + "-Q" + std::to_string(r.hi) + " | " + std::string(r.title) + " | carried |\n";
  for (const auto& q : facts::system_q)
    s += "| Q" + std::to_string(q.number) + " | " + std::string(q.title) + " | carried, read only |\n";
  s += "| QL0-QL" + std::to_string(facts::ql_max) + " | of the program at hand | carried |\n| QR0-QR" +
       std::to_string(facts::qr_max) + " | kept when the control is switched off | carried |\n| QS0-QS" +
       std::to_string(facts::qs_max) + " | texts | carried |\n";
  for (const auto& r : facts::system_reads)
    s += "| FN 18 ID" + std::to_string(r.id) + " NR" + std::to_string(r.nr) + " | " + std::string(r.title) +
         " | carried |\n";
  return s + "| FN 18, other IDs | | " + kept_there + " |\n";
}

TEST(SupportMatrix, OfHeidenhainIsTheOneOfTheTables) {
  const std::string made = "\n### Sentences\n\n" + sentence_table() + "\n### Cycles\n\n" + cycle_table() +
                           "\n### M functions\n\n" + m_table() + "\n### Functions\n\n" + fn_table() +
                           "\n### Variables and data\n\n" + variable_table() + "\n";
  expect_support_matrix("heidenhain.md", made);
}

}  // namespace
}  // namespace cnctrans
