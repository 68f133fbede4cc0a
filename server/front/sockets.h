#pragma once
/// @file
/// Owners of file descriptors, and socket functions.

#include <cstdint>
#include <string>
#include <utility>

#include "server/status.h"

namespace snapthrough::server::http {

/// Owns a file descriptor.
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
  /// Returns the descriptor and gives up its ownership.
  int release() { return std::exchange(value_, -1); }

 private:
  int value_;
};

/// Returns a listening socket; `unavailable` when the address cannot be bound.
[[nodiscard]] StatusOr<Descriptor> listen_on(const std::string& host, int port);
/// Returns the port of a bound socket.
[[nodiscard]] int port_of(int socket);
/// Accepts a client without waiting, and sets its address; -1 when none waits (errno has the reason).
[[nodiscard]] int accept_from(int listener, std::string& remote);

/// An event counter (eventfd); add() makes it readable.
class Counter {
 public:
  /// @param one_by_one true: take() subtracts one; false: take() resets to zero
  explicit Counter(bool one_by_one);
  [[nodiscard]] int get() const { return descriptor_.get(); }
  void add() const;
  void take() const;

 private:
  Descriptor descriptor_;
};

/// Raises the process' limit of open descriptors to the hard limit.
void raise_descriptor_limit();

}  // namespace snapthrough::server::http
