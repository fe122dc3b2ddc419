// The hot path: plain blocks of straight-line programs, one call a block, no allocation, no look-up by name.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "backends/common/backend.h"
#include "backends/common/numbers.h"
#include "backends/common/style.h"

namespace cnctrans::backends {

/// What a plain block may look like in a language; built once from Style and profile, then changed by the dialect where
/// it differs. An empty text: that word is not plain, the block goes to the whole-program writer.
struct PlainTable {
  static constexpr std::size_t setting_values = 4;
  std::array<std::array<std::string_view, setting_values>, ir::setting_count> settings{};
  std::array<std::string_view, 19> motions{};  ///< by MotionKind
  std::array<std::string_view, ir::axis::first_extra> axes{};
  std::array<std::string_view, ir::axis::first_extra> centers{};  ///< address of a centre coordinate, by axis
  ir::CenterMode center_mode = ir::CenterMode::from_start;        ///< what such a word means there
  std::string_view radius;                                        ///< "R", "CR="
  bool radius_major = true;                                       ///< a negative radius has the same meaning there
  std::string_view feed = "F", spindle = "S", tool = "T", offset = "D";
  std::array<std::string_view, 3> spindle_states{};  ///< off cw ccw
  std::array<std::string_view, 4> coolant_states{};  ///< off flood mist second
  std::array<std::string_view, 2> stops{};           ///< M0 M1
  std::string_view tool_change;                      ///< M6
  std::string_view work_offset_off;
  std::array<std::string_view, 5> work_offsets{};  ///< rows 1.. at index 1..
  std::string_view shift_off;                      ///< ends the programmed shift of all axes, alone in its line
  std::string_view end_program;                    ///< M30
  std::string_view dwell;                          ///< "G4 F", alone in its line
  double dwell_unit = 1;                           ///< seconds of one unit of it
  bool offset_waits = false;                       ///< an offset beside a T counts from the change of the tool on
  bool select_changes_too = false;                 ///< a T that also carries out the change is a plain T there
  bool units_with_feed = true;                     ///< the codes of `units` change F words as well
  bool zero_feed = true;                           ///< F0 is a plain word there, not one with a meaning of its own
  bool axes_in_order = false;                      ///< coordinate and centre words must come in the order of their axes
  bool tells_rotary = false;                       ///< of the first absolute rotary word tell_rotary() says something
  bool work_offset_alone = false;                  ///< a work offset stands alone in its line
  /// M codes that are carried as they are (no meaning, or the same one, on the target).
  std::array<bool, 1000> machine_functions{};
};

/// The table of a style and a profile: everything that is said by one code.
PlainTable plain_table(const Style& style, const machine::Profile& profile);

/// Shared by all languages. write() returns false for everything that is not plain in the table; nothing was written
/// then.
class PlainStreamWriter : public StreamWriter {
 public:
  PlainStreamWriter(const Style& style, const WriteOptions& options, const PlainTable& table);
  ~PlainStreamWriter() override;
  void begin(const ir::Program& frame, std::string& out) override;
  bool write(const ir::Statement& statement, std::string& out, Diagnostics& diagnostics) final;
  void end(std::string& out) override;
  [[nodiscard]] int places_kept() const override;
  [[nodiscard]] bool waits() const override { return offset_waits_; }

 protected:
  /// Lines before the first block (header, title). Default: none.
  virtual void header(const ir::Program& frame, std::string& out);
  /// What is to be said of the first absolute rotary word of the program. Default: nothing.
  virtual void tell_rotary(const ir::CoordWord& word, const Span& block, Diagnostics& diagnostics) const;
  [[nodiscard]] bool same_dialect() const { return same_dialect_; }

 private:
  struct Word;
  struct Words;
  bool collect(const ir::Block& b, Words& words) const;
  void look_for_rotary(const ir::Block& b, const Span& span, Diagnostics& diagnostics);
  bool add_action(const ir::Action& a, bool moves, Words& words) const;
  bool add_modal(const ir::ModalSet& m, Word& w) const;
  bool add_motion(const ir::Motion& m, Words& words) const;
  [[nodiscard]] bool order_fits(const ir::Action& a, std::size_t code, bool moves) const;
  bool write_line(const ir::LineInfo& info, const Words& words, std::string& out, Diagnostics& diagnostics);
  bool write_number(const Word& w, char*& p, const char* end);
  bool write_head(const ir::LineInfo& info, bool numbered, char*& p, const char* end);
  void wrap(std::string& out, std::size_t from, std::size_t comments) const;
  void write_comments(const ir::LineInfo& info, std::string& out, Diagnostics* diagnostics) const;

  Style style_;
  WriteOptions options_;
  PlainTable table_;
  NumberFormat numbers_;
  std::unique_ptr<Words> words_;              ///< of the block being written; its memory is used again and again
  std::array<std::uint8_t, 1000> m_after_{};  ///< 1: the target carries the M code out after the motion
  std::array<std::uint16_t, 8> m_codes_{};    ///< spindle off cw ccw, coolant off flood mist second, tool change
  bool same_dialect_ = false;
  bool lathe_ = false;
  bool rotary_told_ = false, incremental_ = false;
  std::optional<bool> changes_tools_;  ///< the answer of the options, asked once
  bool offset_waits_ = false;          ///< a D stands beside its T: its change of the tool must come next
  bool ends_in_comment_ = false;       ///< the line written last: no word can follow in it
  bool rounded_ = false, rounding_noted_ = false;
  std::int64_t next_number_ = 0;
};

}  // namespace cnctrans::backends
