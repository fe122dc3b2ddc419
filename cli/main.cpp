#include <CLI/CLI.hpp>
#include <cstdio>
#include <new>
#include <string_view>
#include <vector>

#include "cli/common.h"
#include "cli/completion.h"
#include "translator/version.h"

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace {

/// A translation builds large programs and drops them again, pass by pass: memory is kept for the next one instead of
/// being handed back to the system and asked for anew (a fifth of the time of a program of 20,000 blocks).
void keep_memory() {
#ifdef __GLIBC__
  mallopt(M_TRIM_THRESHOLD, 512 << 20);
  mallopt(M_TOP_PAD, 4 << 20);
  mallopt(M_MMAP_THRESHOLD, 64 << 20);
#endif
}

using cnctrans::cli::Arguments;

void add_reading(CLI::App& app, Arguments& a) {
  app.add_option("--machine", a.machine, "machine profile: a built-in name (fagor-lathe) or a JSON file");
  app.add_option("--lib", a.libraries,
                 "folder where called programs and definitions are looked up, or a definition file (repeatable)")
      ->allow_extra_args(false);
  app.add_option("--reader", a.reader, "block reader: scanner, antlr, or both (compares them)")
      ->check(CLI::IsMember({"scanner", "antlr", "both"}));
  app.add_option("--diagnostics", a.diagnostics, "form of the diagnostics on stderr: text or json")
      ->check(CLI::IsMember({"text", "json"}));
  app.add_flag("-q,--quiet", a.quiet, "no summary lines");
}

void add_running(CLI::App& app, Arguments& a) {
  app.add_option("--set", a.set, "NAME=VALUE: initial value of a variable (repeatable)")->allow_extra_args(false);
  app.add_option("--skip", a.skip, "block-skip switches that are on, such as 0,3");
  const auto count = [](const std::string& text) {
    const bool digits = !text.empty() && text.find_first_not_of("0123456789") == std::string::npos;
    return digits ? std::string() : "a count such as 1000 is wanted, not " + text;
  };
  app.add_option("--max-events", a.max_events, "stop the run after so many events")->check(count);
  app.add_option("--max-steps", a.max_steps, "stop the run after so many statements")->check(count);
}

/// What convert and batch have in common.
void add_writing(CLI::App& app, Arguments& a) {
  app.add_option("--from", a.from, "dialect of the input: see 'cnctrans dialects'");
  app.add_option("--to", a.to, "dialect of the output");
  app.add_option("--target-machine", a.target_machine, "machine profile of the target");
  app.add_option("--unsupported", a.unsupported, "what becomes of a construct without counterpart")
      ->check(CLI::IsMember({"error", "warn", "comment"}));
  app.add_option("--numbering", a.numbering, "block numbers of the output: keep, none or renumber")
      ->check(CLI::IsMember({"keep", "none", "renumber"}));
  app.add_option("--number-step", a.number_step, "step of renumbered blocks")->check(CLI::Range(1, 1000));
  app.add_option("--cycles", a.cycles,
                 "the target's own cycle where it leaves the same part, only where each move is the same, or the moves")
      ->check(CLI::IsMember({"native", "exact", "explode"}));
  app.add_option("--structure", a.structure, "jumps stay jumps, or become IF, WHILE, REPEAT where that is the same")
      ->check(CLI::IsMember({"keep", "raise"}));
  app.add_flag("--annotate", a.annotate, "the source line as a comment beside its translation");
  app.add_flag("--force", a.force, "replace files that cnctrans did not write, or that were changed since");
  app.add_flag("--no-origin", a.no_origin, "no remark at the head that names the source");
  app.add_option("--encoding", a.encoding, "of the output; else as the input")
      ->check(CLI::IsMember({"utf-8", "windows-1252"}));
  app.add_option("--eol", a.eol, "line ends of the output; else as the input")
      ->check(CLI::IsMember({"lf", "crlf", "cr"}));
  app.add_flag("--verify", a.verify, "a translation that can't be replayed is not taken either");
  app.add_flag("--no-verify", a.no_verify, "write without replaying source and translation");
  add_reading(app, a);
  add_running(app, a);
}

void add_exploring(CLI::App& app, Arguments& a) {
  app.add_flag("--explore", a.explore,
               "prove more than one way through the program: replay it with other initial values and skip levels");
  app.add_option("--replays", a.replays, "with --explore: at most so many replays (100)")
      ->check(CLI::Range(1, 1'000'000));
}

void add_converting(CLI::App& app, Arguments& a) {
  add_writing(app, a);
  app.add_option("input", a.inputs, "part programs")->type_name("FILE");
  app.add_option("-o,--output", a.output, "file, or folder ending in /; without it standard output");
  add_exploring(app, a);
  app.add_option("--names", a.names,
                 "file with the names of programs, subprograms and variables: read when it is there, then completed");
  app.add_option("--report", a.report, "write a report (.html .json .md .sarif)");
}

CLI::App* add_batch(CLI::App& app, Arguments& a) {
  CLI::App* sub = app.add_subcommand("batch", "translate and prove every program below a folder");
  add_writing(*sub, a);
  add_exploring(*sub, a);
  sub->add_option("--names", a.names, "file with the names of programs, subprograms and variables: read, not changed");
  sub->add_option("folders", a.inputs, "folder of the programs, folder for the results")->required()->type_name("DIR");
  sub->add_option("--jobs", a.jobs, "programs side by side")->check(CLI::Range(1, 1024));
  sub->add_option("--shard", a.shard, "K/N: only every N-th program, from number K on");
  sub->add_option("--timeout", a.timeout, "seconds for one program")->check(CLI::Range(1, 86400));
  sub->add_flag("--again", a.again, "do again what an earlier run has done");
  sub->add_flag("--collect", a.collect, "only write the summary of what is there");
  sub->footer(
      "Example:\n  cnctrans batch --from fagor --to sinumerik old/ new/ --jobs 4\n"
      "Exit status: 0 all translated, 1 some were not, 2 wrong usage, 3 some differ.");
  return sub;
}

CLI::App* add_dialect_command(CLI::App& app, Arguments& a, const char* name, const char* what, const char* footer,
                              int programs = 1) {
  CLI::App* sub = app.add_subcommand(name, what);
  sub->add_option("--dialect", a.dialect, "language of the program: see 'cnctrans dialects'")->required();
  sub->add_option("program", a.inputs, "part program")->required()->type_name("FILE")->expected(1, programs);
  add_reading(*sub, a);
  sub->footer(footer);
  return sub;
}

/// Asked of the words as they stand: the command line could not be taken.
bool wants_json(int argc, char** argv) {
  const std::vector<std::string_view> words(argv, argv + argc);
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (words[i] == "--diagnostics=json") return true;
    if (words[i] == "--diagnostics" && i + 1 < words.size() && words[i + 1] == "json") return true;
  }
  return false;
}

}  // namespace

