// The report of a translation: what became of every line, the proof, and both tool paths. See docs/report.md.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "translator/pipeline.h"

namespace cnctrans::translator {

/// What became of a source line; the gravest diagnostic on it decides.
enum class LineStatus : std::uint8_t {
  blank,         ///< nothing on it
  exact,         ///< stands in the translation, nothing to say
  folded,        ///< no line of its own in the translation (a header, or words that went into another block)
  noted,         ///< a note
  review,        ///< a warning: someone has to look
  untranslated,  ///< left out of a draft: a remark stands in its place
  refused,       ///< an error: not carried
  count_
};
std::string_view name(LineStatus s);

/// A line of a file of the report; both from 0 and 1: `file` is an index into the files of its side, `line` counts
/// from 1.
struct ReportPlace {
  std::size_t file = 0;
  std::uint32_t line = 0;
  bool operator==(const ReportPlace&) const = default;
};
struct ReportLine {
  std::string text;  ///< UTF-8
  LineStatus status = LineStatus::blank;
  std::vector<ReportPlace> others;  ///< its lines on the other side
};
struct ReportFile {
  std::string name;
  std::vector<ReportLine> lines;
};
/// One move as a polyline of X Y Z triples in mm (X of a lathe as radius), arcs within 0.01 mm.
struct ReportMove {
  std::string_view kind;  ///< rapid, linear, arc, thread, probe
  ReportPlace place;
  std::vector<double> points;
  std::int32_t tool = 0;  ///< that is in the spindle; 0: not known
  double seconds = 0;     ///< at its feed, with the dwells behind it; 0: a rapid, or not known
};

struct Report {
  std::string source_name;
  std::string from, to;  ///< titles of the controls
  std::string source_machine, target_machine;
  bool lathe = false;
  bool refused = false;
  std::string verdict;       ///< a name of verifier::Status, "not asked", or "refused"
  std::string verdict_text;  ///< for people
  std::uint64_t events = 0, moves = 0;
  double max_length = 0;                 ///< mm
  std::size_t blocks = 0, replayed = 0;  ///< lines of the source that do something, and those that the replay came to
  std::size_t replays = 1, ways = 0, ways_taken = 0;   ///< of an explored program: a condition has two ways
  std::size_t target_blocks = 0, target_replayed = 0;  ///< the same lines of the translation
  verifier::LeftOut left_out;
  std::vector<std::string> read_first, target_read_first;  ///< variables read before they are written
  std::uint64_t similar_cycles = 0;
  double similar_length = 0;  ///< mm
  std::optional<ReportPlace> differs_source, differs_target;
  std::vector<ReportFile> sources, targets;
  std::vector<ReportMove> source_path, target_path;
  std::vector<ToDo> to_do;  ///< of a draft
  Diagnostics diagnostics;
  FileTable files;  ///< that the diagnostics point into

  /// How many source lines have each status.
  [[nodiscard]] std::vector<std::size_t> counts() const;
};

/// From a translation made with `keep_traces`. `written`: the paths of the outputs, in their order; empty: their names.
Report make_report(const std::string& path, const TranslateOptions& options, const TranslateResult& result,
                   const std::vector<std::string>& written = {});

std::string report_json(const Report& r);
std::string report_markdown(const Report& r);
/// SARIF 2.1.0: the diagnostics, and a difference of the verification as an error VER-001.
std::string report_sarif(const Report& r);
/// One page that needs nothing else: both texts side by side, both paths drawn over each other.
std::string report_html(const Report& r);

/// The format by the ending of the file's name (.html .htm .json .md .sarif); nullopt: none of these.
using ReportWriter = std::string (*)(const Report&);
std::optional<ReportWriter> report_writer(std::string_view file_name);

}  // namespace cnctrans::translator
