#include <placegraph/backend/factors/line_reprojection.h>
#include <placegraph/backend/factors/reprojection.h>
#include <placegraph/backend/linear/whitening.h>
#include <placegraph/backend/window/sliding_window_impl.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace placegraph {

void SlidingWindowOptions::check() const {
  check_ranges(*this);
  require(scale_drift >= 0 && scale_drift <= 1, "scale_drift: must lie between 0 and 1");
}

void visit(OptionVisitor& field, SlidingWindowOptions& o) {
  field("max_keyframes", o.max_keyframes, "the oldest keyframe is marginalized beyond this",
        {2, 1000});
  field("max_iterations", o.max_iterations, "steps of Levenberg-Marquardt", {1, 1000});
  field("huber_px", o.huber_px, "width of the Huber kernel, in standard deviations", {1e-3, 1e6});
  field("relative_decrease", o.relative_decrease,
        "stop when the cost falls by less than this share", {0, 1});
}

namespace {

bool is_positive_definite(const Eigen::Matrix2d& m) {
  return m.allFinite() && std::abs(m(0, 1) - m(1, 0)) <= 1e-6 * m.trace() && m(0, 0) > 0 &&
         m.determinant() > 0;
}

/// Inserts an observation in the order of the keyframes; throws if its keyframe has one already.
template <class Observation>
void insert_observation(std::vector<Observation>& list, const Observation& o,
                        const std::string& name) {
  const auto at = std::lower_bound(
      list.begin(), list.end(), o.keyframe,
      [](const Observation& a, std::int64_t keyframe) { return a.keyframe < keyframe; });
  require(at == list.end() || at->keyframe != o.keyframe, name + " is there already");
  list.insert(at, o);
}

std::optional<Matrix6d> inverse_if_full(const Matrix6d& information) {
  bool deficient = false;
  whitening(information, &deficient);
  if (deficient) return std::nullopt;
  return Matrix6d(information.llt().solve(Matrix6d::Identity()));
}

void require_sound(const SE3& pose, const Matrix6d& information, const std::string& name) {
  require(pose.matrix().allFinite() && information.allFinite() &&
              information.isApprox(information.transpose(), 1e-9),
          name + ": the pose must be finite, the information symmetric and finite");
  const Eigen::SelfAdjointEigenSolver<Matrix6d> eigen(information);
  const double least = eigen.eigenvalues()[0], largest = eigen.eigenvalues()[5];
  require(largest > 0 && least >= -1e-9 * largest,
          name + ": the information must be positive semi-definite and not zero");
}

void require_sound(const LineObservation::SecondEye& eye, const std::string& name) {
  require(eye.eye_cam.allFinite() && eye.eye_cam.norm() > 0 && eye.start_px.allFinite() &&
              eye.end_px.allFinite() && positive(eye.sigma_px),
          name + ": a second eye must lie elsewhere, be finite and its sigma_px positive");
}

}  // namespace

SlidingWindow::SlidingWindow(const SlidingWindowOptions& options, const Camera& camera)
    : impl_(std::make_unique<Impl>()) {
  options.check();
  camera.check();
  require(camera.distortion == Distortion::kNone, "sliding window: the camera must be undistorted");
  impl_->change().options = options;
  impl_->change().camera = camera;
}
SlidingWindow::~SlidingWindow() = default;
SlidingWindow::SlidingWindow(SlidingWindow&&) noexcept = default;
SlidingWindow& SlidingWindow::operator=(SlidingWindow&&) noexcept = default;

void SlidingWindow::add_keyframe(std::int64_t id, const SE3& T_map_cam) {
  WindowState& state = impl_->change();
  require(state.keyframes.empty() || id > state.keyframes.rbegin()->first,
          "sliding window: keyframe " + std::to_string(id) + " is not newer than the last one");
  require(T_map_cam.matrix().allFinite(),
          "sliding window: pose of keyframe " + std::to_string(id) + " is not finite");
  if (state.keyframes.empty() && state.prior.empty()) state.fixed = id;
  state.keyframes.emplace(id, T_map_cam);
}

void SlidingWindow::add_landmark(std::int64_t id, const Eigen::Vector3d& p_map) {
  require(p_map.allFinite(), "sliding window: landmark " + std::to_string(id) + " is not finite");
  const bool added =
      impl_->change().landmarks.try_emplace(id, WindowLandmark{p_map, {}, {}}).second;
  require(added, "sliding window: landmark " + std::to_string(id) + " is there already");
}

