#include "api/convert/dxf_segments.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "api/api.h"
#include "solver/check/check_place.h"
#include "solver/model/limits.h"
#include "solver/numeric/work_limit.h"

namespace snapthrough::api::convert {

namespace {

constexpr double kDegrees = std::numbers::pi / 180.0;
constexpr double kFullTurn = 360.0;

// Flags of group code 70.
constexpr int kClosed = 1;
constexpr int kLineTypePattern = 128;  ///< has no influence on the geometry

/// Vertex of a polyline.
struct Vertex {
  std::size_t line = 0;
  std::array<double, 2> at{};
  double bulge = 0.0;  ///< tangent of a quarter of the angle to the next vertex, positive to the left
  double elevation = 0.0;
};

/// Reads entities one after the other and collects their segments.
class SegmentReader {
 public:
  SegmentReader(std::span<const Entity> entities, std::span<const std::string> layers,
                std::vector<Finding>& findings)
      : entities_(entities), layers_(layers), findings_(findings) {}

  std::vector<Segment> read();

 private:
  [[nodiscard]] bool is_wanted(const Entity& entity) const;
  /// Returns the vertices that follow a POLYLINE, up to SEQEND, and moves `next_` behind them.
  std::span<const Entity> take_vertices();

  void read_line(const Entity& entity);
  void read_arc(const Entity& entity);
  void read_light_polyline(const Entity& entity);
  void read_polyline(const Entity& entity, std::span<const Entity> vertices);
  void add(const Entity& entity, const std::vector<Vertex>& vertices);

  double number(const Entity& entity, int code) { return entity.number(code, std::nullopt, findings_); }
  double optional(const Entity& entity, int code, double otherwise) {
    return entity.number(code, otherwise, findings_);
  }
  /// Returns the flags of an entity without those that have no influence; reports a closed curve.
  int flags(const Entity& entity);
  /// Returns whether a drawing with the vertices read so far has too many findings, or too many members.
  [[nodiscard]] bool is_full(std::size_t vertices) const {
    return findings_.size() >= static_cast<std::size_t>(kMaxFindings) ||
           segments_.size() + vertices > kMaxMembers + 2;
  }
  void report(std::size_t line, std::string_view code, std::string detail) {
    findings_.push_back(finding_at(line, code, std::move(detail)));
  }
  void report_unsupported(const Entity& entity, const std::string& what) {
    report(entity.line, "unsupported",
           what + " is not supported; a drawing gives members by LINE, ARC, LWPOLYLINE and POLYLINE");
  }

