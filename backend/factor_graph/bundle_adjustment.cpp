#include <placegraph/backend/factor_graph/bundle_adjustment.h>
#include <placegraph/backend/factor_graph/factor_graph.h>
#include <placegraph/backend/factors/radial_reprojection.h>

#include <cmath>

namespace placegraph {

BundleReport adjust_bundle(const Bundle& bundle, const BundleOptions& options) {
  options.check();
  bundle.check();
  BundleReport report;
  report.bundle = bundle;
  if (bundle.observations.empty()) {
    report.outcome = Outcome::failure(Outcome::Code::kTooFewData, "the bundle has no observations");
    return report;
  }
  // Variables: pose and [f, k1, k2] of every camera, then the points.
  FactorGraph graph;
  for (const BundleCamera& camera : bundle.cameras) {
    graph.add_variable(camera.T_world_cam);
    graph.add_variable(Eigen::Vector3d(camera.focal_px, camera.k1, camera.k2));
  }
  const int first_point = static_cast<int>(graph.variables.size());
  for (const Eigen::Vector3d& p_world : bundle.points) graph.add_variable(p_world);
  for (const BundleObservation& o : bundle.observations)
    graph.add(RadialReprojectionFactor(o.px, 1.0),
              {2 * o.camera, 2 * o.camera + 1, first_point + o.point}, options.kernel);

  const FactorGraphReport solved =
      optimize_factor_graph(graph, {options.max_iterations, options.relative_decrease});
  report.outcome = solved.outcome;
  report.cost_initial = solved.cost_initial;
  report.cost_final = solved.cost_final;
  report.iterations = solved.iterations;
  for (std::size_t i = 0; i < bundle.cameras.size(); ++i) {
    BundleCamera& camera = report.bundle.cameras[i];
    const int pose = 2 * static_cast<int>(i);
    camera.T_world_cam = solved.graph.value<SE3>(pose);
    const auto& intrinsics = solved.graph.value<Eigen::Vector3d>(pose + 1);
    camera.focal_px = intrinsics[0];
    camera.k1 = intrinsics[1];
    camera.k2 = intrinsics[2];
  }
  for (std::size_t i = 0; i < bundle.points.size(); ++i)
    report.bundle.points[i] =
        solved.graph.value<Eigen::Vector3d>(first_point + static_cast<int>(i));
  double sum = 0;
  for (const auto& square : squared_residuals(solved.graph)) sum += square.value_or(0);
  report.rms_px = std::sqrt(sum / static_cast<double>(bundle.observations.size()));
  return report;
}

}  // namespace placegraph
