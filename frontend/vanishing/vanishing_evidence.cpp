#include <placegraph/frontend/vanishing/vanishing_evidence.h>
#include <placegraph/graph/core/angle.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace placegraph {
namespace {

/// Normalizing constant of the Student t density of scale one, as a logarithm.
double log_student(double freedom) {
  return std::lgamma((freedom + 1) / 2) - std::lgamma(freedom / 2) -
         0.5 * std::log(freedom * std::numbers::pi);
}

std::optional<Eigen::Vector2d> ideal_point(const Camera& camera, const Eigen::Vector2d& px) {
  const auto ray = camera.unproject(px);
  if (!ray) return std::nullopt;
  return Eigen::Vector2d(ray->x() / ray->z(), ray->y() / ray->z());
}

}  // namespace

VanishingEvidence::VanishingEvidence(const std::vector<LineSegment>& segments, const Camera& camera,
                                     const VanishingNoise& noise)
    : start_(noise) {
  camera.check();
  noise.check();
  focal_px_ = std::sqrt(camera.fx * camera.fy);
  for (std::size_t i = 0; i < segments.size(); ++i) {
    require(segments[i].length() > 0, "vanishing points: a segment has no length");
    const auto start = ideal_point(camera, segments[i].start);
    const auto end = ideal_point(camera, segments[i].end);
    if (!start || !end) continue;
    const Eigen::Vector2d extent = *end - *start;
    Line line;
    line.segment = static_cast<int>(i);
    line.length = extent.norm();
    if (!(line.length > 0)) continue;
    line.across = Eigen::Vector2d(-extent.y(), extent.x()) / line.length;
    line.middle = 0.5 * (*start + *end);
    line.normal = Eigen::Vector3d(line.across.x(), line.across.y(), -line.across.dot(line.middle))
                      .normalized();
    lines_.push_back(line);
  }
  weigh_collinear();
  set_noise(noise);
}

void VanishingEvidence::weigh_collinear() {
  // Collinear segments are one edge in pieces. Chosen.
  constexpr double kMaxAngle = 0.7 * kRadPerDeg, kMaxDistancePx = 2;
  const double max_distance = kMaxDistancePx / focal_px_;
  const int n = size();
  std::vector<double> angle(lines_.size());
  std::vector<int> order(lines_.size());
  std::iota(order.begin(), order.end(), 0);
  for (std::size_t i = 0; i < lines_.size(); ++i) {
    const double a = std::atan2(lines_[i].across.y(), lines_[i].across.x());
    angle[i] = a < 0 ? a + std::numbers::pi : a;
  }
  const auto at = [&](int k) {
    return static_cast<std::size_t>(order[static_cast<std::size_t>(k)]);
  };
  std::sort(order.begin(), order.end(), [&](int a, int b) {
    return std::make_pair(angle[static_cast<std::size_t>(a)], a) <
           std::make_pair(angle[static_cast<std::size_t>(b)], b);
  });
  std::vector<int> partners(lines_.size(), 1);
  for (int k = 0; k < n; ++k) {
    for (int step = 1; step < n; ++step) {
      const std::size_t i = at(k), j = at((k + step) % n);
      const double difference = angle[j] - angle[i] + (k + step >= n ? std::numbers::pi : 0);
      if (difference > kMaxAngle) break;
      const Line& base = lines_[i].length >= lines_[j].length ? lines_[i] : lines_[j];
      const Line& other = lines_[i].length >= lines_[j].length ? lines_[j] : lines_[i];
      const double offset = std::abs(base.across.dot(other.middle - base.middle));
      if (offset < max_distance) ++partners[i], ++partners[j];
    }
  }
  total_weight_ = 0;
  for (std::size_t i = 0; i < lines_.size(); ++i) {
    lines_[i].weight = 1.0 / partners[i];
    total_weight_ += lines_[i].weight;
  }
}

void VanishingEvidence::set_noise(const VanishingNoise& noise) {
  noise_ = noise;
  log_constant_ = std::log(std::numbers::pi) + log_student(noise.tail_freedom);
  const double end = noise.end_px / focal_px_, parallel = noise.parallel_deg * kRadPerDeg;
  end_variance_ = end * end;
  parallel_variance_ = parallel * parallel;
  pack();
}

void VanishingEvidence::pack() {
  for (auto* column : {&a_, &b_, &c_, &x_, &y_, &rotation_variance_, &log_gain_, &weight_})
    column->resize(size());
  for (int i = 0; i < size(); ++i) {
    const Line& line = lines_[static_cast<std::size_t>(i)];
    const double rotation_variance = variance(line, 1, 0);
    a_[i] = static_cast<float>(line.across.x());
    b_[i] = static_cast<float>(line.across.y());
    c_[i] = static_cast<float>(-line.across.dot(line.middle));
    x_[i] = static_cast<float>(line.middle.x());
    y_[i] = static_cast<float>(line.middle.y());
    rotation_variance_[i] = static_cast<float>(rotation_variance);
    log_gain_[i] = static_cast<float>(std::log(std::numbers::pi) -
                                      0.5 * std::log(2 * std::numbers::pi * rotation_variance));
    weight_[i] = static_cast<float>(line.weight);
  }
}

/// For errors e of each end the segment rotates by sqrt(2) e / length, and its middle moves by e /
/// sqrt(2), which is an angle at the vanishing point.
double VanishingEvidence::variance(const Line& line, double squared_distance, double depth) const {
  const double rotation_variance = 2 * end_variance_ / (line.length * line.length);
  const double shift = 0.5 * end_variance_ * depth * depth / std::max(squared_distance, 1e-12);
  return rotation_variance + shift + parallel_variance_;
}

