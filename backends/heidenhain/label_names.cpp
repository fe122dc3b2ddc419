#include "backends/heidenhain/label_names.h"

#include "base/text.h"
#include "dialects/heidenhain/limits.h"
#include "ir/analysis/label_uses.h"

namespace cnctrans::backends::heidenhain {

namespace {

bool is_label_number(std::string_view digits) {
  const auto n = parse_decimal(digits);
  return n && *n >= 1 && *n <= static_cast<double>(dialects::heidenhain::label_max);
}
std::string quoted_name(std::string_view text) {
  return '"' + to_upper_ascii(text.substr(0, dialects::heidenhain::label_length)) + '"';
}

/// The labels that nothing but ends of called parts lead to: LBL 0.
std::set<std::pair<bool, std::string>> part_ends(const ir::Program& program, const ir::Routine& r) {
  bool some = false;
  for_each_statement(r.body, [&some](const ir::Statement& s) {
    const auto* repeat = std::get_if<ir::Repeat>(&s.node);
    some = some || (repeat != nullptr && !repeat->last.text.empty());
  });
  if (!some) return {};
  auto uses = ir::passes::label_uses(program, r);
  for (const auto& l : uses.targets) uses.ends.erase(l);
  return std::move(uses.ends);
}

}  // namespace

LabelNames::LabelNames(const ir::Program& program, const std::vector<FileGroup>& files, const LabelUse& use) {
  for (std::size_t file = 0; file < files.size(); ++file) {
    taken_.clear();
    last_ = 0;
    // The names of subprograms are what the reader looks for: they come first.
    for (const std::size_t i : files[file].routines) {
      const ir::Routine& r = program.routines[i];
      file_of_[i] = file;
      if (r.kind != ir::RoutineKind::sub) continue;
      const std::string number = std::to_string(r.name.number);
      std::string wanted = is_label_number(number) ? number : quoted_name(r.name.text);
      if (!is_label_number(number) && r.name.text.empty()) wanted = quoted_name("P" + number);
      routines_[i] = take(std::move(wanted));
    }
    for (const std::size_t i : files[file].routines) {
      for (const auto& [number, text] : part_ends(program, program.routines[i])) labels_[{i, number, text}] = "0";
      ir::for_each_statement(program.routines[i].body, [&](const ir::Statement& s) {
        if (!s.line.number.empty() && use.is_target(i, s.line.number)) {
          std::string digits(without_leading_zeros(s.line.number));
          labels_.try_emplace(Key{i, true, digits}, take(is_label_number(digits) ? digits : std::string{}));
        }
        for (const std::string_view name : s.line.labels) {
          if (use.is_target_name(i, name))
            labels_.try_emplace(Key{i, false, std::string(name)}, take(quoted_name(name)));
        }
      });
    }
  }
}

std::string LabelNames::take(std::string wanted) {
  if (wanted.empty() || !taken_.insert(wanted).second) return fresh();
  if (wanted.front() != '"') last_ = std::max(last_, static_cast<std::int64_t>(*parse_decimal(wanted)));
  return wanted;
}

std::string LabelNames::fresh() {
  constexpr std::int64_t last = dialects::heidenhain::label_max;
  std::int64_t n = last_ < last ? last_ + 1 : 1;
  while (n <= last && taken_.count(std::to_string(n)) != 0) ++n;
  const std::string name = n <= last ? std::to_string(n) : "\"L" + std::to_string(++last_) + '"';
  if (n <= last) last_ = std::max(last_, n);
  taken_.insert(name);
  return name;
}

std::string LabelNames::of(std::size_t routine, std::string_view label, bool number) const {
  const auto at =
      labels_.find(Key{routine, number, number ? std::string(without_leading_zeros(label)) : std::string(label)});
  return at != labels_.end() ? at->second : std::string{};
}

bool LabelNames::in_file_of(std::size_t routine, std::size_t other) const {
  const auto a = file_of_.find(routine), b = file_of_.find(other);
  return a != file_of_.end() && b != file_of_.end() && a->second == b->second;
}

}  // namespace cnctrans::backends::heidenhain
