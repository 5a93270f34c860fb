#include <gtest/gtest.h>
#include <placegraph/io/config/yaml_config.h>
#include <placegraph/io/datasets/open_dataset.h>
#include <placegraph/pipeline/run.h>

#include <algorithm>
#include <iomanip>
#include <sstream>

#include "tests/support/paths.h"
#include "tests/support/scenes/street_files.h"

namespace placegraph {
namespace configs_test {

using namespace test;
namespace fs = std::filesystem;

const std::string kFolder = source_dir() + "/configs/";
constexpr int kFrames = 8;

RunOptions options_of(const std::string& path) {
  RunOptions options;
  read_options(path, options);
  options.check();
  return options;
}

TEST(Configs, AreAllReadAndChangeSomething) {
  int count = 0;
  const std::string defaults = dump_options(RunOptions{});
  for (const auto& entry : fs::directory_iterator(kFolder)) {
    if (entry.is_directory()) continue;  // models/
    SCOPED_TRACE(entry.path());
    ASSERT_EQ(entry.path().extension(), ".yaml");
    EXPECT_NE(dump_options(options_of(entry.path().string())), defaults);
    EXPECT_EQ(read_file(entry.path().string()).front(), '#') << "says what it is for";
    ++count;
  }
  EXPECT_GE(count, 6);
}

/// The street as pictures on disk, in one of the layouts.
class OnDisk : public testing::Test {
 protected:
  const TemporaryFolder folder_;
  const StreetFiles files_{folder_, kFrames};

  RunResult run(const std::string& config, Sensor sensor) {
    const RunResult result =
        run_sequence(*open_dataset(folder_ / "s"), options_of(kFolder + config));
    EXPECT_EQ(result.sensor, sensor);
    EXPECT_TRUE(result.map.metric);
    const Trajectory trajectory = result.map.trajectory_optimized();
    EXPECT_EQ(trajectory.posed(), static_cast<std::size_t>(kFrames));
    const auto& last = trajectory.poses.back().T_world_body;
    if (!last) {
      ADD_FAILURE() << "the last frame has no pose";
      return result;
    }
    const SE3 truth = street_T_world_cam(0).inverse() * street_T_world_cam(kFrames - 1);
    EXPECT_LT(distance_m(SE3(*last), truth), 0.06 * truth.translation().norm());
    return result;
  }
};

TEST_F(OnDisk, KittiMonoRuns) {
  files_.write_kitti(false);
  const RunResult result = run("kitti_mono.yaml", Sensor::kMono);
  EXPECT_EQ(result.calibration.camera_height_m, 1.65);
}

TEST_F(OnDisk, KittiStereoRuns) {
  files_.write_kitti(true);
  run("kitti_stereo.yaml", Sensor::kStereo);
}

TEST_F(OnDisk, SyntheticRuns) {
  files_.write_kitti(true);
  run("synthetic.yaml", Sensor::kStereo);
}

TEST_F(OnDisk, SevenScenesRuns) {
  files_.write_kitti(false);
  for (int i = 0; i < kFrames; ++i)
    write_image(folder_, "s/depth_0/" + files_.name(i), files_.depth(i, 1000));
  run("sevenscenes_rgbd.yaml", Sensor::kRgbd);
}

TEST_F(OnDisk, TumRuns) {
  std::ostringstream rgb, depths, calibration;
  for (int i = 0; i < kFrames; ++i) {
    write_image(folder_, "s/rgb/" + files_.name(i), files_.left(i));
    write_image(folder_, "s/depth/" + files_.name(i), files_.depth(i, 5000));
    rgb << 100 + i / 30.0 << " rgb/" << files_.name(i) << "\n";
    depths << 100.01 + i / 30.0 << " depth/" << files_.name(i) << "\n";
  }
  folder_.write("s/rgb.txt", rgb.str());
  folder_.write("s/depth.txt", depths.str());
  const Camera c = street_camera();
  calibration << std::setprecision(12) << "width: " << c.width << "\nheight: " << c.height
              << "\nfx: " << c.fx << "\nfy: " << c.fy << "\ncx: " << c.cx << "\ncy: " << c.cy
              << "\n";
  folder_.write("s/calibration.yaml", calibration.str());
  run("tum_rgbd.yaml", Sensor::kRgbd);
}

TEST_F(OnDisk, EurocRuns) {
  for (const int camera_number : {0, 1}) {
    const std::string at = "s/mav0/cam" + std::to_string(camera_number) + "/";
    std::string list = "#timestamp [ns],filename\n";
    for (int i = 0; i < kFrames; ++i) {
      const std::string stamp = std::to_string(1'000'000'000 + 50'000'000 * i);
      list += stamp + "," + stamp + ".png\n";
      write_image(folder_, at + "data/" + stamp + ".png",
                  camera_number ? files_.right(i) : files_.left(i));
    }
    folder_.write(at + "data.csv", list);
    const Camera c = street_camera();
    std::ostringstream sensor;
    sensor << std::setprecision(12)
           << "sensor_type: camera\nT_BS:\n  cols: 4\n  rows: 4\n  data: [1, 0, 0, "
           << (camera_number ? kStreetBaseline_m : 0.0)
           << ", 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]\nrate_hz: 20\nresolution: [" << c.width << ", "
           << c.height << "]\ncamera_model: pinhole\nintrinsics: [" << c.fx << ", " << c.fy << ", "
           << c.cx << ", " << c.cy
           << "]\ndistortion_model: radial-tangential\ndistortion_coefficients: [0, 0, 0, 0]\n";
    folder_.write(at + "sensor.yaml", sensor.str());
  }
  run("euroc.yaml", Sensor::kStereo);
}

}  // namespace configs_test
}  // namespace placegraph
