#pragma once
/// @file
/// How large strains are: the constitutive law is that of small ones.

#include <Eigen/Core>
#include <vector>

#include "solver/discrete/structure.h"
#include "solver/model/model.h"

namespace snapthrough {

/// The largest strain of a state and where it is.
struct LargestStrain {
  double strain = 0.0;
  int member = -1;
  double s = 0.0;  ///< in the model's units
};

/// @brief Measures strains at the elements' Gauss points, from the section forces there.
///
/// A strain is the largest of |N| / EA, |Q| / GA and |M| / EI times the radius of gyration sqrt(EI / EA):
/// what bending strains some fibre at the least, whatever the section's depth.
class StrainGauge {
 public:
  /// @param structure kept by reference, must outlive this
  StrainGauge(const Structure& structure, const Model& model);
  /// Replaces `largest` where a strain of y exceeds it; true when one does.
  [[nodiscard]] bool raise(const Eigen::VectorXd& y, LargestStrain& largest) const;
  /// Whether y is out of reach of any section and any drawing: the strain along a fibre is 1, at which it is
  /// compressed to nothing, or an element has turned by five turns, within which a member meets itself.
  [[nodiscard]] bool is_beyond_theory(const Eigen::VectorXd& y) const;

 private:
  struct Compliance {
    double axial, shear, bending;  ///< strain by scaled section force
  };
  const Structure& structure_;
  std::vector<Compliance> compliances_;  ///< of each member
};

}  // namespace snapthrough
