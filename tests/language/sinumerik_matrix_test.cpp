// The support matrix of docs/dialects/sinumerik.md is made from the tables of the dialect and the registry of missing
// features. With CNCTRANS_WRITE_DOCS set the test writes it.
#include <gtest/gtest.h>

#include <map>

#include "dialects/sinumerik/addresses.h"
#include "dialects/sinumerik/asked.h"
#include "dialects/sinumerik/beside.h"
#include "dialects/sinumerik/cycles.h"
#include "dialects/sinumerik/g_functions.h"
#include "dialects/sinumerik/operators.h"
#include "ir/check/missing_features.h"
#include "tests/language/matrix.h"

namespace cnctrans {
namespace {

namespace facts = cnctrans::sinumerik;

std::string reason(std::string_view key) {
  const auto& feature = ir::missing_feature(key);
  return "kept as text, refused where it would run or be translated: " + std::string(feature.title) + "; " +
         std::string(feature.reason) + " (`" + std::string(key) + "`)";
}

constexpr const char* beside_path = "acts beside the programmed path, see below";

std::string use_of(const facts::GFunction& g) {
  using enum facts::GUse;
  if (facts::beside(g.name, facts::BesideForm::code) != nullptr) return beside_path;
  switch (g.use) {
    case unsupported: return reason(facts::missing_feature(g));
    case own_block:
      return g.number == 751
                 ? "carried as G0 and G75 (SIN-102)"
                 : "kept; the blocks behind it up to G290 are kept as text, and a run stops there (SIN-103)";
    case timing: return "kept as text: the programmed path is the same";
    case compensation: return "kept as text: acts on the compensated path only";
    case joint: return "run as a straight move to the programmed end (SIN-045); no other control gets it";
    case tool_frame:
      return "carried where the text tells where the tool points (SIN-052); else kept as text, and a run stops there";
    case table_frame:
      return "carried where no carrier is selected, or with the data of its table (SIN-141); else kept as text, and a "
             "run "
             "stops there";
    case inclined: return "carried behind TRAANG with its angle, positions absolute (SIN-134)";
    case path: return g.b != 0 ? "carried as continuous path; the rounding is not (SIN-019)" : "carried";
    case limit: return "carried for spindles; limits of the working area are kept as text";
    case suppress: return "carried for straight moves";
    case approach: return g.number == 75 ? "carried; the machine profile gives the points (`fixed_points`)" : "carried";
    default: return "carried";
  }
}

std::string g_table() {
  std::string s = "| Code | Group | Support |\n|---|---|---|\n";
  for (const auto& g : facts::g_functions()) {
    s += "| " + std::string(g.name) + " | " + std::to_string(g.group) + (g.modal ? "" : " (block)") + " | " +
         use_of(g) + " |\n";
  }
  s += "| G505-G599 | 8 | carried |\n";
  return s;
}

std::string word_table() {
  std::string s = "| Word | Support |\n|---|---|\n";
  for (const auto& w : facts::named_words()) {
    using enum facts::NamedWord;
    s += "| " + std::string(w.name) + "= | " +
         (w.use == unsupported    ? reason("block.word")
          : w.use == orientation  ? "kept as text, a run passes over it; no other control gets it"
          : w.use == joint        ? "kept as text: says how the programmed end is reached; no other control gets it"
          : w.use == timing       ? "kept as text: the programmed path is the same"
          : w.use == compensation ? "kept as text: acts on the compensated path or the tool length only"
                                  : "carried") +
         " |\n";
  }
  s += "| POS[] POSA[] FA[] AX[] IP[] SPOS[] S[] LIMS[] G[8]= | carried |\n";
  return s;
}

bool is_surface(std::string_view name) {
  return name == "TRANSMIT" || name == "TRACYL" || name == "TRAFOOF";
}

std::string procedure_table() {
  std::string s = "| Procedure | Support |\n|---|---|\n";
  for (const auto& p : facts::procedures()) {
    using enum facts::Procedure;
    s += "| " + std::string(p.name) + " | " +
         (p.use == unsupported                 ? reason(facts::procedure_missing_feature(p.name))
          : p.use == timing || p.use == screen ? "kept as text: the programmed path is the same"
          : is_surface(p.name)                 ? "carried: work with the C axis (SIN-041)"
          : p.use == transformation ? "a run goes on with the programmed positions; no other control gets it (SIN-041)"
          : p.use == coordination   ? "kept as text, a run passes over it; no other control gets it (SIN-042)"
                                    : "carried") +
         " |\n";
  }
  std::map<std::string_view, std::string> rest;  // by what is missing
  for (const auto& n : facts::predefined_names()) {
    auto& names = rest[facts::procedure_missing_feature(n)];
    names += (names.empty() ? "" : " ") + std::string(n);
  }
  for (const auto& [feature, names] : rest) s += "| " + names + " | " + reason(feature) + " |\n";
  return s;
}

std::string beside_table() {
  using enum facts::BesideForm;
  std::string s = "| Word | Written as | Feature |\n|---|---|---|\n";
  for (const auto& r : facts::beside_rows()) {
    std::string forms;
    const auto add = [&](facts::BesideForm f, std::string_view text) {
      if ((r.forms & static_cast<std::uint8_t>(f)) != 0) forms += (forms.empty() ? "" : ", ") + std::string(text);
    };
    add(procedure, "procedure");
    add(address, "address");
    add(indexed, "address of an axis");
    add(code, "G function");
    s += "| " + std::string(r.name) + " | " + forms + (r.gives_back ? ", no variable as an argument" : "") + " | " +
         (r.idle ? "defines, ends, looks or counts: a remark in a translation" : "`" + std::string(r.feature) + "`") +
         " |\n";
  }
  for (const auto& d : facts::definitions())
    s += "| " + std::string(d.begin) + " to " + std::string(d.end) +
         " | blocks that define | "
         "a remark in a translation |\n";
  return s;
}

std::string function_table() {
  std::string s = "| Function | Arguments | Result |\n|---|---|---|\n";
  for (const auto& f : facts::functions) {
    s += "| " + std::string(f.name) + " | " + std::to_string(f.arguments_min) +
         (f.arguments_max == f.arguments_min ? "" : "-" + std::to_string(f.arguments_max)) + " | " +
         std::string(ir::name(f.result)) + " |\n";
  }
  for (const auto& f : facts::asked_functions) {
    s += "| " + std::string(f.name) + " | " + std::to_string(f.arguments_min) +
         (f.arguments_max == f.arguments_min ? "" : "-" + std::to_string(f.arguments_max)) +
         " | answered by the profile or --set (SIN-015) |\n";
  }
  for (const auto& n : facts::axis_and_frame_functions()) s += "| " + std::string(n) + " | | axis or frame |\n";
  return s;
}

TEST(SupportMatrix, OfSinumerikIsTheOneOfTheTables) {
  const std::string made = "\n### G functions and named functions\n\n" + g_table() + "\n### Addresses\n\n" +
                           word_table() + "\n### Procedures\n\n" + procedure_table() +
                           "\n### Words beside the programmed path\n\n" + beside_table() + "\n### Functions\n\n" +
                           function_table() + "\n### Options of a machine profile\n\n" + option_table("sinumerik.") +
                           "\n";
  expect_support_matrix("sinumerik.md", made);
}

}  // namespace
}  // namespace cnctrans
