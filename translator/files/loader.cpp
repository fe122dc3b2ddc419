#include "translator/files/loader.h"

#include <algorithm>
#include <charconv>
#include <filesystem>

#include "base/text.h"
#include "dialects/options.h"
#include "translator/files/called.h"
#include "translator/files/definitions.h"
#include "translator/files/language.h"
#include "translator/files/program_axes.h"

namespace cnctrans::translator {

namespace fs = std::filesystem;

namespace {

bool listed(const std::vector<std::string_view>& list, std::string_view extension) {
  return std::find(list.begin(), list.end(), extension) != list.end();
}

bool letter_of_name(char c) {
  return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '_';
}

template <class T>
bool holds(const std::vector<T>& list, const T& value) {
  return std::find(list.begin(), list.end(), value) != list.end();
}

/// What the words outside of comments say about the machine.
struct LatheEvidence {
  const LatheMarks& marks;
  bool y_word = false;
  bool without_y = false;
  bool lathe_code = false;
  bool diameter_axis = false;  ///< X is switched to diameters: no mill has that

  void word(std::string_view name, std::string_view rest) {
    const std::string upper = to_upper_ascii(name);
    std::string with_digits = upper;  // DIAM90
    for (const char c : rest) {
      if (c < '0' || c > '9') break;
      with_digits += c;
    }
    diameter_axis = diameter_axis || holds<std::string_view>(marks.diameter_words, with_digits);
    without_y = without_y || holds<std::string_view>(marks.words_without_y, upper);
    const bool value = !rest.empty() && (rest[0] == '-' || rest[0] == '+' || rest[0] == '.' || rest[0] == '=' ||
                                         (rest[0] >= '0' && rest[0] <= '9'));
    if (upper == "Y" && value) y_word = true;
    if (upper != "G") return;
    int code = -1;
    std::from_chars(rest.data(), rest.data() + rest.size(), code);
    lathe_code = lathe_code || holds(marks.codes, code);
    without_y = without_y || holds(marks.codes_without_y, code);
  }
  [[nodiscard]] bool lathe() const { return lathe_code || diameter_axis || (!y_word && without_y); }
};

/// The file is called as the routine: by its name, or by its number with or without what the control puts before it.
bool stem_names(std::string_view stem, const ir::RoutineName& name, std::string_view before_number) {
  const auto digits = [](std::string_view text) {
    const bool all = !text.empty() && text.find_first_not_of("0123456789") == std::string_view::npos;
    return all ? text.substr(std::min(text.find_first_not_of('0'), text.size() - 1)) : std::string_view{};
  };
  if (!name.text.empty()) return stem == name.text || (!digits(stem).empty() && digits(stem) == digits(name.text));
  if (name.number < 0) return false;
  const std::string number = std::to_string(name.number);
  if (!before_number.empty() && stem.starts_with(before_number) && stem.substr(before_number.size()) == number)
    return true;
  const auto digit = stem.find_first_not_of('0');
  return !stem.empty() && (digit == std::string_view::npos ? "0" : stem.substr(digit)) == number;
}

LatheEvidence lathe_evidence(std::string_view text, const Dialect& dialect) {
  const char comment_open = dialect.comment_open, comment_close = dialect.comment_close;
  LatheEvidence evidence{dialect.lathe};
  std::size_t i = 0;
  constexpr std::size_t head = 65536;  // behind a Y word: what tells a lathe stands near the start
  while (i < text.size() && !evidence.lathe_code && (!evidence.y_word || (!evidence.diameter_axis && i < head))) {
    const char c = text[i];
    if (c == comment_open) {
      const std::size_t close =
          text.find_first_of(comment_close == 0 ? std::string_view("\r\n") : std::string_view(&comment_close, 1), i);
      i = close == std::string_view::npos ? text.size() : close + 1;
    } else if (c == '"') {
      const std::size_t close = text.find_first_of("\"\r\n", i + 1);
      i = close == std::string_view::npos ? text.size() : close + 1;
    } else if (letter_of_name(c)) {
      std::size_t end = i;
      while (end < text.size() && letter_of_name(text[end])) ++end;
      evidence.word(text.substr(i, end - i), text.substr(end, 8));
      i = end;
    } else {
      ++i;
    }
  }
  return evidence;
}

/// A machine that somebody names. One of another control reads other words: nothing it does could be trusted.
std::optional<machine::Profile> named_machine(const Dialect& dialect, const std::string& machine, std::string* error) {
  auto profile = dialects::load_profile(machine, error);
  if (!profile || profile->dialect == dialect.name) return profile;
  const Dialect* other = find_dialect(profile->dialect);
  *error = machine + " is a machine of " + (other != nullptr ? std::string(other->title) : profile->dialect) +
           "; one of " + std::string(dialect.title) + " is needed here";
  return std::nullopt;
}

std::string default_machine(const Dialect& dialect, bool lathe) {
  return std::string(dialect.name) + (lathe ? "-lathe" : "-mill");
}

}  // namespace

std::optional<machine::Profile> choose_profile(const Dialect& dialect, const std::string& machine,
                                               const SourceText* source, std::string* error) {
  if (!machine.empty()) return named_machine(dialect, machine, error);
  bool lathe = false, y_axis = false;
  if (source != nullptr) {
    const std::string extension = source->extension();
    if (listed(dialect.lathe_extensions, extension)) {
      lathe = true;
    } else if (!listed(dialect.mill_extensions, extension)) {
      const LatheEvidence e = lathe_evidence(source->text(), dialect);
      lathe = e.lathe();
      y_axis = lathe && e.diameter_axis && e.y_word;
    }
  }
  auto profile = dialects::load_profile(default_machine(dialect, lathe), error);
  if (profile && y_axis && profile->axis(ir::axis::y) == nullptr) {  // a lathe with driven tools
    machine::AxisSpec y;
    y.id = ir::axis::y;
    y.name = "Y";
    profile->axes.insert(profile->axes.begin() + 1, y);
  }
  if (profile && source != nullptr) add_axes_of_program(dialect, *source, *profile);
  return profile;
}

std::optional<machine::Profile> choose_target(const Dialect& dialect, const std::string& machine,
                                              const machine::Profile& source, std::string* error) {
  if (!machine.empty()) return named_machine(dialect, machine, error);
  const bool lathe = source.kind == machine::Kind::lathe;
  auto profile = dialects::load_profile(default_machine(dialect, lathe), error);
  if (!profile && lathe)
    *error = std::string(dialect.title) + " has no lathe here, and the program is one of a lathe (" + source.name +
             "): say --machine where it is a program of a mill, or --target-machine";
  if (!profile) return profile;
  add_axes(*profile, added_axes(source));
  if (profile->tools.empty()) profile->tools = source.tools;
  return profile;
}

bool can_reopen(const std::string& path) {
  std::error_code ignored;
  return fs::is_regular_file(path, ignored);
}

void note_encoding(std::string_view text, std::uint32_t first_line, FileId file, Diagnostics& diagnostics) {
  SourceLine l;
  for (l.number = first_line - 1; take_line(text, l);) {
    if (valid_utf8(l.text)) continue;
    std::string_view rest = l.text;
    while (const std::size_t n = utf8_length(rest)) rest.remove_prefix(n);
    const auto column = static_cast<std::uint32_t>(l.text.size() - rest.size() + 1);
    diagnostics.note("CNC-ENCODING", {file, l.number, column, l.number, column + 1},
                     "the text is no UTF-8; it is read as Windows-1252");
    return;
  }
}

Loader::Loader(const Dialect& dialect, const machine::Profile& profile, frontends::Reader reader,
               std::vector<std::string> libraries, const std::vector<SourcePtr>& texts)
    : dialect_(dialect),
      profile_(profile),
      reader_(reader),
      folders_(libraries),
      definition_places_(std::move(libraries)) {
  for (const auto& text : texts)
    candidates_.push_back({text->name(), to_upper_ascii(text->stem()), text, nullptr, Diagnostics{}, false});
}

const ir::Program* Loader::read_main(const SourcePtr& source, Diagnostics& diagnostics, frontends::ReadStats* stats) {
  const std::string& path = source->name();
  const fs::path parent = can_reopen(path) ? fs::path(path).parent_path() : fs::path();
  folders_.insert(folders_.begin(), parent.string());  // empty: the current one
  main_path_ = path;
  return read_source(source, diagnostics, stats);
}

const ir::Program* Loader::read_source(const SourcePtr& source, Diagnostics& diagnostics, frontends::ReadStats* stats) {
  const FileId id = files_.add(source);
  if (source->encoding() != Encoding::utf8) note_encoding(source->text(), 1, id, diagnostics);
  if (mains_.empty()) note_added_axes(profile_, id, diagnostics);
  const frontends::ReadOptions options = read_options();
  Diagnostics said;
  frontends::ReadStats own;
  frontends::ReadStats& read = stats != nullptr ? *stats : own;
  mains_.push_back(std::make_unique<ir::Program>(dialect_.frontend->read(source, id, options, said, &read)));
  ir::Program& program = *mains_.back();
  program.texts->hold(source);
  if (auto wrong = wrong_language(dialect_, *source, id, read)) {
    foreign_ = !wrong->beside;
    if (foreign_) said.clear();
    said.add(std::move(wrong->said));
  }
  note_faults(program, id, said, 0);
  diagnostics.append(said);
  ir::number_statements(program);
  return &program;
}

const std::vector<const ir::Program*>& Loader::definitions() {
  if (defined_) return definitions_;
  defined_ = true;
  std::vector<SourcePtr> sources;
  for (const auto& path : definition_files(dialect_, definition_places_)) {
    std::string error;
    if (SourcePtr source = SourceText::open(path, &error)) sources.push_back(std::move(source));
  }
  sources.insert(sources.end(), definition_texts_.begin(), definition_texts_.end());
  for (const SourcePtr& source : sources) {
    Diagnostics said;
    const frontends::ReadOptions options{reader_, &profile_};
    own_definitions_.push_back(
        std::make_unique<ir::Program>(dialect_.frontend->read(source, files_.add(source), options, said, nullptr)));
    own_definitions_.back()->texts->hold(source);
    definitions_.push_back(own_definitions_.back().get());
    const Diagnostics warnings = as_warnings(said);
    for (const auto& d : warnings.all()) {  // what it means for a program is no concern of it
      if (d.severity == Severity::warning) library_diagnostics_.add(d);
    }
  }
  return definitions_;
}

void Loader::use_definitions(const Loader& other) {
  defined_ = true;
  definitions_ = other.definitions_;
}

void Loader::list_candidates() {
  if (listed_) return;
  listed_ = true;
  std::set<std::string> seen;
  std::error_code ignored;
  if (!main_path_.empty()) seen.insert(fs::weakly_canonical(main_path_, ignored).string());
  for (const auto& folder : folders_) {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder.empty() ? "." : folder, ignored)) {
      if (!entry.is_regular_file(ignored)) continue;
      std::string extension = entry.path().extension().string();
      if (!extension.empty()) extension.erase(0, 1);
      std::transform(extension.begin(), extension.end(), extension.begin(),
                     [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
      if (listed(dialect_.mill_extensions, extension) || listed(dialect_.lathe_extensions, extension) ||
          listed(dialect_.other_extensions, extension)) {
        names.push_back((folder.empty() ? entry.path().filename() : entry.path()).string());
      }
    }
    std::sort(names.begin(), names.end());
    for (auto& n : names) {
      if (!seen.insert(fs::weakly_canonical(n, ignored).string()).second) continue;
      candidates_.push_back({n, to_upper_ascii(fs::path(n).stem().string()), nullptr, nullptr, Diagnostics{}, false});
    }
  }
}

bool Loader::has_file(std::string_view capitals) {
  list_candidates();
  return std::any_of(candidates_.begin(), candidates_.end(),
                     [capitals](const Candidate& c) { return c.stem == capitals; });
}

frontends::ReadOptions::Text Loader::called_text(std::string_view capitals) {
  list_candidates();
  for (Candidate& c : candidates_) {
    if (c.stem != capitals || !open(c)) continue;
    if (!c.id) c.id = files_.add(c.source);
    return {c.source, *c.id};
  }
  return {};
}

frontends::ReadOptions Loader::read_options() {
  frontends::ReadOptions options{reader_, &profile_, &definitions()};
  options.has_program = [this](std::string_view name) { return has_file(name); };
  options.called_text = [this](std::string_view name) { return called_text(name); };
  return options;
}

bool Loader::open(Candidate& c) {
  if (c.unreadable || c.source) return !c.unreadable;
  std::string error;
  c.source = SourceText::open(c.path, &error);
  c.unreadable = !c.source;
  return !c.unreadable;
}

bool Loader::may_hold(Candidate& c, const ir::RoutineName& name) {
  if (!open(c)) return false;
  if (c.program) return true;
  if (c.capitals.empty()) c.capitals = to_upper_ascii(c.source->bytes());
  const std::string wanted = name.text.empty() ? std::to_string(name.number) : to_upper_ascii(name.text);
  return c.capitals.find(wanted) != std::string::npos;
}

ir::Program* Loader::load(Candidate& c) {
  if (!c.program) {
    const bool alone = !by_callers_ && dialect_.frontend->reads_by_callers();  // it is read once more
    if (!c.id) c.id = files_.add(c.source);
    const FileId id = *c.id;
    frontends::ReadOptions options = read_options();
    options.callers = &callers_;
    if (c.source->encoding() != Encoding::utf8) note_encoding(c.source->text(), 1, id, c.diagnostics);
    c.program = std::make_unique<ir::Program>(dialect_.frontend->read(c.source, id, options, c.diagnostics, nullptr));
    c.program->texts->hold(c.source);
    if (!alone) note_faults(*c.program, id, c.diagnostics, 0);
    ir::number_statements(*c.program);
  }
  return c.program.get();
}

Loader::Candidate* Loader::locate(const ir::RoutineName& name) {
  list_candidates();
  for (const bool named_so : {true, false}) {  // most routines stand in a file of their name
    for (auto& c : candidates_) {
      const bool holds = stem_names(c.stem, name, dialect_.numbered_stem) == named_so && may_hold(c, name);
      if (holds && load(c)->find(name) != nullptr) return &c;
    }
  }
  for (auto& c : candidates_) {
    if (!stem_names(c.stem, name, dialect_.numbered_stem) || !open(c)) continue;
    ir::Program* p = load(c);
    // The file is the routine: its first routine answers to the stem's name.
    if (!p->routines.empty() && p->routines.front().name.empty()) p->routines.front().name = name;
    if (p->find(name) != nullptr) return &c;
    if (p->routines.empty()) continue;
    const auto main = std::find_if(p->routines.begin(), p->routines.end(),
                                   [](const ir::Routine& r) { return r.kind == ir::RoutineKind::main; });
    (main != p->routines.end() ? *main : p->routines.front()).name = name;
    return &c;
  }
  return nullptr;
}

void Loader::read_by_callers() {
  if (by_callers_ || mains_.empty() || !dialect_.frontend->reads_by_callers()) return;
  std::vector<Candidate*> reached;
  std::vector<ir::RoutineName> wanted;
  collect_calls(*mains_.front(), wanted);
  while (!wanted.empty()) {
    const ir::RoutineName name = wanted.back();
    wanted.pop_back();
    if (mains_.front()->find(name) != nullptr) continue;
    Candidate* c = locate(name);
    if (c == nullptr || std::find(reached.begin(), reached.end(), c) != reached.end()) continue;
    reached.push_back(c);
    collect_calls(*c->program, wanted);
  }
  by_callers_ = true;
  std::vector<std::unique_ptr<ir::Program>> alone;
  for (Candidate* c : reached) alone.push_back(std::move(c->program));
  for (Candidate& c : candidates_) {  // what was only looked into: a computed call may reach it
    c.program.reset();
    c.diagnostics.clear();
  }
  for (std::size_t k = 0; k < reached.size(); ++k) {
    callers_ = {mains_.front().get()};
    for (std::size_t n = 0; n < alone.size(); ++n) {
      if (n != k) callers_.push_back(alone[n].get());
    }
    reached[k]->diagnostics.clear();
    const ir::Program* read = load(*reached[k]);
    for (std::size_t r = 0; r < read->routines.size() && r < alone[k]->routines.size(); ++r)
      reached[k]->program->routines[r].name = alone[k]->routines[r].name;
  }
  callers_ = {mains_.front().get()};
  for (const Candidate* c : reached) callers_.push_back(c->program.get());
}

const ir::Program* Loader::find(const ir::RoutineName& name) {
  read_by_callers();
  Candidate* c = locate(name);
  if (c == nullptr) return nullptr;
  // What a file has to report counts only when something of it is called.
  const ir::Program* p = c->program.get();
  if (std::find(called_.begin(), called_.end(), p) != called_.end()) return p;
  called_.push_back(p);
  library_diagnostics_.append(c->diagnostics);
  return p;
}

std::string Loader::written_file(std::string_view name) const {
  std::string file = dialect_.written_file != nullptr
                         ? dialect_.written_file(name, profile_.kind == machine::Kind::lathe)
                         : std::string(name);
  for (char& c : file) {
    const bool plain = letter_of_name(c) || (c >= '0' && c <= '9') || c == '-' || c == '.';
    if (!plain) c = '_';
  }
  return file;
}

const ir::Program* Loader::read_written(const std::string& name, const std::string& text, std::string& why) {
  Diagnostics said;
  const ir::Program* program = read_source(SourceText::from_string(written_file(name), text), said);
  for (const auto& d : said.all()) {
    if (d.severity != Severity::error) continue;
    why = "line " + std::to_string(d.span.line) + ": " + d.message;
    return nullptr;
  }
  return program;
}

}  // namespace cnctrans::translator
