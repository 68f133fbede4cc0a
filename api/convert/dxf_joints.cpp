#include "api/convert/dxf_joints.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <utility>

#include "solver/geometry/axis_curve.h"
#include "solver/model/limits.h"
#include "solver/numeric/work_limit.h"

namespace snapthrough::api::convert {

namespace {

constexpr int kCoordinateDigits = 9;  ///< digits of a coordinate in messages

double distance_of(const PlanePoint& a, const PlanePoint& b) { return std::hypot(b[0] - a[0], b[1] - a[1]); }

std::string tolerance_remedy(const DrawnPieces& drawn) {
  return "ends are joined within --tolerance, which is " + rounded(drawn.tolerance);
}

std::string repetition(const Piece& piece, const Piece& before, const PointTree& nodes) {
  return "line " + std::to_string(piece.drawn->line) + " on line " + std::to_string(before.drawn->line) +
         " from " + place_of(nodes[piece.start]) + " to " + place_of(nodes[piece.end]);
}

/// Ends on segments, and how far they are from them.
class TeeSearch {
 public:
  explicit TeeSearch(const DrawnPieces& drawn)
      : drawn_(drawn), shortest_(shortest_at_nodes(drawn)), moves_(drawn.rounding) {}

  [[nodiscard]] std::vector<Piece> run(std::vector<Warning>& warnings);

 private:
  struct Tee {
    double fraction;
    int node;
  };
  /// Returns the ends on a piece in their order along it.
  std::vector<Tee> tees_on(const Piece& piece);
  /// Notes a node that is near a piece and farther from it than the tolerance.
  void consider_near(const Piece& piece, double chord, int node, double distance);
  void divide(const Piece& piece, const std::vector<Tee>& tees);
  void warn(std::vector<Warning>& warnings) const;

