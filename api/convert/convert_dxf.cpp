/// Joins the segments of a drawing to members and nodes.

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#include "api/convert/convert.h"
#include "api/convert/dxf_joints.h"
#include "api/convert/dxf_segments.h"
#include "solver/check/check_place.h"
#include "solver/model/limits.h"
#include "solver/numeric/work_limit.h"

namespace snapthrough::api {

namespace convert {
namespace {

using nlohmann::json;
using Point = PlanePoint;

/// Part of the drawing's size within which end points join by default.
constexpr double kRelativeTolerance = 1e-6;
/// Rounding of a coordinate, in parts of the largest number that it was computed from: some operations of a
/// drawing program and of an arc's ends.
constexpr double kRelativeRounding = 64.0 * std::numeric_limits<double>::epsilon();

/// @brief Nodes of a drawing. A point within the tolerance of a node is the nearest such node, else it is a
/// new node.
///
/// Cells of the size of the tolerance hold the nodes, so that only nine cells are searched for a point.
class NodeSet {
 public:
  explicit NodeSet(double tolerance) : tolerance_(tolerance) {}

  /// Returns the index of a point's node.
  std::size_t index_of(const Point& point) {
    const Cell cell{std::floor(point[0] / tolerance_), std::floor(point[1] / tolerance_)};
    std::size_t nearest = points_.size();
    double least = tolerance_;
    for (const double dx : {-1.0, 0.0, 1.0}) {
      for (const double dy : {-1.0, 0.0, 1.0}) {
        find_nearest({cell.first + dx, cell.second + dy}, point, nearest, least);
      }
    }
    if (nearest == points_.size()) {
      points_.push_back(point);
      cells_[cell].push_back(nearest);
    }
    return nearest;
  }

  [[nodiscard]] const std::vector<Point>& points() const { return points_; }

 private:
  using Cell = std::pair<double, double>;

  void find_nearest(const Cell& cell, const Point& point, std::size_t& nearest, double& least) const {
    const auto found = cells_.find(cell);
    if (found == cells_.end()) {
      return;
    }
    for (const std::size_t i : found->second) {
      WorkLimit::poll();
      const double distance = std::hypot(points_[i][0] - point[0], points_[i][1] - point[1]);
      if (distance <= least) {
        least = distance;
        nearest = i;
      }
    }
  }

