#pragma once
/// @file
/// Typed reading of one document with everything that is wrong with it: values that know where they stand,
/// and objects whose fields are read one by one. No full JSON header here, so that readers compile fast.

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

/// What is wrong with a document so far. Places that could not be read are remembered, so that findings of
/// later checks that only follow from them can be left out.
class Report {
 public:
  /// A mistake at a value that could not be read.
  void add(const std::string& pointer, std::string_view code, std::string detail);
  /// A field that nobody knows; `meant` (may be empty) is the pointer of the field that was probably meant.
  void add_unknown_field(const std::string& pointer, const std::string& meant, std::string detail);

  /// Whether the place, something in it, or something that it is in could not be read.
  [[nodiscard]] bool covers(const std::string& pointer) const;

  /// Nothing can be said about what is in here, although the mistake itself is reported elsewhere.
  void mark_unreadable(const std::string& pointer);

  [[nodiscard]] const std::vector<Finding>& findings() const { return findings_; }

 private:
  std::vector<Finding> findings_;
  std::unordered_set<std::string> unreadable_;
  std::unordered_set<std::string> above_unreadable_;
};

/// A value of the document and its pointer. Refers to the document and the report, which must outlive it.
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
  /// Elements of an array, members of an object.
  [[nodiscard]] std::size_t size() const;
  /// @pre is_array() and i < size()
  [[nodiscard]] Value item(std::size_t i) const;
  /// @pre is_object(). Empty when there is no such member.
  [[nodiscard]] std::optional<Value> member(std::string_view key) const;
  /// @pre is_object(). In the document's key order.
  [[nodiscard]] std::vector<std::string> keys() const;

  void report(std::string_view code, std::string detail) const {
    report_->add(pointer(), code, std::move(detail));
  }
  /// Reports that `expected` ("a number", ...) was wanted here.
  void report_type(std::string_view expected) const;

 private:
  const nlohmann::json* json_;
  PointerPath path_;
  Report* report_;
};

// Each read() sets `out` or reports; then a number is NaN and anything else stays as it was.
void read(const Value& value, std::string& out);
void read(const Value& value, double& out);
/// Integers of any JSON spelling (1, 1.0) that an int can hold.
void read(const Value& value, int& out);
void read(const Value& value, bool& out);
void read(const Value& value, std::array<double, 2>& out);

/// What a field holds until it has been read: a number that is not there is NaN.
template <class T>
void set_unread(T&) {}
inline void set_unread(double& out) { out = std::numeric_limits<double>::quiet_NaN(); }
inline void set_unread(std::array<double, 2>& out) { out.fill(std::numeric_limits<double>::quiet_NaN()); }

template <class T>
void read(const Value& value, std::optional<T>& out) {
  read(value, out.emplace());
}

/// An array of any length; every element gets its place, readable or not, so that positions stay.
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

/// @return Position of the string in `names`; when it is not one of them, reports it with the nearest name.
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

/// @brief An object whose fields are read one by one; finish() then reports the fields that nobody asked for.
///
/// A value that is not an object is reported once, and every field is then absent without a further word.
class Object {
 public:
  explicit Object(const Value& value);

  /// A field that must be there.
  template <class T>
  void required(std::string_view key, T& out) {
    set_unread(out);
    if (const auto value = find_required(key)) {
      read(*value, out);
    }
  }
  /// A field that may be there; `out` keeps its default when it is not. Tells whether it is there.
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

  /// Reports every field that was not asked for. To be called last; not when what to ask for is not known.
  void finish() const;

 private:
  Value value_;
  bool readable_;
  std::vector<std::string_view> known_;
};

/// @brief An object whose field "type" names one of several forms; the form's function reads the other
/// fields.
///
/// When the form is not known, the whole object counts as unreadable and `out` stays as it was.
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

/// @brief The one of `names` that was probably meant: one that begins with the words written, else the
/// nearest within two letters and less than half of what was written; empty when there is none.
[[nodiscard]] std::string_view nearest_name(std::string_view written,
                                            std::span<const std::string_view> names);

}  // namespace snapthrough::api
