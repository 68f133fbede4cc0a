#pragma once
/// @file
/// Parts of one correction, measured by themselves.

namespace snapthrough::bench {

/// Registers kernel/...: one factorisation of the shallow arch on five elements of order 5 and what it saves.
void add_kernels();

}  // namespace snapthrough::bench
