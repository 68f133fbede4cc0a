/// Points of grids, zips and Latin hypercubes, each computed from its number alone.

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>

#include "api/sweep_data.h"

namespace snapthrough::api {

namespace {

using Json = nlohmann::json;

/// Finaliser of SplitMix64 (Steele, Lea, Flood 2014): a bijection of 64-bit integers that mixes all bits.
std::uint64_t mix(std::uint64_t x) {
  x += 0x9E3779B97F4A7C15U;
  x = (x ^ (x >> 30U)) * 0xBF58476D1CE4E5B9U;
  x = (x ^ (x >> 27U)) * 0x94D049BB133111EBU;
  return x ^ (x >> 31U);
}

/// @brief Returns the image of `i` in a pseudo-random permutation of 0 to n - 1.
///
/// A Feistel network permutes the integers of the next even number of bits, and is applied until the result
/// is below n (cycle walking; Black, Rogaway 2002). There is no table, so memory does not depend on n.
std::uint64_t permuted(std::uint64_t i, std::uint64_t n, std::uint64_t key) {
  constexpr std::uint64_t kRounds = 8;
  const unsigned half = std::max(1U, (static_cast<unsigned>(std::bit_width(n - 1)) + 1) / 2);
  const std::uint64_t mask = (std::uint64_t{1} << half) - 1;
  do {
    std::uint64_t left = i >> half;
    std::uint64_t right = i & mask;
    for (std::uint64_t round = 0; round < kRounds; ++round) {
      const std::uint64_t next = left ^ (mix(key + mix((round << 32U) + right)) & mask);
      left = right;
      right = next;
    }
    i = (left << half) | right;
  } while (i >= n);
  return i;
}

/// @brief Returns the coordinate of a sample in [0, 1): each of `samples` equal parts holds exactly one
/// sample, at a random position (McKay, Beckman, Conover 1979).
double hypercube_coordinate(const SweepData& data, std::size_t parameter, std::uint64_t point) {
  const auto samples = static_cast<std::uint64_t>(data.samples);
  const std::uint64_t key = mix(mix(static_cast<std::uint64_t>(data.seed)) + parameter);
  const std::uint64_t part = permuted(point, samples, key);
  const double place = static_cast<double>(mix(~key + mix(point)) >> 11U) * 0x1p-53;
  const double last = std::nextafter(1.0, 0.0);
  return std::min((static_cast<double>(part) + place) / static_cast<double>(samples), last);
}

Json in_range(const SweepRange& range, double t) {
  return range.log ? range.from * std::pow(range.to / range.from, t)
                   : range.from + t * (range.to - range.from);
}

Json listed_value(const SweepRange& range, std::uint64_t i) {
  const auto last = static_cast<std::uint64_t>(range.count - 1);
  if (i == 0 || i == last) {
    return i == 0 ? range.from : range.to;  // the ends are exact
  }
  if (!range.log) {
    // Multiplying before dividing keeps 1, 2, 3, ... whole, and keeps the values of a range that is extended.
    return range.from + (range.to - range.from) * static_cast<double>(i) / static_cast<double>(last);
  }
  return in_range(range, static_cast<double>(i) / static_cast<double>(last));
}

/// Position of a point in one parameter: the index in its list or counted range, or a position in a sampled
/// range.
struct Coordinate {
  std::uint64_t entry = 0;
  double place = 0.0;  ///< position in [0, 1) of a Latin hypercube
};

std::vector<Coordinate> coordinates(const SweepData& data, std::uint64_t point) {
  std::vector<Coordinate> all(data.parameters.size());
  std::uint64_t rest = point;
  for (std::size_t i = all.size(); i-- > 0;) {
    const SweepParameter& parameter = data.parameters[i];
    switch (data.design) {
      case SweepDesign::grid:
        all[i].entry = rest % parameter.count();
        rest /= parameter.count();
        break;
      case SweepDesign::zip:
        all[i].entry = point;
        break;
      case SweepDesign::latin_hypercube:
        all[i].place = hypercube_coordinate(data, i, point);
        all[i].entry =
            static_cast<std::uint64_t>(all[i].place * static_cast<double>(parameter.values.size()));
        break;
    }
  }
  return all;
}

Json value_at(const SweepData& data, std::size_t parameter, const Coordinate& at) {
  const SweepParameter& of = data.parameters[parameter];
  if (!of.range) {
    return of.values[static_cast<std::size_t>(at.entry)];
  }
  return data.design == SweepDesign::latin_hypercube ? in_range(*of.range, at.place)
                                                     : listed_value(*of.range, at.entry);
}

}  // namespace

std::vector<Json> design_values(const SweepData& data, std::uint64_t point) {
  std::vector<Json> values;
  for (const Coordinate& at : coordinates(data, point)) {
    values.push_back(value_at(data, values.size(), at));
  }
  return values;
}

std::vector<Json> design_labels(const SweepData& data, std::uint64_t point) {
  std::vector<Json> shown;
  for (const Coordinate& at : coordinates(data, point)) {
    const std::vector<std::string>& labels = data.parameters[shown.size()].labels;
    shown.push_back(labels.empty() ? value_at(data, shown.size(), at)
                                   : Json(labels[static_cast<std::size_t>(at.entry)]));
  }
  return shown;
}

}  // namespace snapthrough::api
