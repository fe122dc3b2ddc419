#include "cli/languages.h"

#include <algorithm>
#include <filesystem>

#include "cli/common.h"
#include "translator/files/language.h"

namespace cnctrans::cli {

bool read_standard_input(Arguments& a) {
  const auto named = std::count(a.inputs.begin(), a.inputs.end(), "-");
  if (named == 0) return true;
  std::string error = "standard input (-) can be one program only";
  SourcePtr text;
  if (named == 1) text = SourceText::open("/dev/stdin", &error);
  if (text) a.standard_input = SourceText::from_string("stdin", std::string(text->bytes()));
  if (!text) usage_error(a, error);
  return text != nullptr;
}

namespace {

/// What a language is told by: the first lines of a program, however long it is.
SourcePtr head_of(const Arguments& a, const std::string& name, std::string* error) {
  const translator::Input input = input_of(a, name);
  if (input.in_memory()) return input.open(error);
  constexpr std::size_t enough = 1U << 18U;
  LineWindowReader reader(enough);
  if (!reader.open(name, error)) return nullptr;
  return SourceText::from_string(name, std::string(reader.next()));
}

}  // namespace

bool find_language(const Arguments& a, std::string& wanted, const char* option, std::size_t first, std::size_t last) {
  if (!wanted.empty()) return true;
  const translator::Dialect* found = nullptr;
  std::string why;
  for (std::size_t i = first; i < std::min(last, a.inputs.size()); ++i) {
    const std::string& name = a.inputs[i];
    const std::string needed = std::string(option) + " is needed: ";
    std::error_code ignored;
    if (name != "-" && std::filesystem::exists(name, ignored) && !std::filesystem::is_directory(name, ignored) &&
        !translator::can_reopen(name)) {
      usage_error(a, needed + name + " can be read only once");
      return false;
    }
    std::string error;
    const SourcePtr source = head_of(a, name, &error);
    if (!source) {
      usage_error(a, error);
      return false;
    }
    const auto language = translator::find_language(*source);
    if (language.dialect == nullptr) {
      usage_error(a, needed + "the language of " + source->name() + " can't be told: " + language.why);
      return false;
    }
    if (found != nullptr && found != language.dialect) {
      usage_error(a, needed + source->name() + " looks like " + std::string(language.dialect->name) + ", " +
                         a.inputs[first] + " like " + std::string(found->name));
      return false;
    }
    found = language.dialect;
    why = language.why;
  }
  if (found == nullptr) return true;  // no program: the command says so
  wanted = std::string(found->name);
  if (!a.quiet)
    a.messages->say(Severity::note, "CNC-LANGUAGE",
                    "read as " + std::string(found->title) + " by " + why + " (" + option + " " + wanted + ")");
  return true;
}

}  // namespace cnctrans::cli
