#pragma once
/// @file
/// Rolled profiles by name.

#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "solver/model/profile_tables.h"
#include "solver/model/section_shape.h"

namespace snapthrough {

/// Series of profiles of one form.
struct ProfileSeries {
  std::string_view name;      ///< such as "IPE"; "HE" has HEAA, HEA, HEB, HEC, HEM and HE
  std::string_view standard;  ///< such as "EN 10365:2017"
  double unit = 1.0;          ///< unit of length of the table in millimetres
  /// Completes the shape of a row: flanges on one or both sides, their taper.
  FlangedSection (*complete)(const FlangedSection& row) = nullptr;
  std::span<const Profile> profiles;
};

/// Profile with its series.
struct RolledProfile {
  const ProfileSeries* series = nullptr;
  const Profile* profile = nullptr;
};

/// All series: IPE, IPN, HE, HD, HL, HP, UB, UC, UPE, UPN and W.
[[nodiscard]] std::span<const ProfileSeries> profile_series();

/// @brief Profile of a name.
///
/// Case, blanks and the place of a suffix do not count. Between two numbers, "*", the sign of multiplication
/// or a blank may be written for "x". "HE 200 A", "HEA 200" and "hea200" are one profile, as are "IPE A 300"
/// and "IPE 300 A". "UKB", "UKC", "INP" and "UNP" are UB, UC, IPN and UPN. Thread-safe.
[[nodiscard]] std::optional<RolledProfile> find_profile(std::string_view name);

/// @brief At most three names near to an unknown one, nearest first, all of its series; empty if no series
/// begins with its letters.
///
/// The distance of two names is that of their numbers, relative to the larger ones.
[[nodiscard]] std::vector<std::string_view> profiles_near(std::string_view name);

/// @brief Area, second moment about the strong axis, and shear area.
/// @param millimetre the length of a millimetre in the unit of the result
[[nodiscard]] SectionGeometry geometry_of(const RolledProfile& rolled, double millimetre);

}  // namespace snapthrough
