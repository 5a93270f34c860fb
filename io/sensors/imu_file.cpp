#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/files/atomic_file.h>
#include <placegraph/io/files/text_file.h>
#include <placegraph/io/sensors/euroc_sensor.h>
#include <placegraph/io/sensors/imu_file.h>

#include <filesystem>

namespace placegraph {
namespace fs = std::filesystem;
namespace {

double positive(const YamlDocument& yaml, const char* key) {
  const double value = yaml.number(yaml.root(), key);
  if (!(value > 0)) yaml.fail(yaml.root()[key], fmt::format("{}: {} is not positive", key, value));
  return value;
}

void read_sensor(const fs::path& path, ImuRecording& recording) {
  const YamlDocument yaml(path.string());
  if (!yaml.root().IsMap()) yaml.fail(yaml.root(), "is not the sensor.yaml of an inertial sensor");
  const SE3 T_body_imu = read_T_body_sensor(yaml);
  // Rounding of a text. Chosen.
  constexpr double kSame = 1e-6;
  if (T_body_imu.log().norm() > kSame)
    yaml.fail(yaml.root()["T_BS"],
              "T_BS: the inertial sensor must have the body's origin and axes");
  recording.rate_hz = positive(yaml, "rate_hz");
  recording.noise.gyro = positive(yaml, "gyroscope_noise_density");
  recording.noise.gyro_bias_walk = positive(yaml, "gyroscope_random_walk");
  recording.noise.accel = positive(yaml, "accelerometer_noise_density");
  recording.noise.accel_bias_walk = positive(yaml, "accelerometer_random_walk");
}

}  // namespace

ImuRecording read_imu(const std::string& folder) {
  ImuRecording recording;
  read_sensor(fs::path(folder) / "sensor.yaml", recording);
  TextFile file((fs::path(folder) / "data.csv").string());
  std::string_view line;
  std::vector<std::string_view> fields;
  while (file.next_data(line)) {
    split_comma(line, fields);
    if (fields.size() != 7)
      file.fail(fmt::format("expected t_ns,wx,wy,wz,ax,ay,az, found {} columns", fields.size()));
    ImuSample sample;
    sample.stamp_ns = file.integer(fields[0], "time [ns]");
    if (!recording.samples.empty() && sample.stamp_ns <= recording.samples.back().stamp_ns)
      file.fail(fmt::format("time {} ns does not increase", sample.stamp_ns));
    for (int i = 0; i < 3; ++i) {
      sample.gyro_rad_s[i] = file.number(fields[static_cast<std::size_t>(1 + i)], "gyro [rad/s]");
      sample.accel_m_s2[i] =
          file.number(fields[static_cast<std::size_t>(4 + i)], "accelerometer [m/s^2]");
    }
    recording.samples.push_back(sample);
  }
  if (recording.samples.empty()) throw FileError(file.path(), "holds no samples");
  return recording;
}

void write_imu(const std::string& folder, const ImuRecording& recording) {
  make_output_folder(folder);
  AtomicFile sensor((fs::path(folder) / "sensor.yaml").string());
  sensor.stream() << "sensor_type: imu\n"
                  << T_body_sensor_yaml(SE3())
                  << fmt::format(
                         "rate_hz: {}\ngyroscope_noise_density: {}  # [rad/s/sqrt(Hz)]\n"
                         "gyroscope_random_walk: {}  # [rad/s^2/sqrt(Hz)]\n"
                         "accelerometer_noise_density: {}  # [m/s^2/sqrt(Hz)]\n"
                         "accelerometer_random_walk: {}  # [m/s^3/sqrt(Hz)]\n",
                         recording.rate_hz, recording.noise.gyro, recording.noise.gyro_bias_walk,
                         recording.noise.accel, recording.noise.accel_bias_walk);
  sensor.commit();
  AtomicFile data((fs::path(folder) / "data.csv").string());
  data.stream() << "#timestamp [ns],w_x [rad/s],w_y,w_z,a_x [m/s^2],a_y,a_z\n";
  for (const ImuSample& s : recording.samples)
    data.stream() << fmt::format("{},{:.9f},{:.9f},{:.9f},{:.9f},{:.9f},{:.9f}\n", s.stamp_ns,
                                 s.gyro_rad_s.x(), s.gyro_rad_s.y(), s.gyro_rad_s.z(),
                                 s.accel_m_s2.x(), s.accel_m_s2.y(), s.accel_m_s2.z());
  data.commit();
}

}  // namespace placegraph
