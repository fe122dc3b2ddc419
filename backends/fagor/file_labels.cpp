#include "backends/fagor/file_labels.h"

#include <algorithm>
#include <charconv>
#include <map>
#include <set>
#include <string>

#include "backends/common/labels.h"
#include "legaliser/edit/editor.h"

namespace cnctrans::backends::fagor {
namespace {

using Numbers = std::set<std::string, std::less<>>;

template <class BodyType, class Visit>
void each_number(BodyType& body, const Visit& visit) {
  ir::for_each_statement(body, [&](auto& s) {
    if (!s.line.number.empty()) visit(s.line);
  });
}

std::int64_t value_of(std::string_view digits) {
  std::int64_t n = 0;
  std::from_chars(digits.data(), digits.data() + digits.size(), n);
  return n;
}

/// Targets of the routine's own jumps and ranges.
struct Targets {
  Numbers numbers;
  bool computed = false;
};
Targets targets_of(ir::Routine& routine) {
  Targets t;
  ir::for_each_statement(routine.body, [&](ir::Statement& s) {
    ir::passes::each_label_ref(s, [&](ir::LabelRef& l, bool /*end*/) {
      if (l.computed) t.computed = true;
      if (l.is_number) t.numbers.emplace(without_leading_zeros(l.text));
    });
  });
  return t;
}

class FileLabels {
 public:
  FileLabels(ir::Program& program, const FileGroup& file, Diagnostics& diagnostics)
      : program_(program), diagnostics_(diagnostics) {
    for (const std::size_t i : file.routines) {
      ir::Routine& r = program.routines[i];
      each_number(r.body, [this](const ir::LineInfo& l) { last_ = std::max(last_, value_of(l.number)); });
      for (const std::string& n : targets_of(r).numbers) last_ = std::max(last_, value_of(n));
    }
    last_ -= last_ % 10;
  }

  void routine(ir::Routine& r) {
    const Targets targets = targets_of(r);
    std::map<std::string, std::string, std::less<>> renamed;
    each_number(r.body, [&](const ir::LineInfo& l) {
      const std::string digits(without_leading_zeros(l.number));
      if (taken_.count(digits) == 0 || renamed.count(digits) != 0) return;
      if (targets.computed) return computed(r, l, digits);
      if (targets.numbers.count(digits) != 0) renamed.emplace(digits, std::to_string(last_ += 10));
    });
    if (!renamed.empty()) rename(r, renamed);
    each_number(r.body, [this](const ir::LineInfo& l) { taken_.emplace(without_leading_zeros(l.number)); });
  }

 private:
  void computed(const ir::Routine& r, const ir::LineInfo& line, const std::string& digits) {
    if (!reported_.insert(&r).second) return;
    diagnostics_.error("TRN-240", line.span,
                       "block number " + digits +
                           " stands in an earlier routine of the file too, and a jump of this subroutine "
                           "computes its target: the target control would find the earlier one",
                       "give the blocks of this subroutine numbers of their own");
  }

  void rename(ir::Routine& r, const std::map<std::string, std::string, std::less<>>& renamed) {
    const auto name_of = [&](std::string_view digits) { return renamed.find(without_leading_zeros(digits)); };
    ir::for_each_statement(r.body, [&](ir::Statement& s) {
      if (const auto to = name_of(s.line.number); !s.line.number.empty() && to != renamed.end()) {
        s.line.number = program_.keep(to->second);
      }
      ir::passes::each_label_ref(s, [&](ir::LabelRef& l, bool /*end*/) {
        if (l.computed || !l.is_number) return;
        if (const auto to = name_of(l.text); to != renamed.end()) l.text = to->second;
      });
    });
  }

  ir::Program& program_;
  Diagnostics& diagnostics_;
  std::int64_t last_ = 0;
  Numbers taken_;
  std::set<const ir::Routine*> reported_;
};

/// Some target of a routine stands in an earlier routine too.
bool has_conflict(const ir::Program& program, const std::vector<std::size_t>& order) {
  const LabelUse use(program);
  Numbers taken;
  for (const std::size_t i : order) {
    const ir::Body& body = program.routines[i].body;
    bool found = false;
    each_number(body, [&](const ir::LineInfo& l) {
      const auto digits = without_leading_zeros(l.number);
      found = found || (taken.count(digits) != 0 && (use.is_target(i, digits) || !use.certain()));
    });
    if (found) return true;
    each_number(body, [&](const ir::LineInfo& l) { taken.emplace(without_leading_zeros(l.number)); });
  }
  return false;
}

}  // namespace

std::optional<ir::Program> with_file_labels(const ir::Program& program, const std::vector<FileGroup>& files,
                                            Diagnostics& diagnostics) {
  std::optional<ir::Program> copy;
  for (const FileGroup& file : files) {
    if (file.routines.size() < 2 || !has_conflict(program, file.routines)) continue;
    if (!copy) copy = program;
    FileLabels labels(*copy, file, diagnostics);
    for (const std::size_t i : file.routines) labels.routine(copy->routines[i]);
  }
  return copy;
}

}  // namespace cnctrans::backends::fagor
