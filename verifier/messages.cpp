#include "verifier/messages.h"

#include <algorithm>
#include <string>

#include "base/text.h"
#include "base/transliterate.h"

namespace cnctrans::verifier {

namespace {

constexpr std::size_t length = 39;        ///< that every control shows
constexpr std::size_t longest_value = 6;  ///< as a text has it, "?P1234"; what is shown may be one digit

/// In plain capitals, as every control can show them.
std::string plain(std::string_view text) {
  std::string out = to_upper_ascii(to_ascii(text, nullptr));
  for (std::size_t i = 0; i < out.size(); ++i) {
    char& c = out[i];
    if (c == '"') c = '\'';
    if (c == '$' || (c == '?' && i + 1 < out.size() && out[i + 1] == 'P')) c = ' ';  // they begin a value somewhere
  }
  // Spaces at the ends and beside others are not seen.
  out.erase(std::unique(out.begin(), out.end(), [](char a, char b) { return a == ' ' && b == ' '; }), out.end());
  return std::string(trim(out));
}

}  // namespace

bool same_message(const interpreter::Event& source, std::string_view target) {
  const std::string shown = plain(target);
  const auto begins = [&](const std::string& whole, std::size_t least) {
    return whole == shown || (target.size() + 1 >= least && whole.starts_with(shown));
  };
  std::string gaps = source.state;
  const auto values = static_cast<std::size_t>(std::count(gaps.begin(), gaps.end(), interpreter::value_mark));
  if (begins(plain(source.text), length - std::min(length, values * longest_value))) return true;
  std::replace(gaps.begin(), gaps.end(), interpreter::value_mark, '?');
  return values != 0 && begins(plain(gaps), length);
}

}  // namespace cnctrans::verifier
