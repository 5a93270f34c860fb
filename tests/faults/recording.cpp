#include "tests/faults/recording.h"

#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/datasets/open_dataset.h>
#include <placegraph/io/synthetic/writers/sequence_folder.h>
#include <placegraph/io/trajectories/trajectory_file.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <opencv2/imgproc.hpp>

namespace placegraph::faults {
namespace {

bool supports(const Dataset& dataset, Sensor sensor) {
  const std::vector<Sensor> sensors = dataset.sensors();
  return std::find(sensors.begin(), sensors.end(), sensor) != sensors.end();
}

Image resized(const Image& image, double scale, int interpolation) {
  Image out;
  if (!image.empty()) cv::resize(image, out, {}, scale, scale, interpolation);
  return out;
}

void resize_camera(Camera& camera, double scale) {
  camera.width = static_cast<int>(std::lround(camera.width * scale));
  camera.height = static_cast<int>(std::lround(camera.height * scale));
  camera.fx *= scale;
  camera.fy *= scale;
  camera.cx = (camera.cx + 0.5) * scale - 0.5;
  camera.cy = (camera.cy + 0.5) * scale - 0.5;
}

void resize(Recording& recording, double scale) {
  for (Frame& frame : recording.frames) {
    frame.image = resized(frame.image, scale, cv::INTER_AREA);
    frame.right = resized(frame.right, scale, cv::INTER_AREA);
    frame.depth = resized(frame.depth, scale, cv::INTER_NEAREST);
  }
  resize_camera(recording.calibration.camera, scale);
  if (recording.calibration.depth) resize_camera(recording.calibration.depth->camera, scale);
}

Frame read_frame(const Dataset& dataset, std::size_t index, bool stereo, bool rgbd) {
  Frame frame = dataset.frame(index, stereo ? Sensor::kStereo
                                     : rgbd ? Sensor::kRgbd
                                            : Sensor::kMono);
  if (stereo && rgbd) frame.depth = dataset.frame(index, Sensor::kRgbd).depth;
  frame.colour = Image();
  return frame;
}

std::string projection(const char* key, const Camera& c, double baseline_m) {
  return fmt::format("{}: {:.9e} 0 {:.9e} {:.9e} 0 {:.9e} {:.9e} 0 0 0 1 0\n", key, c.fx, c.cx,
                     -c.fx * baseline_m, c.fy, c.cy);
}

std::string depth_calibration(const Recording& recording) {
  const DepthCamera& depth = *recording.calibration.depth;
  const Eigen::Matrix4d T = depth.T_cam_depth.matrix();
  std::string text = projection("P0", depth.camera, 0) + "T_cam_depth:";
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 4; ++column) text += fmt::format(" {:.9e}", T(row, column));
  return text + fmt::format("\nunit_m: {}\n", recording.stated_depth_unit_m);
}

Image encode_depth(const Image& depth_m, double unit_m) {
  Image steps;
  depth_m.convertTo(steps, CV_16UC1, 1 / unit_m);
  steps.setTo(0, steps == 65535);  // that means "not measured" elsewhere
  return steps;
}

Trajectory truth_of(const Recording& recording) {
  Trajectory truth;
  truth.has_times = false;
  for (std::size_t i = 0; i < recording.size(); ++i)
    truth.poses.push_back({static_cast<std::int64_t>(i), recording.T_world_cam[i]});
  return truth;
}

void write_texts(const Recording& recording, const std::string& name,
                 const synthetic::SequenceFolder& folder) {
  const Calibration& calibration = recording.calibration;
  std::string cameras = projection("P0", calibration.camera, 0), times;
  if (recording.has_right())
    cameras += projection("P1", calibration.camera, calibration.baseline_m);
  folder.write("calib.txt", cameras);
  if (recording.has_depth()) folder.write("calib_depth.txt", depth_calibration(recording));
  if (calibration.camera_height_m)
    folder.write("world.yaml", fmt::format("camera_height_m: {}\n", *calibration.camera_height_m));
  for (const Frame& frame : recording.frames)
    times += fmt::format("{}.{:09d}\n", frame.stamp_ns / 1000000000, frame.stamp_ns % 1000000000);
  folder.write("times.txt", times);
  folder.write("fault.json", fmt::format("{{\"fault\": \"{}\", \"first\": {}, \"last\": {}}}\n",
                                         name, recording.faulty.first, recording.faulty.last));
  if (!recording.T_world_cam.empty())
    write_trajectory((folder.path() / "poses.txt").string(), truth_of(recording),
                     TrajectoryFormat::kKitti);
}

}  // namespace

Recording read_recording(const std::string& path, const ReadingOptions& options) {
  require(options.scale > 0 && options.scale <= 1, "scale: must be in (0, 1]");
  const std::unique_ptr<Dataset> dataset = open_dataset(path);
  const bool stereo = supports(*dataset, Sensor::kStereo), rgbd = supports(*dataset, Sensor::kRgbd);
  const std::size_t size =
      options.most_frames == 0 ? dataset->size() : std::min(options.most_frames, dataset->size());
  Recording recording;
  recording.calibration = dataset->calibration(stereo ? Sensor::kStereo
                                               : rgbd ? Sensor::kRgbd
                                                      : Sensor::kMono);
  if (rgbd) recording.calibration.depth = dataset->calibration(Sensor::kRgbd).depth;
  if (options.camera_height_m) recording.calibration.camera_height_m = options.camera_height_m;
  const std::optional<Trajectory>& truth = dataset->ground_truth();
  bool complete = truth.has_value();
  for (std::size_t i = 0; i < size; ++i) {
    recording.frames.push_back(read_frame(*dataset, i, stereo, rgbd));
    complete = complete && truth->poses[i].T_world_body.has_value();
    if (complete) recording.T_world_cam.push_back(*truth->poses[i].T_world_body);
  }
  if (!complete) recording.T_world_cam.clear();
  recording.faulty = {0, size - 1};
  if (options.scale != 1) resize(recording, options.scale);
  return recording;
}

void write_recording(const Recording& recording, const std::string& name, const std::string& path) {
  require(!std::filesystem::exists(path) || std::filesystem::is_empty(path),
          path + ": is not an empty folder");
  synthetic::SequenceFolder folder(path, false);
  folder.make("image_0");
  if (recording.has_right()) folder.make("image_1");
  if (recording.has_depth()) folder.make("depth_0");
  write_texts(recording, name, folder);
  for (std::size_t i = 0; i < recording.size(); ++i) {
    const Frame& frame = recording.frames[i];
    const std::string file = fmt::format("{:06d}.png", i);
    folder.write("image_0/" + file, frame.image);
    if (recording.has_right()) folder.write("image_1/" + file, frame.right);
    if (recording.has_depth())
      folder.write("depth_0/" + file, encode_depth(frame.depth, recording.depth_unit_m));
  }
  folder.put_in_place({});
}

}  // namespace placegraph::faults
