#include "backends/common/stream_writer.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "backends/common/comments.h"
#include "backends/common/index_of.h"
#include "backends/common/places.h"
#include "backends/common/tool_words.h"
#include "backends/common/waiting_offset.h"
#include "base/short_copy.h"
#include "base/text.h"

namespace cnctrans::backends {

using machine::MMeaning;

/// One word: an address (or a whole word) and perhaps a number.
struct PlainStreamWriter::Word {
  std::string_view address;
  std::string_view text;
  double number = 0;
  std::uint32_t column = 0;
  Rank rank = Rank::tail;
  bool has_number = false;
};

/// The words of a block, and the order to write them in. Words are built in their place: copying half-written ones
/// costs more than the writing itself.
struct PlainStreamWriter::Words {
  static constexpr std::size_t max = 40;
  std::array<Word, max> list;
  std::array<std::uint8_t, max> order{};
  std::size_t count = 0;
  bool sorted = true;   ///< columns came in ascending order
  bool columns = true;  ///< every word has one
  bool alone = false;   ///< a word that must have the line for itself

  void clear() {
    count = 0;
    sorted = columns = true;
    alone = false;
  }
  /// A place for a further word; null when the line is full. It counts after commit().
  [[nodiscard]] Word* next() { return count == max ? nullptr : &list[count]; }
  void commit() {
    const std::uint32_t column = list[count].column;
    if (column == 0) {
      columns = false;
    } else if (count != 0 && column <= list[count - 1].column) {
      for (std::size_t i = 0; i < count; ++i) {
        // One word of the source, several actions, which another language may say in a word each.
        if (list[i].column == column && list[i].address == list[count].address) return;
      }
      sorted = false;
    }
    order[count] = static_cast<std::uint8_t>(count);
    ++count;
  }
  bool add(std::string_view address, Rank rank, std::uint32_t column) {
    Word* w = next();
    if (w == nullptr) return false;
    w->address = address;
    w->column = column;
    w->rank = rank;
    w->has_number = false;
    commit();
    return true;
  }
  bool add(std::string_view address, const ir::Value& v, Rank rank, std::uint32_t column) {
    Word* w = next();
    if (w == nullptr) return false;
    w->address = address;
    w->text = v.text;
    w->number = v.number;
    w->column = column;
    w->rank = rank;
    w->has_number = true;
    commit();
    return true;
  }
  void sort(bool by_rank) {
    if (!by_rank && !columns) return place();
    if (!by_rank && sorted) return;
    const auto key = [&](std::uint8_t i) {
      return by_rank ? static_cast<std::uint32_t>(list[i].rank) : list[i].column;
    };
    for (std::size_t i = 1; i < count; ++i) {  // stable; few words, nearly in order
      const std::uint8_t w = order[i];
      std::size_t k = i;
      for (; k > 0 && key(order[k - 1]) > key(w); --k) order[k] = order[k - 1];
      order[k] = w;
    }
  }

 private:
  /// As Line does it: the words of the source in their order, each of the others before the first of a higher rank.
  void place() {
    std::size_t n = 0;
    const auto put_before = [&](std::size_t i, auto behind) {
      std::size_t at = 0;
      while (at < n && !behind(list[order[at]])) ++at;
      for (std::size_t k = n++; k > at; --k) order[k] = order[k - 1];
      order[at] = static_cast<std::uint8_t>(i);
    };
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint32_t column = list[i].column;
      if (column != 0) put_before(i, [column](const Word& w) { return w.column > column; });
    }
    for (std::size_t i = 0; i < count; ++i) {
      const Rank rank = list[i].rank;
      if (list[i].column == 0) put_before(i, [rank](const Word& w) { return w.rank > rank; });
    }
  }
};

namespace {

constexpr std::size_t line_max = 2048;

inline bool put(std::string_view text, char*& p, const char* end) {
  if (text.size() > static_cast<std::size_t>(end - p)) return false;
  p = copy_short(p, text);
  return true;
}

}  // namespace

