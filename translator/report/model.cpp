#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/text.h"
#include "translator/report/report.h"

namespace cnctrans::translator {

namespace {

using interpreter::Event;
using interpreter::EventKind;

constexpr double chord_error = 0.01;  // mm

bool is_move(EventKind k) {
  return k == EventKind::rapid || k == EventKind::linear || k == EventKind::arc || k == EventKind::thread ||
         k == EventKind::probe;
}

std::array<double, 3> xyz(const interpreter::Position& p) {
  return {p.value[ir::axis::x], p.value[ir::axis::y], p.value[ir::axis::z]};
}

/// Points of an arc after its start, the end included; a helix goes up evenly.
void add_arc(const Event& e, const std::array<double, 3>& from, std::vector<double>& points) {
  const auto axes = ir::plane_axes(e.plane);
  const std::array<double, 3> to = xyz(e.to);
  const double u0 = from[axes.u] - e.center_u, v0 = from[axes.v] - e.center_v;
  const double u1 = to[axes.u] - e.center_u, v1 = to[axes.v] - e.center_v;
  const double r0 = std::hypot(u0, v0), r1 = std::hypot(u1, v1);
  constexpr double full = 2 * std::numbers::pi;
  double sweep = std::atan2(v1, u1) - std::atan2(v0, u0);
  if (e.cw) sweep = -sweep;
  while (sweep <= 1e-9) sweep += full;  // start = end is a full circle
  sweep += full * e.turns;
  const double step = r0 > chord_error ? 2 * std::acos(1 - chord_error / r0) : full / 8;
  const int parts = std::clamp(static_cast<int>(std::ceil(sweep / step)), 4, 2000);
  const double first = std::atan2(v0, u0);
  for (int i = 1; i <= parts; ++i) {
    const double t = static_cast<double>(i) / parts;
    const double angle = first + (e.cw ? -sweep : sweep) * t, r = r0 + (r1 - r0) * t;
    std::array<double, 3> p{};
    p[axes.u] = e.center_u + r * std::cos(angle);
    p[axes.v] = e.center_v + r * std::sin(angle);
    p[axes.w] = from[axes.w] + (to[axes.w] - from[axes.w]) * t;
    points.insert(points.end(), i == parts ? to.begin() : p.begin(), i == parts ? to.end() : p.end());
  }
}

double length_of(const std::vector<double>& points) {
  double sum = 0;
  for (std::size_t i = 0; i + 5 < points.size(); i += 3)
    sum += std::hypot(points[i + 3] - points[i], points[i + 4] - points[i + 1], points[i + 5] - points[i + 2]);
  return sum;
}

/// What a move's time depends on beside its feed.
struct Turning {
  double speed = 0, limit = 0;  ///< rev/min, or m/min as a constant cutting speed
  bool css = false;

