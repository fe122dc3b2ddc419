#include "translator/folding/file_part.h"

namespace cnctrans::translator {

bool FilePart::open(const std::string& path) {
  return file_.open(path, nullptr);
}

std::string_view FilePart::read(std::uint64_t from, std::uint64_t to) {
  const auto size = static_cast<std::size_t>(to - from);
  if (buffer_.size() < size) buffer_.resize(size);
  return {buffer_.data(), file_.read_at(from, buffer_.data(), size)};
}

}  // namespace cnctrans::translator
