#pragma once
/// @file
/// The parts of a request's model that figures show.

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "api/plot/geometry.h"
#include "api/plot/numbers.h"

namespace snapthrough::api::plot {

/// A place on the structure: a node, or a fraction of a member's length.
struct Location {
  std::string node;  ///< empty: on the member
  std::string member;
  double fraction = 0;
};

struct ModelMember {
  std::string id, start, end;
  Axis axis;
  bool hinge_at_start = false;
  bool hinge_at_end = false;
};

struct ModelSupport {
  std::string node;
  bool x = false;
  bool y = false;
  bool rotation = false;
  double angle = 0;  ///< degrees, counter-clockwise
};

struct ModelSpring {
  std::string id;
  Location at;
  std::optional<Point> direction;  ///< into the medium; nothing: a rotational spring
  bool one_sided = false;
  double gap = 0;
};

struct ModelFoundation {
  std::string id, member;
  double side = 1;                 ///< 1: the medium is on the member's left, -1: on its right
  std::optional<Point> direction;  ///< of unit length, where the medium has a direction of its own
  bool one_sided = false;
  bool compression_only = false;
  double gap = 0;
  std::pair<double, double> range = {0, 1};  ///< fractions of the member's length
};

struct ModelLoad {
  enum class Type { point, distributed, pressure, initial_strain };
  Type type = Type::point;
  Location at;  ///< of the others the member
  Point force;  ///< per length for a distributed one
  double moment = 0;
  double value = 0;  ///< of a pressure, positive from its side
  double side = 1;   ///< of a pressure: 1: it acts on the left side
  std::pair<double, double> range = {0, 1};
  std::string per;  ///< of a distributed one: "length", "horizontal", "vertical"
  double axial = 0;
  double curvature = 0;
  bool constant = false;  ///< not multiplied by the load factor
};

struct ModelMonitor {
  std::string id;
  Location at;
  std::string component;  ///< "x", "y", "rotation", "normal"
};

/// The model of a request; members in the request's order.
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

/// The sense of positive values of a monitor in words, or that of negative ones: "up", "down".
[[nodiscard]] std::string sense_of(const ModelMonitor& monitor, bool negative);

/// @brief Reads the model of a request document.
/// @throws PlotError with a pointer that begins with "request:"
[[nodiscard]] Model read_model(const nlohmann::json& request);

}  // namespace snapthrough::api::plot