PlainStreamWriter::PlainStreamWriter(const Style& style, const WriteOptions& options, const PlainTable& table)
    : style_(style), options_(options), table_(table), words_(std::make_unique<Words>()) {
  for (const machine::MCode& m : options.profile->m_codes) {
    if (m.code >= 0 && index_of(m.code) < m_after_.size()) m_after_[index_of(m.code)] = m.order == ir::Order::after;
  }
  const auto code_of = [](std::string_view word) {
    std::uint16_t n = 0;
    if (!word.empty()) std::from_chars(word.data() + 1, word.data() + word.size(), n);
    return n;
  };
  for (std::size_t i = 0; i < 3; ++i) m_codes_[i] = code_of(table.spindle_states[i]);
  for (std::size_t i = 0; i < 4; ++i) m_codes_[3 + i] = code_of(table.coolant_states[i]);
  m_codes_[7] = code_of(table.tool_change);
}

PlainStreamWriter::~PlainStreamWriter() = default;

void PlainStreamWriter::begin(const ir::Program& frame, std::string& out) {
  same_dialect_ = frame.dialect == style_.dialect;
  lathe_ = frame.lathe;
  numbers_ = NumberFormat{style_.kept_decimals, style_.made_decimals, same_dialect_};
  header(frame, out);
}
void PlainStreamWriter::header(const ir::Program& /*frame*/, std::string& /*out*/) {}
void PlainStreamWriter::end(std::string& /*out*/) {}
void PlainStreamWriter::tell_rotary(const ir::CoordWord& /*word*/, const Span& /*block*/,
                                    Diagnostics& /*diagnostics*/) const {}
int PlainStreamWriter::places_kept() const {
  return options_.numbering == Numbering::renumber ? -1 : numbers_.kept_decimals;
}

bool PlainStreamWriter::write(const ir::Statement& statement, std::string& out, Diagnostics& diagnostics) {
  const ir::LineInfo& info = statement.line;
  if (!info.labels.empty()) return false;
  if (offset_waits_) {
    const OffsetStep step = offset_step(statement);
    if (step == OffsetStep::lost) return false;  // the D does not belong beside its T
    offset_waits_ = step == OffsetStep::passes;
  }
  Words& words = *words_;
  words.clear();
  if (const auto* b = std::get_if<ir::Block>(&statement.node)) {
    if (info.joined || !collect(*b, words)) return false;
    if (table_.tells_rotary && !rotary_told_) look_for_rotary(*b, info.span, diagnostics);
    if (table_.offset_waits && tool_and_offset_only(*b)) {
      if (!changes_tools_ && options_.changes_tools) changes_tools_ = options_.changes_tools();
      if (!changes_tools_) return false;
      if (*changes_tools_) {
        if (info.skip_mask != 0) return false;
        offset_waits_ = true;
      }
    }
  } else if (const auto* e = std::get_if<ir::End>(&statement.node)) {
    const std::string_view text = same_dialect_ && !e->text.empty() ? e->text : table_.end_program;
    if (text.empty()) return false;
    if (info.joined && ends_in_comment_) return false;
    if (info.joined && !out.empty() && out.back() == '\n') {  // goes on the line of its block
      out.back() = ' ';
      out += text;
      out += '\n';
      return true;
    }
    words.add(text, Rank::tail, 0);
  } else {
    return false;
  }
  words.sort(style_.order_by_rank);
  if (!write_line(info, words, out, diagnostics)) return false;
  if (rounded_ && !rounding_noted_) {
    rounding_noted_ = true;
    diagnostics.warning("TRN-210", info.span,
                        "numbers with more than " + std::to_string(numbers_.kept_decimals) +
                            " decimals are rounded for the target: each changes by at most " +
                            shortest(0.5 * std::pow(10.0, -numbers_.kept_decimals)) +
                            " (reported once for the program)");
  }
  return true;
}

bool PlainStreamWriter::collect(const ir::Block& b, Words& words) const {
  if (b.repeat_given != 0) return false;
  const bool moves = b.has_motion && b.motion.moves();
  if (b.has_motion && !add_motion(b.motion, words)) return false;  // first: F and M mostly stand behind
  for (const ir::Action& a : b.actions) {
    if (!add_action(a, moves, words)) return false;
  }
  return !words.alone || words.count == 1;
}

