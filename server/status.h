#pragma once
/// @file
/// Status values of input and output, which callers must not ignore.

#include <optional>
#include <string>
#include <utility>

namespace snapthrough::server {

/// Kind of failure of a store, a socket or a file. Only `ok` means success.
enum class StatusCode {
  ok,
  conflict,       ///< the job is no longer in the expected state or attempt
  unavailable,    ///< may succeed later: busy, disk full, address in use
  stopping,       ///< the service is about to end and accepts nothing new
  waiting_quota,  ///< the owner's waiting work reaches its quota
  rate_quota,     ///< the owner's submissions reach their quota for the moment
  storage_quota,  ///< the owner's stored documents reach their quota
  unsupported,    ///< written by a newer version, or by another program
  io_error,       ///< any other failure
};

/// Outcome of an operation without a value. Copyable, immutable after construction.
class [[nodiscard]] Status {
 public:
  Status() = default;  ///< the status `ok`
  Status(StatusCode code, std::string message) : code_(code), message_(std::move(message)) {}

  [[nodiscard]] bool ok() const { return code_ == StatusCode::ok; }
  [[nodiscard]] StatusCode code() const { return code_; }
  [[nodiscard]] const std::string& message() const { return message_; }

 private:
  StatusCode code_ = StatusCode::ok;
  std::string message_;
};

/// A value, or the status of the failure.
template <class T>
class [[nodiscard]] StatusOr {
 public:
  // Implicit conversions allow `return value;` and `return Status{...};`.
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
