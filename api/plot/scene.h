#pragma once
/// @file
/// The members of a drawing with undeformed and deformed axes, and the transformation from model axes to
/// pixels.

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "api/plot/model.h"
#include "api/plot/result.h"
#include "api/plot/shape.h"

namespace snapthrough::api::plot {

/// Axes of a member; lists of equal length, at least two.
struct DrawnMember {
  std::string id;
  std::vector<double> s, x0, y0, x, y;  ///< arc length, undeformed axis (x0, y0), deformed axis (x, y)
  std::vector<Point> normals;           ///< left normals of the undeformed axis
  std::vector<double> normal_x, normal_y;
};

/// A node and the members that end at it.
struct Joint {
  Point still;
  Point moved;
  std::vector<Point> leaving;  ///< unit tangents of the undeformed members, away from the node
};

/// The force of a support on the structure and its point of application.
struct SupportForce {
  Point at;
  double fx = 0;
  double fy = 0;
};

/// A rectangle in model axes, y up.
struct ModelBox {
  double left, right, bottom, top;
  ModelBox();
  void include(double x, double y);
  [[nodiscard]] bool empty() const { return !(left <= right && bottom <= top); }
};

struct SceneInput {
  const Model* model = nullptr;  ///< null: the model is not given
  const State* state = nullptr;  ///< null: the undeformed structure is drawn
  const Mode* mode = nullptr;
  Units units;
  double factor = 1;  ///< factor of displacements
  std::optional<double> load_factor;
};

struct Scene {
  SceneInput input;
  std::vector<DrawnMember> members;
  std::map<std::string, Joint> joints;       ///< joints by node id; empty without a model
  std::vector<ModelFoundation> foundations;  ///< from the model, or found by foundations_of()
  std::vector<SupportForce> support_forces;  ///< support forces found in the state; empty with a model
  ModelBox box;
  std::optional<double> mirror;  ///< x of the symmetry axis of a half structure
  double extent = 1;             ///< larger side of the undeformed structure's bounding box
  double depth = 0;              ///< depth of the drawn ground in model units

  [[nodiscard]] const DrawnMember* member(const std::string& id) const;
  [[nodiscard]] double load_factor() const { return input.load_factor.value_or(1); }
};

/// Builds the scene. @pre the state or the model is given
/// @throws PlotError when a member of the state or the mode is missing in the model
[[nodiscard]] Scene make_scene(const SceneInput& input);

/// Map from model axes to pixels: pixel = (left + scale x, top - scale y).
struct View {
  double scale = 1;
  double left = 0;
  double top = 0;
};

[[nodiscard]] Pixel to_pixel(const View& view, Point point);
[[nodiscard]] std::vector<Pixel> to_pixels(const View& view, const std::vector<double>& x,
                                           const std::vector<double>& y);

/// The way from a point of an undeformed axis to a medium.
struct Way {
  Point into;      ///< unit direction
  double gap = 0;  ///< distance to the surface, negative below it
};
/// @param s arc length of the undeformed axis
[[nodiscard]] Way way_into(const ModelFoundation& foundation, const DrawnMember& member, double s);

/// Returns the bounding box of structure and ground in model axes, including the mirror image.
[[nodiscard]] ModelBox box_with_ground(const Scene& scene);
/// Returns `size` with its height reduced to that of the drawing.
[[nodiscard]] Size needed_size(const Scene& scene, Size size);
/// Returns the view that fits the structure with ground, loads, supports and dimensions into `size`.
[[nodiscard]] View scene_view(const Scene& scene, Size size);

/// A point on a member: undeformed and deformed position, undeformed left normal, deformed unit tangent.
struct Place {
  Point still, moved, normal, tangent;
  const DrawnMember* member = nullptr;
  double s = 0;
};
[[nodiscard]] Place place_on(const DrawnMember& member, double s);
/// Returns the point of a location; nullopt when the location is not on the structure.
[[nodiscard]] std::optional<Place> place_of(const Scene& scene, const Location& location);

/// Returns a factor of displacements (1, 2, 5 times a power of ten) that shows the largest one as about a
/// twelfth of the extent; 1 when it exceeds a sixtieth of the extent without magnification.
[[nodiscard]] double suggested_factor(const Scene& scene);

/// @brief Finds the foundations of a state without a model: for each, the member and side whose reactions
/// have the foundation's resultant. A foundation that fits no member is left out.
[[nodiscard]] std::vector<ModelFoundation> foundations_of(const std::vector<DrawnMember>& members,
                                                          const State& state);
/// @brief Finds the supports of a state without a model: each stands at the member ends whose internal forces
/// its force balances. A support that fits no member end is left out.
[[nodiscard]] std::vector<SupportForce> support_forces_of(const std::vector<DrawnMember>& members,
                                                          const State& state);

}  // namespace snapthrough::api::plot
