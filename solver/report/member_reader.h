#pragma once
/// @file
/// Displacements and section forces along a member in a state, and their extremes.

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "solver/discrete/element_reader.h"
#include "solver/discrete/layer_state.h"
#include "solver/discrete/structure.h"
#include "solver/geometry/stress_free_axis.h"
#include "solver/report/peaks.h"
#include "solver/report/section_force.h"
#include "solver/result.h"

namespace snapthrough {

/// Reads displacements and section forces of one member in a state.
class MemberReader {
 public:
  /// @param structure, y kept by reference; must outlive this object
  /// @param lambda scaled load factor of the state y
  /// @param layers see layer_states(); not used after construction
  MemberReader(const Structure& structure, const Eigen::VectorXd& y, double lambda,
               const std::vector<LayerState>& layers, int member);

  /// Values at a place, in the model's units.
  struct Values {
    std::array<double, 3> displacement;  ///< x, y, rotation
    double axial_force, shear_force, bending_moment;
  };
  [[nodiscard]] Values at(const MeshPlace& place) const;
  /// Place at an arc length of the undeformed axis.
  [[nodiscard]] MeshPlace place(double s) const { return place_of(structure_.mesh, member_, s / length()); }
  [[nodiscard]] double length() const { return axis_.perfect().length(); }
  [[nodiscard]] StressFreePoint undeformed(double s) const { return axis_.at(s); }

  /// @brief Extremes along the member, without the utilisation.
  /// @param known its values at places, ascending
  [[nodiscard]] MemberPeaks peaks(const MemberState& known) const;
  /// Strength of the section; null: it has none.
  [[nodiscard]] const Strength* strength() const;
  /// Stress over strength in the left and right outer fibre. @pre the section has a strength
  [[nodiscard]] std::array<double, 2> utilisations(const MeshPlace& place) const;
  /// @brief Largest stress over strength along the member in size. @pre the section has a strength
  /// @param known stresses over strength at places of the member, ascending; may have none
  [[nodiscard]] Utilisation largest_utilisation(const MemberState& known) const;
  /// Largest stress over strength in size at the start of the member, at the middles and ends of its
  /// elements, and at places inside at which forces jump or turn. @pre the section has a strength
  [[nodiscard]] Utilisation sampled_utilisation() const;

 private:
  struct Element {
    ElementReader displacements;
    SectionForces forces;
  };
  [[nodiscard]] std::size_t index_of(int element) const {
    return static_cast<std::size_t>(element - structure_.mesh.first[static_cast<std::size_t>(member_)]);
  }
  [[nodiscard]] double fraction_of(const MeshPlace& place) const {
    const MeshElement& cell = structure_.mesh.elements[static_cast<std::size_t>(place.element)];
    return cell.from + place.xi * (cell.to - cell.from);
  }
  [[nodiscard]] double s_of(const MeshPlace& place) const { return length() * fraction_of(place); }
  template <std::size_t count, class KnownValues, class ValuesAt>
  [[nodiscard]] PeakSearch<count> search(const std::vector<double>& bends, const std::vector<double>& known,
                                         const KnownValues& known_values, const ValuesAt& values_at) const;
  [[nodiscard]] std::vector<double> breaks_of(std::size_t index, const std::vector<double>& bends) const;

  const Structure& structure_;
  const StressFreeAxis& axis_;
  int member_;
  std::vector<Element> elements_;
};

}  // namespace snapthrough
