#pragma once
/// @file
/// How input and output report trouble: by value, never to be ignored.

#include <optional>
#include <string>
#include <utility>

namespace snapthrough::server {

/// What went wrong with a store, a socket or a file. `ok` is the only success.
enum class StatusCode {
  ok,
  conflict,       ///< the job is no longer in the state, or the attempt, that the caller holds
  unavailable,    ///< it may work later: busy, disk full, address in use
  stopping,       ///< nothing new is taken: the service is about to end
  waiting_quota,  ///< the owner has as much waiting as it may
  rate_quota,     ///< the owner has handed in as much as it may at the moment
  storage_quota,  ///< the owner keeps as much as it may
  unsupported,    ///< written by a newer version, or by something else
  io_error,       ///< everything else
};

/// Outcome of an operation without a value. Copyable, immutable after construction.
class [[nodiscard]] Status {
 public:
  Status() = default;  ///< ok
  Status(StatusCode code, std::string message) : code_(code), message_(std::move(message)) {}

  [[nodiscard]] bool ok() const { return code_ == StatusCode::ok; }
  [[nodiscard]] StatusCode code() const { return code_; }
  [[nodiscard]] const std::string& message() const { return message_; }

 private:
  StatusCode code_ = StatusCode::ok;
  std::string message_;
};

/// A value or the status that says why there is none.
template <class T>
class [[nodiscard]] StatusOr {
 public:
  // Both conversions are wanted: `return value;` and `return Status{...};`.
  StatusOr(T value) : value_(std::move(value)) {}          // NOLINT(google-explicit-constructor)
  StatusOr(Status status) : status_(std::move(status)) {}  // NOLINT(google-explicit-constructor)

  [[nodiscard]] bool ok() const { return value_.has_value(); }
  [[nodiscard]] const Status& status() const { return status_; }
  /// @pre ok()
  [[nodiscard]] const T& value() const& { return value_.value(); }
  [[nodiscard]] T&& value() && { return std::move(value_).value(); }
  [[nodiscard]] const T& operator*() const& { return *value_; }
  [[nodiscard]] T&& operator*() && { return *std::move(value_); }
  [[nodiscard]] const T* operator->() const { return &*value_; }

 private:
  std::optional<T> value_;
  Status status_;
};

}  // namespace snapthrough::server
