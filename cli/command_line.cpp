#include "cli/command_line.h"

#include <CLI/CLI.hpp>
#include <algorithm>

#include "base/nearest.h"
#include "translator/version.h"

namespace cnctrans::cli {

namespace {

/// A word of a list; another one is answered by the nearest.
CLI::Validator one_of(const std::vector<std::string>& words) {
  std::string list;
  for (const auto& w : words) list += (list.empty() ? "" : ",") + w;
  const auto check = [words, list](const std::string& word) {
    if (std::find(words.begin(), words.end(), word) != words.end()) return std::string();
    return word + " not in {" + list + "}" + did_you_mean(word, words);
  };
  return {check, "{" + list + "}"};
}

void add_colour(CLI::App& app, Arguments& a) {
  app.add_option("--color", a.color, "colours: auto (on a terminal, unless NO_COLOR is set), always or never")
      ->check(one_of({"auto", "always", "never"}));
}

void add_reading(CLI::App& app, Arguments& a) {
  app.add_option("--machine", a.machine, "machine profile: a built-in name (fagor-lathe) or a JSON file");
  app.add_option("--tools", a.tools, "tools of the job: CSV, JSON, or the tool table of a control (docs/tools.md)");
  app.add_option("--lib", a.libraries,
                 "folder where called programs and definitions are looked up, or a definition file (repeatable)")
      ->allow_extra_args(false);
  app.add_option("--reader", a.reader, "block reader: scanner, antlr, or both (compares them)")
      ->check(one_of({"scanner", "antlr", "both"}));
  app.add_option("--diagnostics", a.diagnostics, "form of the diagnostics on stderr: text or json")
      ->check(one_of({"text", "json"}));
  add_colour(app, a);
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

void add_structure(CLI::App& app, Arguments& a) {
  app.add_option("--structure", a.structure, "jumps stay jumps, or become IF, WHILE, REPEAT where that is the same")
      ->check(one_of({"keep", "raise"}));
}

/// What convert and batch have in common.
void add_writing(CLI::App& app, Arguments& a) {
  app.add_option("--from", a.from, "dialect of the input: see 'cnctrans dialects'; else by extension and content");
  app.add_option("--to", a.to, "dialect of the output");
  app.add_option("--target-machine", a.target_machine, "machine profile of the target");
  app.add_option("--unsupported", a.unsupported, "what becomes of a construct without counterpart")
      ->check(one_of({"error", "warn", "comment"}));
  app.add_flag("--draft", a.draft,
               "write what can be translated as PART.draft.EXT: what is left to do stands at its head (status 4)");
  app.add_option("--numbering", a.numbering, "block numbers of the output: keep, none or renumber")
      ->check(one_of({"keep", "none", "renumber"}));
  app.add_option("--number-step", a.number_step, "step of renumbered blocks")->check(CLI::Range(1, 1000));
  app.add_option("--cycles", a.cycles,
                 "the target's own cycle where it leaves the same part, only where each move is the same, or the moves")
      ->check(one_of({"native", "exact", "explode"}));
  add_structure(app, a);
  app.add_flag("--annotate", a.annotate, "the source line as a comment beside its translation");
  app.add_flag("--force", a.force, "replace files that cnctrans did not write, or that were changed since");
  app.add_flag("--no-origin", a.no_origin, "no remark at the head that names the source");
  app.add_option("--encoding", a.encoding, "of the output; else as the input")
      ->check(one_of({"utf-8", "windows-1252"}));
  app.add_option("--eol", a.eol, "line ends of the output; else as the input")->check(one_of({"lf", "crlf", "cr"}));
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
  app.add_option("input", a.inputs, "part programs (- is standard input)")->type_name("FILE");
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
  sub->add_flag("--reports", a.reports, "a page about each program, linked from the summary");
  sub->add_flag("--collect", a.collect, "only write the summary of what is there");
  sub->footer(
      "Example:\n  cnctrans batch --from fagor --to sinumerik old/ new/ --jobs 4\n"
      "Exit status: 0 all translated, 1 some were not, 2 wrong usage, 3 some differ.");
  return sub;
}

CLI::App* add_dialect_command(CLI::App& app, Arguments& a, const char* name, const char* what, const char* footer,
                              int programs = 1) {
  CLI::App* sub = app.add_subcommand(name, what);
  sub->add_option("--dialect", a.dialect,
                  "language of the program: see 'cnctrans dialects'; else by extension and content");
  sub->add_option("program", a.inputs, "part program (- is standard input)")
      ->required()
      ->type_name("FILE")
      ->expected(1, programs);
  add_reading(*sub, a);
  sub->footer(footer);
  return sub;
}

CLI::App* add_profile(CLI::App& app, Arguments& a) {
  CLI::App* sub = app.add_subcommand("profile", "machine profiles: begin one, show it, check it, list its options");
  sub->add_option("action", a.profile_action, "init, show, check or options")
      ->required()
      ->check(one_of({"init", "show", "check", "options"}));
  sub->add_option("machine", a.profile_name, "a built-in machine or a JSON file")->required();
  sub->add_option("-o,--output", a.output, "with init: the file; without it standard output");
  sub->add_flag("--force", a.force, "with init: replace the file");
  sub->footer(
      "Examples:\n  cnctrans profile init fagor-mill -o machine.json\n  cnctrans profile check machine.json\n"
      "Exit status: 0 fine, 1 check has found a fault, 2 wrong usage.");
  return sub;
}

/// What survey and names have in common.
void add_looking(CLI::App& app, Arguments& a) {
  app.add_option("--from", a.from, "dialect of the programs");
  app.add_option("--to", a.to, "dialect of the translation that is planned");
  app.add_option("--machine", a.machine, "machine profile of the programs");
  app.add_option("--lib", a.libraries, "folder with further programs that may be called (repeatable)")
      ->allow_extra_args(false);
  app.add_option("--jobs", a.survey_jobs, "programs side by side; without it one a core")->check(CLI::Range(1, 1024));
  app.add_flag("-q,--quiet", a.quiet, "no summary lines");
}

CLI::App* add_survey(CLI::App& app, Arguments& a) {
  CLI::App* sub = app.add_subcommand("survey", "what is in a folder of programs, and what is missing to translate it");
  add_looking(*sub, a);
  sub->add_option("folder", a.inputs, "folder of the programs")->required()->type_name("DIR")->expected(1);
  sub->add_option("--names", a.names, "file of names: what it answers is not missing");
  sub->add_option("-o,--output", a.output,
                  "folder for survey.html, programs.csv and missing.csv; or one file (.html, .csv)");
  sub->footer(
      "Example:\n  cnctrans survey --from sinumerik --to fagor old/ -o survey/\n"
      "Exit status: 0 done, 1 not written, 2 wrong usage.");
  return sub;
}

CLI::App* add_project(CLI::App& app, Arguments& a) {
  CLI::App* sub = app.add_subcommand("project", "an archive as one job: what cnctrans.json in its folder says");
  sub->add_option("folder", a.inputs, "folder with cnctrans.json")->required()->type_name("DIR")->expected(1);
  sub->add_flag("--status", a.status, "say what state each program is in; translate nothing");
  sub->add_flag("--again", a.again, "do again what an earlier run has done");
  sub->add_flag("--reports", a.reports, "a page about each program, linked from project.html");
  sub->add_option("--jobs", a.jobs, "programs side by side")->check(CLI::Range(1, 1024));
  sub->add_option("--timeout", a.timeout, "seconds for one program")->check(CLI::Range(1, 86400));
  sub->add_flag("-q,--quiet", a.quiet, "no summary lines");
  sub->footer(
      "Example:\n  cnctrans project plant/ --jobs 4\n"
      "Exit status: 0 all translated, 1 some were not, 2 wrong usage, 3 some differ.");
  return sub;
}

CLI::App* add_names(CLI::App& app, Arguments& a) {
  CLI::App* sub =
      app.add_subcommand("names", "the file of names with all that a folder of programs needs and nobody has");
  add_looking(*sub, a);
  sub->add_option("--stub", a.stub, "folder of the programs")->required()->type_name("DIR");
  sub->add_option("-o,--output", a.output, "the file; answers that stand there stay. Without it standard output");
  sub->footer(
      "Example:\n  cnctrans names --stub old/ --from sinumerik --to fagor -o names.json\n"
      "Exit status: 0 done, 1 not written, 2 wrong usage.");
  return sub;
}

CLI::App* add_run(CLI::App& app, Arguments& a) {
  CLI::App* sub = add_dialect_command(
      app, a, "run", "run a program in the reference interpreter",
      "Examples:\n  cnctrans run --dialect num part.xpi --trace moves.jsonl --vars -\n"
      "  cnctrans run --dialect fagor part.pim --set P100=3 --skip 0 --max-events 1000\n"
      "Exit status: 0 ran to the end, 1 refused or ended in an error, 2 wrong usage, 3 a limit stopped it.");
  add_running(*sub, a);
  sub->add_option("--trace", a.trace, "write the events, one JSON object a line (- is standard output)");
  sub->add_option("--vars", a.vars, "write the final values of variables as JSON");
  sub->add_option("--written", a.written, "folder for the programs that the program writes (OPEN, WRITE)")
      ->type_name("DIR");
  sub->add_flag("--force", a.force, "with --written: replace files that no run of this program has written");
  return sub;
}

CLI::App* add_verify(CLI::App& app, Arguments& a) {
  CLI::App* sub = app.add_subcommand("verify", "compare a program with a translation made by anyone");
  sub->add_option("--from", a.from, "dialect of the source; else by extension and content");
  sub->add_option("--to", a.to, "dialect of the translation; else by extension and content");
  sub->add_option("files", a.inputs, "source, translation, and its further files")->required()->type_name("FILE");
  sub->add_option("--target-machine", a.target_machine, "machine profile of the target");
  add_exploring(*sub, a);
  add_reading(*sub, a);
  add_running(*sub, a);
  sub->footer(
      "Example:\n  cnctrans verify --from fagor --to sinumerik part.pim PART.MPF\n"
      "Exit status: 0 both move alike, 1 one of them can't be read or run to its end, or nothing moves, 2 wrong "
      "usage,\n"
      "3 they differ.");
  return sub;
}

CLI::App* add_ir(CLI::App& app, Arguments& a) {
  CLI::App* sub =
      add_dialect_command(app, a, "ir", "print the intermediate representation",
                          "Example:\n  cnctrans ir --dialect num part.xpi\n"
                          "Exit status: 0 no errors, 1 errors (it is printed all the same), 2 wrong usage.");
  sub->add_flag("--json", a.json, "as JSON");
  sub->add_flag("--places", a.places, "with source places");
  sub->get_option("program")->required(false);
  sub->add_option("--to", a.to, "the program as it is rewritten for this language");
  sub->add_option("--target-machine", a.target_machine, "built-in name or profile file of the target machine");
  sub->add_option("--after", a.after_pass,
                  "with --to: behind this pass (docs/passes.md); each: behind every one that changes it");
  sub->add_option("--pass", a.only_pass, "with --to: this pass alone");
  add_structure(*sub, a);
  sub->add_flag("--passes", a.list_passes, "list the passes in their order");
  return sub;
}

}  // namespace

std::vector<Command> declare(CLI::App& app, Arguments& a) {
  app.set_version_flag("--version", "cnctrans " + std::string(translator::version));
  app.require_subcommand(0, 1);
  app.footer(
      "Examples:\n  cnctrans --from fagor --to sinumerik part.pim -o PART.MPF\n"
      "  cnctrans --from num --to fagor *.xpi -o out/ --lib subs\n  cnctrans run --dialect fagor part.pim --trace - | "
      "head\n"
      "Exit status: 0 written, 1 refused, 2 wrong usage, 3 the translation moves the machine otherwise, 4 a draft.\n"
      "Each command has options of its own: cnctrans run --help.");
  add_converting(app, a);

  CLI::App* convert = app.add_subcommand("convert", "translate (the default command)");
  add_converting(*convert, a);
  convert->footer("Example:\n  cnctrans convert --from sinumerik --to num PART.MPF -o part.xpi");
  CLI::App* batch = add_batch(app, a);
  CLI::App* run = add_run(app, a);
  CLI::App* verify = add_verify(app, a);
  CLI::App* check = add_dialect_command(app, a, "check", "read programs and report",
                                        "Example:\n  cnctrans check --dialect sinumerik subs/*.SPF\n"
                                        "Exit status: 0 no errors, 1 errors, 2 wrong usage.",
                                        1 << 20);
  CLI::App* ir = add_ir(app, a);
  CLI::App* list = app.add_subcommand("dialects", "list the dialects and built-in machines");
  list->add_flag("-q,--quiet", a.quiet, "dialects only");
  CLI::App* explain = app.add_subcommand("explain", "what a code of a message means, and what to do about it");
  explain->add_option("code", a.code, "such as FAG-003")->required();
  add_colour(*explain, a);
  explain->footer("Example:\n  cnctrans explain TRN-091");
  CLI::App* profile = add_profile(app, a);
  CLI::App* lsp = app.add_subcommand("lsp", "language server for editors (LSP 3.17 on standard input and output)");
  lsp->add_flag("--stdio", a.stdio, "the way it always talks; for editors that say so");
  lsp->add_option("--grammar", a.grammar, "print the TextMate grammar of a dialect, and no more");
  lsp->footer("Example:\n  cnctrans lsp --grammar fagor > fagor.tmLanguage.json\nEditors start it: docs/editors.md.");
  CLI::App* survey = add_survey(app, a);
  CLI::App* names = add_names(app, a);
  CLI::App* project = add_project(app, a);
  CLI::App* man = app.add_subcommand("man", "print the manual page");
  man->footer("Example:\n  cnctrans man | man -l -");
  CLI::App* completion = app.add_subcommand("completion", "print a shell completion script");
  completion->add_option("shell", a.shell, "bash, zsh or fish")->required()->check(one_of({"bash", "zsh", "fish"}));
  completion->footer("Example:\n  cnctrans completion bash > /etc/bash_completion.d/cnctrans");
  return {{run, cli::run, Programs::dialect},
          {batch, cli::batch},
          {verify, cli::verify, Programs::from_and_to},
          {check, cli::check, Programs::dialect},
          {ir, print_ir, Programs::dialect},
          {list, list_dialects},
          {explain, cli::explain},
          {profile, cli::profile},
          {lsp, language_server},
          {survey, cli::survey},
          {names, cli::names},
          {project, cli::project},
          {man, nullptr},
          {completion, nullptr},
          {convert, cli::convert, Programs::from}};
}

}  // namespace cnctrans::cli
