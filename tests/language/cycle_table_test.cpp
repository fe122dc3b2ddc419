// docs/cycles.md: every cycle of every language and what becomes of it in the other ones. The rows are those of the
// code tables; what becomes of a cycle is seen by translating a program of tests/catalogue with it. With
// CNCTRANS_WRITE_DOCS set the test writes the page.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>

#include "base/text.h"
#include "dialects/fagor/cycles.h"
#include "dialects/fagor/g_codes.h"
#include "dialects/num/gcodes.h"
#include "dialects/options.h"
#include "dialects/sinumerik/cycles.h"
#include "ir/check/missing_features.h"
#include "ir/cycles/pattern.h"
#include "tests/language/markdown.h"
#include "translator/files/registry.h"
#include "translator/pipeline.h"

namespace cnctrans {
namespace {

namespace fs = std::filesystem;

struct CycleEntry {
  std::string dialect, name, machine, what, missing;  ///< `missing`: key of a feature that is not carried
};

std::vector<CycleEntry> fagor_cycles() {
  namespace facts = dialects::fagor;
  std::vector<CycleEntry> out;
  for (const auto& g : facts::g_codes()) {
    const bool cycle = g.use == facts::Use::hole_cycle || g.use == facts::Use::machining ||
                       g.use == facts::Use::pattern || g.use == facts::Use::pocket || g.feature.starts_with("cycle.");
    if (!cycle) continue;
    for (const auto model : {facts::Model::mill, facts::Model::lathe}) {
      if (g.model != model && g.model != facts::Model::both) continue;
      out.push_back({"fagor", "G" + std::to_string(g.code), model == facts::Model::mill ? "mill" : "lathe",
                     std::string(g.title), std::string(g.feature)});
    }
  }
  return out;
}

std::vector<CycleEntry> num_cycles() {
  namespace facts = dialects::num;
  std::vector<CycleEntry> out;
  for (const auto& g : facts::g_codes) {
    if (g.kind != facts::GKind::hole_cycle && g.kind != facts::GKind::turning_cycle &&
        g.kind != facts::GKind::milling_cycle)
      continue;
    out.push_back({"num", "G" + std::to_string(g.code), g.machine == facts::GMachine::lathe ? "lathe" : "mill",
                   std::string(g.title), std::string(facts::missing_feature(g))});
  }
  return out;
}

std::vector<CycleEntry> sinumerik_cycles() {
  namespace facts = cnctrans::sinumerik;
  const auto family = [](facts::CycleFamily f) -> std::pair<std::string, std::string> {
    switch (f) {
      case facts::CycleFamily::drilling: return {"drilling", "cycle.hole"};
      case facts::CycleFamily::pattern: return {"positions", "cycle.pattern"};
      case facts::CycleFamily::milling: return {"milling", "cycle.milling"};
      case facts::CycleFamily::turning: return {"turning", "cycle.turning"};
      case facts::CycleFamily::swivel: return {"swivelling", "motion.transformation"};
      case facts::CycleFamily::measuring: break;
    }
    return {"measuring", "motion.probe"};
  };
  std::vector<CycleEntry> out;
  for (const auto& c : facts::cycles()) {
    const auto [title, feature] = family(c.family);
    out.push_back({"sinumerik", std::string(c.name), c.family == facts::CycleFamily::turning ? "lathe" : "mill", title,
                   c.carried || c.family == facts::CycleFamily::swivel ? std::string() : feature});
  }
  return out;
}

std::vector<std::string> values_of(const testing::Section& s, const std::string& key) {
  std::vector<std::string> found;
  for (const auto& line : s.lines) {
    if (line.rfind(key + ":", 0) == 0) found.emplace_back(trim(line.substr(key.size() + 1)));
  }
  return found;
}

/// A further program of a cycle, with other words: "G68 lathe, with a recess".
bool is_further(const testing::Section& s) {
  return s.heading.find(" mill, ") != std::string::npos || s.heading.find(" lathe, ") != std::string::npos;
}

/// The program for the cycle: its own of tests/cycles, else one of the catalogue whose name ends in the cycle's, else
/// the first that has it.
const testing::Section* program_for(const CycleEntry& c, const std::vector<testing::Section>& sections) {
  const bool call = c.dialect == "sinumerik";
  const std::string number = c.name.substr(call ? 0 : 1);
  const std::regex token(call ? "\\b" + c.name + "\\s*\\(" : "(^|[^A-Z])G0*" + number + "(?![0-9])", std::regex::icase);
  const testing::Section* first = nullptr;
  for (const auto& s : sections) {
    if (s.heading == c.name + " " + c.machine) return &s;
    if (s.heading.ends_with(" mill") || s.heading.ends_with(" lathe") || is_further(s)) continue;
    const auto machines = values_of(s, "machine");
    const bool lathe = !machines.empty() && machines[0].ends_with("-lathe");
    if (lathe != (c.machine == "lathe") || !values_of(s, "refuses").empty() || !std::regex_search(s.fence, token))
      continue;
    const std::string id = s.heading.substr(0, s.heading.find(' '));
    const std::string capitals = to_upper_ascii(id);
    if (capitals.ends_with("." + c.name)) return &s;
    if (first == nullptr) first = &s;
  }
  return first;
}

/// A cycle, or a pattern of positions, stands in the program.
bool has_cycle(const ir::Program& program, bool pattern) {
  bool found = false;
  const auto look = [&](const ir::CyclePtr& cycle) {
    if (!cycle) return;
    const auto* named = std::get_if<ir::NamedCycle>(&cycle->node);
    found = found || (named != nullptr && ir::cycles::find_pattern(named->name) != nullptr) == pattern;
  };
  for (const auto& r : program.routines) {
    ir::for_each_statement(r.body, [&](const ir::Statement& s) {
      if (const auto* m = std::get_if<ir::ModalCall>(&s.node)) look(m->cycle);
      const auto* b = std::get_if<ir::Block>(&s.node);
      for (std::size_t i = 0; b != nullptr && i < b->actions.size(); ++i) {
        if (const auto* d = std::get_if<ir::CycleDefine>(&b->actions[i].data)) look(d->cycle);
      }
    });
  }
  return found;
}

ir::Program read(const translator::Dialect& dialect, const std::string& text, const machine::Profile& profile) {
  FileTable files;
  Diagnostics d;
  const SourcePtr source = SourceText::from_string("7.txt", text);
  return dialect.frontend->read(source, files.add(source), {{}, &profile}, d, nullptr);
}

class CycleTable : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("cnctrans-cycles-" + std::to_string(getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  /// "native", "native, other passes", "written out", or "refused" with its code.
  std::string becomes(const CycleEntry& c, const testing::Section& s, const translator::Dialect& to) {
    std::string error;
    auto profile = dialects::load_profile(c.dialect + "-" + c.machine, &error);
    if (!profile) return error;
    for (const auto& o : values_of(s, "option"))
      if (!dialects::options().set(*profile, trim(o.substr(0, o.find('='))), trim(o.substr(o.find('=') + 1)), &error))
        return error;
    for (const auto& o : values_of(s, "data"))
      profile->data[std::string(trim(o.substr(0, o.find('='))))] = *parse_decimal(trim(o.substr(o.find('=') + 1)));
    for (const auto& o : values_of(s, "nose_width")) {
      machine::Tool tool;
      tool.number = 1;
      tool.nose_width = *parse_decimal(o);
      profile->tools = {tool};
    }
    const std::string machine = (folder_ / "machine.json").string();
    std::ofstream(machine) << machine::to_json(*profile);
    const auto& from = *translator::find_dialect(c.dialect);
    const auto& endings =
        c.machine == "lathe" && !from.lathe_extensions.empty() ? from.lathe_extensions : from.mill_extensions;
    const std::string file =
        (folder_ / ("000100." + (endings.empty() ? std::string("mpf") : std::string(endings[0])))).string();
    std::ofstream(file, std::ios::binary) << s.fence;
    translator::TranslateOptions options;
    options.from = c.dialect;
    options.to = to.name;
    options.machine = machine;
    options.single_output = true;
    const auto result = translator::translate(file, options);
    if (!result.error.empty()) return result.error;
    if (result.refused) {
      for (const auto& d : result.diagnostics.all()) {
        if (d.severity == Severity::error) return "refused (" + d.code + ")";
      }
      return "refused";
    }
    const auto& all = result.diagnostics.all();
    const bool other_passes = std::any_of(all.begin(), all.end(), [](const auto& d) { return d.code == "TRN-415"; });
    const bool pattern = has_cycle(read(from, s.fence, *profile), true);
    const auto target = dialects::load_profile(std::string(to.name) + "-" + c.machine, &error);
    if (!target) return error;
    for (const auto& o : result.outputs) {
      if (has_cycle(read(to, o.bytes, *target), pattern)) return other_passes ? "native, other passes" : "native";
    }
    return "written out";
  }

  std::string table(const std::vector<CycleEntry>& cycles, const std::vector<const translator::Dialect*>& languages) {
    const auto& from = *translator::find_dialect(cycles.front().dialect);
    std::vector<testing::Section> sections;
    const std::string tests = CNCTRANS_SOURCE_DIR "/tests/";
    auto files = testing::files_below(tests + "catalogue/" + std::string(from.name), {".md"});
    files.insert(files.begin(), tests + "cycles/" + std::string(from.name) + ".md");
    for (const auto& p : files) {
      if (!fs::exists(p)) continue;
      for (auto& s : testing::read_markdown(p)) {
        if (s.level == 2 && s.has_fence) sections.push_back(std::move(s));
      }
    }
    std::string s = "## " + std::string(from.title) + "\n\n| Cycle | Machine | What | Program |",
                rule = "|---|---|---|---|";
    for (const auto* to : languages) {
      if (to->name == from.name) continue;
      s += " in " + std::string(to->title) + " |";
      rule += "---|";
    }
    s += "\n" + rule + "\n";
    const auto row = [&](const CycleEntry& c, const std::string& what, const testing::Section* program) {
      const bool own = program != nullptr && program->heading.rfind(c.name + " " + c.machine, 0) == 0;
      s += "| " + c.name + " | " + c.machine + " | " + what + " | ";
      s += (program == nullptr ? std::string("-")
            : own              ? std::string("tests/cycles")
                               : program->heading.substr(0, program->heading.find(' '))) +
           " |";
      for (const auto* to : languages) {
        if (to->name == from.name) continue;
        s += " " + (program == nullptr ? "kept as text, refused (`" + c.missing + "`)" : becomes(c, *program, *to)) +
             " |";
      }
      s += "\n";
    };
    for (const auto& c : cycles) {
      row(c, c.what, c.missing.empty() ? program_for(c, sections) : nullptr);
      const std::string own = c.name + " " + c.machine + ", ";
      for (const auto& further : sections) {
        if (further.heading.rfind(own, 0) == 0) row(c, further.heading.substr(own.size()), &further);
      }
    }
    return s + "\n";
  }

  fs::path folder_;
};

TEST_F(CycleTable, OfTheDocumentationIsWhatTranslationsShow) {
  std::vector<const translator::Dialect*> languages;
  for (const auto& d : translator::dialects()) {
    if (d.frontend && d.backend) languages.push_back(&d);
  }
  std::string made;
  for (const auto& cycles : {fagor_cycles(), num_cycles(), sinumerik_cycles()}) made += table(cycles, languages);
  const std::string path = CNCTRANS_SOURCE_DIR "/docs/cycles.md";
  const std::string text = testing::read_file(path);
  const std::string begin = "<!-- begin of the table -->\n", end = "<!-- end of the table -->\n";
  const auto from = text.find(begin), to = text.find(end);
  ASSERT_TRUE(from != std::string::npos && to != std::string::npos && from < to);
  made = "\n" + made;
  if (std::getenv("CNCTRANS_WRITE_DOCS") != nullptr) {  // NOLINT(concurrency-mt-unsafe)
    std::ofstream(path, std::ios::binary) << text.substr(0, from + begin.size()) << made << text.substr(to);
    return;
  }
  EXPECT_EQ(text.substr(from + begin.size(), to - from - begin.size()), made)
      << "run this test with CNCTRANS_WRITE_DOCS=1 to write the table";
}

}  // namespace
}  // namespace cnctrans
