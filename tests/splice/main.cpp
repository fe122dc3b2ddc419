// Splices valid programs of the repository and holds every translation against its source. README.md says how to use
// it.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>

#include "tests/splice/mutate.h"
#include "tests/splice/prove.h"
#include "tests/splice/reduce.h"
#include "tests/splice/watch.h"

namespace cnctrans::splice {

namespace {

constexpr std::array<const char*, 4> dialects = {"fagor", "num", "sinumerik", "heidenhain"};
constexpr std::size_t most_attempts = 40;     ///< until a splice is a valid program
constexpr std::size_t most_questions = 1500;  ///< while a program is cut down

struct Options {
  std::uint64_t seed = 1, seeds = 1;
  std::size_t count = 100, first = 0, shown = 3;
  std::string direction, keep, program, root = CNCTRANS_SOURCE_DIR;
  bool strict = false;

  [[nodiscard]] bool wants(const std::string& from, const std::string& to) const {
    return from != to && (direction.empty() || direction == from + "-" + to);
  }
};

struct Figures {
  std::size_t spliced = 0, valid = 0, written = 0, replayed = 0, equal = 0, foretold = 0, silent = 0;
  std::map<std::string, std::size_t> codes;  ///< of warnings that foretold a difference
};

class Splices {
 public:
  explicit Splices(Options options) : options_(std::move(options)) {}

  int run() {
    for (const std::string from : dialects) {
      if (std::none_of(dialects.begin(), dialects.end(), [&](const auto& to) { return options_.wants(from, to); }))
        continue;
      const auto programs = programs_of(options_.root, from);
      for (std::uint64_t seed = options_.seed; seed < options_.seed + options_.seeds; ++seed) {
        for (std::size_t i = options_.first; i < options_.first + options_.count; ++i) one(programs, from, seed, i);
      }
    }
    print();
    return failed_ ? 1 : 0;
  }

  /// A program of the user's own, cut down.
  int given() {
    const auto dash = options_.direction.find('-');
    Program p;
    p.dialect = options_.direction.substr(0, dash);
    p.lathe = options_.program.find("lathe") != std::string::npos || options_.program.ends_with(".pit");
    p.name = options_.program;
    std::ifstream in(options_.program);
    for (std::string line; std::getline(in, line);) p.lines.push_back(line);
    if (!valid(p)) {
      std::puts("splice: the program can't be read, does not run to its end or moves nothing");
      return 2;
    }
    const std::string to = options_.direction.substr(dash + 1);
    direction(p, to, options_.program, figures_[options_.direction]);
    print();
    return failed_ ? 1 : 0;
  }

 private:
  void one(const std::vector<Program>& programs, const std::string& from, std::uint64_t seed, std::size_t index) {
    const std::string name = "seed " + std::to_string(seed) + " index " + std::to_string(index);
    Program p;
    std::size_t attempts = 0;
    bool good = false;
    for (; attempts < most_attempts && !good; ++attempts) {
      Chance chance(((seed * 100 + attempts) << 32U) + index * 3 + static_cast<std::uint64_t>(from.size() % 3));
      p = spliced(programs, chance);
      begins("reading and running, " + from + " " + name, p.text());
      good = valid(p);
    }
    for (const std::string to : dialects) {
      if (!options_.wants(from, to) || (to == "heidenhain" && p.lathe)) continue;  // it has no lathe
      Figures& f = figures_[from + "-" + to];
      f.spliced += attempts;
      if (!good) continue;
      direction(p, to, from + "-" + to + " " + name, f);
    }
  }

  void direction(const Program& p, const std::string& to, const std::string& name, Figures& f) {
    ++f.valid;
    begins(name, p.text());
    const Outcome found = prove(p, to);
    if (found.fate == Fate::refused) return;
    ++f.written;
    if (found.fate == Fate::not_replayed) return;
    ++f.replayed;
    if (found.fate == Fate::equal) ++f.equal;
    if (found.fate == Fate::foretold) ++f.foretold;
    for (const auto& code : found.codes) ++f.codes[code];
    if (found.fate == Fate::silent) ++f.silent;
    if (found.fate == Fate::silent || (options_.strict && found.fate == Fate::foretold)) fail(p, to, name, found);
  }

