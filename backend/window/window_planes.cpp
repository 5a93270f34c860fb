#include <placegraph/backend/factors/plane_observation.h>
#include <placegraph/backend/window/sliding_window_impl.h>

#include <Eigen/Dense>
#include <algorithm>

namespace placegraph {

Eigen::Matrix3d whitening_of(const PlaneObservation& observation) {
  return Eigen::LLT<Eigen::Matrix3d>(observation.information).matrixU();
}

namespace {

/// The prior with one of its planes integrated out: the residuals are projected on the complement
/// of what that plane does.
void forget_plane(MarginalPrior& prior, std::size_t k) {
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(prior.plane_columns(k));
  const Eigen::MatrixXd basis =
      qr.householderQ() * Eigen::MatrixXd::Identity(prior.J.rows(), qr.rank());
  prior.J -= basis * (basis.transpose() * prior.J).eval();
  prior.e -= basis * (basis.transpose() * prior.e).eval();
  const Eigen::Index begin =
      6 * static_cast<Eigen::Index>(prior.keyframes.size()) + 3 * static_cast<Eigen::Index>(k);
  const Eigen::Index after = prior.J.cols() - begin - 3;
  Eigen::MatrixXd J(prior.J.rows(), prior.J.cols() - 3);
  J << prior.J.leftCols(begin), prior.J.rightCols(after);
  prior.J = std::move(J);
  prior.planes.erase(prior.planes.begin() + static_cast<std::ptrdiff_t>(k));
  prior.plane_lin.erase(prior.plane_lin.begin() + static_cast<std::ptrdiff_t>(k));
}

}  // namespace

void SlidingWindow::add_plane(std::int64_t id, const Plane3& plane_map) {
  const bool added = impl_->change().planes.try_emplace(id, plane_map).second;
  require(added, "sliding window: plane " + std::to_string(id) + " is there already");
}

void SlidingWindow::add_height(const HeightObservation& h) {
  impl_->keyframe(h.keyframe);
  impl_->require_plane(h.plane);
  require(positive(h.height_m) && positive(h.sigma_m),
          "sliding window: height_m and sigma_m must be finite and positive");
  impl_->change().heights.push_back(h);
}

void SlidingWindow::add_plane_point(const PlanePoint& point) {
  impl_->require_plane(point.plane);
  impl_->landmark(point.landmark);
  WindowLandmark& landmark = impl_->change().landmarks.at(point.landmark);
  require(positive(point.sigma_m), "sliding window: sigma_m must be finite and positive");
  require(!landmark.on_plane, "sliding window: landmark " + std::to_string(point.landmark) +
                                  " lies on a plane already");
  landmark.on_plane = point;
}

void SlidingWindow::add_plane_observation(const PlaneObservation& o) {
  impl_->keyframe(o.keyframe);
  impl_->require_plane(o.plane);
  const std::string name = "sliding window: plane " + std::to_string(o.plane) + " in keyframe " +
                           std::to_string(o.keyframe);
  require(o.information.allFinite() && o.information.isApprox(o.information.transpose(), 1e-9) &&
              Eigen::LLT<Eigen::Matrix3d>(o.information).info() == Eigen::Success,
          name + ": the information must be symmetric, finite and positive definite");
  std::vector<PlaneObservation>& all = impl_->change().plane_observations;
  require(std::none_of(all.begin(), all.end(),
                       [&](const PlaneObservation& other) {
                         return other.keyframe == o.keyframe && other.plane == o.plane;
                       }),
          name + " is there already");
  all.push_back(o);
}

const std::vector<PlaneObservation>& SlidingWindow::plane_observations() const {
  return impl_->state().plane_observations;
}

std::optional<Eigen::Vector3d> SlidingWindow::residual_sigmas(const PlaneObservation& o) const {
  const WindowState& state = impl_->state();
  const auto keyframe = state.keyframes.find(o.keyframe);
  const auto plane = state.planes.find(o.plane);
  if (keyframe == state.keyframes.end() || plane == state.planes.end()) return std::nullopt;
  PlaneObservationFactor::Residual r;
  PlaneObservationFactor(o.plane_cam, whitening_of(o))
      .compute(keyframe->second, plane->second, r, nullptr);
  return Eigen::Vector3d(r);
}

void SlidingWindow::remove_plane_observation(std::int64_t keyframe, std::int64_t plane) {
  const std::size_t removed = std::erase_if(
      impl_->change().plane_observations,
      [&](const PlaneObservation& o) { return o.keyframe == keyframe && o.plane == plane; });
  require(removed > 0, "sliding window: plane " + std::to_string(plane) +
                           " was not measured in keyframe " + std::to_string(keyframe));
}

void SlidingWindow::keep_plane(std::int64_t id, bool kept) {
  impl_->require_plane(id);
  if (kept)
    impl_->change().kept_planes.insert(id);
  else
    impl_->change().kept_planes.erase(id);
}

void SlidingWindow::remove_plane(std::int64_t id) {
  impl_->require_plane(id);
  WindowState& state = impl_->change();
  const auto of_it = [&](const auto& o) { return o.plane == id; };
  std::erase_if(state.plane_observations, of_it);
  std::erase_if(state.heights, of_it);
  for (auto& [landmark_id, landmark] : state.landmarks)
    if (landmark.on_plane && landmark.on_plane->plane == id) landmark.on_plane.reset();
  state.kept_planes.erase(id);
  state.planes.erase(id);
  const auto in_prior = std::find(state.prior.planes.begin(), state.prior.planes.end(), id);
  if (in_prior != state.prior.planes.end())
    forget_plane(state.prior, static_cast<std::size_t>(in_prior - state.prior.planes.begin()));
}

std::vector<std::int64_t> SlidingWindow::planes() const { return ids_of(impl_->state().planes); }

std::optional<Plane3> SlidingWindow::plane(std::int64_t id) const {
  const auto it = impl_->state().planes.find(id);
  if (it == impl_->state().planes.end()) return std::nullopt;
  return it->second;
}

std::optional<Eigen::Matrix3d> SlidingWindow::plane_covariance(std::int64_t plane,
                                                               std::int64_t keyframe) const {
  impl_->keyframe(keyframe);
  impl_->require_plane(plane);
  return placegraph::plane_covariance(impl_->state(), impl_->information(), plane, keyframe);
}

}  // namespace placegraph
