#include "solver/check/check_place.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "solver/model/limits.h"
#include "solver/numeric/number_text.h"

namespace snapthrough::checks {

namespace {

bool is_bounded(double value) { return std::abs(value) <= kMaxMagnitude; }

/// @param rule returns the text of the rule
template <class Rule>
bool report_unless(bool holds, const Place& place, double value, const Rule& rule) {
  if (!holds) {
    place.report("out_of_range", place.name() + " must be " + rule() + ", got " + text(value));
  }
  return holds;
}

}  // namespace

void Place::report(std::string_view code, std::string detail) const {
  findings_->push_back({path_.text(), std::string(code), std::move(detail)});
}

std::string Place::name() const {
  const std::string pointer = path_.text();
  return pointer.substr(pointer.rfind('/') + 1);
}

std::string text(double value) {
  std::array<char, 32> buffer{};
  const auto [end, error] = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  return std::string(buffer.data(), error == std::errc() ? end : buffer.data());
}

std::string in_quotes(std::string_view id) {
  std::size_t length = std::min(id.size(), MessageLimits::id_bytes);
  while (length < id.size() && length > 0 && (static_cast<unsigned char>(id[length]) & 0xC0U) == 0x80U) {
    --length;  // do not cut inside a UTF-8 sequence
  }
  return "\"" + std::string(id.substr(0, length)) + (length < id.size() ? "...\"" : "\"");
}

bool require_finite(const Place& place, double value) {
  return report_unless(is_bounded(value), place, value,
                       [] { return "a finite number of at most " + text(kMaxMagnitude); });
}

bool require_positive(const Place& place, double value) {
  return report_unless(value > 0.0 && is_bounded(value), place, value, [] { return "positive and finite"; });
}

bool require_not_negative(const Place& place, double value) {
  return report_unless(value >= 0.0 && is_bounded(value), place, value,
                       [] { return "zero or positive, and finite"; });
}

bool require_between(const Place& place, double value, double lo, double hi) {
  return report_unless(value >= lo && value <= hi, place, value,
                       [&] { return "from " + text(lo) + " to " + text(hi); });
}

bool require_between(const Place& place, int value, int lo, int hi) {
  const bool holds = value >= lo && value <= hi;
  if (!holds) {
    place.report("out_of_range", place.name() + " must be from " + std::to_string(lo) + " to " +
                                     std::to_string(hi) + ", got " + std::to_string(value));
  }
  return holds;
}

bool require_next_fraction(const Place& place, double fraction, double previous) {
  if (!require_between(place, fraction, 0.0, 1.0)) {
    return false;
  }
  const bool holds = fraction - previous > kMinRelativeChord;
  if (!holds) {
    place.report("not_increasing", "fractions must increase by more than " + text(kMinRelativeChord) +
                                       ", got " + text(fraction) + " after " + text(previous));
  }
  return holds;
}

bool require_direction(const Place& place, const std::array<double, 2>& direction) {
  const bool finite = is_bounded(direction[0]) && is_bounded(direction[1]);
  if (!finite) {
    place.report("out_of_range", "direction must have two finite components");
  } else if (!(std::hypot(direction[0], direction[1]) > 0.0)) {
    place.report("zero_direction", "direction must not be [0, 0]");
    return false;
  }
  return finite;
}

bool require_fractions(const Place& place, const std::array<double, 2>& range) {
  const bool holds = range[0] >= 0.0 && range[0] < range[1] && range[1] <= 1.0;
  if (!holds) {
    place.report("out_of_range", "range must be [f0, f1] with 0 <= f0 < f1 <= 1, got [" + text(range[0]) +
                                     ", " + text(range[1]) + "]");
  }
  return holds;
}

bool require_interval(const Place& place, const std::array<double, 2>& range) {
  const bool holds = is_bounded(range[0]) && is_bounded(range[1]) && range[0] < range[1];
  if (!holds) {
    place.report("out_of_range", place.name() + " must be [lo, hi] with lo < hi, got [" + text(range[0]) +
                                     ", " + text(range[1]) + "]");
  }
  return holds;
}

bool require_count(const Place& place, std::size_t count, std::size_t max) {
  if (count > max) {
    place.report("too_many", place.name() + " may hold at most " + std::to_string(max) + " entries, got " +
                                 std::to_string(count));
  }
  return count <= max;
}

std::size_t characters(std::string_view text) {
  return static_cast<std::size_t>(std::count_if(
      text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

void Ids::add(const Place& place, std::string_view id) {
  const auto [first, is_new] = first_.emplace(id, added_++);
  const auto is_control = [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; };
  if (id.empty()) {
    place.report("bad_id", "the id of a " + kind_ + " must not be empty");
  } else if (characters(id) > kMaxIdLength || std::any_of(id.begin(), id.end(), is_control)) {
    place.report("bad_id", "an id has at most " + std::to_string(kMaxIdLength) +
                               " characters, and no control characters");
  } else if (!is_new) {
    place.report("duplicate_id", kind_ + " " + in_quotes(id) + " is there already, at position " +
                                     std::to_string(first->second));
  }
}

bool Ids::require(const Place& place, std::string_view id) const {
  const bool holds = !id.empty() && contains(id);
  if (!holds) {
    place.report("unknown_reference", "there is no " + kind_ + " " + in_quotes(id));
  }
  return holds;
}

}  // namespace snapthrough::checks
