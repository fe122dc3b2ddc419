// Messages: length, and values inside the text (equivalences 3.2).
#include "base/text.h"
#include "ir/edit/rewrite.h"
#include "legaliser/passes.h"

namespace cnctrans::ir::passes {

namespace {

class MessagePass {
 public:
  explicit MessagePass(const LegaliseContext& context) : context_(context) {}

  void one(const Statement& s, Message& m) {
    if (!m.file_line.empty()) return;
    if (!context_.target.message_values) flatten(s, m);
    cut(s, m);
  }

 private:
  /// Values become text: literal ones exactly, the others can't be shown.
  void flatten(const Statement& s, Message& m) {
    std::string text;
    bool changed = false;
    for (const auto& p : m.parts) {
      if (!p) continue;
      if (const auto* str = std::get_if<String>(&p->node)) {
        text += str->text;
      } else if (const auto v = constant_value(p)) {
        text += shortest(*v);
        changed = true;
      } else {
        text += "?";
        changed = true;
        context_.diagnostics.warning("TRN-165", s.line.span,
                                     "a message of the target can't show a value: '?' stands in its place",
                                     "the rest of the text is the same");
      }
    }
    if (changed || m.parts.size() > 1) m.parts = {string_literal(std::move(text))};
  }

  void cut(const Statement& s, Message& m) {
    const std::size_t limit = context_.target.message_length;
    std::size_t used = 0;
    for (auto& p : m.parts) {
      const auto* str = p ? std::get_if<String>(&p->node) : nullptr;
      if (str == nullptr) continue;
      if (used + str->text.size() > limit) {
        context_.diagnostics.warning(
            "TRN-166", s.line.span, "the message is cut to the " + std::to_string(limit) + " characters of the target");
        p = string_literal(str->text.substr(0, limit > used ? limit - used : 0));
        used = limit;
      } else {
        used += str->text.size();
      }
    }
  }

  const LegaliseContext& context_;
};

}  // namespace

void convert_messages(Program& program, const LegaliseContext& context) {
  MessagePass pass(context);
  for (auto& r : program.routines) {
    for_each_statement(r.body, [&pass](Statement& s) {
      if (auto* m = std::get_if<Message>(&s.node)) pass.one(s, *m);
    });
  }
}

}  // namespace cnctrans::ir::passes
