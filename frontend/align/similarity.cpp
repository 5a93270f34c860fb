#include <placegraph/frontend/align/joint_histogram.h>
#include <placegraph/frontend/align/similarity.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace placegraph {
namespace {

struct Moments {
  double weight = 0, mean_ref = 0, mean_cur = 0, ref_ref = 0, cur_cur = 0, ref_cur = 0;
};

template <class Weight>
Moments moments_of(const std::vector<double>& ref, const std::vector<double>& cur, Weight weight) {
  Moments m;
  for (std::size_t i = 0; i < ref.size(); ++i) {
    const double w = weight(i);
    m.weight += w, m.mean_ref += w * ref[i], m.mean_cur += w * cur[i];
  }
  if (!(m.weight > 0)) return m;
  m.mean_ref /= m.weight, m.mean_cur /= m.weight;
  for (std::size_t i = 0; i < ref.size(); ++i) {
    const double w = weight(i), a = ref[i] - m.mean_ref, b = cur[i] - m.mean_cur;
    m.ref_ref += w * a * a, m.cur_cur += w * b * b, m.ref_cur += w * a * b;
  }
  return m;
}

double correlation(const Moments& m) {
  const double product = m.ref_ref * m.cur_cur;
  return product > 0 ? m.ref_cur / std::sqrt(product) : 0;
}

double one(std::size_t) { return 1; }

/// Gain of the regression of cur on ref, limited to the range between images of one scene: without
/// a bound a blank wall would match everything best.
double regression_gain(const Moments& m) {
  return m.ref_ref > 0 ? std::clamp(m.ref_cur / m.ref_ref, 0.5, 2.0) : 1;
}

/// m(ref) = gain ref + bias under the weights of the fit.
void linear_model(Similarity kind, const std::vector<double>& ref, const std::vector<double>& cur,
                  PhotometricFit& fit) {
  fit.gain = 1, fit.bias = 0;
  if (kind != Similarity::kSsd) {
    const Moments m = moments_of(ref, cur, [&](std::size_t i) { return fit.weight[i]; });
    fit.gain = regression_gain(m);
    // ZNCC compares both lists at unit norm.
    if (kind == Similarity::kZncc && m.ref_ref > 0) fit.gain = std::sqrt(m.cur_cur / m.ref_ref);
    fit.bias = m.mean_cur - fit.gain * m.mean_ref;
  }
  for (std::size_t i = 0; i < ref.size(); ++i) {
    fit.model[i] = fit.gain * ref[i] + fit.bias;
    fit.residual[i] = cur[i] - fit.model[i];
  }
}

void measure_spread(const std::vector<double>& cur, PhotometricFit& fit) {
  std::vector<double> magnitudes(cur.size());
  for (std::size_t i = 0; i < cur.size(); ++i) magnitudes[i] = std::abs(cur[i] - fit.model[i]);
  const auto middle = magnitudes.begin() + static_cast<std::ptrdiff_t>(magnitudes.size() / 2);
  std::nth_element(magnitudes.begin(), middle, magnitudes.end());
  fit.sigma_grey = std::max(0.4, 1.4826 * *middle);
  const double cut = 2.5 * std::min(fit.sigma_grey, 12.0);
  const auto close = std::count_if(magnitudes.begin(), magnitudes.end(),
                                   [&](double magnitude) { return magnitude < cut; });
  fit.inlier_share = static_cast<double>(close) / static_cast<double>(magnitudes.size());
}

void weigh(const std::vector<double>& cur, const RobustKernel& kernel, PhotometricFit& fit) {
  for (std::size_t i = 0; i < cur.size(); ++i) {
    const double r = (cur[i] - fit.model[i]) / fit.sigma_grey;
    fit.weight[i] = kernel.evaluate(r * r).first;
  }
}

}  // namespace

double similarity(Similarity kind, const std::vector<double>& ref, const std::vector<double>& cur) {
  if (ref.size() < 2) return -std::numeric_limits<double>::infinity();
  const auto n = static_cast<double>(ref.size());
  if (kind == Similarity::kMi) return JointHistogram(ref, cur).mutual_information();
  if (kind == Similarity::kSsd) {
    double sum = 0;
    for (std::size_t i = 0; i < ref.size(); ++i) sum += (cur[i] - ref[i]) * (cur[i] - ref[i]);
    return -sum / n;
  }
  const Moments m = moments_of(ref, cur, one);
  if (kind == Similarity::kZncc) return correlation(m);
  const double gain = regression_gain(m);
  return -(m.cur_cur - 2 * gain * m.ref_cur + gain * gain * m.ref_ref) / n;
}

void fit_photometry(Similarity kind, const std::vector<double>& ref, const std::vector<double>& cur,
                    RobustKernel::Kind kernel, double width, PhotometricFit& fit) {
  const std::size_t n = ref.size();
  const RobustKernel robust{kernel, width};
  // Without weights of the previous step, the outliers must be found first.
  const bool fresh = fit.weight.size() != n;
  if (fresh || kernel == RobustKernel::Kind::kNone) fit.weight.assign(n, 1);
  for (auto* values : {&fit.model, &fit.slope, &fit.residual}) values->resize(n);
  if (kind == Similarity::kMi) {
    JointHistogram histogram(ref, cur);
    fit.similarity = histogram.mutual_information();
    histogram.linearize(ref, cur, fit.model, fit.slope, fit.residual);
    measure_spread(cur, fit);
    // The logarithm of the histogram already gives outliers little weight.
    fit.weight.assign(n, 1);
    return;
  }
  linear_model(kind, ref, cur, fit);
  measure_spread(cur, fit);
  for (int i = fresh ? 10 : 1; kernel != RobustKernel::Kind::kNone && i > 0; --i) {
    weigh(cur, robust, fit);
    linear_model(kind, ref, cur, fit);
    measure_spread(cur, fit);
  }
  if (kernel != RobustKernel::Kind::kNone) weigh(cur, robust, fit);
  std::fill(fit.slope.begin(), fit.slope.end(), fit.gain);
  fit.similarity = similarity(kind, ref, cur);
}

double robust_similarity(Similarity kind, const std::vector<double>& ref,
                         const std::vector<double>& cur) {
  if (kind == Similarity::kMi || ref.size() < 2) return similarity(kind, ref, cur);
  PhotometricFit fit;
  fit_photometry(kind, ref, cur, RobustKernel::Kind::kTukey, 4.685, fit);
  const Moments m = moments_of(ref, cur, one);
  const double variance = m.ref_ref / m.weight;
  const double scale = 4 / (variance * std::max(fit.gain * fit.gain, 1e-6));
  if (!(variance > 0)) return 0;
  double lost = 0;
  for (const double e : fit.residual) lost += std::min(scale * e * e, 1.0);
  return 1 - lost / static_cast<double>(ref.size());
}

double agreement(const PhotometricFit& fit, const std::vector<double>& cur) {
  return correlation(moments_of(fit.model, cur, [&](std::size_t i) { return fit.weight[i]; }));
}

}  // namespace placegraph
