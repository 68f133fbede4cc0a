/// Writes the p-y curves of a soil document as laws of foundations.

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>

#include "api/convert/convert.h"
#include "api/convert/interpolation.h"
#include "api/convert/soil.h"
#include "api/json_text.h"
#include "solver/check/check_place.h"
#include "solver/model/limits.h"
#include "solver/numeric/work_limit.h"

namespace snapthrough::api {

namespace convert {
namespace {

using nlohmann::json;

// Curve of soft clay, p/Pmax over t = y/y50: 0.5 t^(1/3), in place of which the tables of API RP 2GEO have a
// line up to their first point.
constexpr double kExponent = 1.0 / 3.0;
constexpr double kFirstPoint = 0.1;       ///< t at the end of the line
constexpr double kStaticEnd = 8.0;        ///< t at which p = Pmax
constexpr double kCyclicCapacity = 0.72;  ///< p/Pmax that cyclic loads leave below the transition depth
constexpr double kStrainFactor = 2.5;     ///< y50 / (eps50 D)

/// Returns p/Pmax of soft clay without limit.
double clay_curve(double t) { return 0.5 * std::cbrt(t); }
/// Returns t at which the curve reaches p/Pmax = c.
double clay_displacement(double c) { return kStaticEnd * c * c * c; }
/// Returns the initial stiffness times y50/Pmax: that of the line to the first point.
double clay_stiffness() { return clay_curve(kFirstPoint) / kFirstPoint; }

/// A value that varies with depth.
using ByDepth = std::function<double(double)>;

/// Writes the foundations of a pile, layer by layer.
class SoilWriter {
 public:
  SoilWriter(const SoilDocument& document, std::vector<Finding>& findings)
      : document_(document), findings_(findings) {}

  json foundations();

 private:
  void write(const Sand& sand);
  void write(const SoftClay& clay);
  void write_clay(std::span<const Piece> resistance, double capacity, double y50);
  void write_shallow_cyclic(const Piece& resistance, double transition, double y50);
  void write_power(std::span<const double> depths, const ByDepth& resistance, double capacity, double y50,
                   std::size_t curve = 0);

  void add(double from, double to, json law, std::size_t curve = 0);
  json along(std::span<const double> depths, const ByDepth& value);
  double checked(double value);
  void report(std::string detail) {
    findings_.push_back({"/layers/" + std::to_string(index_), "out_of_range", std::move(detail)});
  }
  void report_too_fine() {
    report(
        "the resistance of this layer cannot be interpolated by depth within the accuracy: a layer has at "
        "most " +
        std::to_string(kMaxBreakPoints) + " break points, which are at least " +
        checks::text(2.0 * kMinRelativeChord) + " of the pile's length apart");
  }
  [[nodiscard]] const Layer& layer() const { return document_.layers[index_]; }
  [[nodiscard]] double shortest() const { return 2.0 * kMinRelativeChord * document_.pile.length; }

