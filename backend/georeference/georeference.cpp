#include <placegraph/backend/georeference/antenna_calibration.h>
#include <placegraph/backend/georeference/antenna_trajectory.h>
#include <placegraph/backend/georeference/connected_parts.h>
#include <placegraph/backend/georeference/fix_statistics.h>
#include <placegraph/backend/georeference/georeference.h>
#include <placegraph/backend/georeference/gps_alignment.h>
#include <placegraph/backend/georeference/map_latency.h>
#include <placegraph/backend/georeference/map_scale.h>
#include <placegraph/backend/georeference/variance_components.h>
#include <placegraph/backend/pose_graph/pose_graph_optimizer.h>
#include <placegraph/graph/core/chi_squared.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/random.h>
#include <placegraph/graph/pose_graph/node_index.h>
#include <placegraph/graph/text/log_message.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace placegraph {
namespace {

constexpr double kHuberWidth = 1.345;  // 95 % of the efficiency of least squares for normal errors
constexpr double kRejectedWeight = 0.1;  // a fix of less weight is reported as rejected; chosen
/// Share of right fixes whose errors do not count as gross.
constexpr double kNotGross = 1 - 1e-5;

/// The steps of georeference().
class Georeferencer {
 public:
  Georeferencer(const GeoreferenceInput& input, const GeoreferenceOptions& options,
                const LogSink& log_sink)
      : in_(input),
        options_(options),
        log_(log_sink),
        visits_(input.visits),
        motion_(input.motion) {
    calibration_ << input.lever_arm, 0.0;
    prior_.value = calibration_;
    if (options.estimate_lever_arm) prior_.sigma.head<3>().setConstant(options.lever_arm_sigma_m);
    if (input.graph.kind() == PoseKind::kSE2) prior_.sigma[2] = 0;
    if (options.estimate_clock_offset) prior_.sigma[3] = options.clock_offset_sigma_s;
  }

  GeoreferenceResult run() {
    locate_fixes();
    result_.dropouts = find_dropouts(visits_, stamps_ns_, options_.dropout_s);
    result_.outcome = align();
    if (!result_.outcome) return std::move(result_);
    bound_odometry();
    dispersion_of_fixes();
    variance_components_of_odometry();
    if (options_.estimate_delay && !options_.estimate_clock_offset) undo_delay();
    calibrate();
    if (result_.outcome.code == Outcome::Code::kDegenerate) return std::move(result_);
    solve(options_.kernel);
    finish();
    return std::move(result_);
  }

 private:
  void locate_fixes();
  void interpolate_fixes(const AntennaTrack& track);
  void interpolate_fixes_again();
  Eigen::Matrix3d information(int fix) const {
    return fix_information(accuracy_m_[fix] * result_.accuracy_factor_horizontal,
                           accuracy_m_[fix] * result_.accuracy_factor_vertical);
  }
  Outcome align();
  GpsAlignment align_component(int component, const std::vector<int>& component_of, Random& random);
  void place(const std::vector<std::optional<Sim3>>& T_enu_map, const std::vector<int>& component);
  void dispersion_of_fixes();
  void bound_odometry();
  void scale_odometry_by(double translation, double rotation);
  void variance_components_of_odometry();
  void undo_delay();
  void take_further(double delay_s);
  void calibrate();
  void solve(const RobustKernel& kernel);
  void finish();

