#include "api/soil/write_foundations.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <utility>

#include "api/soil/curve_depths.h"
#include "api/soil/equivalent_depth.h"
#include "api/soil/faces.h"
#include "api/soil/interpolation.h"
#include "solver/check/check_place.h"
#include "solver/model/limits.h"
#include "solver/numeric/work_limit.h"

namespace snapthrough::api::soil {

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

/// Set of curves of a layer.
struct Kind {
  const char* name = "";       ///< in ids of foundations
  const char* component = "";  ///< component of the foundations; empty: the normal
  double limit = 0.0;          ///< largest displacement at which interpolation by depth keeps the accuracy
  double force_factor = 1.0;
  double displacement_factor = 1.0;
};
constexpr Kind kLateral;

/// Largest equivalent depth over the length of the pile, for which sums of depths keep their digits.
constexpr double kLargestEquivalentDepth = 1e6;

/// @brief A layer and the pile, by depths of one origin, and what is above the layer.
///
/// Curves of a layer with an equivalent depth have that origin at which its upper face is at that depth.
struct Frame {
  Layer layer;
  Pile pile;
  double stress = 0.0;    ///< vertical effective stress at the top of the layer
  double strength = 0.0;  ///< integral of the strength over the clay above the layer
  double clay = 0.0;      ///< thickness of that clay

  /// Returns the part of the layer that holds the pile.
  [[nodiscard]] Contact contact() const {
    return {std::max({layer.from, pile.head_depth, pile.held_from}), std::min(layer.to, pile.tip_depth()),
            Cubic({stress - layer.gamma * layer.from, layer.gamma, 0.0, 0.0})};
  }
};

using CurveByDepth = std::function<Curve(double)>;
/// A value that varies with depth.
using ByDepth = std::function<double(double)>;

/// Writes the foundations of a pile, layer by layer.
class SoilWriter {
 public:
  SoilWriter(const Profile& profile, const Pile& pile, std::size_t& numbers, std::vector<Finding>& findings)
      : profile_(profile),
        numbers_by_depth_(numbers),
        findings_(findings),
        frame_{{}, pile},
        equivalent_depths_(pile.diameter, profile.loading, kLargestEquivalentDepth * pile.length) {}

  json foundations();

 private:
  void write(const Sand& sand);
  void write(const SoftClay& clay);
  void write(const Faces<LayerType>& faces);
  void write(const Axial& axial);
  void write_clay(std::span<const Piece> resistance, double capacity, double y50);
  void write_shallow_cyclic(const Piece& resistance, double transition, double y50);
  void write_power(std::span<const double> depths, const ByDepth& resistance, double capacity, double y50,
                   std::size_t curve = 0);

  void write_tables(const CurveByDepth& curve_at, const Kind& kind);

  /// Returns the place of a curve in the current layer.
  [[nodiscard]] Place place_at(double depth) const;
  /// Returns the fraction of the current layer's thickness.
  [[nodiscard]] double in_layer(double depth) const {
    return (depth - layer().from) / (layer().to - layer().from);
  }
  [[nodiscard]] double mean_strength(double depth) const;
  void pass_layer();
  void write_layer(std::optional<double> equivalent_depth);
  [[nodiscard]] Frame moved_to(double depth) const;
  void enter(Frame frame) {
    frame_ = std::move(frame);
    contact_ = frame_.contact();
  }

  void add(double from, double to, json law, const Kind& kind, std::size_t curve = 0);
  json along(std::span<const double> depths, const ByDepth& value);
  double checked(double value);
  void report(std::string detail) {
    findings_.push_back({"/layers/" + std::to_string(layer().number), "out_of_range", std::move(detail)});
  }
  void report_too_fine() {
    is_too_fine_ = true;
    report(
        "the resistance of this layer cannot be interpolated by depth within the accuracy: a layer has at "
        "most " +
        std::to_string(kMaxBreakPoints) + " break points, which are at least " +
        checks::text(2.0 * kMinRelativeChord) + " of the pile's length apart");
  }
  [[nodiscard]] const Layer& layer() const { return frame_.layer; }
  [[nodiscard]] const Pile& pile() const { return frame_.pile; }
  /// Returns the part of the accuracy that is for the points of curves; interpolation by depth has the rest,
  /// since the number of depths falls faster with it than the number of points does.
  [[nodiscard]] double curve_accuracy() const {
    return std::max(0.25 * profile_.accuracy, std::min(kLeastAccuracy, 0.5 * profile_.accuracy));
  }
  /// Returns the factor of initial stiffnesses.
  [[nodiscard]] double stiffening() const { return pile().force_factor / pile().displacement_factor; }
  [[nodiscard]] double shortest() const { return 2.0 * kMinRelativeChord * pile().length; }

