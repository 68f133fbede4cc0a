#pragma once
/// @file
/// A model on a mesh in scaled units: the data of the equilibrium problem.

#include <Eigen/Core>
#include <array>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include "solver/discrete/follower_loads.h"
#include "solver/discrete/node_spring.h"
#include "solver/element/element_set.h"
#include "solver/geometry/axes.h"
#include "solver/geometry/stress_free_axis.h"
#include "solver/mesh/dof_map.h"
#include "solver/mesh/mesh.h"
#include "solver/model/analysis.h"
#include "solver/model/model_traits.h"
#include "solver/model/scales.h"
#include "solver/resolve/resolved_model.h"
#include "solver/support/law.h"

namespace snapthrough {

/// Support of a node: components 0 and 1 along axes rotated by `angle` (rad), component 2 is the rotation.
struct NodeSupport {
  std::array<bool, 3> fixed{};
  double angle = 0.0;
  std::array<double, 3> proportional{};  ///< prescribed displacement per unit scaled load factor
  std::array<double, 3> constant{};
};

/// Rotational spring between a node and a released member end: a semi-rigid joint.
struct JointSpring {
  int node_rotation = 0;  ///< unknown of the node
  int end_rotation = 0;   ///< unknown of the member end
  Law law;                ///< moment by the rotation of the node relative to the end; bilateral
  int member = 0;
  bool at_end = false;  ///< false: the joint is at the start of its member

