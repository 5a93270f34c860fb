#include <placegraph/backend/factors/reprojection.h>
#include <placegraph/backend/sliding_window.h>
#include <placegraph/backend/window_state.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace placegraph {

void SlidingWindowOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, SlidingWindowOptions& o) {
  field("max_keyframes", o.max_keyframes, "the oldest keyframe is marginalized beyond this",
        {2, 1000});
  field("max_iterations", o.max_iterations, "steps of Levenberg-Marquardt", {1, 1000});
  field("huber_px", o.huber_px, "width of the Huber kernel, in standard deviations", {1e-3, 1e6});
  field("relative_decrease", o.relative_decrease,
        "stop when the cost falls by less than this share", {0, 1});
}

struct SlidingWindow::Impl {
  WindowState state;

  SE3& keyframe(std::int64_t id) {
    const auto it = state.keyframes.find(id);
    require(it != state.keyframes.end(),
            "sliding window: keyframe " + std::to_string(id) + " is not in the window");
    return it->second;
  }
  WindowLandmark& landmark(std::int64_t id) {
    const auto it = state.landmarks.find(id);
    require(it != state.landmarks.end(),
            "sliding window: landmark " + std::to_string(id) + " is not in the window");
    return it->second;
  }
};

SlidingWindow::SlidingWindow(const SlidingWindowOptions& options, const Camera& camera)
    : impl_(std::make_unique<Impl>()) {
  options.check();
  camera.check();
  require(camera.distortion == Distortion::kNone, "sliding window: the camera must be undistorted");
  impl_->state.options = options;
  impl_->state.camera = camera;
}
SlidingWindow::~SlidingWindow() = default;
SlidingWindow::SlidingWindow(SlidingWindow&&) noexcept = default;
SlidingWindow& SlidingWindow::operator=(SlidingWindow&&) noexcept = default;

void SlidingWindow::add_keyframe(std::int64_t id, const SE3& T_map_cam) {
  WindowState& state = impl_->state;
  require(state.keyframes.empty() || id > state.keyframes.rbegin()->first,
          "sliding window: keyframe " + std::to_string(id) + " is not newer than the last one");
  require(T_map_cam.matrix().allFinite(),
          "sliding window: pose of keyframe " + std::to_string(id) + " is not finite");
  if (state.keyframes.empty() && state.prior.empty()) state.fixed = id;
  state.keyframes.emplace(id, T_map_cam);
}

void SlidingWindow::add_landmark(std::int64_t id, const Eigen::Vector3d& p_map) {
  require(p_map.allFinite(), "sliding window: landmark " + std::to_string(id) + " is not finite");
  const bool added = impl_->state.landmarks.try_emplace(id, WindowLandmark{p_map, {}}).second;
  require(added, "sliding window: landmark " + std::to_string(id) + " is there already");
}

void SlidingWindow::add_observation(const WindowObservation& o) {
  impl_->keyframe(o.keyframe);
  std::vector<WindowObservation>& list = impl_->landmark(o.landmark).observations;
  const std::string name = "sliding window: observation of landmark " + std::to_string(o.landmark) +
                           " in keyframe " + std::to_string(o.keyframe);
  require(o.px.allFinite() && std::isfinite(o.sigma_px) && o.sigma_px > 0,
          name + ": px must be finite and sigma_px positive");
  require(!o.inverse_depth || (std::isfinite(*o.inverse_depth) && o.sigma_inverse_depth > 0 &&
                               std::isfinite(o.sigma_inverse_depth)),
          name + ": inverse_depth must be finite and its sigma positive");
  const auto at = std::lower_bound(
      list.begin(), list.end(), o.keyframe,
      [](const WindowObservation& a, std::int64_t keyframe) { return a.keyframe < keyframe; });
  require(at == list.end() || at->keyframe != o.keyframe, name + " is there already");
  list.insert(at, o);
}

void SlidingWindow::add_distance(const DistanceObservation& d) {
  impl_->keyframe(d.from);
  impl_->keyframe(d.to);
  require(d.from != d.to, "sliding window: a distance needs two keyframes");
  require(
      std::isfinite(d.distance_m) && d.distance_m >= 0 && std::isfinite(d.sigma_m) && d.sigma_m > 0,
      "sliding window: distance_m must be finite and not negative, sigma_m positive");
  impl_->state.distances.push_back(d);
}

