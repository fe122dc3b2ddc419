#include "translator/files/written_files.h"

#include <algorithm>
#include <fstream>
#include <sstream>

#include "base/sum.h"
#include "base/text.h"
#include "base/uri.h"

namespace cnctrans::translator {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view list_name = ".cnctrans-written";
constexpr std::string_view head =
    "# What cnctrans wrote into this folder: sums, file, number in the control, sources. It replaces nothing else.\n";
constexpr std::string_view nobody = "-";  ///< a source that can't be known again: a pipe

std::string text_of(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

fs::path real_path(const fs::path& path) {
  std::error_code ignored;
  return fs::weakly_canonical(fs::absolute(path, ignored), ignored);
}

template <class List>
std::string joined(const List& list) {
  std::string text;
  for (const auto& item : list) text += (text.empty() ? "" : ",") + percent_encoded(item);
  return text.empty() ? std::string(nobody) : text;
}

/// The parts of "a,b"; none of "-".
std::vector<std::string> parts(const std::string& text) {
  std::vector<std::string> list;
  std::istringstream in(text);
  for (std::string part; text != nobody && std::getline(in, part, ',');)
    if (auto plain = percent_decoded(part)) list.push_back(std::move(*plain));
  return list;
}

}  // namespace

WrittenFiles::Entries WrittenFiles::read(const std::string& text) {
  Entries entries;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string sums, name, program, origins;
    if (line.starts_with('#') || !(words >> sums >> name >> program >> origins)) continue;
    const auto plain = percent_decoded(name);
    const auto number = parts(program), from = parts(origins);
    if (!plain || plain->find('/') != std::string::npos) continue;  // of this folder alone
    entries[*plain] = {parts(sums), {from.begin(), from.end()}, number.empty() ? std::string() : number.front()};
  }
  return entries;
}

std::string WrittenFiles::text() const {
  std::string text(head);
  for (const auto& [name, e] : entries_) {
    text += joined(e.sums) + ' ' + percent_encoded(name) + ' ' +
            (e.program.empty() ? std::string(nobody) : percent_encoded(e.program)) + ' ' + joined(e.origins) + '\n';
  }
  return text;
}

WrittenFiles::WrittenFiles(fs::path folder, Use use) {
  std::error_code ignored;
  if (folder.empty()) folder = ".";
  if (use == Use::write) fs::create_directories(folder, ignored);
  folder_ = real_path(folder);
  const std::string list = path(std::string(list_name));
  if (use == Use::write) list_.open(list);
  entries_ = read(text_of(list));
}

std::set<std::string> WrittenFiles::names() const {
  std::set<std::string> names;
  for (const auto& [name, e] : entries_) names.insert(name);
  return names;
}

/// A folder of programs that is moved with its translations stays known: the path is one from here.
std::string WrittenFiles::from_here(const std::string& source) const {
  std::error_code ignored;
  const fs::path file = real_path(source);
  if (!fs::is_regular_file(file, ignored) && !fs::is_directory(file, ignored)) return {};
  return file.lexically_relative(folder_).generic_string();
}

std::string WrittenFiles::as_said(const std::string& origin) const {
  std::error_code ignored;
  const fs::path file = (folder_ / origin).lexically_normal();
  const fs::path near = file.lexically_relative(fs::current_path(ignored));
  return near.empty() || *near.begin() == ".." ? file.string() : near.string();
}

std::set<std::string> WrittenFiles::replaceable(const Origin& origin) const {
  std::set<std::string> mine{from_here(origin.source)};
  for (const auto& source : origin.coming) mine.insert(from_here(source));
  mine.erase("");
  return mine;
}

namespace {

std::string sum_to_be(const FileToWrite& file) {
  return file.sum.empty() ? sum_of(file.bytes) : file.sum;
}

}  // namespace

