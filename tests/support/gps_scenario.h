#pragma once
#include <placegraph/backend/georeference/georeference.h>
#include <placegraph/graph/core/random.h>
#include <placegraph/io/sensors/oxts_file.h>
#include <placegraph/io/trajectories/trajectory_file.h>

#include <Eigen/Geometry>
#include <cmath>
#include <string>
#include <vector>

namespace placegraph::test {

/// What is done to a drive's ground truth and GPS readings.
///
/// Drift: every relative pose is T_true exp(xi) with xi normal, its variance proportional to the
/// length d of the step (no less than `min_step_m`): a random walk of position and attitude. After
/// L metres of a straight road the position is off by sqrt(3 a^2 L + 2 b^2 L^3 / 3) RMS, with a and
/// b the two walks below; in percent of L and averaged over KITTI's lengths 100, 200 ... 800 m the
/// defaults make 1.0 (0.7 at 100 m, 1.3 at 800 m).
struct GpsScenarioOptions {
  std::uint64_t seed = 1;
  double noise_m = 1;                                 ///< of every fix, each coordinate, normal
  double gross_share = 0.05;                          ///< of fixes with a gross error
  double gross_min_m = 10, gross_max_m = 100;         ///< its length, uniform; direction uniform
  std::vector<std::pair<double, double>> dropouts_s;  ///< begin and end, no fixes in between
  double translation_walk = 0.03;                     ///< a [m per sqrt(m)], each axis
  double rotation_walk = 5.7e-4;                      ///< b [rad per sqrt(m)], each axis
  double min_step_m = 0.05;
  /// KITTI's poses were made from the readings, line by line; the clocks of the two files differ by
  /// a constant (0.06 s for 00, 0.12 s for 06). True: the reference of node i is reading i, so that
  /// the estimate must find that constant. False: the clocks are taken at their word, the reference
  /// is interpolated at the times of the nodes.
  bool reference_by_line = false;
  /// Of the GPS/inertial unit in KITTI's left camera, from the calibration of KITTI raw.
  Eigen::Vector3d lever_arm{-0.32, 0.72, -1.08};
};

struct GpsScenario {
  GeoreferenceInput input;
  std::vector<std::size_t> reading;  ///< of every fix, its line in the file of readings
  /// Ground truth put onto the noise-free readings, T_enu_cam about input.origin: attitude of the
  /// rigidly aligned ground truth, position of the reading less the lever arm.
  Trajectory reference;
  std::vector<char> inside;  ///< of every node, whether it lies in a dropout
};

inline bool in_dropout(const GpsScenarioOptions& options, std::int64_t stamp_ns) {
  for (const auto& [begin, end] : options.dropouts_s)
    if (1e-9 * static_cast<double>(stamp_ns) >= begin &&
        1e-9 * static_cast<double>(stamp_ns) <= end)
      return true;
  return false;
}

/// A position at a time between readings at most a second apart.
inline std::optional<Eigen::Vector3d> reading_at(const std::vector<GpsFix>& fixes,
                                                 const EnuFrame& enu, std::int64_t stamp_ns) {
  for (std::size_t i = 1; i < fixes.size(); ++i) {
    const std::int64_t a = fixes[i - 1].stamp_ns, b = fixes[i].stamp_ns;
    if (stamp_ns < a || stamp_ns > b || b - a > 1'000'000'000) continue;
    const double share = static_cast<double>(stamp_ns - a) / static_cast<double>(b - a);
    return (1 - share) * enu.to_enu(fixes[i - 1].position) + share * enu.to_enu(fixes[i].position);
  }
  return std::nullopt;
}

inline Eigen::Vector3d normal3(Random& random, double sigma) {
  const double x = random.normal(0, sigma), y = random.normal(0, sigma),
               z = random.normal(0, sigma);
  return {x, y, z};
}

/// The ground truth on the earth, see GpsScenario.
inline Trajectory reference_on_earth(const Trajectory& truth, const std::vector<GpsFix>& readings,
                                     const EnuFrame& enu, const GpsScenarioOptions& options) {
  std::vector<std::optional<Eigen::Vector3d>> seen;
  Eigen::Matrix3Xd from(3, static_cast<Eigen::Index>(truth.size())), to = from;
  Eigen::Index n = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    seen.push_back(options.reference_by_line ? enu.to_enu(readings[i].position)
                                             : reading_at(readings, enu, truth.poses[i].stamp_ns));
    if (!seen.back()) continue;
    from.col(n) = SE3(*truth.poses[i].T_world_body) * options.lever_arm;
    to.col(n++) = *seen.back();
  }
  const Eigen::Matrix4d T = Eigen::umeyama(from.leftCols(n), to.leftCols(n), false);
  const SO3 R_enu_world = SO3::from_matrix(T.topLeftCorner<3, 3>());
  Trajectory reference = truth;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const SO3 R_enu_cam = R_enu_world * SE3(*truth.poses[i].T_world_body).rotation();
    reference.poses[i].T_world_body.reset();
    if (seen[i])
      reference.poses[i].T_world_body =
          SE3(R_enu_cam, *seen[i] - R_enu_cam * options.lever_arm).isometry();
  }
  return reference;
}

