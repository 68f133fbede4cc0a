#pragma once
/// @file
/// Look-up of objects by id.

#include <cstddef>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace snapthrough {

/// @brief Hash index of ids, with which loops over a model take linear time.
///
/// @pre the ids outlive this object
class IdIndex {
 public:
  template <class T>
  explicit IdIndex(const std::vector<T>& things) {
    positions_.reserve(things.size());
    for (std::size_t i = 0; i < things.size(); ++i) positions_.emplace(things[i].id, static_cast<int>(i));
  }
  /// Position of the object with this id; -1: none.
  [[nodiscard]] int of(std::string_view id) const {
    const auto found = positions_.find(id);
    return found == positions_.end() ? -1 : found->second;
  }

 private:
  std::unordered_map<std::string_view, int> positions_;
};

}  // namespace snapthrough
