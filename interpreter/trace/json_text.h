// Pieces of JSON, written by hand: this is where a run without end spends its time.
#pragma once

#include <string>
#include <string_view>

namespace cnctrans::interpreter {

/// Shortest text that reads back to the same double; "-0" is "0".
void append_json_number(std::string& out, double value);
/// In quotes and escaped; bytes that are not UTF-8 are read as Windows-1252.
void append_json_text(std::string& out, std::string_view text);

}  // namespace cnctrans::interpreter
