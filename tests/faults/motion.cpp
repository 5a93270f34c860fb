// Faults of the camera's motion: jumps, rotations, standing still, other mountings.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <opencv2/imgproc.hpp>

#include "tests/faults/changes.h"
#include "tests/faults/fault.h"

namespace placegraph::faults {
namespace {

constexpr auto kAll = "mono stereo rgbd";
constexpr auto kJump = "jump|components|lost_frames|few_posed|times_questionable";

/// The frames of a stretch, forwards.
std::vector<std::size_t> stretch(std::size_t first, std::size_t end) {
  std::vector<std::size_t> numbers(end - first);
  std::iota(numbers.begin(), numbers.end(), first);
  return numbers;
}

std::vector<std::size_t> joined(std::vector<std::size_t> a, const std::vector<std::size_t>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

/// The camera is moved along its path without images: the second third is missing.
Recording teleported(const Recording& recording) {
  const std::size_t size = recording.size();
  Recording out = with_order(recording, joined(stretch(0, size / 3), stretch(2 * size / 3, size)));
  out.faulty = {std::min(size / 3, out.size() - 1), out.size() - 1};
  return out;
}

/// The same world and path in a mirror, which is another world to a camera: images are mirrored
/// and moved so that the calibration holds, and the right camera becomes the left one.
Recording mirrored_world(const Recording& recording) {
  Recording out = recording;
  const Camera& c = recording.calibration.camera;
  const auto mirror = [](const Image& image, const Camera& camera, int interpolation) {
    Image flipped;
    if (image.empty()) return flipped;
    cv::flip(image, flipped, 1);
    return shifted(flipped, 2 * camera.cx - (image.cols - 1), 0, interpolation);
  };
  for (Frame& frame : out.frames) {
    if (recording.has_right()) std::swap(frame.image, frame.right);
    frame.image = mirror(frame.image, c, cv::INTER_LINEAR);
    frame.right = mirror(frame.right, c, cv::INTER_LINEAR);
    if (recording.has_depth())
      frame.depth = mirror(frame.depth, recording.calibration.depth->camera, cv::INTER_NEAREST);
  }
  const Eigen::DiagonalMatrix<double, 3> S(-1, 1, 1);
  const double left_to_first_m = recording.has_right() ? recording.calibration.baseline_m : 0;
  for (Eigen::Isometry3d& T : out.T_world_cam) {
    T.translate(Eigen::Vector3d(left_to_first_m, 0, 0));
    T.linear() = S * T.linear() * S;
    T.translation() = S * T.translation();
  }
  return out;
}

/// The camera is carried into another world in the middle. Its truth there is a kilometre off, so
/// that no pose of both worlds in one component can be right.
Recording kidnapped(const Recording& recording) {
  const std::size_t half = recording.size() / 2;
  const Recording other = mirrored_world(recording);
  Recording out = recording;
  out.faulty = {half, recording.size() - 1};
  for (std::size_t i = half; i < out.size(); ++i) {
    const std::int64_t stamp_ns = out.frames[i].stamp_ns;
    out.frames[i] = other.frames[i];
    out.frames[i].stamp_ns = stamp_ns;
    if (out.T_world_cam.empty()) continue;
    out.T_world_cam[i] = other.T_world_cam[i];
    out.T_world_cam[i].pretranslate(Eigen::Vector3d(1000, 0, 0));
  }
  return out;
}

Recording backwards(const Recording& recording) {
  std::vector<std::size_t> numbers = stretch(0, recording.size());
  std::reverse(numbers.begin(), numbers.end());
  return with_order(recording, numbers);
}

Recording there_and_back(const Recording& recording) {
  const std::size_t half = recording.size() / 2;
  std::vector<std::size_t> back = stretch(0, half);
  std::reverse(back.begin(), back.end());
  return with_order(recording, joined(stretch(0, half + 1), back));
}

Image with_sensor_noise(const Image& image, std::uint32_t seed, std::size_t index) {
  cv::RNG random = random_of(seed, index);
  Image noise(image.size(), CV_16SC1), out;
  random.fill(noise, cv::RNG::NORMAL, 0, 2);
  cv::add(image, noise, out, cv::noArray(), CV_8U);
  return out;
}

/// The camera stands for 40 frames in the middle; each has noise of its own.
Recording standing_while(const Recording& recording, std::uint32_t seed) {
  const std::size_t size = recording.size(), half = size / 2;
  std::vector<std::size_t> numbers = stretch(0, half);
  numbers.insert(numbers.end(), 40, half);
  const Recording out = with_order(recording, joined(numbers, stretch(half, size)));
  return with_images(out, {half, half + 39}, [seed](const Image& image, std::size_t index) {
    return with_sensor_noise(image, seed, index);
  });
}

Recording standing(const Recording& recording, std::uint32_t seed) {
  const Recording out = with_order(recording, std::vector<std::size_t>(recording.size(), 0));
  return with_images(out, whole(out), [seed](const Image& image, std::size_t index) {
    return with_sensor_noise(image, seed, index);
  });
}

/// The camera turns to and fro by 15 degrees at one place. It has twice the focal length, so that
/// the first image of the recording shows all that it sees.
Recording rotated_on_the_spot(const Recording& recording) {
  Recording out = with_order(recording, std::vector<std::size_t>(recording.size(), 0));
  const Eigen::Matrix3d K = recording.calibration.camera.K();
  out.calibration.camera.fx *= 2;
  out.calibration.camera.fy *= 2;
  const Eigen::Matrix3d K_result = out.calibration.camera.K();
  const auto R_of = [&](std::size_t i) {
    const double angle = 15 * CV_PI / 180 * std::sin(static_cast<double>(i) * CV_PI / 40);
    return Eigen::Matrix3d(Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitY()));
  };
  for (std::size_t i = 0; i < out.T_world_cam.size(); ++i) out.T_world_cam[i].rotate(R_of(i));
  return with_images(out, whole(out), [&](const Image& image, std::size_t i) {
    return warped(image, K * R_of(i) * K_result.inverse(), cv::INTER_LINEAR);
  });
}

/// The rotation by `angle` [rad] about the principal point, from pixels of the result.
Eigen::Matrix3d roll_of_pixels(const Camera& camera, double angle) {
  return camera.K() * Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()).toRotationMatrix() *
         camera.K().inverse();
}

/// The camera rolls about its axis by up to 4 degrees, differently in each frame.
Recording shaken(const Recording& recording, std::uint32_t seed) {
  const auto angle_of = [seed](std::size_t index) {
    cv::RNG random = random_of(seed, index);
    return random.uniform(-4.0, 4.0) * CV_PI / 180;
  };
  Recording out = with_images(recording, whole(recording), [&](const Image& image, std::size_t i) {
    return warped(image, roll_of_pixels(recording.calibration.camera, angle_of(i)),
                  cv::INTER_LINEAR);
  });
  out = with_depth(out, whole(recording), [&](const Image& depth, std::size_t i) {
    return warped(depth, roll_of_pixels(recording.calibration.depth->camera, angle_of(i)),
                  cv::INTER_NEAREST);
  });
  for (std::size_t i = 0; i < out.T_world_cam.size(); ++i)
    out.T_world_cam[i].rotate(Eigen::AngleAxisd(angle_of(i), Eigen::Vector3d::UnitZ()));
  return out;
}

void rotate_by_half(Image& image, Camera& camera) {
  if (image.empty()) return;
  Image out;
  cv::flip(image, out, -1);
  image = out;
  camera.cx = image.cols - 1 - camera.cx;
  camera.cy = image.rows - 1 - camera.cy;
}

/// The rig is mounted upside down, with a calibration that holds. The right camera is then the left
/// one.
Recording upside_down(const Recording& recording) {
  Recording out = recording;
  out.faulty = whole(recording);
  const Eigen::AngleAxisd half(CV_PI, Eigen::Vector3d::UnitZ());
  for (Frame& frame : out.frames) {
    out.calibration = recording.calibration;
    if (recording.has_right()) std::swap(frame.image, frame.right);
    rotate_by_half(frame.image, out.calibration.camera);
    Camera same = recording.calibration.camera;
    rotate_by_half(frame.right, same);
    if (recording.has_depth()) rotate_by_half(frame.depth, out.calibration.depth->camera);
  }
  if (out.calibration.depth) {
    const SE3 roll(half.toRotationMatrix(), Eigen::Vector3d(0, 0, 0));
    out.calibration.depth->T_cam_depth = roll * out.calibration.depth->T_cam_depth * roll.inverse();
  }
  for (Eigen::Isometry3d& T : out.T_world_cam) {
    if (recording.has_right()) T.translate(Eigen::Vector3d(recording.calibration.baseline_m, 0, 0));
    T.rotate(half);
  }
  return out;
}

}  // namespace

