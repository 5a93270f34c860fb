// A fixed program, to compare what the checks cost on two machines by: scripts/test.d/cost.py compiles it and runs it, and
// counts in units of the two times. It has nothing of the project in it and is not to change. Prints its CPU time in seconds.
#include <Eigen/Dense>
#include <cstdio>
#include <ctime>
#include <map>
#include <regex>
#include <string>
#include <vector>

namespace {

template <int N>
double decompose(int rounds) {
  using Matrix = Eigen::Matrix<double, N, N>;
  double sum = 0;
  Matrix a = Matrix::Identity(N, N);
  for (int i = 0; i < rounds; ++i) {
    for (int k = 0; k < N * N; ++k) a(k) += ((7 * i + 3 * k) % 11 - 5) / 16.0;
    const Matrix s = a * a.transpose() + N * Matrix::Identity(N, N);
    sum += s.llt().solve(a.col(0)).norm() + a.partialPivLu().determinant();
    a *= 0.5;
  }
  return sum;
}

double words(int rounds) {
  std::map<std::string, std::vector<double>> found;
  const std::regex word("([a-z]+)([0-9]+)");
  for (int i = 0; i < rounds; ++i) {
    const std::string text = std::string(1, static_cast<char>('a' + i % 26)) + "x" + std::to_string(i);
    std::smatch match;
    if (std::regex_match(text, match, word)) found[match[1]].push_back(std::stod(match[2]));
  }
  double sum = 0;
  for (const auto& [name, values] : found) sum += values.back() + static_cast<double>(name.size());
  return sum;
}

}  // namespace

int main() {
  const double sum = decompose<6>(1500000) + words(700000);
  std::printf("%.3f\n", static_cast<double>(std::clock()) / CLOCKS_PER_SEC);
  return sum == 0;
}
