// Shell completions, made from the command line's own definition.
#pragma once

#include <string>

namespace CLI {
class App;
}

namespace cnctrans::cli {

/// `shell` is bash, zsh or fish; empty text for any other.
std::string completion(const CLI::App& app, const std::string& shell);

}  // namespace cnctrans::cli
