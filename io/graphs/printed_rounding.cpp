#include <placegraph/io/graphs/printed_rounding.h>

#include <Eigen/Eigenvalues>
#include <charconv>
#include <cmath>

namespace placegraph {

double printed_rounding(std::string_view number) {
  const std::size_t exponent_at = number.find_first_of("eE");
  const std::size_t point = number.find('.');
  if (point == std::string_view::npos) return 0;
  const std::string_view mantissa = number.substr(0, exponent_at);
  const int decimals = static_cast<int>(mantissa.size() - point) - 1;
  int exponent = 0;
  if (exponent_at != std::string_view::npos) {
    std::string_view digits = number.substr(exponent_at + 1);
    if (digits.starts_with('+')) digits.remove_prefix(1);
    std::from_chars(digits.data(), digits.data() + digits.size(), exponent);
  }
  return 0.5 * std::pow(10.0, exponent - decimals);
}

Information nearest_semidefinite(const Information& information) {
  const Eigen::SelfAdjointEigenSolver<Information> eigen(information);
  const Information nearest = eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0).asDiagonal() *
                              eigen.eigenvectors().transpose();
  return 0.5 * (nearest + nearest.transpose());
}

Information without_rounding(const Information& information, double rounding) {
  constexpr double kMostRounding = 1e-3;  // as a share of the largest eigenvalue
  const Eigen::SelfAdjointEigenSolver<Information> eigen(information, Eigen::EigenvaluesOnly);
  const double largest = eigen.eigenvalues()[information.rows() - 1];
  const double least = static_cast<double>(information.rows()) * rounding;
  if (!(least <= kMostRounding * largest) || eigen.eigenvalues()[0] < -least) return information;
  return nearest_semidefinite(information);
}

}  // namespace placegraph