  double tolerance_;
  std::vector<Point> points_;
  std::map<Cell, std::vector<std::size_t>> cells_;
};

/// Returns the larger side of the rectangle around all end points; 0 without points.
double size_of(const std::vector<Segment>& segments) {
  double size = 0.0;
  for (const std::size_t axis : {std::size_t{0}, std::size_t{1}}) {
    double least = std::numeric_limits<double>::infinity();
    double largest = -least;
    for (const Segment& segment : segments) {
      least = std::min({least, segment.start[axis], segment.end[axis]});
      largest = std::max({largest, segment.start[axis], segment.end[axis]});
    }
    size = std::max(size, largest - least);
  }
  return size;
}

double tolerance_of(const DxfOptions& options, const std::vector<Segment>& segments) {
  const double size = size_of(segments);
  return options.tolerance.value_or(size > 0.0 ? kRelativeTolerance * size : 1.0);
}

/// Returns the distance that rounding may put between the ends of two segments that are meant to meet.
double rounding_of(const std::vector<Segment>& segments) {
  double largest = 0.0;
  for (const Segment& segment : segments) {
    largest = std::max({largest, segment.extent, std::abs(segment.start[0]), std::abs(segment.start[1]),
                        std::abs(segment.end[0]), std::abs(segment.end[1])});
  }
  return kRelativeRounding * largest;
}

/// Reports layers that were asked for and have no segment.
void require_layers(const DxfOptions& options, const std::vector<Segment>& segments,
                    std::vector<Finding>& findings) {
  for (const std::string& layer : options.layers) {
    WorkLimit::poll();
    if (std::none_of(segments.begin(), segments.end(),
                     [&](const Segment& segment) { return segment.layer == layer; })) {
      findings.push_back({"--layer", "unknown_reference",
                          "the drawing has no line, arc or polyline on layer " + checks::in_quotes(layer)});
    }
  }
  if (options.layers.empty() && segments.empty()) {
    findings.push_back({"ENTITIES", "missing_field", "the drawing has no line, arc or polyline"});
  }
}

json sections_of(const std::vector<Segment>& segments, std::vector<Finding>& findings) {
  checks::Ids ids("section");
  json sections = json::array();
  const Segment* before = nullptr;
  for (const Segment& segment : segments) {
    WorkLimit::poll();
    // Segments of one polyline have one text in the file, which may be long.
    const bool same = before != nullptr && before->layer.data() == segment.layer.data();
    before = &segment;
    if (!same && !ids.contains(segment.layer)) {
      ids.add(checks::Place(PointerPath("line " + std::to_string(segment.line)), findings), segment.layer);
      sections.push_back({{"id", segment.layer}});
    }
  }
  return sections;
}

/// Returns ids for numbers from 1.
std::string id_of(std::size_t index) { return std::to_string(index + 1); }

/// Joins the ends of the segments to nodes; a piece is a whole segment.
std::vector<Piece> pieces_of(const std::vector<Segment>& segments, double tolerance, NodeSet& nodes,
                             Moves& moves, std::vector<Finding>& findings) {
  std::vector<Piece> pieces;
  const auto node_at = [&](const Point& end, const Segment& segment) {
    const std::size_t node = nodes.index_of(end);
    const Point& at = nodes.points()[node];
    moves.add(std::hypot(at[0] - end[0], at[1] - end[1]), end, segment);
    return static_cast<int>(node);
  };
  for (const Segment& segment : segments) {
    WorkLimit::poll();
    const int start = node_at(segment.start, segment);
    const int end = node_at(segment.end, segment);
    if (start == end) {
      findings.push_back(finding_at(
          segment.line, "zero_length",
          "the ends are one node, because they are within the tolerance " + checks::text(tolerance)));
    }
    if (segment.elevation > tolerance) {
      findings.push_back(finding_at(segment.line, "out_of_range",
                                    "z must be 0 within the tolerance " + checks::text(tolerance)));
    }
    pieces.push_back({&segment, start, end, segment.sweep_degrees});
  }
  return pieces;
}

json members_of(const std::vector<Piece>& pieces) {
  json members = json::array();
  for (const Piece& piece : pieces) {
    json member{{"id", id_of(members.size())},
                {"start", id_of(static_cast<std::size_t>(piece.start))},
                {"end", id_of(static_cast<std::size_t>(piece.end))},
                {"section", piece.drawn->layer}};
    if (piece.sweep_degrees != 0.0) {
      member["curve"] = {{"type", "arc"}, {"sweep_degrees", piece.sweep_degrees}};
    }
    members.push_back(std::move(member));
  }
  return members;
}

json nodes_of(const NodeSet& nodes) {
  json list = json::array();
  for (const Point& point : nodes.points()) {
    list.push_back({{"id", id_of(list.size())}, {"x", point[0]}, {"y", point[1]}});
  }
  return list;
}

Finding too_many(const char* what, std::size_t most) {
  return {"ENTITIES", "too_many", "a drawing may give at most " + std::to_string(most) + " " + what};
}

/// Adds nodes and members to the parts of a model, and warnings.
void join(const std::vector<Segment>& segments, const DxfOptions& options, json& parts,
          Conversion& conversion) {
  std::vector<Finding>& findings = conversion.findings;
  const double tolerance = tolerance_of(options, segments);
  const double rounding = rounding_of(segments);
  NodeSet nodes(tolerance);
  Moves moves(rounding);
  std::vector<Piece> pieces = pieces_of(segments, tolerance, nodes, moves, findings);
  if (nodes.points().size() > kMaxNodes) {
    findings.push_back(too_many("nodes", kMaxNodes));
  }
  if (!findings.empty()) {
    return;
  }
  std::vector<Warning>& warnings = conversion.warnings;
  moves.warn("joined_ends", "end is joined to a node at other coordinates",
             "ends are joined to nodes at other coordinates",
             "ends within the tolerance " + rounded(tolerance) + " are one node at the first of them",
             warnings);
  pieces = joints({std::move(pieces), PointTree(nodes.points()), nodes.points().size(), tolerance, rounding,
                   options.join_tees},
                  warnings);
  if (pieces.size() > kMaxMembers) {
    findings.push_back(too_many("members", kMaxMembers));
    return;
  }
  parts["members"] = members_of(pieces);
  parts["nodes"] = nodes_of(nodes);
}

}  // namespace
}  // namespace convert

Conversion convert_dxf(std::string_view text, const DxfOptions& options) {
  Conversion conversion;
  std::vector<Finding>& findings = conversion.findings;
  const std::vector<convert::Entity> entities = convert::read_entities(text, findings);
  if (!findings.empty()) {
    return conversion;
  }
  const std::vector<convert::Segment> segments = convert::read_segments(entities, options.layers, findings);
  if (findings.empty()) {
    convert::require_layers(options, segments, findings);
  }
  if (!findings.empty()) {
    return conversion;
  }
  nlohmann::json parts;
  parts["sections"] = convert::sections_of(segments, findings);
  if (!findings.empty()) {
    return conversion;  // each member would repeat the name of its layer, however long it is
  }
  convert::join(segments, options, parts, conversion);
  if (findings.empty()) {
    conversion.document = std::make_shared<nlohmann::json>(std::move(parts));
  }
  return conversion;
}

}  // namespace snapthrough::api
