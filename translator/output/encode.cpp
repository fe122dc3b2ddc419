#include "translator/output/encode.h"

#include <string>

namespace cnctrans::translator {

namespace {

std::string with_eol(std::string_view text, Eol eol) {
  if (eol == Eol::lf) return std::string(text);
  const std::string_view end = eol_text(eol);
  std::string out;
  out.reserve(text.size() + text.size() / 16);
  for (const char c : text) {
    if (c == '\n') {
      out += end;
    } else {
      out += c;
    }
  }
  return out;
}

std::string to_windows1252(std::string_view text, Diagnostics& diagnostics) {
  std::string out;
  std::uint32_t line = 1;
  bool warned = false;
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    std::string_view part = text.substr(0, end == std::string_view::npos ? text.size() : end + 1);
    text.remove_prefix(part.size());
    if (!valid_utf8(part)) {
      out += part;  // bytes of a Windows-1252 source: already what is wanted
    } else {
      std::size_t bad = 0;
      while (true) {
        const auto encoded = utf8_to_windows1252(part, &bad);
        if (encoded) {
          out += *encoded;
          break;
        }
        out += utf8_to_windows1252(part.substr(0, bad)).value_or("");
        out += '?';
        if (!warned) {
          diagnostics.warning(
              "TRN-091", Span{},
              "line " + std::to_string(line) + " of the output has a character that Windows-1252 lacks; '?' is written",
              "use --encoding utf-8 if the control takes it");
          warned = true;
        }
        ++bad;
        while (bad < part.size() && (static_cast<unsigned char>(part[bad]) & 0xC0U) == 0x80U) ++bad;
        part.remove_prefix(bad);
      }
    }
    ++line;
  }
  return out;
}

}  // namespace

std::string encode_output(std::string_view text, Encoding encoding, Eol eol, bool bom, Diagnostics& diagnostics) {
  std::string out;
  if (encoding == Encoding::utf8) {
    if (bom) out = "\xEF\xBB\xBF";
    out += with_eol(valid_utf8(text) ? std::string(text) : windows1252_to_utf8(text), eol);
    return out;
  }
  return with_eol(to_windows1252(text, diagnostics), eol);
}

}  // namespace cnctrans::translator
