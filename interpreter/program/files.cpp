// Files of the control that the program writes: the run keeps them, and runs one when it is called.
#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "interpreter/program/runner.h"
#include "interpreter/trace/run_codes.h"

namespace cnctrans::interpreter {

bool Runner::file_name(const ir::ExprPtr& e, std::string& out) {
  const auto id = evaluator_.id_of(e);
  out = evaluator_.is_text(id) ? to_upper_ascii(trim(evaluator_.text(id)))
                               : number_text(std::round(evaluator_.number(id)));
  return !failure_.set;
}

WrittenFile* Runner::written(const std::string& name) {
  const auto it = std::find_if(written_.begin(), written_.end(), [&name](const auto& f) { return f.name == name; });
  return it == written_.end() ? nullptr : &*it;
}

/// A file that the run has not begun itself may hold lines that nobody here knows.
bool Runner::write_file(const ir::FileStatement& f, const std::string& text) {
  std::string name;
  if (f.name && !file_name(f.name, name)) return false;
  const auto add = [&text](WrittenFile& file) {
    if (!text.empty()) file.text += text + '\n';
  };
  if (f.use == ir::FileUse::line && !f.name) {
    if (open_file_ < written_.size()) return add(written_[open_file_]), true;
    return failure_.fail(code::file_fault, "a line is written and no program is open for it");
  }
  WrittenFile* file = written(name);
  const bool there = options_.library && options_.library(ir::RoutineName{-1, name}) != nullptr;
  if (f.use == ir::FileUse::create && (file != nullptr || there))
    return failure_.fail(code::file_fault, "the program " + name + " that is to be written exists already");
  if (file == nullptr) {
    file = &written_.emplace_back();
    file->name = name;
    file->more = f.use == ir::FileUse::line || (f.use == ir::FileUse::append && there);
  } else if (f.use == ir::FileUse::replace) {
    file->text.clear();
    file->more = false;
  }
  if (f.use != ir::FileUse::append || (file->text.empty() && !file->more)) add(*file);
  if (f.use != ir::FileUse::line) open_file_ = static_cast<std::size_t>(file - written_.data());
  return true;
}

/// `out` stays null where the run has written no such program.
bool Runner::written_routine(const ir::RoutineName& name, Flow*& out) {
  const WrittenFile* file = written_.empty() ? nullptr : written(routine_text(name));
  if (file == nullptr || name.text.empty()) return true;
  if (file->more)
    return failure_.fail(code::file_fault,
                         "the program " + file->name + " was there before and has got more lines: it is not run");
  if (open_file_ < written_.size() && &written_[open_file_] == file)
    diagnostics_.warning(code::file_open_still, failure_.where,
                         "the program " + file->name +
                             " is run while it is still open for writing: whether the control does that is not known",
                         "open another program before");
  auto& program = read_written_[file->text];
  std::string why = "nothing reads it here";
  if (program == nullptr && options_.read_written) program = options_.read_written(file->name, file->text, why);
  if (program != nullptr) out = routines_.main_of(*program);
  if (out != nullptr) return true;
  return failure_.fail(code::file_fault,
                       "the program " + file->name + " that this run has written can't be run: " + why);
}

}  // namespace cnctrans::interpreter
