// Words of the control that act beside the programmed path: a run goes past them with a warning, the moves of their
// block stay (reference-language 3 and 10; motion reference 12 to 18).
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string_view>

namespace cnctrans::sinumerik {

/// How such a word is written; a row may have several.
enum class BesideForm : std::uint8_t {
  procedure = 1,  ///< TRAILON(V,Y), TMON
  address = 2,    ///< TCARR=1
  indexed = 4,    ///< OSP1[Z]=10
  code = 8        ///< PON: a G function of a group
};

struct BesideRow {
  std::string_view name;     ///< capitals
  std::string_view feature;  ///< key of the missing-features registry, one that a run goes past
  std::uint8_t forms;        ///< of BesideForm
  /// It hands back a result in its arguments: beside the path only as long as no variable stands there.
  bool gives_back = false;
  /// By itself it leaves the part alone: it defines, ends, looks or counts. What it belongs to has a word of its own.
  bool idle = false;
};
/// In alphabetical order.
std::span<const BesideRow> beside_rows();
/// By name in any case and form; null when there is none.
const BesideRow* beside(std::string_view name, BesideForm form);
/// By name in any case, whatever the form.
const BesideRow* beside(std::string_view name);

/// Feature of a system variable (capitals, with `$`) that a program may write and that changes no programmed position;
/// empty for every other one.
std::string_view beside_datum(std::string_view capitals);

/// Machine or setting data (capitals, with `$`): they change by a program or by the machine's builder only.
bool is_setting(std::string_view capitals);

/// A definition whose blocks up to its end are no moves: CTABDEF to CTABEND, CPROTDEF, NPROTDEF and
/// CONTPRON to EXECUTE.
struct Definition {
  std::string_view begin;    ///< capitals
  std::string_view end;      ///< capitals
  std::string_view feature;  ///< of all of its lines
  bool gives_back = false;   ///< as in BesideRow
};
std::span<const Definition> definitions();
/// By the procedure that begins it (capitals); null when there is none.
const Definition* definition(std::string_view begin);

/// Feature of a synchronised action (its text without number and comment, any case); empty when it could move an axis
/// that the program moves, change coordinates or set what the program reads. `is_machine_axis` knows the axes by name
/// (capitals).
std::string_view beside_action(std::string_view text, const std::function<bool(std::string_view)>& is_machine_axis);

}  // namespace cnctrans::sinumerik
