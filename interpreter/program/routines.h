// All routines that a run can reach: those of the program and those of the library, each lowered once.
#pragma once

#include <map>
#include <memory>
#include <vector>

#include "interpreter/program/flow.h"
#include "interpreter/program/interpreter.h"

namespace cnctrans::interpreter {

class Routines {
 public:
  /// `variables` may be null when nothing is to be run.
  Routines(const ir::Program& program, const Options& options, Variables* variables);

  /// The routine a run begins with; null when the program has none.
  Flow* main();
  /// A called routine: of the caller's program, of the main program, of the library. Null when it is nowhere.
  Flow* find(const ir::RoutineName& name, const Flow& caller);
  /// The main part of a program that the run has written.
  Flow* main_of(const ir::Program& program);
  [[nodiscard]] bool of_main_program(const Flow& flow) const { return flow.program == &program_; }
  /// Every routine of the main program.
  std::vector<Flow*> all_of_main();

 private:
  struct Unit {
    std::vector<NumberedSpace*> spaces;
    std::map<const ir::Routine*, std::unique_ptr<Flow>> flows;
  };
  Unit& unit(const ir::Program& program);
  Flow* flow(const ir::Program& program, const ir::Routine& routine);

  const ir::Program& program_;
  const Options& options_;
  Variables* variables_;
  std::map<const ir::Program*, std::unique_ptr<Unit>> units_;
};

}  // namespace cnctrans::interpreter
