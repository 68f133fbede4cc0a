#pragma once
/// @file
/// Largest element order.

namespace snapthrough {

/// Largest polynomial order of elements and of collocation rules; the smallest is 1.
inline constexpr int kMaxOrder = 8;

}  // namespace snapthrough
