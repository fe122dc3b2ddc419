// The translation of a folded text, unfolded: what the writer made of the lines that stayed tells how the others are
// written.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "backends/common/backend.h"
#include "translator/folding/folded_text.h"
#include "translator/pipeline.h"

namespace cnctrans::translator {

/// Where text goes, piece by piece. False: stop (it can't be written).
using TextSink = std::function<bool(std::string_view)>;

/// How the lines of one shape are written: fixed text with numbers between.
class LineForm {
 public:
  /// From a line and what was written for it, in words of the target. nullopt: its numbers do not explain it.
  static std::optional<LineForm> of(const PlainLine& line, const PlainPlace& before, std::string_view written,
                                    const frontends::PlainWords& target);
  /// Appends the line. `before`: where it begins, for centres that are written as places.
  void write(const PlainLine& line, const PlainPlace& before, std::string& out) const;
  [[nodiscard]] bool uses_place() const { return uses_place_; }

 private:
  struct Piece {
    std::string before;      ///< fixed text
    std::size_t number = 0;  ///< which number of the line
    bool plus = false;       ///< a number without a minus gets a plus
    bool anew = false;       ///< the shortest way to write it
    bool turn = false;       ///< what is left of a full turn
    std::int8_t axis = -1;   ///< the place of this axis is added
  };
  static std::optional<Piece> find(const PlainLine& line, const PlainPlace& before, char letter, bool of_centre,
                                   std::string_view token);
  std::vector<Piece> pieces_;
  std::string after_;
  std::size_t fixed_size_ = 0;
  bool uses_place_ = false;
};

/// Makes what numbers the blocks of one output; null where nothing does.
using MakeBlockNumbers = std::function<std::unique_ptr<backends::BlockNumbers>()>;

class WrittenLines;

class Unfolding {
 public:
  /// `words` of the source, `target` of the outputs.
  Unfolding(std::string path, const frontends::PlainWords& words, const FoldedText& folded,
            const frontends::PlainWords& target, MakeBlockNumbers numbers);

  /// Holds every line that stayed against what was written for it, in all outputs. False: `stays` says which lines
  /// have to stay besides; when it is as before, no folding helps.
  bool learn(const std::vector<OutputText>& outputs, FileId file, FoldedText::Stays& stays);
  /// The output with all its lines, made in parts of so many bytes of the file and more. False: the sink, or the file
  /// is not what it was.
  bool write(std::size_t output, std::string_view bytes, const TextSink& sink, std::size_t part = 1U << 19U) const;

 private:
  /// Behind this byte of an output the lines of a gap belong, in place of so many bytes.
  struct Place {
    std::size_t at = 0, size = 0;
    std::size_t gap = 0;
  };

  std::string path_;
  frontends::PlainWords words_, target_;
  const FoldedText& folded_;
  MakeBlockNumbers numbers_;
  PlainLine line_;
  /// A line that stayed, and what was written for it.
  struct Sample {
    std::string text, written;
    std::int8_t motion = motion_unknown;
    PlainPlace place;
  };
  struct Form {
    std::optional<LineForm> form;
    std::vector<Sample> samples;
  };
  struct Part;
  /// The output where the lines of a gap belong, and where in it; nullopt: what stands about it was written otherwise.
  [[nodiscard]] std::optional<std::pair<std::uint32_t, Place>> place_of(std::size_t gap,
                                                                        const WrittenLines& written) const;
  [[nodiscard]] std::vector<Part> parts_of(std::size_t output, std::size_t least) const;
  [[nodiscard]] std::optional<std::string> lines_of(std::size_t output, std::string_view bytes, const Part& part) const;

  [[nodiscard]] bool explains(const LineForm& form, const Sample& sample);
  [[nodiscard]] bool take(Form& form, Sample sample);
  std::vector<Form> forms_;  ///< by shape
  ShapeIndex index_;
  std::vector<std::vector<Place>> places_;  ///< by output
  bool uses_places_ = false;                ///< what a line becomes may go by where it begins
};

/// What translating a file by its folded text came to.
struct FoldedTranslation {
  TranslateResult result;  ///< its outputs are folded
  FoldedText text;
  std::unique_ptr<Unfolding> unfolding;
};
/// A smaller file is read as it is.
inline constexpr std::uintmax_t least_folded = 64 * 1024;
/// nullptr: the file is not one to be folded, or it takes the whole text.
std::unique_ptr<FoldedTranslation> translate_folded(const std::string& path, const TranslateOptions& options,
                                                    std::uintmax_t least_size = least_folded);

/// Translates a file, a long one by its folded text where that can be. The outputs are whole; those of a folded text
/// have no map of lines.
TranslateResult translate_file(const std::string& path, const TranslateOptions& options);

}  // namespace cnctrans::translator
