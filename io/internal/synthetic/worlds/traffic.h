#pragma once
#include <placegraph/io/internal/synthetic/render/height_surface.h>
#include <placegraph/io/internal/synthetic/render/world.h>

#include <vector>

namespace placegraph::synthetic {

/// A car standing on the ground at (x, z) and looking along `direction`.
SE3 car_pose(const GroundMesh& ground, const Eigen::Vector2d& position,
             const Eigen::Vector2d& direction);

/// Cars that come towards the camera on its left lane, or drive ahead of it on its own way, about
/// `per_minute` of them; none comes closer than a lane beside the camera.
void add_traffic(Scene& scene, const GroundMesh& ground, const std::vector<double>& time_s,
                 const std::vector<SE3>& T_scene_cam, double per_minute, std::uint64_t seed);

/// A car that passes (x, z) `crossing` at a time, straight along `direction`. False, and nothing
/// added, if it would come too close to the camera.
bool add_crossing_car(Scene& scene, const GroundMesh& ground, const std::vector<double>& time_s,
                      const std::vector<SE3>& T_scene_cam, const Eigen::Vector2d& crossing,
                      const Eigen::Vector2d& direction, double crossing_time_s, double speed_mps,
                      std::uint32_t seed);

}  // namespace placegraph::synthetic
