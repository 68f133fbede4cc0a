#pragma once
/// @file
/// What differs in the build of a sanitizer: all takes longer, and the memory of runners has no bound,
/// because the sanitizer's own takes more than any (server/worker/confinement.cpp).

#include "server/worker/sanitizer.h"

namespace snapthrough::server::test {

inline constexpr bool kSanitized = SNAPTHROUGH_SANITIZED == 1;

/// How much longer things may take.
inline constexpr double kSlowdown = kSanitized ? 20.0 : 1.0;

}  // namespace snapthrough::server::test

/// At the start of a test of that bound.
#define SKIP_WITHOUT_MEMORY_BOUND() \
  if (kSanitized) GTEST_SKIP() << "runners have no bound of their memory in the build of a sanitizer"
