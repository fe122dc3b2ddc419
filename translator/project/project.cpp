#include "translator/project/project.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <map>
#include <set>

#include "base/os/os.h"
#include "base/source.h"
#include "base/text.h"
#include "translator/batch/batch_record.h"
#include "translator/files/archives.h"
#include "translator/files/names_file.h"
#include "translator/files/readable.h"
#include "translator/files/written_files.h"
#include "translator/folding/unfolding.h"

namespace cnctrans::translator {

namespace {

namespace fs = std::filesystem;

std::string bytes_of(const fs::path& path) {
  std::string error;
  const SourcePtr text = SourceText::open(path.string(), &error);
  return text ? std::string(text->bytes()) : std::string();
}

bool put(const fs::path& path, std::string_view bytes, std::string* error) {
  AtomicFile file(path.string());
  return file.open(error) && file.write(bytes, error) && file.commit(error);
}

/// The folder entry that a program belongs to: the longest path that fits; null: none.
const ProjectFolder* folder_of(const ProjectConfig& config, const std::string& program) {
  const ProjectFolder* best = nullptr;
  for (const auto& f : config.folders) {
    const bool fits = program.starts_with(f.path + '/') || program == f.path;
    if (fits && (best == nullptr || f.path.size() > best->path.size())) best = &f;
  }
  return best;
}

/// Programs of one machine: those of the folder, or of an archive that was taken apart.
struct Group {
  BatchOptions batch;
  std::string archive;  ///< its path below the programs; empty: the folder itself
  fs::path to;          ///< folder of the outputs

  [[nodiscard]] std::string shown(const std::string& program) const {
    return archive.empty() ? program : archive + '/' + program;
  }
};

class Project {
 public:
  Project(const ProjectOptions& options, ProjectConfig config)
      : options_(options), config_(std::move(config)), work_(fs::path(options.folder) / ".cnctrans") {}

  ProjectResult run(const std::function<void(const BatchProgress&)>& progress) {
    ProjectResult result;
    if (!check(&result.error) || !read_names(&result.error)) return result;
    std::error_code ignored;
    if (!options_.status) fs::create_directories(work_, ignored);
    gather();
    if (!work_on(groups_, result, progress)) return result;
    // A subprogram that a program of the archive calls has come with it; the others are programs like any other.
    for (auto& group : late_)
      std::erase_if(group.batch.only, [&](const auto& p) { return called_.contains(whole(group.batch.in, p)); });
    std::erase_if(late_, [](const Group& g) { return g.batch.only.empty(); });
    if (!work_on(late_, result, progress)) return result;
    std::sort(result.programs.begin(), result.programs.end(),
              [](const ProjectProgram& a, const ProjectProgram& b) { return a.path < b.path; });
    if (!options_.status && !config_.archive.empty()) write_archive(result);
    if (!options_.status) write_pages(result);
    return result;
  }

 private:
  /// Names first, then translations, then the folder of the control. False: `result.error`.
  bool work_on(const std::vector<Group>& groups, ProjectResult& result,
               const std::function<void(const BatchProgress&)>& progress) {
    for (const auto& group : groups) {
      if (!options_.status && !name(group, &result.error)) return false;
    }
    for (const auto& group : groups) {
      BatchOptions batch_options = group.batch;
      if (!options_.status) {
        batch_options.translate.names = &names_;
        const BatchResult done = batch(batch_options, progress);
        if (!done.error.empty()) {
          result.error = done.error;
          return false;
        }
        result.reused += done.reused;
        result.translated += done.programs - done.reused;
      }
      const auto open = options_.status ? batch_open(group.batch) : std::vector<std::string>();
      for (const auto& program : group.batch.only)
        result.programs.push_back(
            place(group, program, std::find(open.begin(), open.end(), program) != open.end(), result));
    }
    return true;
  }
  static std::string whole(const fs::path& folder, const fs::path& file) {
    return fs::absolute(folder / file).lexically_normal().string();
  }

