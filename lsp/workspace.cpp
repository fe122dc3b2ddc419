#include "lsp/workspace.h"

namespace cnctrans::lsp {

void Workspace::open(const std::string& uri, const std::string& language, std::string text) {
  documents_.insert_or_assign(uri, Document(uri, language, std::move(text)));
  analyses_.erase(uri);
}

void Workspace::close(const std::string& uri) {
  documents_.erase(uri);
  analyses_.erase(uri);
}

Document* Workspace::find(const std::string& uri) {
  const auto found = documents_.find(uri);
  return found == documents_.end() ? nullptr : &found->second;
}

void Workspace::changed(const std::string& uri) {
  analyses_.erase(uri);
}

void Workspace::all_changed() {
  analyses_.clear();
}

Analysis* Workspace::analysis(const std::string& uri) {
  const Document* document = find(uri);
  if (document == nullptr) return nullptr;
  auto& analysis = analyses_[uri];
  if (!analysis) analysis = std::make_unique<Analysis>(*document, settings);
  return analysis->read() ? analysis.get() : nullptr;
}

}  // namespace cnctrans::lsp
