// The report for tools: JSON of our own (docs/report.md) and SARIF 2.1.0.
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/uri.h"
#include "translator/report/data.h"
#include "translator/version.h"

namespace cnctrans::translator {

using Json = nlohmann::ordered_json;

namespace {

Json place_json(const ReportPlace& p) {
  return Json::array({p.file, p.line});
}

Json files_json(const std::vector<ReportFile>& files) {
  Json list = Json::array();
  for (const auto& f : files) {
    Json lines = Json::array();
    for (const auto& l : f.lines) {
      Json line{{"text", l.text}, {"status", name(l.status)}};
      Json others = Json::array();
      for (const auto& o : l.others) others.push_back(place_json(o));
      if (!others.empty()) line["others"] = std::move(others);
      lines.push_back(std::move(line));
    }
    list.push_back({{"name", f.name}, {"lines", std::move(lines)}});
  }
  return list;
}

Json path_json(const std::vector<ReportMove>& path) {
  Json list = Json::array();
  for (const auto& m : path) {
    Json move{{"kind", m.kind}, {"at", place_json(m.place)}, {"points", m.points}};
    if (m.tool != 0) move["tool"] = m.tool;
    if (m.seconds != 0) move["seconds"] = std::round(m.seconds * 1000) / 1000;
    list.push_back(std::move(move));
  }
  return list;
}

/// Invalid UTF-8 can't occur (texts were decoded), but a file name may hold anything.
std::string dump(const Json& j, int indent) {
  return j.dump(indent, ' ', false, Json::error_handler_t::replace);
}

Json sarif_place(const std::string& file, std::uint32_t line) {
  return {
      {"physicalLocation", {{"artifactLocation", {{"uri", uri_of_path(file)}}}, {"region", {{"startLine", line}}}}}};
}

/// With columns where bytes and characters are the same count.
Json sarif_place(const Span& span, const FileTable& files) {
  Json place = sarif_place(files.name(span.file), span.line);
  const SourceText* text = files.source(span.file);
  if (text == nullptr || span.column == 0 || span.end_line != span.line || span.end_column <= span.column) return place;
  const std::string_view line = text->line_text(span.line);
  if (std::any_of(line.begin(), line.end(), [](char c) { return static_cast<unsigned char>(c) >= 0x80; })) return place;
  auto& region = place["physicalLocation"]["region"];
  region["startColumn"] = span.column;
  region["endColumn"] = span.end_column;
  return place;
}

Json sarif_result(const std::string& code, std::string_view level, const std::string& message) {
  return {{"ruleId", code}, {"level", level}, {"message", {{"text", message}}}};
}

Json not_compared(const verifier::LeftOut& l) {
  Json out;
  if (l.offset_numbers != 0) out["offset_numbers"] = l.offset_numbers;
  if (l.path_modes != 0) out["path_modes"] = l.path_modes;
  if (l.preselected_tools != 0) out["preselected_tools"] = l.preselected_tools;
  if (l.messages != 0) out["messages"] = l.messages;
  return out;
}

Json to_do_json(const Report& r) {
  Json list = Json::array();
  for (const auto& item : r.to_do) {
    Json places = Json::array();
    for (const Span& s : item.places) places.push_back({{"file", r.files.name(s.file)}, {"line", s.line}});
    list.push_back({{"code", item.code}, {"what", item.message}, {"decide", item.hint}, {"places", std::move(places)}});
  }
  return list;
}

}  // namespace

std::string report_data(const Report& r, bool with_paths) {
  Json counts;
  const auto n = r.counts();
  for (std::size_t i = 0; i < n.size(); ++i) {
    const auto status = static_cast<LineStatus>(i);
    if (n[i] != 0 || status != LineStatus::untranslated) counts[std::string(name(status))] = n[i];
  }
  Json verdict{{"status", r.verdict}, {"events", r.events}, {"moves", r.moves}, {"max_length", r.max_length}};
  if (r.replays > 1) verdict.update({{"replays", r.replays}, {"ways", r.ways}, {"ways_taken", r.ways_taken}});
  if (r.blocks != 0) verdict.update({{"blocks", r.blocks}, {"replayed", r.replayed}});
  if (r.target_blocks != 0)
    verdict.update({{"translation_blocks", r.target_blocks}, {"translation_replayed", r.target_replayed}});
  if (r.similar_cycles != 0)
    verdict.update({{"similar_cycles", r.similar_cycles}, {"similar_length", r.similar_length}});
  if (const Json aside = not_compared(r.left_out); !aside.empty()) verdict["not_compared"] = aside;
  if (!r.read_first.empty()) verdict["read_first"] = r.read_first;
  if (!r.target_read_first.empty()) verdict["translation_read_first"] = r.target_read_first;
  if (!r.verdict_text.empty()) verdict["text"] = to_utf8(r.verdict_text);
  if (r.differs_source) verdict["source_place"] = place_json(*r.differs_source);
  if (r.differs_target) verdict["target_place"] = place_json(*r.differs_target);
  Json j{{"tool", "cnctrans"},
         {"version", version},
         {"source", to_utf8(r.source_name)},
         {"from", r.from},
         {"to", r.to},
         {"machine", r.source_machine},
         {"target_machine", r.target_machine},
         {"kind", r.lathe ? "lathe" : "mill"},
         {"refused", r.refused},
         {"verdict", std::move(verdict)},
         {"lines", std::move(counts)},
         {"diagnostics", Json::parse(render_json(r.diagnostics, r.files))},
         {"sources", files_json(r.sources)},
         {"targets", files_json(r.targets)}};
  if (!r.to_do.empty()) j["to_do"] = to_do_json(r);
  if (with_paths) {
    j["source_path"] = path_json(r.source_path);
    j["target_path"] = path_json(r.target_path);
  }
  return dump(j, with_paths ? -1 : 1);
}

std::string report_json(const Report& r) {
  return report_data(r, false) + "\n";
}

std::string report_sarif(const Report& r) {
  Json results = Json::array(), rules = Json::array();
  std::vector<std::string> known;
  const auto rule = [&](const std::string& code) {
    if (std::find(known.begin(), known.end(), code) != known.end()) return;
    known.push_back(code);
    rules.push_back({{"id", code}});
  };
  for (const auto& d : r.diagnostics.all()) {
    rule(d.code);
    Json result =
        sarif_result(d.code, severity_text(d.severity), to_utf8(d.message + (d.hint.empty() ? "" : "; " + d.hint)));
    if (d.span.known()) result["locations"] = Json::array({sarif_place(d.span, r.files)});
    results.push_back(std::move(result));
  }
  for (const auto& [code, more] : r.diagnostics.more()) {
    rule(code);
    results.push_back(
        sarif_result(code, severity_text(more.severity), std::to_string(more.count) + " more of this code"));
  }
  if (r.verdict == verifier::name(verifier::Status::differs)) {
    rule("VER-001");
    Json result = sarif_result("VER-001", "error", to_utf8(r.verdict_text));
    if (r.differs_source)
      result["locations"] = Json::array({sarif_place(r.sources[r.differs_source->file].name, r.differs_source->line)});
    results.push_back(std::move(result));
  }
  if (r.verdict_text.starts_with("not proved")) {
    rule("VER-002");
    results.push_back(sarif_result("VER-002", "warning", to_utf8(r.verdict_text)));
  }
  const Json tool{{"driver", {{"name", "cnctrans"}, {"version", version}, {"rules", std::move(rules)}}}};
  const Json log{{"$schema", "https://json.schemastore.org/sarif-2.1.0.json"},
                 {"version", "2.1.0"},
                 {"runs", Json::array({{{"tool", tool},
                                        {"columnKind", "utf16CodeUnits"},
                                        {"properties", {{"verdict", r.verdict}, {"text", to_utf8(r.verdict_text)}}},
                                        {"results", std::move(results)}}})}};
  return dump(log, 1) + "\n";
}

}  // namespace cnctrans::translator
