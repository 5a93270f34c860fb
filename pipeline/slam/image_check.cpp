#include <placegraph/graph/core/error.h>
#include <placegraph/pipeline/slam/image_check.h>

namespace placegraph {

void check_images(const Frame& frame, const Calibration& calibration) {
  const Camera& camera = calibration.camera;
  require(frame.image.type() == CV_8UC1 && frame.image.cols == camera.width &&
              frame.image.rows == camera.height,
          "frame " + to_string(frame.id) + ": grey image of " + std::to_string(camera.width) + "x" +
              std::to_string(camera.height) + " needed");
  const auto fits = [&](const Image& image, int type, const Camera& of) {
    return image.empty() ||
           (image.type() == type && image.cols == of.width && image.rows == of.height);
  };
  require(fits(frame.right, CV_8UC1, camera) && fits(frame.mask, CV_8UC1, camera) &&
              fits(frame.colour, CV_8UC3, camera) &&
              (!calibration.depth || fits(frame.depth, CV_32FC1, calibration.depth->camera)),
          "frame " + to_string(frame.id) +
              ": right image, colour image, mask or depth image differs in size or type from the "
              "calibration");
}

}  // namespace placegraph