void PlainStreamWriter::look_for_rotary(const ir::Block& b, const Span& span, Diagnostics& diagnostics) {
  for (const ir::Action& a : b.actions) {
    const auto* set = std::get_if<ir::ModalSet>(&a.data);
    if (set != nullptr && set->setting == ir::Setting::distance)
      incremental_ = set->value == static_cast<std::uint8_t>(ir::Distance::incremental);
  }
  if (!b.has_motion || incremental_) return;
  for (const ir::CoordWord& c : b.motion.coords) {
    if (!ir::is_rotary_letter(c.axis)) continue;
    rotary_told_ = true;
    return tell_rotary(c, span, diagnostics);
  }
}

bool PlainStreamWriter::order_fits(const ir::Action& a, std::size_t code, bool moves) const {
  if (!moves) return true;
  return (a.order == ir::Order::after) == (m_after_[code] != 0);
}

bool PlainStreamWriter::add_modal(const ir::ModalSet& m, Word& w) const {
  const auto& codes = table_.settings[index_of(m.setting)];
  if (m.value >= codes.size()) return false;
  if (m.setting == ir::Setting::units && m.feed_too != table_.units_with_feed) return false;
  w.address = codes[m.value];
  w.rank = Rank::setting;
  return true;
}

bool PlainStreamWriter::add_action(const ir::Action& a, bool moves, Words& words) const {
  Word* const place = words.next();
  if (place == nullptr) return false;
  Word& w = *place;
  w.column = a.pos.column;
  w.rank = Rank::machine;
  w.has_number = false;
  w.address = {};
  const auto valued = [&](std::string_view address, const ir::Value& v, Rank rank) {
    if (!v.literal()) return false;
    w.address = address;
    w.text = v.text;
    w.number = v.number;
    w.rank = rank;
    w.has_number = true;
    return true;
  };
  bool plain = false;
  bool m_code_fits = !moves || a.order != ir::Order::after;  // of other words than M functions
  if (const auto* f = std::get_if<ir::SetFeed>(&a.data)) {
    const bool special = f->value.number == 0 && (f->zero_is_maximum || !table_.zero_feed);
    plain = !special && valued(table_.feed, f->value, Rank::feed);
  } else if (const auto* m = std::get_if<ir::ModalSet>(&a.data)) {
    plain = add_modal(*m, w);
  } else if (const auto* s = std::get_if<ir::SetSpindle>(&a.data)) {
    plain = s->number == 1 && valued(table_.spindle, s->value, Rank::spindle);
  } else if (const auto* r = std::get_if<ir::SpindleRun>(&a.data)) {
    const std::size_t i = index_of(r->state);
    w.address = table_.spindle_states[i];
    plain = r->number == 1;
    m_code_fits = order_fits(a, m_codes_[i], moves);
  } else if (const auto* g = std::get_if<ir::SpindleGear>(&a.data)) {
    plain = g->number == 1 && !g->automatic && g->gear >= 1 && g->gear <= 4;
    if (plain) {
      m_code_fits = order_fits(a, index_of(40 + g->gear), moves);
      w.address = "M";
      w.number = 40 + g->gear;
      w.text = {};
      w.has_number = true;
    }
  } else if (const auto* t = std::get_if<ir::ToolSelect>(&a.data)) {
    plain = t->name.empty() && (!t->changes || table_.select_changes_too) && valued(table_.tool, t->number, Rank::tool);
  } else if (const auto* d = std::get_if<ir::ToolOffset>(&a.data)) {
    plain = valued(table_.offset, d->number, Rank::offset);
  } else if (std::holds_alternative<ir::ToolChange>(a.data)) {
    w.address = table_.tool_change;
    plain = true;
    m_code_fits = order_fits(a, m_codes_[7], moves);
  } else if (const auto* c = std::get_if<ir::Coolant>(&a.data)) {
    const std::size_t i = index_of(c->state);
    w.address = table_.coolant_states[i];
    plain = true;
    m_code_fits = order_fits(a, m_codes_[3 + i], moves);
  } else if (const auto* x = std::get_if<ir::MachineFunction>(&a.data)) {
    plain = !x->auxiliary && !x->computed && x->extension < 0 && x->code >= 0 && index_of(x->code) < m_after_.size() &&
            table_.machine_functions[index_of(x->code)];
    if (plain) {
      m_code_fits = order_fits(a, index_of(x->code), moves);
      w.address = style_.two_digit_m && x->code < 10 ? "M0" : "M";
      w.number = x->code;
      w.text = {};
      w.has_number = true;
    }
  } else if (const auto* h = std::get_if<ir::Stop>(&a.data)) {
    w.address = table_.stops[h->optional ? 1 : 0];
    plain = true;
    m_code_fits = !moves || a.order == ir::Order::after;
  } else if (const auto* o = std::get_if<ir::WorkOffset>(&a.data)) {
    w.rank = Rank::setting;
    const double row = o->index.number;
    if (o->off) {
      w.address = table_.work_offset_off;
    } else if (o->index.literal() && row >= 1 && row < static_cast<double>(table_.work_offsets.size())) {
      w.address = table_.work_offsets[static_cast<std::size_t>(row)];
    }
    words.alone = words.alone || (table_.work_offset_alone && !same_dialect_);
    plain = true;
  } else if (const auto* op = std::get_if<ir::FrameOp>(&a.data)) {
    plain = op->change && op->change->slot == ir::FrameSlot::shift && op->change->combine == ir::FrameCombine::clear;
    w.address = table_.shift_off;
    w.rank = Rank::setting;
    words.alone = true;
  } else if (std::holds_alternative<ir::ExactStopBlock>(a.data)) {
    w.address = style_.exact_stop_block;
    w.rank = Rank::setting;
    plain = true;
  } else if (const auto* dwell = std::get_if<ir::Dwell>(&a.data)) {
    plain = !dwell->revolutions && valued(table_.dwell, dwell->value, Rank::setting);
    if (dwell->scale != table_.dwell_unit) {
      w.number = dwell->value.number * dwell->scale / table_.dwell_unit;
      w.text = {};
    }
    words.alone = true;
    if (w.number <= 0) plain = false;
  }
  if (!plain || w.address.empty()) return false;
  if (same_dialect_ && !a.text.empty() && !words.alone) {
    w.address = a.text;
    w.has_number = false;
  } else if (!m_code_fits) {
    return false;
  }
  words.commit();
  return true;
}