void SlidingWindow::add_observation(const WindowObservation& o) {
  impl_->keyframe(o.keyframe);
  impl_->landmark(o.landmark);
  std::vector<WindowObservation>& list = impl_->change().landmarks.at(o.landmark).observations;
  const std::string name = "sliding window: observation of landmark " + std::to_string(o.landmark) +
                           " in keyframe " + std::to_string(o.keyframe);
  require(o.px.allFinite() && std::isfinite(o.sigma_px) && o.sigma_px > 0,
          name + ": px must be finite and sigma_px positive");
  require(!o.covariance_px || is_positive_definite(*o.covariance_px),
          name + ": covariance_px must be finite and positive definite");
  require(!o.inverse_depth || (std::isfinite(*o.inverse_depth) && o.sigma_inverse_depth > 0 &&
                               std::isfinite(o.sigma_inverse_depth)),
          name + ": inverse_depth must be finite and its sigma positive");
  insert_observation(list, o, name);
}

void SlidingWindow::add_distance(const DistanceObservation& d) {
  impl_->keyframe(d.from);
  impl_->keyframe(d.to);
  require(d.from != d.to, "sliding window: a distance needs two keyframes");
  require(
      std::isfinite(d.distance_m) && d.distance_m >= 0 && std::isfinite(d.sigma_m) && d.sigma_m > 0,
      "sliding window: distance_m must be finite and not negative, sigma_m positive");
  impl_->change().distances.push_back(d);
}

void SlidingWindow::keep(std::int64_t keyframe, bool kept) {
  impl_->keyframe(keyframe);
  if (kept)
    impl_->change().kept.insert(keyframe);
  else
    impl_->change().kept.erase(keyframe);
}

void SlidingWindow::add_line(std::int64_t id, const Line3& line_map) {
  require(line_map.coordinates().allFinite(),
          "sliding window: line " + std::to_string(id) + " is not finite");
  const bool added = impl_->change().lines.try_emplace(id, WindowLine{line_map, {}}).second;
  require(added, "sliding window: line " + std::to_string(id) + " is there already");
}

void SlidingWindow::add_line_observation(const LineObservation& o) {
  impl_->keyframe(o.keyframe);
  impl_->line(o.line);
  std::vector<LineObservation>& list = impl_->change().lines.at(o.line).observations;
  const std::string name = "sliding window: observation of line " + std::to_string(o.line) +
                           " in keyframe " + std::to_string(o.keyframe);
  require(o.start_px.allFinite() && o.end_px.allFinite() && positive(o.sigma_px),
          name + ": its ends must be finite and sigma_px positive");
  if (o.second) require_sound(*o.second, name);
  insert_observation(list, o, name);
}

const std::vector<LineObservation>& SlidingWindow::line_observations(std::int64_t line) const {
  return impl_->line(line).observations;
}

std::optional<Eigen::Vector2d> SlidingWindow::residual_px(const LineObservation& o) const {
  const WindowState& state = impl_->state();
  const auto keyframe = state.keyframes.find(o.keyframe);
  const auto line = state.lines.find(o.line);
  if (keyframe == state.keyframes.end() || line == state.lines.end()) return std::nullopt;
  LineReprojectionFactor::Residual r;
  LineReprojectionFactor(state.camera, o.start_px, o.end_px, 1.0)
      .compute(keyframe->second, line->second.line_map, r, nullptr);
  return Eigen::Vector2d(r);
}

void SlidingWindow::remove_line(std::int64_t id) {
  impl_->line(id);
  impl_->change().lines.erase(id);
}

void SlidingWindow::add_pose_prior(const PosePrior& prior) {
  impl_->keyframe(prior.keyframe);
  require_sound(prior.T_map_cam, prior.information,
                "sliding window: prior of keyframe " + std::to_string(prior.keyframe));
  impl_->change().pose_priors.push_back(prior);
  bool deficient = false;
  whitening(prior.information, &deficient);
  if (!deficient && impl_->change().fixed == prior.keyframe) impl_->change().fixed.reset();
}

