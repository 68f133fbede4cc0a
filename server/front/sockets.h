#pragma once
/// @file
/// Small owners and helpers for descriptors.

#include <cstdint>
#include <string>
#include <utility>

#include "server/status.h"

namespace snapthrough::server::http {

/// Owns a descriptor.
class Descriptor {
 public:
  explicit Descriptor(int value = -1) : value_(value) {}
  ~Descriptor() { reset(); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  Descriptor(Descriptor&& other) noexcept;
  Descriptor& operator=(Descriptor&& other) noexcept;

  [[nodiscard]] int get() const { return value_; }
  void reset();
  /// Leaves the descriptor to the caller.
  int release() { return std::exchange(value_, -1); }

 private:
  int value_;
};

/// A socket that listens; `unavailable` when the address can't be bound.
[[nodiscard]] StatusOr<Descriptor> listen_on(const std::string& host, int port);
/// The port of a bound socket.
[[nodiscard]] int port_of(int socket);
/// The next client, without waiting: -1 when there is none (errno says why). Sets its address.
[[nodiscard]] int accept_from(int listener, std::string& remote);

/// An event counter (eventfd): add() makes it readable.
class Counter {
 public:
  /// @param one_by_one each take() takes one of what was added
  explicit Counter(bool one_by_one);
  [[nodiscard]] int get() const { return descriptor_.get(); }
  void add() const;
  void take() const;

 private:
  Descriptor descriptor_;
};

/// Lets the process open as many descriptors as it is allowed to.
void raise_descriptor_limit();

}  // namespace snapthrough::server::http
