#pragma once
/// @file
/// Typed reading of one document with collection of all findings: values with their pointers, and objects
/// whose fields are read one by one. Does not include the full JSON header, so that readers compile fast.

#include <array>
#include <cstddef>
#include <limits>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_set>
#include <utility>
#include <vector>

#include "api/names.h"
#include "solver/check/check.h"
#include "solver/model/pointer.h"

namespace snapthrough::api {

/// Findings about a document, the first kMaxFindings (api/api.h) of them: the memory that mistakes take is
/// bounded. Unreadable places are recorded, so that later findings that only follow from them can be left
/// out.
class Report {
 public:
  /// Adds a finding about a value that could not be read.
  void add(const std::string& pointer, std::string_view code, std::string detail);
  /// Adds a finding about an unknown field; `meant` is the pointer of the field probably meant, or "".
  void add_unknown_field(const std::string& pointer, const std::string& meant, std::string detail);

  /// Returns whether a place, a part of it, or a container of it is unreadable.
  [[nodiscard]] bool covers(const std::string& pointer) const;

  /// Records an unreadable place without a finding.
  void mark_unreadable(const std::string& pointer);

  [[nodiscard]] const std::vector<Finding>& findings() const { return findings_; }
  /// Returns whether there are more findings than findings() has.
  [[nodiscard]] bool is_cut() const { return left_out_ > 0; }
  /// Returns findings(), and if there are more, a finding "too_many_findings" with their number.
  [[nodiscard]] std::vector<Finding> listed() const;

 private:
  void add_finding(Finding finding);

  std::vector<Finding> findings_;
  std::size_t left_out_ = 0;
  std::unordered_set<std::string> unreadable_;
  std::unordered_set<std::string> above_unreadable_;
};

/// A value of a document with its pointer. Refers to document and report, which must outlive the Value.
class Value {
 public:
  Value(const nlohmann::json& json, PointerPath path, Report& report)
      : json_(&json), path_(std::move(path)), report_(&report) {}

  [[nodiscard]] const nlohmann::json& json() const { return *json_; }
  [[nodiscard]] std::string pointer() const { return path_.text(); }
  [[nodiscard]] Report& document_report() const { return *report_; }

  [[nodiscard]] bool is_object() const;
  [[nodiscard]] bool is_array() const;
  [[nodiscard]] bool is_string() const;
  [[nodiscard]] bool is_number() const;
  /// Returns the number of elements of an array or of members of an object.
  [[nodiscard]] std::size_t size() const;
  /// Returns an element. @pre is_array() and i < size()
  [[nodiscard]] Value item(std::size_t i) const;
  /// Returns a member; nullopt when the object lacks it. @pre is_object()
  [[nodiscard]] std::optional<Value> member(std::string_view key) const;
  /// Returns the keys in the order of the document. @pre is_object()
  [[nodiscard]] std::vector<std::string> keys() const;

  void report(std::string_view code, std::string detail) const {
    report_->add(pointer(), code, std::move(detail));
  }
  /// Reports that the value does not have the type `expected`, such as "a number".
  void report_type(std::string_view expected) const;

 private:
  const nlohmann::json* json_;
  PointerPath path_;
  Report* report_;
};

// Each read() sets `out` or reports; after a report a number is NaN and another type keeps its value.
void read(const Value& value, std::string& out);
void read(const Value& value, double& out);
/// Reads an integer in the range of int, in any JSON form (1, 1.0).
void read(const Value& value, int& out);
void read(const Value& value, bool& out);
void read(const Value& value, std::array<double, 2>& out);

/// Sets `out` to the value of an unread field: NaN for numbers, no change for other types.
template <class T>
void set_unread(T&) {}
inline void set_unread(double& out) { out = std::numeric_limits<double>::quiet_NaN(); }
inline void set_unread(std::array<double, 2>& out) { out.fill(std::numeric_limits<double>::quiet_NaN()); }

template <class T>
void read(const Value& value, std::optional<T>& out) {
  read(value, out.emplace());
}

/// Reads an array of any length; unreadable elements keep their positions.
template <class T>
void read(const Value& value, std::vector<T>& out) {
  if (!value.is_array()) {
    value.report_type("an array");
    return;
  }
  out.assign(value.size(), T{});
  for (std::size_t i = 0; i < out.size(); ++i) {
    read(value.item(i), out[i]);
  }
}

/// @return index of the string in `names`; nullopt after a report that suggests the nearest name
std::optional<std::size_t> read_choice(const Value& value, std::span<const std::string_view> names);

template <class E, std::size_t n>
void read_named(const Value& value, const Named<E> (&table)[n], E& out) {
  std::array<std::string_view, n> names;
  for (std::size_t i = 0; i < n; ++i) {
    names[i] = table[i].name;
  }
  if (const auto choice = read_choice(value, names)) {
    out = table[*choice].value;
  }
}

/// @brief An object whose fields are read one by one; finish() then reports all other fields as unknown.
///
/// A value that is not an object is reported once; all its fields then count as absent.
class Object {
 public:
  explicit Object(const Value& value);

  /// Reads a field; reports it when absent.
  template <class T>
  void required(std::string_view key, T& out) {
    set_unread(out);
    if (const auto value = find_required(key)) {
      read(*value, out);
    }
  }
  /// Reads a field if present, else `out` keeps its default. Returns whether the field is present.
  template <class T>
  bool optional(std::string_view key, T& out) {
    const auto value = find(key);
    if (value) {
      read(*value, out);
    }
    return value.has_value();
  }

  [[nodiscard]] std::optional<Value> find(std::string_view key);
  [[nodiscard]] std::optional<Value> find_required(std::string_view key);
  [[nodiscard]] bool is_readable() const { return readable_; }
  [[nodiscard]] const Value& value() const { return value_; }

  /// Reports all fields that were not read. Call it last, and only if the set of known fields is complete.
  void finish() const;

 private:
  Value value_;
  bool readable_;
  std::vector<std::string_view> known_;
};

/// @brief Reads an object whose field "type" selects a form; the form's function reads the other fields.
///
/// For an unknown type, the whole object counts as unreadable and `out` keeps its value.
template <class T, std::size_t n>
void read_tagged(const Value& value, const Named<T (*)(Object&)> (&forms)[n], T& out) {
  Object in(value);
  T (*form)(Object&) = nullptr;
  if (const auto type = in.find_required("type")) {
    read_named(*type, forms, form);
  }
  if (form == nullptr) {
    value.document_report().mark_unreadable(value.pointer());
    return;
  }
  out = form(in);
  in.finish();
}

/// @brief Returns the name probably meant: one that begins with the written words, else the nearest at an
/// edit distance of at most two and less than half the written length; "" when there is none.
[[nodiscard]] std::string_view nearest_name(std::string_view written,
                                            std::span<const std::string_view> names);

}  // namespace snapthrough::api
