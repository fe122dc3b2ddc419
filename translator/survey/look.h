// What reading a program shows: its kind, what it uses, what it calls and asks of its machine.
#pragma once

#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "translator/pipeline.h"

namespace cnctrans::translator {

/// What a program calls or asks for, and how often.
struct Need {
  std::size_t times = 0;
  std::vector<std::string> arguments;  ///< of a call: its letters, or an empty text for each by position
};

struct ProgramLook {
  std::string path;     ///< below the folder
  std::string dialect;  ///< registry name; empty: no reader understands it
  std::string kind;     ///< a word of program_kinds()
  std::size_t lines = 0, blocks = 0, unread = 0;
  std::set<std::string> features;
  std::set<std::string> routines;     ///< names that others can call it and its subprograms by
  std::map<std::string, Need> calls;  ///< of what is not in the program itself
  std::map<std::string, Need> data;   ///< machine data that the target can't name, or that are of this machine
  std::map<std::string, Need> names;  ///< names that nothing in the program defines, where a machine may define them
};

/// "CAM output", "parametric", "plain", "machine's own", "data", "no program".
const std::vector<std::string>& program_kinds();

/// `to`: of the data, only those without a counterpart there count; may be null.
ProgramLook look_at(const std::string& path, const InputOptions& options, const std::string& from, const Dialect* to);

/// One spelling for a name that programs call each other by: capitals; a number, also behind one letter, without
/// leading zeros.
std::string call_key(const std::string& name);

}  // namespace cnctrans::translator
