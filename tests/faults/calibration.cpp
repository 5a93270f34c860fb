// Faults of the calibration: the images are right, what is stated about the camera is not.
#include <fmt/format.h>

#include <algorithm>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include "tests/faults/changes.h"
#include "tests/faults/fault.h"

namespace placegraph::faults {
namespace {

constexpr auto kAll = "mono stereo rgbd";
constexpr auto kCalibration = "calibration_questionable|distortion_questionable";

/// Changes the stated intrinsics of the image, and of depth images that share them.
Recording with_camera(const Recording& recording, const std::function<void(Camera&)>& change) {
  Recording out = recording;
  out.faulty = whole(recording);
  change(out.calibration.camera);
  if (out.calibration.depth) change(out.calibration.depth->camera);
  return out;
}

Fault focal_length(int percent) {
  return {fmt::format("focal_{}_{}", percent > 0 ? "plus" : "minus", std::abs(percent)), kAll,
          fmt::format("the stated focal length is {} % too {}", std::abs(percent),
                      percent > 0 ? "large" : "small"),
          kCalibration, [percent](const Recording& r, std::uint32_t) {
            return with_camera(r, [percent](Camera& camera) {
              camera.fx *= 1 + percent / 100.0;
              camera.fy *= 1 + percent / 100.0;
            });
          }};
}

/// The largest squared distance of a corner from the principal point, in normalized coordinates.
double corner_radius2(const Camera& c) {
  const double x = std::max(c.cx, c.width - 1 - c.cx) / c.fx;
  const double y = std::max(c.cy, c.height - 1 - c.cy) / c.fy;
  return x * x + y * y;
}

/// Images of a lens with radial distortion k1, which the calibration does not state. A barrel's
/// focal length is longer, so that the images of the recording show all that it sees.
Recording with_distortion(const Recording& recording, double k1) {
  const Camera& c = recording.calibration.camera;
  const double zoom = std::max(1.0, 1 / (1 + k1 * corner_radius2(c)));
  const cv::Matx33d K(c.fx, 0, c.cx, 0, c.fy, c.cy, 0, 0, 1);
  const cv::Matx33d K_lens(zoom * c.fx, 0, c.cx, 0, zoom * c.fy, c.cy, 0, 0, 1);
  std::vector<cv::Point2f> distorted, pinhole;
  for (int v = 0; v < c.height; ++v)
    for (int u = 0; u < c.width; ++u)
      distorted.emplace_back(static_cast<float>(u), static_cast<float>(v));
  cv::undistortPoints(distorted, pinhole, K_lens, std::vector<double>{k1, 0, 0, 0}, {}, K,
                      cv::TermCriteria(cv::TermCriteria::MAX_ITER, 60, 0));
  const Image source = Image(pinhole).reshape(2, c.height).clone();
  Recording out =
      with_images(recording, whole(recording), [&source](const Image& image, std::size_t) {
        Image result;
        cv::remap(image, result, source, Image(), cv::INTER_LINEAR, cv::BORDER_REPLICATE);
        return result;
      });
  out.calibration.camera.fx *= zoom;
  out.calibration.camera.fy *= zoom;
  return out;
}

Recording with_camera_height(const Recording& recording, double factor) {
  Recording out = recording;
  out.faulty = whole(recording);
  out.calibration.camera_height_m = factor * recording.calibration.camera_height_m.value_or(1.5);
  return out;
}

Recording with_baseline(const Recording& recording, double factor) {
  Recording out = recording;
  out.faulty = whole(recording);
  out.calibration.baseline_m *= factor;
  return out;
}

Fault camera_height(const char* name, const char* what, double factor) {
  const std::string causes = "camera_height_questionable|scale_questionable";
  return {name, "mono", what, causes + (is_plausible(factor) ? kUnchecked : ""),
          [factor](const Recording& r, std::uint32_t) { return with_camera_height(r, factor); }};
}

Fault baseline(const char* name, const char* what, double factor) {
  const std::string causes = "baseline_questionable|scale_questionable";
  return {name, "stereo", what, causes + (is_plausible(factor) ? kUnchecked : ""),
          [factor](const Recording& r, std::uint32_t) { return with_baseline(r, factor); }};
}

Fault distortion(const char* name, double k1) {
  return {name, kAll, fmt::format("the lens has k1 = {}, which the calibration does not state", k1),
          kCalibration, [k1](const Recording& r, std::uint32_t) { return with_distortion(r, k1); }};
}

}  // namespace

std::vector<Fault> calibration_faults() {
  return {
      focal_length(5),
      focal_length(-5),
      focal_length(10),
      focal_length(-10),
      focal_length(20),
      focal_length(-20),
      {"aspect_off", kAll, "fx alone is stated 10 % too large", kCalibration,
       [](const Recording& r, std::uint32_t) {
         return with_camera(r, [](Camera& camera) { camera.fx *= 1.1; });
       }},
      {"principal_point_x", kAll, "cx is stated off by a tenth of the width", kCalibration,
       [](const Recording& r, std::uint32_t) {
         return with_camera(r, [](Camera& camera) { camera.cx += 0.1 * camera.width; });
       }},
      {"principal_point_y", kAll, "cy is stated off by a tenth of the height", kCalibration,
       [](const Recording& r, std::uint32_t) {
         return with_camera(r, [](Camera& camera) { camera.cy += 0.1 * camera.height; });
       }},
      distortion("distortion_plus", 0.15),
      distortion("distortion_minus", -0.15),
      distortion("distortion_strong", -0.3),
      camera_height("camera_height_10x", "the stated camera height is ten times the true one", 10),
      camera_height("camera_height_100x", "the camera height is stated in centimetres", 100),
      camera_height("camera_height_half", "the stated camera height is half the true one", 0.5),
      baseline("baseline_2x", "the stated baseline is twice the true one", 2),
      baseline("baseline_half", "the stated baseline is half the true one", 0.5),
      baseline("baseline_1000x", "the baseline is stated in millimetres", 1000),
  };
}

}  // namespace placegraph::faults
