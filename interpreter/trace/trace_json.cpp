// Events as JSON, one object a line, keys in the order of the contract.
#include <charconv>
#include <cmath>

#include "base/source.h"
#include "interpreter/trace/json_text.h"
#include "interpreter/trace/trace.h"

namespace cnctrans::interpreter {

void append_json_number(std::string& out, double value) {
  if (value == 0) {
    out += '0';
    return;
  }
  if (!std::isfinite(value)) {
    out += "null";
    return;
  }
  // Shortest digits that read back to the same number; an exponent only where the plain form would be long.
  const double size = std::abs(value);
  const bool plain = size >= 1e-7 && size < 1e15;
  char buffer[64];
  const auto [end, ec] = plain ? std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::fixed)
                               : std::to_chars(buffer, buffer + sizeof buffer, value);
  out.append(buffer, end);
}

namespace {

void append_escaped(std::string& out, std::string_view text) {
  constexpr std::string_view hex = "0123456789abcdef";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (byte < 0x20) {
      out += "\\u00";
      out += hex[byte >> 4U];
      out += hex[byte & 15U];
    } else {
      out += c;
    }
  }
}

}  // namespace

void append_json_text(std::string& out, std::string_view text) {
  out += '"';
  if (valid_utf8(text)) {
    append_escaped(out, text);
  } else {
    append_escaped(out, windows1252_to_utf8(text));
  }
  out += '"';
}

std::string_view name(EventKind k) {
  switch (k) {
    case EventKind::rapid: return "rapid";
    case EventKind::linear: return "linear";
    case EventKind::arc: return "arc";
    case EventKind::thread: return "thread";
    case EventKind::dwell: return "dwell";
    case EventKind::feed_stop: return "feed_stop";
    case EventKind::spindle: return "spindle";
    case EventKind::tool: return "tool";
    case EventKind::offset: return "offset";
    case EventKind::comp: return "comp";
    case EventKind::coolant: return "coolant";
    case EventKind::m: return "m";
    case EventKind::probe: return "probe";
    case EventKind::message: return "message";
    case EventKind::stop: return "stop";
    case EventKind::end: break;
  }
  return "end";
}

std::string_view name(EndReason r) {
  switch (r) {
    case EndReason::error: return "error";
    case EndReason::event_limit: return "event_limit";
    case EndReason::step_limit: return "step_limit";
    case EndReason::program_end: break;
  }
  return "program_end";
}

namespace {

/// Appends `, "key": value` pieces to one line.
class Line {
 public:
  Line(std::string& out, const std::vector<std::string>& axis_names) : out_(out), axis_names_(axis_names) {}

  void key(std::string_view k) {
    out_ += ",\"";
    out_ += k;
    out_ += "\":";
  }
  void number(std::string_view k, double v) {
    key(k);
    append_json_number(out_, v);
  }
  void integer(std::string_view k, std::int64_t v) {
    key(k);
    char buffer[24];
    out_.append(buffer, std::to_chars(buffer, buffer + sizeof buffer, v).ptr);
  }
  void text(std::string_view k, std::string_view v) {
    key(k);
    append_json_text(out_, v);
  }
  void boolean(std::string_view k, bool v) {
    key(k);
    out_ += v ? "true" : "false";
  }
  void position(const Position& p) {
    key("to");
    char mark = '{';
    for (ir::AxisId a = 0; a < ir::axis::count_max; ++a) {
      if (((p.known >> a) & 1U) == 0) continue;
      out_ += mark;
      mark = ',';
      axis(a, p.value[a]);
    }
    if (mark == '{') out_ += mark;
    out_ += '}';
  }
  void feed(const Event& e) {
    key("feed");
    out_ += "{\"value\":";
    append_json_number(out_, e.feed);
    out_ += ",\"mode\":\"";
    out_ += ir::name(e.feed_mode);
    out_ += "\"}";
  }
  void arc(const Event& e) {
    key("plane");
    const auto axes = ir::plane_axes(e.plane);
    out_ += e.plane == ir::Plane::xy ? "\"XY\"" : (e.plane == ir::Plane::zx ? "\"ZX\"" : "\"YZ\"");
    key("center");
    out_ += '{';
    const bool swap = axes.u > axes.v;  // axes in the order of `to`
    axis(swap ? axes.v : axes.u, swap ? e.center_v : e.center_u);
    out_ += ',';
    axis(swap ? axes.u : axes.v, swap ? e.center_u : e.center_v);
    out_ += '}';
    boolean("cw", e.cw);
    integer("turns", e.turns);
  }
  void spindle(const Event& e) {
    integer("number", e.number);
    text("state", e.state);
    text("mode", e.css ? "css" : "rpm");
    number("value", e.value);
    if (e.has_limit) number("limit", e.limit);
    if (e.state == "oriented") number("angle", e.angle);
  }
  void tool(const Event& e) {
    if (e.text.empty()) {
      integer("number", e.number);
    } else {
      text("name", e.text);
    }
    boolean("change", e.change);
  }
  void end(const Event& e) {
    text("reason", name(e.reason));
    if (e.reason != EndReason::error) return;
    text("code", e.code);
    text("text", e.text);
  }

 private:
  void axis(ir::AxisId a, double value) {
    out_ += '"';
    if (a < ir::axis::first_extra) {
      out_ += ir::fixed_axis_name(a);
    } else {
      const std::size_t i = a - ir::axis::first_extra;
      out_ += i < axis_names_.size() ? axis_names_[i] : "axis" + std::to_string(a);
    }
    out_ += "\":";
    append_json_number(out_, value);
  }
  std::string& out_;
  const std::vector<std::string>& axis_names_;
};

void append_fields(Line& line, const Event& e) {
  switch (e.kind) {
    case EventKind::rapid: line.position(e.to); break;
    case EventKind::linear:
      line.position(e.to);
      line.feed(e);
      break;
    case EventKind::arc:
      line.position(e.to);
      line.arc(e);
      line.feed(e);
      break;
    case EventKind::thread:
      line.position(e.to);
      line.number("pitch", e.pitch);
      line.number("pitch_change", e.pitch_change);
      line.number("start_angle", e.start_angle);
      break;
    case EventKind::dwell: line.number(e.revolutions ? "revolutions" : "seconds", e.amount); break;
    case EventKind::feed_stop: break;
    case EventKind::spindle: line.spindle(e); break;
    case EventKind::tool: line.tool(e); break;
    case EventKind::offset: line.integer("number", e.number); break;
    case EventKind::comp: line.text("side", e.state); break;
    case EventKind::coolant: line.text("state", e.state); break;
    case EventKind::m: line.integer("code", e.number); break;
    case EventKind::probe:
      line.position(e.to);
      line.feed(e);
      line.boolean("toward", e.change);
      break;
    case EventKind::message: line.text("text", e.text); break;
    case EventKind::stop: line.boolean("optional", e.optional_stop); break;
    case EventKind::end: line.end(e); break;
  }
}

}  // namespace

void append_json(std::string& out, const Event& e, const FileTable& files, const std::vector<std::string>& axis_names) {
  out += "{\"event\":\"";
  out += name(e.kind);
  out += '"';
  Line line(out, axis_names);
  line.text("file", files.name(e.file));
  line.integer("line", e.line);
  append_fields(line, e);
  out += '}';
}

std::string to_json(const Event& e, const FileTable& files, const std::vector<std::string>& axis_names) {
  std::string out;
  append_json(out, e, files, axis_names);
  return out;
}

}  // namespace cnctrans::interpreter
