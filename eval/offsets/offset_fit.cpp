#include <placegraph/eval/offsets/offset_fit.h>
#include <placegraph/graph/core/median.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

namespace placegraph {
namespace {

// Slowest cosines of which the scores' variance is taken, half periods of the last that a motion
// may last at most, and cosines beyond the number of parameters where a drive is short. Chosen.
constexpr int kWaves = 24, kWaveShare = 4, kWavesBeyond = 5;
/// Motions of the final fit, and of those that choose the duration. Chosen.
constexpr int kMotions = 10000, kTrialMotions = 2000;
/// Scatters below this are rounding [m, rad].
constexpr double kLeastScatter = 1e-7;
/// Median and 99 % bound of the length of a vector of three standard normal numbers.
constexpr double kMedianLength = 1.538, kFarLength = 3.368;

using Columns = Eigen::Matrix<double, kOffsetParameters, Eigen::Dynamic>;

/// The sums over all motions at a state.
struct OffsetSums {
  OffsetVector unit = OffsetVector::Zero();  ///< change that a motion's noise looks like
  OffsetMatrix derivative = OffsetMatrix::Zero();
  OffsetVector score = OffsetVector::Zero();
  std::vector<OffsetVector> waves;  ///< of the scores, see kWaves
  int motions = 0;
  double translation_m = 0, rotation_rad = 0;

  /// What the motions of both have in common about the parameters; a motion's share.
  OffsetMatrix information() const {
    return (derivative + derivative.transpose()) / (2 * std::max(1, motions));
  }
};

double scatter_of(const std::vector<OffsetRow>& rows, int at) {
  std::vector<double> lengths;
  for (const OffsetRow& row : rows) lengths.push_back(row.error.segment<3>(at).norm());
  return std::max(kLeastScatter, median_of(std::move(lengths)) / kMedianLength);
}

double huber_weight(const Eigen::Vector3d& error, double scatter) {
  return std::min(1.0, kFarLength * scatter / std::max(error.norm(), kLeastScatter)) /
         (scatter * scatter);
}

/// Changes of the parameters that noise of the poses alone would let each motion show: a lever arm
/// by sqrt(2) of the rotations' noise, rotations by that of both, and so on.
OffsetVector noise_units(const OffsetSums& sums, double half, bool positions_alone) {
  // Rotations of an estimate beside a truth without any: a milliradian. Chosen.
  constexpr double kRotationNoise_rad = 1e-3;
  const double rotation_rad = positions_alone ? kRotationNoise_rad : sums.rotation_rad;
  OffsetVector information;
  information.segment<3>(kLeverAt).setConstant(2 * std::pow(rotation_rad / sums.translation_m, 2));
  information.segment<3>(kRotationAt).setConstant(positions_alone ? 2 : 4);
  information[kTimeAt] = (positions_alone ? 1.5 : 3) / (half * half);
  information[kScaleAt] = 3;
  return information.cwiseSqrt().cwiseInverse();
}

OffsetSums sums_of(const OffsetEquations& equations, const OffsetMask& mask,
                   const OffsetState& state, double duration, int most, int waves) {
  const std::vector<OffsetRow> rows = equations.rows(state, duration, most);
  OffsetSums sums;
  sums.motions = static_cast<int>(rows.size());
  if (rows.empty()) return sums;
  const bool positions_alone = equations.positions_alone();
  sums.translation_m = scatter_of(rows, 0);
  sums.rotation_rad = positions_alone ? 0 : scatter_of(rows, 3);
  sums.unit = noise_units(sums, equations.half_of(duration), positions_alone);
  for (int k = 0; k < kOffsetParameters; ++k)
    if (!mask[static_cast<std::size_t>(k)]) sums.unit[k] = 0;
  sums.waves.assign(static_cast<std::size_t>(waves), OffsetVector::Zero());
  const double first = rows.front().time, length = rows.back().time - first;
  for (const OffsetRow& row : rows) {
    Vector6d weights;
    weights.head<3>().setConstant(huber_weight(row.error.head<3>(), sums.translation_m));
    weights.tail<3>().setConstant(
        positions_alone ? 0 : huber_weight(row.error.tail<3>(), sums.rotation_rad));
    const OffsetJacobian weighted = weights.asDiagonal() * row.instrument;
    sums.derivative += weighted.transpose() * row.derivative;
    const OffsetVector score = weighted.transpose() * row.error;
    sums.score += score;
    const double half_turns = length > 0 ? (row.time - first) / length : 0;
    for (std::size_t k = 0; k < sums.waves.size(); ++k)
      sums.waves[k] += std::cos(std::numbers::pi * half_turns * static_cast<double>(k + 1)) * score;
  }
  return sums;
}

/// Directions by what a motion shows of them; columns in units of the noise, orthonormal.
struct Directions {
  Columns shown, free;

