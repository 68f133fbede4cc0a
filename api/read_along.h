#pragma once
/// @file
/// Reader of values that may vary along a member. Internal to api/.

#include <cstddef>
#include <string>
#include <utility>

#include "api/value.h"
#include "solver/model/along_member.h"

namespace snapthrough::api {

/// Reads one [fraction, value].
template <class T>
void read(const Value& value, std::pair<double, T>& out) {
  set_unread(out.first);
  set_unread(out.second);
  if (!value.is_array() || value.size() != 2) {
    value.report_type("[fraction, value]");
    return;
  }
  read(value.item(0), out.first);
  read(value.item(1), out.second);
}

/// Least number of places at which a load or a number of a section that varies is given.
inline constexpr std::size_t kLeastPoints = 2;

/// Reads a value that is the same along a member, or {"along": [[fraction, value], ...]}.
/// @param least least number of points
/// @param power null where the form has no "power"
template <class T>
void read_along(const Value& value, T& out, Along<T>& along, std::size_t least, double* power = nullptr) {
  if (!value.is_object()) {
    set_unread(out);
    read(value, out);
    return;
  }
  Object in(value);
  if (const auto points = in.find_required("along")) {
    if (points->is_array() && points->size() < least) {
      points->report("empty", least == 1 ? "along must hold a [fraction, value] pair"
                                         : "along must hold at least two [fraction, value] pairs");
    }
    read(*points, along);
  }
  if (power != nullptr) {
    in.optional("power", *power);
  }
  in.finish();
}

}  // namespace snapthrough::api
