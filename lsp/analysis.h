// What the house makes of the text of a document: read at a change, the rest when it is first asked for.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/diagnostics.h"
#include "ir/analysis/dataflow.h"
#include "lsp/document.h"
#include "lsp/names.h"
#include "lsp/words/words.h"
#include "translator/files/loader.h"
#include "translator/pipeline.h"

namespace cnctrans::lsp {

/// What the client has set.
struct Settings {
  std::string machine;
  std::vector<std::string> libraries;
};

class Analysis {
 public:
  Analysis(const Document& document, const Settings& settings);
  Analysis(const Analysis&) = delete;
  Analysis& operator=(const Analysis&) = delete;

  /// There is a program; else the text is of no language that is known.
  [[nodiscard]] bool read() const { return program_ != nullptr; }
  [[nodiscard]] const translator::Dialect& dialect() const { return *dialect_; }
  [[nodiscard]] const Language& language() const { return *language_; }
  [[nodiscard]] const machine::Profile& profile() const { return *profile_; }
  [[nodiscard]] const ir::Program& program() const { return *program_; }
  [[nodiscard]] const Diagnostics& diagnostics() const { return diagnostics_; }
  [[nodiscard]] const SourcePtr& source() const { return source_; }
  [[nodiscard]] translator::Loader& loader() { return *loader_; }
  [[nodiscard]] FileId file() const { return 1; }
  [[nodiscard]] bool lathe() const { return profile_->kind == machine::Kind::lathe; }

  const std::vector<Occurrence>& names();
  /// Null: there is none at this place.
  const Occurrence* name_at(std::uint32_t line, std::uint32_t column);
  /// What holds before a statement.
  const ir::Facts& facts(const ir::Statement& statement);
  /// The statements of a line, in order.
  const std::vector<const ir::Statement*>& statements(std::uint32_t line);
  /// Where called programs are: the file's own folder first, which a text in memory has not.
  [[nodiscard]] std::vector<std::string> folders() const;
  /// The translation into another language, from the text in memory.
  translator::TranslateResult translate(const std::string& to, translator::TranslateOptions& options) const;

 private:
  const translator::Dialect* dialect_ = nullptr;
  const Language* language_ = nullptr;
  Settings settings_;
  SourcePtr source_;
  std::optional<machine::Profile> profile_;
  std::unique_ptr<translator::Loader> loader_;
  const ir::Program* program_ = nullptr;
  Diagnostics diagnostics_;
  std::optional<std::vector<Occurrence>> names_;
  std::optional<ir::FactTable> facts_;
  std::optional<std::vector<std::vector<const ir::Statement*>>> by_line_;
};

}  // namespace cnctrans::lsp
