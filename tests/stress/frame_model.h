#pragma once
/// @file
/// Small random frames on springs and bases whose first loss of stability is asked for.

#include <cstdint>

#include "tests/stress/random_model.h"

namespace snapthrough::testing {

/// @brief A frame of one to three members (lines, arcs, parabolas; some with shear flexibility, hinges,
/// angled rollers, springs with gaps, bases of one or both sides) with an analysis of type `critical`.
///
/// Stiffnesses are of the order that frames in soil have: EA l^2 / EI from 1e3 to 1e9, bases from soft to
/// some thousand times EI / l^4, so that a mesh of a hundred elements a member is converged.
/// @param accuracy asked for
[[nodiscard]] RandomRequest frame_request(std::uint64_t seed, double accuracy);

}  // namespace snapthrough::testing
