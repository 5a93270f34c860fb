#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/parallel.h>
#include <placegraph/io/measurements/flow_file.h>
#include <placegraph/io/measurements/marker_layout_file.h>
#include <placegraph/io/sensors/euroc_sensor.h>
#include <placegraph/io/synthetic/worlds/flight_world.h>
#include <placegraph/io/synthetic/writers/flight_writer.h>
#include <placegraph/io/synthetic/writers/sequence_folder.h>
#include <placegraph/io/trajectories/body_state_file.h>

#include <mutex>

namespace placegraph {

using synthetic::FlightSetting;
using synthetic::SequenceFolder;
using synthetic::SimulatedFlight;

namespace {

const std::string kCamera = "mav0/cam0", kTruth = "mav0/state_groundtruth_estimate0";

std::string camera_yaml(const Camera& camera, const SE3& T_body_cam) {
  return "sensor_type: camera\n" + T_body_sensor_yaml(T_body_cam) +
         fmt::format(
             "rate_hz: {}\nresolution: [{}, {}]\ncamera_model: pinhole\n"
             "intrinsics: [{}, {}, {}, {}]\ndistortion_model: none\ndistortion_coefficients: []\n",
             SimulatedFlight::kImageHz, camera.width, camera.height, camera.fx, camera.fy,
             camera.cx, camera.cy);
}

std::string flight_yaml(const SyntheticWorld& world) {
  const SyntheticOptions& o = world.options();
  const std::string defects = defect_list(o.defects);
  return fmt::format(
      "# A rendered flight; {}\nworld: {}\ndifficulty: {}\nseed: {}\nframes: {}\nfloor_z_m: 0\n{}",
      defects.empty() ? "everything here is exact." : "its files have these defects.", world.name(),
      to_string(o.difficulty), o.seed, world.size(),
      defects.empty() ? defects : "defects:\n" + defects);
}

std::string readme(const SyntheticContents& contents) {
  std::string text =
      "Rendered by `placegraph synth sequence flight`. EuRoC's layout: mav0/cam0 (8-bit grey, no "
      "distortion),\n"
      "mav0/imu0, mav0/state_groundtruth_estimate0 (T_world_body, velocity, biases, exact).\n"
      "World: z up, the floor is z = 0. Body: the inertial sensor's axes, x forward, z up.\n"
      "markers.yaml: AprilTags and lamps in the middle of the floor.\n";
  if (contents.flow)
    text +=
        "flow_0: to the next image, KITTI's 16-bit form: (R, G) = 64 * (du, dv) + 2^15, B = "
        "valid.\n";
  return text;
}

void write_recordings(const FlightSetting& setting, std::int64_t last_ns,
                      const SequenceFolder& folder) {
  ImuRecording imu = setting.flight.imu;
  std::vector<BodyState> truth = setting.flight.truth;
  while (truth.back().stamp_ns > last_ns) truth.pop_back();
  imu.samples.resize(truth.size());
  folder.make(kTruth);
  write_imu((folder.path() / "mav0/imu0").string(), imu);
  write_body_states((folder.path() / kTruth / "data.csv").string(), truth);
  write_marker_layout((folder.path() / "markers.yaml").string(), setting.layout);
}

}  // namespace

void write_flight(const SyntheticWorld& world, const std::string& path,
                  const SequenceWriterOptions& options,
                  const std::function<void(std::size_t)>& progress) {
  const FlightSetting* setting = world.flight_setting();
  require(setting != nullptr, world.name() + ": is not a flight");
  SequenceFolder folder(path, options.force);
  SyntheticContents contents;
  contents.flow = options.contents.flow;
  folder.make(kCamera + "/data");
  if (contents.flow) folder.make("flow_0");
  std::string list = "#timestamp [ns],filename\n";
  const auto name = [&](std::size_t index) { return fmt::format("{}.png", world.stamp_ns(index)); };
  for (std::size_t i = 0; i < world.size(); ++i)
    list += fmt::format("{},{}\n", world.stamp_ns(i), name(i));
  folder.write(kCamera + "/data.csv", list);
  folder.write(kCamera + "/sensor.yaml",
               camera_yaml(world.calibration().camera, setting->T_body_cam));
  write_recordings(*setting, world.stamp_ns(world.size() - 1), folder);
  folder.write("world.yaml", flight_yaml(world));
  folder.write("README.txt", readme(contents));

  std::mutex mutex;
  std::size_t done = 0;
  parallel_for(static_cast<int>(world.size()), options.threads, [&](int i) {
    const auto index = static_cast<std::size_t>(i);
    const SyntheticFrame frame = world.render(index, contents);
    folder.write(kCamera + "/data/" + name(index), frame.frame.image);
    if (!frame.flow.empty())
      folder.write(fmt::format("flow_0/{:06d}.png", index), encode_kitti_flow(frame.flow));
    const std::lock_guard<std::mutex> lock(mutex);
    ++done;
    if (progress) progress(done);
  });
  folder.put_in_place({"mav0", "flow_0", "markers.yaml", "world.yaml", "README.txt"});
}

}  // namespace placegraph
