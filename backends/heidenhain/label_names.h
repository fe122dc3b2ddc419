// Labels of a file: LBL 10, LBL "TOP". Labels of all routines of a file share one set of names, subprograms too.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "backends/common/file_groups.h"
#include "backends/common/labels.h"
#include "ir/program.h"

namespace cnctrans::backends::heidenhain {

class LabelNames {
 public:
  /// `files`: which routines share a file.
  LabelNames(const ir::Program& program, const std::vector<FileGroup>& files, const LabelUse& use);

  /// What stands behind LBL for a block number or name of a routine that is a target; empty: it has no label.
  [[nodiscard]] std::string of(std::size_t routine, std::string_view label, bool number) const;
  /// What stands behind LBL where the subprogram begins.
  [[nodiscard]] const std::string& of_routine(std::size_t routine) const { return routines_.at(routine); }
  [[nodiscard]] bool in_file_of(std::size_t routine, std::size_t other) const;

 private:
  struct Key {
    std::size_t routine;
    bool number;
    std::string text;
    bool operator<(const Key& o) const {
      return std::tie(routine, number, text) < std::tie(o.routine, o.number, o.text);
    }
  };
  std::string fresh();
  /// The wanted name, or another one where the file has it already.
  std::string take(std::string wanted);

  std::set<std::string, std::less<>> taken_;
  std::map<Key, std::string> labels_;
  std::map<std::size_t, std::string> routines_;
  std::map<std::size_t, std::size_t> file_of_;
  std::int64_t last_ = 0;
};

}  // namespace cnctrans::backends::heidenhain