  const Profile& profile_;
  std::size_t& numbers_by_depth_;  ///< written for the piles and layers up to the current one
  std::vector<Finding>& findings_;
  Frame frame_;  ///< origin of depths of the current layer
  EquivalentDepths equivalent_depths_;
  Contact contact_;           ///< part of the current layer that holds the pile
  bool is_too_fine_ = false;  ///< a layer needs too many depths
  bool is_finite_ = true;     ///< all numbers of the current layer are at most kMaxMagnitude
  json foundations_ = json::array();
};

json SoilWriter::foundations() {
  for (const Layer& one : profile_.layers) {
    WorkLimit::poll();
    frame_.layer = one;
    contact_ = frame_.contact();
    const auto equivalent_depth =
        profile_.layering == Layering::georgiadis ? equivalent_depths_.next(one) : std::optional<double>();
    if (contact_.to - contact_.from < shortest()) {
      pass_layer();  // the layer does not hold the pile, but for rounding
      continue;
    }
    is_finite_ = true;
    write_layer(equivalent_depth);
    if (is_too_fine_) {
      break;  // such layers take the longest
    }
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
    pass_layer();
  }
  return std::move(foundations_);
}

/// Writes the curves of the current layer, the lateral ones at its equivalent depths if it has any.
void SoilWriter::write_layer(std::optional<double> equivalent_depth) {
  const auto write_lateral = [this] { std::visit([this](const auto& soil) { write(soil); }, layer().soil); };
  if (!equivalent_depth) {
    write_lateral();
  } else if (*equivalent_depth < kLargestEquivalentDepth * pile().length) {
    Frame own = frame_;
    enter(moved_to(*equivalent_depth));
    write_lateral();
    enter(std::move(own));
  } else {
    return report(
        "the soil of this layer alone does not have the resistance of the layers above within " +
        checks::text(kLargestEquivalentDepth) +
        " lengths of the member: it has no equivalent depth; its strength at the upper face counts");
  }
  if (layer().axial) {
    write(*layer().axial);
  }
}

/// Returns the frame in which the current layer begins at an equivalent depth, with its own soil above.
Frame SoilWriter::moved_to(double depth) const {
  const double shift = depth - layer().from;
  Frame moved = frame_;
  moved.layer.from = depth;
  moved.layer.to += shift;
  moved.layer.top += shift;
  for (double Pile::*one : {&Pile::head_depth, &Pile::embedded_depth, &Pile::held_from}) {
    moved.pile.*one += shift;
  }
  moved.stress = layer().gamma * depth;
  moved.strength = strength_at(layer(), 0.0).value_or(0.0) * depth;
  moved.clay = depth;
  return moved;
}

/// Adds the current layer to the sums over the layers above.
void SoilWriter::pass_layer() {
  const double thickness = layer().to - layer().from;
  frame_.stress += layer().gamma * thickness;
  if (const auto middle = strength_at(layer(), 0.5)) {
    frame_.strength += *middle * thickness;
    frame_.clay += thickness;
  }
}

/// Returns the mean strength of clay from the surface to a depth in the current layer, which has a strength.
double SoilWriter::mean_strength(double depth) const {
  const double fraction = in_layer(depth);
  const double part = depth - layer().from;
  const double strength = strength_at(layer(), 0.5 * fraction).value_or(0.0);
  return frame_.clay + part > 0.0 ? (frame_.strength + strength * part) / (frame_.clay + part) : strength;
}

Place SoilWriter::place_at(double depth) const {
  const double embedded = std::max(pile().embedded_depth, pile().tip_depth());
  return {depth,           std::max(contact_.stress(depth), 0.0), pile().diameter, embedded, layer().top,
          profile_.loading};
}

/// Writes p = A Pmax tanh(k X y / (A Pmax)).
void SoilWriter::write(const Sand& sand) {
  const auto resistance = sand_resistance(sand, pile().diameter, profile_.loading, contact_, shortest());
  const auto depths = break_depths(resistance, shortest(), profile_.accuracy);
  if (!depths) {
    return report_too_fine();
  }
  add(contact_.from, contact_.to,
      {{"type", "tanh"},
       {"stiffness",
        along(std::array{contact_.from, contact_.to}, [&](double X) { return stiffening() * (sand.k * X); })},
       {"capacity", along(*depths, [&](double X) { return pile().force_factor * value_at(resistance, X); })}},
      kLateral);
}

void SoilWriter::write(const Faces<LayerType>& faces) {
  const auto type_at = [&](double X) { return with_mean_strength(at(faces, in_layer(X)), mean_strength(X)); };
  write_tables([&](double X) { return curve_of(type_at(X), place_at(X), curve_accuracy()); },
               {"", "", pile().diameter, pile().force_factor, pile().displacement_factor});
  if (std::holds_alternative<PisaClay>(faces.top)) {
    write_tables(
        [&](double X) {
          return moment_curve_of(std::get<PisaClay>(type_at(X)), place_at(X), curve_accuracy());
        },
        {" rotation", "rotation", 1.0});
  }
}

void SoilWriter::write(const Axial& axial) {
  write_tables(
      [&](double X) {
        AxialType type = at(axial.type, in_layer(X));
        if (axial.friction_by_strength) {
          const double Su = strength_at(layer(), in_layer(X)).value_or(0.0);
          std::get<ApiTzClay>(type).friction = api_clay_friction(Su, place_at(X).stress);
        }
        return curve_of(type, place_at(X), curve_accuracy());
      },
      {" axial", "tangent", pile().diameter});
}

/// @brief Writes curves at depths X_0, X_1, ..., linear in X between.
///
/// The factor of each curve falls linearly from 1 at its own depth to zero at both neighbours.
void SoilWriter::write_tables(const CurveByDepth& curve_at, const Kind& kind) {
  const double accuracy = profile_.accuracy - curve_accuracy();
  const auto curves = curves_by_depth(curve_at, contact_.from, contact_.to,
                                      {accuracy, kind.limit, accuracy * pile().diameter, shortest()});
  if (!curves) {
    return report_too_fine();
  }
  std::vector<double> depths;
  std::ranges::transform(*curves, std::back_inserter(depths), &CurveAtDepth::depth);
  for (std::size_t i = 0; i < depths.size(); ++i) {
    if (!(*curves)[i].curve.has_resistance()) {
      continue;
    }
    const std::span neighbours(depths.begin() + (i > 0 ? i - 1 : 0),
                               depths.begin() + std::min(i + 2, depths.size()));
    json points = json::array();
    for (const auto& [displacement, force] : (*curves)[i].curve.points) {
      points.push_back(
          {checked(kind.displacement_factor * displacement), checked(kind.force_factor * force)});
    }
    numbers_by_depth_ += points.size();
    add(neighbours.front(), neighbours.back(),
        {{"type", "table"},
         {"points", std::move(points)},
         {"interpolation", "linear"},
         {"factor", along(neighbours, [&](double X) { return X == depths[i] ? 1.0 : 0.0; })}},
        kind, i + 1);
  }
}

void SoilWriter::write(const SoftClay& clay) {
  const double D = pile().diameter;
  const double y50 = kStrainFactor * clay.eps50 * D;
  if (profile_.loading == Loading::static_) {
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
  if (const auto depths = break_depths(resistance, shortest(), profile_.accuracy)) {
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
    return error < 1.0 && sum / (1.0 - error) <= profile_.accuracy;
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
       {"capacity", times_resistance(pile().force_factor * capacity)},
       {"reference", checked(pile().displacement_factor * (clay_displacement(capacity) * y50))},
       {"exponent", kExponent},
       {"stiffness", times_resistance(stiffening() * (clay_stiffness() / y50))}},
      kLateral, curve);
}

void SoilWriter::add(double from, double to, json law, const Kind& kind, std::size_t curve) {
  std::array range{pile().fraction(from), pile().fraction(to)};
  std::sort(range.begin(), range.end());
  json foundation{{"id", foundation_id(pile(), layer(), kind.name, curve)},
                  {"member", pile().member},
                  {"range", range},
                  {"law", std::move(law)}};
  if (*kind.component != '\0') {
    foundation["component"] = kind.component;
  }
  foundations_.push_back(std::move(foundation));
}

/// Returns a value by fractions of the pile's member, linear between.
json SoilWriter::along(std::span<const double> depths, const ByDepth& value) {
  std::vector<std::array<double, 2>> pairs;
  numbers_by_depth_ += depths.size();
  for (const double depth : depths) {
    pairs.push_back({pile().fraction(depth), checked(value(depth))});
  }
  std::sort(pairs.begin(), pairs.end());
  return {{"along", pairs}};
}

double SoilWriter::checked(double value) {
  is_finite_ = is_finite_ && std::abs(value) <= kMaxMagnitude;
  return value;
}

}  // namespace

double Pile::fraction(double depth) const {
  const double from_head = std::clamp((depth - head_depth) / length, 0.0, 1.0);
  return head_is_start ? from_head : 1.0 - from_head;
}

std::string foundation_id(const Pile& pile, const Layer& layer, std::string_view kind, std::size_t curve) {
  std::string id = pile.id + " layer " + std::to_string(layer.number + 1);
  if (layer.part > 0) {
    id += " part " + std::to_string(layer.part);
  }
  id += kind;
  return curve > 0 ? id + " curve " + std::to_string(curve) : id;
}

json write_foundations(const Profile& profile, const Pile& pile, std::size_t& numbers,
                       std::vector<Finding>& findings) {
  return SoilWriter(profile, pile, numbers, findings).foundations();
}

}  // namespace snapthrough::api::soil