  std::span<const Entity> entities_;
  std::span<const std::string> layers_;
  std::vector<Finding>& findings_;
  std::size_t next_ = 0;  ///< index of the next entity
  std::vector<Segment> segments_;
};

std::string_view layer_of(const Entity& entity) { return entity.text(8, "0"); }

bool SegmentReader::is_wanted(const Entity& entity) const {
  constexpr std::string_view kPaperSpace = "1";
  return entity.text(67, "0") != kPaperSpace &&
         (layers_.empty() || std::find(layers_.begin(), layers_.end(), layer_of(entity)) != layers_.end());
}

std::span<const Entity> SegmentReader::take_vertices() {
  const std::size_t first = next_;
  while (next_ < entities_.size() && entities_[next_].type == "VERTEX") {
    ++next_;
  }
  const auto vertices = entities_.subspan(first, next_ - first);
  next_ += next_ < entities_.size() && entities_[next_].type == "SEQEND" ? 1 : 0;
  return vertices;
}

int SegmentReader::flags(const Entity& entity) {
  const int all = static_cast<int>(std::clamp(optional(entity, 70, 0.0), 0.0, 65535.0));
  if ((all & kClosed) != 0) {
    report(entity.line, "closed",
           "a closed " + std::string(entity.type) +
               " has no ends: open it by a last vertex that repeats the first");
  }
  return all & ~(kClosed | kLineTypePattern);
}

void SegmentReader::read_line(const Entity& entity) {
  const double z = std::max(std::abs(optional(entity, 30, 0.0)), std::abs(optional(entity, 31, 0.0)));
  segments_.push_back({entity.line,
                       layer_of(entity),
                       {number(entity, 10), number(entity, 20)},
                       {number(entity, 11), number(entity, 21)},
                       0.0,
                       z});
}

void SegmentReader::read_arc(const Entity& entity) {
  const std::array<double, 2> centre{number(entity, 10), number(entity, 20)};
  const double radius = number(entity, 40);
  const double from = number(entity, 50);
  const double to = number(entity, 51);
  const double turn = std::fmod(to - from, kFullTurn);
  const auto point_at = [&](double angle) {
    return std::array{centre[0] + radius * std::cos(angle * kDegrees),
                      centre[1] + radius * std::sin(angle * kDegrees)};
  };
  if (turn == 0.0) {
    report(entity.line, "closed", "the arc is a full circle, which has no ends: draw it as two arcs");
  }
  segments_.push_back({entity.line, layer_of(entity), point_at(from), point_at(to),
                       turn > 0.0 ? turn : turn + kFullTurn, std::abs(optional(entity, 30, 0.0)),
                       std::max(std::abs(centre[0]), std::abs(centre[1])) + std::abs(radius)});
}

/// Reads LWPOLYLINE, in which code 10 begins a vertex.
void SegmentReader::read_light_polyline(const Entity& entity) {
  flags(entity);
  const double elevation = std::abs(optional(entity, 38, 0.0));
  std::vector<Vertex> vertices;
  for (const Group& group : entity.groups) {
    if (is_full(vertices.size())) {
      break;
    }
    if (group.code == 10) {
      vertices.push_back({group.line, {number_of(group, findings_), 0.0}, 0.0, elevation});
    } else if (group.code == 20 && !vertices.empty()) {
      vertices.back().at[1] = number_of(group, findings_);
    } else if (group.code == 42 && !vertices.empty()) {
      vertices.back().bulge = number_of(group, findings_);
    }
  }
  add(entity, vertices);
}

void SegmentReader::read_polyline(const Entity& entity, std::span<const Entity> vertices) {
  if (flags(entity) != 0) {
    return report_unsupported(entity, "a POLYLINE in space, with a mesh or with a fitted curve");
  }
  std::vector<Vertex> corners;
  for (const Entity& vertex : vertices) {
    if (is_full(corners.size())) {
      break;
    }
    corners.push_back({vertex.line,
                       {number(vertex, 10), number(vertex, 20)},
                       optional(vertex, 42, 0.0),
                       std::abs(optional(vertex, 30, 0.0))});
  }
  add(entity, corners);
}

/// Adds the segments between vertices.
void SegmentReader::add(const Entity& entity, const std::vector<Vertex>& vertices) {
  if (vertices.size() < 2) {
    report(entity.line, "zero_length", std::string(entity.type) + " needs two vertices");
  }
  const std::string_view layer = layer_of(entity);  // searches all groups
  for (std::size_t i = 0; i + 1 < vertices.size(); ++i) {
    segments_.push_back({vertices[i].line, layer, vertices[i].at, vertices[i + 1].at,
                         4.0 * std::atan(vertices[i].bulge) / kDegrees,
                         std::max(vertices[i].elevation, vertices[i + 1].elevation)});
  }
}

std::vector<Segment> SegmentReader::read() {
  while (next_ < entities_.size() && findings_.size() < static_cast<std::size_t>(kMaxFindings)) {
    WorkLimit::poll();
    const Entity& entity = entities_[next_++];
    const auto vertices = entity.type == "POLYLINE" ? take_vertices() : std::span<const Entity>();
    if (!is_wanted(entity)) {
      continue;
    }
    if (optional(entity, 210, 0.0) != 0.0 || optional(entity, 220, 0.0) != 0.0 ||
        optional(entity, 230, 1.0) != 1.0) {
      report(entity.line, "unsupported",
             std::string(entity.type) + " must be drawn in the x-y plane, with extrusion direction 0, 0, 1");
    } else if (entity.type == "LINE") {
      read_line(entity);
    } else if (entity.type == "ARC") {
      read_arc(entity);
    } else if (entity.type == "LWPOLYLINE") {
      read_light_polyline(entity);
    } else if (entity.type == "POLYLINE") {
      read_polyline(entity, vertices);
    } else {
      report_unsupported(entity, std::string(entity.type));
    }
    if (segments_.size() > kMaxMembers) {
      report(entity.line, "too_many",
             "a drawing may give at most " + std::to_string(kMaxMembers) + " members");
      break;
    }
  }
  return std::move(segments_);
}

}  // namespace

std::vector<Segment> read_segments(std::span<const Entity> entities, std::span<const std::string> layers,
                                   std::vector<Finding>& findings) {
  return SegmentReader(entities, layers, findings).read();
}

}  // namespace snapthrough::api::convert
