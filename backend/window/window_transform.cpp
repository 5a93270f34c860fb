#include <placegraph/backend/window/window_transform.h>
#include <placegraph/graph/core/error.h>

#include <Eigen/LU>
#include <cmath>

namespace placegraph {
namespace {

void transform_factors(WindowState& state, const Sim3& S_new_old) {
  for (WindowFactor& factor : state.factors) factor = transformed(factor, S_new_old);
}

template <class Move>
void rescale_landmark(WindowLandmark& landmark, const Move& move, double scale) {
  landmark.p_map = move(landmark.p_map);
  for (WindowObservation& o : landmark.observations) {
    if (!o.inverse_depth) continue;
    *o.inverse_depth /= scale;
    o.sigma_inverse_depth /= scale;
  }
  if (landmark.on_plane) landmark.on_plane->sigma_m *= scale;
}

template <class Move>
void rescale_line(WindowLine& line, const Move& move, double scale) {
  line.line_map =
      Line3::from_direction(move(line.line_map.nearest_point()), line.line_map.direction());
  for (LineObservation& o : line.observations)
    if (o.second) o.second->second_in_cam *= scale;
}

}  // namespace

Line3 moved(const Line3& line, const SE3& T_new_old) {
  return Line3::from_direction(T_new_old * line.nearest_point(),
                               T_new_old.rotation() * line.direction());
}

void move_window(WindowState& state, const SE3& T_new_old) {
  const SE3 T_old_new = T_new_old.inverse();
  for (auto& [id, T_map_cam] : state.keyframes) T_map_cam = T_new_old * T_map_cam;
  for (auto& [id, landmark] : state.landmarks) landmark.p_map = T_new_old * landmark.p_map;
  for (auto& [id, line] : state.lines) line.line_map = moved(line.line_map, T_new_old);
  for (auto& [id, plane_map] : state.planes) plane_map = transform_to(T_old_new, plane_map);
  for (auto& [id, R_map_manhattan] : state.manhattan_frames)
    R_map_manhattan = T_new_old.rotation() * R_map_manhattan;
  transform_factors(state, Sim3(T_new_old));
  // Right tangents of poses and rotations are the same in any frame; those of planes are rotated.
  MarginalPrior& prior = state.prior;
  for (SE3& T_map_cam : prior.T_map_cam_lin) T_map_cam = T_new_old * T_map_cam;
  for (SO3& R_map_manhattan : prior.R_map_manhattan_lin)
    R_map_manhattan = T_new_old.rotation() * R_map_manhattan;
  for (std::size_t k = 0; k < prior.planes.size(); ++k) {
    Eigen::Matrix3d J_new_old;
    prior.plane_lin[k] = transform_to(T_old_new, prior.plane_lin[k], nullptr, &J_new_old);
    auto columns = prior.J.middleCols<3>(6 * static_cast<Eigen::Index>(prior.keyframes.size()) +
                                         3 * static_cast<Eigen::Index>(k));
    columns = (columns * J_new_old.inverse()).eval();
  }
}

void rotate_window(WindowState& state, ManhattanFrameId manhattan_frame,
                   const SO3& R_map_manhattan) {
  const SO3 R_new_old = R_map_manhattan * state.manhattan_frames.at(manhattan_frame).inverse();
  const Eigen::Vector3d centre = state.keyframes.begin()->second.translation();
  move_window(state, SE3(R_new_old, centre - R_new_old * centre));
}

void rescale_window(WindowState& state, double scale) {
  require(std::isfinite(scale) && scale > 0, "sliding window: scale must be positive");
  require(state.prior.planes.empty(), "sliding window: a prior of planes cannot be rescaled");
  if (state.keyframes.empty()) return;
  const Eigen::Vector3d center_map = state.keyframes.begin()->second.translation();
  const auto move = [&](const Eigen::Vector3d& p_map) -> Eigen::Vector3d {
    return center_map + scale * (p_map - center_map);
  };
  for (auto& [id, T_map_cam] : state.keyframes)
    T_map_cam = SE3(T_map_cam.rotation(), move(T_map_cam.translation()));
  for (auto& [id, landmark] : state.landmarks) rescale_landmark(landmark, move, scale);
  for (auto& [id, line] : state.lines) rescale_line(line, move, scale);
  for (auto& [id, plane_map] : state.planes)
    plane_map = Plane3(plane_map.normal(),
                       plane_map.normal().dot(move(plane_map.distance() * plane_map.normal())));
  transform_factors(state, Sim3(SO3(), (1 - scale) * center_map, scale));
  // Deviations of position are multiplied by `scale`, so their columns are divided by it: the
  // residual stays the same.
  for (std::size_t k = 0; k < state.prior.keyframes.size(); ++k) {
    SE3& T_lin = state.prior.T_map_cam_lin[k];
    T_lin = SE3(T_lin.rotation(), move(T_lin.translation()));
    state.prior.J.middleCols<3>(6 * static_cast<Eigen::Index>(k)) /= scale;
  }
}

}  // namespace placegraph
