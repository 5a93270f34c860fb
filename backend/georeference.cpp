#include <placegraph/backend/antenna_calibration.h>
#include <placegraph/backend/georeference.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace placegraph {
namespace {

constexpr double kHuberWidth = 1.345;
constexpr double kRejectedWeight = 0.1;
constexpr double kGrossChi2 = 25;
constexpr double kMedianOfNormal = 0.6745;  ///< median of |x| for x of unit deviation

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Component-wise, longitudes relative to the first fix: gross errors do not move it.
GeodeticPosition median_position(const std::vector<GpsFix>& fixes) {
  std::vector<double> latitudes, longitudes, heights;
  const double reference = fixes.front().position.longitude_deg;
  for (const GpsFix& fix : fixes) {
    latitudes.push_back(fix.position.latitude_deg);
    longitudes.push_back(std::remainder(fix.position.longitude_deg - reference, 360.0));
    heights.push_back(fix.position.height_m);
  }
  return {median(latitudes), std::remainder(reference + median(longitudes), 360.0),
          median(heights)};
}

/// T_enu_map in front of a pose of the map.
Pose placed(const Sim3& T_enu_map, const Pose& T_map_node) {
  if (const SE2* T = std::get_if<SE2>(&T_map_node)) {
    const SE3 rigid = SE3(T_enu_map.rotation(), T_enu_map.translation()) * rigid_part(*T);
    const Eigen::Matrix3d R = rigid.rotation().matrix();
    return SE2(rigid.translation().x(), rigid.translation().y(), std::atan2(R(1, 0), R(0, 0)));
  }
  if (const SE3* T = std::get_if<SE3>(&T_map_node))
    return SE3(T_enu_map.rotation(), T_enu_map.translation()) * *T;
  return T_enu_map * std::get<Sim3>(T_map_node);
}

AlignmentGroup alignment_group(PoseKind kind) {
  return kind == PoseKind::kSE2   ? AlignmentGroup::kPlanar
         : kind == PoseKind::kSE3 ? AlignmentGroup::kRigid
                                  : AlignmentGroup::kSimilarity;
}

double path_length(const std::vector<PositionPair>& pairs) {
  double length = 0;
  for (std::size_t i = 1; i < pairs.size(); ++i) length += (pairs[i].map - pairs[i - 1].map).norm();
  return length;
}

/// The part of a graph whose nodes are kept: constraints that join dropped ones go too.
PoseGraph kept_part(const PoseGraph& graph, const std::vector<char>& keep) {
  PoseGraph part;
  for (std::size_t i = 0; i < graph.nodes.size(); ++i)
    if (keep[i]) part.nodes.push_back(graph.nodes[i]);
  const auto index = part.index_by_id();
  for (const Constraint& constraint : graph.constraints) {
    const auto* edge = std::get_if<RelativePoseConstraint>(&constraint);
    if (edge && index.contains(edge->from) && index.contains(edge->to))
      part.constraints.push_back(constraint);
  }
  return part;
}

/// The work of georeference(), step by step.
class Georeferencer {
 public:
  Georeferencer(const GeoreferenceInput& input, const GeoreferenceOptions& options,
                const LogSink& log_sink)
      : in_(input), options_(options), log_(log_sink), visits_(input.visits) {
    calibration_ << input.lever_arm, 0.0;
    prior_.value = calibration_;
    if (options.estimate_lever_arm) prior_.sigma.head<3>().setConstant(options.lever_arm_sigma_m);
    if (input.graph.kind() == PoseKind::kSE2) prior_.sigma[2] = 0;
    if (options.estimate_clock_offset) prior_.sigma[3] = options.clock_offset_sigma_s;
  }

  GeoreferenceResult run() {
    locate_fixes();
    find_dropouts();
    result_.outcome = align();
    if (!result_.outcome) return std::move(result_);
    scatter_of_fixes();
    calibrate();
    if (result_.outcome.code == Outcome::Code::kDegenerate) return std::move(result_);
    solve(options_.kernel);
    finish();
    return std::move(result_);
  }

 private:
  void locate_fixes();
  void find_dropouts();
  void carry(const AntennaTrack& track);
  void carry_again();
  Eigen::Matrix3d information(int fix) const;
  Outcome align();
  GpsAlignment align_component(int component, const std::vector<int>& component_of, Random& random);
  void place(const std::vector<std::optional<Sim3>>& T_enu_map, const std::vector<int>& component);
  void scatter_of_fixes();
  void calibrate();
  void solve(const RobustKernel& kernel);
  void finish();
  Eigen::Vector3d residual(const AntennaObservation& seen) const;