void SlidingWindow::add_motion(const MotionObservation& motion) {
  impl_->keyframe(motion.from);
  impl_->keyframe(motion.to);
  require(motion.from != motion.to, "sliding window: a motion needs two keyframes");
  require_sound(motion.T_from_to, motion.information,
                "sliding window: motion from keyframe " + std::to_string(motion.from));
  impl_->change().motions.push_back(motion);
}

void SlidingWindow::remove_landmark(std::int64_t id) {
  impl_->landmark(id);
  impl_->change().landmarks.erase(id);
}

void SlidingWindow::remove_observation(std::int64_t keyframe, std::int64_t landmark) {
  impl_->landmark(landmark);
  const std::size_t removed =
      std::erase_if(impl_->change().landmarks.at(landmark).observations,
                    [&](const WindowObservation& o) { return o.keyframe == keyframe; });
  require(removed > 0, "sliding window: landmark " + std::to_string(landmark) +
                           " has no observation in keyframe " + std::to_string(keyframe));
}

void SlidingWindow::revise_inverse_depth(std::int64_t keyframe, std::int64_t landmark,
                                         double inverse_depth) {
  require(std::isfinite(inverse_depth), "sliding window: inverse_depth must be finite");
  impl_->landmark(landmark);
  for (WindowObservation& o : impl_->change().landmarks.at(landmark).observations)
    if (o.keyframe == keyframe && o.inverse_depth) {
      o.inverse_depth = inverse_depth;
      return;
    }
  throw ArgumentError("sliding window: landmark " + std::to_string(landmark) +
                      " has no inverse depth in keyframe " + std::to_string(keyframe));
}

void SlidingWindow::revise_second_eye(std::int64_t keyframe, std::int64_t line,
                                      const LineObservation::SecondEye& second) {
  impl_->line(line);
  require_sound(second, "sliding window: line " + std::to_string(line) + " in keyframe " +
                            std::to_string(keyframe));
  for (LineObservation& o : impl_->change().lines.at(line).observations)
    if (o.keyframe == keyframe && o.second) {
      o.second = second;
      return;
    }
  throw ArgumentError("sliding window: line " + std::to_string(line) +
                      " has no second eye in keyframe " + std::to_string(keyframe));
}

WindowSummary SlidingWindow::optimize() { return optimize_window(impl_->change()); }

std::vector<std::int64_t> SlidingWindow::marginalize() {
  WindowState& state = impl_->change();
  std::vector<std::int64_t> left;
  while (static_cast<int>(state.keyframes.size()) > state.options.max_keyframes) {
    // The newest stays in any case.
    const auto newest = std::prev(state.keyframes.end());
    const auto oldest = std::find_if(state.keyframes.begin(), newest, [&](const auto& keyframe) {
      return !state.kept.contains(keyframe.first);
    });
    if (oldest == newest) break;
    left.push_back(oldest->first);
    const auto held_before = state.fixed;
    marginalize_keyframe(state, left.back());
    if (state.fixed && state.fixed != held_before) impl_->tied_to_map = false;
  }
  return left;
}

void SlidingWindow::rescale(double scale) {
  WindowState& state = impl_->change();
  require(std::isfinite(scale) && scale > 0, "sliding window: scale must be positive");
  require(!has_metric_observation(state) && !state.prior_is_metric && state.prior.planes.empty(),
          "sliding window: the scale is measured already, it cannot be set");
  if (state.keyframes.empty()) return;
  const Eigen::Vector3d center_map = state.keyframes.begin()->second.translation();
  const auto move = [&](const Eigen::Vector3d& p_map) -> Eigen::Vector3d {
    return center_map + scale * (p_map - center_map);
  };
  for (auto& [id, T_map_cam] : state.keyframes)
    T_map_cam = SE3(T_map_cam.rotation(), move(T_map_cam.translation()));
  for (auto& [id, landmark] : state.landmarks) landmark.p_map = move(landmark.p_map);
  for (auto& [id, line] : state.lines)
    line.line_map =
        Line3::from_direction(move(line.line_map.nearest_point()), line.line_map.direction());
  for (auto& [id, plane_map] : state.planes)
    plane_map = Plane3(plane_map.normal(),
                       plane_map.normal().dot(move(plane_map.distance() * plane_map.normal())));
  // What holds a direction of the way only does so in any unit.
  for (MotionObservation& motion : state.motions) {
    motion.T_from_to = motion.T_from_to.scaled(scale);
    motion.information.topRows<3>() /= scale;
    motion.information.leftCols<3>() /= scale;
  }
  // Deviations of position grow by `scale`, so their columns shrink: the residual stays the same.
  for (std::size_t k = 0; k < state.prior.keyframes.size(); ++k) {
    SE3& T_lin = state.prior.T_map_cam_lin[k];
    T_lin = SE3(T_lin.rotation(), move(T_lin.translation()));
    state.prior.J.middleCols<3>(6 * static_cast<Eigen::Index>(k)) /= scale;
  }
}

