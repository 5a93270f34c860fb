#include <placegraph/backend/inertial/inertial_window.h>
#include <placegraph/pipeline/flight/flight_estimator.h>
#include <placegraph/pipeline/flight/flight_run.h>

#include <algorithm>
#include <cmath>

namespace placegraph {
FlightRun run_flight(const Dataset& images, const ImuRecording& imu, const SE3& T_body_cam,
                     const MarkerLayout& layout, const FlightRunOptions& options,
                     const std::function<void(std::size_t done)>& progress) {
  FlightRun run;
  StageTimes reading;
  FlightEstimator estimator(options.flight, images.calibration(Sensor::kMono).camera, T_body_cam,
                            layout);
  const auto ahead_ns = static_cast<std::int64_t>(std::llround(1e9 * options.predict_ahead_s));
  std::optional<BodyState> start = options.initial_state;
  auto sample = imu.samples.begin();
  for (std::size_t i = 0; i < images.size(); ++i) {
    Frame frame;
    {
      const auto span = reading.measure("read");
      frame = images.frame(i, Sensor::kMono);
    }
    for (; sample != imu.samples.end() && sample->stamp_ns <= frame.stamp_ns; ++sample)
      (void)estimator.add(*sample);
    if (start && start->stamp_ns <= frame.stamp_ns) {
      estimator.start(*start);
      start.reset();
    }
    const double t = 1e-9 * static_cast<double>(frame.stamp_ns - images.stamp_ns(0));
    const bool blind =
        std::any_of(options.blind.begin(), options.blind.end(),
                    [t](const TimeSpan& span) { return t >= span.from_s && t < span.to_s; });
    FlightFrame result = estimator.add(frame, !blind);
    if (ahead_ns > 0) {
      const ErrorStateFilter::StateEstimate later = estimator.at(frame.stamp_ns + ahead_ns);
      result.outcome = later.outcome;
      result.state = later.state;
    }
    run.frames.push_back(std::move(result));
    if (progress) progress(i + 1);
  }
  run.stages = reading.stages();
  for (const StageTime& stage : estimator.times().stages()) run.stages.push_back(stage);
  return run;
}

std::vector<BodyState> smooth_flight(const FlightRun& run, const ImuRecording& imu,
                                     const SE3& T_body_cam, const FlightOptions& options,
                                     int states) {
  InertialWindowOptions window_options;
  const ErrorStateFilterOptions& filter = options.filter;
  window_options.noise = {filter.gyro_noise, filter.accel_noise, filter.gyro_bias_walk,
                          filter.accel_bias_walk};
  window_options.max_states = states;
  window_options.gate = filter.gate;
  InertialWindow window(window_options, T_body_cam, options.floor_z_m);
  std::vector<BodyState> smoothed;
  auto sample = imu.samples.begin();
  std::vector<BodyState> held;
  for (const FlightFrame& frame : run.frames) {
    if (!window.started()) {
      if (!frame.outcome) continue;
      window.start(frame.state);
      while (sample != imu.samples.end() && sample->stamp_ns <= frame.stamp_ns) ++sample;
      continue;
    }
    for (; sample != imu.samples.end() && sample->stamp_ns <= frame.stamp_ns; ++sample)
      (void)window.add(*sample);
    if (frame.flow_measurement) (void)window.add(*frame.flow_measurement);
    if (frame.pose_measurement) (void)window.add(*frame.pose_measurement);
    held = window.solve().states;
    if (static_cast<int>(held.size()) == states) smoothed.push_back(held.front());
  }
  if (static_cast<int>(held.size()) == states) held.erase(held.begin());
  smoothed.insert(smoothed.end(), held.begin(), held.end());
  return smoothed;
}

}  // namespace placegraph
