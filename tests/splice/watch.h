// Names the program that runs when a test crashes or hangs.
#pragma once

#include <string>

namespace cnctrans::splice {

/// `test`: its name, for the message.
void watch_for_crashes(const char* test);
/// This runs from now on: more than 30 s of the processor are a hang.
void begins(const std::string& what, const std::string& program);

}  // namespace cnctrans::splice
