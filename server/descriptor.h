#pragma once
/// @file
/// Owner of a file descriptor.

#include <unistd.h>

#include <utility>

namespace snapthrough::server {

/// Owns a descriptor and closes it. -1: none.
class Descriptor {
 public:
  explicit Descriptor(int value = -1) : value_(value) {}
  ~Descriptor() { reset(); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  Descriptor(Descriptor&& other) noexcept : value_(other.release()) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(value_, other.value_);
    return *this;
  }

  [[nodiscard]] int get() const { return value_; }
  void reset() {
    if (value_ >= 0) {
      ::close(std::exchange(value_, -1));
    }
  }
  /// Leaves the descriptor to the caller.
  int release() { return std::exchange(value_, -1); }

 private:
  int value_;
};

}  // namespace snapthrough::server