bool PlainStreamWriter::add_motion(const ir::Motion& m, Words& words) const {
  if (m.extra || m.frame != ir::FrameUse::normal || !m.keeps_modal) return false;
  if (m.kind != ir::MotionKind::modal) {
    const std::string_view code = index_of(m.kind) < table_.motions.size() ? table_.motions[index_of(m.kind)] : "";
    if (code.empty()) return false;
    const bool own = same_dialect_ && !m.code_text.empty();
    if (!words.add(own ? m.code_text : code, Rank::motion_code, m.code_pos.column)) return false;
  }
  const bool keep_order = table_.axes_in_order && !same_dialect_;
  for (std::size_t i = 1; keep_order && i < m.coords.size(); ++i) {
    if (m.coords[i].axis < m.coords[i - 1].axis) return false;
  }
  for (std::size_t i = 1; keep_order && i < m.centers.size(); ++i) {
    if (m.centers[i].axis < m.centers[i - 1].axis) return false;
  }
  for (const ir::CoordWord& c : m.coords) {
    if (c.mode != ir::WordMode::modal || c.scale != ir::WordScale::modal ||
        c.direction != ir::RotaryDirection::as_value || !c.value.literal() || c.axis >= table_.axes.size() ||
        table_.axes[c.axis].empty()) {
      return false;
    }
    if (!words.add(table_.axes[c.axis], c.value, Rank::coordinate, c.pos.column)) return false;
  }
  for (const ir::CenterWord& c : m.centers) {
    if (c.mode != table_.center_mode || !c.value.literal() || c.axis >= table_.centers.size()) return false;
    if (table_.centers[c.axis].empty() || (lathe_ && c.scale != ir::WordScale::radius)) return false;
    if (!words.add(table_.centers[c.axis], c.value, Rank::center, c.pos.column)) return false;
  }
  if (m.radius_given) {
    if (!m.radius.literal() || table_.radius.empty()) return false;
    if (m.radius.number < 0 && !table_.radius_major) return false;
    if (!words.add(table_.radius, m.radius, Rank::radius, m.radius_pos.column)) return false;
  }
  return true;
}

inline bool PlainStreamWriter::write_number(const Word& w, char*& p, const char* end) {
  if (static_cast<std::size_t>(end - p) < w.text.size() + 1) return false;
  if (!w.text.empty()) {
    if (numbers_.verbatim) return put(w.text, p, end);
    std::string_view text = w.text;
    if (text.front() == '+') text.remove_prefix(1);
    if (places_of(text) <= numbers_.kept_decimals) return put(text, p, end);
  }
  std::string text;
  if (append_number(text, w.number, w.text, numbers_) != 0) rounded_ = true;
  return put(text, p, end);
}

