#pragma once

namespace placegraph {

/// Tells OpenBLAS to compute with one thread. This is a setting of the whole process (the library
/// has no other), and it stays: sums must not depend on the number of threads, and taking it back
/// would disturb an optimization that runs beside this one.
void use_one_blas_thread();

}  // namespace placegraph
