#include <placegraph/backend/linear/blas_threads.h>

extern "C" {
int openblas_get_num_threads();
void openblas_set_num_threads(int count);
}

namespace placegraph {

void use_one_blas_thread() {
  if (openblas_get_num_threads() != 1) openblas_set_num_threads(1);
}

}  // namespace placegraph
