#include <placegraph/graph/core/error.h>
#include <placegraph/io/odometry_file.h>
#include <placegraph/pipeline/lens_correction.h>
#include <placegraph/pipeline/run.h>

#include <algorithm>
#include <cmath>
#include <future>

namespace placegraph {
namespace {

Sensor choose_sensor(const Dataset& dataset, SensorChoice choice) {
  const auto offered = dataset.sensors();
  if (choice == SensorChoice::kAuto) return offered.front();
  const Sensor wanted = static_cast<Sensor>(static_cast<int>(choice) - 1);
  std::string all;
  for (const Sensor sensor : offered)
    all += (all.empty() ? "" : ", ") + std::string(to_string(sensor));
  require(
      std::find(offered.begin(), offered.end(), wanted) != offered.end(),
      dataset.name() + ": has not what " + to_string(wanted) + " needs; it can be run as " + all);
  return wanted;
}

/// Of the camera.
MeasuredMotion read_motion(const Dataset& dataset, const MotionOptions& options) {
  std::vector<std::int64_t> stamps_ns;
  for (std::size_t i = 0; i < dataset.size(); ++i) stamps_ns.push_back(dataset.stamp_ns(i));
  const auto& v = options.T_cam_body;
  const Eigen::Quaterniond q(v[6], v[3], v[4], v[5]);
  const SE3 T_cam_body(q.normalized().toRotationMatrix(), Eigen::Vector3d(v[0], v[1], v[2]));
  return read_odometry(options.file, options.noise, stamps_ns).seen_from(T_cam_body);
}

/// Reads frames in order, one ahead of its user if it may have a thread for that.
class FrameReader {
 public:
  FrameReader(const Dataset& dataset, const LensCorrection& lens, Sensor sensor, std::size_t end,
              bool ahead)
      : dataset_(dataset), lens_(lens), sensor_(sensor), end_(end), ahead_(ahead) {}

  Frame read(std::size_t index) {
    Frame frame = next_.valid() ? next_.get() : load(index);
    if (ahead_ && index + 1 < end_)
      next_ = std::async(std::launch::async, [this, index] { return load(index + 1); });
    return frame;
  }

 private:
  Frame load(std::size_t index) const {
    Frame frame = dataset_.frame(index, sensor_);
    lens_.apply(frame);
    return frame;
  }

  const Dataset& dataset_;
  LensCorrection lens_;
  Sensor sensor_;
  std::size_t end_;
  bool ahead_;
  std::future<Frame> next_;
};

/// Whether the images proved to be distorted by more than `lens` takes out, which then does. The
/// first finding leans towards no distortion, as tracks that contradict it were dropped: it is
/// refined once.
bool learn_lens(const LensEstimator& seen, int pass, const LensOptions& options,
                LensCorrection& lens, const LogSink& log) {
  if (pass > 1) return false;
  LensOptions refined = options;
  if (pass == 1) {
    refined.min_sigmas *= 0.5;
    refined.min_effect *= 0.25;
  }
  if (!seen.distorted(refined)) return false;
  lens.add(seen.k1());
  placegraph::log(log, LogLevel::kInfo,
                  "images are distorted, k1 = " + std::to_string(lens.k1()) + " +- " +
                      std::to_string(seen.sigma_k1()) + ": once more from the beginning without");
  return true;
}

}  // namespace

const char* to_string(Sensor sensor) {
  switch (sensor) {
    case Sensor::kMono:
      return "mono";
    case Sensor::kStereo:
      return "stereo";
    case Sensor::kRgbd:
      return "rgbd";
  }
  return "";
}

void RunOptions::check() const {
  check_ranges(*this);
  motion.check();
  lens.check();
  slam.check();
}

void visit(OptionVisitor& field, RunOptions& o) {
  field.choice("sensor", o.sensor, {"auto", "mono", "stereo", "rgbd"},
               "what the sequence is run as; auto: the best it offers");
  field("camera_height_m", o.camera_height_m,
        "of the camera above the ground; 0: as the sequence says, or unknown", {0, 1000});
  field("first_frame", o.first_frame, "frames left out at the beginning", {0, 1e9});
  field("max_frames", o.max_frames, "frames run; 0: all", {0, 1e9});
  field("threads", o.threads, "threads; the result does not depend on it", {1, 256});
  field.group("motion", o.motion, "motion that other sensors measured");
  field.group("lens", o.lens, "self-calibration of one eye's radial distortion");
  visit(field, o.slam);
}

void MotionOptions::check() const {
  check_ranges(*this);
  noise.check();
  require(T_cam_body.size() == 7, "motion.T_cam_body: seven numbers needed, tx ty tz qx qy qz qw");
  const Eigen::Map<const Eigen::Vector4d> q(T_cam_body.data() + 3);
  require(std::abs(q.norm() - 1) < 1e-2, "motion.T_cam_body: the quaternion is not of unit length");
}

void visit(OptionVisitor& field, MotionOptions& o) {
  field("file", o.file, "see docs/odometry.md; none if empty");
  field("T_cam_body", o.T_cam_body, "tx ty tz qx qy qz qw of the body in the camera [m]");
  field.group("noise", o.noise, "where the file tells none");
}

RunResult run_sequence(const Dataset& dataset, const RunOptions& options,
                       const RunProgress& progress, const LogSink& log,
                       const FrameObserver& observer) {
  options.check();
  RunResult result;
  result.sensor = choose_sensor(dataset, options.sensor);
  result.calibration = dataset.calibration(result.sensor);
  if (options.camera_height_m > 0) result.calibration.camera_height_m = options.camera_height_m;
  const std::size_t begin = options.first_frame;
  require(begin < dataset.size(),
          "first_frame: the sequence has " + std::to_string(dataset.size()) + " frames");
  const std::size_t end = options.max_frames > 0
                              ? std::min(dataset.size(), begin + options.max_frames)
                              : dataset.size();

  LensCorrection lens(result.calibration);
  for (int pass = 0;; ++pass) {
    result.calibration = lens.calibration();
    Slam slam(options.slam, result.calibration, log);
    if (!options.motion.file.empty()) slam.set_motion(read_motion(dataset, options.motion));
    StageTimes reading;
    FrameReader reader(dataset, lens, result.sensor, end, options.threads > 1);
    bool again = false;
    for (std::size_t i = begin; i < end && !again; ++i) {
      Frame frame;
      try {
        const auto span = reading.measure("reading");
        frame = reader.read(i);
      } catch (const FileError& error) {
        if (i == begin) throw;
        result.broken_off = error.what();
        break;
      }
      const FrameResult frame_result = slam.add_frame(frame);
      if (observer) observer(frame, frame_result, slam.view());
      if (progress) progress(i + 1 - begin, end - begin, frame_result);
      again = learn_lens(slam.lens(), pass, options.lens, lens, log);
    }
    if (again) continue;
    result.lens_k1 = lens.k1();
    result.map = slam.finish();
    result.stages = reading.stages();
    result.stages.insert(result.stages.end(), slam.stages().begin(), slam.stages().end());
    return result;
  }
}

}  // namespace placegraph
