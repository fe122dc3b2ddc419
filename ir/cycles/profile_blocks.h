// The blocks of a program that describe the profile of a cycle.
#pragma once

#include <string>
#include <vector>

#include "ir/cycle.h"
#include "ir/cycles/machining.h"
#include "ir/program.h"

namespace cnctrans::ir::cycles {

/// The value is a name, no number.
bool is_text(const Value& value);
/// The cycle names blocks of the program as its profile.
bool has_profile(const NamedCycle& cycle);
/// The program or subprogram that the cycle names as its profile; nullopt: it names none.
std::optional<RoutineName> profile_routine(const NamedCycle& cycle);
/// The blocks from the first to the last label, both included, in the order of the text: those of the routine that
/// calls the cycle, else of the first routine that has the labels; of the program that the cycle names, if it names
/// one. Empty with a sentence: there are none.
std::vector<const Statement*> profile_blocks(const Program& program, const Routine& caller, const NamedCycle& cycle,
                                             std::string* error);

/// How the blocks of a profile are to be read.
struct ContourStart {
  ModalState modal;                 ///< units, diameter and distance mode as they are in force
  std::optional<TurnPoint> from;    ///< where the profile begins; nullopt: at its first point
  bool rapid_begins_blank = false;  ///< a block with rapid motion begins the profile of the blank
};
/// Of a cycle whose parameters are known: its own first point, when it gives one.
ContourStart contour_start(const TurnNumbers& numbers, const ModalState& modal);

/// A contour that has been read may travel in the words of its cycle, as plain numbers in mm; or the reason why there
/// is none.
void put_contour(NamedCycle& cycle, const TurnProfile& profile);
void put_contour_fault(NamedCycle& cycle, const std::string& why);
std::optional<TurnProfile> contour_in(const NamedCycle& cycle, std::string* error);

}  // namespace cnctrans::ir::cycles
