#pragma once
/// @file
/// Look-up of objects by id in models of tests.

#include <cstddef>
#include <string>
#include <vector>

namespace snapthrough {

/// @brief Position of the object with this id, by linear search; -1: none.
template <typename T>
[[nodiscard]] int index_of(const std::vector<T>& things, const std::string& id) {
  for (std::size_t i = 0; i < things.size(); ++i)
    if (things[i].id == id) return static_cast<int>(i);
  return -1;
}

}  // namespace snapthrough
