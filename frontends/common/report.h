// Faults of the line being lowered: where, with which code, and whether the line is lost because of them.
#pragma once

#include <string>
#include <string_view>
#include <utility>

#include "base/diagnostics.h"
#include "base/span.h"

namespace cnctrans::frontends {

class Report {
 public:
  explicit Report(Diagnostics& sink) : sink_(sink) {}

  void start(const Span& line) {
    line_ = line;
    refused_ = false;
    harmless_ = false;
    feature_ = {};
  }
  /// The line can't be carried: it becomes Opaque. `feature` is a key of the missing-features registry, or
  /// "text.unread".
  void refuse(std::string_view code, WordPos pos, std::string message, std::string hint = {},
              std::string_view feature = "text.unread") {
    sink_.error(code, word_span(line_, pos), std::move(message), std::move(hint));
    lose(feature);
  }
  /// The line is read and means something that is not carried: it becomes Opaque with the key `feature` of the
  /// missing-features registry. A run stops at it and a translation refuses it; the reader only warns.
  void keep(std::string_view code, WordPos pos, std::string message, std::string_view feature, std::string hint = {}) {
    sink_.warning(code, word_span(line_, pos), std::move(message), std::move(hint));
    lose(feature);
  }
  /// The line can't be carried because something before it was refused: that has been said, and nothing more is.
  void lose(std::string_view feature) {
    if (!refused_) feature_ = feature;
    refused_ = true;
    harmless_ = false;
  }
  /// The line is carried as text; it moves nothing and changes no state.
  void carry(std::string_view code, WordPos pos, std::string message, std::string_view feature,
             Severity severity = Severity::note) {
    sink_.add({std::string(code), severity, word_span(line_, pos), std::move(message), {}});
    if (refused_) return;
    refused_ = harmless_ = true;
    feature_ = feature;
  }
  void warn(std::string_view code, WordPos pos, std::string message, std::string hint = {}) {
    sink_.warning(code, word_span(line_, pos), std::move(message), std::move(hint));
  }
  void note(std::string_view code, WordPos pos, std::string message) {
    sink_.note(code, word_span(line_, pos), std::move(message));
  }

  [[nodiscard]] bool refused() const { return refused_; }
  [[nodiscard]] bool harmless() const { return harmless_; }
  [[nodiscard]] std::string_view feature() const { return feature_; }
  [[nodiscard]] const Span& line() const { return line_; }

 private:
  Diagnostics& sink_;
  Span line_;
  std::string_view feature_;
  bool refused_ = false;
  bool harmless_ = false;
};

}  // namespace cnctrans::frontends
