#include "backends/common/stream_writer.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>

#include "backends/common/comments.h"
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

struct PlainStreamWriter::Words {
  static constexpr std::size_t max = 40;
  std::array<Word, max> list;
  std::size_t count = 0;
  bool sorted = true;   ///< columns came in ascending order
  bool columns = true;  ///< every word has one
  bool alone = false;   ///< a word that must have the line for itself

  bool add(const Word& w) {
    if (count == max) return false;
    if (w.column == 0) {
      columns = false;
    } else if (count != 0 && w.column <= list[count - 1].column) {
      for (std::size_t i = 0; i < count; ++i) {
        if (list[i].column == w.column) return true;  // one word of the source, several actions
      }
      sorted = false;
    }
    list[count++] = w;
    return true;
  }
  void sort(bool by_rank) {
    if (by_rank || !columns) {
      std::stable_sort(list.begin(), list.begin() + static_cast<std::ptrdiff_t>(count),
                       [](const Word& a, const Word& b) { return a.rank < b.rank; });
    } else if (!sorted) {
      for (std::size_t i = 1; i < count; ++i) {
        Word w = list[i];
        std::size_t k = i;
        for (; k > 0 && list[k - 1].column > w.column; --k) list[k] = list[k - 1];
        list[k] = w;
      }
    }
  }
};

namespace {

constexpr std::size_t line_max = 2048;

bool put(std::string_view text, char*& p, const char* end) {
  if (text.size() > static_cast<std::size_t>(end - p)) return false;
  std::memcpy(p, text.data(), text.size());
  p += text.size();
  return true;
}

template <class T>
std::size_t index_of(T value) {
  return static_cast<std::size_t>(value);
}

}  // namespace

PlainStreamWriter::PlainStreamWriter(const Style& style, const WriteOptions& options, const PlainTable& table)
    : style_(style), options_(options), table_(table) {
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

void PlainStreamWriter::begin(const ir::Program& frame, std::string& out) {
  same_dialect_ = frame.dialect == style_.dialect;
  lathe_ = frame.lathe;
  numbers_ = NumberFormat{style_.kept_decimals, style_.made_decimals, same_dialect_};
  header(frame, out);
}
void PlainStreamWriter::header(const ir::Program& /*frame*/, std::string& /*out*/) {}
void PlainStreamWriter::end(std::string& /*out*/) {}

bool PlainStreamWriter::write(const ir::Statement& statement, std::string& out, Diagnostics& diagnostics) {
  const ir::LineInfo& info = statement.line;
  if (!info.labels.empty()) return false;
  Words words;
  if (const auto* b = std::get_if<ir::Block>(&statement.node)) {
    if (info.joined || !collect(*b, words)) return false;
  } else if (const auto* e = std::get_if<ir::End>(&statement.node)) {
    const std::string_view text = same_dialect_ && !e->text.empty() ? e->text : table_.end_program;
    if (text.empty()) return false;
    if (info.joined && !out.empty() && out.back() == '\n') {  // goes on the line of its block
      out.back() = ' ';
      out += text;
      out += '\n';
      return true;
    }
    words.add(Word{text, {}, 0, 0, Rank::tail, false});
  } else {
    return false;
  }
  words.sort(style_.order_by_rank);
  if (!write_line(info, words, out)) return false;
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
  for (const ir::Action& a : b.actions) {
    if (!add_action(a, moves, words)) return false;
  }
  if (b.has_motion && !add_motion(b.motion, words)) return false;
  return !words.alone || words.count == 1;
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
  Word w;
  w.column = a.pos.column;
  w.rank = Rank::machine;
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
  bool m_code_fits = true;
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
  return words.add(w);
}

bool PlainStreamWriter::add_motion(const ir::Motion& m, Words& words) const {
  if (m.extra || m.frame != ir::FrameUse::normal || !m.keeps_modal) return false;
  if (m.kind != ir::MotionKind::modal) {
    Word w;
    const std::string_view code = index_of(m.kind) < table_.motions.size() ? table_.motions[index_of(m.kind)] : "";
    if (code.empty()) return false;
    w.address = same_dialect_ && !m.code_text.empty() ? m.code_text : code;
    w.column = m.code_pos.column;
    w.rank = Rank::motion_code;
    if (!words.add(w)) return false;
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
        c.direction != ir::RotaryDirection::as_value || !c.value.literal() || c.axis >= table_.axes.size()) {
      return false;
    }
    if (!words.add(Word{table_.axes[c.axis], c.value.text, c.value.number, c.pos.column, Rank::coordinate, true}))
      return false;
  }
  for (const ir::CenterWord& c : m.centers) {
    if (c.mode != table_.center_mode || !c.value.literal() || c.axis >= table_.centers.size()) return false;
    if (table_.centers[c.axis].empty() || (lathe_ && c.scale != ir::WordScale::radius)) return false;
    if (!words.add(Word{table_.centers[c.axis], c.value.text, c.value.number, c.pos.column, Rank::center, true}))
      return false;
  }
  if (m.radius_given) {
    if (!m.radius.literal() || table_.radius.empty()) return false;
    if (m.radius.number < 0 && !table_.radius_major) return false;
    if (!words.add(Word{table_.radius, m.radius.text, m.radius.number, m.radius_pos.column, Rank::radius, true}))
      return false;
  }
  return true;
}