  const GeoreferenceInput& in_;
  const GeoreferenceOptions& options_;
  const LogSink& log_;
  GeoreferenceResult result_;
  std::vector<NodeVisit> visits_;        ///< of the nodes that are placed
  PoseGraph graph_;                      ///< T_enu_node of the nodes that are placed
  std::optional<AntennaTrack> track_;    ///< about their poses in the map
  std::vector<std::int64_t> stamps_ns_;  ///< of the fixes, by the nodes' clock
  std::vector<Eigen::Vector3d> positions_enu_;
  std::vector<double> accuracy_m_;
  AntennaCalibration prior_;
  Eigen::Vector4d calibration_;  ///< as it stands
  std::vector<int> fix_of_;      ///< of every observation, its fix
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

void Georeferencer::find_dropouts() {
  if (visits_.empty()) return;
  const auto [first, last] =
      std::minmax_element(visits_.begin(), visits_.end(),
                          [](const auto& a, const auto& b) { return a.stamp_ns < b.stamp_ns; });
  std::int64_t begin = first->stamp_ns;
  const auto consider = [&](std::int64_t end) {
    if (1e-9 * static_cast<double>(end - begin) > options_.dropout_s)
      result_.dropouts.push_back({begin, end});
  };
  for (const std::int64_t stamp : stamps_ns_) {
    if (stamp < first->stamp_ns || stamp > last->stamp_ns) continue;
    consider(stamp);
    begin = stamp;
  }
  consider(last->stamp_ns);
}

Eigen::Matrix3d Georeferencer::information(int fix) const {
  const double horizontal = accuracy_m_[fix] * result_.accuracy_factor_horizontal;
  const double vertical = accuracy_m_[fix] * result_.accuracy_factor_vertical;
  return Eigen::Vector3d(1 / (horizontal * horizontal), 1 / (horizontal * horizontal),
                         1 / (vertical * vertical))
      .asDiagonal();
}

/// Takes the fixes to the nodes at the clock offset found so far.
void Georeferencer::carry(const AntennaTrack& track) {
  std::vector<std::int64_t> stamps_ns = stamps_ns_;
  const auto offset_ns = static_cast<std::int64_t>(std::llround(1e9 * calibration_[3]));
  for (std::int64_t& stamp : stamps_ns) stamp += offset_ns;
  const auto carried = track.carry(stamps_ns, calibration_.head<3>(), options_.max_gap_s);
  fix_of_.clear();
  observations_.clear();
  for (std::size_t i = 0; i < carried.size(); ++i) {
    if (!carried[i]) continue;
    const int fix = static_cast<int>(i);
    AntennaObservation seen{*carried[i], positions_enu_[i], information(fix)};
    seen.fix.t -= seen.fix.v * calibration_[3];
    if (!graph_.nodes.empty())  // the lever arm is in metres
      seen.fix.A /= scale_of(graph_.nodes[seen.fix.node].T_world_node);
    fix_of_.push_back(fix);
    observations_.push_back(seen);
  }
}

void Georeferencer::carry_again() {
  if (in_.motion.poses.empty())
    carry(AntennaTrack(graph_, visits_, {}));
  else
    carry(*track_);
}

Outcome Georeferencer::align() {
  const AntennaTrack track(in_.graph, visits_, in_.motion);
  carry(track);
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
  // In a Sim(3) map the length of the lever arm is not known yet, and it hardly matters here.
  const Eigen::Vector3d arm =
      kind == PoseKind::kSim3 ? Eigen::Vector3d::Zero() : Eigen::Vector3d(calibration_.head<3>());
  std::vector<PositionPair> pairs;
  for (std::size_t i = 0; i < observations_.size(); ++i) {
    const CarriedFix& fix = observations_[i].fix;
    if (component_of[fix.node] != component) continue;
    const Pose& T_map_node = in_.graph.nodes[fix.node].T_world_node;
    const Eigen::Vector3d p_node = scale_of(T_map_node) * fix.antenna(arm, calibration_[3]);
    pairs.push_back(
        {rigid_part(T_map_node) * p_node, positions_enu_[fix_of_[i]], accuracy_m_[fix_of_[i]]});
  }
  return align_to_fixes(pairs, alignment_group(kind), path_length(pairs), options_.alignment,
                        random);
}

void Georeferencer::place(const std::vector<std::optional<Sim3>>& T_enu_map,
                          const std::vector<int>& component) {
  std::vector<char> keep(in_.graph.nodes.size());
  for (std::size_t i = 0; i < keep.size(); ++i) {
    keep[i] = T_enu_map[static_cast<std::size_t>(component[i])].has_value();
    if (!keep[i]) result_.unplaced_nodes.push_back(in_.graph.nodes[i].id);
  }
  const PoseGraph map = kept_part(in_.graph, keep);
  graph_ = map;
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
  track_.emplace(map, visits_, in_.motion);
  carry_again();
}

Eigen::Vector3d Georeferencer::residual(const AntennaObservation& seen) const {
  const Pose& T_enu_node = graph_.nodes[seen.fix.node].T_world_node;
  const Eigen::Vector3d antenna = seen.fix.antenna(calibration_.head<3>(), calibration_[3]);
  Eigen::Vector3d e =
      rigid_part(T_enu_node) * (scale_of(T_enu_node) * antenna) - seen.position_world;
  if (in_.graph.kind() == PoseKind::kSE2) e[2] = 0;
  return e;
}

/// Optimizes with Huber's kernel until the scatter of the fixes stays the same. It is taken from
/// differences of successive residuals, which know nothing of a map that does not fit: what is left
/// of it cancels, and the median passes over gross errors.
void Georeferencer::scatter_of_fixes() {
  for (int round = 0; round < 5; ++round) {
    solve({RobustKernel::Kind::kHuber, kHuberWidth});
    if (!options_.estimate_accuracy) return;
    std::vector<double> horizontal, vertical;
    int last = -1;
    for (std::size_t i = 0; i < observations_.size(); ++i) {
      const Eigen::Vector3d e = residual(observations_[i]);
      // The first round knows no scale by which to call an error gross.
      if (round > 0 && e.dot(observations_[i].information * e) > kGrossChi2) continue;
      const int now = static_cast<int>(i);
      const int before = std::exchange(last, now);
      if (before < 0) continue;
      const int a = fix_of_[static_cast<std::size_t>(before)], b = fix_of_[i];
      if (1e-9 * static_cast<double>(stamps_ns_[b] - stamps_ns_[a]) > options_.max_gap_s) continue;
      const Eigen::Vector3d d = (e - residual(observations_[static_cast<std::size_t>(before)])) /
                                std::hypot(accuracy_m_[a], accuracy_m_[b]);
      horizontal.push_back(std::abs(d[0]));
      horizontal.push_back(std::abs(d[1]));
      vertical.push_back(std::abs(d[2]));
    }
    if (vertical.size() < 20) return;
    const double h = std::max(1.0, median(horizontal) / kMedianOfNormal);
    const double v = std::max(1.0, median(vertical) / kMedianOfNormal);
    const double change = std::max(std::abs(std::log(h / result_.accuracy_factor_horizontal)),
                                   std::abs(std::log(v / result_.accuracy_factor_vertical)));
    result_.accuracy_factor_horizontal = h;
    result_.accuracy_factor_vertical = v;
    for (std::size_t i = 0; i < observations_.size(); ++i)
      observations_[i].information = information(fix_of_[i]);
    if (change < 0.05) return;
  }
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
    carry_again();
    if (round > 0 && step.head<3>().norm() < 1e-3 && std::abs(step[3]) < 1e-4) break;
    kernel = options_.kernel;
  }
  for (int k = 0; k < 3; ++k)
    result_.lever_arm_observable[k] = prior_.sigma[k] > 0 && std::sqrt(result_.lever_arm_covariance(
                                                                 k, k)) < 0.5 * prior_.sigma[k];
}

/// Optimizes the poses with the calibration as it stands.
void Georeferencer::solve(const RobustKernel& kernel) {
  PoseGraph graph = graph_;
  for (const AntennaObservation& seen : observations_)
    graph.constraints.emplace_back(PositionConstraint{
        graph_.nodes[seen.fix.node].id, seen.position_world,
        seen.fix.antenna(calibration_.head<3>(), calibration_[3]), seen.information, kernel});
  PoseGraphOptions options = options_.solver;
  options.start = PoseGraphStart::kFile;  // the alignment; other starts know nothing of fixes
  const PoseGraphReport report = optimize_pose_graph(graph, options, log_);
  result_.outcome = report.outcome;
  result_.iterations += report.iterations;
  for (std::size_t i = 0; i < graph_.nodes.size(); ++i)
    graph_.nodes[i].T_world_node = report.graph.nodes[i].T_world_node;
  result_.graph = report.graph;
  carry_again();
}

void Georeferencer::finish() {
  double squares = 0;
  for (std::size_t i = 0; i < observations_.size(); ++i) {
    const AntennaObservation& seen = observations_[i];
    FixReport& report = result_.fixes[static_cast<std::size_t>(fix_of_[i])];
    report.node = seen.fix.node;
    report.residual_enu = residual(seen);
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
  log(log_, LogLevel::kInfo,
      "georeference: " + std::to_string(result_.fixes_used) + " fixes used, " +
          std::to_string(result_.fixes_rejected) + " rejected");
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
