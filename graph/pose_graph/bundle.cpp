#include <placegraph/graph/core/error.h>
#include <placegraph/graph/pose_graph/bundle.h>

#include <cmath>
#include <string>

namespace placegraph {

void Bundle::check() const {
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    const BundleCamera& camera = cameras[i];
    const std::string name = "bundle: camera " + std::to_string(i);
    require(camera.T_world_cam.matrix().allFinite() && std::isfinite(camera.focal_px) &&
                std::isfinite(camera.k1) && std::isfinite(camera.k2),
            name + " is not finite");
    require(camera.focal_px > 0, name + ": the focal length must be positive");
  }
  for (std::size_t i = 0; i < points.size(); ++i)
    require(points[i].allFinite(), "bundle: point " + std::to_string(i) + " is not finite");
  const auto is_there = [](int i, std::size_t size) {
    return i >= 0 && static_cast<std::size_t>(i) < size;
  };
  for (std::size_t i = 0; i < observations.size(); ++i) {
    const BundleObservation& o = observations[i];
    const std::string name = "bundle: observation " + std::to_string(i);
    require(is_there(o.camera, cameras.size()),
            name + ": there is no camera " + std::to_string(o.camera));
    require(is_there(o.point, points.size()),
            name + ": there is no point " + std::to_string(o.point));
    require(o.px.allFinite(), name + " is not finite");
  }
}

}  // namespace placegraph
