// Where the labels of a routine stand, and which one a jump finds. The one place that knows how a search goes.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "ir/program.h"

namespace cnctrans::ir {

/// A line that a label can stand on. `else_line` and `end_line` are lines of the structured statement `statement`.
enum class SitePart : std::uint8_t { statement, else_line, end_line };
struct LabelSite {
  std::uint32_t statement = 0;  ///< id
  SitePart part = SitePart::statement;
  std::uint32_t order = 0;  ///< place in text order among all lines of the routine, from 1
  bool operator==(const LabelSite&) const = default;
};

/// All labels of one routine; its statements must have ids. Numbers are compared without leading zeros, identifiers
/// without regard to case.
class LabelTable {
 public:
  explicit LabelTable(const Routine& routine);

  /// The site that `text` means for a statement whose line has the order `from`. A label on the line of the jump itself
  /// is found backward. `to_start` finds nothing here: the target is the routine's first statement.
  [[nodiscard]] std::optional<LabelSite> find(std::string_view text, bool is_number, Search search,
                                              std::uint32_t from) const;
  [[nodiscard]] std::optional<LabelSite> find(const LabelRef& label, Search search, std::uint32_t from) const {
    return find(label.text, label.is_number, search, from);
  }
  /// First and last line of the range that a Repeat on the line `from` runs. The first label is found like a jump's (a
  /// backward search that fails goes forward), the last one is the next of its name from there on (`whole_first`: the
  /// first of all). nullopt when a label is missing or stands in the wrong order. Only for a Repeat of this routine
  /// with fixed labels and a `last`.
  [[nodiscard]] std::optional<std::pair<LabelSite, LabelSite>> range(const Repeat& repeat, std::uint32_t from) const;
  /// All sites of a label, in text order.
  [[nodiscard]] const std::vector<LabelSite>& all(std::string_view text, bool is_number) const;
  /// All sites of all labels, in text order.
  [[nodiscard]] const std::vector<LabelSite>& sites() const { return sites_; }
  /// Order of a statement's (first) line; 0 when it is not of this routine.
  [[nodiscard]] std::uint32_t order(std::uint32_t statement_id) const;

 private:
  void add_body(const Body& body);
  void add_line(const LineInfo& line, std::uint32_t id, SitePart part);
  void add_statement(const Statement& s);

  std::map<std::string, std::vector<LabelSite>, std::less<>> by_name_;
  std::vector<LabelSite> sites_;
  std::vector<std::uint32_t> orders_;  ///< by id
  std::uint32_t order_ = 0;
};

/// How a label is written for comparison: digits without leading zeros after 'N', or the identifier in capitals after
/// '.'.
std::string label_key(std::string_view text, bool is_number);

}  // namespace cnctrans::ir