bool PlainStreamWriter::write_number(const Word& w, char*& p, const char* end) {
  if (static_cast<std::size_t>(end - p) < w.text.size() + 1) return false;
  if (!w.text.empty()) {
    if (numbers_.verbatim) return put(w.text, p, end);
    const char* from = w.text.data();
    const char* const last = from + w.text.size();
    if (*from == '+') ++from;
    char* q = p;
    const char* point = nullptr;
    bool plain = from != last;
    for (; from != last; ++from) {
      const char c = *from;
      if (c == '.') {
        if (point != nullptr) plain = false;
        point = q;
      } else if (static_cast<unsigned char>(c - '0') > 9 && !(c == '-' && q == p)) {
        plain = false;
      }
      *q++ = c;
    }
    if (plain && (point == nullptr || q - point - 1 <= numbers_.kept_decimals)) {
      p = q;
      return true;
    }
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

void PlainStreamWriter::write_comments(const ir::LineInfo& info, std::string& out) const {
  bool first = true;
  for (const ir::CommentText& c : info.comments) {
    if (!first) out += ' ';
    first = false;
    if (same_dialect_) {
      out += style_.comment.open;
      out += c.text;
      out += style_.comment.close;
    } else {
      out += comment(c.text, style_.comment, false, nullptr);
    }
  }
}

bool PlainStreamWriter::write_line(const ir::LineInfo& info, const Words& words, std::string& out) {
  char line[line_max];
  char* p = line;
  const char* const end = line + line_max;
  if (!write_head(info, words.count != 0, p, end)) return false;
  char* const head_end = p;
  for (std::size_t i = 0; i < words.count; ++i) {
    const Word& w = words.list[i];
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
  if (!has_comments && words.count == 0 && head_end == line) return true;  // nothing to say
  const bool comment_before = has_comments && style_.comment.line_before && words.count != 0 && !same_dialect_;
  if (comment_before) {
    write_comments(info, out);
    out += '\n';
  }
  out.append(line, static_cast<std::size_t>(p - line));
  if (has_comments && !comment_before) {
    if (p != line) out.append(words.count == 0 ? 1 : style_.comment.gap, ' ');
    write_comments(info, out);
  } else if (words.count == 0 && !style_.only_label.empty()) {
    out += ' ';
    out += style_.only_label;
  }
  out += '\n';
  return true;
}

// ---- table ---------------------------------------------------------------------------------------------------------

namespace {

/// M words by number; the texts live as long as the program.
std::string_view m_text(std::int32_t code, bool two_digits) {
  static const std::array<std::string, 200> texts = [] {
    std::array<std::string, 200> t;
    for (std::size_t i = 0; i < 100; ++i) {
      t[i] = "M" + std::to_string(i);
      t[100 + i] = i < 10 ? "M0" + std::to_string(i) : t[i];
    }
    return t;
  }();
  if (code < 0 || code > 99) return {};
  return texts[static_cast<std::size_t>(code) + (two_digits ? 100 : 0)];
}

std::int32_t code_with(const machine::Profile& profile, MMeaning meaning, std::int32_t usual) {
  const machine::MCode* at = profile.m_code(usual);
  if (at == nullptr || at->meaning == meaning) return usual;
  for (const machine::MCode& m : profile.m_codes) {
    if (m.meaning == meaning) return m.code;
  }
  return usual;
}

}  // namespace

PlainTable plain_table(const Style& style, const machine::Profile& profile) {
  PlainTable t;
  for (const ModalCode& c : style.modal_codes) {
    if (c.value < PlainTable::setting_values) t.settings[index_of(c.setting)][c.value] = c.code;
  }
  for (const MotionCode& c : style.motion_codes) {
    const bool plain = c.kind == ir::MotionKind::rapid || c.kind == ir::MotionKind::linear ||
                       c.kind == ir::MotionKind::arc_cw || c.kind == ir::MotionKind::arc_ccw;
    if (plain) t.motions[index_of(c.kind)] = c.code;
  }
  for (std::size_t i = 0; i < t.axes.size(); ++i) t.axes[i] = ir::fixed_axis_name(static_cast<ir::AxisId>(i));
  t.centers[ir::axis::x] = "I";
  t.centers[ir::axis::y] = "J";
  t.centers[ir::axis::z] = "K";
  t.radius = style.radius_address;
  const auto m = [&](MMeaning meaning, std::int32_t usual) {
    return m_text(code_with(profile, meaning, usual), style.two_digit_m);
  };
  t.spindle_states = {m(MMeaning::spindle_stop, 5), m(MMeaning::spindle_cw, 3), m(MMeaning::spindle_ccw, 4)};
  t.coolant_states = {m(MMeaning::coolant_off, 9), m(MMeaning::coolant_flood, 8), m(MMeaning::coolant_mist, 7),
                      m(MMeaning::coolant_second, 7)};
  t.stops = {m(MMeaning::stop, 0), m(MMeaning::optional_stop, 1)};
  t.tool_change = m(MMeaning::tool_change, 6);
  t.machine_functions.fill(true);
  for (const machine::MCode& c : profile.m_codes) {
    if (c.code < 0 || index_of(c.code) >= t.machine_functions.size()) continue;
    t.machine_functions[index_of(c.code)] = c.meaning == MMeaning::machine_function || c.meaning == MMeaning::none;
  }
  return t;
}

}  // namespace cnctrans::backends
