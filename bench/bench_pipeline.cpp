// Micro benchmarks of the hot path: scanning, lowering, running and writing plain blocks.
#include <benchmark/benchmark.h>

#include <fmt/format.h>

#include <cmath>

#include "dialects/options.h"
#include "frontends/common/word_scanner.h"
#include "interpreter/program/interpreter.h"
#include "translator/files/registry.h"

namespace {

using namespace cnctrans;

std::vector<std::string> cam_lines(int count) {
  std::vector<std::string> lines;
  for (int i = 0; i < count; ++i) {
    const double a = 0.01 * i;
    lines.push_back(fmt::format("N{} G1 X{:.3f} Y{:.3f} Z{:.3f}{}", 5 * i + 5, 50 * std::cos(a), 50 * std::sin(a),
                                -0.001 * i, i % 50 == 0 ? " F1000" : ""));
  }
  return lines;
}

struct Setup {
  const translator::Dialect* from = translator::find_dialect("fagor");
  const translator::Dialect* to = translator::find_dialect("sinumerik");
  machine::Profile source, target;
  std::vector<std::string> lines = cam_lines(10000);
  Setup() {
    std::string error;
    source = *dialects::load_profile("fagor-mill", &error);
    target = *dialects::load_profile("sinumerik-mill", &error);
  }
};
const Setup& setup() {
  static const Setup s;
  return s;
}

void count(benchmark::State& state) {
  std::size_t bytes = 0;
  for (const auto& l : setup().lines) bytes += l.size() + 1;
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(setup().lines.size()));
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(bytes));
}

void read_blocks(benchmark::State& state) {
  const frontends::ReadOptions options{frontends::Reader::scanner, &setup().source};
  ir::Statement statement;
  for (auto _ : state) {
    const auto reader = setup().from->frontend->stream(1, options, "bench.pim");
    Diagnostics diagnostics;
    std::uint32_t number = 0;
    for (const auto& l : setup().lines)
      benchmark::DoNotOptimize(reader->read(SourceLine{l, ++number, Eol::lf, true}, statement, diagnostics));
  }
  count(state);
}
BENCHMARK(read_blocks);

void read_and_run_blocks(benchmark::State& state) {
  const frontends::ReadOptions options{frontends::Reader::scanner, &setup().source};
  ir::Statement statement;
  for (auto _ : state) {
    const auto reader = setup().from->frontend->stream(1, options, "bench.pim");
    Diagnostics diagnostics;
    interpreter::TraceCounter sink;
    interpreter::BlockRunner runner(setup().source, {}, sink, diagnostics);
    std::uint32_t number = 0;
    for (const auto& l : setup().lines) {
      reader->read(SourceLine{l, ++number, Eol::lf, true}, statement, diagnostics);
      runner.step(statement);
    }
    benchmark::DoNotOptimize(sink.count);
  }
  count(state);
}
BENCHMARK(read_and_run_blocks);

}  // namespace

BENCHMARK_MAIN();
