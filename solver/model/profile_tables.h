#pragma once
/// @file
/// Tables of the series of rolled profiles.

#include <span>
#include <string_view>

#include "solver/model/section_shape.h"

namespace snapthrough {

/// Row of the table of a series. Lengths in the unit of the table.
struct Profile {
  std::string_view name;  ///< such as "IPE 300", "HEB 200", "UB 457x191x67"
  /// Depth, width, web, flange and root radius; the rest of the shape follows from the series.
  FlangedSection section;
  double area = 0.0;           ///< printed area; 0: that of the shape
  double second_moment = 0.0;  ///< printed second moment; 0: that of the shape
};

[[nodiscard]] std::span<const Profile> ipe_profiles();
[[nodiscard]] std::span<const Profile> ipn_profiles();
[[nodiscard]] std::span<const Profile> he_profiles();
[[nodiscard]] std::span<const Profile> hd_profiles();
[[nodiscard]] std::span<const Profile> hl_profiles();
[[nodiscard]] std::span<const Profile> hp_profiles();
[[nodiscard]] std::span<const Profile> ub_profiles();
[[nodiscard]] std::span<const Profile> uc_profiles();
[[nodiscard]] std::span<const Profile> upe_profiles();
[[nodiscard]] std::span<const Profile> upn_profiles();
[[nodiscard]] std::span<const Profile> w_profiles();

}  // namespace snapthrough
