#pragma once
#include <placegraph/io/internal/synthetic/render/renderer.h>

namespace placegraph::synthetic {

/// How hard the images are. The numbers in sensor_model.cpp are frozen: results are quoted by
/// level.
enum class Difficulty { kClean, kStandard, kHard };
Difficulty difficulty_from(const std::string& name);  ///< throws ArgumentError naming the choices
const char* to_string(Difficulty difficulty);

struct SensorModel {
  double noise_grey = 0;  ///< sigma of white noise [grey levels of 255]
  double exposure = 0;    ///< gain wanders within 1 +- this
  double shutter_s = 0;   ///< motion blur over this time, centred on the stamp
  double contrast = 1;    ///< of all textures
  double traffic = 0;     ///< moving cars per minute of driving, about
};
SensorModel sensor_model(Difficulty difficulty);

/// Velocity of what the camera sees, in its frame: dp/dt = maps[object + 1] applied to p.
std::vector<AffineMap> point_velocities(const Scene& scene, const View& view,
                                        const Eigen::Vector3d& velocity_cam,
                                        const Eigen::Vector3d& angular_velocity_cam);

/// The 8-bit image a camera would deliver: blurred along each pixel's own motion, exposed, with
/// noise. `noise_seed` belongs to this image alone, `exposure_seed` to the sequence.
Image expose(const Rendering& rendering, const View& view, const std::vector<AffineMap>& velocities,
             const SensorModel& model, std::uint32_t noise_seed, std::uint32_t exposure_seed);

}  // namespace placegraph::synthetic
