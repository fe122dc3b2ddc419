#include "base/nearest.h"

#include <algorithm>
#include <numeric>

#include "base/text.h"

namespace cnctrans {

namespace {

/// Letters to put in, take out, replace, or exchange with their neighbour until `a` is `b`.
std::size_t letters_apart(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before, row(b.size() + 1), next(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    next[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      next[j] = std::min({row[j] + 1, next[j - 1] + 1, row[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      const bool exchanged = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (exchanged) next[j] = std::min(next[j], before[j - 2] + 1);
    }
    before = row;
    row.swap(next);
  }
  return row[b.size()];
}

}  // namespace

std::string nearest(std::string_view word, const std::vector<std::string>& words) {
  const std::string wanted = to_upper_ascii(word);
  std::string found;
  std::size_t least = wanted.size() / 3 + 1;
  for (const auto& w : words) {
    const std::size_t apart = letters_apart(wanted, to_upper_ascii(w));
    if (apart >= least) continue;
    least = apart;
    found = w;
  }
  return found;
}

std::string did_you_mean(std::string_view word, const std::vector<std::string>& words) {
  const std::string found = nearest(word, words);
  return found.empty() ? std::string() : "; did you mean " + found + "?";
}

}  // namespace cnctrans
