#include "tests/splice/reduce.h"

#include <algorithm>
#include <cctype>

namespace cnctrans::splice {

namespace {

/// Leaves out runs of items, half of them first, then ever fewer. True: something went.
template <class Item, class Shows>
bool cut(std::vector<Item>& items, const Shows& shows) {
  bool any = false;
  for (std::size_t size = std::max<std::size_t>(items.size() / 2, 1);; size /= 2) {
    for (std::size_t at = 0; at < items.size();) {
      std::vector<Item> fewer = items;
      const std::size_t end = std::min(at + size, fewer.size());
      fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(at), fewer.begin() + static_cast<std::ptrdiff_t>(end));
      if (shows(fewer)) {
        items = std::move(fewer);
        any = true;
      } else {
        at += size;
      }
    }
    if (size <= 1) return any;
  }
}

/// Words and the space between them; what stands in brackets goes or stays as one, and parameter by parameter.
std::vector<std::string> words_of(const std::string& line) {
  std::vector<std::string> out(1);
  const auto kind = [](char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; };
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    const bool begins =
        i > 0 && ((kind(c) && !kind(line[i - 1])) || c == ' ' || c == '/' || c == '(' || c == ',' || c == ';');
    if (begins && !(c != ' ' && line[i - 1] == '=')) out.emplace_back();
    out.back() += c;
  }
  return out;
}

std::string text_of(const std::vector<std::string>& words) {
  std::string out;
  for (const auto& w : words) out += w;
  return out;
}

}  // namespace

Program reduced(Program p, const std::function<bool(const Program&)>& shows, std::size_t tries) {
  const auto asked = [&](const Program& q) { return tries > 0 && (--tries, shows(q)); };
  const auto with_lines = [&](const std::vector<std::string>& lines) {
    Program q = p;
    q.lines = lines;
    return asked(q);
  };
  for (bool more = true; more && tries > 0;) {
    more = cut(p.lines, with_lines);
    for (std::size_t i = 0; i < p.lines.size(); ++i) {
      auto words = words_of(p.lines[i]);
      if (words.size() < 2) continue;
      const bool fewer = cut(words, [&](const std::vector<std::string>& kept) {
        Program q = p;
        q.lines[i] = text_of(kept);
        return asked(q);
      });
      if (fewer) p.lines[i] = text_of(words);
      more = more || fewer;
    }
  }
  return p;
}

}  // namespace cnctrans::splice
