// The pipeline as library calls: read, check, run, translate, verify.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "backends/common/backend.h"
#include "base/diagnostics.h"
#include "interpreter/program/interpreter.h"
#include "legaliser/legalise.h"
#include "translator/files/loader.h"
#include "translator/files/names_file.h"
#include "translator/files/registry.h"
#include "translator/proving/proof.h"
#include "verifier/compare.h"

namespace cnctrans::translator {

/// Progress of long jobs: part done 0..1. May be empty.
using Progress = std::function<void(double)>;

/// A program to work on: a file, or a text in memory. A text has no folder of its own that would be searched for what
/// it calls.
class Input {
 public:
  Input(std::string path) : path_(std::move(path)) {}  // NOLINT(google-explicit-constructor): a path is an input
  Input(SourcePtr text) : text_(std::move(text)) {}    // NOLINT(google-explicit-constructor): so is a text
  /// A file whose text is at hand.
  Input(std::string path, SourcePtr text) : path_(std::move(path)), text_(std::move(text)) {}

  [[nodiscard]] bool in_memory() const { return text_ != nullptr && path_.empty(); }
  [[nodiscard]] const std::string& path() const { return path_; }  ///< empty for a text
  /// nullptr, and why in `error`: it can't be read.
  SourcePtr open(std::string* error) const;