  const DrawnPieces& drawn_;
  std::vector<double> shortest_;
  std::vector<Piece> parts_;
  Places unjoined_;
  Places near_;
  Moves moves_;
};

std::vector<TeeSearch::Tee> TeeSearch::tees_on(const Piece& piece) {
  const PointTree& nodes = drawn_.nodes;
  const Shape shape = shape_of(piece, nodes);
  std::vector<int> found;
  const double reach = std::max(drawn_.tolerance, kNear * shape.chord);
  nodes.near(nodes[piece.start], nodes[piece.end], std::abs(shape.rise) + reach, found);
  std::erase_if(found, [&](int i) {
    return i == piece.start || i == piece.end || !(distance_from(shape, nodes[i]) <= reach);
  });
  std::sort(found.begin(), found.end());
  std::vector<Tee> tees;
  for (const int i : found) {
    WorkLimit::poll();
    const double distance = distance_from(shape, nodes[i]);
    const double fraction = fraction_at(shape, nodes[i]);
    if (!(fraction > 0.0 && fraction < 1.0)) {
      continue;
    }
    if (distance > drawn_.tolerance) {
      consider_near(piece, shape.chord, i, distance);
      continue;
    }
    tees.push_back({fraction, i});
    unjoined_.add([&] { return place_of(nodes[i]) + " on " + name_of(piece); });
    moves_.add(distance, nodes[i], *piece.drawn);
  }
  std::sort(tees.begin(), tees.end(), [](const Tee& a, const Tee& b) { return a.fraction < b.fraction; });
  return tees;
}

void TeeSearch::consider_near(const Piece& piece, double chord, int node, double distance) {
  const PointTree& nodes = drawn_.nodes;
  const double near = kNear * std::min(chord, shortest_[static_cast<std::size_t>(node)]);
  const bool at_end = distance_of(nodes[node], nodes[piece.start]) <= near ||
                      distance_of(nodes[node], nodes[piece.end]) <= near;
  if (distance <= near && !at_end) {
    near_.add([&] {
      return place_of(nodes[node]) + " at a distance of " + rounded(distance) + " from " + name_of(piece);
    });
  }
}

void TeeSearch::divide(const Piece& piece, const std::vector<Tee>& tees) {
  int start = piece.start;
  double from = 0.0;
  for (const Tee& tee : tees) {
    parts_.push_back({piece.drawn, start, tee.node, piece.sweep_degrees * (tee.fraction - from)});
    start = tee.node;
    from = tee.fraction;
  }
  parts_.push_back({piece.drawn, start, piece.end, piece.sweep_degrees * (1.0 - from)});
}

void TeeSearch::warn(std::vector<Warning>& warnings) const {
  if (drawn_.join_tees) {
    moves_.warn("tees_moved", "segment is divided at an end that is not exactly on it",
                "segments are divided at ends that are not exactly on them", "the parts go through the ends",
                warnings);
  } else {
    unjoined_.warn("tee_unjoined", "end lies on a segment that it is not joined to",
                   "ends lie on segments that they are not joined to",
                   "--join-tees divides the segments there", warnings);
  }
  near_.warn("tee_unjoined", "end lies almost on a segment and is not joined to it",
             "ends lie almost on segments and are not joined to them", tolerance_remedy(drawn_), warnings);
}

std::vector<Piece> TeeSearch::run(std::vector<Warning>& warnings) {
  for (const Piece& piece : drawn_.pieces) {
    WorkLimit::poll();
    const std::vector<Tee> tees = tees_on(piece);
    divide(piece, drawn_.join_tees ? tees : std::vector<Tee>());
    if (parts_.size() > kMaxMembers) {
      break;  // the drawing is refused
    }
  }
  warn(warnings);
  return std::move(parts_);
}

}  // namespace

void Places::warn(const char* code, const char* one, const char* several, const std::string& remedy,
                  std::vector<Warning>& out) const {
  if (count_ == 0) {
    return;
  }
  const std::size_t more = count_ - std::min<std::size_t>(count_, MessageLimits::items);
  out.push_back({code, std::to_string(count_) + " " + (count_ == 1 ? one : several) + ": " + text_ +
                           (more > 0 ? " and " + std::to_string(more) + " more" : "") + "; " + remedy});
}

void Moves::add(double distance, const PlanePoint& from, const Segment& drawn) {
  if (distance <= rounding_) {
    return;
  }
  ++count_;
  if (distance > farthest_) {
    farthest_ = distance;
    from_ = from;
    line_ = drawn.line;
  }
}

void Moves::warn(const char* code, const char* one, const char* several, const std::string& remedy,
                 std::vector<Warning>& out) const {
  if (count_ > 0) {
    out.push_back({code, std::to_string(count_) + " " + (count_ == 1 ? one : several) +
                             ", the farthest at a distance of " + rounded(farthest_) + ": " +
                             place_of(from_) + " at the segment of line " + std::to_string(line_) + "; " +
                             remedy});
  }
}

std::string place_of(const PlanePoint& point) {
  return "(" + rounded(point[0], kCoordinateDigits) + ", " + rounded(point[1], kCoordinateDigits) + ")";
}

std::string name_of(const Piece& piece) { return "the segment of line " + std::to_string(piece.drawn->line); }

Shape shape_of(const Piece& piece, const PointTree& nodes) {
  const PlanePoint& a = nodes[piece.start];
  const PlanePoint& b = nodes[piece.end];
  const Curve curve = piece.sweep_degrees == 0.0 ? Curve(LineCurve{}) : Curve(ArcCurve{piece.sweep_degrees});
  const AxisCurve axis(curve, a, b);
  const AxisPoint start = axis.at(0.0);
  const double chord = distance_of(a, b);
  return {a,
          {std::cos(start.angle), std::sin(start.angle)},
          start.curvature,
          axis.length(),
          chord,
          0.5 * chord * std::tan(0.25 * piece.sweep_degrees * std::numbers::pi / 180.0)};
}

double distance_from(const Shape& shape, const PlanePoint& point) {
  const double dx = point[0] - shape.start[0];
  const double dy = point[1] - shape.start[1];
  const double left = dy * shape.tangent[0] - dx * shape.tangent[1];
  const double k = shape.curvature;
  // r - sqrt((r - left)^2 + along^2) without the difference of long radii
  const double g = left - 0.5 * k * (dx * dx + dy * dy);
  return std::abs(2.0 * g / (1.0 + std::sqrt(std::max(0.0, 1.0 - 2.0 * k * g))));
}

double fraction_at(const Shape& shape, const PlanePoint& point) {
  const double dx = point[0] - shape.start[0];
  const double dy = point[1] - shape.start[1];
  const double along = dx * shape.tangent[0] + dy * shape.tangent[1];
  const double left = dy * shape.tangent[0] - dx * shape.tangent[1];
  const double k = std::abs(shape.curvature);
  if (k == 0.0) {
    return along / shape.length;
  }
  const double turned = std::atan2(k * along, 1.0 - shape.curvature * left);
  return (turned < 0.0 ? turned + 2.0 * std::numbers::pi : turned) / (k * shape.length);
}

std::vector<Piece> without_duplicates(const DrawnPieces& drawn, Places& dropped, Places& stacked) {
  struct Kept {
    std::size_t index;
    double rise;  ///< to the right of the line from the node of lower number
  };
  std::vector<Piece> kept;
  std::map<std::pair<int, int>, std::vector<Kept>> between;
  for (const Piece& piece : drawn.pieces) {
    std::vector<Kept>& others = between[std::minmax(piece.start, piece.end)];
    const double rise = (piece.start < piece.end ? 1.0 : -1.0) * shape_of(piece, drawn.nodes).rise;
    const Piece* same = nullptr;
    for (const Kept& other : others) {
      WorkLimit::poll();
      const Piece& before = kept[other.index];
      // two arcs between the same ends are farthest from each other at their middles
      if (std::abs(rise - other.rise) <= drawn.tolerance &&
          (same == nullptr || before.drawn->layer == piece.drawn->layer)) {
        same = &before;
      }
    }
    const bool repeats = same != nullptr && same->drawn->layer == piece.drawn->layer;
    if (same != nullptr) {
      (repeats ? dropped : stacked).add([&] { return repetition(piece, *same, drawn.nodes); });
    }
    if (!repeats) {
      others.push_back({kept.size(), rise});
      kept.push_back(piece);
    }
  }
  return kept;
}

std::vector<Piece> with_tees(const DrawnPieces& drawn, std::vector<Warning>& warnings) {
  return TeeSearch(drawn).run(warnings);
}

std::vector<double> shortest_at_nodes(const DrawnPieces& drawn) {
  std::vector<double> shortest(drawn.node_count, std::numeric_limits<double>::infinity());
  for (const Piece& piece : drawn.pieces) {
    const double chord = distance_of(drawn.nodes[piece.start], drawn.nodes[piece.end]);
    for (const int end : {piece.start, piece.end}) {
      double& least = shortest[static_cast<std::size_t>(end)];
      least = std::min(least, chord);
    }
  }
  return shortest;
}

void tell_near_nodes(const DrawnPieces& drawn, std::vector<Warning>& warnings) {
  const std::vector<double> shortest = shortest_at_nodes(drawn);
  Places near;
  std::vector<int> found;
  for (int i = 0; i < static_cast<int>(shortest.size()); ++i) {
    found.clear();
    const double reach = kNear * shortest[static_cast<std::size_t>(i)];
    drawn.nodes.near(drawn.nodes[i], drawn.nodes[i], reach, found);
    std::sort(found.begin(), found.end());
    for (const int j : found) {
      WorkLimit::poll();
      const double distance = distance_of(drawn.nodes[i], drawn.nodes[j]);
      if (j > i && distance <= kNear * shortest[static_cast<std::size_t>(j)]) {
        near.add([&] {
          return place_of(drawn.nodes[i]) + " and " + place_of(drawn.nodes[j]) + " at a distance of " +
                 rounded(distance);
        });
      }
    }
  }
  near.warn("near_nodes", "pair of ends lies in almost one place and is not joined",
            "pairs of ends lie in almost one place and are not joined", tolerance_remedy(drawn), warnings);
}

std::vector<Piece> joints(DrawnPieces drawn, std::vector<Warning>& warnings) {
  Places dropped;
  Places stacked;
  drawn.pieces = without_duplicates(drawn, dropped, stacked);
  tell_near_nodes(drawn, warnings);
  tell_crossings(drawn, warnings);
  std::vector<Piece> parts = with_tees(drawn, warnings);
  const bool divided = parts.size() > drawn.pieces.size();
  drawn.pieces = std::move(parts);
  if (drawn.pieces.size() > kMaxMembers) {
    return std::move(drawn.pieces);
  }
  if (divided) {
    // the second pass finds again what lies on another layer
    stacked = Places();
    drawn.pieces = without_duplicates(drawn, dropped, stacked);
  }
  dropped.warn("duplicates_dropped", "segment is drawn twice and is left out",
               "segments are drawn twice and are left out", "each stays once", warnings);
  stacked.warn("stacked_members", "segment lies on one of another layer",
               "segments lie on ones of another layer", "they act side by side, each with its section",
               warnings);
  return std::move(drawn.pieces);
}

}  // namespace snapthrough::api::convert