  const SoilDocument& document_;
  std::vector<Finding>& findings_;
  std::size_t index_ = 0;             ///< current layer
  Contact contact_;                   ///< part of the current layer that touches the pile
  bool is_finite_ = true;             ///< all numbers of the current layer are at most kMaxMagnitude
  std::size_t numbers_by_depth_ = 0;  ///< written for the layers up to the current one
  json foundations_ = json::array();
};

json SoilWriter::foundations() {
  const Pile& pile = document_.pile;
  double stress = 0.0;  // vertical effective stress at the top of the layer
  for (index_ = 0; index_ < document_.layers.size(); ++index_) {
    WorkLimit::poll();
    contact_ = {std::max(layer().from, pile.head_depth), std::min(layer().to, pile.tip_depth()),
                Cubic({stress - layer().gamma * layer().from, layer().gamma, 0.0, 0.0})};
    stress += layer().gamma * (layer().to - layer().from);
    if (contact_.to - contact_.from < shortest()) {
      continue;  // the layer does not touch the pile, but for rounding
    }
    is_finite_ = true;
    std::visit([this](const auto& soil) { write(soil); }, layer().soil);
    if (!is_finite_) {
      report("a resistance or stiffness of this layer is greater than " + checks::text(kMaxMagnitude));
    }
    if (foundations_.size() > kMaxFoundations) {
      report("the layers up to this one need more than " + std::to_string(kMaxFoundations) + " foundations");
      break;
    }
    if (numbers_by_depth_ > kMaxNumbersByDepth) {
      report("the layers up to this one need more than " + std::to_string(kMaxNumbersByDepth) +
             " numbers by depth; a larger accuracy needs fewer");
      break;
    }
  }
  return std::move(foundations_);
}

/// Writes p = A Pmax tanh(k X y / (A Pmax)).
void SoilWriter::write(const Sand& sand) {
  const auto resistance =
      sand_resistance(sand, document_.pile.diameter, document_.loading, contact_, shortest());
  const auto depths = break_depths(resistance, shortest(), document_.accuracy);
  if (!depths) {
    return report_too_fine();
  }
  add(contact_.from, contact_.to,
      {{"type", "tanh"},
       {"stiffness", along(std::array{contact_.from, contact_.to}, [&](double X) { return sand.k * X; })},
       {"capacity", along(*depths, [&](double X) { return value_at(resistance, X); })}});
}

void SoilWriter::write(const SoftClay& clay) {
  const double D = document_.pile.diameter;
  const double y50 = kStrainFactor * clay.eps50 * D;
  if (document_.loading == Loading::static_) {
    return write_clay(clay_resistance(clay, layer(), D, contact_, shortest()), 1.0, y50);
  }
  const double transition = transition_depth(clay, layer(), D, contact_.stress);
  const bool has_deep_part = transition < contact_.to - shortest();
  Contact shallow = contact_;
  shallow.to = has_deep_part ? std::max(transition, contact_.from) : contact_.to;
  if (shallow.to > shallow.from + shortest()) {
    write_shallow_cyclic(clay_resistance(clay, layer(), D, shallow, shortest()).front(), transition, y50);
  }
  if (has_deep_part) {
    Contact deep = contact_;
    deep.from = shallow.to;
    write_clay(clay_resistance(clay, layer(), D, deep, shortest()), kCyclicCapacity, y50);
  }
}

/// Writes p = Pmax min(0.5 (y/y50)^(1/3), capacity).
void SoilWriter::write_clay(std::span<const Piece> resistance, double capacity, double y50) {
  if (const auto depths = break_depths(resistance, shortest(), document_.accuracy)) {
    write_power(
        *depths, [&](double X) { return value_at(resistance, X); }, capacity, y50);
  } else {
    report_too_fine();
  }
}

/// @brief Writes p = Pmax min(0.5 (y/y50)^(1/3), 0.72 X/X_R) as curves at depths X_0, X_1, ..., linear in X
/// between.
///
/// The resistance of each curve falls linearly from its own depth to zero at both neighbours.
/// With m = min(0.5 (y/y50)^(1/3), c) and c = 0.72 X/X_R, interpolation L of P m between a and b satisfies
///   L[P m] - P m = (L[P] - P) L[m] + P (L[m] - m) + u (1 - u) dP dm,
/// where u is the fraction of the interval and |L[m] - m| <= dc/4. All terms are bounded relative to P =
/// Pmax.
/// @param resistance above the transition depth X_R clay has one polynomial
void SoilWriter::write_shallow_cyclic(const Piece& resistance, double transition, double y50) {
  const auto capacity = [&](double X) { return kCyclicCapacity * std::min(1.0, X / transition); };
  const auto depths = divide_depth(resistance.from, resistance.to, shortest(), [&](double a, double b) {
    const double error = chord_error(resistance, a, b);
    const double step = capacity(b) - capacity(a);
    const double root_a = std::sqrt(resistance_at(resistance, a));
    const double root_b = std::sqrt(resistance_at(resistance, b));
    const double sum = error * capacity(b) + (1.0 + error) * step / 4.0 +
                       step * std::abs(root_b - root_a) / (root_a + root_b);
    return error < 1.0 && sum / (1.0 - error) <= document_.accuracy;
  });
  if (!depths) {
    return report_too_fine();
  }
  for (std::size_t i = 0; i < depths->size(); ++i) {
    const double own = (*depths)[i];
    const std::span neighbours(depths->begin() + (i > 0 ? i - 1 : 0),
                               depths->begin() + std::min(i + 2, depths->size()));
    const double peak = resistance_at(resistance, own);
    if (peak * capacity(own) > 0.0) {  // there is no resistance at the surface
      write_power(
          neighbours, [&](double X) { return X == own ? peak : 0.0; }, capacity(own), y50, i + 1);
    }
  }
}

/// Writes p = R min(0.5 (y/y50)^(1/3), capacity), where the resistance R is linear between depths.
void SoilWriter::write_power(std::span<const double> depths, const ByDepth& resistance, double capacity,
                             double y50, std::size_t curve) {
  const auto times_resistance = [&](double factor) {
    return along(depths, [&](double X) { return factor * resistance(X); });
  };
  add(depths.front(), depths.back(),
      {{"type", "power"},
       {"capacity", times_resistance(capacity)},
       {"reference", checked(clay_displacement(capacity) * y50)},
       {"exponent", kExponent},
       {"stiffness", times_resistance(clay_stiffness() / y50)}},
      curve);
}

void SoilWriter::add(double from, double to, json law, std::size_t curve) {
  const Pile& pile = document_.pile;
  std::array range{pile.fraction(from), pile.fraction(to)};
  std::sort(range.begin(), range.end());
  foundations_.push_back({{"id", foundation_id(pile, index_ + 1, curve)},
                          {"member", pile.member},
                          {"range", range},
                          {"law", std::move(law)}});
}

/// Returns a value by fractions of the pile's member, linear between.
json SoilWriter::along(std::span<const double> depths, const ByDepth& value) {
  std::vector<std::array<double, 2>> pairs;
  numbers_by_depth_ += depths.size();
  for (const double depth : depths) {
    pairs.push_back({document_.pile.fraction(depth), checked(value(depth))});
  }
  std::sort(pairs.begin(), pairs.end());
  return {{"along", pairs}};
}

double SoilWriter::checked(double value) {
  is_finite_ = is_finite_ && std::abs(value) <= kMaxMagnitude;
  return value;
}

}  // namespace
}  // namespace convert

Conversion convert_soil(std::string_view text) {
  const ParsedText parsed = parse_json(text);
  return parsed.document == nullptr ? Conversion{nullptr, parsed.findings}
                                    : convert_soil_document(*parsed.document);
}

Conversion convert_soil_document(const nlohmann::json& soil) {
  Conversion conversion;
  const convert::SoilDocument document = convert::read_soil(soil, conversion.findings);
  if (!conversion.findings.empty()) {
    return conversion;
  }
  nlohmann::json parts = nlohmann::json::object();
  if (!document.units.empty()) {
    parts["units"] = nlohmann::json(document.units);
  }
  parts["foundations"] = convert::SoilWriter(document, conversion.findings).foundations();
  if (conversion.findings.empty()) {
    conversion.document = std::make_shared<nlohmann::json>(std::move(parts));
  }
  return conversion;
}

}  // namespace snapthrough::api
