#include "solver/report/place_stiffness.h"

#include <Eigen/Dense>
#include <array>
#include <optional>

#include "solver/model/id_index.h"
#include "solver/newton/corrector.h"
#include "solver/numeric/rounding.h"
#include "solver/problem/structural_problem.h"

namespace snapthrough {

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// Weights of the unknowns in the displacement (x, y) and rotation of a place, one column for each.
MatrixXd rows_at(const Structure& structure, const ResolvedLocation& at) {
  MatrixXd rows = MatrixXd::Zero(structure.size, 3);
  for (Eigen::Index c = 0; c < 3; ++c) {
    std::array<double, 3> row{};
    row[static_cast<std::size_t>(c)] = 1.0;
    for (const auto& [unknown, weight] : displacement_row(structure, at, row).entries)
      rows(unknown, c) += weight;
  }
  return rows;
}

/// Displacements of a place under unit forces at it, scaled. @pre the problem is factorised
Matrix3d compliance_at(const Structure& structure, StructuralProblem& problem, const ResolvedLocation& at) {
  const MatrixXd rows = rows_at(structure, at);
  MatrixXd motions = rows;
  problem.to_rows(motions);
  problem.solve(motions);
  return rows.transpose() * motions;
}

/// Inverse of a compliance in the model's units; empty where it is singular, or as large as that of a
/// mechanism.
std::optional<std::vector<std::array<double, 3>>> stiffness_of(const Structure& structure,
                                                               const Matrix3d& compliance) {
  if (!compliance.allFinite() || compliance.cwiseAbs().maxCoeff() > kSingularResponse) return std::nullopt;
  const Eigen::JacobiSVD<Matrix3d> parts(compliance);
  const Eigen::Vector3d sizes = parts.singularValues();
  if (!(sizes[2] > Rounding::last_places * sizes[0])) return std::nullopt;
  const Matrix3d scaled = compliance.inverse();
  const Scales& scales = structure.scales;
  const std::array<double, 3> force{scales.force, scales.force, scales.moment()};
  const std::array<double, 3> moved{scales.length, scales.length, 1.0};
  std::vector<std::array<double, 3>> out(3);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      out[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] =
          scaled(i, j) * force[static_cast<std::size_t>(i)] / moved[static_cast<std::size_t>(j)];
  return out;
}

}  // namespace

std::vector<PlaceStiffness> place_stiffnesses(const Structure& structure, const VectorXd& y, double lambda,
                                              const std::vector<Location>& places) {
  std::vector<PlaceStiffness> out;
  if (places.empty()) return out;
  const ResolvedModel& model = *structure.model;
  const IdIndex nodes(model.nodes);
  const IdIndex members(model.members);
  StructuralProblem problem(structure);
  VectorXd residual;
  problem.linearise(y, lambda, residual);
  for (const Location& place : places) {
    PlaceStiffness& one = out.emplace_back();
    ResolvedLocation at;
    if (place.member.empty()) {
      one.node = place.node;
      at.node = nodes.of(place.node);
    } else {
      one.member = place.member;
      one.fraction = place.fraction;
      at.member = members.of(place.member);
      at.fraction = place.fraction;
    }
    one.tangent = stiffness_of(structure, compliance_at(structure, problem, at));
  }
  return out;
}

}  // namespace snapthrough
