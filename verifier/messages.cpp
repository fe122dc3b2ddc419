#include "verifier/messages.h"

#include <string>

#include "base/text.h"
#include "base/transliterate.h"

namespace cnctrans::verifier {

namespace {

/// Letters and digits in capitals: what must survive of a message on a control with a smaller character set.
std::string message_core(std::string_view text) {
  std::string core;
  for (const char c : to_upper_ascii(to_ascii(text, nullptr))) {
    if ((c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9')) core += c;
  }
  return core;
}
constexpr std::size_t message_core_kept = 24;

/// A control that can't show values inside a message shows '?' for each: what stands between them must be there, in
/// order.
bool message_with_gaps(std::string_view source, std::string_view target) {
  if (target.find('?') == std::string_view::npos || source.find('?') != std::string_view::npos) return false;
  const std::string whole = message_core(source);
  std::size_t at = 0;
  while (true) {
    const std::size_t gap = target.find('?');
    const std::string part = message_core(target.substr(0, gap));
    const std::size_t found = whole.find(part, at);
    if (found == std::string::npos || (at == 0 && found != 0)) return false;
    at = found + part.size();
    if (gap == std::string_view::npos) return true;
    target.remove_prefix(gap + 1);
  }
}

}  // namespace

bool same_message(std::string_view source, std::string_view target) {
  const std::string x = message_core(source), y = message_core(target);
  const bool cut = y.size() >= message_core_kept && x.starts_with(y);
  return x == y || cut || message_with_gaps(source, target);
}

}  // namespace cnctrans::verifier
