// What variables a program uses: numbers of each numbered space, names, and where.
#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "ir/edit/rewrite.h"
#include "legaliser/legalise.h"

namespace cnctrans::ir::passes {

struct VariableUse {
  struct Named {
    std::set<std::size_t> routines;
    std::vector<std::int64_t> dimensions;
    /// 1 for a variable that is no array.
    [[nodiscard]] std::int64_t elements() const {
      std::int64_t n = 1;
      for (const auto d : dimensions) n *= std::max<std::int64_t>(d, 1);
      return n;
    }
  };
  struct Numbered {
    std::set<std::int64_t> used;
    bool computed = false;  ///< some number is found at run time
    LineInfo computed_at;
  };
  /// Machine data without a counterpart on the target are reported.
  VariableUse(const Program& program, const LegaliseContext& context);

  std::map<std::pair<SpaceId, std::string>, Named> named;
  std::map<SpaceId, Numbered> numbered;
  bool levels = false;  ///< calls open levels of local parameters

 private:
  void note(const VarRef& v, std::size_t routine, const LineInfo& line);
  void dimensions(const Declare& d, std::size_t routine);
  void system(const SystemRef& ref);
  /// What the statement reads or writes and the target has not: one for each kind of datum, with their number.
  void note_missing(const Statement& s);
  /// One error for each, where it is needed first.
  void say_lacking() const;
  struct Lacking {
    std::string what;
    Span first;
    std::size_t blocks = 0;
  };
  std::vector<Lacking> lacking_;
  std::map<std::string, std::set<std::string>> missing_;  ///< of the statement: names by kind
  const Program& program_;
  const LegaliseContext& context_;
};

/// A declaration makes the variable, and neither it nor anything else in its line gives a value: it starts at 0.
bool may_be_read_first(const Program& program, const std::pair<SpaceId, std::string>& key);

}  // namespace cnctrans::ir::passes
