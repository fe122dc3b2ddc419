#include "machine/data_at_rest.h"

#include <algorithm>
#include <array>
#include <utility>

#include "base/text.h"

namespace cnctrans::machine {

namespace {

constexpr std::int32_t most_spindles = 100;

constexpr std::array<std::pair<RunDatum, std::string_view>, run_datum_count> run_words{
    {{RunDatum::travelled, "travelled"},
     {RunDatum::next_offset, "next_offset"},
     {RunDatum::spindle_angle, "spindle_angle"},
     {RunDatum::rpm, "rpm"},
     {RunDatum::cutting_speed, "cutting_speed"},
     {RunDatum::spindle_limit, "spindle_limit"},
     {RunDatum::call_level, "call_level"},
     {RunDatum::next_tool, "next_tool"},
     {RunDatum::spindle_position, "spindle_position"},
     {RunDatum::turning_speed, "turning_speed"},
     {RunDatum::plane_normal, "plane_normal"},
     {RunDatum::program_number, "program_number"},
     {RunDatum::last_label, "last_label"},
     {RunDatum::numbered_position, "numbered_position"},
     {RunDatum::block_coordinate, "block_coordinate"}}};

bool fits(std::string_view pattern, std::string_view name) {
  if (pattern.empty()) return name.empty();
  if (pattern.front() == '*') {
    for (std::size_t n = 0; n <= name.size(); ++n) {
      if (fits(pattern.substr(1), name.substr(n))) return true;
    }
    return false;
  }
  if (name.empty()) return false;
  const char p = pattern.front(), c = name.front();
  const bool same = p == '?' || p == c || (p == '#' && c >= '0' && c <= '9');
  return same && fits(pattern.substr(1), name.substr(1));
}

/// The row of the table behind `mark` that says most of `name`; null: none.
const double* row(const Profile& profile, std::string_view mark, std::string_view name) {
  const std::string exact = std::string(mark) + std::string(name);
  if (const auto it = profile.data.find(exact); it != profile.data.end()) return &it->second;
  const double* best = nullptr;
  std::size_t length = 0;
  for (auto it = profile.data.lower_bound(std::string(mark)); it != profile.data.end(); ++it) {
    const std::string_view key = it->first;
    if (!key.starts_with(mark)) break;
    const auto pattern = key.substr(mark.size());
    if (pattern.size() < length || pattern.find_first_of("*?#") == std::string_view::npos) continue;
    if (!fits(pattern, name)) continue;
    best = &it->second;
    length = pattern.size();
  }
  return best;
}

}  // namespace

std::optional<double> data_at_rest(const Profile& profile, std::string_view name) {
  const double* found = row(profile, at_rest_mark, name);
  return found == nullptr ? std::nullopt : std::optional(*found);
}

std::optional<RunAnswer> data_of_run(const Profile& profile, std::string_view name) {
  const double* found = row(profile, of_run_mark, name);
  if (found == nullptr) return std::nullopt;
  const auto code = static_cast<std::int32_t>(*found);
  return RunAnswer{static_cast<RunDatum>(code / most_spindles), code % most_spindles};
}

bool is_length_datum(const Profile& profile, std::string_view name) {
  for (std::string_view rest = profile.policies.machine_data_lengths; !rest.empty();) {
    const auto bar = std::min(rest.find('|'), rest.size());
    if (fits(rest.substr(0, bar), name)) return true;
    rest.remove_prefix(std::min(bar + 1, rest.size()));
  }
  return false;
}

std::optional<double> value_of_data(const Profile& profile, const std::string& name) {
  const auto last = name.find_last_not_of("0123456789");
  const bool bare = last != std::string::npos && last + 1 < name.size() && name.back() != ']';
  const std::string indexed = bare ? name.substr(0, last + 1) + '[' + name.substr(last + 1) + ']' : name;
  const auto bracket = indexed.find('[');
  const std::string any = indexed.substr(0, bracket) + "[*]";
  for (const std::string& key : {name, indexed, any}) {
    if (key == any && bracket == std::string::npos) continue;
    if (const auto it = profile.data.find(key); it != profile.data.end()) return it->second;
  }
  if (const auto rest = data_at_rest(profile, indexed)) return rest;
  return data_at_rest(profile, name);
}

void forget_data_at_rest(Profile& profile) {
  std::erase_if(profile.data, [](const auto& item) { return item.first.starts_with(at_rest_mark); });
}

std::optional<double> run_answer_code(std::string_view text) {
  const auto colon = text.find(':');
  const auto word = text.substr(0, colon);
  const auto it = std::find_if(run_words.begin(), run_words.end(), [&](const auto& w) { return w.second == word; });
  if (it == run_words.end()) return std::nullopt;
  const auto spindle =
      colon == std::string_view::npos ? std::optional<double>(1) : parse_decimal(std::string(text.substr(colon + 1)));
  if (!spindle || *spindle < 0 || *spindle >= 32 || *spindle != static_cast<std::int32_t>(*spindle)) {
    return std::nullopt;
  }
  return static_cast<double>(static_cast<std::int32_t>(it->first) * most_spindles) + *spindle;
}

std::string run_answer_text(double code) {
  const auto n = static_cast<std::int32_t>(code);
  const auto& word = run_words[static_cast<std::size_t>(n / most_spindles)];
  const auto spindle = n % most_spindles;
  return std::string(word.second) + (spindle == 1 ? "" : ":" + std::to_string(spindle));
}

}  // namespace cnctrans::machine
