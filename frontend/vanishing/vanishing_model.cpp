#include <placegraph/frontend/vanishing/vanishing_model.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace placegraph {
namespace {

/// Cost of a line's share while that of its direction is unknown: a tenth of the lines [nats].
constexpr double kFirstCost = 2.3;

}  // namespace

TangentBasis tangent_basis(const Eigen::Vector3d& v) {
  TangentBasis basis;
  basis.col(0) = v.unitOrthogonal();
  basis.col(1) = v.cross(basis.col(0));
  return basis;
}

double entropy_term(double n, double total) { return n > 0 ? -n * std::log(n / total) : 0; }

FittedDirection fit_direction(const VanishingEvidence& evidence, const Eigen::Vector3d& start,
                              const std::vector<int>& lines, int iterations) {
  FittedDirection fit;
  fit.v = start.normalized();
  if (lines.size() < 2) return fit;
  Eigen::Matrix2d information;
  for (int iteration = 0; iteration <= iterations; ++iteration) {
    const TangentBasis B = tangent_basis(fit.v);
    Eigen::Matrix2d A = Eigen::Matrix2d::Zero();
    Eigen::Vector2d b = Eigen::Vector2d::Zero();
    information.setZero();
    for (const int i : lines) {
      const PointingError e = evidence.error(i, fit.v);
      const Eigen::RowVector2d J = e.J_sine_v * B;
      const Eigen::Matrix2d JJ = J.transpose() * J / e.variance;
      const double w = evidence.robust_weight(e);
      information += JJ;
      A += w * JJ;
      b -= (w * e.sine / e.variance) * J.transpose();
    }
    if (!(A.determinant() > 1e-9 * A.trace() * A.trace())) return fit;
    if (iteration == iterations) break;
    Eigen::Vector2d step = A.inverse() * b;
    const double norm = step.norm();
    if (norm > 0.3) step *= 0.3 / norm;  // the errors are nonlinear
    fit.v = (fit.v + B * step).normalized();
  }
  if (fit.v.z() < 0) fit.v = -fit.v;
  const TangentBasis B = tangent_basis(fit.v);
  Eigen::Matrix3d full = Eigen::Matrix3d::Zero();
  for (const int i : lines) {
    const PointingError e = evidence.error(i, fit.v);
    full += e.J_sine_v.transpose() * e.J_sine_v / e.variance;
  }
  information = evidence.information_share() * (B.transpose() * full * B);
  const double determinant = information.determinant();
  if (!(determinant > 1e-9 * information.trace() * information.trace())) return fit;
  fit.covariance = B * information.inverse() * B.transpose();
  fit.precision_cost = 0.5 * std::log(determinant);
  fit.ok = true;
  return fit;
}

void DirectionPrior::pull(FittedDirection& fit) const {
  fit.across_axis = -1;
  if (axes.empty()) return;
  // Densities relative to the uniform one on half the sphere, 1 / (2 pi): normal across half a
  // great circle, 1 / pi along it. Both are integrated over the uncertainty of the lines.
  double sum = free_share, largest = free_share;
  for (std::size_t a = 0; a < axes.size(); ++a) {
    const double off = std::asin(std::clamp(axes[a].dot(fit.v), -1.0, 1.0));
    const double variance = sigma_rad * sigma_rad + axes[a].dot(fit.covariance * axes[a]);
    const double density = (1 - free_share) / static_cast<double>(axes.size()) * 2 *
                           std::exp(-0.5 * off * off / variance) /
                           std::sqrt(2 * std::numbers::pi * variance);
    sum += density;
    if (density > largest) largest = density, fit.across_axis = static_cast<int>(a);
  }
  fit.precision_cost -= std::log(sum);
  if (fit.across_axis < 0) return;
  const Eigen::Vector3d& axis = axes[static_cast<std::size_t>(fit.across_axis)];
  const Eigen::Vector3d toward = fit.covariance * axis;
  const double own = axis.dot(toward), variance = sigma_rad * sigma_rad + own;
  const double off = axis.dot(fit.v);
  fit.precision_cost -= 0.5 * off * off * own / (variance * variance);
  fit.v = (fit.v - toward * (off / variance)).normalized();
  if (fit.v.z() < 0) fit.v = -fit.v;
  const Eigen::Matrix3d P = Eigen::Matrix3d::Identity() - fit.v * fit.v.transpose();
  fit.covariance = P * (fit.covariance - toward * toward.transpose() / variance) * P;
}

std::vector<int> VanishingModel::lines_of(int direction) const {
  std::vector<int> lines;
  for (std::size_t i = 0; i < of_.size(); ++i)
    if (of_[i] == direction) lines.push_back(static_cast<int>(i));
  return lines;
}

FittedDirection VanishingModel::fit(const Eigen::Vector3d& start,
                                    const std::vector<int>& lines) const {
  FittedDirection fitted = fit_direction(*evidence_, start, lines, 3);
  if (fitted.ok) prior_.pull(fitted);
  return fitted;
}

