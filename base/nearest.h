// "Did you mean": the known word that somebody has probably meant by an unknown one.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace cnctrans {

/// The word of `words` that is like `word`: by at most one letter in three another, capitals or not. Empty: none is.
std::string nearest(std::string_view word, const std::vector<std::string>& words);
/// "; did you mean <nearest>?", or empty.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& words);

}  // namespace cnctrans
