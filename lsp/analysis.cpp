#include "lsp/analysis.h"

#include <algorithm>

#include "ir/text/text.h"
#include "translator/files/language.h"
#include "translator/files/readable.h"

namespace cnctrans::lsp {

namespace {

/// By the client's language, by the file's name and content.
const translator::Dialect* dialect_of(const Document& document, const SourceText& source) {
  const auto* named = translator::find_dialect(document.language());
  if (named != nullptr && translator::readable(*named)) return named;
  return translator::find_language(source).dialect;
}

}  // namespace

Analysis::Analysis(const Document& document, const Settings& settings)
    : settings_(settings), source_(SourceText::from_string(document.path(), document.text())) {
  dialect_ = dialect_of(document, *source_);
  language_ = dialect_ == nullptr ? nullptr : lsp::language(dialect_->name);
  if (language_ == nullptr) return;
  std::string error;
  profile_ = translator::choose_profile(*dialect_, settings.machine, source_.get(), &error);
  if (!profile_) {  // a machine of another control: the program is read as it stands
    diagnostics_.warning("CNC-USAGE", {1, 1, 1, 1, 2}, "the machine of the settings can't be used: " + error);
    profile_ = translator::choose_profile(*dialect_, {}, source_.get(), &error);
  }
  if (!profile_) return;
  loader_ = std::make_unique<translator::Loader>(*dialect_, *profile_, frontends::Reader::scanner, settings.libraries);
  program_ = loader_->read_main(source_, diagnostics_);
  ir::check_well_formed(*program_, diagnostics_);
}

const std::vector<Occurrence>& Analysis::names() {
  if (!names_) names_ = find_names(*program_, file(), *source_, *language_);
  return *names_;
}

const Occurrence* Analysis::name_at(std::uint32_t line, std::uint32_t column) {
  const auto& all = names();
  const auto found = std::find_if(all.begin(), all.end(), [line, column](const Occurrence& o) {
    return o.span.line == line && o.span.column <= column && column <= o.span.end_column;
  });
  return found == all.end() ? nullptr : &*found;
}

const ir::Facts& Analysis::facts(const ir::Statement& statement) {
  if (!facts_) facts_ = ir::analyse(*program_, profile_->power_on);
  return facts_->before(statement.id);
}

const std::vector<const ir::Statement*>& Analysis::statements(std::uint32_t line) {
  static const std::vector<const ir::Statement*> none;
  if (!by_line_) {
    by_line_.emplace(source_->lines().size() + 2);
    for (const auto& routine : program_->routines) {
      ir::for_each_statement(routine.body, [&](const ir::Statement& s) {
        if (s.line.span.file != file()) return;
        for (std::uint32_t n = s.line.span.line; n <= std::max(s.line.span.line, s.line.span.end_line); ++n) {
          if (n < by_line_->size()) (*by_line_)[n].push_back(&s);
        }
      });
    }
  }
  return line < by_line_->size() ? (*by_line_)[line] : none;
}

std::vector<std::string> Analysis::folders() const {
  std::vector<std::string> out = settings_.libraries;
  if (!translator::can_reopen(source_->name())) return out;
  const auto slash = source_->name().rfind('/');
  out.insert(out.begin(), slash == std::string::npos ? "." : source_->name().substr(0, slash));
  return out;
}

translator::TranslateResult Analysis::translate(const std::string& to, translator::TranslateOptions& options) const {
  options.from = dialect_->name;
  options.to = to;
  options.machine = settings_.machine;
  options.libraries = folders();
  translator::prove_as_usual(options);
  return translator::translate(source_, options);
}

}  // namespace cnctrans::lsp