std::vector<std::int64_t> SlidingWindow::keyframes() const {
  return ids_of(impl_->state().keyframes);
}

std::vector<std::int64_t> SlidingWindow::landmarks() const {
  return ids_of(impl_->state().landmarks);
}

std::vector<std::int64_t> SlidingWindow::lines() const { return ids_of(impl_->state().lines); }

std::optional<Line3> SlidingWindow::line(std::int64_t id) const {
  const auto it = impl_->state().lines.find(id);
  if (it == impl_->state().lines.end()) return std::nullopt;
  return it->second.line_map;
}

SE3 SlidingWindow::pose(std::int64_t keyframe) const { return impl_->keyframe(keyframe); }

std::optional<Eigen::Vector3d> SlidingWindow::landmark(std::int64_t id) const {
  const auto it = impl_->state().landmarks.find(id);
  if (it == impl_->state().landmarks.end()) return std::nullopt;
  return it->second.p_map;
}

const std::vector<WindowObservation>& SlidingWindow::observations(std::int64_t landmark) const {
  return impl_->landmark(landmark).observations;
}

namespace {

std::optional<Eigen::Vector2d> residual_of(const WindowState& state, const WindowObservation& o,
                                           const Reprojection& reprojection) {
  const auto keyframe = state.keyframes.find(o.keyframe);
  const auto landmark = state.landmarks.find(o.landmark);
  if (keyframe == state.keyframes.end() || landmark == state.landmarks.end()) return std::nullopt;
  const SE3& T_map_cam = keyframe->second;
  const PointInCamera point(T_map_cam.rotation().matrix(), T_map_cam.translation(),
                            landmark->second.p_map);
  if (!point.projectable()) return std::nullopt;
  return reprojection.residual(point.p_cam);
}

}  // namespace

std::optional<Eigen::Vector2d> SlidingWindow::residual_px(const WindowObservation& o) const {
  return residual_of(impl_->state(), o, Reprojection(impl_->state().camera, o.px, 1.0));
}

std::optional<Eigen::Vector2d> SlidingWindow::residual_sigmas(const WindowObservation& o) const {
  return residual_of(impl_->state(), o, reprojection_of(impl_->state().camera, o));
}

Matrix6d SlidingWindow::relative_information(std::int64_t from, std::int64_t to) const {
  impl_->keyframe(from);
  impl_->keyframe(to);
  require(from != to, "sliding window: a relative pose needs two keyframes");
  return placegraph::relative_information(impl_->state(), impl_->information(), from, to);
}

std::optional<Matrix6d> SlidingWindow::relative_covariance(std::int64_t from,
                                                           std::int64_t to) const {
  return inverse_if_full(relative_information(from, to));
}

std::optional<Matrix6d> SlidingWindow::covariance(std::int64_t keyframe) const {
  impl_->keyframe(keyframe);
  if (!impl_->tied_to_map) return std::nullopt;
  if (impl_->state().fixed == keyframe) return Matrix6d(Matrix6d::Zero());
  return inverse_if_full(absolute_information(impl_->state(), impl_->information(), keyframe));
}

LensEvidence SlidingWindow::lens_evidence() const {
  return placegraph::lens_evidence(impl_->state());
}

double SlidingWindow::sigma_log_length_ratio(std::int64_t first, std::int64_t middle,
                                             std::int64_t last) const {
  for (const std::int64_t id : {first, middle, last}) impl_->keyframe(id);
  require(first != middle && middle != last && first != last,
          "sliding window: a ratio of lengths needs three keyframes");
  return placegraph::sigma_log_length_ratio(impl_->state(), impl_->information(), first, middle,
                                            last);
}

}  // namespace placegraph
