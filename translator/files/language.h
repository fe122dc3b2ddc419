// Which language a text is written in: asked of the readers themselves, so that a new dialect is recognised at once.
#pragma once

#include <optional>
#include <string>

#include "base/diagnostics.h"
#include "base/source.h"
#include "frontends/common/frontend.h"
#include "translator/files/registry.h"

namespace cnctrans::translator {

struct Language {
  const Dialect* dialect = nullptr;  ///< null: it can't be told
  std::string why;                   ///< what told it, or why it can't be told
};
/// The dialect whose reader has the least to complain about at the head of the text; the extension of the file counts
/// as well.
Language find_language(const SourceText& source);

/// What to say of a file instead of one message for each of its lines: it is no text, it is a program of another
/// control, or no part program at all. Also, with `beside`, what to say beside the messages where some lines can't be
/// read and another control's reader could read them. `read`: what the reader of `dialect` made of it.
struct WrongLanguage {
  Diagnostic said;
  bool beside = false;
};
std::optional<WrongLanguage> wrong_language(const Dialect& dialect, const SourceText& source, FileId file,
                                            const frontends::ReadStats& read);

}  // namespace cnctrans::translator
