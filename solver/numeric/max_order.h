#pragma once
/// @file
/// The largest order of elements.

namespace snapthrough {

/// Polynomial orders of elements, and of the collocation rules they stand on, go from 1 to this.
inline constexpr int kMaxOrder = 8;

}  // namespace snapthrough
