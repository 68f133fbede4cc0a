#include "solver/element/shear_layer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "solver/numeric/bracket.h"

namespace snapthrough {
namespace {

/// Search of the ends of contact on a shear layer.
struct EdgeSearch {
  static constexpr double place = 1e-13;       ///< accuracy of an end's place, in element lengths
  static constexpr int trials = 100;           ///< evaluations at most for one end
  static constexpr double least_share = 1e-6;  ///< share of a bracket that a trial leaves at both ends
  static constexpr int rounds = 20;            ///< ends of one gap depend on each other: alternations at most
  static constexpr double one_place = 1e-9;    ///< distance of two zones that are one, in element lengths
  /// One of so many samples of an element at each of its ends is not tested. Chosen on pipes and random
  /// models: bends of the axis at nodes make zones that the member does not have.
  static constexpr std::size_t untested = 6;
  static constexpr double rounding = 37.0;  ///< k l beyond which 1 / sinh(k l) is rounding beside 1
};

/// Step for differences of slopes, in element lengths: error of second order, rounding 1e-12.
constexpr double kBendStep = 1e-4;

/// sinh(x) / sinh(total). @pre 0 <= x <= total
double sinh_ratio(double x, double total) {
  return total > 0.0 ? std::exp(x - total) * std::expm1(-2.0 * x) / std::expm1(-2.0 * total) : 0.0;
}

/// cosh(x) / cosh(total). @pre 0 <= x <= total
double cosh_ratio(double x, double total) {
  return std::exp(x - total) * (1.0 + std::exp(-2.0 * x)) / (1.0 + std::exp(-2.0 * total));
}

/// Place on the member with its penetration.
struct Place {
  std::size_t cell = 0;
  double xi = 0.0;
  double s = 0.0;
  double depth = 0.0;
  int run = 0;          ///< number of the run of adjoining cells
  bool tested = false;  ///< takes part in the hull
};

/// Finds the contact set: the smallest surface above the penetrations is that of their hull in which
/// solutions of G g'' = K g stand for straight lines. The hull of samples gives the zones, then each end is
/// moved to the place at which the surface leaves the member tangentially.
class ContactSet {
 public:
  ContactSet(std::span<const LayerCell> cells, const ShearLayer& layer) : cells_(cells), layer_(layer) {
    for (std::size_t i = 0; i < cells.size(); ++i) gather(i);
    if (!samples_.empty()) samples_.back().tested = true;
  }
  [[nodiscard]] LayerParts parts() const;

 private:
  /// End of a zone that is searched for.
  struct Side {
    bool begins;                       ///< the zone begins there
    std::array<std::size_t, 2> reach;  ///< samples between which it lies
    const Place*
        other;  ///< end at the other side of the gap; null: the ground goes on to the end of the range
  };
  struct Zone {
    std::size_t first, last;  ///< samples on the hull
    Place from, to;
  };

  void gather(std::size_t cell);
  void gather_small_zones(std::size_t cell, std::vector<Place>& samples) const;
  void gather_small_gaps(std::size_t cell, std::vector<Place>& samples) const;
  [[nodiscard]] std::vector<Zone> zones() const;
  [[nodiscard]] bool is_covered(const Place* left, const Place& at, const Place* right) const;
  void place_ends(std::vector<Zone>& zones) const;
  [[nodiscard]] double excess(const Place& at, const Side& side) const;
  /// Excess at the start of the interval after a sample.
  [[nodiscard]] double excess_after(std::size_t sample, const Side& side) const {
    return excess(at(samples_[sample + 1].cell, start_of(sample + 1)), side);
  }
  [[nodiscard]] Place at(std::size_t cell, double xi) const {
    return {cell, xi, cells_[cell].arc(xi), cells_[cell].depth(xi)};
  }
  /// Coordinate of the sample before an index, in the cell of the sample at the index.
  [[nodiscard]] double start_of(std::size_t sample) const {
    const Place& before = samples_[sample - 1];
    const std::size_t cell = samples_[sample].cell;
    return before.cell == cell ? before.xi : cells_[cell].contact->range()[0];
  }
  [[nodiscard]] std::array<std::size_t, 2> run_of(std::size_t sample) const;
  [[nodiscard]] Place end_near(std::size_t sample, const Side& side) const {
    const auto after = fall_after(sample, side);
    return after ? *after : fall_before(sample, side);
  }
  [[nodiscard]] std::optional<Place> fall_after(std::size_t sample, const Side& side) const;
  [[nodiscard]] Place fall_before(std::size_t sample, const Side& side) const;
  [[nodiscard]] Place end_between(std::size_t sample, const Side& side) const;

