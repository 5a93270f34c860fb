#pragma once
#include <placegraph/io/synthetic/render/renderer.h>

namespace placegraph::synthetic {

/// How a camera degrades its images.
struct SensorModel {
  double noise_grey = 0;  ///< sigma of white noise [grey levels of 255]
  double exposure = 0;    ///< the gain drifts within 1 +- this
  double shutter_s = 0;   ///< motion blur over this time, centred on the stamp
  double contrast = 1;    ///< contrast of all textures
  double traffic = 0;     ///< approximate number of moving cars per minute of driving
};

/// Velocity of the visible points in the camera frame: dp/dt = maps[object + 1] applied to p.
std::vector<AffineMap> point_velocities(const Scene& scene, const View& view,
                                        const Eigen::Vector3d& velocity_cam,
                                        const Eigen::Vector3d& angular_velocity_cam);

/// The 8-bit image of a real camera: blurred along each pixel's own motion, exposed, with noise.
/// `noise_seed` belongs to this image alone, `exposure_seed` to the sequence.
Image expose(const Rendering& rendering, const View& view, const std::vector<AffineMap>& velocities,
             const SensorModel& model, std::uint32_t noise_seed, std::uint32_t exposure_seed);

}  // namespace placegraph::synthetic
