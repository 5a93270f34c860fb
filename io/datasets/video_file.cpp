#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/time.h>
#include <placegraph/graph/image/picture_plugin.h>
#include <placegraph/graph/measurements/stamp_plausibility.h>
#include <placegraph/io/calibration/calibration_file.h>
#include <placegraph/io/calibration/calibration_plausibility.h>
#include <placegraph/io/datasets/recorded_sequence.h>
#include <placegraph/io/datasets/video_file.h>
#include <placegraph/io/files/image_file.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <string_view>

namespace placegraph {
namespace fs = std::filesystem;
namespace {

std::unique_ptr<VideoReader> open_video(const std::string& path) {
  std::unique_ptr<VideoReader> video = picture_plugin(path).open_video(path);
  if (!video) throw FileError(path, "is not a readable video");
  return video;
}

/// Extrapolates the times of the last frames with the time step before them. The reader returns no
/// times for frames that the decoder still buffers at the end of the file (as many as frames are
/// predicted from later ones).
void continue_times(std::vector<std::int64_t>& stamps_ns) {
  constexpr std::size_t kMostHeld = 16;
  std::size_t timed = 1;
  while (timed < stamps_ns.size() && stamps_ns[timed] > stamps_ns[timed - 1]) ++timed;
  if (timed < 2 || stamps_ns.size() - timed > kMostHeld) return;
  const std::int64_t step_ns = stamps_ns[timed - 1] - stamps_ns[timed - 2];
  for (; timed < stamps_ns.size(); ++timed) stamps_ns[timed] = stamps_ns[timed - 1] + step_ns;
}

class VideoDataset : public Dataset {
 public:
  VideoDataset(const std::string& path, const std::string& yaml_path, CalibrationYaml yaml)
      : path_(path) {
    if (auto note = fit_to_image(path, decode(0), yaml)) notes_.push_back(*note);
    raw_ = yaml.camera().camera;
    undistorted_ = undistort_plausibly(yaml_path, yaml.camera());
    name_ = fs::path(path).stem().string();
    calibration_.camera = undistorted_.camera;
    if (yaml.camera_height_m > 0) calibration_.camera_height_m = yaml.camera_height_m;

    read_times(yaml.fps);
    for (DataNote& note : odd_calibration(calibration_)) notes_.push_back(std::move(note));
    const std::string odd = odd_spacing(stamps_ns_, "frame");
    if (!odd.empty()) notes_.push_back({odd, false, NoteCause::kTimes, ""});
  }

  const std::string& name() const override { return name_; }
  const std::string& format() const override { return format_; }
  std::size_t size() const override { return stamps_ns_.size(); }
  std::vector<Sensor> sensors() const override { return {Sensor::kMono}; }
  Calibration calibration(Sensor sensor) const override {
    return calibration_for(sensor, calibration_, name_);
  }
  std::int64_t stamp_ns(std::size_t index) const override {
    check_index(index);
    return stamps_ns_[index];
  }
  const std::optional<Trajectory>& ground_truth() const override { return ground_truth_; }
  std::vector<DataNote> notes() const override { return notes_; }

  Frame frame(std::size_t index, Sensor sensor) const override {
    check_index(index);
    calibration_for(sensor, calibration_, name_);
    const Image raw = decode(index);
    require_size(path_, raw, raw_.width, raw_.height);
    Frame frame;
    frame.id = FrameId(index);
    frame.stamp_ns = stamps_ns_[index];
    const Image image = undistorted_.remap.bilinear(raw);
    if (image.channels() == 3) frame.colour = image;
    frame.image = to_grey(image);
    return frame;
  }

