#include "solver/discrete/free_motions.h"

#include <cstddef>
#include <optional>
#include <utility>

#include "solver/discrete/mechanism.h"
#include "solver/mesh/dof_map.h"
#include "solver/numeric/dense.h"
#include "solver/numeric/rounding.h"
#include "solver/support/joined_supports.h"

namespace snapthrough {

using Eigen::Index;
using Eigen::MatrixXd;

FreeMotions::FreeMotions(const ResolvedModel& model, HeldBy held_by) {
  if (is_plainly_held(model)) return;
  if (std::optional<ResolvedModel> joined = with_joined_supports(model))
    joined_ = std::make_unique<const ResolvedModel>(*std::move(joined));
  mechanism_ = std::make_unique<const RigidMechanism>(joined_ ? *joined_ : model, held_by);
  motions_.resize(mechanism_->parts().unknowns(), static_cast<Index>(mechanism_->motions().size()));
  for (Index i = 0; i < motions_.cols(); ++i)
    motions_.col(i) = mechanism_->motions()[static_cast<std::size_t>(i)];
}

MatrixXd FreeMotions::of_nodes() const {
  if (empty()) return {};
  MatrixXd nodes(DofMap::count(static_cast<Index>(joined_model().nodes.size())), motions_.cols());
  for (Index i = 0; i < motions_.cols(); ++i) nodes.col(i) = mechanism_->of_nodes(motions_.col(i));
  const MatrixXd motions = orthonormal_columns(nodes);
  // remove rounding in rows of fixed nodes, which would couple independent parts
  return (motions.array().abs() > Rounding::unit_component).select(motions, 0.0);
}

MatrixXd free_motions(const ResolvedModel& model) { return FreeMotions(model).of_nodes(); }

}  // namespace snapthrough
