// What the words of the dialects have in common.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "ir/modal.h"
#include "lsp/words/words.h"

namespace cnctrans::lsp {

void add_words(std::vector<WordInfo>& out, WordKind kind, std::initializer_list<std::string_view> words);
/// "rapid", "plane zx", "units inch".
std::string setting_title(ir::Setting setting, std::uint8_t value);
std::string motion_title(ir::MotionKind kind);
/// The parts of a list with commas.
std::vector<std::string_view> parts_of(std::string_view list);

}  // namespace cnctrans::lsp
