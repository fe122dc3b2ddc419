// The verdict in words.
#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "base/text.h"
#include "verifier/compare.h"

namespace cnctrans::verifier {

namespace {

std::string source_line_text(const FileTable& files, FileId file, std::uint32_t line) {
  const SourceText* source = files.source(file);
  return source != nullptr ? std::string(source->line_text(line)) : std::string();
}

/// Said with a good verdict too: feeds that could not be compared.
std::string without_feed(const Verdict& v) {
  if (v.unfed_moves == 0) return {};
  return fmt::format(
      "; {} without a feed in the source (controls move at their highest feed then, or stop), feeds not compared",
      v.unfed_moves == 1 ? "1 move" : fmt::format("{} moves", v.unfed_moves));
}

constexpr std::array<std::string_view, 5> status_names{"verified", "verified within tolerance", "differs",
                                                       "nothing to compare", "not replayable"};

/// How far the traces are from each other.
std::string apart(const Verdict& v) {
  const auto most = rounded(v.max_length, 6);
  return v.similar_cycles > 0 && std::string_view(most) == "0" ? "all equal" : fmt::format("within {} mm", most);
}

std::string counted(std::size_t n, std::string_view one) {
  return fmt::format("{} {}{}", n, one, n == 1 ? "" : "s");
}

/// Cycles whose passes differ.
std::string by_contour(const Verdict& v) {
  if (v.similar_cycles == 0) return {};
  const auto apart = rounded(v.similar_length, 6);
  return fmt::format("; {} compared by the part {}, not pass by pass{}", counted(v.similar_cycles, "cycle"),
                     v.similar_cycles == 1 ? "it leaves" : "they leave",
                     std::string_view(apart) == "0" ? std::string() : fmt::format(" (at most {} mm apart)", apart));
}

/// Where the zero point is the operator's, and where the program only runs from it.
std::string by_zero(const Verdict& v) {
  std::string text;
  if (v.open_zero_moves != 0)
    text += fmt::format(
        "; {} before a work offset is selected: the zero point that both machines have then is taken for "
        "the same",
        counted(v.open_zero_moves, "move"));
  if (v.world && v.world->stands_at_zero) text += "; proved for a start at the zero point only";
  if (v.one_world) text += "; proved for zero points as in the profiles only";
  return text;
}

/// Variables that hold what an earlier program left.
std::string by_kept(const Verdict& v) {
  const auto list = [](const std::vector<std::string>& names) {
    constexpr std::size_t named = 8;
    std::string text;
    for (std::size_t i = 0; i < std::min(named, names.size()); ++i) text += (i == 0 ? "" : ", ") + names[i];
    return names.size() > named ? text + ", ..." : text;
  };
  std::string text;
  if (!v.read_first.empty())
    text += fmt::format("; {} read before {} written ({})", list(v.read_first),
                        v.read_first.size() == 1 ? "it is" : "they are",
                        v.kept_values_tried ? "also with other values than 0" : "0 was taken");
  if (!v.target_read_first.empty())
    text += fmt::format("; in the translation {} read before {} written", list(v.target_read_first),
                        v.target_read_first.size() == 1 ? "it is" : "they are");
  return text;
}

/// What this program has that is not compared.
std::string left_out(const Verdict& v) {
  std::string text;
  const auto add = [&text](std::size_t n, std::string_view what) {
    if (n != 0) text += (text.empty() ? "; not compared: " : ", ") + counted(n, what);
  };
  add(v.left_out.offset_numbers, "offset number");
  add(v.left_out.path_modes, "path mode");
  add(v.left_out.preselected_tools, "tool made ready");
  add(v.left_out.messages, "message");
  return text;
}

/// Milling cycles that ran with a tool nobody gives.
std::string by_radius(const Verdict& v) {
  if (v.assumed_radius == 0) return {};
  return fmt::format("; milling cycles with a tool of radius {} mm, which nobody gives", shortest(v.assumed_radius));
}

/// The part of a program that the proof does not speak of; empty: none.
std::string not_replayed(const Coverage& c, const FileTable& files, std::string_view whose) {
  if (c.missed.empty()) return {};
  constexpr std::size_t named = 8;
  std::string lines;
  for (std::size_t i = 0; i < std::min(named, c.missed.size()); ++i) {
    const auto& m = c.missed[i];
    const bool other = m.file != (i == 0 ? c.main : c.missed[i - 1].file);
    lines += fmt::format("{}{}{}", i == 0 ? "" : ", ", other ? files.name(m.file) + ":" : "", m.first);
    if (m.last != m.first) lines += fmt::format("-{}", m.last);
  }
  if (c.missed.size() > named) lines += ", ...";
  return fmt::format("; {} of {} lines{} were not reached ({})", c.blocks - c.replayed, c.blocks, whose, lines);
}

std::string also_with(const Coverage& c) {
  return c.also.empty() ? std::string() : "; also with " + c.also;
}

std::string why_nothing(const Verdict& v) {
  if (v.status == Status::nothing_to_compare) return "the program moves nothing, so there is nothing to compare";
  return v.reason;
}

std::string started_with(const Verdict& v) {
  return v.inputs.empty() ? std::string() : " with " + v.inputs;
}

/// What exploring came to; empty: there was none.
std::string explored(const Coverage& c, const FileTable& files) {
  if (!c.explored && c.open.empty()) return {};
  std::string text = c.explored ? fmt::format("; {} took {} of {} ways of the conditions", counted(c.replays, "replay"),
                                              c.ways_taken, c.ways)
                                : std::string("; conditions that came out one way");
  constexpr std::size_t named = 8;
  for (std::size_t i = 0; i < std::min(named, c.open.size()); ++i) {
    const auto& b = c.open[i];
    const bool other = b.file != (i == 0 ? c.main : c.open[i - 1].file);
    text += fmt::format("{}{}{} {}", i == 0 ? " (" : ", ", other ? files.name(b.file) + ":" : "", b.line,
                        b.always ? "always held" : "never held");
  }
  if (!c.open.empty()) text += c.open.size() > named ? ", ...)" : ")";
  return text;
}

}  // namespace

std::string_view name(Status s) {
  return status_names[static_cast<std::size_t>(s)];
}

std::string not_proved(const Verdict& v) {
  std::string why = why_nothing(v);
  std::replace_if(
      why.begin(), why.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
  return "not proved" + started_with(v) + ": " + why;
}

std::string describe(const Verdict& v, const FileTable& source_files, const FileTable& target_files) {
  switch (v.status) {
    case Status::verified:
    case Status::within_tolerance:
      return fmt::format("verified: {} events, {} moves, {}", v.events, v.moves,
                         v.status == Status::verified ? "all equal" : apart(v)) +
             also_with(v.coverage) + by_contour(v) + by_radius(v) + without_feed(v) + by_zero(v) + by_kept(v) +
             left_out(v) + not_replayed(v.coverage, source_files, "") +
             not_replayed(v.target_coverage, target_files, " of the translation") + explored(v.coverage, source_files);
    case Status::nothing_to_compare:
    case Status::not_replayable: return "not verified" + started_with(v) + ": " + why_nothing(v);
    case Status::differs: break;
  }
  const auto& d = v.difference;
  std::string text = fmt::format("not verified{}: after {} equal events: {}", started_with(v), v.events, d.what);
  text += fmt::format("\n  source      {}:{}: {}", source_files.name(d.source_file), d.source_line,
                      source_line_text(source_files, d.source_file, d.source_line));
  text += fmt::format("\n  translation {}:{}: {}", target_files.name(d.target_file), d.target_line,
                      source_line_text(target_files, d.target_file, d.target_line));
  return text;
}

}  // namespace cnctrans::verifier
