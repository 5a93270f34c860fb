#pragma once
#include <placegraph/io/synthetic/render/height_surface.h>
#include <placegraph/io/synthetic/render/world.h>

#include <vector>

namespace placegraph::synthetic {

/// The pose of a car on the ground at (x, z) that faces `direction`.
SE3 car_pose(const GroundMesh& ground, const Eigen::Vector2d& position,
             const Eigen::Vector2d& direction);

/// Adds about `per_minute` cars that come towards the camera on its left lane, or drive ahead of it
/// on its own path; none comes closer than a lane beside the camera.
void add_traffic(Scene& scene, const GroundMesh& ground, const std::vector<double>& time_s,
                 const std::vector<SE3>& T_scene_cam, double per_minute, std::uint64_t seed);

/// Adds a car that passes (x, z) `crossing` at a time, straight along `direction`. Returns false,
/// and adds nothing, if it would come too close to the camera.
bool add_crossing_car(Scene& scene, const GroundMesh& ground, const std::vector<double>& time_s,
                      const std::vector<SE3>& T_scene_cam, const Eigen::Vector2d& crossing,
                      const Eigen::Vector2d& direction, double crossing_time_s, double speed_mps,
                      std::uint32_t seed);

}  // namespace placegraph::synthetic
