// Holds every known fact of the analysis against the run, in the programs of the repository and in splices of them.
// README.md says how to use it.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <string>

#include "tests/facts/hold.h"
#include "tests/splice/mutate.h"
#include "tests/splice/reduce.h"

namespace cnctrans::facts {

namespace {

constexpr std::size_t most_questions = 800;  ///< while a program is cut down

struct Options {
  std::string dialect, program, root = CNCTRANS_SOURCE_DIR;
  std::uint64_t seed = 1;
  std::size_t count = 1000, first = 0, shown = 2;
};

class Facts {
 public:
  explicit Facts(Options o) : options_(std::move(o)) {}

  int run() {
    for (const std::string dialect : {"fagor", "num", "sinumerik", "heidenhain"}) {
      if (!options_.dialect.empty() && options_.dialect != dialect) continue;
      const auto programs = splice::programs_of(options_.root, dialect);
      if (options_.first == 0) {
        for (const auto& p : programs) one(p, p.name);
      }
      for (std::size_t i = options_.first; i < options_.first + options_.count; ++i) {
        splice::Chance chance((options_.seed << 32U) + i);
        one(splice::spliced(programs, chance), "seed " + std::to_string(options_.seed) + " index " + std::to_string(i));
      }
    }
    print();
    return kinds_.empty() ? 0 : 1;
  }

 private:
  void one(const splice::Program& p, const std::string& name) {
    const Held held = hold(p, &shares_);
    ran_ += held.ran ? 1 : 0;
    for (const auto& u : held.untrue) {
      std::size_t& n = kinds_[p.dialect + " " + u.domain];
      std::printf("facts: %s %s (%s): line %u: %s is said to be %s and is %s\n", p.dialect.c_str(), name.c_str(),
                  p.name.c_str(), u.line, u.domain.c_str(), u.said.c_str(), u.seen.c_str());
      if (++n <= options_.shown) show(p, u);
    }
  }

  static void show(const splice::Program& p, const Untrue& u) {
    const auto still = [&](const splice::Program& q) {
      for (const auto& v : hold(q, nullptr).untrue) {
        if (v.domain == u.domain) return true;
      }
      return false;
    };
    const splice::Program small = splice::reduced(p, still, most_questions);
    std::printf("%s", small.text().c_str());
    for (const auto& v : hold(small, nullptr).untrue) {
      if (v.domain == u.domain)
        std::printf("--- line %u: %s is said to be %s and is %s\n", v.line, v.domain.c_str(), v.said.c_str(),
                    v.seen.c_str());
    }
    std::fflush(stdout);
  }

  void print() const {
    std::printf("%zu programs held\n%-20s %10s %8s %22s\n", ran_, "fact", "asked", "known", "one value, not known");
    for (const auto& [domain, s] : shares_) {
      const double all = static_cast<double>(s.asked) / 100;
      std::printf("%-20s %10zu %7.1f%% %21.1f%%\n", domain.c_str(), s.asked, static_cast<double>(s.known) / all,
                  static_cast<double>(s.needless) / all);
    }
    for (const auto& [kind, n] : kinds_) std::printf("%zu x %s\n", n, kind.c_str());
  }

  Options options_;
  Shares shares_;
  std::map<std::string, std::size_t> kinds_;
  std::size_t ran_ = 0;
};

}  // namespace

}  // namespace cnctrans::facts

int main(int argc, char** argv) {
  cnctrans::facts::Options o;
  CLI::App app{"holds the facts of the analysis against the run"};
  app.add_option("--dialect", o.dialect, "one language; without it all four");
  app.add_option("--count", o.count, "splices beside the programs of the repository")->capture_default_str();
  app.add_option("--seed", o.seed, "of the splices")->capture_default_str();
  app.add_option("--first", o.first, "the first index: with --count 1 one splice alone");
  app.add_option("--shown", o.shown, "untrue facts of one kind that are cut down")->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  return cnctrans::facts::Facts(std::move(o)).run();
}
