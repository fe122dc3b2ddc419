// Letters of the language, which knows no case.
#pragma once

namespace cnctrans::sinumerik {

constexpr char capital(char c) {
  return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
}

}  // namespace cnctrans::sinumerik
