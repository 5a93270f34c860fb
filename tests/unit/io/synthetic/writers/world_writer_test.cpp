#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/image/png_codec.h>
#include <placegraph/io/synthetic/writers/flight_writer.h>
#include <placegraph/io/synthetic/writers/world_writer.h>
#include <placegraph/io/trajectories/trajectory_file.h>

#include <cmath>
#include <map>
#include <opencv2/core.hpp>
#include <set>
#include <sstream>

#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"

namespace placegraph {
namespace world_writer_test {

namespace fs = std::filesystem;
using test::message_of;
using test::read_file;
using test::TemporaryFolder;
using testing::HasSubstr;

/// Few small frames of a walk through a corridor, or of a flight.
SyntheticWorld small_world(const std::string& name, int frames) {
  SyntheticOptions options;
  options.world = name;
  options.frames = frames;
  options.width = 64;
  options.height = 48;
  if (name == "flight") options.duration_s = 1;
  return SyntheticWorld(options);
}

/// All files below a folder with their bytes.
std::map<std::string, std::string> files_of(const std::string& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file())
      files[fs::relative(entry.path(), folder).string()] = read_file(entry.path().string());
  return files;
}

Image image_in(const std::map<std::string, std::string>& files, const std::string& name) {
  return decode_png(files.at(name), DecodedPixels::kAsStored);
}

TEST(WorldWriter, WritesWhatTheWorldRendersInTheSameBytesByAnyNumberOfThreads) {
  const SyntheticWorld world = small_world("corridor-loop", 3);
  const TemporaryFolder around;
  SequenceWriterOptions options;
  options.contents = {true, true, true, true, true};
  std::map<std::string, std::string> files;
  for (const int threads : {1, 3}) {
    options.threads = threads;
    const std::string path = around / std::to_string(threads);
    std::vector<std::size_t> done;
    write_world(world, path, options, [&](std::size_t count) { done.push_back(count); });
    EXPECT_THAT(done, testing::ElementsAre(1, 2, 3));
    if (threads == 1) files = files_of(path);
    EXPECT_EQ(files_of(path), files);
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const SyntheticFrame frame = world.render(i, options.contents);
    const std::string name = "_0/00000" + std::to_string(i) + ".png";
    const auto expect_same = [&](const std::string& file, const Image& image) {
      EXPECT_EQ(cv::norm(image_in(files, file), image, cv::NORM_INF), 0) << file;
    };
    expect_same("image" + name, frame.frame.image);
    expect_same("image_1" + name.substr(2), frame.frame.right);
    expect_same("labels" + name, frame.labels);
    expect_same("planes" + name, frame.planes);
    const Image depth = image_in(files, "depth" + name);
    ASSERT_EQ(depth.type(), CV_16UC1);
    for (int v = 0; v < depth.rows; ++v)
      for (int u = 0; u < depth.cols; ++u)  // a step is a millimetre
        ASSERT_NEAR(1e-3 * depth.at<std::uint16_t>(v, u), frame.frame.depth.at<float>(v, u), 6e-4);
    EXPECT_EQ(files.count("flow" + name), i < 2 ? 1u : 0u);  // the last has no next
  }
}

TEST(WorldWriter, TextsSayTheCalibrationTheTimesAndThePoses) {
  const SyntheticWorld world = small_world("corridor-loop", 4);
  const TemporaryFolder around;
  SequenceWriterOptions options;
  options.contents.planes = true;
  write_world(world, around / "walk", options);
  const auto files = files_of(around / "walk");
  const Calibration calibration = world.calibration();
  std::istringstream calib(files.at("calib.txt"));
  std::string key;
  for (int camera = 0; camera < 2; ++camera) {
    double P[12];
    calib >> key;
    EXPECT_EQ(key, "P" + std::to_string(camera) + ":");
    for (double& p : P) calib >> p;
    const Camera& c = calibration.camera;
    EXPECT_NEAR(P[0], c.fx, 1e-6);
    EXPECT_NEAR(P[5], c.fy, 1e-6);
    EXPECT_NEAR(P[2], c.cx, 1e-6);
    EXPECT_NEAR(P[6], c.cy, 1e-6);
    EXPECT_NEAR(P[3], -camera * c.fx * calibration.baseline_m, 1e-6);
  }
  std::istringstream times(files.at("times.txt"));
  const Trajectory truth = world.ground_truth(), poses = read_trajectory(around / "walk/poses.txt");
  ASSERT_EQ(poses.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    double time_s = 0;
    times >> time_s;
    EXPECT_NEAR(time_s, 1e-9 * static_cast<double>(world.stamp_ns(i)), 1e-9);
    EXPECT_TRUE(poses.poses[i].T_world_body->isApprox(*truth.poses[i].T_world_body, 1e-6));
  }
  std::istringstream planes(files.at("planes.txt"));
  for (const Eigen::Vector4d& plane : world.planes())
    for (const double expected : plane) {
      double number = 0;
      planes >> number;
      ASSERT_NEAR(number, expected, 1e-8);
    }
  EXPECT_EQ(files.at("floorplan.json"), world.floor_plan());
  for (const auto& [name, bytes] : files)
    EXPECT_FALSE(name.starts_with("CLASSES") || name.find("depth") != std::string::npos) << name;
}

TEST(WorldWriter, AForcedSequenceLeavesNothingOfTheOneBefore) {
  const TemporaryFolder around;
  SequenceWriterOptions options;
  options.contents.depth = options.contents.labels = true;
  write_world(small_world("corridor-loop", 3), around / "walk", options);
  options.contents = {};
  EXPECT_THROW(write_world(small_world("corridor-loop", 2), around / "walk", options),
               ArgumentError);
  options.force = true;
  write_world(small_world("corridor-loop", 2), around / "walk", options);
  write_world(small_world("corridor-loop", 2), around / "alone", options);
  EXPECT_EQ(files_of(around / "walk"), files_of(around / "alone"));
}

TEST(WorldWriter, AFlightHasItsOwnLayoutAndOneCamera) {
  const SyntheticWorld flight = small_world("flight", 2), walk = small_world("corridor-loop", 1);
  const TemporaryFolder around;
  SequenceWriterOptions options;
  options.contents.depth = true;
  EXPECT_THAT(message_of<ArgumentError>([&] { write_world(flight, around / "a", options); }),
              HasSubstr("flight: has one camera"));
  EXPECT_THAT(message_of<ArgumentError>([&] { write_flight(walk, around / "a", options); }),
              HasSubstr("corridor-loop: is not a flight"));
  options.contents = usual_contents(flight);
  options.contents.flow = true;
  write_world(flight, around / "flight", options);
  const auto files = files_of(around / "flight");
  for (std::size_t i = 0; i < 2; ++i) {
    const std::string stamp = std::to_string(flight.stamp_ns(i));
    EXPECT_EQ(cv::norm(image_in(files, "mav0/cam0/data/" + stamp + ".png"),
                       flight.render(i, {}).frame.image, cv::NORM_INF),
              0);
    EXPECT_THAT(files.at("mav0/cam0/data.csv"), HasSubstr(stamp + "," + stamp + ".png\n"));
  }
  EXPECT_EQ(files.count("flow_0/000000.png"), 1u);
  // The recordings end with the last image: one inertial sample every 5 ms, from the first on.
  const auto lines = [&](const char* name) { return std::ranges::count(files.at(name), '\n') - 1; };
  const auto samples = (flight.stamp_ns(1) - flight.stamp_ns(0)) / 5'000'000 + 1;
  EXPECT_EQ(lines("mav0/imu0/data.csv"), samples);
  EXPECT_EQ(lines("mav0/state_groundtruth_estimate0/data.csv"), samples);
  EXPECT_EQ(files.count("markers.yaml"), 1u);
}

TEST(WorldWriter, UsuallyWritesDepthIndoorsOnly) {
  const SyntheticContents indoors = usual_contents(small_world("corridor-loop", 1));
  EXPECT_TRUE(indoors.depth && !indoors.right);
  const SyntheticContents flying = usual_contents(small_world("flight", 1));
  EXPECT_FALSE(flying.depth || flying.right || flying.labels || flying.planes || flying.flow);
}

}  // namespace world_writer_test
}  // namespace placegraph