PointingError VanishingEvidence::error(int i, const Eigen::Vector3d& v) const {
  const Line& line = lines_[static_cast<std::size_t>(i)];
  // Vector from the middle to the vanishing point, times v_z: it has a limit at infinity.
  const Eigen::Vector2d to_point = v.head<2>() - v.z() * line.middle;
  const double squared = std::max(to_point.squaredNorm(), 1e-12), norm = std::sqrt(squared);
  PointingError result;
  result.sine = line.across.dot(to_point) / norm;
  result.variance = variance(line, squared, v.z());
  // d sine / d to_point, then d to_point / d v = [I, -middle].
  const Eigen::Vector2d J = line.across / norm - (result.sine / squared) * to_point;
  result.J_sine_v << J.x(), J.y(), -J.dot(line.middle);
  return result;
}

double VanishingEvidence::log_ratio(int i, const Eigen::Vector3d& v, double widen_rad) const {
  const Line& line = lines_[static_cast<std::size_t>(i)];
  const Eigen::Vector2d to_point = v.head<2>() - v.z() * line.middle;
  const double squared = std::max(to_point.squaredNorm(), 1e-12),
               across = line.across.dot(to_point);
  const double spread = variance(line, squared, v.z()) + widen_rad * widen_rad;
  const double nu = noise_.tail_freedom, ratio = 1 + across * across / (squared * nu * spread);
  // log(spread^-1/2 ratio^-(nu + 1)/2), in one logarithm for the default, heavy tails
  if (nu == 4)
    return log_constant_ - 0.5 * std::log(spread * ratio * ratio * ratio * ratio * ratio);
  return log_constant_ - 0.5 * (std::log(spread) + (nu + 1) * std::log(ratio));
}

double VanishingEvidence::robust_weight(const PointingError& e) const {
  const double nu = noise_.tail_freedom;
  return (nu + 1) / (nu + e.sine * e.sine / e.variance);
}

double VanishingEvidence::information_share() const {
  return (noise_.tail_freedom + 1) / (noise_.tail_freedom + 3);
}

void VanishingEvidence::quick_gains(const Eigen::Vector3d& v, double cost,
                                    Eigen::Ref<Eigen::ArrayXf> gains) const {
  const Eigen::Vector3f f = v.cast<float>();
  const float shift = static_cast<float>(0.5 * end_variance_ * v.z() * v.z()) + 1e-12F;
  const float share = static_cast<float>(cost);
  const auto across = a_ * f.x() + b_ * f.y() + c_ * f.z();
  const auto squared_distance = (f.x() - f.z() * x_).square() + (f.y() - f.z() * y_).square();
  gains = weight_ * (log_gain_ - share -
                     0.5F * across.square() / (rotation_variance_ * squared_distance + shift))
                        .max(0.0F);
}

void VanishingEvidence::fit_noise(const std::vector<Eigen::Vector3d>& directions,
                                  const std::vector<int>& of) {
  require(of.size() == lines_.size(), "fit_noise: needs one direction per line");
  constexpr double kFactors[] = {0.35, 0.42, 0.5,  0.59, 0.71, 0.84, 1,
                                 1.19, 1.41, 1.68, 2,    2.38, 2.83};
  constexpr double kHold = 0.5;  ///< prior standard deviation of the logarithms of both
  struct Term {
    double squared, end;  ///< sine^2; the variance from the ends at the current noise
  };
  std::vector<Term> terms;
  for (int i = 0; i < size(); ++i) {
    const int which = of[static_cast<std::size_t>(i)];
    if (which < 0) continue;
    const PointingError e = error(i, directions[static_cast<std::size_t>(which)]);
    terms.push_back({e.sine * e.sine, e.variance - parallel_variance_});
  }
  const double present = noise_.end_px * noise_.end_px, nu = noise_.tail_freedom;
  const auto cost_of = [&](const VanishingNoise& trial) {
    const double end = trial.end_px * trial.end_px / present;
    const double parallel = std::pow(trial.parallel_deg * kRadPerDeg, 2);
    const double hold = std::hypot(std::log(trial.end_px / start_.end_px),
                                   std::log(trial.parallel_deg / start_.parallel_deg)) /
                        kHold;
    double cost = 0.5 * hold * hold;
    for (const Term& term : terms) {
      const double variance = term.end * end + parallel;
      cost +=
          0.5 * std::log(variance) + 0.5 * (nu + 1) * std::log1p(term.squared / (nu * variance));
    }
    return cost;
  };
  VanishingNoise found = start_;
  double best = cost_of(found);
  for (int sweep = 0; sweep < 2; ++sweep) {
    for (double VanishingNoise::*const part :
         {&VanishingNoise::end_px, &VanishingNoise::parallel_deg}) {
      for (const double factor : kFactors) {
        VanishingNoise trial = found;
        trial.*part = factor * (start_.*part);
        const double cost = cost_of(trial);
        if (cost < best) best = cost, found = trial;
      }
    }
  }
  set_noise(found);
}

void spread_labels(const VanishingEvidence& evidence, std::size_t segments,
                   std::vector<int>& labels) {
  std::vector<int> all(segments, -1);
  for (std::size_t i = 0; i < labels.size(); ++i)
    all[static_cast<std::size_t>(evidence.segment(static_cast<int>(i)))] = labels[i];
  labels = std::move(all);
}

}  // namespace placegraph
