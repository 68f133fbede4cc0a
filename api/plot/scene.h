#pragma once
/// @file
/// The members of a drawing with their undeformed and deformed axes, and how the model's axes lie on the
/// figure.

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "api/plot/model.h"
#include "api/plot/result.h"
#include "api/plot/shape.h"

namespace snapthrough::api::plot {

/// Lists of equal length, two places and more.
struct DrawnMember {
  std::string id;
  std::vector<double> s, x0, y0, x, y;  ///< undeformed, and deformed with the factor of the scene
  std::vector<Point> normals;           ///< initial left normals
  std::vector<double> normal_x, normal_y;
};

/// A node with the members that meet there.
struct Joint {
  Point still;
  Point moved;
  std::vector<Point> leaving;  ///< initial unit tangents that leave it
};

/// The force of a support on the structure, where it acts.
struct SupportForce {
  Point at;
  double fx = 0;
  double fy = 0;
};

/// A box in the model's axes, y up.
struct ModelBox {
  double left, right, bottom, top;
  ModelBox();
  void include(double x, double y);
  [[nodiscard]] bool empty() const { return !(left <= right && bottom <= top); }
};

struct SceneInput {
  const Model* model = nullptr;  ///< null: not known
  const State* state = nullptr;  ///< null: undeformed
  const Mode* mode = nullptr;
  Units units;
  double factor = 1;  ///< of displacements
  std::optional<double> load_factor;
};

struct Scene {
  SceneInput input;
  std::vector<DrawnMember> members;
  std::map<std::string, Joint> joints;       ///< by node; empty where the model is not known
  std::vector<ModelFoundation> foundations;  ///< those of the model, or those that the state tells
  std::vector<SupportForce> support_forces;  ///< where the model is not known
  ModelBox box;
  std::optional<double> mirror;  ///< x of the line that a half structure is mirrored at
  double extent = 1;             ///< larger side of the undeformed structure's box
  double depth = 0;              ///< of the ground that is drawn

  [[nodiscard]] const DrawnMember* member(const std::string& id) const;
  [[nodiscard]] double load_factor() const { return input.load_factor.value_or(1); }
};

/// @pre the state or the model is known
/// @throws PlotError when a member of the state or the mode is not one of the model
[[nodiscard]] Scene make_scene(const SceneInput& input);

/// How the model lies on the figure: pixel = (left + scale x, top - scale y).
struct View {
  double scale = 1;
  double left = 0;
  double top = 0;
};

[[nodiscard]] Pixel to_pixel(const View& view, Point point);
[[nodiscard]] std::vector<Pixel> to_pixels(const View& view, const std::vector<double>& x,
                                           const std::vector<double>& y);

/// The unit direction into the medium at an initial left normal.
[[nodiscard]] Point into_medium(const ModelFoundation& foundation, Point normal);

/// The box of the structure and its ground, mirror image included.
[[nodiscard]] ModelBox box_with_ground(const Scene& scene);
/// The size without the height that a flat structure leaves empty.
[[nodiscard]] Size needed_size(const Scene& scene, Size size);
/// A view that shows the whole structure with its ground, loads, supports and dimensions.
[[nodiscard]] View scene_view(const Scene& scene, Size size);

/// A place on a member: undeformed, deformed, initial left normal, deformed unit tangent.
struct Place {
  Point still, moved, normal, tangent;
  const DrawnMember* member = nullptr;
  double s = 0;
};
[[nodiscard]] Place place_on(const DrawnMember& member, double s);
/// The place of a location; nothing where it is not on the structure.
[[nodiscard]] std::optional<Place> place_of(const Scene& scene, const Location& location);

/// A round factor (1, 2, 5 times a power of ten) that makes displacements a twelfth of the structure; 1 where
/// they are to be seen without.
[[nodiscard]] double suggested_factor(const Scene& scene);

/// @brief Where foundations lie that a state has reactions of, found by equilibrium: the member and the side
/// whose reactions have the resultant that the state gives. Those that fit no member are left out.
[[nodiscard]] std::vector<ModelFoundation> foundations_of(const std::vector<DrawnMember>& members,
                                                          const State& state);
/// @brief Where supports stand that a state has forces of: the ends of members whose internal forces they
/// balance. Those that fit none are left out.
[[nodiscard]] std::vector<SupportForce> support_forces_of(const std::vector<DrawnMember>& members,
                                                          const State& state);

}  // namespace snapthrough::api::plot