  bool check(std::string* error) const {
    std::error_code ignored;
    (void)find_readable(config_.from, error);
    if (error->empty() && find_dialect(config_.to) == nullptr) *error = unknown_dialect(config_.to);
    if (error->empty() && !fs::is_directory(config_.programs, ignored)) *error = config_.programs + " is not a folder";
    if (error->empty() && !config_.archive.empty() && !has_archives(*find_dialect(config_.to)))
      *error = "\"archive\": there are none for " + std::string(find_dialect(config_.to)->title);
    if (error->empty() && fs::equivalent(config_.programs, config_.output, ignored))
      *error = "\"output\" can't be the folder of the programs";
    return error->empty();
  }

  bool read_names(std::string* error) {
    std::error_code ignored;
    if (!fs::exists(config_.names, ignored)) return true;
    auto found = translator::read_names(config_.names, config_.from, config_.to, error);
    if (!found) return false;
    names_ = *std::move(found);
    // Somebody has answered a question, or given another name: everything is made with it.
    edited_ = fs::exists(saved_names(), ignored) && bytes_of(saved_names()) != bytes_of(config_.names);
    if (const SourcePtr text = definitions_of(names_, config_.from, config_.names, error)) definitions_ = {text};
    return error->empty();
  }
  [[nodiscard]] fs::path saved_names() const { return work_ / "names.json"; }

  [[nodiscard]] BatchOptions batch_options() const {
    BatchOptions o;
    o.translate.from = config_.from;
    o.translate.to = config_.to;
    o.translate.machine = config_.machine;
    o.translate.target_machine = config_.target_machine;
    o.translate.tools = config_.tools;
    o.translate.libraries = config_.libraries;
    o.translate.definitions = definitions_;
    o.translate.origin = true;
    o.translate.files_apart = true;  // a subprogram of several programs stands there once
    prove_as_usual(o.translate);
    o.translate.draft = config_.draft;
    if (config_.draft) o.translate.unsupported = backends::Unsupported::comment;
    constexpr std::uint64_t events_each = 500'000, steps_each = 50'000'000;
    o.translate.run.max_events = events_each;
    o.translate.run.max_steps = steps_each;
    o.in = config_.programs;
    o.out = (work_ / "work").string();
    o.jobs = options_.jobs;
    o.timeout = options_.timeout;
    o.again = options_.again || edited_;
    o.names_key = "project";
    o.reports = options_.reports;
    return o;
  }

