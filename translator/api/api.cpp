// The C++ interface: its options become those of the house.
#include "cnctrans/api.h"

#include "machine/profile.h"
#include "translator/api/calls.h"
#include "translator/files/readable.h"
#include "translator/option_words.h"
#include "translator/version.h"

namespace cnctrans::api {

namespace {

namespace house = cnctrans::translator;

void take_input(const Options& given, house::InputOptions& out) {
  out.machine = given.machine;
  out.libraries = given.libraries;
  std::string ignored;  // a file that can't be read is missed where it is called
  for (const auto& program : given.programs) {
    if (const auto text = house::input_of(program).open(&ignored)) out.texts.push_back(text);
  }
}

/// False: a value that the command line would not take; why in `error`.
bool take_run(const Options& given, const std::string& dialect, interpreter::Options& out, std::string& error) {
  out.set = given.set;
  if (given.max_events != 0) out.max_events = given.max_events;
  for (const unsigned level : given.skip) {
    if (level > house::last_skip_level) {
      error = "there is no block-skip switch " + std::to_string(level);
      return false;
    }
    house::add_skip(out, level, house::find_dialect(dialect));
  }
  return true;
}

backends::Unsupported house_word(Unsupported u) {
  if (u == Unsupported::warn) return backends::Unsupported::warn;
  return u == Unsupported::comment ? backends::Unsupported::comment : backends::Unsupported::error;
}
backends::Numbering house_word(Numbering n) {
  if (n == Numbering::none) return backends::Numbering::none;
  return n == Numbering::renumber ? backends::Numbering::renumber : backends::Numbering::keep;
}
ir::CycleWriting house_word(Cycles c) {
  if (c == Cycles::explode) return ir::CycleWriting::explode;
  return c == Cycles::exact ? ir::CycleWriting::exact : ir::CycleWriting::native;
}
std::optional<cnctrans::Encoding> house_word(Encoding e) {
  if (e == Encoding::as_source) return std::nullopt;
  return e == Encoding::utf8 ? cnctrans::Encoding::utf8 : cnctrans::Encoding::windows1252;
}
std::optional<Eol> house_word(LineEnd e) {
  if (e == LineEnd::as_source) return std::nullopt;
  if (e == LineEnd::lf) return Eol::lf;
  return e == LineEnd::crlf ? Eol::crlf : Eol::cr;
}

bool take(const TranslateOptions& given, house::TranslateOptions& out, std::string& error) {
  if (given.number_step < 1) {
    error = "number_step is " + std::to_string(given.number_step) + "; 1 is the least";
    return false;
  }
  take_input(given, out);
  out.from = given.from;
  out.to = given.to;
  out.target_machine = given.target_machine;
  out.unsupported = house_word(given.unsupported);
  out.numbering = house_word(given.numbering);
  out.number_step = given.number_step;
  out.cycles = house_word(given.cycles);
  out.raise_structure = given.raise_structure;
  out.annotate = given.annotate;
  out.origin = given.origin;
  if (given.prove || given.verify || given.explore != 0) house::prove_as_usual(out);
  out.strict = given.verify || given.explore != 0;
  if (given.explore != 0) out.further = {false, given.explore, {}};
  out.single_output = given.one_file;
  out.encoding = house_word(given.encoding);
  out.eol = house_word(given.line_end);
  out.run.max_events = house::kept_events;
  return take_run(given, given.from, out.run, error);
}

bool take(const RunOptions& given, house::RunOptions& out, std::string& error) {
  take_input(given, out);
  out.dialect = given.dialect;
  return take_run(given, given.dialect, out.run, error);
}

std::vector<std::string> copy(const std::vector<std::string_view>& list) {
  return {list.begin(), list.end()};
}

}  // namespace

std::string version() {
  return std::string(house::version);
}

std::vector<Dialect> dialects() {
  std::vector<Dialect> list;
  for (const auto& d : house::dialects()) {
    list.push_back({std::string(d.name), std::string(d.title), house::readable(d), copy(d.mill_extensions),
                    copy(d.lathe_extensions)});
  }
  return list;
}

std::vector<std::string> machines() {
  return machine::builtin_names();
}

Translation translate(const Program& program, const TranslateOptions& options) {
  house::TranslateOptions with;
  Translation refused;
  if (!take(options, with, refused.error)) return refused;
  return house::translate_for(house::input_of(program), with);
}

Comparison verify(const Program& source, const std::vector<Program>& translation, const TranslateOptions& options) {
  house::TranslateOptions with;
  Comparison refused;
  if (!take(options, with, refused.error)) return refused;
  std::vector<house::Input> targets;
  for (const auto& program : translation) targets.push_back(house::input_of(program));
  return house::verify_for(house::input_of(source), targets, with);
}

Run run(const Program& program, const RunOptions& options, const EventSink& sink) {
  house::RunOptions with;
  Run refused;
  if (!take(options, with, refused.error)) return refused;
  return house::run_for(house::input_of(program), with, sink);
}

Check check(const Program& program, const RunOptions& options) {
  house::RunOptions with;
  Check refused;
  if (!take(options, with, refused.error)) return refused;
  return house::check_for(house::input_of(program), with);
}

}  // namespace cnctrans::api