  Directions(const OffsetSums& sums, double bound) {
    const OffsetMatrix information = sums.information();
    std::vector<int> fitted;
    for (int k = 0; k < kOffsetParameters; ++k)
      if (sums.unit[k] > 0) fitted.push_back(k);
    Eigen::MatrixXd in_units(fitted.size(), fitted.size());
    for (std::size_t a = 0; a < fitted.size(); ++a)
      for (std::size_t b = 0; b < fitted.size(); ++b)
        in_units(static_cast<int>(a), static_cast<int>(b)) =
            sums.unit[fitted[a]] * information(fitted[a], fitted[b]) * sums.unit[fitted[b]];
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(in_units);
    int count_free = 0;
    while (count_free < in_units.rows() && solver.eigenvalues()[count_free] < bound) ++count_free;
    Columns all = Columns::Zero(kOffsetParameters, in_units.rows());
    for (std::size_t a = 0; a < fitted.size(); ++a)
      all.row(fitted[a]) = solver.eigenvectors().row(static_cast<int>(a));
    free = all.leftCols(count_free);
    shown = all.rightCols(in_units.rows() - count_free);
  }
};

/// The sums in a basis of the directions that are shown.
struct ShownSystem {
  Columns basis;
  Eigen::FullPivLU<Eigen::MatrixXd> derivative;

  ShownSystem(const OffsetSums& sums, const Directions& directions)
      : basis(sums.unit.asDiagonal() * directions.shown),
        derivative(Eigen::MatrixXd(basis.transpose() * sums.derivative * basis)) {}

  OffsetVector step(const OffsetVector& score) const {
    if (basis.cols() == 0) return OffsetVector::Zero();
    return basis * derivative.solve(Eigen::VectorXd(basis.transpose() * score));
  }
};

/// One fit with motions of one duration.
class DurationFit {
 public:
  DurationFit(const OffsetEquations& equations, const OffsetMask& mask, double duration, int most)
      : equations_(equations), mask_(mask), duration_(duration), most_(most) {
    const double longest = equations.span() / (kWaveShare * duration);
    waves_ = std::clamp(static_cast<int>(longest), 1, kWaves);
  }

  OffsetSums sums(const OffsetState& state) const {
    return sums_of(equations_, mask_, state, duration_, most_, waves_);
  }

  /// Newton's steps along the directions of which a motion shows more than `bound`; true once a
  /// step is below `enough` of what a motion's noise looks like, over the root of their number.
  bool descend(OffsetState& state, double bound, int steps, double enough) const {
    for (int k = 0; k < steps; ++k) {
      const OffsetSums now = sums(state);
      const Directions directions(now, bound);
      OffsetVector step = ShownSystem(now, directions).step(now.score);
      // No further than velocities are similar, and rotations nearly linear.
      const double most = std::max(2 * std::abs(step[kTimeAt]) / duration_,
                                   step.segment<3>(kRotationAt).norm());
      if (most > 1) step /= most;
      state = state.plus(step, equations_.positions_alone());
      double length = 0;
      for (int p = 0; p < kOffsetParameters; ++p)
        if (now.unit[p] > 0) length = std::max(length, std::abs(step[p]) / now.unit[p]);
      if (length * std::sqrt(static_cast<double>(now.motions)) < enough) return true;
    }
    return false;
  }

