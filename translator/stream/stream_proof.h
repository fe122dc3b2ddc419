// The proof of a translation that went through as a stream: both texts are replayed in step, and nothing is kept.
#pragma once

#include <cstdint>
#include <string>

#include "translator/pipeline.h"

namespace cnctrans::translator {

enum class StreamProved : std::uint8_t {
  yes,      ///< and `verdict` says how
  no,       ///< a difference, or a run that stops: the whole program tells
  unknown,  ///< one of the two is no program for a stream
};
struct StreamVerdict {
  StreamProved proved = StreamProved::unknown;
  verifier::Verdict verdict;
};
/// `written`: where the text of the translation is.
StreamVerdict prove_stream(const std::string& source, const std::string& written, const TranslateOptions& options);

}  // namespace cnctrans::translator