  /// The programs by their machines, archives taken apart.
  void gather() {
    const Dialect& from = *find_dialect(config_.from);
    const BatchOptions all = batch_options();
    std::vector<Group> sources{{all, {}, config_.output}};
    std::vector<std::string> roots;
    for (const auto& program : batch_programs(all)) {
      const auto parts = take_apart(from, bytes_of(fs::path(config_.programs) / program));
      if (parts.empty()) {
        sources.front().batch.only.push_back(program);
        continue;
      }
      Group archive{all, program, fs::path(config_.output) / fs::path(program).replace_extension()};
      archive.batch.in = (work_ / "archives" / program).string();
      archive.batch.out = (work_ / "parts" / program).string();
      unpack(parts, archive.batch.in);
      archive.batch.only = batch_programs(archive.batch);
      roots.push_back(archive.batch.in);
      sources.push_back(std::move(archive));
    }
    if (!roots.empty()) sources.front().batch.in = without_archives(sources);
    for (auto& source : sources) {  // the common subprograms of an archive are there for all, first for its own
      auto& libraries = source.batch.translate.libraries;
      if (!source.archive.empty()) libraries.insert(libraries.begin(), source.batch.in);
      for (const auto& root : roots) {
        if (root != source.batch.in) libraries.push_back(root);
      }
    }
    for (const auto& source : sources) {
      std::map<std::pair<std::string, std::string>, Group> mains, subprograms;
      for (const auto& program : source.batch.only)
        add(is_subprogram_file(from, program) ? subprograms : mains, source, program);
      for (auto& [machines, group] : mains) groups_.push_back(std::move(group));
      for (auto& [machines, group] : subprograms) late_.push_back(std::move(group));
    }
  }
  void add(std::map<std::pair<std::string, std::string>, Group>& groups, Group group,
           const std::string& program) const {
    const ProjectFolder* folder = folder_of(config_, group.shown(program));
    if (folder != nullptr && folder->skip) return;
    TranslateOptions& t = group.batch.translate;
    if (folder != nullptr && !folder->machine.empty()) t.machine = folder->machine;
    if (folder != nullptr && !folder->target_machine.empty()) t.target_machine = folder->target_machine;
    group.batch.only.clear();
    const std::pair machines(t.machine, t.target_machine);
    groups.try_emplace(machines, std::move(group)).first->second.batch.only.push_back(program);
  }
  /// A copy of the programs without the archives, so that a program calls none of them as a whole.
  [[nodiscard]] std::string without_archives(const std::vector<Group>& sources) const {
    std::vector<ArchivePart> files;
    std::error_code ignored;
    const fs::path folder = config_.programs;
    for (auto at = fs::recursive_directory_iterator(folder, ignored); at != fs::recursive_directory_iterator();
         at.increment(ignored)) {
      if (!at->is_regular_file(ignored)) continue;
      const std::string name = at->path().lexically_relative(folder).generic_string();
      const bool archive =
          std::any_of(sources.begin(), sources.end(), [&name](const Group& g) { return g.archive == name; });
      if (!archive) files.emplace_back(name, bytes_of(at->path()));
    }
    const fs::path to = work_ / "programs";
    unpack(files, to);
    return to.string();
  }
  /// The parts as files; what an earlier archive had besides goes.
  static void unpack(const std::vector<ArchivePart>& parts, const fs::path& folder) {
    std::error_code ignored;
    std::set<fs::path> there;
    for (const auto& [name, bytes] : parts) {
      const fs::path path = folder / name;
      there.insert(path);
      std::string failed;
      fs::create_directories(path.parent_path(), ignored);
      if (bytes_of(path) != bytes) (void)put(path, bytes, &failed);
    }
    std::vector<fs::path> gone;
    for (auto at = fs::recursive_directory_iterator(folder, ignored); at != fs::recursive_directory_iterator();
         at.increment(ignored)) {
      if (at->is_regular_file(ignored) && !there.contains(at->path())) gone.push_back(at->path());
    }
    for (const auto& path : gone) fs::remove(path, ignored);
  }

  /// The names that the open programs need, one program after the other, so that none is given twice.
  bool name(const Group& group, std::string* error) {
    const ir::NameMap before = names_.map;
    for (const auto& program : batch_open(group.batch)) {
      ir::NameMap more;
      if (names_for(group, program, more)) add_names(names_.map, more);
    }
    if (before == names_.map && fs::exists(saved_names())) return true;
    const std::string text = names_text(names_, config_.from, config_.to);
    return put(config_.names, text, error) && put(saved_names(), text, error);
  }
  /// In a process of its own: a program that ends it gets no names.
  bool names_for(const Group& group, const std::string& program, ir::NameMap& more) const {
    const auto work = [&](std::FILE* out) {
      TranslateOptions t = group.batch.translate;
      t.verify = false;
      t.names = &names_;
      const fs::path source = fs::path(group.batch.in) / program;
      const fs::path to = group.to / fs::path(program).parent_path();
      t.taken = WrittenFiles(to, WrittenFiles::Use::look).taken(origin_of(group, program));
      const TranslateResult result = translate_file(source.string(), t);
      Names found;
      if (!result.refused) found.map = result.names;
      const std::string text = names_text(found, config_.from, config_.to);
      return std::fwrite(text.data(), 1, text.size(), out) == text.size();
    };
    os::Child child;
    if (!child.begin(work, std::chrono::seconds(options_.timeout))) return false;
    const std::string text = child.read_all();
    std::string ignored;
    auto found = parse_names(text, config_.from, config_.to, &ignored);
    if (found) more = std::move(found->map);
    return found.has_value();
  }

  [[nodiscard]] WrittenFiles::Origin origin_of(const Group& group, const std::string& program) const {
    return {(fs::path(group.archive.empty() ? config_.programs : group.batch.in) / program).string(), {}, false};
  }

