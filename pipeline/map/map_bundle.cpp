#include <placegraph/backend/factor_graph/factor_graph.h>
#include <placegraph/backend/factors/point_observation.h>
#include <placegraph/backend/factors/relative_pose.h>
#include <placegraph/graph/core/angle.h>
#include <placegraph/graph/core/median.h>
#include <placegraph/pipeline/map/map_bundle.h>

#include <algorithm>
#include <optional>
#include <unordered_map>

namespace placegraph {
namespace {

/// An observation of a landmark of the component.
struct BundledObservation {
  int view = 0, point = 0;  ///< positions in the geometry's keyframes and landmarks
  Eigen::Vector2d px;       ///< position in the undistorted image
  bool kept = false;        ///< whether the optimization uses it
};

std::vector<BundledObservation> observations_of(const MapGeometry& geometry) {
  std::unordered_map<LandmarkId, int> points;
  for (std::size_t i = 0; i < geometry.landmarks.size(); ++i)
    points.emplace(geometry.landmarks[i].id, static_cast<int>(i));
  std::vector<BundledObservation> observations;
  for (std::size_t i = 0; i < geometry.keyframes.size(); ++i)
    for (const LandmarkObservation& seen : geometry.keyframes[i].keyframe->observations) {
      const auto point = points.find(seen.landmark);
      if (point == points.end() || seen.camera != 0) continue;
      observations.push_back({static_cast<int>(i), point->second, seen.px.cast<double>(), false});
    }
  return observations;
}

/// Distance of the projected point from its observation; nothing if it cannot be projected.
std::optional<double> error_of(const MapGeometry& geometry, const Camera& camera,
                               const BundledObservation& observation) {
  const SE3& T_map_cam = geometry.keyframes[static_cast<std::size_t>(observation.view)].T_map_cam;
  const Eigen::Vector3d& p_map =
      geometry.landmarks[static_cast<std::size_t>(observation.point)].p_map;
  const auto px = camera.project(T_map_cam.inverse() * p_map);
  if (!px) return std::nullopt;
  return (*px - observation.px).norm();
}

/// Keeps the observations with an error of at most `limit_px` of points that have two of them.
/// Returns how many.
std::size_t keep_within(const MapGeometry& geometry, const Camera& camera, double limit_px,
                        std::vector<BundledObservation>& observations) {
  std::vector<int> views(geometry.landmarks.size(), 0);
  for (BundledObservation& observation : observations) {
    const auto error = error_of(geometry, camera, observation);
    observation.kept = error && *error <= limit_px;
    views[static_cast<std::size_t>(observation.point)] += observation.kept;
  }
  std::size_t kept = 0;
  for (BundledObservation& observation : observations) {
    observation.kept &= views[static_cast<std::size_t>(observation.point)] >= 2;
    kept += observation.kept;
  }
  return kept;
}

/// Adds the relative poses of consecutive keyframes, with the standard deviations of adjust_map.
void add_chain(const MapGeometry& geometry, FactorGraph& graph) {
  // 5 % of a step and half a degree, as in adjust_map. Chosen.
  constexpr double kOfStep = 0.05;
  const double sigma_rad = deg_to_rad(0.5);
  std::vector<SE3> steps;
  std::vector<double> lengths;
  for (std::size_t i = 0; i + 1 < geometry.keyframes.size(); ++i) {
    steps.push_back(geometry.keyframes[i].T_map_cam.inverse() *
                    geometry.keyframes[i + 1].T_map_cam);
    lengths.push_back(steps.back().translation().norm());
  }
  if (steps.empty()) return;
  const double usual = median_of(lengths);
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const double sigma = kOfStep * std::max({lengths[i], usual, 1e-6});
    Vector6d weights;
    weights << Eigen::Vector3d::Constant(1 / sigma), Eigen::Vector3d::Constant(1 / sigma_rad);
    graph.add(RelativePoseFactor<SE3>(steps[i], Matrix6d(weights.asDiagonal())),
              {static_cast<int>(i), static_cast<int>(i) + 1});
  }
}

/// Optimizes poses and points by the observations that are kept.
void optimize_kept(const Camera& camera, const MapBundleOptions& options, double kernel_px,
                   const std::vector<BundledObservation>& observations, MapGeometry& geometry) {
  FactorGraph graph;
  for (std::size_t i = 0; i < geometry.keyframes.size(); ++i)
    graph.add_variable(geometry.keyframes[i].T_map_cam, i == 0);
  std::vector<int> variables(geometry.landmarks.size(), -1);
  const RobustKernel kernel{RobustKernel::Kind::kCauchy, kernel_px};
  for (const BundledObservation& observation : observations) {
    if (!observation.kept) continue;
    int& variable = variables[static_cast<std::size_t>(observation.point)];
    if (variable < 0)
      variable =
          graph.add_variable(geometry.landmarks[static_cast<std::size_t>(observation.point)].p_map);
    graph.add(PointObservationFactor<Reprojection>(Reprojection(camera, observation.px, 1.0)),
              {observation.view, variable}, kernel);
  }
  add_chain(geometry, graph);
  // Relative decrease of the cost that ends the optimization. Chosen.
  constexpr double kDecrease = 1e-5;
  const FactorGraphReport solved =
      optimize_factor_graph(graph, {options.max_iterations, kDecrease});
  if (!(solved.cost_final <= solved.cost_initial)) return;
  for (std::size_t i = 0; i < geometry.keyframes.size(); ++i)
    geometry.keyframes[i].T_map_cam = solved.graph.value<SE3>(static_cast<int>(i));
  for (std::size_t i = 0; i < variables.size(); ++i)
    if (variables[i] >= 0)
      geometry.landmarks[i].p_map = solved.graph.value<Eigen::Vector3d>(variables[i]);
}

/// Mean reprojection error of all observations that can be projected; 0 without any.
double mean_error(const MapGeometry& geometry, const Camera& camera,
                  const std::vector<BundledObservation>& observations) {
  double sum = 0;
  std::size_t count = 0;
  for (const BundledObservation& observation : observations)
    if (const auto error = error_of(geometry, camera, observation)) {
      sum += *error;
      ++count;
    }
  return count > 0 ? sum / static_cast<double>(count) : 0;
}

/// Writes what was kept into the bundle.
void describe_kept(const MapGeometry& geometry, const Camera& camera,
                   const std::vector<BundledObservation>& observations, MapBundle& bundle) {
  for (const PosedKeyframe& posed : geometry.keyframes)
    bundle.views.push_back({posed.keyframe, posed.T_map_cam, {}});
  std::vector<int> numbers(geometry.landmarks.size(), -1);
  for (const BundledObservation& observation : observations)
    if (observation.kept) numbers[static_cast<std::size_t>(observation.point)] = 0;
  for (std::size_t i = 0; i < numbers.size(); ++i)
    if (numbers[i] == 0) {
      numbers[i] = static_cast<int>(bundle.points.size());
      bundle.points.push_back({geometry.landmarks[i], 0, 0});
    }
  double sum = 0;
  for (const BundledObservation& observation : observations) {
    if (!observation.kept) continue;
    const int number = numbers[static_cast<std::size_t>(observation.point)];
    bundle.views[static_cast<std::size_t>(observation.view)].observations.push_back(
        {observation.px, number});
    MapBundle::Point& point = bundle.points[static_cast<std::size_t>(number)];
    const double error = error_of(geometry, camera, observation).value_or(0);
    ++point.views;
    point.error_px += error;
    sum += error;
    ++bundle.kept;
  }
  for (MapBundle::Point& point : bundle.points) point.error_px /= point.views;
  if (bundle.kept > 0) bundle.error_px = sum / static_cast<double>(bundle.kept);
}

}  // namespace

MapBundle adjust_map(const Map& map, int component, const Camera& camera,
                     const MapBundleOptions& options) {
  MapGeometry geometry = geometry_of(map, component);
  std::vector<BundledObservation> observations = observations_of(geometry);
  MapBundle bundle;
  bundle.offered = observations.size();
  bundle.error_before_px = mean_error(geometry, camera, observations);
  // Loops have moved places since the landmarks were estimated: the first rounds accept more.
  struct Round {
    double limit_px, kernel_px;
  };
  const double limit = options.max_error_px, kernel = options.kernel_px;
  for (const Round& round :
       {Round{25 * limit, 4 * kernel}, Round{4 * limit, 2 * kernel}, Round{limit, kernel}})
    if (keep_within(geometry, camera, round.limit_px, observations) > 0)
      optimize_kept(camera, options, round.kernel_px, observations, geometry);
  if (keep_within(geometry, camera, limit, observations) == 0) {
    bundle.outcome = Outcome::failure(Outcome::Code::kTooFewData,
                                      "no landmark has two observations that agree with it");
    return bundle;
  }
  describe_kept(geometry, camera, observations, bundle);
  bundle.outcome = Outcome::ok();
  return bundle;
}

}  // namespace placegraph