int main(int argc, char** argv) {
  keep_memory();
  Arguments a;
  CLI::App app{
      "Translates CNC part programs between controls, keeps the program, and proves that the machine moves the same "
      "way.",
      "cnctrans"};
  app.set_version_flag("--version", "cnctrans " + std::string(cnctrans::translator::version));
  app.require_subcommand(0, 1);
  app.footer(
      "Examples:\n  cnctrans --from fagor --to sinumerik part.pim -o PART.MPF\n"
      "  cnctrans --from num --to fagor *.xpi -o out/ --lib subs\n  cnctrans run --dialect fagor part.pim --trace - | "
      "head\n"
      "Exit status: 0 written, 1 refused, 2 wrong usage, 3 the translation moves the machine otherwise.\n"
      "Each command has options of its own: cnctrans run --help.");
  add_converting(app, a);

  CLI::App* convert = app.add_subcommand("convert", "translate (the default command)");
  add_converting(*convert, a);
  convert->footer("Example:\n  cnctrans convert --from sinumerik --to num PART.MPF -o part.xpi");
  CLI::App* batch = add_batch(app, a);
  CLI::App* run = add_dialect_command(
      app, a, "run", "run a program in the reference interpreter",
      "Examples:\n  cnctrans run --dialect num part.xpi --trace moves.jsonl --vars -\n"
      "  cnctrans run --dialect fagor part.pim --set P100=3 --skip 0 --max-events 1000\n"
      "Exit status: 0 ran to the end, 1 refused or ended in an error, 2 wrong usage, 3 a limit stopped it.");
  add_running(*run, a);
  run->add_option("--trace", a.trace, "write the events, one JSON object a line (- is standard output)");
  run->add_option("--vars", a.vars, "write the final values of variables as JSON");
  run->add_option("--written", a.written, "folder for the programs that the program writes (OPEN, WRITE)")
      ->type_name("DIR");
  run->add_flag("--force", a.force, "with --written: replace files that no run of this program has written");
  CLI::App* verify = app.add_subcommand("verify", "compare a program with a translation made by anyone");
  verify->add_option("--from", a.from, "dialect of the source")->required();
  verify->add_option("--to", a.to, "dialect of the translation")->required();
  verify->add_option("files", a.inputs, "source, translation, and its further files")->required()->type_name("FILE");
  verify->add_option("--target-machine", a.target_machine, "machine profile of the target");
  add_exploring(*verify, a);
  add_reading(*verify, a);
  add_running(*verify, a);
  verify->footer(
      "Example:\n  cnctrans verify --from fagor --to sinumerik part.pim PART.MPF\n"
      "Exit status: 0 both move alike, 1 one of them can't be read or run to its end, or nothing moves, 2 wrong "
      "usage,\n"
      "3 they differ.");
  CLI::App* check = add_dialect_command(app, a, "check", "read programs and report",
                                        "Example:\n  cnctrans check --dialect sinumerik subs/*.SPF\n"
                                        "Exit status: 0 no errors, 1 errors, 2 wrong usage.",
                                        1 << 20);
  CLI::App* ir = add_dialect_command(app, a, "ir", "print the intermediate representation",
                                     "Example:\n  cnctrans ir --dialect num part.xpi\n"
                                     "Exit status: 0 no errors, 1 errors (it is printed all the same), 2 wrong usage.");
  ir->add_flag("--json", a.json, "as JSON");
  ir->add_flag("--places", a.places, "with source places");
  CLI::App* list = app.add_subcommand("dialects", "list the dialects and built-in machines");
  list->add_flag("-q,--quiet", a.quiet, "dialects only");
  CLI::App* completion = app.add_subcommand("completion", "print a shell completion script");
  completion->add_option("shell", a.shell, "bash, zsh or fish")
      ->required()
      ->check(CLI::IsMember({"bash", "zsh", "fish"}));
  completion->footer("Example:\n  cnctrans completion bash > /etc/bash_completion.d/cnctrans");

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() != 0 && wants_json(argc, argv)) {
      cnctrans::cli::Messages(true).say(cnctrans::Severity::error, "CNC-USAGE", e.what());
      return cnctrans::cli::usage;
    }
    const int status = app.exit(e);
    return status == 0 ? 0 : cnctrans::cli::usage;
  }
  cnctrans::cli::Messages messages(a.diagnostics == "json");
  a.messages = &messages;
  const auto command = [&] {
    if (run->parsed()) return cnctrans::cli::run(a);
    if (batch->parsed()) return cnctrans::cli::batch(a);
    if (verify->parsed()) return cnctrans::cli::verify(a);
    if (check->parsed()) return cnctrans::cli::check(a);
    if (ir->parsed()) return cnctrans::cli::print_ir(a);
    if (list->parsed()) return cnctrans::cli::list_dialects(a);
    if (!completion->parsed()) return cnctrans::cli::convert(a);
    std::fputs(cnctrans::cli::completion(app, a.shell).c_str(), stdout);
    return static_cast<int>(cnctrans::cli::ok);
  };
  try {
    const int status = command();
    std::string why;
    if (cnctrans::cli::stdout_arrived(&why)) return status;
    messages.say(cnctrans::Severity::error, "CNC-OUTPUT", "cnctrans: the standard output can't be written" + why);
    return status != cnctrans::cli::ok ? status : cnctrans::cli::usage;  // a result that did not arrive is no success
  } catch (const std::bad_alloc&) {
    messages.say(cnctrans::Severity::error, "CNC-MEMORY", "cnctrans: not enough memory for this input");
    return cnctrans::cli::refused;
  }
}