void SlidingWindow::remove_landmark(std::int64_t id) {
  impl_->landmark(id);
  impl_->state.landmarks.erase(id);
}

void SlidingWindow::remove_observation(std::int64_t keyframe, std::int64_t landmark) {
  const std::size_t removed =
      std::erase_if(impl_->landmark(landmark).observations,
                    [&](const WindowObservation& o) { return o.keyframe == keyframe; });
  require(removed > 0, "sliding window: landmark " + std::to_string(landmark) +
                           " has no observation in keyframe " + std::to_string(keyframe));
}

WindowSummary SlidingWindow::optimize() { return optimize_window(impl_->state); }

std::vector<std::int64_t> SlidingWindow::marginalize() {
  WindowState& state = impl_->state;
  std::vector<std::int64_t> left;
  while (static_cast<int>(state.keyframes.size()) > state.options.max_keyframes) {
    left.push_back(state.keyframes.begin()->first);
    marginalize_keyframe(state, left.back());
  }
  return left;
}

void SlidingWindow::rescale(double scale) {
  WindowState& state = impl_->state;
  require(std::isfinite(scale) && scale > 0, "sliding window: scale must be positive");
  require(!has_metric_observation(state) && !state.prior_is_metric,
          "sliding window: the scale is measured already, it cannot be set");
  if (state.keyframes.empty()) return;
  const Eigen::Vector3d center_map = state.keyframes.begin()->second.translation();
  const auto move = [&](const Eigen::Vector3d& p_map) -> Eigen::Vector3d {
    return center_map + scale * (p_map - center_map);
  };
  for (auto& [id, T_map_cam] : state.keyframes)
    T_map_cam = SE3(T_map_cam.rotation(), move(T_map_cam.translation()));
  for (auto& [id, landmark] : state.landmarks) landmark.p_map = move(landmark.p_map);
  // Deviations of position grow by `scale`, so their columns shrink: the residual stays the same.
  for (std::size_t k = 0; k < state.prior.keyframes.size(); ++k) {
    SE3& T_lin = state.prior.T_map_cam_lin[k];
    T_lin = SE3(T_lin.rotation(), move(T_lin.translation()));
    state.prior.J.middleCols<3>(6 * static_cast<Eigen::Index>(k)) /= scale;
  }
}

std::vector<std::int64_t> SlidingWindow::keyframes() const {
  std::vector<std::int64_t> ids;
  for (const auto& [id, T_map_cam] : impl_->state.keyframes) ids.push_back(id);
  return ids;
}

std::vector<std::int64_t> SlidingWindow::landmarks() const {
  std::vector<std::int64_t> ids;
  for (const auto& [id, landmark] : impl_->state.landmarks) ids.push_back(id);
  return ids;
}

SE3 SlidingWindow::pose(std::int64_t keyframe) const { return impl_->keyframe(keyframe); }

std::optional<Eigen::Vector3d> SlidingWindow::landmark(std::int64_t id) const {
  const auto it = impl_->state.landmarks.find(id);
  if (it == impl_->state.landmarks.end()) return std::nullopt;
  return it->second.p_map;
}

const std::vector<WindowObservation>& SlidingWindow::observations(std::int64_t landmark) const {
  return impl_->landmark(landmark).observations;
}

std::optional<Eigen::Vector2d> SlidingWindow::residual_px(const WindowObservation& o) const {
  const auto keyframe = impl_->state.keyframes.find(o.keyframe);
  const auto landmark = impl_->state.landmarks.find(o.landmark);
  if (keyframe == impl_->state.keyframes.end() || landmark == impl_->state.landmarks.end())
    return std::nullopt;
  const SE3& T_map_cam = keyframe->second;
  const PointInCamera point(T_map_cam.rotation().matrix(), T_map_cam.translation(),
                            landmark->second.p_map);
  if (!point.projectable()) return std::nullopt;
  return Reprojection(impl_->state.camera, o.px, 1.0).residual(point.p_cam);
}

Matrix6d SlidingWindow::relative_information(std::int64_t from, std::int64_t to) const {
  impl_->keyframe(from);
  impl_->keyframe(to);
  require(from != to, "sliding window: a relative pose needs two keyframes");
  return placegraph::relative_information(impl_->state, from, to);
}

}  // namespace placegraph
