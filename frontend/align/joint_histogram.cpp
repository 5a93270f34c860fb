#include <placegraph/frontend/align/joint_histogram.h>

#include <algorithm>
#include <cmath>

namespace placegraph {
namespace {

/// Offset from zero that keeps the logarithm of a bin moderate.
constexpr double kTiny = 1e-6;

}  // namespace

JointHistogram::Scale::Scale(const std::vector<double>& values) {
  if (values.empty()) return;
  const auto [least, greatest] = std::minmax_element(values.begin(), values.end());
  low = *least;
  // Windows reach two bins to either side of 2 ... kBins - 3.
  if (*greatest > *least) bins_per_grey = (kBins - 5) / (*greatest - *least);
}

JointHistogram::Window JointHistogram::Scale::window(double value) const {
  const double place = 2 + (value - low) * bins_per_grey;
  const int bin = std::clamp(static_cast<int>(place), 1, kBins - 3);
  const double t = std::clamp(place - bin, 0.0, 1.0), u = 1 - t;
  Window w;
  w.first = bin - 1;
  w.share[0] = u * u * u / 6;
  w.share[1] = (4 - 6 * t * t + 3 * t * t * t) / 6;
  w.share[2] = (4 - 6 * u * u + 3 * u * u * u) / 6;
  w.share[3] = t * t * t / 6;
  w.derivative[0] = -0.5 * u * u * bins_per_grey;
  w.derivative[1] = (-2 * t + 1.5 * t * t) * bins_per_grey;
  w.derivative[2] = (2 * u - 1.5 * u * u) * bins_per_grey;
  w.derivative[3] = 0.5 * t * t * bins_per_grey;
  return w;
}

double JointHistogram::Scale::grey(double bin) const {
  return bins_per_grey > 0 ? low + (bin - 2) / bins_per_grey : low;
}

JointHistogram::JointHistogram(const std::vector<double>& ref, const std::vector<double>& cur)
    : scale_ref_(ref), scale_cur_(cur), p_(Eigen::MatrixXd::Zero(kBins, kBins)) {
  for (std::size_t i = 0; i < ref.size(); ++i) {
    const Window a = scale_cur_.window(cur[i]), b = scale_ref_.window(ref[i]);
    for (int r = 0; r < 4; ++r)
      for (int c = 0; c < 4; ++c) p_(a.first + c, b.first + r) += a.share[c] * b.share[r];
  }
  if (!ref.empty()) p_ /= static_cast<double>(ref.size());
  p_cur_ = p_.rowwise().sum();
  p_ref_ = p_.colwise().sum();
}

double JointHistogram::mutual_information() const {
  double sum = 0;
  for (int r = 0; r < kBins; ++r)
    for (int c = 0; c < kBins; ++c)
      if (p_(c, r) > 0) sum += p_(c, r) * std::log(p_(c, r) / (p_cur_[c] * p_ref_[r]));
  return sum;
}

void JointHistogram::linearize(const std::vector<double>& ref, const std::vector<double>& cur,
                               std::vector<double>& mean, std::vector<double>& slope,
                               std::vector<double>& residual) const {
  Eigen::VectorXd mean_of_bin = Eigen::VectorXd::Zero(kBins);
  double variance = 0;
  for (int r = 0; r < kBins; ++r) {
    if (!(p_ref_[r] > 0)) continue;
    double first = 0, second = 0;
    for (int c = 0; c < kBins; ++c) {
      const double grey = scale_cur_.grey(c);
      first += p_(c, r) * grey;
      second += p_(c, r) * grey * grey;
    }
    mean_of_bin[r] = first / p_ref_[r];
    variance += std::max(0.0, second - first * mean_of_bin[r]);
  }
  Eigen::MatrixXd log_ratio(kBins, kBins);
  for (int r = 0; r < kBins; ++r)
    for (int c = 0; c < kBins; ++c)
      log_ratio(c, r) = std::log((p_(c, r) + kTiny) / (p_cur_[c] + kTiny));
  for (std::size_t i = 0; i < ref.size(); ++i) {
    const Window a = scale_cur_.window(cur[i]), b = scale_ref_.window(ref[i]);
    double value = 0, rise = 0, gradient = 0;
    for (int r = 0; r < 4; ++r) {
      value += b.share[r] * mean_of_bin[b.first + r];
      rise += b.derivative[r] * mean_of_bin[b.first + r];
      for (int c = 0; c < 4; ++c)
        gradient += a.derivative[c] * b.share[r] * log_ratio(a.first + c, b.first + r);
    }
    mean[i] = value;
    slope[i] = rise;
    residual[i] = -variance * gradient;
  }
}

}  // namespace placegraph
