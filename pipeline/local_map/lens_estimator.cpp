#include <placegraph/backend/window/window_problem.h>
#include <placegraph/backend/window/window_state.h>
#include <placegraph/pipeline/local_map/lens_estimator.h>

#include <cmath>

namespace placegraph {
namespace {

WindowMotion motion_of(const SlidingWindow& window) {
  const auto keyframes = window.keyframes();
  const SE3 T_map_first = window.pose(keyframes.front());
  const SE3 T_first_last = T_map_first.inverse() * window.pose(keyframes.back());
  const Eigen::Vector3d t = T_first_last.translation();
  return {T_map_first.rotation(), t.norm() > 0 ? Eigen::Vector3d(t.normalized()) : t,
          T_first_last.rotation()};
}

/// The points of a window and its poses, without what was estimated from other pixels.
WindowState points_of(WindowState state) {
  state.lines.clear();
  state.prior = {};
  state.prior_is_metric = state.prior_holds_scale = false;
  state.fixed = state.keyframes.begin()->first;
  return state;
}

/// Removes the measured depths; returns whether there were any.
bool drop_depths(WindowState& state) {
  bool any = false;
  for (auto& [id, landmark] : state.landmarks)
    for (WindowObservation& o : landmark.observations) {
      any = any || o.inverse_depth;
      o.inverse_depth.reset();
    }
  return any;
}

/// Evidence about k1 at the optimum of the points for `k1`, with all pixels undistorted by it.
DistortionEvidence evidence_at(double k1, WindowState points) {
  if (k1 == 0) return lens_evidence(points);
  Camera lens = points.camera;
  lens.distortion = Distortion::kRadialTangential;
  lens.coefficients = {k1};
  for (auto& [id, landmark] : points.landmarks)
    for (WindowObservation& o : landmark.observations)
      if (const auto ray = lens.unproject(o.px)) o.px = *points.camera.project(*ray);
  if (!optimize_window(points).outcome) return {};
  DistortionEvidence evidence = lens_evidence(points);
  evidence.gradient -= evidence.information * k1;
  return evidence;
}

/// `before` with the evidence of a window. At 0 the evidence of a large distortion is wrong,
/// because it is not linear and the points that show it most clearly have little weight as
/// outliers: it is computed again at the estimate.
LensStretches with_window(const LensStretches& before, const WindowState& points,
                          const WindowMotion& motion) {
  // Iterations at most, and the change of k1 that ends them: below kCommonSigma of
  // lens_stretches.cpp. Chosen.
  constexpr int kIterations = 4;
  constexpr double kAccuracy = 1e-3;
  LensStretches after;
  double k1 = before.linearization();
  for (int i = 0; i < kIterations; ++i) {
    after = before;
    after.add(evidence_at(k1, points), motion);
    const double next = after.linearization();
    if (std::abs(next - k1) < kAccuracy) break;
    k1 = next;
  }
  return after;
}

/// |k1| in standard deviations.
double clearness(const LensDistortion& lens) { return std::abs(lens.k1) / lens.sigma_k1; }

}  // namespace

bool LensEstimator::observe(const SlidingWindow& window) {
  const auto keyframes = window.keyframes();
  if (keyframes.empty() || keyframes.front() <= newest_) return false;
  newest_ = keyframes.back();
  const WindowMotion motion = motion_of(window);
  WindowState points = points_of(window.state());
  const WindowState measured = points;
  if (drop_depths(points)) with_depth_ = with_window(with_depth_, measured, motion);
  points_ = with_window(points_, points, motion);
  return true;
}

LensDistortion LensEstimator::estimate() const {
  const LensDistortion points = points_.estimate(), depth = with_depth_.estimate();
  return clearness(depth) > clearness(points) ? depth : points;
}

}  // namespace placegraph
