// Lines of one shape: same letters in the same order, same codes, other numbers. What the reader, the passes and the
// writer made of the first of them under a modal state is kept as a text with gaps; the later ones only fill the gaps.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "frontends/common/frontend.h"

namespace cnctrans::translator {

class LineShapes {
 public:
  /// What the whole stream makes of a line in the state of the moment; nullopt: more than one plain block, a report, or
  /// another state afterwards.
  using Trial = std::function<std::optional<std::string>(std::string_view)>;

  /// `places`: digits after the point that stay as they are written, whatever the number.
  LineShapes(const frontends::FreeNumbers& free, int places);

  /// Writes the line when its shape is known in this state. False: nothing was written.
  bool write(std::string_view line, std::uint32_t state, std::string& out);
  /// After the stream has written `text` for a line that write() refused and that left the state as it was.
  void learn(std::string_view line, std::uint32_t state, std::string_view text, const Trial& trial);

 private:
  static constexpr std::size_t max_key = 32, max_gaps = 12, buckets = 1024;
  /// The shape of a line and where its numbers stand.
  struct Scan {
    std::array<char, max_key> key{};
    std::size_t key_size = 0;
    std::array<std::string_view, max_gaps> gaps;
    std::size_t gap_count = 0;
    std::uint32_t hash = 0;
  };
  struct Piece {
    std::string before;   ///< fixed text before the number
    std::size_t gap = 0;  ///< which number
  };
  struct Shape {
    bool known = false;  ///< else: tried in vain
    std::uint32_t state = 0;
    std::size_t key_size = 0;  ///< 0: the bucket is empty
    std::array<char, max_key> key{};
    std::vector<Piece> pieces;
    std::string after;
    std::size_t fixed_size = 0;
  };

  bool scan(std::string_view line, std::uint32_t state, Scan& s) const;
  bool scan_number(const char*& p, const char* end, frontends::FreeNumber rule) const;
  static bool matches(const Shape& shape, const Scan& s, std::uint32_t state);
  static bool cut(const std::string& text, const std::vector<std::string>& marks, Shape& shape);
  static void fill(const Shape& shape, const Scan& s, std::string& out);

  frontends::FreeNumbers free_;
  int places_;
  Scan scan_;  ///< of the line at hand
  bool scanned_ = false;
  std::vector<Shape> shapes_;
};

}  // namespace cnctrans::translator
