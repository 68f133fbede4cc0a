#pragma once
/// @file
/// What a process gives up before it computes what somebody else asked for.

#include <cstdint>

namespace snapthrough::server {

/// @brief Ends with its parent, gains no rights, leaves no core dump, is the first to go when the machine has
/// no memory left, and yields the processor to others.
/// @return false when the parent is gone already
[[nodiscard]] bool confine_process(int parent);

/// @brief From now on nobody of its user can look into the process, and it can read, write, take memory and
/// end; opening, connecting or starting anything ends it. Does nothing where the kernel has no filters.
void confine_calls();

/// Memory of this process and its bound.
class MemoryBound {
 public:
  MemoryBound();
  ~MemoryBound();
  MemoryBound(const MemoryBound&) = delete;
  MemoryBound& operator=(const MemoryBound&) = delete;
  MemoryBound(MemoryBound&&) = delete;
  MemoryBound& operator=(MemoryBound&&) = delete;

  /// From now on no more than so many bytes beyond what is in use. The peak begins anew.
  void set(std::int64_t bytes);
  void lift();
  /// The most memory in use since set(), beyond what was in use then, bytes.
  [[nodiscard]] std::int64_t peak() const;

 private:
  int pages_;   ///< /proc/self/statm; -1: not there
  int status_;  ///< /proc/self/status
  int reset_;   ///< /proc/self/clear_refs
  std::int64_t resident_before_ = 0;
};

}  // namespace snapthrough::server
