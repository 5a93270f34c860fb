#include <dlfcn.h>
#include <gtest/gtest.h>
#include <placegraph/backend/linear/blas_threads.h>

#include <string>

extern "C" int openblas_get_num_threads();

namespace placegraph {
namespace blas_threads_test {

TEST(BlasThreads, IsOneAfterItWasAskedFor) {
  use_one_blas_thread();
  EXPECT_EQ(openblas_get_num_threads(), 1);
}

// Ceres' package brings ATLAS: with Ceres before OpenBLAS on the link line CHOLMOD calls that.
TEST(Blas, TheDenseKernelsOfTheSparseSolverAreThoseOfOpenBlas) {
  for (const char* name : {"dgemm_", "dsyrk_", "dtrsm_", "dpotrf_"}) {
    void* const symbol = dlsym(RTLD_DEFAULT, name);
    ASSERT_NE(symbol, nullptr) << name;
    Dl_info info;
    ASSERT_NE(dladdr(symbol, &info), 0);
    EXPECT_NE(std::string(info.dli_fname).find("openblas"), std::string::npos)
        << name << " is from " << info.dli_fname;
  }
}

}  // namespace blas_threads_test
}  // namespace placegraph