 private:
  /// Sets times at the given rate, else the container's times if its rate varies, else times at its
  /// rate.
  void read_times(double given_hz) {
    const std::unique_ptr<VideoReader> video = open_video(path_);
    const double container_hz = video->rate_hz();
    const bool has_container_rate = container_hz > 0.01 && container_hz < 1e5;
    const double rate_hz = given_hz > 0         ? given_hz
                           : has_container_rate ? container_hz
                                                : kDefaultRateHz;
    const double announced = video->announced_frames();
    std::vector<std::int64_t> container_ns;
    while (video->grab()) container_ns.push_back(std::llround(video->time_ms() * 1e6));
    const std::size_t count = container_ns.size();
    if (count == 0) throw FileError(path_, "holds no frames");
    continue_times(container_ns);
    const bool increase = std::ranges::adjacent_find(container_ns, std::ranges::greater_equal()) ==
                          container_ns.end();
    stamps_ns_ = synthetic_stamps_ns(count, rate_hz);
    if (has_container_rate)
      note_if_cut_short(announced, container_hz, increase ? seconds(0, container_ns.back()) : 0);
    if (given_hz > 0 || count < 2) return;
    double furthest_s = 0;
    for (std::size_t i = 1; i < count; ++i)
      furthest_s = std::max(furthest_s, std::abs(seconds(stamps_ns_[i] - stamps_ns_[0],
                                                         container_ns[i] - container_ns[0])));
    if (furthest_s < 0.5 / rate_hz) return;
    if (increase) {
      stamps_ns_ = std::move(container_ns);
      notes_.push_back({"the frame rate varies: the times of the video are used"});
    } else {
      notes_.push_back(
          {fmt::format("the times of the video do not increase: {:g} Hz is assumed; "
                       "fps in its yaml sets the rate",
                       rate_hz)});
    }
  }

  /// The announced number is an estimate from length and rate in some containers: only a clear
  /// difference in both is meaningful.
  void note_if_cut_short(double announced, double rate_hz, double last_s) {
    const auto count = static_cast<double>(stamps_ns_.size());
    const bool fewer = announced > 1.05 * count + 2;
    const bool shorter = announced / rate_hz > 1.05 * last_s + 2 / rate_hz;
    if (fewer && shorter)
      notes_.push_back(
          {fmt::format("{} frames of {:.0f} that the video announces: is it cut short?",
                       stamps_ns_.size(), announced)});
  }

  void check_index(std::size_t index) const {
    if (index < size()) return;
    throw ArgumentError(fmt::format("{}: frame {} of {}", name_, index, size()));
  }

  /// Seeking by frame number is inexact in many containers; decoding in order is not.
  Image decode(std::size_t index) const {
    const std::lock_guard lock(mutex_);
    if (!video_ || index < next_) {
      video_ = open_video(path_);
      next_ = 0;
    }
    Image image;
    bool good = true;
    for (; good && next_ <= index; ++next_) {
      good = next_ < index ? video_->grab() : video_->read(image);
    }
    if (!good || image.empty()) {
      video_.reset();
      throw FileError(path_, fmt::format("frame {} cannot be decoded", index));
    }
    return image.clone();
  }

  std::string path_, name_, format_ = "video";
  Camera raw_;
  UndistortedCamera undistorted_;
  Calibration calibration_;
  std::vector<std::int64_t> stamps_ns_;
  std::optional<Trajectory> ground_truth_;
  std::vector<DataNote> notes_;
  mutable std::mutex mutex_;
  mutable std::unique_ptr<VideoReader> video_;
  mutable std::size_t next_ = 0;
};

}  // namespace

bool is_video_file(const std::string& path) {
  static constexpr std::array<std::string_view, 7> kExtensions = {".avi", ".mkv", ".mov", ".mp4",
                                                                  ".m4v", ".mpg", ".webm"};
  std::string extension = fs::path(path).extension().string();
  std::ranges::transform(extension, extension.begin(),
                         [](char c) { return (c >= 'A' && c <= 'Z') ? c + ('a' - 'A') : c; });
  return fs::is_regular_file(path) &&
         std::ranges::find(kExtensions, extension) != kExtensions.end();
}

std::unique_ptr<Dataset> open_video_file(const std::string& path) {
  const std::string full = path + ".yaml";
  const std::string beside = fs::path(path).replace_extension(".yaml").string();
  if (!fs::exists(full) && !fs::exists(beside)) {
    throw FileError(path, "a video needs its calibration beside it, in " + full);
  }
  const std::string yaml_path = fs::exists(full) ? full : beside;
  CalibrationYaml yaml;
  read_calibration_yaml(yaml_path, yaml);
  if (yaml.baseline_m > 0) throw FileError(yaml_path, "baseline_m: a video has one camera");
  auto dataset = std::make_unique<VideoDataset>(path, yaml_path, yaml);
  dataset->frame(0, Sensor::kMono);  // rejects a size that differs from the calibration
  return dataset;
}

}  // namespace placegraph
