#include <algorithm>
#include <cstdio>

#include <fmt/format.h>

#include "base/text.h"
#include "cli/common.h"
#include "dialects/options.h"
#include "ir/text/text.h"
#include "legaliser/pipeline/pipeline.h"
#include "translator/files/loader.h"
#include "translator/files/readable.h"
#include "translator/files/registry.h"

namespace cnctrans::cli {

int verify(const Arguments& a) {
  translator::TranslateOptions options;
  if (!translate_options(a, options)) return usage;
  if (a.inputs.size() < 2) return usage_error(a, "verify takes the source program and its translation");
  std::vector<translator::Input> targets;
  for (auto it = a.inputs.begin() + 1; it != a.inputs.end(); ++it) targets.push_back(input_of(a, *it));
  const auto result = translator::verify(input_of(a, a.inputs.front()), targets, options);
  if (!result.error.empty()) return usage_error(a, result.error);
  a.messages->add(result.source_diagnostics, result.source_files);
  a.messages->add(result.target_diagnostics, result.target_files);
  const std::string text = verifier::describe(result.verdict, result.source_files, result.target_files) + "\n";
  write_all(stdout, text);
  return exit_of(result.verdict);
}

int check(const Arguments& a) {
  translator::RunOptions options;
  if (!run_options(a, options)) return usage;
  if (a.inputs.empty()) return usage_error(a, "check takes at least one file");
  int status = ok;
  for (const auto& input : a.inputs) {
    const auto result = translator::check(input_of(a, input), options);
    if (!result.error.empty()) {
      status = usage_error(a, result.error);
      continue;
    }
    a.messages->add(result.diagnostics, result.files);
    if (!a.quiet) {
      const auto& s = result.stats;
      std::printf("%s: %llu lines, %llu blocks, %llu read, %zu errors, %zu warnings\n", input.c_str(),
                  static_cast<unsigned long long>(s.lines), static_cast<unsigned long long>(s.blocks),
                  static_cast<unsigned long long>(s.blocks_read), result.diagnostics.error_count(),
                  result.diagnostics.warning_count());
    }
    if (result.diagnostics.has_errors()) status = std::max<int>(status, refused);
  }
  return status;
}

namespace {

int list_passes() {
  std::string text;
  for (const ir::Pass& pass : ir::pipeline()) text += fmt::format("{:<24} {}\n", pass.name, pass.summary);
  write_all(stdout, text);
  return ok;
}

/// The same of a program in the textual IR (docs/ir.md), whose header names its language: PART.ir.
int print_legalised_ir(const Arguments& a, const translator::TranslateOptions& options, std::string& text) {
  std::string error;
  const SourcePtr source = input_of(a, a.inputs.front()).open(&error);
  const auto* to = translator::find_dialect(options.to);
  if (!source) return usage_error(a, error);
  if (to == nullptr) return usage_error(a, "--to is needed: see 'cnctrans dialects'");
  FileTable files;
  Diagnostics diagnostics;
  ir::Program program = ir::from_text(source->text(), files.add(source), diagnostics);
  if (!diagnostics.has_errors()) {
    ir::number_statements(program);
    const std::string own = program.dialect + (program.lathe ? "-lathe" : "-mill");
    const auto profile = dialects::load_profile(options.machine.empty() ? own : options.machine, &error);
    const auto target =
        profile ? translator::choose_target(*to, options.target_machine, *profile, &error) : std::nullopt;
    if (!target) return usage_error(a, error);
    ir::LegaliseReport report;
    ir::LegaliseContext context{to->backend->capabilities_for(*target), *profile, *target, {}, diagnostics, &report};
    context.options.cycles = options.cycles;
    context.options.raise_structure = options.raise_structure;
    context.options.only = options.only_pass;
    context.behind_pass = options.behind_pass;
    ir::legalise(program, context);
  }
  a.messages->add(diagnostics, files);
  write_all(stdout, text);
  return diagnostics.has_errors() ? refused : ok;
}

/// The program on its way to another control.
int print_legalised(const Arguments& a) {
  translator::TranslateOptions options;
  if (a.inputs.size() != 1) return usage_error(a, "ir takes one program");
  if (!translate_options(a, options)) return usage;
  if (!a.only_pass.empty() && !a.after_pass.empty()) return usage_error(a, "--after and --pass exclude each other");
  const std::string& wanted = a.only_pass.empty() ? a.after_pass : a.only_pass;
  const bool each = a.after_pass == "each";
  if (!wanted.empty() && !each && !ir::is_pass(wanted))
    return usage_error(a, "no pass is called '" + wanted + "'; cnctrans ir --passes lists them");
  std::string text, last;
  options.from = a.dialect;
  options.verify = false;
  options.only_pass = a.only_pass;
  options.behind_pass = [&](std::string_view pass, const ir::Program& program) {
    if (!each && !wanted.empty() && pass != wanted) return;
    std::string now = ir::to_text(program, {a.places});
    if (!each || pass == ir::pipeline().front().name) text.clear();  // again from the start: another attempt
    if (each && now == last && !text.empty()) return;
    if (each) text += "// " + std::string(pass) + '\n';
    text += now;
    last = std::move(now);
  };
  if (a.inputs.front().ends_with(".ir")) return print_legalised_ir(a, options, text);
  const auto result = translator::translate(input_of(a, a.inputs.front()), options);
  if (!result.error.empty()) return usage_error(a, result.error);
  a.messages->add(result.diagnostics, result.files);
  write_all(stdout, text);
  return result.refused ? refused : ok;
}

}  // namespace

int print_ir(const Arguments& a) {
  if (a.list_passes) return list_passes();
  if (!a.to.empty()) return print_legalised(a);
  translator::RunOptions options;
  if (a.inputs.size() != 1) return usage_error(a, "ir takes one program");
  if (!run_options(a, options)) return usage;
  std::string error;
  const auto* dialect = translator::find_readable(a.dialect, &error);
  if (dialect == nullptr) return usage_error(a, error);
  const auto source = input_of(a, a.inputs.front()).open(&error);
  if (!source) return usage_error(a, error);
  const auto profile = translator::choose_profile(*dialect, a.machine, source.get(), &error);
  if (!profile) return usage_error(a, error);
  translator::Loader loader(*dialect, *profile, options.reader, options.libraries);
  Diagnostics diagnostics;
  const ir::Program* program = loader.read_main(source, diagnostics);
  a.messages->add(diagnostics, loader.files());
  write_all(stdout, a.json ? ir::to_json(*program) + "\n" : ir::to_text(*program, {a.places}));
  return diagnostics.has_errors() ? refused : ok;
}

int list_dialects(const Arguments& a) {
  for (const auto& d : translator::dialects()) {
    std::string line(d.name);
    line += std::string(line.size() < 12 ? 12 - line.size() : 1, ' ') + std::string(d.title);
    const auto add = [&line](const char* what, const std::vector<std::string_view>& list) {
      for (const auto& e : list) line += std::string("  .") + std::string(e) + what;
    };
    add(" (mill)", d.mill_extensions);
    add(" (lathe)", d.lathe_extensions);
    add("", d.other_extensions);
    write_all(stdout, line + "\n");
  }
  if (!a.quiet) {
    std::string machines = "machines:";
    for (const auto& m : machine::builtin_names()) machines += " " + m;
    write_all(stdout, machines + "\n");
  }
  return ok;
}

}  // namespace cnctrans::cli
