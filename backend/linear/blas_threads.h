#pragma once

namespace placegraph {

/// Sets OpenBLAS to a single thread.
/// Sums must not depend on the number of threads. The setting applies to the whole process (the
/// library has no other such setting) and is permanent, because a reset would disturb concurrent
/// optimizations.
void use_one_blas_thread();

}  // namespace placegraph
