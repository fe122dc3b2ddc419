#include "base/sum.h"

#include <fmt/format.h>

#include <array>
#include <fstream>

namespace cnctrans {

void Sum::add(std::string_view bytes) {
  for (const char c : bytes) h_ = (h_ ^ static_cast<unsigned char>(c)) * 1099511628211ULL;
}

std::string Sum::text() const {
  return fmt::format("{:016x}", h_);
}

std::string sum_of(std::string_view bytes) {
  Sum sum;
  sum.add(bytes);
  return sum.text();
}

std::string sum_of_file(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) return {};
  Sum sum;
  std::array<char, 1U << 16U> buffer;
  do {
    in.read(buffer.data(), buffer.size());
    sum.add({buffer.data(), static_cast<std::size_t>(in.gcount())});
  } while (in);
  return in.bad() ? std::string() : sum.text();
}

}  // namespace cnctrans