  /// Rotation of the node relative to the member end in a vector of unknowns.
  [[nodiscard]] double rotation(const Eigen::Ref<const Eigen::VectorXd>& y) const {
    return y[node_rotation] - y[end_rotation];
  }
  /// Adds a moment on the node, and its opposite on the member end, to the rows of the unknowns.
  void add(double moment, Eigen::Ref<Eigen::VectorXd> rows) const {
    rows[node_rotation] += moment;
    rows[end_rotation] -= moment;
  }
};

/// @brief One-sided supports that touch without pressure, and which of them the critical motion moves into.
///
/// Indices are those of with_joined_supports(), or of the model if no supports are joined.
struct TouchingSupports {
  struct FoundationRange {
    int foundation = 0;
    std::array<double, 2> range{};  ///< fractions of the member
    Touch touch = Touch::none;
  };
  struct Spring {
    int spring = 0;
    Touch touch = Touch::none;
  };
  std::vector<FoundationRange> foundations;  ///< ascending for each foundation, without overlap
  std::vector<Spring> springs;
  Eigen::VectorXd motion;  ///< critical motion: unknowns of the mesh on which it was found
  double reference = 0.0;  ///< load factor at which the supports touch
};

/// Linear functional of the unknowns.
struct SparseRow {
  std::vector<std::pair<Eigen::Index, double>> entries;
  [[nodiscard]] double dot(const Eigen::VectorXd& y) const {
    double sum = 0.0;
    for (const auto& [i, c] : entries) sum += c * y[i];
    return sum;
  }
};

/// Row that evaluates a monitor in the user's units.
struct MonitorRow {
  std::string id;
  SparseRow row;
};

/// Part of an element covered by a foundation.
struct FoundationPart {
  int foundation = 0;
  int element = 0;
  std::array<double, 2> range{0.0, 1.0};     ///< fraction of the element
  std::optional<FoundationContact> contact;  ///< for one-sided foundations, also with lumping
};

/// @brief All data for assembly, built once for a model and a mesh; constant afterwards.
struct Structure {
  std::shared_ptr<const ResolvedModel> model;
  std::shared_ptr<const ResolvedModel> laws;  ///< with_joined_supports(), or `model`
  Scales scales;
  Mesh mesh;
  Geometry geometry = Geometry::nonlinear;
  Axes axes;  ///< relative to `origin`
  /// Coordinates of the first node, subtracted to preserve digits far from the axes' origin.
  std::array<double, 2> origin{};
  std::vector<std::shared_ptr<const StressFreeAxis>> stress_free;  ///< one per member, with imperfections
  Eigen::Index size = 0;       ///< number of unknowns of the mixed problem
  int free_displacements = 0;  ///< number of unconstrained displacements, with element interiors and releases
  int nodes = 0;
  /// First of the nodes that stand for moving ground: they follow those of the model, and are held.
  int first_ground = 0;
  /// First of the nodes between elements of a member at which stops act; they follow those of the ground.
  int first_stop_node = 0;
  std::vector<int> stop_elements;  ///< element that begins at each of these nodes, ascending
  /// First elements of the parts of members between nodes, ascending, and the number of elements.
  std::vector<int> parts_between_nodes;
  /// Number of rotations of released member ends; their unknowns follow those of the nodes.
  int releases = 0;
  int stops = 0;  ///< number of unknown forces of stops; they follow the released rotations
  /// Number of unknowns before those of the first element.
  [[nodiscard]] int before_elements() const { return DofMap::count(nodes) + releases + stops; }
  std::unique_ptr<const ElementSet> elements;
  std::vector<ElementDofs> dofs;      ///< one per element
  std::vector<NodeSupport> supports;  ///< one per node, those of the ground included
  std::vector<NodeSpring> node_springs;
  std::vector<JointSpring> joints;
  std::vector<FoundationLaw> foundation_laws;  ///< one per foundation of the model
  std::vector<SpringLaw> spring_laws;          ///< one per spring of the model
  /// Largest stiffness of a one-sided foundation on each element, for `Mesh::decay_lengths`.
  std::vector<double> stiffest;
  std::vector<double> stiffest_rigid;  ///< stiffness of a rigid foundation on each element
  Eigen::VectorXd proportional_load;   ///< load per unit scaled load factor
  Eigen::VectorXd constant_load;       ///< with the pull of cables as they are drawn
  Eigen::VectorXd drawn_pull;          ///< part of it that is the pull of cables; empty: none
  Eigen::VectorXd metric;
  std::vector<MonitorRow> monitors;
  std::vector<FoundationPart> foundation_parts;       ///< in the order of the elements
  std::vector<std::vector<int>> parts_of_foundation;  ///< indices of `foundation_parts`, per foundation
  std::vector<std::string> skipped;
  std::vector<FollowerEnd> follower_ends;
  std::vector<FollowerForce> follower_forces;
  std::vector<double> euler_loads;  ///< pi^2 EI / l^2 of each member by its smallest EI
  /// Increase of these by foundations, with the largest EI: 2 sqrt(K EI) + G, or K of one against rotation.
  std::vector<double> foundation_loads;
  TouchingSupports touching;  ///< empty unless touching supports were searched for
  /// Bending laws, one per section of the model; null for a section without one.
  std::vector<std::shared_ptr<const BendingCurve>> bending_curves;
  /// Curves to which the laws of the elements, nodes and joints refer.
  std::vector<std::shared_ptr<const ReactionCurve>> curves;
  ModelTraits traits;
  bool has_constant = false;  ///< constant actions cause displacements
  std::stop_token stop;       ///< cancels computations on the structure
  /// Node motions (x, y, rotation each, scaled) that only one-sided supports can resist; orthonormal columns.
  Eigen::MatrixXd free_motions;
};

/// Prescribed displacement (x, y, rotation) of the ground, in the model's units.
struct GroundMovement {
  std::array<double, 3> proportional{};  ///< per load factor
  std::array<double, 3> constant{};
};
/// Movements of the ground under springs and foundations, in the order of their nodes. That of a spring
/// between two nodes is along x, and is what displacement_without_force() returns.
[[nodiscard]] std::vector<GroundMovement> ground_displacements(const ResolvedModel& model);

/// @brief Point forces of a model that turn with their places; none in linear geometry.
/// @pre the unknowns and scales of the structure are set
[[nodiscard]] std::vector<FollowerForce> follower_forces_of(const Structure& structure);

/// Law of a foundation on an element, with its stiffness bounded by Structure::stiffest; that of a rigid one
/// is Structure::stiffest_rigid. A shear layer has the stiffness of the model on all elements.
[[nodiscard]] FoundationLaw law_on(const Structure& structure, const FoundationLaw& foundation, int element);

/// @brief Messages on foundations and springs that are omitted because their stiffness is zero.
[[nodiscard]] std::vector<std::string> without_stiffness(const ResolvedModel& model);

/// @brief Functional row . (x, y, rotation) of the displacement at a location.
/// @param row weights of (x, y, rotation)
[[nodiscard]] SparseRow displacement_row(const Structure& structure, const ResolvedLocation& at,
                                         std::array<double, 3> row);

/// Rows that evaluate the monitors of a model. @pre the unknowns, axes and scales of the structure are set
[[nodiscard]] std::vector<MonitorRow> monitor_rows(const Structure& structure);

/// Displacement of a spring into its medium at a state, with its derivative by the unknowns, and its
/// reaction.
struct SpringReading {
  double displacement = 0.0;
  SparseRow row;
  double force = 0.0;  ///< force on the structure, against `row`
  double depth = 0.0;  ///< a one-sided spring acts where this distance is positive
};
/// The displacement of a cable is its largest strain times the distance of its nodes, and its force that in
/// its middle.
/// @param index index among the springs of the model
[[nodiscard]] SpringReading reading_of(const Structure& structure, std::size_t index,
                                       const Eigen::VectorXd& y);
/// @brief Scaled spring along the present chord between two nodes that replaces a one-sided member, see
/// with_rods_as_springs().
/// @param index index among the springs of the model; that spring has a `rod`
[[nodiscard]] NodeSpring rod_of(const Structure& structure, std::size_t index);

/// @brief Stress-free geometry and compliances of an element, scaled.
[[nodiscard]] ElementShape shape_of_element(const Structure& structure, int element);
/// @brief Length of an element, scaled.
[[nodiscard]] double length_of_element(const Structure& structure, int element);

/// Element of a member, and its local coordinate in [0, 1], at a fraction of the member's length.
struct MeshPlace {
  int element = 0;
  double xi = 0.0;
};
[[nodiscard]] MeshPlace place_of(const Mesh& mesh, int member, double fraction);

}  // namespace snapthrough