 private:
  const OffsetEquations& equations_;
  const OffsetMask& mask_;
  double duration_;
  int most_, waves_;
};

/// How much motions of a duration show in their time: first of how many directions.
struct DurationWorth {
  int shown = 0;
  double log_information = 0;
  bool operator<(const DurationWorth& other) const {
    return shown != other.shown ? shown < other.shown : log_information < other.log_information;
  }
};

DurationWorth worth_of(const OffsetSums& sums, double duration, double bound) {
  const Directions directions(sums, bound);
  DurationWorth worth;
  worth.shown = static_cast<int>(directions.shown.cols());
  if (worth.shown == 0) return worth;
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(
      Eigen::MatrixXd(sums.unit.asDiagonal() * directions.shown));
  const Eigen::MatrixXd basis =
      qr.householderQ() * Eigen::MatrixXd::Identity(kOffsetParameters, worth.shown);
  const Eigen::MatrixXd rate =
      basis.transpose() * sums.information() * basis / duration;
  worth.log_information = std::log(std::max(rate.determinant(), 1e-300));
  return worth;
}

/// The same state without the change from `start` along free directions.
OffsetState without_free(const OffsetState& state, const OffsetState& start,
                         const OffsetSums& sums, bool positions_alone) {
  const Directions directions(sums, least_shown(positions_alone));
  if (directions.free.cols() == 0) return state;
  OffsetVector change = OffsetVector::Zero();
  if (positions_alone) {
    change.head<3>() = state.T_estimate_truth.translation() - start.T_estimate_truth.translation();
    change.segment<3>(kRotationAt) =
        (start.R_world_estimate.inverse() * state.R_world_estimate).log();
  } else {
    change.head<6>() = (start.T_estimate_truth.inverse() * state.T_estimate_truth).log();
  }
  change[kTimeAt] = state.time_s - start.time_s;
  change[kScaleAt] = std::log(state.scale / start.scale);
  OffsetVector in_units = OffsetVector::Zero();
  for (int k = 0; k < kOffsetParameters; ++k)
    if (sums.unit[k] > 0) in_units[k] = change[k] / sums.unit[k];
  in_units -= directions.free * (directions.free.transpose() * in_units);
  return start.plus(sums.unit.cwiseProduct(in_units), positions_alone);
}

/// Covariance by the slowest waves of the scores (Lazarus, Lewis, Stock, Watson 2018), whose mean
/// square is the variance of their sum if they are correlated for less long than a wave.
OffsetMatrix covariance_of(const OffsetSums& sums, const Directions& directions) {
  const ShownSystem system(sums, directions);
  OffsetMatrix covariance = OffsetMatrix::Zero();
  for (const OffsetVector& wave : sums.waves) {
    const OffsetVector moved = system.step(wave);
    covariance += moved * moved.transpose();
  }
  // A cosine has half the square of a constant; and 1.96 deviations hold 95 % as in Student's
  // distribution with as many degrees of freedom (first term of its expansion).
  constexpr double kBound = 1.96;
  const auto count = static_cast<double>(sums.waves.size());
  const double student = 1 + (kBound * kBound + 1) / (4 * count);
  return covariance * (2 / count * student * student);
}

// Directions of which a motion shows less than this take no part while the errors are still those
// of a wrong state; steps of either part, and lengths of the last in deviations of a parameter of
// which a motion shows as much as noise. Chosen.
constexpr double kFaint = 0.04;
constexpr int kTrialSteps = 8, kSteps = 30;
constexpr double kTrialEnough = 0.1, kEnough = 1e-3;

/// The duration whose motions show most, and the states of the first fit with it.
struct BestDuration {
  DurationWorth worth{-1, 0};
  double duration = 0;
  OffsetState begin, state;
};

BestDuration best_duration(const OffsetEquations& equations, const OffsetMask& mask,
                           const OffsetState& start, int least_motions) {
  const double longest = equations.span() / (kWaves * kWaveShare);
  BestDuration best;
  for (double duration = equations.spacing(); best.duration == 0 || duration <= longest;
       duration *= 2) {
    if (duration > equations.span()) break;
    const DurationFit trial(equations, mask, duration, kTrialMotions);
    OffsetState begin = start;
    if (mask[kRotationAt])
      begin = equations.aligned(start, duration, kTrialMotions, mask[kScaleAt]);
    OffsetState state = begin;
    (void)trial.descend(state, kFaint, kTrialSteps, kTrialEnough);
    const OffsetSums sums = trial.sums(state);
    const DurationWorth worth =
        worth_of(sums, duration, least_shown(equations.positions_alone()));
    if (sums.motions >= least_motions && best.worth < worth)
      best = {worth, duration, begin, state};
  }
  return best;
}

}  // namespace

OffsetFit fit_offsets(const OffsetEquations& equations, const OffsetMask& mask,
                      const OffsetState& start) {
  OffsetFit fit;
  const auto parameters = static_cast<int>(std::count(mask.begin(), mask.end(), true));
  const int needed = kWaveShare * (parameters + kWavesBeyond);
  const auto common = static_cast<int>(std::max(0.0, equations.span()) / equations.spacing());
  const BestDuration best =
      common < needed ? BestDuration{} : best_duration(equations, mask, start, needed / 2);
  if (best.worth.shown < 0) {
    fit.outcome = Outcome::failure(
        Outcome::Code::kTooFewData,
        "the offsets need " + std::to_string(needed) +
            " poses in the time that both cover, without gaps, and there are " +
            std::to_string(common) + (common < needed ? "" : " with gaps"));
    return fit;
  }
  const bool positions_alone = equations.positions_alone();
  const double bound = least_shown(positions_alone);
  const DurationFit final_fit(equations, mask, best.duration, kMotions);
  fit.duration = best.duration;
  fit.state = best.state;
  (void)final_fit.descend(fit.state, kFaint, kTrialSteps, kTrialEnough);
  fit.state = without_free(fit.state, best.begin, final_fit.sums(fit.state), positions_alone);
  const bool converged = final_fit.descend(fit.state, bound, kSteps, kEnough);
  const OffsetSums sums = final_fit.sums(fit.state);
  const Directions directions(sums, bound);
  fit.free = directions.free;
  fit.motions = sums.motions;
  fit.translation_m = sums.translation_m;
  fit.rotation_rad = sums.rotation_rad;
  fit.information = sums.unit.asDiagonal() * sums.information() * sums.unit.asDiagonal();
  fit.covariance = covariance_of(sums, directions);
  fit.outcome = converged ? Outcome::ok()
                          : Outcome::failure(Outcome::Code::kNotConverged,
                                             "the fit of the offsets does not converge: the "
                                             "motions of both do not agree with any");
  return fit;
}

}  // namespace placegraph