bool PlainStreamWriter::write_head(const ir::LineInfo& info, bool numbered, char*& p, const char* end) {
  if (info.skip_mask != 0) {
    for (std::size_t level = 0; level < 16; ++level) {
      if ((info.skip_mask >> level & 1U) == 0) continue;
      if (level >= style_.skip_marks.size() || !put(style_.skip_marks[level], p, end)) return false;
    }
    if (p[-1] != '/' && !put(" ", p, end)) return false;
  }
  if (options_.numbering == Numbering::keep) {
    if (info.number.empty()) return true;
    const char mark = same_dialect_ ? info.number_mark : 'N';
    return put({&mark, 1}, p, end) && put(info.number, p, end) && put(" ", p, end);
  }
  if (options_.numbering == Numbering::renumber && numbered) {
    next_number_ += options_.number_step;
    char digits[24];
    digits[0] = 'N';
    const auto to = std::to_chars(digits + 1, digits + sizeof digits, next_number_);
    return put({digits, static_cast<std::size_t>(to.ptr - digits)}, p, end) && put(" ", p, end);
  }
  return true;
}

/// The line from `from` on, with comments from `comments` on, as several where it is too long.
void PlainStreamWriter::wrap(std::string& out, std::size_t from, std::size_t comments) const {
  if (same_dialect_ || style_.line_length == 0 || out.size() - from <= style_.line_length) return;
  out.replace(from, std::string::npos, wrapped(out.substr(from), comments - from, style_.comment, style_.line_length));
}

void PlainStreamWriter::write_comments(const ir::LineInfo& info, std::string& out, Diagnostics* diagnostics) const {
  const bool own_lines = diagnostics == nullptr;
  for (const ir::CommentText& c : info.comments) {
    if (&c != info.comments.data()) out += own_lines ? '\n' : ' ';
    const std::size_t from = out.size();
    bool lossy = false;
    out += comment(c.text, style_.comment, same_dialect_, &lossy);
    if (lossy && diagnostics != nullptr) note_lossy_comment(word_span(info.span, c.pos), *diagnostics);
    if (own_lines) wrap(out, from, from);
  }
}

bool PlainStreamWriter::write_line(const ir::LineInfo& info, const Words& words, std::string& out,
                                   Diagnostics& diagnostics) {
  char line[line_max];
  char* p = line;
  const char* const end = line + line_max;
  if (!write_head(info, words.count != 0, p, end)) return false;
  char* const head_end = p;
  for (std::size_t i = 0; i < words.count; ++i) {
    const Word& w = words.list[words.order[i]];
    if (i != 0 && !put(" ", p, end)) return false;
    if (!put(w.address, p, end)) return false;
    if (w.has_number && !write_number(w, p, end)) return false;
  }
  if (words.count == 0 && p != line && p[-1] == ' ') --p;
  if (info.blank_lines_before != 0 && style_.blank_lines) {
    for (std::uint16_t i = 0; i < info.blank_lines_before; ++i) {
      out += style_.blank_line;
      out += '\n';
    }
  }
  const bool has_comments = !info.comments.empty();
  ends_in_comment_ = has_comments;
  if (!has_comments && words.count == 0 && head_end == line) {  // an empty line
    if (style_.blank_lines) out += std::string(style_.blank_line) + '\n';
    return true;
  }
  const bool comment_before = has_comments && style_.comment.line_before && words.count != 0 && !same_dialect_;
  if (comment_before) {
    write_comments(info, out, nullptr);
    out += '\n';
    ends_in_comment_ = false;
  }
  const std::size_t from = out.size();
  out.append(line, static_cast<std::size_t>(p - line));
  if (has_comments && !comment_before) {
    if (p != line) out.append(words.count == 0 ? 1 : style_.comment.gap, ' ');
    const std::size_t comments = out.size();
    write_comments(info, out, &diagnostics);
    wrap(out, from, comments);
  } else if (words.count == 0 && !style_.only_label.empty()) {
    out += ' ';
    out += style_.only_label;
  }
  out += '\n';
  return true;
}

}  // namespace cnctrans::backends
