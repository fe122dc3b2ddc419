#include "translator/survey/survey.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <unordered_map>

#include "base/os/os.h"
#include "base/text.h"
#include "translator/files/readable.h"

namespace cnctrans::translator {

namespace {

namespace fs = std::filesystem;
using LookJson = nlohmann::json;

/// Every file below the folder that is none of cnctrans's own, sorted.
std::vector<std::string> files_below(const std::string& folder) {
  std::vector<std::string> found;
  std::error_code ignored;
  for (auto it = fs::recursive_directory_iterator(folder, fs::directory_options::skip_permission_denied, ignored);
       it != fs::recursive_directory_iterator(); it.increment(ignored)) {
    if (it->is_regular_file(ignored) && !it->path().filename().string().starts_with('.'))
      found.push_back(it->path().lexically_relative(folder).generic_string());
  }
  std::sort(found.begin(), found.end());
  return found;
}

LookJson needs_json(const std::map<std::string, Need>& needs) {
  LookJson out = LookJson::object();
  for (const auto& [name, need] : needs) out[to_utf8(name)] = {need.times, need.arguments};
  return out;
}

std::map<std::string, Need> needs_of(const LookJson& j) {
  std::map<std::string, Need> out;
  for (const auto& [name, need] : j.items())
    out[name] = {need[0].get<std::size_t>(), need[1].get<std::vector<std::string>>()};
  return out;
}

std::string line_of(std::size_t index, const ProgramLook& l) {
  const LookJson j{{"at", index},
                   {"dialect", l.dialect},
                   {"kind", l.kind},
                   {"lines", l.lines},
                   {"blocks", l.blocks},
                   {"unread", l.unread},
                   {"features", l.features},
                   {"routines", l.routines},
                   {"calls", needs_json(l.calls)},
                   {"data", needs_json(l.data)},
                   {"names", needs_json(l.names)}};
  return j.dump(-1, ' ', true, LookJson::error_handler_t::replace) + "\n";
}

void read_line(const std::string& text, std::vector<ProgramLook>& out, std::vector<bool>& seen) {
  const LookJson j = LookJson::parse(text, nullptr, false);
  if (!j.is_object()) return;  // the process ended within it
  const auto at = j["at"].get<std::size_t>();
  seen[at] = true;
  ProgramLook& l = out[at];
  l.dialect = j["dialect"];
  l.kind = j["kind"];
  l.lines = j["lines"];
  l.blocks = j["blocks"];
  l.unread = j["unread"];
  l.features = j["features"].get<std::set<std::string>>();
  l.routines = j["routines"].get<std::set<std::string>>();
  l.calls = needs_of(j["calls"]);
  l.data = needs_of(j["data"]);
  l.names = needs_of(j["names"]);
}

/// Looks at the programs in processes side by side: one that is ended by a program goes on behind it.
class Looking {
 public:
  Looking(const SurveyOptions& options, std::vector<ProgramLook>& programs)
      : options_(options), programs_(programs), seen_(programs.size()), to_(find_dialect(options.to)) {}

  void run(const std::function<void(std::size_t, std::size_t)>& progress) {
    const std::size_t jobs = std::max(1U, options_.jobs);
    std::vector<Part> parts;
    for (std::size_t k = 0; k < jobs; ++k) {
      Part part;
      part.next = k;
      part.step = jobs;
      part.works = k < programs_.size() && begin(part);
      if (part.works) parts.push_back(std::move(part));
    }
    std::size_t done = 0;
    while (!parts.empty()) {
      for (auto& part : parts) {
        std::string line;
        if (part.child.read_line(line)) {
          read_line(line, programs_, seen_);
          part.next += part.step;
          if (progress) progress(++done, programs_.size());
          continue;
        }
        (void)part.child.ended(true);
        part.works = false;
        if (part.next >= programs_.size()) continue;
        programs_[part.next].kind = "no program";  // the look at it ended the process
        part.next += part.step;
        if (part.next < programs_.size()) part.works = begin(part);
      }
      std::erase_if(parts, [](const Part& p) { return !p.works; });
    }
  }

 private:
  struct Part {
    std::size_t next = 0, step = 1;  ///< the program that the next line is about
    os::Child child{};
    bool works = false;
  };

  bool begin(Part& part) {
    return part.child.begin([this, &part](std::FILE* out) {
      for (std::size_t i = part.next; i < programs_.size(); i += part.step) {
        const std::string path = (fs::path(options_.in) / programs_[i].path).string();
        const std::string line = line_of(i, look_at(path, options_, options_.from, to_));
        if (std::fwrite(line.data(), 1, line.size(), out) != line.size()) return false;
      }
      return true;
    });
  }

  const SurveyOptions& options_;
  std::vector<ProgramLook>& programs_;
  std::vector<bool> seen_;
  const Dialect* to_;
};

/// What nobody in the folder has, and the order in which answers free the most programs.
class Ranking {
 public:
  Ranking(Survey& s, const SurveyOptions& options) : survey_(s) {
    std::set<std::string> have;
    for (const auto& p : s.programs) have.insert(p.routines.begin(), p.routines.end());
    for (const auto& library : options.libraries) {
      for (const auto& file : files_below(library)) have.insert(call_key(fs::path(file).stem().string()));
    }
    needed_.resize(s.programs.size());
    for (std::size_t i = 0; i < s.programs.size(); ++i) {
      const auto& p = s.programs[i];
      for (const auto& [name, need] : p.calls) {
        if (have.count(call_key(name)) == 0 && !answered(options.names, Question::Kind::routine, name))
          add(i, Question::Kind::routine, name, need);
      }
      for (const auto& [name, need] : p.data) {
        if (!answered(options.names, Question::Kind::datum, name)) add(i, Question::Kind::datum, name, need);
      }
      for (const auto& [name, need] : p.names) {
        if (!answered(options.names, Question::Kind::size, name)) add(i, Question::Kind::size, name, need);
      }
    }
  }

