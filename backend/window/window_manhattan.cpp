#include <placegraph/backend/linear/whitening.h>
#include <placegraph/backend/window/sliding_window_impl.h>

#include <Eigen/Dense>

namespace placegraph {

Eigen::Matrix3d whitening_of(const WorldObservation& observation) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(observation.information);
  return eigen.eigenvalues().cwiseMax(0).cwiseSqrt().asDiagonal() *
         eigen.eigenvectors().transpose();
}

void move_window(WindowState& state, const SE3& T_new_old) {
  const SE3 T_old_new = T_new_old.inverse();
  const auto moved = [&](const Plane3& plane, Eigen::Matrix3d* J = nullptr) {
    return transform_to(T_old_new, plane, nullptr, J);
  };
  for (auto& [id, T_map_cam] : state.keyframes) T_map_cam = T_new_old * T_map_cam;
  for (auto& [id, landmark] : state.landmarks) landmark.p_map = T_new_old * landmark.p_map;
  for (auto& [id, line] : state.lines)
    line.line_map = Line3::from_direction(T_new_old * line.line_map.nearest_point(),
                                          T_new_old.rotation() * line.line_map.direction());
  for (auto& [id, plane_map] : state.planes) plane_map = moved(plane_map);
  for (auto& [id, R_map_world] : state.worlds) R_map_world = T_new_old.rotation() * R_map_world;
  // Right tangents of poses and rotations are the same in any frame; those of planes turn.
  MarginalPrior& prior = state.prior;
  for (SE3& T_map_cam : prior.T_map_cam_lin) T_map_cam = T_new_old * T_map_cam;
  for (SO3& R_map_world : prior.R_map_world_lin) R_map_world = T_new_old.rotation() * R_map_world;
  for (std::size_t k = 0; k < prior.planes.size(); ++k) {
    Eigen::Matrix3d J_new_old;
    prior.plane_lin[k] = moved(prior.plane_lin[k], &J_new_old);
    auto columns = prior.J.middleCols<3>(6 * static_cast<Eigen::Index>(prior.keyframes.size()) +
                                         3 * static_cast<Eigen::Index>(k));
    columns = (columns * J_new_old.inverse()).eval();
  }
}

void turn_window(WindowState& state, std::int64_t world, const SO3& R_map_world) {
  const SO3 R_new_old = R_map_world * state.worlds.at(world).inverse();
  const Eigen::Vector3d centre = state.keyframes.begin()->second.translation();
  move_window(state, SE3(R_new_old, centre - R_new_old * centre));
}

void SlidingWindow::add_world(std::int64_t id, const SO3& R_map_world) {
  require(R_map_world.matrix().allFinite(),
          "sliding window: world " + std::to_string(id) + " is not finite");
  const bool added = impl_->change().worlds.try_emplace(id, R_map_world).second;
  require(added, "sliding window: world " + std::to_string(id) + " is there already");
}

void SlidingWindow::add_world_observation(const WorldObservation& o) {
  impl_->keyframe(o.keyframe);
  impl_->world(o.world);
  const std::string name = "sliding window: sighting of world " + std::to_string(o.world) +
                           " in keyframe " + std::to_string(o.keyframe);
  require(o.R_cam_world.matrix().allFinite() && o.information.allFinite() &&
              o.information.isApprox(o.information.transpose(), 1e-9),
          name + ": the rotation must be finite, the information symmetric and finite");
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(o.information);
  const double least = eigen.eigenvalues()[0], largest = eigen.eigenvalues()[2];
  require(largest > 0 && least >= -1e-9 * largest,
          name + ": the information must be positive semi-definite and not zero");
  impl_->change().world_observations.push_back(o);
}

void SlidingWindow::keep_world(std::int64_t id, bool kept) {
  impl_->world(id);
  if (kept)
    impl_->change().kept_worlds.insert(id);
  else
    impl_->change().kept_worlds.erase(id);
}

void SlidingWindow::hold_world(std::optional<std::int64_t> id) {
  if (id) impl_->world(*id);
  impl_->change().held_world = id;
}

std::vector<std::int64_t> SlidingWindow::worlds() const { return ids_of(impl_->state().worlds); }

std::optional<SO3> SlidingWindow::world(std::int64_t id) const {
  const auto it = impl_->state().worlds.find(id);
  if (it == impl_->state().worlds.end()) return std::nullopt;
  return it->second;
}

std::optional<Eigen::Matrix3d> SlidingWindow::world_covariance(std::int64_t world,
                                                               std::int64_t keyframe) const {
  impl_->keyframe(keyframe);
  impl_->world(world);
  return placegraph::world_covariance(impl_->state(), impl_->information(), world, keyframe);
}

}  // namespace placegraph
