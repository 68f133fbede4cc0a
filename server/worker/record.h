#pragma once
/// @file
/// Values as bytes, between the service and its runners: two processes of one program, so that neither byte
/// order nor versions matter.

#include <cstring>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <vector>

#include "api/names.h"
#include "api/point_outcome.h"
#include "api/result_fields.h"
#include "server/jobs/job.h"
#include "server/worker/runner.h"
#include "solver/solve.h"

namespace snapthrough::server {

/// The members of a type that are sent: all of them. Of the types in api/result_fields.h those that are
/// kSent.
template <class T>
inline constexpr auto kMembers = nullptr;

template <>
inline constexpr auto kMembers<NamedSeries> = std::tuple{&NamedSeries::id, &NamedSeries::values};
template <>
inline constexpr auto kMembers<Progress> =
    std::tuple{&Progress::branch, &Progress::step, &Progress::load_factor, &Progress::negative_eigenvalues};
template <>
inline constexpr auto kMembers<NamedValue> = std::tuple{&NamedValue::id, &NamedValue::value};
template <>
inline constexpr auto kMembers<TracedPoint> = std::tuple{&TracedPoint::branch,
                                                         &TracedPoint::step,
                                                         &TracedPoint::load_factor,
                                                         &TracedPoint::arc_length,
                                                         &TracedPoint::negative_eigenvalues,
                                                         &TracedPoint::monitors};
template <>
inline constexpr auto kMembers<JobResult> =
    std::tuple{&JobResult::document, &JobResult::wall_time_s, &JobResult::summary, &JobResult::branches,
               &JobResult::critical_points};
template <>
inline constexpr auto kMembers<JobFailure> =
    std::tuple{&JobFailure::code, &JobFailure::detail, &JobFailure::reached};
template <>
inline constexpr auto kMembers<StoredPath> = std::tuple{&StoredPath::branches, &StoredPath::critical_points};
template <>
inline constexpr auto kMembers<JobRun> =
    std::tuple{&JobRun::result, &JobRun::failure, &JobRun::reached, &JobRun::usage};
template <>
inline constexpr auto kMembers<WorkUsage> =
    std::tuple{&WorkUsage::cpu_us, &WorkUsage::peak_bytes, &WorkUsage::factorizations};
template <>
inline constexpr auto kMembers<api::PointOutcome> =
    std::tuple{&api::PointOutcome::outputs, &api::PointOutcome::code, &api::PointOutcome::detail};

template <class... Types>
inline constexpr bool kAllAreSent =
    ((std::tuple_size_v<decltype(kMembers<Types>)> == api::member_count<Types>()) && ...);
static_assert(kAllAreSent<NamedSeries, Progress, NamedValue, TracedPoint, JobResult, JobFailure, StoredPath,
                          JobRun, WorkUsage, api::PointOutcome>,
              "a member is missing in kMembers");

/// Calls visit(pointer to member) for each member of T that is sent.
template <class T, class Visit>
void for_each_sent(const Visit& visit) {
  if constexpr (api::kHasFields<T>) {
    api::for_each_field<T>([&](const auto& field) {
      if constexpr (api::FieldOf<decltype(field)>::is(api::kSent)) visit(field.get);
    });
  } else {
    std::apply([&](auto... member) { (visit(member), ...); }, kMembers<T>);
  }
}

template <class T>
inline constexpr bool kIsPlain = std::is_arithmetic_v<T> || std::is_enum_v<T>;

/// Appends values to a text.
class RecordWriter {
 public:
  explicit RecordWriter(std::string& out) : out_(out) {}

  template <class T>
  requires kIsPlain<T>
  void put(T value) { out_.append(reinterpret_cast<const char*>(&value), sizeof value); }
  void put(std::string_view text) {
    put(text.size());
    out_.append(text);
  }
  void put(const std::string& text) { put(std::string_view(text)); }
  template <class T>
  void put(const std::optional<T>& value) {
    put(value.has_value());
    if (value) put(*value);
  }
  template <class T>
  void put(const std::vector<T>& values) {
    put(values.size());
    if constexpr (kIsPlain<T>) {
      out_.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
    } else {
      for (const T& value : values) put(value);
    }
  }
  template <class T>
  requires(!kIsPlain<T> && !std::is_convertible_v<const T&, std::string_view>) void put(const T& value) {
    for_each_sent<T>([&](auto member) { put(value.*member); });
  }

 private:
  std::string& out_;
};

/// @brief Takes values from a text, in the order that they were put.
/// @throws std::runtime_error past its end, and at bytes that are no value of their type
class RecordReader {
 public:
  explicit RecordReader(std::string_view bytes) : bytes_(bytes) {}

  [[nodiscard]] bool at_end() const { return bytes_.empty(); }

  template <class T>
  requires kIsPlain<T>
  void get(T& value) {
    const std::string_view bytes = take(sizeof value);
    if constexpr (std::is_same_v<T, bool>) {
      require(bytes[0] == 0 || bytes[0] == 1);
    }
    if constexpr (std::is_enum_v<T>) {
      std::underlying_type_t<T> number{};
      std::memcpy(&number, bytes.data(), sizeof number);
      require(number >= 0 &&
              number <= static_cast<std::underlying_type_t<T>>(api::last_of(api::kNamesOf<T>)));
    }
    std::memcpy(&value, bytes.data(), sizeof value);
  }
  void get(std::string& text) {
    std::size_t size = 0;
    get(size);
    text = take(size);
  }
  template <class T>
  void get(std::optional<T>& value) {
    bool is_there = false;
    get(is_there);
    if (is_there) get(value.emplace());
  }
  template <class T>
  void get(std::vector<T>& values) {
    std::size_t size = 0;
    get(size);
    if constexpr (kIsPlain<T>) {
      static_assert(std::is_arithmetic_v<T>, "enumerations are read one by one");
      require(size <= bytes_.size() / sizeof(T));
      const std::string_view block = take(size * sizeof(T));
      values.resize(size);
      if (size > 0) std::memcpy(values.data(), block.data(), block.size());
    } else {
      for (std::size_t i = 0; i < size; ++i) get(values.emplace_back());
    }
  }
  template <class T>
  requires(!kIsPlain<T>) void get(T& value) {
    for_each_sent<T>([&](auto member) { get(value.*member); });
  }
  template <class T>
  [[nodiscard]] T get() {
    T value{};
    get(value);
    return value;
  }

 private:
  static void require(bool holds) {
    if (!holds) throw std::runtime_error("the bytes are no such record");
  }
  std::string_view take(std::size_t size) {
    require(size <= bytes_.size());
    const std::string_view out = bytes_.substr(0, size);
    bytes_.remove_prefix(size);
    return out;
  }

  std::string_view bytes_;
};

}  // namespace snapthrough::server