  void run() {
    std::vector<std::size_t> open(needed_.size());
    for (std::size_t i = 0; i < needed_.size(); ++i) {
      open[i] = needed_[i].size();
      if (open[i] == 0 && survey_.programs[i].kind != "no program") ++survey_.complete;
      if (open[i] == 1) ++all_[needed_[i].front()].alone;
    }
    std::vector<std::size_t> last(all_.size());  // programs that wait for this answer alone
    for (std::size_t q = 0; q < all_.size(); ++q) last[q] = all_[q].alone;
    std::vector<bool> given(all_.size());
    std::size_t complete = survey_.complete;
    // Beyond the first so many the order is that of the programs that need each.
    constexpr std::size_t ranked = 500;
    for (std::size_t n = 0; n < std::min(all_.size(), ranked); ++n) {
      std::size_t best = all_.size();
      for (std::size_t q = 0; q < all_.size(); ++q) {
        if (!given[q] && (best == all_.size() || better(q, best, last))) best = q;
      }
      give(best, open, last, given, complete);
    }
    std::vector<std::size_t> rest;
    for (std::size_t q = 0; q < all_.size(); ++q) {
      if (!given[q]) rest.push_back(q);
    }
    std::stable_sort(rest.begin(), rest.end(), [this](auto a, auto b) { return all_[a].programs > all_[b].programs; });
    for (const auto q : rest) give(q, open, last, given, complete);
  }

 private:
  static bool answered(const Names* names, Question::Kind kind, const std::string& name) {
    if (names == nullptr) return false;
    if (kind == Question::Kind::routine) return names->map.routines.count(name) != 0 || names->outside.count(name) != 0;
    const auto any = name.substr(0, name.find('[')) + "[*]";
    if (names->map.data.count(name) != 0 || names->map.data.count(any) != 0) return true;
    return names->sizes.count(name) != 0;
  }
  void add(std::size_t program, Question::Kind kind, const std::string& name, const Need& need) {
    const std::string key = std::to_string(static_cast<int>(kind)) + name;
    const auto [it, fresh] = index_.emplace(key, all_.size());
    if (fresh) {
      all_.push_back({kind, name, 0, 0, 0, 0, {}});
      needing_.emplace_back();
    }
    Missing& m = all_[it->second];
    m.times += need.times;
    ++m.programs;
    if (need.arguments.size() > m.arguments.size()) m.arguments = need.arguments;
    needed_[program].push_back(it->second);
    needing_[it->second].push_back(program);
  }
  [[nodiscard]] bool better(std::size_t a, std::size_t b, const std::vector<std::size_t>& last) const {
    return last[a] != last[b] ? last[a] > last[b] : all_[a].programs > all_[b].programs;
  }
  void give(std::size_t q, std::vector<std::size_t>& open, std::vector<std::size_t>& last, std::vector<bool>& given,
            std::size_t& complete) {
    given[q] = true;
    for (const auto program : needing_[q]) {
      if (--open[program] == 0) ++complete;
      if (open[program] != 1) continue;
      for (const auto other : needed_[program]) {
        if (!given[other]) ++last[other];
      }
    }
    all_[q].unlocks = complete - survey_.complete;
    survey_.missing.push_back(all_[q]);
  }

  Survey& survey_;
  std::vector<Missing> all_;
  std::unordered_map<std::string, std::size_t> index_;
  std::vector<std::vector<std::size_t>> needed_;   ///< of each program
  std::vector<std::vector<std::size_t>> needing_;  ///< programs, of each question
};

}  // namespace

std::string_view name(Question::Kind kind) {
  switch (kind) {
    case Question::Kind::routine: return "program";
    case Question::Kind::datum: return "datum";
    case Question::Kind::size: break;
  }
  return "name";
}

Survey survey(const SurveyOptions& options, const std::function<void(std::size_t, std::size_t)>& progress) {
  Survey out;
  std::error_code ignored;
  if (!fs::is_directory(options.in, ignored)) out.error = options.in + " is not a folder";
  if (out.error.empty() && !options.from.empty()) (void)find_readable(options.from, &out.error);
  if (out.error.empty() && !options.to.empty() && find_dialect(options.to) == nullptr)
    out.error = unknown_dialect(options.to);
  if (!out.error.empty()) return out;
  for (auto& path : files_below(options.in)) out.programs.emplace_back().path = std::move(path);
  Looking(options, out.programs).run(progress);
  Ranking(out, options).run();
  return out;
}

std::vector<Question> questions_of(const Survey& s) {
  std::vector<Question> list;
  for (const auto& m : s.missing) list.push_back({m.kind, m.name, m.arguments});
  return list;
}

}  // namespace cnctrans::translator
