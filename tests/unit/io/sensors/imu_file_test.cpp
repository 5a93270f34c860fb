#include <placegraph/io/sensors/imu_file.h>

#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"

namespace placegraph {
namespace imu_file_test {

using test::message_of;
using test::TemporaryFolder;
using testing::HasSubstr;

std::string sensor(const std::string& x_m = "0", const std::string& rate_hz = "200") {
  return "sensor_type: imu\nT_BS:\n  cols: 4\n  rows: 4\n  data: [1, 0, 0, " + x_m +
         ", 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]\nrate_hz: " + rate_hz +
         "\n"
         "gyroscope_noise_density: 1.7e-4\ngyroscope_random_walk: 1.9e-5\n"
         "accelerometer_noise_density: 2.0e-3\naccelerometer_random_walk: 3.0e-3\n";
}

std::string refused(const std::string& data, const std::string& yaml = sensor()) {
  const TemporaryFolder folder;
  folder.write("imu0/sensor.yaml", yaml);
  folder.write("imu0/data.csv", data);
  return message_of([&] { (void)read_imu(folder / "imu0"); });
}

TEST(ImuFile, ReadsSamplesAndNoise) {
  const TemporaryFolder folder;
  folder.write("imu0/sensor.yaml", sensor());
  folder.write("imu0/data.csv", "#timestamp\n1000,0.1,0.2,0.3,1,2,9.8\r\n6000,-1,-2,-3,4,5,6\n");
  const ImuRecording imu = read_imu(folder / "imu0");
  EXPECT_EQ(imu.rate_hz, 200);
  EXPECT_EQ(imu.noise.gyro, 1.7e-4);
  EXPECT_EQ(imu.noise.gyro_bias_walk, 1.9e-5);
  EXPECT_EQ(imu.noise.accel, 2e-3);
  EXPECT_EQ(imu.noise.accel_bias_walk, 3e-3);
  ASSERT_EQ(imu.samples.size(), 2u);
  EXPECT_EQ(imu.samples[1].stamp_ns, 6000);
  EXPECT_EQ(imu.samples[0].gyro_rad_s, Eigen::Vector3d(0.1, 0.2, 0.3));
  EXPECT_EQ(imu.samples[1].accel_m_s2, Eigen::Vector3d(4, 5, 6));
}

TEST(ImuFile, ReadsWhatItWrote) {
  const TemporaryFolder folder;
  ImuRecording imu;
  imu.rate_hz = 100;
  imu.noise = {1e-3, 2e-2, 3e-5, 4e-4};
  imu.samples = {{5, {0.1, -0.2, 0.3}, {1, 2, 3}}, {15, {0, 0, 1}, {0.5, 0, 9.80665}}};
  write_imu(folder / "mav0/imu0", imu);
  const ImuRecording again = read_imu(folder / "mav0/imu0");
  EXPECT_EQ(again.rate_hz, 100);
  EXPECT_EQ(again.noise.accel_bias_walk, 4e-4);
  ASSERT_EQ(again.samples.size(), 2u);
  EXPECT_EQ(again.samples[1].stamp_ns, 15);
  EXPECT_LT((again.samples[0].gyro_rad_s - imu.samples[0].gyro_rad_s).norm(), 1e-9);
  EXPECT_LT((again.samples[1].accel_m_s2 - imu.samples[1].accel_m_s2).norm(), 1e-9);
}

TEST(ImuFile, NamesFileAndLineOfWhatIsWrong) {
  EXPECT_THAT(refused("1,0,0,0,0,0,9\n2,0,0,0,0\n"), HasSubstr("data.csv:2: expected t_ns"));
  EXPECT_THAT(refused("1,0,nan,0,0,0,9\n"), HasSubstr("data.csv:1: gyro"));
  EXPECT_THAT(refused("1,0,0,0,0,inf,9\n"), HasSubstr("data.csv:1: accelerometer"));
  EXPECT_THAT(refused("2,0,0,0,0,0,9\n\n2,0,0,0,0,0,9\n"),
              HasSubstr("data.csv:3: time 2 ns does not increase"));
  EXPECT_THAT(refused("#none\n"), HasSubstr("data.csv: holds no samples"));
  EXPECT_THAT(refused("1,0,0,0,0,0,9\n", sensor("0.1")), HasSubstr("sensor.yaml:3: T_BS"));
  EXPECT_THAT(refused("1,0,0,0,0,0,9\n", "rate_hz: 200\n"), HasSubstr("T_BS: is missing"));
  EXPECT_THAT(refused("1,0,0,0,0,0,9\n", sensor("0", "-1")), HasSubstr("rate_hz: -1 is not pos"));
  EXPECT_THAT(message_of([] { (void)read_imu("/nowhere"); }), HasSubstr("/nowhere/sensor.yaml"));
}

}  // namespace imu_file_test
}  // namespace placegraph
