// survey: what is in a folder of programs. names: the file of names with what is not known in it.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <thread>

#include "base/text.h"
#include "cli/common.h"
#include "translator/files/names_file.h"
#include "translator/survey/survey.h"

namespace cnctrans::cli {

namespace {

namespace fs = std::filesystem;

bool put_file(const Arguments& a, const fs::path& path, std::string_view bytes) {
  std::error_code ignored;
  if (path.has_parent_path()) fs::create_directories(path.parent_path(), ignored);
  std::string error;
  AtomicFile file(path.string());
  if (file.open(&error) && file.write(bytes, &error) && file.commit(&error)) {
    if (!a.quiet) a.messages->say(Severity::note, "CNC-WRITTEN", "wrote " + path.string());
    return true;
  }
  a.messages->say(Severity::error, "CNC-OUTPUT", "cnctrans: " + error);
  return false;
}

/// The survey of the folder that is named; false, and the reason is said.
bool look_around(const Arguments& a, translator::SurveyOptions& options, translator::Survey& out) {
  options.from = a.from;
  options.to = a.to;
  options.machine = a.machine;
  options.libraries = a.libraries;
  options.jobs = a.survey_jobs != 0 ? a.survey_jobs : std::max(1U, std::thread::hardware_concurrency());
  ProgressLine progress(options.in);
  out = translator::survey(options, [&progress](std::size_t done, std::size_t all) {
    progress(static_cast<double>(done) / static_cast<double>(all));
  });
  if (!out.error.empty()) usage_error(a, out.error);
  return out.error.empty();
}

/// The names file that is there already; false, and the reason is said: it can't be used.
bool known_names(const Arguments& a, const std::string& path, translator::Names& names) {
  std::error_code ignored;
  if (path.empty() || !fs::exists(path, ignored)) return true;
  std::string error;
  auto found = translator::read_names(path, a.from, a.to, &error);
  if (!found) {
    usage_error(a, error);
    return false;
  }
  names = *std::move(found);
  return true;
}

std::string ending(const std::string& path) {
  return fs::path(path).extension().string();
}

}  // namespace

int survey(const Arguments& a) {
  translator::SurveyOptions options;
  translator::Survey found;
  translator::Names names;
  options.in = a.inputs.front();
  const bool folder = !a.output.empty() && (a.output.back() == '/' || ending(a.output).empty());
  if (!a.output.empty() && !folder && ending(a.output) != ".html" && ending(a.output) != ".csv")
    return usage_error(a, "survey: -o is a folder, or a file that ends in .html or .csv");
  if (!a.names.empty() && (a.from.empty() || a.to.empty()))
    return usage_error(a, "survey: --names needs --from and --to");
  if (!known_names(a, a.names, names)) return usage;
  options.names = &names;
  if (!look_around(a, options, found)) return usage;
  if (!a.quiet || a.output.empty()) write_all(stdout, translator::survey_text(found, options));
  if (a.output.empty()) return ok;
  if (folder) {
    const fs::path place(a.output);
    return put_file(a, place / "survey.html", translator::survey_html(found, options)) &&
                   put_file(a, place / "programs.csv", translator::survey_programs_csv(found)) &&
                   put_file(a, place / "missing.csv", translator::survey_missing_csv(found))
               ? ok
               : refused;
  }
  const bool page = ending(a.output) == ".html";
  return put_file(a, a.output, page ? translator::survey_html(found, options) : translator::survey_programs_csv(found))
             ? ok
             : refused;
}

int names(const Arguments& a) {
  if (a.stub.empty()) return usage_error(a, "names: --stub DIR is needed: the folder of the programs");
  if (a.from.empty() || a.to.empty()) return usage_error(a, "names: --from and --to are needed");
  translator::SurveyOptions options;
  translator::Survey found;
  translator::Names names;
  options.in = a.stub;
  if (!known_names(a, a.output, names)) return usage;
  if (!look_around(a, options, found)) return usage;
  const auto added = translator::add_questions(names, translator::questions_of(found));
  const std::string text = translator::names_text(names, a.from, a.to);
  if (a.output.empty()) {
    write_all(stdout, text);
  } else if (!put_file(a, a.output, text)) {
    return refused;
  }
  if (!a.quiet)
    a.messages->say(Severity::note, "CNC-NAMES",
                    fmt::format("{} {} without an answer added", added, added == 1 ? "entry" : "entries"));
  return ok;
}

}  // namespace cnctrans::cli
