// Paths of files as URIs (RFC 3986): the form that other programs read them in.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace cnctrans {

/// Every byte but letters, digits, `- . _ ~` and `/` as `%E8`: "dir/pièce #1.pim" is "dir/pi%C3%A8ce%20%231.pim".
std::string percent_encoded(std::string_view path);
/// The other way round; nullopt: a `%` without two hexadecimal digits behind it.
std::optional<std::string> percent_decoded(std::string_view text);
/// A path as a reference: relative to whatever the reader takes as the base, or "file:///home/..." for an absolute one.
std::string uri_of_path(std::string_view path);

}  // namespace cnctrans
