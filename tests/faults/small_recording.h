#pragma once
#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "tests/faults/changes.h"
#include "tests/faults/fault.h"

namespace placegraph::faults::test {

/// 60 stereo frames of 96x64 px with depth: a texture that moves by a pixel a frame, a camera that
/// moves by 0.1 m and rotates by 1 degree.
inline Recording small_recording() {
  Recording recording;
  cv::RNG random(1);
  Image texture(64, 200, CV_8UC1);
  random.fill(texture, cv::RNG::UNIFORM, 30, 220);
  cv::GaussianBlur(texture, texture, {}, 1.0);
  Camera& camera = recording.calibration.camera;
  camera.width = 96, camera.height = 64;
  camera.fx = camera.fy = 80, camera.cx = 46, camera.cy = 31;
  recording.calibration.baseline_m = 0.2;
  recording.calibration.camera_height_m = 1.5;
  recording.calibration.depth = DepthCamera{camera, SE3(), 0.005};
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  for (int i = 0; i < 60; ++i) {
    Frame frame;
    frame.stamp_ns = 1000000000LL + i * 100000000LL;
    frame.image = texture.colRange(i + 10, i + 106).clone();
    frame.right = texture.colRange(i + 14, i + 110).clone();
    frame.depth = Image(64, 96, CV_32FC1);
    for (int v = 0; v < 64; ++v)
      for (int u = 0; u < 96; ++u)
        frame.depth.at<float>(v, u) = 1 + 0.01F * static_cast<float>(u + 2 * v + i);
    recording.frames.push_back(frame);
    recording.T_world_cam.push_back(T);
    T = T * Eigen::AngleAxisd(CV_PI / 180, Eigen::Vector3d::UnitY());
    T.translate(Eigen::Vector3d(0, 0, 0.1));
  }
  recording.faulty = {0, 59};
  return recording;
}

/// The recording with the fault of this name.
inline Recording faulty(const Recording& recording, const std::string& name) {
  for (const Fault& fault : all_faults())
    if (fault.name == name) return fault.apply(recording, 1);
  ADD_FAILURE() << "no fault " << name;
  return recording;
}

inline bool equal(const Image& a, const Image& b) {
  return a.size() == b.size() && a.type() == b.type() &&
         (a.empty() || cv::norm(a, b, cv::NORM_INF) == 0);
}

/// The fraction of the pixels that differ.
inline double changed_fraction(const Image& a, const Image& b) {
  return static_cast<double>(cv::countNonZero(a != b)) / static_cast<double>(a.total());
}

inline double mean_of(const Image& image) { return cv::mean(image)[0]; }

inline double contrast_of(const Image& image) {
  cv::Scalar mean, deviation;
  cv::meanStdDev(image, mean, deviation);
  return deviation[0];
}

/// The number of the frame of `recording` whose left image is that of frame `index` of `out`.
inline int source_of(const Recording& recording, const Recording& out, std::size_t index) {
  for (std::size_t i = 0; i < recording.size(); ++i)
    if (equal(recording.frames[i].image, out.frames.at(index).image)) return static_cast<int>(i);
  return -1;
}

}  // namespace placegraph::faults::test