std::vector<Fault> motion_faults() {
  return {
      {"teleport", kAll, "the second third of the path has no frames", kJump,
       [](const Recording& r, std::uint32_t) { return teleported(r); }},
      {"kidnap", kAll, "the second half is of another world", kJump,
       [](const Recording& r, std::uint32_t) { return kidnapped(r); }},
      {"backwards", kAll, "the sequence runs backwards", "-",
       [](const Recording& r, std::uint32_t) { return backwards(r); }},
      {"there_and_back", kAll, "the first half forwards, then backwards", "-",
       [](const Recording& r, std::uint32_t) { return there_and_back(r); }},
      {"standing_while", kAll, "the camera stands for 40 frames", "-", standing_while},
      {"standing", kAll, "the camera stands all the time", "-", standing},
      {"rotation_on_the_spot", "mono", "the camera rotates and does not move",
       "few_posed|lost_frames|scale_questionable",
       [](const Recording& r, std::uint32_t) { return rotated_on_the_spot(r); }},
      {"shaken", "mono rgbd", "the camera rolls by up to 4 degrees, differently in each frame", "-",
       shaken},
      {"upside_down", kAll, "the camera is mounted upside down", "upside_down",
       [](const Recording& r, std::uint32_t) { return upside_down(r); }},
  };
}

}  // namespace placegraph::faults