std::string WrittenFiles::conflict(const FileToWrite& file, const std::set<std::string>& mine, bool force) const {
  const std::string sum = sum_to_be(file);
  std::error_code ignored;
  const auto others = [&](const Entry& e) {
    std::string text;
    for (const auto& o : e.origins)
      if (!mine.contains(o)) text += (text.empty() ? "" : ", ") + as_said(o);
    return e.origins.empty() ? std::string("another program") : text;
  };
  const std::string place = path(file.name), said = as_said(file.name);
  const auto there = [&](const std::string& name) { return fs::is_regular_file(path(name), ignored); };
  for (const auto& [name, e] : entries_) {  // the target's disk may not tell small letters from capitals
    if (force || name == file.name || !there(name) || others(e).empty()) continue;
    if (iequals_ascii(name, file.name) && sum_of_file(path(name)) != sum)
      return said + " holds a different program already, from the translation of " + others(e);
    if (!file.named && !file.program.empty() && e.program == file.program)
      return said + " would be the program " + file.program + ", which " + as_said(name) +
             " is already, from the translation of " + others(e);
  }
  if (!there(file.name) || fs::file_size(place, ignored) == 0 || force) return {};
  const std::string now = sum_of_file(place);
  if (now == sum) return {};
  const auto it = entries_.find(file.name);
  if (it == entries_.end()) return said + " is there already, and cnctrans did not write it";
  if (std::find(it->second.sums.begin(), it->second.sums.end(), now) == it->second.sums.end())
    return said + " was changed since cnctrans wrote it";
  if (file.named || others(it->second).empty()) return {};
  return said + " holds a different program already, from the translation of " + others(it->second);
}

std::vector<std::string> WrittenFiles::conflicts(const std::vector<FileToWrite>& files, const Origin& origin) const {
  std::set<std::string> mine = replaceable(origin);
  for (const auto& f : files) {  // who takes the place of a main program takes that of its subprograms
    const auto it = entries_.find(f.name);
    if (f.named && it != entries_.end()) mine.insert(it->second.origins.begin(), it->second.origins.end());
  }
  std::vector<std::string> found;
  for (const auto& f : files) {
    if (auto why = conflict(f, mine, origin.force); !why.empty()) found.push_back(std::move(why));
  }
  return found;
}

void WrittenFiles::put(const FileToWrite& file, const std::string& origin) {
  const std::string sum = sum_to_be(file);
  std::error_code ignored;
  const fs::file_status there = fs::status(path(file.name), ignored);
  if (fs::exists(there) && !fs::is_regular_file(there)) return;  // a pipe, a device
  const std::string now = sum_of_file(path(file.name));
  Entry& e = entries_[file.name];
  if (now != sum) e.origins.clear();
  if (!origin.empty()) e.origins.insert(origin);
  const bool ours = now != sum && std::find(e.sums.begin(), e.sums.end(), now) != e.sums.end();
  e.sums = ours ? std::vector{sum, now} : std::vector{sum};
  e.program = file.program;
}

void WrittenFiles::add(const std::vector<FileToWrite>& files, const Origin& origin) {
  const std::string source = from_here(origin.source);
  for (const auto& f : files) put(f, source);
  save();
}

bool WrittenFiles::write(const std::vector<FileToWrite>& files, const Origin& origin, std::string* error) {
  add(files, origin);
  return std::all_of(files.begin(), files.end(), [&](const FileToWrite& f) {
    if (f.put_in_place) return f.put_in_place(error);
    AtomicFile file(path(f.name));
    return file.open(error) && file.write(f.bytes, error) && file.commit(error);
  });
}

std::vector<std::string> WrittenFiles::changed() const {
  std::vector<std::string> found;
  for (const auto& [name, e] : entries_) {
    const std::string now = sum_of_file(path(name));
    if (!now.empty() && std::find(e.sums.begin(), e.sums.end(), now) == e.sums.end()) found.push_back(name);
  }
  return found;
}

void WrittenFiles::remove_all_but(const std::set<std::string>& names) {
  const auto kept = changed();
  const std::size_t before = entries_.size();
  std::erase_if(entries_, [&](const auto& item) {
    if (names.contains(item.first) || std::find(kept.begin(), kept.end(), item.first) != kept.end()) return false;
    std::error_code ignored;
    fs::remove(path(item.first), ignored);
    return true;
  });
  if (entries_.size() != before) save();
}

std::set<std::string> WrittenFiles::taken(const Origin& origin) const {
  const auto mine = replaceable(origin);
  std::set<std::string> names;
  std::error_code ignored;
  for (const auto& [name, e] : entries_) {
    const bool other = e.origins.empty() || std::any_of(e.origins.begin(), e.origins.end(),
                                                        [&](const auto& o) { return !mine.contains(o); });
    if (origin.force || !other || !fs::exists(path(name), ignored)) continue;
    names.insert(to_upper_ascii(name));
    if (!e.program.empty()) names.insert(to_upper_ascii(e.program));
  }
  return names;
}

void WrittenFiles::save() {
  list_.replace(text());
}

}  // namespace cnctrans::translator