  /// What became of a program, its outputs put into the folder of the control. `open`: it would be translated anew.
  ProjectProgram place(const Group& group, const std::string& program, bool open, ProjectResult& result) {
    ProjectProgram p;
    p.path = group.shown(program);
    const fs::path made = fs::path(group.batch.out) / program;
    const auto record = read_record((made / record_name).string());
    p.state = !record ? "new" : open ? "source changed" : record->status;
    if (!record) return p;
    if (!open) p.detail = record->detail;
    for (const auto& [file, sum] : record->read) called_.insert(whole(group.batch.in, file));
    p.lines = record->lines;
    p.moves = record->moves;
    p.errors = record->errors;
    p.warnings = record->warnings;
    if (!record->report.empty())
      p.report = (made / record->report).lexically_relative(options_.folder).generic_string();
    const fs::path to = group.to / fs::path(program).parent_path();
    WrittenFiles folder(to, options_.status ? WrittenFiles::Use::look : WrittenFiles::Use::write);
    const WrittenFiles::Origin origin = origin_of(group, program);
    const auto changed = folder.changed();
    for (const auto& name : record->outputs) {
      if (name.ends_with(".unverified")) continue;
      p.outputs.push_back((to / name).lexically_relative(config_.output).generic_string());
      const std::string bytes = bytes_of(made / name), there = bytes_of(to / name);
      const bool by_hand = std::find(changed.begin(), changed.end(), name) != changed.end() && there != bytes;
      if (by_hand) {
        p.state = "changed by hand";
        p.detail = name + " stays as it is; what the translation is now stands in " + (made / name).generic_string();
        p.diffs.emplace_back(name, line_diff(there, bytes));
        continue;
      }
      if (options_.status) continue;
      const std::vector<FileToWrite> file{{name, bytes, {}, false}};
      std::string error;
      if (const auto why = folder.conflicts(file, origin); !why.empty()) {
        p.state = "name taken";
        p.detail = why.front();
      } else if (!folder.write(file, origin, &error)) {
        p.detail = error;
      } else if (there != bytes) {
        result.written.push_back((to / name).generic_string());
      }
    }
    return p;
  }

  /// All outputs as they stand in the folder of the control, mended ones as well, in one file.
  void write_archive(ProjectResult& result) const {
    std::map<std::string, std::string> files;
    for (const auto& p : result.programs) {
      for (const auto& name : p.outputs) files[name] = bytes_of(fs::path(config_.output) / name);
    }
    std::erase_if(files, [](const auto& f) { return f.second.empty(); });
    const std::string bytes = put_together(*find_dialect(config_.to), {files.begin(), files.end()});
    const fs::path path = fs::path(config_.output) / config_.archive;
    if (bytes_of(path) == bytes) return;
    WrittenFiles folder(path.parent_path());
    const WrittenFiles::Origin origin{(fs::path(options_.folder) / "cnctrans.json").string(), {}, false};
    const std::vector<FileToWrite> file{{path.filename().string(), bytes, {}, false}};
    if (const auto why = folder.conflicts(file, origin); !why.empty())
      result.error = why.front();
    else if (folder.write(file, origin, &result.error))
      result.written.push_back(path.generic_string());
  }

  void write_pages(ProjectResult& result) const {
    const fs::path folder(options_.folder);
    (void)(put(folder / "project.html", project_html(result, config_), &result.error) &&
           put(folder / "project.csv", project_csv(result), &result.error));
  }

  const ProjectOptions& options_;
  ProjectConfig config_;
  fs::path work_;
  Names names_;
  std::vector<SourcePtr> definitions_;
  std::vector<Group> groups_, late_;  ///< late: subprograms, which a program may have brought along
  std::set<std::string> called_;      ///< files that were read
  bool edited_ = false;               ///< somebody has changed the file of names since the last run
};

}  // namespace

ProjectResult project(const ProjectOptions& options, const std::function<void(const BatchProgress&)>& progress) {
  ProjectResult refused;
  auto config = read_project(options.folder, &refused.error);
  return config ? Project(options, *std::move(config)).run(progress) : refused;
}

}  // namespace cnctrans::translator
