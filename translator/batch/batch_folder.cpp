#include "translator/batch/batch_folder.h"

#include <algorithm>

#include "translator/batch/batch_record.h"

namespace cnctrans::translator {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view summary_names[] = {"summary.csv", "programs.csv", "summary.html"};

fs::path real(const fs::path& path) {
  std::error_code ignored;
  return fs::weakly_canonical(fs::absolute(path, ignored), ignored);
}

/// `path` is the folder or lies in it; both without links.
bool lies_in(const fs::path& path, const fs::path& folder) {
  return std::mismatch(folder.begin(), folder.end(), path.begin(), path.end()).first == folder.end();
}

std::string with_advice(const std::string& why) {
  return why + "; it is left alone (--force replaces it)";
}

}  // namespace

std::string BatchFolder::fault() const {
  std::error_code ignored;
  if (fs::equivalent(options_.in, options_.out, ignored))
    return "the results can't go into the folder of the programs, " + options_.in + "; choose another";
  fs::create_directories(options_.out, ignored);
  const WrittenFiles files(options_.out, WrittenFiles::Use::look);
  for (const auto& name : summary_names) {
    const auto why = files.conflicts(std::vector<FileToWrite>{{std::string(name)}}, origin_of_summary());
    if (!why.empty()) return with_advice(why.front());
  }
  return {};
}

bool BatchFolder::is_result(const fs::path& file) {
  const fs::path folder = real(file.parent_path());
  if (!lies_in(folder, real(options_.out))) return false;
  const auto [it, fresh] = results_.emplace(folder, std::set<std::string>{});
  if (fresh) it->second = WrittenFiles(folder, WrittenFiles::Use::look).names();
  return it->second.contains(file.filename().string());
}

fs::path BatchFolder::folder_of(const std::string& program) const {
  return fs::path(options_.out) / program;
}

std::string BatchFolder::record_path(const std::string& program) const {
  return (folder_of(program) / record_name).string();
}

WrittenFiles::Origin BatchFolder::origin(const std::string& program) const {
  return {(fs::path(options_.in) / program).string(), {}, options_.force};
}

std::string BatchFolder::left_alone(const std::string& program) const {
  std::error_code ignored;
  const fs::path folder = folder_of(program);
  for (fs::path p = folder; p.has_relative_path() && p != fs::path(options_.out); p = p.parent_path()) {
    if (fs::exists(p, ignored) && !fs::is_directory(p, ignored))
      return p.string() + " is a file, and the results of this program need a folder of that name";
  }
  if (!fs::exists(folder, ignored) || options_.force) return {};
  const WrittenFiles files(folder, WrittenFiles::Use::look);
  for (const auto& name : files.changed())
    return with_advice((folder / name).string() + " was changed since cnctrans wrote it");
  const auto why = files.conflicts(std::vector<FileToWrite>{{std::string(record_name)}}, origin(program));
  return why.empty() ? std::string() : with_advice(why.front());
}

bool BatchFolder::write(BatchRecord record, const std::vector<FileToWrite>& outputs) const {
  WrittenFiles folder(folder_of(record.program));
  const auto why = folder.conflicts(outputs, origin(record.program));
  std::vector<FileToWrite> files = outputs;
  if (!why.empty()) {
    record.status = "left alone";
    record.detail = with_advice(why.front());
    files.clear();
  }
  record.outputs.clear();
  for (const auto& f : files) {
    if (f.name != record.report) record.outputs.push_back(f.name);
  }
  const std::string text = to_json(record);
  files.push_back({std::string(record_name), text});
  std::set<std::string> names;
  for (const auto& f : files) names.insert(f.name);
  if (why.empty()) folder.remove_all_but(names);
  std::string error;
  return folder.write(files, origin(record.program), &error);
}

bool BatchFolder::write_record(const BatchRecord& record) const {
  WrittenFiles folder(folder_of(record.program));
  const std::string text = to_json(record);
  const std::vector<FileToWrite> file{{std::string(record_name), text}};
  std::string error;
  return folder.conflicts(file, origin(record.program)).empty() && folder.write(file, origin(record.program), &error);
}

bool BatchFolder::write_summary(const std::function<std::vector<BatchRecord>()>& read, std::size_t all,
                                std::string* error) const {
  WrittenFiles folder(options_.out);
  const auto records = read();
  const std::string texts[] = {summary_csv(records, all), programs_csv(records), summary_html(records, options_, all)};
  std::vector<FileToWrite> files;
  for (std::size_t i = 0; i < std::size(texts); ++i) files.push_back({std::string(summary_names[i]), texts[i]});
  if (const auto why = folder.conflicts(files, origin_of_summary()); !why.empty()) {
    *error = with_advice(why.front());
    return false;
  }
  return folder.write(files, origin_of_summary(), error);
}

}  // namespace cnctrans::translator