  void take(const Event& e) {
    if (e.state == "off" || e.state == "oriented") return;
    speed = e.value;
    css = e.css;
    limit = e.has_limit ? e.limit : 0;
  }
  [[nodiscard]] double rpm(double radius) const {
    if (!css) return speed;
    const double free = 1000 * speed / (2 * std::numbers::pi * std::max(std::abs(radius), 0.01));
    return limit > 0 ? std::min(free, limit) : free;
  }
};

double seconds_of(const Event& e, const std::vector<double>& points, const Turning& spindle) {
  if (e.kind == EventKind::rapid) return 0;
  const double length = length_of(points), radius = (points[0] + points[points.size() - 3]) / 2;
  const double per_rev = e.kind == EventKind::thread ? e.pitch : e.feed;
  double per_minute = e.feed;
  if (e.kind == EventKind::thread || e.feed_mode == ir::FeedMode::per_rev) per_minute = per_rev * spindle.rpm(radius);
  if (e.kind != EventKind::thread && e.feed_mode == ir::FeedMode::inverse_time) per_minute = e.feed * length;
  return per_minute > 0 ? length / per_minute * 60 : 0;
}

/// The start point is where the first move ends: where the machine stands before is not the program's matter.
std::vector<ReportMove> path_of(const std::vector<Event>& events, const std::vector<std::size_t>& file_index) {
  std::vector<ReportMove> path;
  std::optional<std::array<double, 3>> at;
  Turning spindle;
  std::int32_t tool = 0;
  for (const Event& e : events) {
    if (e.kind == EventKind::spindle && e.number == 1) spindle.take(e);
    if (e.kind == EventKind::tool && e.change) tool = e.number;
    if (e.kind == EventKind::dwell && !e.revolutions && !path.empty()) path.back().seconds += e.amount;
    if (!is_move(e.kind)) continue;
    const auto to = xyz(e.to);
    if (at) {
      ReportMove move{interpreter::name(e.kind), {e.file < file_index.size() ? file_index[e.file] : 0, e.line}, {}};
      move.points.assign(at->begin(), at->end());
      if (e.kind == EventKind::arc) {
        add_arc(e, *at, move.points);
      } else {
        move.points.insert(move.points.end(), to.begin(), to.end());
      }
      move.tool = tool;
      move.seconds = seconds_of(e, move.points, spindle);
      path.push_back(std::move(move));
    }
    at = to;
  }
  return path;
}

/// The files of a table as the report numbers them: index by FileId.
std::vector<std::size_t> number_files(const FileTable& files, std::vector<ReportFile>& out) {
  std::vector<std::size_t> index(files.size(), 0);
  for (FileId id = 1; id < files.size(); ++id) {
    const SourceText* text = files.source(id);
    if (text == nullptr) continue;
    index[id] = out.size();
    ReportFile file{to_utf8(files.name(id)), {}};
    for (const auto& line : text->lines()) {
      ReportLine l;
      l.text = to_utf8(line.text);
      l.status = trim(line.text).empty() ? LineStatus::blank : LineStatus::folded;
      file.lines.push_back(std::move(l));
    }
    out.push_back(std::move(file));
  }
  return index;
}

ReportFile target_file(const OutputText& out) {
  ReportFile file{out.name, {}};
  const auto text = SourceText::from_string(out.name, out.bytes);
  for (const auto& line : text->lines()) {
    ReportLine l;
    l.text = to_utf8(line.text);
    l.status = trim(line.text).empty() ? LineStatus::blank : LineStatus::exact;
    file.lines.push_back(std::move(l));
  }
  return file;
}

ReportLine* line_at(std::vector<ReportFile>& files, const ReportPlace& p) {
  if (p.file >= files.size() || p.line == 0 || p.line > files[p.file].lines.size()) return nullptr;
  return &files[p.file].lines[p.line - 1];
}

void link(Report& r, const ReportPlace& source, const ReportPlace& target) {
  ReportLine* a = line_at(r.sources, source);
  ReportLine* b = line_at(r.targets, target);
  if (a == nullptr || b == nullptr || b->status == LineStatus::blank) return;
  a->others.push_back(target);
  b->others.push_back(source);
  if (a->status == LineStatus::folded) a->status = LineStatus::exact;
}

void link_lines(Report& r, const TranslateResult& result, const std::vector<std::size_t>& file_index) {
  for (std::size_t f = 0; f < result.outputs.size(); ++f) {
    const auto& spans = result.outputs[f].map.lines;
    for (std::size_t i = 0; i < spans.size(); ++i) {
      const Span& s = spans[i];
      if (!s.known() || s.file >= file_index.size()) continue;
      link(r, {file_index[s.file], s.line}, {f, static_cast<std::uint32_t>(i + 1)});
    }
  }
}

LineStatus status_of(Severity s) {
  return s == Severity::error ? LineStatus::refused : s == Severity::warning ? LineStatus::review : LineStatus::noted;
}

void mark_diagnostics(Report& r, const std::vector<std::size_t>& file_index) {
  const auto raise = [&r, &file_index](FileId file, std::uint32_t line, LineStatus status) {
    if (file >= file_index.size()) return;
    ReportLine* l = line_at(r.sources, {file_index[file], line});
    if (l != nullptr) l->status = std::max(l->status, status);
  };
  for (const auto& d : r.diagnostics.all()) {
    if (d.span.known()) raise(d.span.file, d.span.line, status_of(d.severity));
  }
  for (const auto& [code, more] : r.diagnostics.more()) {
    for (const auto& range : more.lines) {
      for (std::uint32_t line = range.first; line <= range.last; ++line)
        raise(range.file, line, status_of(more.severity));
    }
  }
}

}  // namespace

std::string_view name(LineStatus s) {
  constexpr std::array<std::string_view, static_cast<std::size_t>(LineStatus::count_)> names{
      "blank", "exact", "folded", "noted", "review", "untranslated", "refused"};
  return names[static_cast<std::size_t>(s)];
}

std::vector<std::size_t> Report::counts() const {
  std::vector<std::size_t> n(static_cast<std::size_t>(LineStatus::count_));
  for (const auto& f : sources) {
    for (const auto& l : f.lines) ++n[static_cast<std::size_t>(l.status)];
  }
  return n;
}

Report make_report(const std::string& path, const TranslateOptions& options, const TranslateResult& result,
                   const std::vector<std::string>& written) {
  Report r;
  r.source_name = path;
  r.from = find_dialect(options.from)->title;
  r.to = find_dialect(options.to)->title;
  r.source_machine = result.source_machine;
  r.target_machine = result.target_machine;
  r.lathe = result.lathe;
  r.refused = result.refused;
  r.diagnostics = result.diagnostics;
  r.files = result.files;
  const auto source_index = number_files(result.files, r.sources);
  for (const auto& out : result.outputs) r.targets.push_back(target_file(out));
  for (std::size_t i = 0; i < std::min(written.size(), r.targets.size()); ++i) r.targets[i].name = to_utf8(written[i]);
  link_lines(r, result, source_index);
  mark_diagnostics(r, source_index);
  for (const Span& s : result.untranslated) {
    if (s.file >= source_index.size()) continue;
    if (ReportLine* l = line_at(r.sources, {source_index[s.file], s.line})) l->status = LineStatus::untranslated;
  }
  r.to_do = result.to_do;
  r.verdict = result.refused ? "refused" : "not asked";
  if (!result.refused) r.verdict_text = proof_text(result, result.target_files);
  if (result.verified) {
    const auto& v = result.verdict;
    r.verdict = verifier::name(v.status);
    r.events = v.events;
    r.moves = v.moves;
    r.max_length = v.max_length;
    r.blocks = v.coverage.blocks;
    r.replayed = v.coverage.replayed;
    r.target_blocks = v.target_coverage.blocks;
    r.target_replayed = v.target_coverage.replayed;
    r.left_out = v.left_out;
    r.read_first = v.read_first;
    r.target_read_first = v.target_read_first;
    r.similar_cycles = v.similar_cycles;
    r.similar_length = v.similar_length;
    r.replays = v.coverage.replays;
    r.ways = v.coverage.ways;
    r.ways_taken = v.coverage.ways_taken;
    // The files of the verification are the outputs, in order.
    std::vector<std::size_t> target_index(result.target_files.size(), 0);
    for (std::size_t id = 1; id < target_index.size(); ++id) target_index[id] = id - 1;
    if (v.status == verifier::Status::differs) {
      const auto& d = v.difference;
      if (d.source_line != 0 && d.source_file < source_index.size())
        r.differs_source = ReportPlace{source_index[d.source_file], d.source_line};
      if (d.target_line != 0 && d.target_file < target_index.size())
        r.differs_target = ReportPlace{target_index[d.target_file], d.target_line};
    }
    r.source_path = path_of(result.source_trace, source_index);
    r.target_path = path_of(result.target_trace, target_index);
  }
  return r;
}

std::optional<ReportWriter> report_writer(std::string_view file_name) {
  const auto dot = file_name.rfind('.');
  const std::string ending = dot == std::string_view::npos ? "" : to_upper_ascii(file_name.substr(dot + 1));
  if (ending == "HTML" || ending == "HTM") return &report_html;
  if (ending == "JSON") return &report_json;
  if (ending == "MD") return &report_markdown;
  if (ending == "SARIF") return &report_sarif;
  return std::nullopt;
}

}  // namespace cnctrans::translator
