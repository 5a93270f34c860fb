#include <placegraph/backend/factor_graph/factor_graph.h>
#include <placegraph/backend/factors/camera_reprojection.h>
#include <placegraph/backend/factors/point_observation.h>
#include <placegraph/pipeline/map/colmap_bundle.h>

#include <vector>

namespace placegraph {
namespace {

/// Writes the mean reprojection error of every point into the model; returns that of all
/// observations of points before the camera.
double measure_errors(ColmapModel& model) {
  std::vector<std::size_t> views(model.points.size(), 0);
  for (ColmapModel::Point& point : model.points) point.error_px = 0;
  double sum = 0;
  std::size_t count = 0;
  for (const ColmapModel::Image& image : model.images) {
    const SE3 T_cam_world = image.T_world_cam.inverse();
    for (const ColmapModel::Observation& seen : image.observations) {
      const auto at = static_cast<std::size_t>(seen.point);
      const auto px = model.camera.project(T_cam_world * model.points[at].p_world);
      if (!px) continue;
      const double error = (*px - seen.px).norm();
      model.points[at].error_px += error;
      ++views[at];
      sum += error;
      ++count;
    }
  }
  for (std::size_t i = 0; i < views.size(); ++i)
    if (views[i] > 0) model.points[i].error_px /= static_cast<double>(views[i]);
  return count > 0 ? sum / static_cast<double>(count) : 0;
}

}  // namespace

ColmapBundleReport adjust_colmap(const ColmapModel& model, const BundleOptions& options) {
  options.check();
  ColmapBundleReport report;
  report.model = model;
  FactorGraph graph;
  for (const ColmapModel::Image& image : model.images) graph.add_variable(image.T_world_cam);
  const int first_point = static_cast<int>(graph.variables.size());
  for (const ColmapModel::Point& point : model.points) graph.add_variable(point.p_world);
  for (std::size_t i = 0; i < model.images.size(); ++i)
    for (const ColmapModel::Observation& seen : model.images[i].observations)
      graph.add(
          PointObservationFactor<CameraReprojection>(CameraReprojection{model.camera, seen.px, 1}),
          {static_cast<int>(i), first_point + seen.point}, options.kernel);
  report.observations = graph.terms.size();
  report.error_before_px = report.error_px = measure_errors(report.model);
  if (graph.terms.empty()) {
    report.outcome = Outcome::failure(Outcome::Code::kTooFewData, "the model has no observations");
    return report;
  }
  const FactorGraphReport solved =
      optimize_factor_graph(graph, {options.max_iterations, options.relative_decrease});
  report.outcome = solved.outcome;
  report.cost_initial = solved.cost_initial;
  report.cost_final = solved.cost_final;
  report.iterations = solved.iterations;
  for (std::size_t i = 0; i < model.images.size(); ++i)
    report.model.images[i].T_world_cam = solved.graph.value<SE3>(static_cast<int>(i));
  for (std::size_t i = 0; i < model.points.size(); ++i)
    report.model.points[i].p_world =
        solved.graph.value<Eigen::Vector3d>(first_point + static_cast<int>(i));
  report.error_px = measure_errors(report.model);
  return report;
}

}  // namespace placegraph
