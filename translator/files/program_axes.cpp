#include "translator/files/program_axes.h"

#include <algorithm>
#include <array>
#include <charconv>

#include "base/text.h"

namespace cnctrans::translator {

namespace {

constexpr std::string_view letters_of_axes = "YUVWABC";

bool is_letter(char c) {
  return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '_' || c == '$';
}
bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

/// A word of one letter, or with the letter of a parameter behind it (UP1, UL1, UE80000).
bool axis_word(std::string_view run, std::string_view rest, const std::string& missing) {
  if (missing.find(to_upper_ascii(run.substr(0, 1))[0]) == std::string::npos || run.size() > 2) return false;
  if (run.size() == 2) return !rest.empty() && is_digit(rest[0]);
  const auto at = rest.find_first_not_of(" \t");
  return at != std::string_view::npos && (is_digit(rest[at]) || std::string_view("+-.=([").find(rest[at]) < 6);
}

/// The name of an axis as an argument: GEOAX(3,W), POS[W].
bool axis_argument(std::string_view text, std::size_t at, const std::string& missing) {
  constexpr std::string_view before = "([,", behind = ")],";
  return at > 0 && at + 1 < text.size() && before.find(text[at - 1]) != std::string_view::npos &&
         behind.find(text[at + 1]) != std::string_view::npos &&
         missing.find(to_upper_ascii(text.substr(at, 1))[0]) != std::string::npos;
}

/// The text may have a word of one of the letters. Comments are passed over, names of more letters too. Most bytes are
/// passed over by one look into a table: large files are read at memory speed.
bool mentions(std::string_view text, const Dialect& dialect, const std::string& missing) {
  std::array<bool, 256> stops{};
  const auto stop_at = [&stops](char c) { stops[static_cast<unsigned char>(c)] = true; };
  for (const char c : missing) {
    stop_at(c);
    stop_at(static_cast<char>(c + 32));
  }
  const bool by_code = std::any_of(dialect.axis_codes.begin(), dialect.axis_codes.end(),
                                   [&](const auto& row) { return missing.find(row.second) != std::string::npos; });
  if (by_code) {
    stop_at('G');
    stop_at('g');
  }
  stop_at(dialect.comment_open);
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (!stops[static_cast<unsigned char>(c)]) continue;
    if (c == dialect.comment_open) {
      i = dialect.comment_close == 0 ? text.find_first_of("\r\n", i) : text.find(dialect.comment_close, i);
      if (i == std::string_view::npos) return false;
      continue;
    }
    if (i > 0 && is_letter(text[i - 1])) continue;
    std::size_t end = i;
    while (end < text.size() && is_letter(text[end])) ++end;
    const auto run = text.substr(i, end - i), rest = text.substr(end, 8);
    if (axis_word(run, rest, missing) || axis_argument(text, i, missing)) return true;
    int code = -1;
    if (run == "G" || run == "g") std::from_chars(rest.data(), rest.data() + rest.size(), code);
    for (const auto& [g, letter] : dialect.axis_codes) {
      if (g == code && missing.find(letter) != std::string::npos) return true;
    }
  }
  return false;
}

/// The letter at the end of "... the machine has no axis U".
char missing_axis(const Diagnostic& d) {
  const auto at = d.message.find(" has no axis ");
  if (at == std::string::npos || d.message.size() < 2) return 0;
  const char letter = d.message.back();
  return d.message[d.message.size() - 2] == ' ' && letters_of_axes.find(letter) < letters_of_axes.size() ? letter
                                                                                                         : '\0';
}

}  // namespace

void add_axes(machine::Profile& profile, const std::string& letters) {
  std::string added;
  for (const char letter : letters) {
    const ir::AxisId id = ir::fixed_axis(letter);
    if (profile.axis(id) != nullptr) continue;
    machine::AxisSpec axis;
    axis.id = id;
    axis.name = std::string(1, letter);
    axis.rotary = ir::is_rotary_letter(id);
    const auto place =
        std::find_if(profile.axes.begin(), profile.axes.end(), [id](const auto& a) { return a.id > id; });
    profile.axes.insert(place, axis);
    added += letter;
  }
  if (!added.empty()) profile.name += "+" + added;
}

void add_axes_of_program(const Dialect& dialect, const SourceText& source, machine::Profile& profile) {
  std::string missing;
  for (const char letter : letters_of_axes) {
    if (profile.axis(ir::fixed_axis(letter)) == nullptr) missing += letter;
  }
  if (missing.empty() || !dialect.frontend || !mentions(source.text(), dialect, missing)) return;
  const SourcePtr copy = SourceText::from_string(source.name(), std::string(source.text()));
  FileTable files;
  Diagnostics found;
  dialect.frontend->read(copy, files.add(copy), {frontends::Reader::scanner, &profile}, found, nullptr);
  std::string wanted;
  for (const auto& d : found.all()) {
    if (const char letter = missing_axis(d); letter != 0 && wanted.find(letter) == std::string::npos) wanted += letter;
  }
  add_axes(profile, wanted);
}

std::string added_axes(const machine::Profile& profile) {
  const auto plus = profile.name.rfind('+');
  if (plus == std::string::npos) return {};
  const auto builtins = machine::builtin_names();
  if (std::find(builtins.begin(), builtins.end(), profile.name.substr(0, plus)) == builtins.end()) return {};
  return profile.name.substr(plus + 1);
}

void note_added_axes(const machine::Profile& profile, FileId file, Diagnostics& diagnostics) {
  const std::string letters = added_axes(profile);
  if (letters.empty()) return;
  std::string list;
  for (std::size_t i = 0; i < letters.size(); ++i) {
    list += (i == 0                    ? ""
             : i + 1 == letters.size() ? " and "
                                       : ", ") +
            std::string(1, letters[i]) + (ir::is_rotary_letter(ir::fixed_axis(letters[i])) ? " (rotary)" : " (linear)");
  }
  const std::string base = profile.name.substr(0, profile.name.rfind('+'));
  diagnostics.warning("CNC-AXES", {file, 1, 1, 1, 1},
                      "the program moves axes that the default machine " + base + " does not have; it is read for " +
                          base + " with " + list,
                      "name the real machine with --machine: a profile that extends " + base + " and lists its axes");
}

}  // namespace cnctrans::translator
