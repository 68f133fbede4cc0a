#pragma once
/// @file
/// Restrictions of a process that computes for untrusted clients.

#include <cstdint>

namespace snapthrough::server {

/// @brief Makes the process end with its parent, gain no rights, write no core dump, be killed first when the
/// machine has no memory left, and run at low priority.
/// @return false when the parent has ended already
[[nodiscard]] bool confine_process(int parent);

/// @brief Hides the process from others of its user, and allows it only to read, write, allocate and exit;
/// the kernel kills it for other system calls (open, connect, start). Does nothing without seccomp filters.
void confine_calls();

/// Memory of this process and its limit.
class MemoryBound {
 public:
  MemoryBound();
  ~MemoryBound();
  MemoryBound(const MemoryBound&) = delete;
  MemoryBound& operator=(const MemoryBound&) = delete;
  MemoryBound(MemoryBound&&) = delete;
  MemoryBound& operator=(MemoryBound&&) = delete;

  /// Limits new memory to `bytes` beyond the current use, and resets the peak.
  void set(std::int64_t bytes);
  void lift();
  /// Returns the largest memory use since set(), minus the use at set(), in bytes.
  [[nodiscard]] std::int64_t peak() const;

 private:
  int pages_;   ///< descriptor of /proc/self/statm; -1: absent
  int status_;  ///< descriptor of /proc/self/status
  int reset_;   ///< descriptor of /proc/self/clear_refs
  std::int64_t resident_before_ = 0;
};

}  // namespace snapthrough::server