  void fail(const Program& p, const std::string& to, const std::string& name, const Outcome& found) {
    failed_ = true;
    std::size_t& shown = kinds_[p.dialect + "-" + to + ": " + found.kind];
    std::printf("splice: %s (%s): %s\n", name.c_str(), p.name.c_str(), found.kind.c_str());
    if (++shown > options_.shown) return;
    const Program small = reduced(
        p,
        [&](const Program& q) {
          begins("cutting down " + name, q.text());
          if (!valid(q)) return false;
          const Outcome o = prove(q, to);
          return o.fate == found.fate && o.kind == found.kind;
        },
        most_questions);
    begins(name, small.text());
    const Outcome last = prove(small, to);
    std::string text = name + ", the smallest program that shows it:\n" + small.text() + "--- shown by\n" +
                       command(small, to) + "\n--- which says\n" + last.said + "\n";
    for (const auto& code : last.codes) text += "--- foretold by " + code + "\n";
    std::printf("%s", text.c_str());
    std::fflush(stdout);
    if (options_.keep.empty()) return;
    std::filesystem::create_directories(options_.keep);
    std::string file = name;
    std::replace(file.begin(), file.end(), ' ', '-');
    std::replace(file.begin(), file.end(), '/', '-');
    std::ofstream(options_.keep + "/" + file + ".txt") << text;
    std::ofstream(options_.keep + "/" + file + "-" + small.file_name()) << small.text();
  }

  void print() const {
    std::printf("%-18s %8s %8s %8s %8s %8s %8s %8s\n", "direction", "spliced", "valid", "written", "replayed", "equal",
                "foretold", "silent");
    for (const auto& [name, f] : figures_) {
      std::printf("%-18s %8zu %8zu %8zu %8zu %8zu %8zu %8zu\n", name.c_str(), f.spliced, f.valid, f.written, f.replayed,
                  f.equal, f.foretold, f.silent);
    }
    std::map<std::string, std::size_t> codes;
    for (const auto& [name, f] : figures_) {
      for (const auto& [code, n] : f.codes) codes[code] += n;
    }
    for (const auto& [code, n] : codes) std::printf("foretold by %s: %zu\n", code.c_str(), n);
    for (const auto& [kind, n] : kinds_) std::printf("%zu x %s\n", n, kind.c_str());
  }

  Options options_;
  std::map<std::string, Figures> figures_;
  std::map<std::string, std::size_t> kinds_;
  bool failed_ = false;
};

}  // namespace

}  // namespace cnctrans::splice

int main(int argc, char** argv) {
  cnctrans::splice::Options o;
  CLI::App app{"splices valid programs and holds every translation against its source"};
  app.add_option("--direction", o.direction, "one direction, such as fagor-num; without it all nine");
  app.add_option("--count", o.count, "valid splices of each seed and direction")->capture_default_str();
  app.add_option("--seed", o.seed, "the (first) seed")->capture_default_str();
  app.add_option("--seeds", o.seeds, "how many seeds, one after the other")->capture_default_str();
  app.add_option("--first", o.first, "the first index: with --count 1 one splice alone");
  app.add_option("--shown", o.shown, "failures of one kind that are cut down")->capture_default_str();
  app.add_option("--keep", o.keep, "folder for the programs that fail, cut down");
  app.add_option("--program", o.program, "instead: this program, in the direction of --direction");
  app.add_option("--root", o.root, "the folder of the repository");
  app.add_flag("--strict", o.strict, "a difference that a warning foretells is a failure too");
  CLI11_PARSE(app, argc, argv);
  cnctrans::splice::watch_for_crashes("splice");
  const auto holds_tests = [](const std::string& root) {
    std::error_code none;
    return std::filesystem::is_directory(root + "/tests/pairs", none);
  };
  if (o.program.empty() && !holds_tests(o.root)) {  // it was built where the repository stands elsewhere
    if (app.count("--root") == 0 && holds_tests(".")) {
      o.root = ".";
    } else {
      std::printf("splice: there are no programs under %s; --root names the folder of the repository\n",
                  o.root.c_str());
      return 2;
    }
  }
  const bool given = !o.program.empty();
  cnctrans::splice::Splices splices(std::move(o));
  return given ? splices.given() : splices.run();
}
