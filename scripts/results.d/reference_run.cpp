// A fixed piece of work, to compare the times of two sittings or machines by: the ratio of a time
// to that of this program says more than the time. It factorizes a dense matrix, multiplies two,
// and goes through memory in order and out of order; it has nothing of the project in it and is not
// to change. Prints its CPU time in seconds.
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <ctime>
#include <vector>

namespace {

std::uint64_t state = 88172645463325252ULL;

std::uint64_t random_bits() {
  state ^= state << 13;
  state ^= state >> 7;
  state ^= state << 17;
  return state;
}

double random_number() { return static_cast<double>(random_bits() >> 11) / 9007199254740992.0; }

// c = a b, then the Cholesky factor of a a^T + n I; the sum of both.
double linear_algebra(int n) {
  std::vector<double> a(n * n), b(n * n), c(n * n, 0.0), l(n * n, 0.0);
  for (double& x : a) x = random_number() - 0.5;
  for (double& x : b) x = random_number() - 0.5;
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < n; ++k)
      for (int j = 0; j < n; ++j) c[i * n + j] += a[i * n + k] * b[k * n + j];
  double sum = 0;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j <= i; ++j) {
      double x = i == j ? n : 0;
      for (int k = 0; k < n; ++k) x += a[i * n + k] * a[j * n + k];
      for (int k = 0; k < j; ++k) x -= l[i * n + k] * l[j * n + k];
      l[i * n + j] = i == j ? std::sqrt(x) : x / l[j * n + j];
      sum += l[i * n + j] + c[i * n + j];
    }
  }
  return sum;
}

// 32 MB, in order and out of order.
double memory_traffic(int rounds) {
  std::vector<std::uint32_t> table(1 << 23);
  for (std::uint32_t& x : table) x = static_cast<std::uint32_t>(random_bits());
  std::uint64_t sum = 0;
  for (int round = 0; round < rounds; ++round) {
    for (std::size_t i = 1; i < table.size(); ++i) sum += (table[i] += table[i - 1] >> 3);
    std::size_t at = sum % table.size();
    for (int i = 0; i < 400000; ++i) {
      at = (table[at] + i) % table.size();
      sum += at;
    }
  }
  return static_cast<double>(sum % 1000003);
}

}  // namespace

int main() {
  const std::clock_t start = std::clock();
  volatile double result = linear_algebra(400) + memory_traffic(3);
  const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  std::printf("%.4f\n", seconds);
  return std::isfinite(result) ? 0 : 1;
}