/// From `folder` with poses.txt (T_world_cam0), times.txt, oxts.txt and times_oxts.txt.
inline GpsScenario make_gps_scenario(const std::string& folder, const GpsScenarioOptions& options) {
  const Trajectory truth = read_trajectory(folder + "/poses.txt", folder + "/times.txt");
  const std::vector<GpsFix> readings = read_oxts(folder + "/oxts.txt");
  GpsScenario scenario;
  GeoreferenceInput& in = scenario.input;
  in.origin = readings.front().position;
  in.lever_arm = options.lever_arm;
  const EnuFrame enu(*in.origin);
  scenario.reference = reference_on_earth(truth, readings, enu, options);

  Random drift(options.seed, 0), noise(options.seed, 1), gross(options.seed, 2);
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const NodeId id(i);
    in.visits.push_back({truth.poses[i].stamp_ns, id});
    scenario.inside.push_back(in_dropout(options, truth.poses[i].stamp_ns));
    if (i == 0) {
      in.graph.nodes.push_back({id, SE3(), true});
      continue;
    }
    const SE3 T_from_to =
        SE3(*truth.poses[i - 1].T_world_body).inverse() * SE3(*truth.poses[i].T_world_body);
    const double root = std::sqrt(std::max(T_from_to.translation().norm(), options.min_step_m));
    Vector6d sigma, xi;
    sigma << Eigen::Vector3d::Constant(options.translation_walk * root),
        Eigen::Vector3d::Constant(options.rotation_walk * root);
    for (int k = 0; k < 6; ++k) xi[k] = drift.normal(0, sigma[k]);
    RelativePoseConstraint edge;
    edge.from = NodeId(i - 1);
    edge.to = id;
    edge.T_from_to = T_from_to.plus(xi);
    edge.information = Matrix6d(sigma.array().square().inverse().matrix().asDiagonal());
    in.graph.nodes.push_back(
        {id, std::get<SE3>(in.graph.nodes.back().T_world_node) * std::get<SE3>(edge.T_from_to)});
    in.graph.constraints.emplace_back(edge);
  }
  for (std::size_t i = 0; i < readings.size(); ++i) {
    const Eigen::Vector3d error = normal3(noise, options.noise_m);
    const bool is_gross = gross.uniform() < options.gross_share;
    const Eigen::Vector3d direction = normal3(gross, 1).normalized();
    const double length = gross.uniform(options.gross_min_m, options.gross_max_m);
    if (in_dropout(options, readings[i].stamp_ns)) continue;
    Eigen::Vector3d position = enu.to_enu(readings[i].position) + error;
    if (is_gross) position += length * direction;
    GpsFix fix = readings[i];
    fix.position = enu.to_geodetic(position);
    fix.accuracy_m = options.noise_m;
    in.fixes.push_back(fix);
    scenario.reading.push_back(i);
  }
  return scenario;
}

/// RMSE [m] of the positions of the nodes inside or outside of the dropouts.
inline double position_rmse(const GpsScenario& scenario, const PoseGraph& graph, bool inside) {
  double squares = 0;
  int count = 0;
  for (std::size_t i = 0; i < graph.nodes.size(); ++i) {
    const auto& T_enu_cam = scenario.reference.poses[i].T_world_body;
    if (!T_enu_cam || (scenario.inside[i] != 0) != inside) continue;
    squares += (std::get<SE3>(graph.nodes[i].T_world_node).translation() - T_enu_cam->translation())
                   .squaredNorm();
    ++count;
  }
  return std::sqrt(squares / count);
}

}  // namespace placegraph::test
