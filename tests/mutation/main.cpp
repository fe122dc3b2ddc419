// Puts faults into translations that verify and asks the verifier. README.md says how to use it.
#include <CLI/CLI.hpp>
#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>

#include "tests/language/markdown.h"
#include "tests/mutation/by_hand.h"
#include "tests/mutation/documented.h"
#include "tests/mutation/trial.h"
#include "tests/splice/reduce.h"
#include "tests/splice/watch.h"

namespace cnctrans::mutation {

namespace {

using splice::Chance;
using splice::Program;

constexpr std::array<const char*, 3> dialects = {"fagor", "num", "sinumerik"};
constexpr int most_attempts = 200;           ///< until a fault has a place
constexpr std::size_t most_questions = 800;  ///< while a survivor is cut down

struct Options {
  std::uint64_t seed = 1;
  std::size_t count = 500, first = 0, shown = 3;
  std::string direction, kind, keep, root = CNCTRANS_SOURCE_DIR;
  bool by_hand = false, documented = false;

  [[nodiscard]] bool wants(const std::string& from, const std::string& to) const {
    return from != to && (direction.empty() || direction == from + "-" + to);
  }
};

struct Figures {
  std::size_t nothing = 0, no_run = 0, caught = 0, documented = 0, undocumented = 0;

  void add(Fate f) {
    if (f == Fate::nothing) ++nothing;
    if (f == Fate::no_run) ++no_run;
    if (f == Fate::caught) ++caught;
    if (f == Fate::documented) ++documented;
    if (f == Fate::undocumented) ++undocumented;
  }
  void add(const Figures& f) {
    nothing += f.nothing;
    no_run += f.no_run;
    caught += f.caught;
    documented += f.documented;
    undocumented += f.undocumented;
  }
};

std::string edit_of(const Fault& f) {
  std::string text;
  for (const auto& line : f.before) text += "- " + line + "\n";
  for (const auto& line : f.after) text += "+ " + line + "\n";
  return text;
}

class Mutations {
 public:
  explicit Mutations(Options options) : options_(std::move(options)) {}

  int run() {
    const auto missing = missing_sentences(testing::read_file(options_.root + "/docs/verify.md"));
    for (const auto& sentence : missing) std::printf("mutation: docs/verify.md does not say: %s\n", sentence.c_str());
    for (const std::string from : dialects) {
      for (const std::string to : dialects) {
        if (!options_.wants(from, to)) continue;
        if (programs_.empty() || programs_.front().dialect != from)
          programs_ = splice::programs_of(options_.root, from);
        translations_.clear();
        for (std::size_t i = options_.first; i < options_.first + options_.count; ++i) one(to, i);
      }
    }
    print();
    return missing.empty() && undocumented_ == 0 ? 0 : 1;
  }

 private:
  const std::optional<Translated>& translation(const Program& p, const std::string& to) {
    const auto [it, is_new] = translations_.try_emplace(p.name + "\n" + p.text());
    if (is_new) {
      splice::begins("translating " + p.name + " for " + to, p.text());
      it->second = translated(p, to);
    }
    return it->second;
  }

  void one(const std::string& to, std::size_t index) {
    Chance chance((options_.seed << 32U) + index);
    for (int attempt = 0; attempt < most_attempts; ++attempt) {
      const Program& p = splice::pick(programs_, chance.draw());
      const std::string kind = options_.kind.empty() ? chance.of(kinds()) : options_.kind;
      const std::uint64_t draw = chance.draw();
      const auto& t = translation(p, to);
      if (!t) continue;
      Chance own(draw);
      const auto f = fault(kind, t->lines, to, p.lathe, own);
      if (!f) continue;
      const std::string name =
          p.dialect + "-" + to + " seed " + std::to_string(options_.seed) + " index " + std::to_string(index);
      splice::begins(name + ": " + kind, text_of(*with_fault(t->lines, *f)));
      const Outcome o = tried(*t, *f);
      figures_[kind].add(o.fate);
      for (const auto& a : o.aspects) {
        if (o.fate == Fate::documented) ++aspects_[a];
      }
      if (o.fate == Fate::undocumented || (options_.documented && o.fate == Fate::documented)) show(*t, *f, o, name);
      return;
    }
  }