 private:
  std::string path_;
  SourcePtr text_;
};

/// How programs are found and read.
struct InputOptions {
  std::string machine;                 ///< built-in name or file; empty: chosen
  std::string tools;                   ///< file of tools for the machine; empty: those of its profile
  std::vector<std::string> libraries;  ///< folders and files
  std::vector<SourcePtr> texts;        ///< programs in memory that may be called; they come before every folder
  std::vector<SourcePtr> definitions;  ///< in memory: they define names for every program of the machine
  frontends::Reader reader = frontends::Reader::scanner;
};

class FoldedText;

struct TranslateOptions : InputOptions {
  const FoldedText* folded = nullptr;  ///< the program is the folded text of a file; may be null
  std::string from, to;                ///< registry names
  std::string target_machine;          ///< as `machine`
  backends::Unsupported unsupported = backends::Unsupported::error;
  backends::Numbering numbering = backends::Numbering::keep;
  std::int32_t number_step = 10;
  bool draft = false;  ///< with Unsupported::comment: what is left to do stands at the head, in order
  bool annotate = false;
  bool origin = false;          ///< a remark at the head names the source's file and control
  bool verify = false;          ///< a proof is made; then:
  FurtherReplays further;       ///< beside the one of the program as written
  bool strict = true;           ///< what can't be replayed is held back as well, not only what differs
  bool keep_traces = false;     ///< both traces stay in the result, for a report
  bool single_output = false;   ///< everything in one file (standard output): as an archive where the target has one
  bool files_apart = false;     ///< called programs of other files go to files of their own, in every language
  std::set<std::string> taken;  ///< names that other translations of the job have: see backends::WriteOptions
  ir::CycleWriting cycles = ir::CycleWriting::native;
  bool raise_structure = false;      ///< jumps become structures where the target has them and it is provably the same
  std::optional<Encoding> encoding;  ///< of the output; else as the input
  std::optional<Eol> eol;
  interpreter::Options run;      ///< limits, --set, --skip for the verification
  const Names* names = nullptr;  ///< names that are given; may be null
  std::string only_pass;         ///< of the legaliser; empty: all
  ir::BehindPass behind_pass{};  ///< gets the program behind each pass; may be empty
};

/// Something that a draft leaves to a person.
struct ToDo {
  std::string code, message, hint;
  std::vector<Span> places;
  bool placeholder = false;  ///< a variable stands for it; the lines are translated
};

/// One file of the result, ready to be written: encoded, with line ends.
struct OutputText {
  std::string name;
  std::string program;  ///< of a main program: its name in the control where that is not the file's
  std::string bytes;
  backends::SourceMap map;
  bool main = false;
};

/// The proof that a translation gets without being asked.
void prove_as_usual(TranslateOptions& options);

/// What a program does that its text was not folded for.
struct Unfit {
  std::set<std::uint64_t> numbers;  ///< it jumps to these blocks
  std::set<std::uint32_t> runs;     ///< of plain lines that are not read as they look
  std::uint32_t letters = 0;        ///< of axes whose words mean more than their number; bit 0 is A
  std::uint32_t by_way = 0;         ///< of axes whose words go by the way there
  bool whole = false;               ///< any line may matter
};

struct TranslateResult {
  std::optional<Unfit> unfit;  ///< of a folded text: nothing else counts
  bool refused = false;        ///< nothing may be written
  bool held_back = false;      ///< by the proof: the outputs may be looked at and not used
  std::vector<OutputText> outputs;
  bool draft = false;  ///< asked for, and something is left to do
  std::vector<ToDo> to_do;
  std::vector<Span> untranslated;  ///< lines of the source that the outputs leave out
  Diagnostics diagnostics;
  FileTable files;
  bool verified = false;  ///< a verification ran
  verifier::Verdict verdict;
  FileTable target_files;                                      ///< of the verification
  Diagnostics target_diagnostics;                              ///< why the translation could not be replayed
  std::vector<interpreter::Event> source_trace, target_trace;  ///< with `keep_traces`
  std::string source_machine, target_machine;                  ///< names of the profiles
  bool lathe = false;                                          ///< the source's machine is one
  std::uint64_t lines = 0;
  std::uint64_t lines_by_form = 0;  ///< plain lines of a long file that are written as those of their form
  ir::NameMap names;                ///< those that the translation has, given or chosen
  std::string error;                ///< could not even start (file missing, unknown dialect): usage
};

/// What the proof came to, in words; `targets`: the files of the verification under the names to tell. "not asked"
/// where none was made, else it begins with "verified", "not verified" or "not proved: ".
std::string proof_text(const TranslateResult& result, const FileTable& targets);

/// Translates one program in memory, with what it calls.
TranslateResult translate(const Input& input, const TranslateOptions& options);

/// Compares a source with a translation made by anyone: its main program, and what else it calls.
struct VerifyResult {
  Diagnostics source_diagnostics, target_diagnostics;
  FileTable source_files, target_files;
  verifier::Verdict verdict;
  std::string error;
};
VerifyResult verify(const Input& source, const std::vector<Input>& targets, const TranslateOptions& options);

struct RunOptions : InputOptions {
  std::string dialect;
  interpreter::Options run;
  bool may_stream = false;  ///< long programs may run in flat memory (the sink must not keep or print events)
  const FoldedText* folded = nullptr;  ///< the program is the folded text of a file; may be null
};
struct RunResult {
  interpreter::Result result;
  Diagnostics diagnostics;
  FileTable files;
  std::vector<std::string> axis_names;
  std::vector<std::pair<std::string, std::string>> written;  ///< files that the program has written: name, text
  std::optional<Unfit> unfit;                                ///< of a folded text: nothing else counts
  std::string error;
};
/// Makes the receiver of the events; gets the file table and the axis names that events refer to.
using MakeSink =
    std::function<std::unique_ptr<interpreter::TraceSink>(const FileTable&, const std::vector<std::string>&)>;
RunResult run(const Input& input, const RunOptions& options, const MakeSink& make_sink);

/// Reads a program and writes it in its own language, without any pass: identity tests, and tidy-up of own programs.
struct RewriteResult {
  ir::Program program;
  std::vector<backends::OutputFile> files;
  Diagnostics diagnostics;
  std::string error;
};
RewriteResult rewrite(const SourcePtr& source, const std::string& dialect, const std::string& machine);

struct CheckResult {
  Diagnostics diagnostics;
  FileTable files;
  frontends::ReadStats stats;
  std::string error;
};
CheckResult check(const Input& input, const RunOptions& options);

}  // namespace cnctrans::translator
