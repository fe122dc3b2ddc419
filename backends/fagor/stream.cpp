#include "backends/fagor/stream.h"

#include "backends/fagor/tables.h"
#include "backends/fagor/writer.h"

namespace cnctrans::backends::fagor {
namespace {

using dialects::fagor::Use;

class Plain : public PlainStreamWriter {
 public:
  Plain(const Style& style, const WriteOptions& options, const PlainTable& table)
      : PlainStreamWriter(style, options, table), options_(options) {}

 protected:
  void header(const ir::Program& frame, std::string& out) override {
    const std::string line = header_line(frame, options_);
    if (line.empty()) return;
    out += line;
    out += '\n';
  }
  void tell_rotary(const ir::CoordWord& word, const Span& block, Diagnostics& diagnostics) const override {
    say_rotary(ir::fixed_axis_name(word.axis), word_span(block, word.pos), diagnostics);
  }

 private:
  const WriteOptions& options_;
};

PlainTable table_of(const Style& style, const machine::Profile& profile, bool lathe, bool inch) {
  PlainTable t = plain_table(style, profile);
  // G151 and G152 act on the blocks that follow: the whole-program writer knows where they stand.
  t.settings[static_cast<std::size_t>(ir::Setting::diameter)] = {};
  // A later change to inches changes the number of decimals.
  if (!inch) t.settings[static_cast<std::size_t>(ir::Setting::units)][static_cast<std::size_t>(ir::Units::inch)] = {};
  for (ir::AxisId axis = 0; axis < ir::axis::a; ++axis) t.centers[axis] = center_letter(axis);
  t.tells_rotary = true;
  t.radius = style.radius_address;
  t.work_offset_off = g_word(lathe, Use::machine_coordinates);
  t.shift_off = g_word(lathe, Use::shift);
  for (std::size_t row = 1; row < t.work_offsets.size(); ++row) {
    t.work_offsets[row] = g_word(lathe, Use::work_offset, static_cast<int>(row));
  }
  t.end_program = "M30";
  t.dwell = "G04 K";
  t.dwell_unit = 0.01;
  const std::string how = profile.option("fagor.tool_change");
  t.offset_waits = how.empty() || how == "m6";
  t.select_changes_too = !how.empty() && how != "m6";
  t.zero_feed = false;
  t.axes_in_order = true;
  t.work_offset_alone = true;
  return t;
}

/// The style depends on the program (language, unit): the writer is made when that is known.
class Stream : public StreamWriter {
 public:
  explicit Stream(const WriteOptions& options) : options_(options) {}

  void begin(const ir::Program& frame, std::string& out) override {
    const bool lathe = options_.profile->kind == machine::Kind::lathe;
    const bool inch = frame.unit_hint == ir::Units::inch;
    const Style style = make_style(lathe, inch, frame.dialect != dialect_name);
    writer_ = std::make_unique<Plain>(style, options_, table_of(style, *options_.profile, lathe, inch));
    writer_->begin(frame, out);
  }
  bool write(const ir::Statement& statement, std::string& out, Diagnostics& diagnostics) override {
    if (is_empty_line(statement)) {
      out += ";\n";
      return true;
    }
    return writer_ != nullptr && writer_->write(statement, out, diagnostics);
  }
  void end(std::string& out) override {
    if (writer_) writer_->end(out);
  }
  [[nodiscard]] int places_kept() const override { return writer_ != nullptr ? writer_->places_kept() : -1; }
  [[nodiscard]] bool waits() const override { return writer_ != nullptr && writer_->waits(); }

 private:
  WriteOptions options_;
  std::unique_ptr<Plain> writer_;
};

}  // namespace

std::unique_ptr<StreamWriter> make_stream(const WriteOptions& options) {
  return std::make_unique<Stream>(options);
}

}  // namespace cnctrans::backends::fagor
