#pragma once
/// @file
/// The parts of a request's model that figures draw.

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "api/plot/geometry.h"
#include "api/plot/numbers.h"
#include "solver/model/along_member.h"
#include "solver/support/surface.h"

namespace snapthrough::api::plot {

/// A point of the structure: a node, or a fraction (0 to 1) of a member's length.
struct Location {
  std::string node;  ///< empty: the point is on `member`
  std::string member;
  double fraction = 0;
};

struct ModelMember {
  std::string id, start, end;
  Axis axis;
  bool hinge_at_start = false;
  bool hinge_at_end = false;
  bool one_sided = false;  ///< carries tension alone or compression alone
  bool hangs = false;      ///< a cable, of which a model has the ends alone
};

struct ModelSupport {
  std::string node;
  bool x = false;
  bool y = false;
  bool rotation = false;
  double angle = 0;  ///< rotation of the fixed directions in degrees, counter-clockwise
};

struct ModelSpring {
  std::string id;
  Location at;
  std::optional<Location> to;      ///< other end; nullopt: the ground
  std::optional<Point> direction;  ///< unit vector into the medium; nullopt: rotational spring
  bool one_sided = false;
  double gap = 0;
};

struct ModelFoundation {
  std::string id, member;
  double side = 1;                 ///< 1: the medium is left of the member, -1: right of it
  std::optional<Point> direction;  ///< unit vector into the medium; nullopt: along the normal
  bool one_sided = false;
  bool compression_only = false;
  double gap = 0;                          ///< the largest along the member
  Along<double> gap_along;                 ///< empty: `gap` everywhere
  std::shared_ptr<const Surface> surface;  ///< surface of the medium; null: beside the member
  std::vector<Point> line;                 ///< points of that surface, where it has points
  std::array<double, 2> range = {0, 1};    ///< loaded part, as fractions of the member's length
};

struct ModelLoad {
  enum class Type { point, distributed, pressure, initial_strain, temperature, self_weight };
  Type type = Type::point;
  Location at;              ///< location of a point load; other loads: only its member is set
  Point force;              ///< force of a point load; per length for a distributed one
  bool follows = false;     ///< a point load turns with its place
  bool fixed_line = false;  ///< a point load stays on its line
  double moment = 0;
  double value = 0;  ///< pressure, positive when it pushes from `side`
  double side = 1;   ///< pressure acts on the left (1) or right (-1) side
  std::array<double, 2> range = {0, 1};
  std::string per;  ///< reference length of a distributed load: "length", "horizontal", "vertical"
  /// [fraction, x component, y component] of a force, [fraction, pressure, 0] of a pressure that varies;
  /// empty: the same everywhere. `force` or `value` is then the largest.
  std::vector<std::array<double, 3>> force_along;
  bool member_axes = false;  ///< a distributed load in axes of its member
  double axial = 0;          ///< strain, or change of temperature; NaN: varies along the member
  double curvature = 0;      ///< curvature, or gradient of temperature
  bool constant = false;     ///< true: the load factor does not multiply the load
};

struct ModelMonitor {
  std::string id;
  Location at;
  std::string component;  ///< direction: "x", "y", "rotation" or "normal"
};

/// The model of a request, with members in the order of the request.
struct Model {
  std::vector<ModelMember> members;
  std::map<std::string, Point> nodes;
  std::vector<ModelSupport> supports;
  std::vector<ModelSpring> springs;
  std::vector<ModelFoundation> foundations;
  std::vector<ModelLoad> loads;
  std::vector<ModelMonitor> monitors;

  [[nodiscard]] const ModelMonitor* monitor(const std::string& id) const;
};

/// Returns the direction of positive or negative values of a monitor in words, such as "up" or "down".
[[nodiscard]] std::string sense_of(const ModelMonitor& monitor, bool negative);

/// @brief Reads a model.
/// @throws PlotError when the model is invalid
[[nodiscard]] Model read_model(const Field& field);

}  // namespace snapthrough::api::plot
