#pragma once
/// @file
/// Largest model and analysis that check() accepts, which bounds memory and time.

#include <cstddef>

namespace snapthrough {

inline constexpr std::size_t kMaxNodes = 20'000;
inline constexpr std::size_t kMaxSections = 20'000;
inline constexpr std::size_t kMaxMembers = 20'000;
inline constexpr std::size_t kMaxSupports = 20'000;
inline constexpr std::size_t kMaxSprings = 20'000;
inline constexpr std::size_t kMaxFoundations = 20'000;
inline constexpr std::size_t kMaxLoads = 100'000;
inline constexpr std::size_t kMaxImperfections = 20'000;
inline constexpr std::size_t kMaxMonitors = 1'000;
inline constexpr std::size_t kMaxCurvePoints =
    10'000;  ///< interior points of one spline, offsets of one imperfection
inline constexpr std::size_t kMaxLoadFactors =
    100'000;  ///< entries of `load_factors` and of `at_load_factors`
inline constexpr std::size_t kMaxSensitivities = 10'000;
inline constexpr std::size_t kMaxIdLength = 200;       ///< characters (code points) of an id
inline constexpr std::size_t kMaxTitleLength = 1'000;  ///< characters of a title, which lists of jobs repeat
inline constexpr std::size_t kMaxUnits = 100;          ///< units of a model
inline constexpr std::size_t kMaxUnitLength = 100;   ///< characters of a unit, and of what it is the unit of
inline constexpr std::size_t kMaxWorstMembers = 32;  ///< members of a model with a worst imperfection
inline constexpr std::size_t kMaxPointsAlong =
    1'000;  ///< points of a table of a law, or of a number along a member
inline constexpr double kMaxBendingExponent = 100.0;
/// Least slope dM/dk of a bending law's table over that at the origin. A moment then gives 1e8 times the
/// curvature, so that rounding of the moment leaves half of the curvature's digits.
inline constexpr double kLeastBendingSlope = 1e-8;
inline constexpr int kMaxHalfWaves = 1'000;
inline constexpr int kMaxModes = 1'000;  ///< number of buckling modes, and of a mode imperfection
inline constexpr std::size_t kMaxMasses = 20'000;
inline constexpr std::size_t kMaxStiffnesses = 100;  ///< places whose stiffness each state reports
inline constexpr int kMaxFrequencies = 100;          ///< natural frequencies at each point of a path
inline constexpr int kMaxElementsPerMember = 100'000;
inline constexpr long long kMaxElements = 1'000'000;  ///< elements of a fixed mesh, all members together
inline constexpr int kMaxPointsPerMember = 100'001;
inline constexpr long long kMaxStatePoints = 2'000'000;  ///< members times points_per_member
inline constexpr int kMaxPathPoints = 100'000;
inline constexpr int kMaxSteps =
    10'000'000;  ///< largest count that a stop rule, branch limit or `every` takes
inline constexpr double kMaxAccuracy = 0.5;
inline constexpr double kMaxMagnitude = 1e150;  ///< bound on all quantities; their squares are finite
/// Chord over the model's extent, or difference of fractions of a member, below which it counts as zero.
inline constexpr double kMinRelativeChord = 1e-9;

}  // namespace snapthrough
