// The folder that a batch writes to: a folder for each program, and the summary. Nothing in it is replaced or removed
// that the batch has not written, or that somebody has changed since.
#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "translator/batch/batch.h"
#include "translator/files/written_files.h"

namespace cnctrans::translator {

class BatchFolder {
 public:
  explicit BatchFolder(const BatchOptions& options) : options_(options) {}

  /// Why nothing can be written here; empty: it can. The folder is made when it is not there.
  [[nodiscard]] std::string fault() const;
  /// The file is one that a batch has written: no source, even where this folder lies among the sources or above them.
  bool is_result(const std::filesystem::path& file);

  [[nodiscard]] std::string record_path(const std::string& program) const;
  /// Why what is there for this program must stay as it is; empty: it need not. Such a program is not translated at
  /// all: a main program that somebody has mended would be left with other subprograms.
  [[nodiscard]] std::string left_alone(const std::string& program) const;
  /// The outputs with the record, in the place of those of an earlier run. Where one of them may not be written, only
  /// the record is, and says so. False: not even that.
  bool write(BatchRecord record, const std::vector<FileToWrite>& outputs) const;
  /// The record alone; outputs of an earlier run stay.
  bool write_record(const BatchRecord& record) const;
  /// The summary of the records that `read` brings; nobody else writes one meanwhile.
  bool write_summary(const std::function<std::vector<BatchRecord>()>& read, std::size_t all, std::string* error) const;

 private:
  [[nodiscard]] std::filesystem::path folder_of(const std::string& program) const;
  [[nodiscard]] WrittenFiles::Origin origin(const std::string& program) const;
  [[nodiscard]] WrittenFiles::Origin origin_of_summary() const { return {options_.in, {}, options_.force}; }

  const BatchOptions& options_;
  std::map<std::filesystem::path, std::set<std::string>> results_;  ///< by folder: names of files
};

}  // namespace cnctrans::translator