std::vector<double> VanishingModel::ratios(const Eigen::Vector3d& v) const {
  std::vector<double> row(static_cast<std::size_t>(evidence_->size()));
  for (int i = 0; i < evidence_->size(); ++i)
    row[static_cast<std::size_t>(i)] = evidence_->log_ratio(i, v);
  return row;
}

void VanishingModel::append(const FittedDirection& direction) {
  directions_.push_back(direction);
  ratios_.push_back(ratios(direction.v));
}

void VanishingModel::remove(int direction) {
  directions_.erase(directions_.begin() + direction);
  ratios_.erase(ratios_.begin() + direction);
  for (int& which : of_) which = which == direction ? -1 : which - (which > direction);
}

/// Assigns lines to directions with the current shares, then updates the shares; computes the cost
/// at the end.
void VanishingModel::assign(int rounds) {
  const std::size_t n = static_cast<std::size_t>(evidence_->size()), m = directions_.size();
  of_.resize(n, -1);
  const double total = std::max(evidence_->total_weight(), 1e-9);
  std::vector<double> bonus(m), share = bonus;
  share.push_back(0);
  for (int round = 0; round <= rounds; ++round) {
    std::fill(share.begin(), share.end(), 0.0);
    for (std::size_t i = 0; i < n; ++i)
      share[static_cast<std::size_t>(of_[i] + 1)] += evidence_->weight(static_cast<int>(i));
    if (round == rounds) break;
    for (std::size_t z = 0; z < m; ++z) bonus[z] = std::log((share[z + 1] + 1) / (share[0] + 1));
    for (std::size_t i = 0; i < n; ++i) {
      double best = 0;
      of_[i] = -1;
      for (std::size_t z = 0; z < m; ++z) {
        const double gain = ratios_[z][i] + bonus[z];
        if (gain > best) best = gain, of_[i] = static_cast<int>(z);
      }
    }
  }
  cost_ = 0;
  for (std::size_t i = 0; i < n; ++i)
    if (of_[i] >= 0)
      cost_ -=
          evidence_->weight(static_cast<int>(i)) * ratios_[static_cast<std::size_t>(of_[i])][i];
  for (const double part : share) cost_ += entropy_term(part, total);
  for (const FittedDirection& direction : directions_)
    cost_ += std::max(0.0, direction.precision_cost) + cost_per_direction_;
}

std::optional<VanishingModel> VanishingModel::with(const Eigen::Vector3d& v) const {
  VanishingModel larger = *this;
  larger.of_.resize(static_cast<std::size_t>(evidence_->size()), -1);
  FittedDirection direction;
  direction.v = v;
  larger.append(direction);
  // Shares of a new direction: those that it would win at a share like the others'.
  const int z = larger.size() - 1;
  for (std::size_t i = 0; i < larger.of_.size(); ++i) {
    const int rival = larger.of_[i];
    const double present =
        rival < 0 ? kFirstCost : larger.ratios_[static_cast<std::size_t>(rival)][i];
    if (larger.ratios_.back()[i] > present) larger.of_[i] = z;
  }
  for (int round = 0; round < 3; ++round) {
    const std::vector<int> lines = larger.lines_of(z);
    if (static_cast<int>(lines.size()) < min_lines_) return std::nullopt;
    const FittedDirection fitted = fit(larger.directions_.back().v, lines);
    if (!fitted.ok) return std::nullopt;
    larger.directions_.back() = fitted;
    larger.ratios_.back() = ratios(fitted.v);
    larger.assign(2);
  }
  if (static_cast<int>(larger.lines_of(z).size()) < min_lines_) return std::nullopt;
  return larger;
}

VanishingModel VanishingModel::with_all(const std::vector<FittedDirection>& directions) const {
  VanishingModel other(*evidence_, cost_per_direction_, min_lines_);
  other.prior_ = prior_;
  for (const FittedDirection& direction : directions) other.append(direction);
  other.of_.assign(static_cast<std::size_t>(evidence_->size()), -1);
  for (std::size_t i = 0; i < other.of_.size(); ++i) {
    double best = kFirstCost;
    for (std::size_t z = 0; z < other.ratios_.size(); ++z)
      if (other.ratios_[z][i] > best)
        best = other.ratios_[z][i], other.of_[i] = static_cast<int>(z);
  }
  other.assign(3);
  return other;
}

VanishingModel VanishingModel::without(int direction, int polish_rounds) const {
  VanishingModel smaller = *this;
  smaller.remove(direction);
  smaller.assign(2);
  smaller.polish(polish_rounds);
  return smaller;
}

void VanishingModel::polish(int rounds) {
  for (int round = 0; round < rounds; ++round) {
    for (int z = size() - 1; z >= 0; --z) {
      if (directions_[static_cast<std::size_t>(z)].held) continue;
      const std::vector<int> lines = lines_of(z);
      const std::size_t row = static_cast<std::size_t>(z);
      FittedDirection fitted;
      if (static_cast<int>(lines.size()) >= min_lines_) fitted = fit(directions_[row].v, lines);
      if (fitted.ok) {
        directions_[row] = fitted;
        ratios_[row] = ratios(fitted.v);
      } else {
        remove(z);
      }
    }
    assign(2);
  }
}

}  // namespace placegraph
