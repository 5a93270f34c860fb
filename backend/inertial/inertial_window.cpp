#include <placegraph/backend/inertial/covariance_matrix.h>
#include <placegraph/backend/inertial/inertial_window.h>
#include <placegraph/graph/core/chi_squared.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/time.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <string>

namespace placegraph {
namespace {

using Code = Outcome::Code;
using Eigen::MatrixXd;
using Eigen::VectorXd;

Outcome window_not_started() {
  return Outcome::failure(Code::kNotAttempted, "the window has not been started");
}

}  // namespace

/// Normal equations of a chain: H(k,k), H(k,k+1) and gradients.
struct InertialWindow::Chain {
  std::vector<StateMatrix> diagonal, upper;
  std::vector<StateStep> gradient;

  explicit Chain(std::size_t count)
      : diagonal(count, StateMatrix::Zero()),
        upper(count, StateMatrix::Zero()),
        gradient(count, StateStep::Zero()) {}

  void add(const StateError& error, std::size_t first) {
    const MatrixXd weighted = error.J_first.transpose() * error.information;
    diagonal[first] += weighted * error.J_first;
    gradient[first] += weighted * error.r;
    if (error.J_second.size() == 0) return;
    upper[first] += weighted * error.J_second;
    const MatrixXd weighted_second = error.J_second.transpose() * error.information;
    diagonal[first + 1] += weighted_second * error.J_second;
    gradient[first + 1] += weighted_second * error.r;
  }
  /// Forward elimination: diagonal and gradient of every state k, with those of all earlier states.
  void eliminate_forwards(std::vector<StateMatrix>& H, std::vector<StateStep>& g) const {
    H = diagonal;
    g = gradient;
    for (std::size_t k = 0; k + 1 < H.size(); ++k) {
      const StateMatrix gain = H[k].ldlt().solve(upper[k]);
      H[k + 1] -= upper[k].transpose() * gain;
      g[k + 1] -= gain.transpose() * g[k];
    }
  }
  std::vector<StateMatrix> eliminate_backwards() const {
    std::vector<StateMatrix> H = diagonal;
    for (std::size_t k = H.size() - 1; k > 0; --k)
      H[k - 1] -= upper[k - 1] * H[k].ldlt().solve(upper[k - 1].transpose());
    return H;
  }
  std::vector<StateStep> step() const {
    std::vector<StateMatrix> H;
    std::vector<StateStep> g;
    eliminate_forwards(H, g);
    std::vector<StateStep> x(H.size());
    for (std::size_t k = H.size(); k-- > 0;) {
      StateStep right = -g[k];
      if (k + 1 < H.size()) right -= upper[k] * x[k + 1];
      x[k] = H[k].ldlt().solve(right);
    }
    return x;
  }
  /// Joint information of states k and k + 1, all others marginalized.
  MatrixXd pair_information(std::size_t k) const {
    std::vector<StateMatrix> forwards;
    std::vector<StateStep> g;
    eliminate_forwards(forwards, g);
    const std::vector<StateMatrix> backwards = eliminate_backwards();
    MatrixXd pair(30, 30);
    pair.topLeftCorner<15, 15>() = forwards[k];
    pair.topRightCorner<15, 15>() = upper[k];
    pair.bottomLeftCorner<15, 15>() = upper[k].transpose();
    pair.bottomRightCorner<15, 15>() = backwards[k + 1];
    return pair;
  }
};

InertialWindow::InertialWindow(const InertialWindowOptions& options, const SE3& T_body_cam,
                               double floor_z_m)
    : options_(options), T_body_cam_(T_body_cam), floor_z_m_(floor_z_m) {
  options_.check();
}

void InertialWindow::start(const BodyState& state) {
  require(state.T_world_body.translation().allFinite() && state.velocity_world.allFinite() &&
              state.gyro_bias.allFinite() && state.accel_bias.allFinite() &&
              positive_definite(state.covariance),
          "InertialWindow: the initial state or its covariance is invalid");
  states_.clear();
  samples_.clear();
  State first;
  first.value = state;
  states_.push_back(first);
  prior_at_ = state;
  prior_.H = symmetric_inverse(state.covariance);
  prior_.b = VectorXd::Zero(15);
  // The body is assumed at rest until the first inertial sample.
  begins_at_rest_ = true;
  samples_.push_back(
      {state.stamp_ns, state.gyro_bias,
       state.T_world_body.rotation().inverse() * Eigen::Vector3d(-gravity()) + state.accel_bias});
}

Outcome InertialWindow::add(const ImuSample& sample) {
  if (states_.empty()) return window_not_started();
  if (!sample.gyro_rad_s.allFinite() || !sample.accel_m_s2.allFinite())
    return Outcome::failure(Code::kInconsistent, "the inertial sample is not finite");
  if (sample.stamp_ns <= samples_.back().stamp_ns)
    return Outcome::failure(Code::kInconsistent, "the inertial sample is not after the last one");
  samples_.push_back(sample);
  return Outcome::ok();
}

/// Appends a state, predicted from the newest state by the inertial samples.
Outcome InertialWindow::append(std::int64_t stamp_ns) {
  if (seconds(samples_.back().stamp_ns, stamp_ns) > options_.max_prediction_s)
    return Outcome::failure(Code::kTooFewData, "no inertial samples reach to the measurement");
  const BodyState& last = states_.back().value;
  ImuPreintegration motion(last.gyro_bias, last.accel_bias, options_.noise);
  std::int64_t now = last.stamp_ns;
  std::size_t at = 0;
  while (now < stamp_ns) {
    // The mean of two successive samples; beyond the last sample its own values.
    while (at + 1 < samples_.size() && samples_[at + 1].stamp_ns <= now) ++at;
    const ImuSample& before = samples_[at];
    const ImuSample& after = samples_[std::min(at + 1, samples_.size() - 1)];
    const std::int64_t until =
        at + 1 < samples_.size() ? std::min(after.stamp_ns, stamp_ns) : stamp_ns;
    const double share = begins_at_rest_ && at == 0 && samples_.size() > 1 ? 0 : 0.5;
    motion.add(share * before.gyro_rad_s + (1 - share) * after.gyro_rad_s,
               share * before.accel_m_s2 + (1 - share) * after.accel_m_s2, seconds(now, until));
    now = until;
  }
  while (samples_.size() > 1 && samples_[1].stamp_ns <= stamp_ns) {
    samples_.pop_front();
    begins_at_rest_ = false;
  }

  const auto change = motion.change(last.gyro_bias, last.accel_bias);
  const double t = motion.duration_s();
  const SO3 R = last.T_world_body.rotation();
  State next;
  next.value = last;
  next.value.stamp_ns = stamp_ns;
  next.value.T_world_body =
      SE3(R * change.rotation,
          Eigen::Vector3d(last.T_world_body.translation() + t * last.velocity_world +
                          0.5 * t * t * gravity() + R * change.position));
  next.value.velocity_world += t * gravity() + R * change.velocity;
  next.motion = motion;
  states_.push_back(next);
  return Outcome::ok();
}

/// Finds the state at a time; appends it if the time is newer than all states.
Outcome InertialWindow::reach(std::int64_t stamp_ns, std::size_t& index) {
  if (stamp_ns > states_.back().value.stamp_ns) {
    const Outcome made = append(stamp_ns);
    if (!made) return made;
  }
  for (index = 0; index < states_.size(); ++index)
    if (states_[index].value.stamp_ns == stamp_ns) return Outcome::ok();
  return Outcome::failure(Code::kTooFewData, "the window has no state of that time");
}

/// Terms of the states in [`from`, `to`); the prior is added with the oldest state.
InertialWindow::Chain InertialWindow::linearize(std::size_t from, std::size_t to) const {
  Chain chain(to - from);
  if (from == 0) {
    const StateStep off = difference(prior_at_, states_[0].value);
    chain.diagonal[0] += prior_.H;
    chain.gradient[0] += prior_.H * off + prior_.b;
  }
  for (std::size_t k = from; k < to; ++k) {
    const State& state = states_[k];
    for (const PoseMeasurement& seen : state.poses)
      chain.add(pose_error(seen, state.value), k - from);
    if (k == from) continue;
    const BodyState& before = states_[k - 1].value;
    chain.add(inertial_error(*state.motion, before, state.value), k - 1 - from);
    for (const FlowMeasurement& flow : state.flows)
      if (const auto error = flow_error(flow, T_body_cam_, floor_z_m_, before, state.value))
        chain.add(*error, k - 1 - from);
  }
  return chain;
}

/// Whether an error of states `index` and the next, or of `index` alone, is inside the gate.
bool InertialWindow::is_within_gate(const StateError& error, std::size_t index) const {
  const Chain chain = linearize(0, states_.size());
  const bool alone = error.J_second.size() == 0;
  MatrixXd J(error.r.size(), 30), covariance = MatrixXd::Zero(30, 30);
  if (alone && index + 1 == states_.size()) {
    // The newest state is the second of the last pair, or the only state.
    std::vector<StateMatrix> H;
    std::vector<StateStep> g;
    chain.eliminate_forwards(H, g);
    covariance.topLeftCorner<15, 15>() = symmetric_inverse(H.back());
    J << error.J_first, MatrixXd::Zero(error.r.size(), 15);
  } else {
    covariance = symmetric_inverse(chain.pair_information(index));
    J.leftCols<15>() = error.J_first;
    J.rightCols<15>() = alone ? MatrixXd::Zero(error.r.size(), 15) : error.J_second;
  }
  const MatrixXd S = J * covariance * J.transpose() + symmetric_inverse(error.information);
  const double chi2 = error.r.dot(S.ldlt().solve(error.r));
  return chi2 <= chi_squared_quantile(options_.gate, static_cast<int>(error.r.size()));
}

Outcome InertialWindow::add(const PoseMeasurement& observation) {
  if (states_.empty()) return window_not_started();
  if (!observation.T_world_body.translation().allFinite() ||
      !positive_definite(observation.covariance))
    return Outcome::failure(Code::kInconsistent, "the pose or its covariance is unusable");
  std::size_t index = 0;
  const Outcome reached = reach(observation.stamp_ns, index);
  if (!reached) return reached;
  const bool accepted = is_within_gate(pose_error(observation, states_[index].value), index);
  if (accepted) {
    states_[index].poses.push_back(observation);
    improve(1);
  }
  forget();
  return accepted ? Outcome::ok()
                  : Outcome::failure(Code::kInconsistent, "the measurement is outside the gate");
}

Outcome InertialWindow::add(const FlowMeasurement& observation) {
  if (states_.empty()) return window_not_started();
  if (!observation.over_distance.allFinite() || !positive_definite(observation.covariance) ||
      observation.to_ns <= observation.from_ns)
    return Outcome::failure(Code::kInconsistent, "the flow or its covariance is unusable");
  std::size_t from = 0, to = 0;
  for (const auto& [stamp, index] :
       {std::pair{observation.from_ns, &from}, {observation.to_ns, &to}}) {
    const Outcome reached = reach(stamp, *index);
    if (!reached) return reached;
  }
  if (to != from + 1)
    return Outcome::failure(Code::kTooFewData,
                            "there are states between the two images of the flow");
  const auto error =
      flow_error(observation, T_body_cam_, floor_z_m_, states_[from].value, states_[to].value);
  const bool accepted = error && is_within_gate(*error, from);
  if (accepted) {
    states_[to].flows.push_back(observation);
    improve(1);
  }
  forget();
  return accepted ? Outcome::ok()
                  : Outcome::failure(Code::kInconsistent, "the measurement is outside the gate");
}

/// Marginalizes the oldest states into the prior of the next one.
void InertialWindow::forget() {
  while (static_cast<int>(states_.size()) > options_.max_states) {
    Chain chain = linearize(0, 2);
    // Terms of the second state alone are not marginalized.
    for (const PoseMeasurement& seen : states_[1].poses) {
      const StateError error = pose_error(seen, states_[1].value);
      chain.diagonal[1] -= error.J_first.transpose() * error.information * error.J_first;
      chain.gradient[1] -= error.J_first.transpose() * error.information * error.r;
    }
    QuadraticForm both{MatrixXd(30, 30), VectorXd(30)};
    both.H << chain.diagonal[0], chain.upper[0], chain.upper[0].transpose(), chain.diagonal[1];
    both.b << chain.gradient[0], chain.gradient[1];
    prior_ = marginalize_first(both, 15);
    prior_at_ = states_[1].value;
    states_.pop_front();
    states_.front().motion.reset();
    states_.front().flows.clear();
  }
}

/// Gauss-Newton steps from the current states.
void InertialWindow::improve(int iterations) {
  // Largest step that ends the iteration. Chosen.
  constexpr double kStill = 1e-6;
  for (int i = 0; i < iterations; ++i) {
    const std::vector<StateStep> steps = linearize(0, states_.size()).step();
    double largest = 0;
    for (std::size_t k = 0; k < states_.size(); ++k) {
      states_[k].value = moved(states_[k].value, steps[k]);
      largest = std::max(largest, steps[k].cwiseAbs().maxCoeff());
    }
    if (largest < kStill) break;
  }
}

InertialWindow::StateEstimate InertialWindow::solve() {
  StateEstimate estimate;
  if (states_.empty()) {
    estimate.outcome = window_not_started();
    return estimate;
  }
  improve(options_.max_iterations);
  const Chain chain = linearize(0, states_.size());
  std::vector<StateMatrix> forwards;
  std::vector<StateStep> g;
  chain.eliminate_forwards(forwards, g);
  const std::vector<StateMatrix> backwards = chain.eliminate_backwards();
  for (std::size_t k = 0; k < states_.size(); ++k) {
    // Both eliminations contain the state's own terms, which are subtracted once.
    states_[k].value.covariance = symmetric_inverse(forwards[k] + backwards[k] - chain.diagonal[k]);
    estimate.states.push_back(states_[k].value);
  }
  estimate.outcome = Outcome::ok();
  return estimate;
}

}  // namespace placegraph
