#pragma once
/// @file
/// The largest model and analysis that check() lets pass. They bound memory and time before any work is done.

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
inline constexpr std::size_t kMaxIdLength = 200;  ///< characters (code points) of an id
inline constexpr int kMaxHalfWaves = 1'000;
inline constexpr int kMaxModes = 1'000;  ///< buckling modes, and the number of a mode imperfection
inline constexpr int kMaxElementsPerMember = 100'000;
inline constexpr long long kMaxElements = 1'000'000;  ///< of a fixed mesh, all members together
inline constexpr int kMaxPointsPerMember = 100'001;
inline constexpr long long kMaxStatePoints = 2'000'000;  ///< members times points_per_member
inline constexpr int kMaxPathPoints = 100'000;
inline constexpr int kMaxSteps =
    10'000'000;  ///< largest count that a stop rule, branch limit or `every` takes
inline constexpr double kMaxAccuracy = 0.5;
inline constexpr double kMaxMagnitude = 1e150;  ///< of any quantity, so that its square is finite
/// Chords shorter than this fraction of the model's extent, and steps of fractions along a member that are
/// shorter than this, are taken as zero.
inline constexpr double kMinRelativeChord = 1e-9;

}  // namespace snapthrough
