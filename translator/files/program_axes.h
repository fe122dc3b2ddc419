// Axes that a program moves and a default machine lacks: nobody has named a machine, so the default one gets them.
#pragma once

#include <string>

#include "base/diagnostics.h"
#include "base/source.h"
#include "machine/profile.h"
#include "translator/files/registry.h"

namespace cnctrans::translator {

/// Adds to a default machine the axes Y U V W (linear) and A B C (rotary) that the reader of the language finds words
/// of in `source`, and says so in the machine's name ("fagor-lathe+YB"). Reads the text a second time only where such a
/// word may stand in it.
void add_axes_of_program(const Dialect& dialect, const SourceText& source, machine::Profile& profile);
/// The letters that were added; empty: none.
std::string added_axes(const machine::Profile& profile);
/// Adds these letters where they are missing.
void add_axes(machine::Profile& profile, const std::string& letters);
/// CNC-AXES, at the start of the file: which axes were added, and how to name the machine.
void note_added_axes(const machine::Profile& profile, FileId file, Diagnostics& diagnostics);

}  // namespace cnctrans::translator
