#pragma once
/// @file
/// Soil around a buried pipe: its reactions per length, as foundations of a model.
///
/// H is the depth of the pipe's axis below the surface, D the outer diameter, c the undrained shear strength,
/// phi the friction angle, gamma the effective and gamma_t the total unit weight. Each reaction grows
/// linearly with the displacement up to its ultimate value and stays there.
///
/// Source: American Lifelines Alliance, Guidelines for the Design of Buried Steel Pipe, July 2001 with
/// addenda through February 2005, appendix B; secondary, read in the sources of uhb
/// (github.com/benranderson/uhb).

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <variant>

namespace snapthrough::api::soil {

/// Accepted friction angles in degrees: those of the table of the lateral factor.
inline constexpr double kLeastPipePhi = 20.0;
inline constexpr double kLargestPipePhi = 45.0;
/// Accepted depths H over D. Uplift in clay is given up to the largest, and a pipe is buried from the least
/// on.
inline constexpr double kLeastPipeDepth = 0.5;
inline constexpr double kLargestPipeDepth = 10.0;

/// @brief Sand around a pipe.
///
/// - axial: t = pi D H gamma (1 + K0)/2 tan(f phi)
/// - lateral: p = N_qh gamma H D, N_qh = a + b x + c x^2 + d x^3 + e x^4 with x = H/D, whose coefficients are
///   linear in phi between those of the table, each 5 degrees from 20 to 45
/// - uplift: q = N_qv gamma H D, N_qv = min(phi/44 H/D, N_q), phi in degrees
/// - bearing: q = N_q gamma H D + N_gamma gamma_t D^2/2, N_q = exp(pi tan(phi)) tan^2(45 + phi/2),
///   N_gamma = exp(0.18 phi - 2.5), phi in degrees
struct PipeSand {
  double phi = 0.0;             ///< friction angle in degrees
  double coating_factor = 0.0;  ///< f: friction angle of pipe and soil over phi
  double K0 = 0.0;              ///< coefficient of earth pressure at rest
  bool is_dense = true;         ///< false: loose
};

/// @brief Clay around a pipe.
///
/// - axial: t = pi D alpha c
/// - lateral: p = N_ch c D, N_ch = 6.752 + 0.065 x - 11.063/(x + 1)^2 + 7.119/(x + 1)^3 and at most 9, with
///   x = H/D
/// - uplift: q = N_cv c D, N_cv = min(2 H/D, 10)
/// - bearing: q = N_c c D + gamma H D + exp(-2.5) gamma_t D^2/2, N_c = 2 + pi
struct PipeClay {
  double Su = 0.0;        ///< c
  double adhesion = 0.0;  ///< alpha: axial friction over c
  bool is_stiff = true;   ///< false: soft
};

using PipeSoil = std::variant<PipeSand, PipeClay>;

/// @brief Displacements at which reactions reach their ultimate values.
///
/// Where one is empty, that of the guideline counts: lateral min(0.04 (H + D/2), 0.10 D); uplift min(0.01 H,
/// 0.1 D) in dense and min(0.02 H, 0.1 D) in loose sand, min(0.1 H, 0.2 D) in stiff and min(0.2 H, 0.2 D) in
/// soft clay; bearing 0.1 D in sand and 0.2 D in clay.
struct PipeDisplacements {
  double axial = 0.0;
  std::optional<double> lateral, uplift, bearing;
};

/// A member that is a pipe in soil of one kind.
struct BuriedPipe {
  std::string id;      ///< begins the ids of its foundations
  std::string member;  ///< id of the member
  double diameter = 0.0;
  double depth = 0.0;              ///< H
  double unit_weight = 0.0;        ///< gamma
  double total_unit_weight = 0.0;  ///< gamma_t
  PipeSoil soil;
  PipeDisplacements displacements;
};

/// A reaction per length: linear up to `force` at `displacement`, constant beyond.
struct PipeReaction {
  double force = 0.0, displacement = 0.0;
};

/// @{
/// Returns a reaction of the soil around a pipe.
[[nodiscard]] PipeReaction axial_reaction(const BuriedPipe& pipe);
[[nodiscard]] PipeReaction lateral_reaction(const BuriedPipe& pipe);
[[nodiscard]] PipeReaction uplift_reaction(const BuriedPipe& pipe);
[[nodiscard]] PipeReaction bearing_reaction(const BuriedPipe& pipe);
/// @}

/// Returns the foundations of a pipe in a horizontal plane: axial, and lateral in both directions.
[[nodiscard]] nlohmann::json write_pipe_in_plan(const BuriedPipe& pipe);
/// Returns the foundations of a pipe in a vertical plane: axial, uplift and bearing.
/// @param up_is_left the soil above lies on the left of the member
[[nodiscard]] nlohmann::json write_pipe_in_elevation(const BuriedPipe& pipe, bool up_is_left);

}  // namespace snapthrough::api::soil
