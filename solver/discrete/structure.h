#pragma once
/// @file
/// A model on a mesh, in scaled units: the data of the equilibrium problem.

#include <Eigen/Core>
#include <array>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include "solver/discrete/follower_ends.h"
#include "solver/element/element_set.h"
#include "solver/geometry/axes.h"
#include "solver/geometry/stress_free_axis.h"
#include "solver/mesh/mesh.h"
#include "solver/model/analysis.h"
#include "solver/model/model.h"
#include "solver/model/scales.h"
#include "solver/support/law.h"

namespace snapthrough {

/// Support of a node. Components 0, 1 are along axes turned by `angle`, 2 is the rotation.
struct NodeSupport {
  std::array<bool, 3> fixed{};
  double angle = 0.0;
  std::array<double, 3> proportional{};  ///< prescribed displacement by unit scaled load factor
  std::array<double, 3> constant{};
};

/// Spring at a node: reacts along `row` (x, y, rotation).
struct NodeSpring {
  int node = 0;
  std::array<double, 3> row{};
  Law law;
  Touch touch = Touch::none;
  int spring = -1;  ///< its number among the springs
};

/// @brief One-sided supports that touch without pressure, and which of them the motion of least load meets.
///
/// Numbers are those of with_joined_supports(), or of the model where nothing is joined.
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
  std::vector<FoundationRange> foundations;  ///< of each foundation ascending, none twice
  std::vector<Spring> springs;
  Eigen::VectorXd motion;  ///< of least load: unknowns of the mesh where it was found
  double reference = 0.0;  ///< load factor under which they touch
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

/// A monitor in the user's units.
struct MonitorRow {
  std::string id;
  SparseRow row;
};

/// Where a foundation lies on the mesh.
struct FoundationPart {
  int foundation = 0;
  int element = 0;
  std::array<double, 2> range{0.0, 1.0};     ///< of the element
  std::optional<FoundationContact> contact;  ///< of a one-sided foundation, also where the mesh lumps it
};

/// @brief Everything that assembly needs, built once for a model and a mesh; const from then on.
struct Structure {
  Scales scales;
  Mesh mesh;
  Geometry geometry = Geometry::nonlinear;
  Axes axes;                       ///< relative to `origin`
  std::array<double, 2> origin{};  ///< the first node: far from the axes' origin nothing loses digits
  std::vector<std::shared_ptr<const StressFreeAxis>> stress_free;  ///< of each member, with its imperfections
  Eigen::Index size = 0;                                           ///< unknowns of the mixed problem
  int free_displacements = 0;  ///< of them, free displacement unknowns (interiors included, releases counted)
  int nodes = 0;
  int releases = 0;  ///< scalar rotations of released member ends, after the nodes' unknowns
  std::unique_ptr<const ElementSet> elements;
  std::vector<ElementDofs> dofs;      ///< of each element
  std::vector<NodeSupport> supports;  ///< of each node
  std::vector<NodeSpring> node_springs;
  std::vector<FoundationLaw>
      foundation_laws;                 ///< of each foundation of the model, as results are read from it
  std::vector<SpringLaw> spring_laws;  ///< of each spring of the model
  /// Of each element: the largest stiffness of a one-sided foundation that acts on it
  /// (`Mesh::decay_lengths`).
  std::vector<double> stiffest;
  Eigen::VectorXd proportional_load;  ///< by unit scaled load factor
  Eigen::VectorXd constant_load;
  Eigen::VectorXd metric;
  std::vector<MonitorRow> monitors;
  std::vector<FoundationPart> foundation_parts;
  std::vector<std::string> skipped;
  std::vector<FollowerEnd> follower_ends;
  std::vector<double> euler_loads;  ///< pi^2 EI / l^2 of each member
  std::vector<double>
      foundation_loads;  ///< 2 sqrt(K EI) + G of the foundations of each member: what they can add to that
  TouchingSupports touching;  ///< empty unless they were looked for
  bool one_sided = false;     ///< some foundation or spring is not bilateral
  bool has_constant = false;  ///< actions of the constant pattern move it
  std::stop_token stop;       ///< who computes with it looks at this
  /// Motions of the nodes (x, y, rotation each, scaled) that supports of one side alone can resist, or
  /// nothing; orthonormal columns.
  Eigen::MatrixXd free_motions;
};

/// The law of a foundation as it acts on an element.
[[nodiscard]] FoundationLaw law_on(const Structure& structure, const FoundationLaw& foundation, int element);

/// @brief Builds the structure.
/// @pre the model passed the reference and range checks of check()
[[nodiscard]] Structure make_structure(const Model& model, const Discretization& discretization,
                                       Geometry geometry, const ModeOffsets& modes = {},
                                       MeshUse use = MeshUse::final);
/// @brief The structure of the same model, with the same imperfections and scales, on another mesh.
[[nodiscard]] Structure on_mesh(const Structure& structure, const Model& model, Mesh mesh);
/// @brief The same structure, in which it is known what supports do that touch without pressure.
[[nodiscard]] Structure with_touching(const Structure& structure, const Model& model,
                                      TouchingSupports touching);

/// @brief The structure of a changed model with the same members: its unknowns, elements and scales are those
/// of the structure, so that one state means the same in both.
/// @param model of the structure
/// @param modes offsets of the changed model's mode imperfections
/// @pre the changed model passed check()
[[nodiscard]] Structure with_changed_model(const Structure& structure, const Model& model,
                                           const Model& changed, const ModeOffsets& modes);

/// @brief Foundations and springs that are left out because their stiffness is zero, in words.
[[nodiscard]] std::vector<std::string> without_stiffness(const Model& model);

/// @brief Functional that reads the displacement along (dx, dy), or the rotation, at a place.
/// @param row (x, y, rotation) weights at that place
[[nodiscard]] SparseRow displacement_row(const Structure& structure, const Model& model, const Location& at,
                                         std::array<double, 3> row);

/// @brief Stress-free geometry and compliances of an element, scaled.
[[nodiscard]] ElementShape shape_of_element(const Structure& structure, const Model& model, int element);
/// @brief Length of an element, scaled.
[[nodiscard]] double length_of_element(const Structure& structure, int element);

/// Element of a member and local coordinate in [0, 1] at a fraction of its length.
struct MeshPlace {
  int element = 0;
  double xi = 0.0;
};
[[nodiscard]] MeshPlace place_of(const Mesh& mesh, int member, double fraction);

}  // namespace snapthrough