  void show(const Translated& t, const Fault& f, const Outcome& found, const std::string& name) {
    if (found.fate == Fate::undocumented) ++undocumented_;
    std::string about = found.what;
    for (const auto& a : found.aspects) about += " " + a;
    std::printf("mutation: %s (%s): %s passes: %s\n", name.c_str(), t.source.name.c_str(), f.kind.c_str(),
                about.c_str());
    std::printf("%s", edit_of(f).c_str());
    if (++shown_[about] > options_.shown) return;
    const auto again = [&](const Program& q) -> std::optional<std::pair<Translated, Outcome>> {
      splice::begins("cutting down " + name, q.text());
      const auto small = translated(q, t.to);
      if (!small) return std::nullopt;
      Outcome o = tried(*small, f);
      if (o.fate != found.fate || o.what != found.what) return std::nullopt;
      return std::pair(*small, o);
    };
    const Program least = splice::reduced(
        t.source, [&](const Program& q) { return again(q).has_value(); }, most_questions);
    const auto last = again(least);
    const Translated& shown = last ? last->first : t;
    const auto mutant = with_fault(shown.lines, f);
    std::string text =
        shown.source.text() + "--- the translation\n" + text_of(shown.lines) + "--- the fault\n" + edit_of(f);
    text += "--- shown by\n" + command(shown) + "\n--- which says\n" + (last ? last->second.said : found.said) + "\n";
    std::printf("%s", text.c_str());
    std::fflush(stdout);
    if (options_.keep.empty()) return;
    std::string folder = options_.keep + "/" + name;
    std::replace(folder.begin(), folder.end(), ' ', '-');
    std::filesystem::create_directories(folder);
    std::ofstream(folder + "/" + shown.source.file_name()) << shown.source.text();
    std::ofstream(folder + "/" + shown.file) << text_of(*mutant);
    std::ofstream(folder + "/shown.txt") << text;
  }

  void print() const {
    const auto row = [](const std::string& name, const Figures& f) {
      std::printf("%-18s %8zu %8zu %8zu %10zu %12zu\n", name.c_str(), f.nothing, f.no_run, f.caught, f.documented,
                  f.undocumented);
    };
    std::printf("%-18s %8s %8s %8s %10s %12s\n", "fault", "nothing", "no run", "caught", "documented", "undocumented");
    Figures all;
    for (const auto& kind : kinds()) {
      const auto it = figures_.find(kind);
      if (it == figures_.end()) continue;
      row(kind, it->second);
      all.add(it->second);
    }
    row("all", all);
    const auto counted = static_cast<double>(all.caught + all.documented + all.undocumented);
    if (counted > 0)
      std::printf(
          "of the faults that change something and run: caught %.2f %%, documented %.2f %%, undocumented %.2f %%\n",
          100 * static_cast<double>(all.caught) / counted, 100 * static_cast<double>(all.documented) / counted,
          100 * static_cast<double>(all.undocumented) / counted);
    for (const auto& [aspect, n] : aspects_) std::printf("documented, %s: %zu\n", aspect.c_str(), n);
    for (const auto& [what, n] : shown_) std::printf("%zu x %s\n", n, what.c_str());
  }

  Options options_;
  std::vector<Program> programs_;
  std::map<std::string, std::optional<Translated>> translations_;
  std::map<std::string, Figures> figures_;
  std::map<std::string, std::size_t> aspects_, shown_;
  std::size_t undocumented_ = 0;
};

}  // namespace

}  // namespace cnctrans::mutation

int main(int argc, char** argv) {
  cnctrans::mutation::Options o;
  std::string only;
  CLI::App app{"puts faults into translations that verify and asks the verifier"};
  app.add_option("--direction", o.direction, "one direction, such as fagor-num; without it all six");
  app.add_option("--count", o.count, "faults of each direction")->capture_default_str();
  app.add_option("--seed", o.seed, "the seed")->capture_default_str();
  app.add_option("--first", o.first, "the first index: with --count 1 one fault alone");
  app.add_option("--kind", o.kind, "only faults of this kind");
  app.add_option("--shown", o.shown, "survivors of one kind that are cut down")->capture_default_str();
  app.add_option("--keep", o.keep, "folder for the survivors, cut down");
  app.add_option("--root", o.root, "the folder of the repository");
  app.add_flag("--documented", o.documented, "documented survivors are shown too");
  app.add_flag("--by-hand", o.by_hand, "instead: the faults of by-hand/");
  app.add_option("--only", only, "with --by-hand: files whose name has this in it");
  CLI11_PARSE(app, argc, argv);
  cnctrans::splice::watch_for_crashes("mutation");
  if (o.by_hand) return cnctrans::mutation::by_hand(o.root, only) == 0 ? 0 : 1;
  return cnctrans::mutation::Mutations(std::move(o)).run();
}
