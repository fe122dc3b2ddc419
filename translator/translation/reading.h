// What every command starts with: a program of a dialect, its machine, and the reader.
#pragma once

#include <optional>
#include <string>

#include "base/diagnostics.h"
#include "base/source.h"
#include "translator/files/loader.h"
#include "translator/files/registry.h"
#include "translator/pipeline.h"

namespace cnctrans::translator {

/// One program that is opened, and read. Stays where it is: the loader points to the profile.
class Reading {
 public:
  Reading() = default;
  Reading(const Reading&) = delete;
  Reading& operator=(const Reading&) = delete;

  /// Finds the dialect, opens the program, chooses its machine. False, and why in `error`: usage, nothing was read.
  bool open(const Input& input, const std::string& dialect, const InputOptions& options, std::string* error);
  /// Reads it; what it has to say goes to `diagnostics`.
  const ir::Program& read(Diagnostics& diagnostics, frontends::ReadStats* stats = nullptr);

  /// The machine has this datum.
  void give(const std::string& datum, double value) { profile_->data[datum] = value; }

  [[nodiscard]] const Dialect& dialect() const { return *dialect_; }
  [[nodiscard]] const SourcePtr& source() const { return source_; }
  [[nodiscard]] const machine::Profile& profile() const { return *profile_; }
  [[nodiscard]] Loader& loader() { return *loader_; }

 private:
  const Dialect* dialect_ = nullptr;
  SourcePtr source_;
  bool in_memory_ = false;
  std::optional<machine::Profile> profile_;
  std::optional<Loader> loader_;
};

}  // namespace cnctrans::translator
