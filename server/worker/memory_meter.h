#pragma once
/// @file
/// A bound on the memory of one analysis.

#include <cstdint>

namespace snapthrough::server {

/// @brief While it exists, what the calling thread allocates (new, malloc and their relatives) is counted,
/// and what would go beyond a limit is refused: as std::bad_alloc from new, as a null pointer from malloc,
/// which Eigen turns into std::bad_alloc.
///
/// Memory counts by its real size in the heap. What the thread frees is taken off again, also when it was
/// allocated before; what other threads do is their own. An analysis works on one thread, so its limit
/// concerns it alone. Programs have to link snapthrough_server as CMake does, which puts the counting in
/// front of the allocator (see server/CMakeLists.txt).
class MemoryMeter {
 public:
  /// @param limit bytes, > 0. A meter inside another one counts for itself only.
  explicit MemoryMeter(std::int64_t limit);
  ~MemoryMeter();
  MemoryMeter(const MemoryMeter&) = delete;
  MemoryMeter& operator=(const MemoryMeter&) = delete;
  MemoryMeter(MemoryMeter&&) = delete;
  MemoryMeter& operator=(MemoryMeter&&) = delete;

  [[nodiscard]] std::int64_t limit() const { return limit_; }
  /// The most that was in use at a time, bytes.
  [[nodiscard]] std::int64_t peak() const { return peak_; }
  /// Whether something was refused.
  [[nodiscard]] bool exceeded() const { return exceeded_; }

  /// While it exists the thread's allocations are not counted: for what belongs to the service.
  class Pause {
   public:
    Pause();
    ~Pause();
    Pause(const Pause&) = delete;
    Pause& operator=(const Pause&) = delete;
    Pause(Pause&&) = delete;
    Pause& operator=(Pause&&) = delete;

   private:
    MemoryMeter* paused_;
  };

  // For the allocator. Neither allocates.
  /// The meter of the calling thread; null when nothing is counted.
  static MemoryMeter*& current();
  /// Whether so much more may be allocated; remembered when not.
  [[nodiscard]] bool admits(std::size_t bytes);
  void add(std::int64_t bytes);

 private:
  const std::int64_t limit_;
  std::int64_t used_ = 0;
  std::int64_t peak_ = 0;
  bool exceeded_ = false;
  MemoryMeter* outer_;
};

}  // namespace snapthrough::server
