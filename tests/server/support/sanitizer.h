#pragma once
/// @file
/// What differs in the build of a sanitizer: all takes longer, and the memory of runners has no bound,
/// because the sanitizer's own takes more than any (server/worker/confinement.cpp).

namespace snapthrough::server::test {

#if defined(__SANITIZE_THREAD__) || defined(__SANITIZE_ADDRESS__)
inline constexpr bool kSanitized = true;
#else
inline constexpr bool kSanitized = false;
#endif

/// How much longer things may take.
inline constexpr double kSlowdown = kSanitized ? 20.0 : 1.0;

}  // namespace snapthrough::server::test

/// At the start of a test of that bound.
#define SKIP_WITHOUT_MEMORY_BOUND() \
  if (kSanitized) GTEST_SKIP() << "runners have no bound of their memory in the build of a sanitizer"
