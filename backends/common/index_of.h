// Enumerators and codes as places in a table.
#pragma once

#include <cstddef>

namespace cnctrans::backends {

template <class T>
constexpr std::size_t index_of(T value) {
  return static_cast<std::size_t>(value);
}

}  // namespace cnctrans::backends
