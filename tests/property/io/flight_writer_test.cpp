#include <placegraph/graph/core/error.h>
#include <placegraph/io/datasets/euroc.h>
#include <placegraph/io/measurements/marker_layout_file.h>
#include <placegraph/io/sensors/imu_file.h>
#include <placegraph/io/synthetic/worlds/flight_world.h>
#include <placegraph/io/synthetic/writers/flight_writer.h>
#include <placegraph/io/trajectories/body_state_file.h>

#include <opencv2/core.hpp>

#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"

namespace placegraph {
namespace flight_writer_test {

using test::message_of;
using test::TemporaryFolder;

SyntheticWorld world_of(const std::string& name) {
  SyntheticOptions options;
  options.world = name;
  options.frames = 3;
  options.width = 64;
  options.height = 48;
  return SyntheticWorld(options);
}

TEST(FlightWriter, WhatItWritesIsReadAsItWas) {
  const TemporaryFolder folder;
  const SyntheticWorld world = world_of("flight");
  SequenceWriterOptions options;
  options.contents.flow = true;
  write_flight(world, folder / "hover", options);
  const EurocBody read = open_euroc_body(folder / "hover");
  ASSERT_EQ(read.images->size(), 3u);
  EXPECT_EQ(read.images->stamp_ns(2), world.stamp_ns(2));
  EXPECT_EQ(cv::norm(read.images->frame(1, Sensor::kMono).image, world.render(1, {}).frame.image,
                     cv::NORM_INF),
            0);
  const synthetic::FlightSetting& setting = *world.flight_setting();
  EXPECT_LT((read.T_body_cam.inverse() * setting.T_body_cam).log().norm(), 1e-9);
  const Camera camera = read.images->calibration(Sensor::kMono).camera;
  EXPECT_NEAR(camera.fx, world.calibration().camera.fx, 1e-4);

  const ImuRecording imu = read_imu(read.mav_folder + "/imu0");
  EXPECT_EQ(imu.samples.back().stamp_ns, world.stamp_ns(2));
  EXPECT_EQ(imu.noise.gyro, setting.flight.imu.noise.gyro);
  const auto truth = read_body_states(read.mav_folder + "/state_groundtruth_estimate0/data.csv");
  EXPECT_EQ(truth.size(), imu.samples.size());
  EXPECT_LT((truth.back().velocity_world - setting.flight.at_image(2).velocity_world).norm(), 1e-8);
  EXPECT_EQ(read_marker_layout(folder / "hover/markers.yaml").markers.size(), 6u);
  EXPECT_TRUE(std::filesystem::exists(folder / "hover/flow_0/000001.png"));
  EXPECT_FALSE(std::filesystem::exists(folder / "hover/flow_0/000002.png"));
}

TEST(FlightWriter, RefusesWorldsThatDoNotFly) {
  const TemporaryFolder folder;
  const SyntheticWorld world = world_of("warehouse");
  EXPECT_THAT(message_of<ArgumentError>([&] { write_flight(world, folder / "x", {}); }),
              testing::HasSubstr("is not a flight"));
}

}  // namespace flight_writer_test
}  // namespace placegraph