  const GeoreferenceInput& in_;
  const GeoreferenceOptions& options_;
  const LogSink& log_;
  GeoreferenceResult result_;
  std::vector<NodeVisit> visits_;        ///< visits of the placed nodes
  PoseGraph graph_;                      ///< T_enu_node of the placed nodes
  PoseGraph map_;                        ///< T_map_node of the placed nodes
  Trajectory motion_;                    ///< T_map_body
  std::optional<AntennaTrack> track_;    ///< track of map_ and motion_
  std::vector<std::int64_t> stamps_ns_;  ///< times of the fixes, by the nodes' clock
  std::vector<Eigen::Vector3d> positions_enu_;
  std::vector<double> accuracy_m_;
  AntennaCalibration prior_;
  Eigen::Vector4d calibration_;  ///< current calibration
  std::vector<int> fix_of_;      ///< fix of every observation
  std::vector<AntennaObservation> observations_;
};

void Georeferencer::locate_fixes() {
  result_.fixes.resize(in_.fixes.size());
  if (in_.origin)
    result_.origin = *in_.origin;
  else if (!in_.fixes.empty())
    result_.origin = median_position(in_.fixes);
  const EnuFrame enu(result_.origin);
  const auto offset_ns = static_cast<std::int64_t>(std::llround(1e9 * in_.clock_offset_s));
  for (std::size_t i = 0; i < in_.fixes.size(); ++i) {
    stamps_ns_.push_back(in_.fixes[i].stamp_ns + offset_ns);
    positions_enu_.push_back(enu.to_enu(in_.fixes[i].position));
    accuracy_m_.push_back(std::max(in_.fixes[i].accuracy_m, options_.min_accuracy_m));
    require(std::isfinite(accuracy_m_[i]), "georeference: accuracy of a fix is not finite");
    require(i == 0 || stamps_ns_[i - 1] < stamps_ns_[i],
            "georeference: times of fixes do not increase");
  }
}

/// Transfers the fixes to the nodes with the current clock offset.
void Georeferencer::interpolate_fixes(const AntennaTrack& track) {
  std::vector<std::int64_t> stamps_ns = stamps_ns_;
  const auto offset_ns = static_cast<std::int64_t>(std::llround(1e9 * calibration_[3]));
  for (std::int64_t& stamp : stamps_ns) stamp += offset_ns;
  const auto interpolated =
      track.interpolate_fixes(stamps_ns, calibration_.head<3>(), options_.max_gap_s);
  fix_of_.clear();
  observations_.clear();
  for (std::size_t i = 0; i < interpolated.size(); ++i) {
    if (!interpolated[i]) continue;
    const int fix = static_cast<int>(i);
    AntennaObservation seen{*interpolated[i], positions_enu_[i], information(fix)};
    seen.fix.t -= seen.fix.v * calibration_[3];
    if (!graph_.nodes.empty())  // the lever arm is in metres
      seen.fix.A /= scale_of(graph_.nodes[seen.fix.node].T_world_node);
    fix_of_.push_back(fix);
    observations_.push_back(seen);
  }
}

void Georeferencer::interpolate_fixes_again() {
  if (motion_.poses.empty())
    interpolate_fixes(AntennaTrack(graph_, visits_, {}));
  else
    interpolate_fixes(*track_);
}

Outcome Georeferencer::align() {
  const AntennaTrack track(in_.graph, visits_, in_.motion);
  interpolate_fixes(track);
  if (observations_.empty())
    return Outcome::failure(
        Outcome::Code::kTooFewData,
        in_.fixes.empty() ? "there are no fixes" : "the fixes and the map have no time in common");
  const std::vector<int> component = in_.graph.components();
  const int count = *std::max_element(component.begin(), component.end()) + 1;
  std::vector<std::optional<Sim3>> T_enu_map(static_cast<std::size_t>(count));
  Outcome failure;
  bool any = false;
  for (int c = 0; c < count; ++c) {
    Random random(options_.seed, static_cast<std::uint64_t>(c));
    const GpsAlignment alignment = align_component(c, component, random);
    if (alignment.outcome) {
      T_enu_map[static_cast<std::size_t>(c)] = alignment.T_enu_map;
      if (!any) {
        result_.T_enu_map = alignment.T_enu_map;
        result_.alignment_rmse_m = alignment.rmse_m;
      }
      any = true;
    } else if (failure.code == Outcome::Code::kNotAttempted) {
      failure = alignment.outcome;
    }
  }
  if (!any) return failure;
  place(T_enu_map, component);
  return Outcome::ok();
}

GpsAlignment Georeferencer::align_component(int component, const std::vector<int>& component_of,
                                            Random& random) {
  const PoseKind kind = in_.graph.kind();
  // The lever arm in the scale of a Sim(3) map is still unknown; its effect here is small.
  const Eigen::Vector3d arm =
      kind == PoseKind::kSim3 ? Eigen::Vector3d::Zero() : Eigen::Vector3d(calibration_.head<3>());
  std::vector<PositionPair> pairs;
  for (std::size_t i = 0; i < observations_.size(); ++i) {
    const InterpolatedFix& fix = observations_[i].fix;
    if (component_of[fix.node] != component) continue;
    const Pose& T_map_node = in_.graph.nodes[fix.node].T_world_node;
    const Eigen::Vector3d p_node = scale_of(T_map_node) * fix.antenna(arm, calibration_[3]);
    pairs.push_back(
        {rigid_part(T_map_node) * p_node, positions_enu_[fix_of_[i]], accuracy_m_[fix_of_[i]]});
  }
  return align_to_fixes(pairs, alignment_group(kind), options_.alignment, random);
}

void Georeferencer::place(const std::vector<std::optional<Sim3>>& T_enu_map,
                          const std::vector<int>& component) {
  std::vector<char> keep(in_.graph.nodes.size());
  for (std::size_t i = 0; i < keep.size(); ++i) {
    keep[i] = T_enu_map[static_cast<std::size_t>(component[i])].has_value();
    if (!keep[i]) result_.unplaced_nodes.push_back(in_.graph.nodes[i].id);
  }
  map_ = subgraph_of(in_.graph, keep);
  graph_ = map_;
  std::size_t next = 0;
  for (std::size_t i = 0; i < keep.size(); ++i) {
    if (!keep[i]) continue;
    PoseNode& node = graph_.nodes[next++];
    node.T_world_node =
        placed(*T_enu_map[static_cast<std::size_t>(component[i])], node.T_world_node);
    node.fixed = false;
  }
  const auto index = graph_.index_by_id();
  std::erase_if(visits_, [&](const NodeVisit& visit) { return !index.contains(visit.node); });
  track_.emplace(map_, visits_, motion_);
  interpolate_fixes_again();
}

/// Optimizes with Huber's kernel until the dispersion of the fixes is constant.
void Georeferencer::dispersion_of_fixes() {
  for (int round = 0; round < 5; ++round) {
    solve({RobustKernel::Kind::kHuber, kHuberWidth});
    if (!options_.estimate_accuracy) return;
    std::vector<FixResidual> residuals;
    static const double gross = chi_squared_quantile(kNotGross, 3);
    for (std::size_t i = 0; i < observations_.size(); ++i) {
      const Eigen::Vector3d e = residual_of(observations_[i], graph_, calibration_);
      // In the first round no scale is known by which an error can be classified as gross.
      if (round == 0 || e.dot(observations_[i].information * e) <= gross)
        residuals.push_back({stamps_ns_[fix_of_[i]], e, accuracy_m_[fix_of_[i]]});
    }
    const auto dispersion = dispersion_of(residuals, options_.max_gap_s);
    if (!dispersion) return;
    const double h = dispersion->horizontal, v = dispersion->vertical;
    const double change = std::max(std::abs(std::log(h / result_.accuracy_factor_horizontal)),
                                   std::abs(std::log(v / result_.accuracy_factor_vertical)));
    result_.accuracy_factor_horizontal = h;
    result_.accuracy_factor_vertical = v;
    for (std::size_t i = 0; i < observations_.size(); ++i)
      observations_[i].information = information(fix_of_[i]);
    if (change < 0.05) return;
  }
}

void Georeferencer::scale_odometry_by(double translation, double rotation) {
  scale_odometry(graph_, translation, rotation);
  result_.odometry_factor_translation *= translation;
  result_.odometry_factor_rotation *= rotation;
}

/// Bounds the stated covariance of the odometry by the residuals of the rigid fit.
/// Odometry whose stated covariance is far too large (e.g. an information of 1) would let the map
/// deform before its dispersion can be estimated.
void Georeferencer::bound_odometry() {
  if (!options_.estimate_odometry) return;
  constexpr double kMuchWorse = 5;  // Stated drift over the seen one that is not assumed. Chosen.
  const ClaimedDrift drift = claimed_drift(map_);
  const double seen =
      std::max(result_.alignment_rmse_m, options_.min_accuracy_m) / result_.T_enu_map.scale();
  const auto bound = [&](double claimed) {
    return claimed > kMuchWorse * seen ? seen / claimed : 1;
  };
  scale_odometry_by(bound(drift.by_translation), bound(drift.by_rotation));
}

/// Keeps the stated covariances of the edges unless the fixes contradict them.
/// Then it uses the estimated dispersion. The factors are bounded from below so that the fixes
/// could distinguish the edges from a rigid map.
void Georeferencer::variance_components_of_odometry() {
  if (!options_.estimate_odometry) return;
  constexpr int kRounds = 15;  // Rounds at most. Chosen.
  constexpr double kContradicted = 3, kSettled = 0.05, kRigid = 0.1;
  const ClaimedDrift drift = claimed_drift(map_);
  const double rigid = kRigid * *std::min_element(accuracy_m_.begin(), accuracy_m_.end()) /
                       std::sqrt(static_cast<double>(observations_.size())) /
                       result_.T_enu_map.scale();
  for (int round = 0; round < kRounds; ++round) {
    const VarianceComponents found = odometry_variance_components(result_.graph);
    const auto change = [&](const DispersionFactor& now, double factor, double claimed) {
      if (factor == 1 && std::abs(now.deviations) < kContradicted) return 1.0;
      return std::max(now.factor, std::min(1.0, rigid / claimed) / factor);
    };
    const double t = change(found.translation, result_.odometry_factor_translation,
                            drift.by_translation),
                 r = change(found.rotation, result_.odometry_factor_rotation, drift.by_rotation);
    if (std::max(std::abs(std::log(t)), std::abs(std::log(r))) < kSettled) return;
    scale_odometry_by(t, r);
    solve({RobustKernel::Kind::kHuber, kHuberWidth});
  }
}

/// Corrects a significant latency (or advance) of the map's poses.
/// Map and motion are moved to their stamps; this repeats until the remaining delay is negligible.
void Georeferencer::undo_delay() {
  constexpr int kRounds = 6;                   // Rounds at most. Chosen.
  constexpr double kClear = 3, kLittle = 0.2;  // standard deviations
  for (int round = 0; round < kRounds; ++round) {
    AntennaCalibration prior;
    prior.value << calibration_.head<3>(), -result_.map_delay_s;
    prior.sigma[3] = options_.clock_offset_sigma_s;
    const auto found =
        calibrate_antenna(graph_, observations_, {RobustKernel::Kind::kHuber, kHuberWidth}, prior,
                          calibration_, options_.solver.max_iterations);
    result_.iterations += found.iterations;
    const double sigma = std::sqrt(found.covariance(3, 3)), delay_s = found.value[3];
    if (!found.outcome || !(std::abs(delay_s) > (round == 0 ? kClear : kLittle) * sigma)) break;
    result_.map_delay_s += delay_s;
    result_.map_delay_sigma_s = sigma;
    graph_ = found.graph;
    take_further(delay_s);
  }
  if (result_.map_delay_s == 0) return;
  // The delay had affected the residuals of the edges: estimates their dispersion again.
  scale_odometry_by(1 / result_.odometry_factor_translation, 1 / result_.odometry_factor_rotation);
  bound_odometry();
  solve({RobustKernel::Kind::kHuber, kHuberWidth});
  variance_components_of_odometry();
}

void Georeferencer::take_further(double delay_s) {
  const auto steps = steps_of_delay(map_, visits_, track_->motion(), delay_s, options_.max_gap_s);
  move_nodes(graph_, steps);
  if (!motion_.poses.empty()) motion_ = without_delay(motion_, delay_s, options_.max_gap_s);
  move_nodes(map_, steps);
  track_.emplace(map_, visits_, motion_);
  interpolate_fixes_again();
}

void Georeferencer::calibrate() {
  if (prior_.sigma.isZero()) return;
  RobustKernel kernel{RobustKernel::Kind::kHuber, kHuberWidth};
  for (int round = 0; round < 6; ++round) {
    const AntennaCalibrationResult found = calibrate_antenna(
        graph_, observations_, kernel, prior_, calibration_, options_.solver.max_iterations);
    const Eigen::Vector4d step = found.value - calibration_;
    calibration_ = found.value;
    result_.iterations += found.iterations;
    result_.outcome = found.outcome;
    result_.lever_arm_covariance = found.covariance.topLeftCorner<3, 3>();
    result_.clock_offset_sigma_s = std::sqrt(found.covariance(3, 3));
    graph_ = found.graph;
    interpolate_fixes_again();
    if (round > 0 && step.head<3>().norm() < 1e-3 && std::abs(step[3]) < 1e-4) break;
    kernel = options_.kernel;
  }
  for (int k = 0; k < 3; ++k)
    result_.lever_arm_observable[k] = prior_.sigma[k] > 0 && std::sqrt(result_.lever_arm_covariance(
                                                                 k, k)) < 0.5 * prior_.sigma[k];
}

/// Optimizes the poses with the current calibration.
void Georeferencer::solve(const RobustKernel& kernel) {
  PoseGraph graph = graph_;
  for (const AntennaObservation& seen : observations_)
    graph.constraints.emplace_back(PositionConstraint{
        graph_.nodes[seen.fix.node].id, seen.position_world,
        seen.fix.antenna(calibration_.head<3>(), calibration_[3]), seen.information, kernel});
  PoseGraphOptions options = options_.solver;
  options.initialization =
      PoseGraphInitialization::kFile;  // the alignment; other initializations do not use the fixes
  const PoseGraphReport report = optimize_pose_graph(graph, options, log_);
  result_.outcome = report.outcome;
  result_.iterations += report.iterations;
  for (std::size_t i = 0; i < graph_.nodes.size(); ++i)
    graph_.nodes[i].T_world_node = report.graph.nodes[i].T_world_node;
  result_.graph = report.graph;
  interpolate_fixes_again();
}

void Georeferencer::finish() {
  double squares = 0;
  for (std::size_t i = 0; i < observations_.size(); ++i) {
    const AntennaObservation& seen = observations_[i];
    FixReport& report = result_.fixes[static_cast<std::size_t>(fix_of_[i])];
    report.node = seen.fix.node;
    report.residual_enu = residual_of(seen, graph_, calibration_);
    report.sigma_horizontal_m = 1 / std::sqrt(seen.information(0, 0));
    report.sigma_vertical_m = 1 / std::sqrt(seen.information(2, 2));
    const double chi2 = report.residual_enu.dot(seen.information * report.residual_enu);
    report.weight = options_.kernel.evaluate(chi2).first;
    report.rejected = report.weight < kRejectedWeight;
    ++(report.rejected ? result_.fixes_rejected : result_.fixes_used);
    if (!report.rejected) squares += report.residual_enu.squaredNorm();
  }
  result_.residual_rms_m = std::sqrt(squares / std::max(1, result_.fixes_used));
  result_.lever_arm = calibration_.head<3>();
  result_.clock_offset_s = in_.clock_offset_s + calibration_[3];
  result_.trajectory = track_->moved(graph_);
  result_.scale = map_scale(map_, result_.graph);
  log(log_, LogLevel::kInfo, "georeference: {} fixes used, {} rejected", result_.fixes_used,
      result_.fixes_rejected);
}

}  // namespace

GeoreferenceResult georeference(const GeoreferenceInput& input, const GeoreferenceOptions& options,
                                const LogSink& log) {
  options.check();
  input.graph.check();
  require(!input.graph.nodes.empty(), "georeference: the graph has no nodes");
  require(input.lever_arm.allFinite(), "georeference: the lever arm is not finite");
  return Georeferencer(input, options, log).run();
}

}  // namespace placegraph
