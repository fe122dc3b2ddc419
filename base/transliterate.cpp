#include "base/transliterate.h"

#include <array>

#include "base/source.h"
#include "base/text.h"

namespace cnctrans {
namespace {

struct Letter {
  char32_t code;
  std::string_view ascii;
};
// Latin letters with marks that European shops use; the German ones as they are spelled out.
constexpr std::array letters{
    Letter{0xC4, "AE"},  Letter{0xD6, "OE"},   Letter{0xDC, "UE"},   Letter{0xE4, "ae"},  Letter{0xF6, "oe"},
    Letter{0xFC, "ue"},  Letter{0xDF, "ss"},   Letter{0xC6, "AE"},   Letter{0xE6, "ae"},  Letter{0xD8, "OE"},
    Letter{0xF8, "oe"},  Letter{0xC5, "AA"},   Letter{0xE5, "aa"},   Letter{0xC7, "C"},   Letter{0xE7, "c"},
    Letter{0xD1, "N"},   Letter{0xF1, "n"},    Letter{0xDD, "Y"},    Letter{0xFD, "y"},   Letter{0x0141, "L"},
    Letter{0x0142, "l"}, Letter{0x0152, "OE"}, Letter{0x0153, "oe"}, Letter{0xB0, "DEG"}, Letter{0xB5, "u"},
    Letter{0x2013, "-"}, Letter{0x2014, "-"},  Letter{0x2018, "'"},  Letter{0x2019, "'"}, Letter{0x201C, "'"},
    Letter{0x201D, "'"}, Letter{0xA0, " "},    Letter{0xD7, "x"}};
struct Range {
  char32_t lo, hi;
  char ascii;
};
constexpr std::array ranges{Range{0xC0, 0xC5, 'A'}, Range{0xC8, 0xCB, 'E'}, Range{0xCC, 0xCF, 'I'},
                            Range{0xD2, 0xD6, 'O'}, Range{0xD9, 0xDC, 'U'}, Range{0xE0, 0xE5, 'a'},
                            Range{0xE8, 0xEB, 'e'}, Range{0xEC, 0xEF, 'i'}, Range{0xF2, 0xF6, 'o'},
                            Range{0xF9, 0xFC, 'u'}};

bool append_letter(std::string& out, char32_t code) {
  for (const Letter& l : letters) {
    if (l.code == code) {
      out += l.ascii;
      return true;
    }
  }
  for (const Range& r : ranges) {
    if (code >= r.lo && code <= r.hi) {
      out += r.ascii;
      return true;
    }
  }
  return false;
}

}  // namespace

std::string to_ascii(std::string_view text, bool* lossy) {
  const std::string utf8 = to_utf8(text);
  std::string out;
  out.reserve(utf8.size());
  for (std::string_view rest = utf8; !rest.empty();) {
    char32_t code = 0;
    std::size_t length = utf8_length(rest, &code);
    if (length == 0) length = 1;
    if (length == 1) {
      const char c = rest.front();
      out += (c == '\t') ? ' ' : (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) ? '?' : c;
    } else if (!append_letter(out, code)) {
      out += '?';
      if (lossy != nullptr) *lossy = true;
    }
    rest.remove_prefix(length);
  }
  return out;
}

}  // namespace cnctrans
