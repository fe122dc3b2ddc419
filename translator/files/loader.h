// Reads part programs and what they call: the file itself, its folder, and the library folders.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "base/diagnostics.h"
#include "base/source.h"
#include "frontends/common/frontend.h"
#include "ir/program.h"
#include "machine/profile.h"
#include "translator/files/registry.h"

namespace cnctrans::translator {

/// The profile for a source: `machine` (built-in name or file) when given; else by the file's extension; else by
/// unmistakable content (constant cutting speed or diameter programming without any Y word: lathe); else mill. A
/// machine that nobody named gets the axes that the program moves (program_axes.h).
std::optional<machine::Profile> choose_profile(const Dialect& dialect, const std::string& machine,
                                               const SourceText* source, std::string* error);
/// The profile of a translation's target: `machine` when given; else the built-in one of the same kind as the source's,
/// with the axes that were added to that and with its tools, for the job moves with its tools.
std::optional<machine::Profile> choose_target(const Dialect& dialect, const std::string& machine,
                                              const machine::Profile& source, std::string* error);
/// True for a regular file: it can be opened and read as often as one likes. What has been read from a pipe is gone.
bool can_reopen(const std::string& path);

/// A text that is no UTF-8 is taken for Windows-1252, with a note at its first such byte. `text` starts with line
/// `first_line` of the file.
void note_encoding(std::string_view text, std::uint32_t first_line, FileId file, Diagnostics& diagnostics);

/// Owns the files of one job. Programs found in libraries are read once.
class Loader {
 public:
  /// `texts`: programs in memory that may be called; they come before every folder.
  Loader(const Dialect& dialect, const machine::Profile& profile, frontends::Reader reader,
         std::vector<std::string> libraries, const std::vector<SourcePtr>& texts = {});

  /// Reads the main file, which has been opened: its folder is searched first. A pipe has no folder: the current one.
  const ir::Program* read_main(const SourcePtr& source, Diagnostics& diagnostics,
                               frontends::ReadStats* stats = nullptr);
  const ir::Program* read_source(const SourcePtr& source, Diagnostics& diagnostics,
                                 frontends::ReadStats* stats = nullptr);
  /// What was read last is no program of this dialect; that was said, and there is nothing to do with it.
  [[nodiscard]] bool foreign() const { return foreign_; }
  /// The program that holds the routine, or nullptr: header number or name first, then the stem of the file.
  const ir::Program* find(const ir::RoutineName& name);
  /// Reads what a run has written under a name of the control; nullptr, and why: it can't be read.
  const ir::Program* read_written(const std::string& name, const std::string& text, std::string& why);
  /// The name of its file.
  [[nodiscard]] std::string written_file(std::string_view name) const;
  /// Library programs read so far, in the order they were asked for.
  [[nodiscard]] const std::vector<const ir::Program*>& called() const { return called_; }
  /// Diagnostics of library files that were used.
  [[nodiscard]] const Diagnostics& library_diagnostics() const { return library_diagnostics_; }
  FileTable& files() { return files_; }
  /// Files of the libraries that define names for every program of the machine; read when first asked for.
  const std::vector<const ir::Program*>& definitions();
  /// A text in memory defines names as well.
  void define(const SourcePtr& text) { definition_texts_.push_back(text); }
  /// Definitions that another loader has read, in the place of own ones.
  void use_definitions(const Loader& other);
  /// The error that reading gave for one of these lines (see interpreter::Options::fault). Errors on lines without a
  /// statement stand at the next statement of their routine.
  [[nodiscard]] const Diagnostic* fault(FileId file, std::uint32_t first_line, std::uint32_t last_line) const;

 private:
  struct Candidate {
    std::string path;
    std::string stem;  ///< capitals
    SourcePtr source;
    std::unique_ptr<ir::Program> program;
    Diagnostics diagnostics;  ///< of reading it
    bool unreadable = false;
    std::optional<FileId> id = {};
    std::string capitals = {};  ///< the text, once it has been searched
  };
  void list_candidates();
  /// False: it can't be read.
  static bool open(Candidate& c);
  /// There is a file of this name in the folders.
  bool has_file(std::string_view capitals);
  /// What a reader may ask while it reads.
  [[nodiscard]] frontends::ReadOptions read_options();
  frontends::ReadOptions::Text called_text(std::string_view capitals);
  ir::Program* load(Candidate& c);
  /// The file that has the routine; null: none.
  Candidate* locate(const ir::RoutineName& name);
  /// Reads the files that the main program reaches once more, each with all the others as its callers.
  void read_by_callers();
  void note_faults(const ir::Program& program, FileId file, const Diagnostics& said, std::size_t from);
  bool may_hold(Candidate& c, const ir::RoutineName& name);

  const Dialect& dialect_;
  const machine::Profile& profile_;
  frontends::Reader reader_;
  std::vector<std::string> folders_;
  std::string main_path_;
  FileTable files_;
  std::vector<std::unique_ptr<ir::Program>> mains_;
  std::vector<Candidate> candidates_;
  bool listed_ = false, foreign_ = false;
  bool by_callers_ = false;  ///< read_by_callers() has been done
  bool defined_ = false;
  std::vector<std::string> definition_places_;  ///< the libraries, without the folder of the program
  std::vector<SourcePtr> definition_texts_;
  std::vector<std::unique_ptr<ir::Program>> own_definitions_;
  std::vector<const ir::Program*> definitions_;
  std::vector<const ir::Program*> called_;
  std::vector<const ir::Program*> callers_;  ///< of the file that is read, the main program first
  Diagnostics library_diagnostics_;
  std::map<std::pair<FileId, std::uint32_t>, Diagnostic> faults_;  ///< line 0: of a routine without header
};

/// Errors as warnings: what the run has not come to.
Diagnostics as_warnings(const Diagnostics& diagnostics);

}  // namespace cnctrans::translator
