// The manual page, made from the command line's own definition: the text of --help.
#pragma once

#include <string>

namespace CLI {
class App;
}

namespace cnctrans::cli {

/// In the language of man(1).
std::string man_page(const CLI::App& app);

}  // namespace cnctrans::cli
