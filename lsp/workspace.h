// The documents that are open, each with its analysis.
#pragma once

#include <map>
#include <memory>
#include <string>

#include "lsp/analysis.h"
#include "lsp/document.h"

namespace cnctrans::lsp {

class Workspace {
 public:
  Settings settings;

  void open(const std::string& uri, const std::string& language, std::string text);
  void close(const std::string& uri);
  /// Null: it is not open.
  Document* find(const std::string& uri);
  /// The text has changed.
  void changed(const std::string& uri);
  void all_changed();
  /// Null: it is not open, or is of no language that is known.
  Analysis* analysis(const std::string& uri);
  [[nodiscard]] const std::map<std::string, Document>& documents() const { return documents_; }

 private:
  std::map<std::string, Document> documents_;
  std::map<std::string, std::unique_ptr<Analysis>> analyses_;
};

}  // namespace cnctrans::lsp