  std::span<const LayerCell> cells_;
  ShearLayer layer_;
  std::vector<Place> samples_;
  int run_ = 0;
};

/// Appends the samples of a cell; the place that it shares with the cell before it has one sample. Those near
/// the ends of a cell are not tested: the axis bends at nodes by what the mesh does not resolve, and the
/// surface does not leave the member there.
void ContactSet::gather(std::size_t cell) {
  const LayerCell& c = cells_[cell];
  std::vector<FoundationContact::DepthAt> depths;
  c.contact->append_samples(c.start, c.gradient(c.dx), c.gradient(c.dy), depths);
  const std::size_t margin = depths.size() / EdgeSearch::untested;
  std::vector<Place> samples;
  for (std::size_t i = 0; i < depths.size(); ++i)
    samples.push_back({cell, depths[i].xi, c.arc(depths[i].xi), depths[i].depth + c.above, 0,
                       i >= margin && i + margin < depths.size()});
  gather_small_zones(cell, samples);
  gather_small_gaps(cell, samples);
  std::sort(samples.begin(), samples.end(), [](const Place& a, const Place& b) { return a.xi < b.xi; });
  const double near = EdgeSearch::one_place * c.contact->length();
  if (samples_.empty() || samples.front().s - samples_.back().s > near) {
    if (!samples_.empty()) samples_.back().tested = true;  // a run of cells ends
    samples.front().tested = true;
    ++run_;
  }
  for (Place& sample : samples) {
    if (!samples_.empty() && sample.s - samples_.back().s <= near) continue;
    sample.run = run_;
    samples_.push_back(sample);
  }
}

/// Adds a sample in each interval with penetration, so that a zone begins without length.
void ContactSet::gather_small_zones(std::size_t cell, std::vector<Place>& samples) const {
  const LayerCell& c = cells_[cell];
  std::vector<ElementPart> above;
  c.contact->contact_intervals(c.start, c.gradient(c.dx), c.gradient(c.dy), above, -c.above);
  for (const ElementPart& part : above) {
    samples.push_back(at(cell, 0.5 * (part.from + part.to)));
    samples.back().tested = true;
  }
}

/// Adds samples in each interval of length l in which the member would be pulled, so that a gap begins
/// without length: in its middle, which leaves the hull, and at the distance l from there. A small gap has
/// ends between these: its length is 3^(1/2) l where the pressure is a parabola.
void ContactSet::gather_small_gaps(std::size_t cell, std::vector<Place>& samples) const {
  const LayerCell& c = cells_[cell];
  const auto [first, last] = c.contact->range();
  std::vector<ElementPart> pressed;
  c.contact->pressed_intervals(c.start, c.gradient(c.dx), c.gradient(c.dy), c.above, pressed);
  pressed.push_back({last, last});
  double from = first;
  for (const ElementPart& part : pressed) {
    const double middle = 0.5 * (from + part.from);
    const double length = part.from - from;
    for (const double xi : {middle - length, middle, middle + length}) {
      if (!(length > 0.0 && xi > first && xi < last)) continue;
      samples.push_back(at(cell, xi));
      samples.back().tested = true;
    }
    from = part.to;
  }
}

/// Whether the surface that rests on the member at `left` and `right` covers it at a place in between.
/// @param left, right null: the surface goes on to the end of the ground
bool ContactSet::is_covered(const Place* left, const Place& at, const Place* right) const {
  const double k = layer_.decay();
  const auto tail = [&](const Place& from, double end) {
    if (layer_.endless) return std::exp(-k * std::abs(from.s - at.s));
    return cosh_ratio(k * std::abs(end - at.s), k * std::abs(end - from.s));
  };
  if (left == nullptr && right == nullptr) return false;
  if (left == nullptr) return at.depth <= right->depth * tail(*right, layer_.from);
  if (right == nullptr) return at.depth <= left->depth * tail(*left, layer_.to);
  const double whole = k * (right->s - left->s);
  return at.depth <= left->depth * sinh_ratio(k * (right->s - at.s), whole) +
                         right->depth * sinh_ratio(k * (at.s - left->s), whole);
}

/// Zones of the hull of the tested samples: neighbouring ones on the hull belong to one zone.
std::vector<ContactSet::Zone> ContactSet::zones() const {
  struct Tested {
    std::size_t sample, number;
  };
  std::vector<Tested> hull;
  const auto drop_covered = [&](const Place* next) {
    while (!hull.empty()) {
      const Place* before = hull.size() > 1 ? &samples_[hull[hull.size() - 2].sample] : nullptr;
      if (!is_covered(before, samples_[hull.back().sample], next)) break;
      hull.pop_back();
    }
  };
  std::size_t number = 0;
  for (std::size_t i = 0; i < samples_.size(); ++i) {
    if (!samples_[i].tested) continue;
    ++number;
    if (!(samples_[i].depth > 0.0)) continue;
    drop_covered(&samples_[i]);
    hull.push_back({i, number});
  }
  drop_covered(nullptr);
  std::vector<Zone> out;
  std::size_t last = 0;
  for (const auto& [i, tested] : hull) {
    if (out.empty() || tested != last + 1 || samples_[i].run != samples_[out.back().last].run)
      out.push_back({i, i, samples_[i], samples_[i]});
    else
      out.back().last = i;
    last = tested;
  }
  return out;
}

/// First and last sample of the adjoining cells around a sample.
std::array<std::size_t, 2> ContactSet::run_of(std::size_t sample) const {
  std::array<std::size_t, 2> out{sample, sample};
  while (out[0] > 0 && samples_[out[0] - 1].run == samples_[sample].run) --out[0];
  while (out[1] + 1 < samples_.size() && samples_[out[1] + 1].run == samples_[sample].run) ++out[1];
  return out;
}

/// Slope of the penetration less that of the ground beyond an end of contact: above zero on the side of the
/// smaller s of a tangential end, below zero on the other.
double ContactSet::excess(const Place& at, const Side& side) const {
  const auto& [begins, reach, other] = side;
  const double k = layer_.decay();
  double rise = 0.0;
  if (other != nullptr) {
    const double length =
        std::max(std::abs(other->s - at.s), EdgeSearch::one_place * cells_[at.cell].contact->length());
    rise = k * (at.depth * std::tanh(0.5 * k * length) + (at.depth - other->depth) / std::sinh(k * length));
  } else {
    const double length = begins ? at.s - layer_.from : layer_.to - at.s;
    rise = k * at.depth * (layer_.endless ? 1.0 : std::tanh(k * length));
  }
  return cells_[at.cell].slope(at.xi) - (begins ? rise : -rise);
}

/// Place between the samples before and at an index at which the excess falls through zero.
Place ContactSet::end_between(std::size_t sample, const Side& side) const {
  const std::size_t cell = samples_[sample].cell;
  const auto value = [&](double xi) { return excess(at(cell, xi), side); };
  const double first = start_of(sample);
  const double last = samples_[sample].xi;
  SignBracket bracket(first, value(first), last, value(last));
  for (int i = 0; i < EdgeSearch::trials && bracket.width() > EdgeSearch::place && !bracket.is_exact(); ++i) {
    const double xi = bracket.next(EdgeSearch::least_share);
    bracket.take(xi, value(xi));
  }
  return at(cell, bracket.best());
}

/// First place after a sample at which the excess falls through zero: between samples or at a bend of the
/// axis. Empty if the excess is not above zero after the sample.
std::optional<Place> ContactSet::fall_after(std::size_t sample, const Side& side) const {
  std::size_t i = sample;
  for (; i < side.reach[1] && excess_after(i, side) > 0.0; ++i)
    if (excess(samples_[i + 1], side) < 0.0) return end_between(i + 1, side);
  return i > sample ? std::optional(samples_[i]) : std::nullopt;
}

/// Last place before a sample, likewise; the sample itself if the excess is not below zero before it.
Place ContactSet::fall_before(std::size_t sample, const Side& side) const {
  std::size_t i = sample;
  for (; i > side.reach[0] && excess(samples_[i], side) < 0.0; --i)
    if (excess_after(i - 1, side) > 0.0) return end_between(i, side);
  return samples_[i];
}

/// Places the ends of all zones. The two ends of a gap depend on each other, in the second order of their
/// distance from the solution. Zones between which no gap is left are one.
void ContactSet::place_ends(std::vector<Zone>& zones) const {
  if (zones.empty()) return;
  // an end lies between the samples of the zones before and behind, in the run of its cells
  const auto reach = [&](std::size_t zone, std::size_t sample) {
    const auto [first, last] = run_of(sample);
    return std::array{zone > 0 ? std::max(zones[zone - 1].last, first) : first,
                      zone + 1 < zones.size() ? std::min(zones[zone + 1].first, last) : last};
  };
  std::vector<Zone> out{zones.front()};
  out.front().from = end_near(zones.front().first, {true, reach(0, zones.front().first), nullptr});
  for (std::size_t i = 1; i < zones.size(); ++i) {
    const Zone& left = zones[i - 1];
    const Zone& right = zones[i];
    Place to = samples_[left.last];
    Place from = samples_[right.first];
    for (int round = 0; round < EdgeSearch::rounds; ++round) {
      const double moved = to.s - from.s;
      to = end_near(left.last, {false, reach(i - 1, left.last), &from});
      from = end_near(right.first, {true, reach(i, right.first), &to});
      if (std::abs(moved - (to.s - from.s)) <= EdgeSearch::place * cells_[to.cell].contact->length()) break;
    }
    if (to.s < from.s) {
      out.back().to = to;
      out.push_back(right);
      out.back().from = from;
    }
  }
  out.back().to = end_near(zones.back().last, {false, reach(zones.size() - 1, zones.back().last), nullptr});
  zones = std::move(out);
}

LayerParts ContactSet::parts() const {
  std::vector<Zone> found = zones();
  place_ends(found);
  LayerParts out(cells_.size());
  for (Zone& zone : found) {
    if (zone.from.s > zone.to.s) zone.from = zone.to;  // rounding of a zone without length
    for (std::size_t cell = zone.from.cell; cell <= zone.to.cell; ++cell) {
      const auto [start, end] = cells_[cell].contact->range();
      const double from = cell == zone.from.cell ? zone.from.xi : start;
      const double to = cell == zone.to.cell ? zone.to.xi : end;
      out[cell].push_back({std::min(from, to), to});
    }
  }
  return out;
}

}  // namespace

double LayerCell::bend(double xi) const {
  const auto [first, last] = contact->range();
  const double low = std::max(xi - kBendStep, first);
  const double high = std::min(xi + kBendStep, last);
  return (slope(high) - slope(low)) / ((high - low) * contact->length());
}

ShearLayer layer_of(std::span<const LayerCell> cells) {
  const FoundationContact& contact = *cells.front().contact;
  return {contact.shear(), contact.modulus(), contact.endless(), cells.front().arc(contact.range()[0]),
          cells.back().arc(cells.back().contact->range()[1])};
}

LayerParts touching_parts(std::span<const LayerCell> cells) { return touching_parts(cells, layer_of(cells)); }

LayerParts touching_parts(std::span<const LayerCell> some, const ShearLayer& layer) {
  return ContactSet(some, layer).parts();
}

bool is_pressed(std::span<const LayerCell> cells, double depth) {
  std::vector<FoundationContact::DepthAt> samples;
  for (const LayerCell& cell : cells)
    cell.contact->append_samples(cell.start, cell.gradient(cell.dx), cell.gradient(cell.dy), samples);
  return std::any_of(samples.begin(), samples.end(),
                     [depth](const auto& sample) { return sample.depth > depth; });
}

std::vector<LayerEdge> edges_of(std::span<const LayerCell> cells, const LayerParts& parts) {
  const ShearLayer layer = layer_of(cells);
  const double k = layer.decay();
  const double stiffness = layer.shear * k;
  std::vector<LayerEdge> out;
  const auto arc = [&](const LayerEdge& edge) { return cells[edge.cell].arc(edge.xi); };
  const auto beside_range = [&](double length) {
    return layer.endless ? stiffness : stiffness * std::tanh(k * length);
  };
  for (std::size_t cell = 0; cell < cells.size(); ++cell) {
    const double near = EdgeSearch::one_place * cells[cell].contact->length();
    for (const ElementPart& part : parts[cell]) {
      if (!out.empty() && cells[cell].arc(part.from) - arc(out.back()) <= near) {
        out.back().cell = cell;
        out.back().xi = part.to;
        continue;
      }
      out.push_back({cell, part.from, true});
      out.push_back({cell, part.to, false});
    }
  }
  if (out.empty()) return out;
  out.front().stiffness = beside_range(arc(out.front()) - layer.from);
  out.back().stiffness = beside_range(layer.to - arc(out.back()));
  for (std::size_t i = 1; i + 1 < out.size(); i += 2) {
    const double length = k * (arc(out[i + 1]) - arc(out[i]));
    for (LayerEdge* edge : {&out[i], &out[i + 1]}) edge->stiffness = stiffness * std::tanh(0.5 * length);
    if (length > EdgeSearch::rounding) continue;
    out[i].other = static_cast<int>(i + 1);
    out[i + 1].other = static_cast<int>(i);
    out[i].compliance = out[i + 1].compliance = std::sinh(length) / stiffness;
  }
  return out;
}

namespace {

/// Forces by which penetrations, or their changes, are resisted beyond an end of contact.
double resistance(std::span<const LayerCell> penetrations, std::span<const LayerEdge> edges,
                  std::size_t index) {
  const LayerEdge& edge = edges[index];
  const double depth = penetrations[edge.cell].depth(edge.xi);
  double force = edge.stiffness * depth;
  if (edge.other >= 0) {
    const LayerEdge& other = edges[static_cast<std::size_t>(edge.other)];
    force += (depth - penetrations[other.cell].depth(other.xi)) / edge.compliance;
  }
  return force;
}

}  // namespace

double edge_force(std::span<const LayerCell> cells, std::span<const LayerEdge> edges, std::size_t index) {
  return resistance(cells, edges, index);
}

bool is_held(std::span<const LayerCell> cells, const LayerEdge& edge) {
  const auto range = cells[edge.cell].contact->range();
  return edge.xi == range[0] || edge.xi == range[1];
}

double edge_rate(std::span<const LayerCell> cells, std::span<const LayerCell> rates,
                 std::span<const LayerEdge> edges, std::size_t index) {
  const LayerEdge& edge = edges[index];
  const double pressure = cells[edge.cell].pressure(edge.xi);
  if (is_held(cells, edge) || !(pressure > 0.0)) return 0.0;
  const LayerCell& rate = rates[edge.cell];
  const double rise = resistance(rates, edges, index);
  return (rate.contact->shear() * rate.slope(edge.xi) - (edge.begins ? rise : -rise)) / pressure;
}

}  // namespace snapthrough
