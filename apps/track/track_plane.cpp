#include "apps/track/track_plane.h"

#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/text/json_text.h>
#include <placegraph/io/files/image_file.h>
#include <placegraph/io/files/picture_file.h>
#include <placegraph/io/files/text_file.h>
#include <placegraph/io/trajectories/trajectory_file.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "apps/support/frame_source.h"
#include "apps/support/output.h"
#include "apps/support/progress.h"
#include "apps/support/read_calib.h"
#include "apps/support/usage.h"
#include "apps/track/plane_track_files.h"

namespace placegraph::apps {
namespace {

using Eigen::Vector2d;
using nlohmann::ordered_json;

/// Parses numbers separated by commas, such as "1,2.5,3"; their count is given.
std::vector<double> numbers_of(const std::string& option, const std::string& text,
                               std::size_t count) {
  std::vector<std::string_view> fields;
  split_comma(text, fields);
  std::vector<double> values;
  for (const std::string_view field : fields)
    if (const auto value = parse_double(field)) values.push_back(*value);
  require(values.size() == count && fields.size() == count,
          fmt::format("{}: {} is not {} numbers with commas between them", option, in_quotes(text),
                      count));
  return values;
}

std::vector<Vector2d> corners_of(const std::string& text, const Image& image) {
  const std::vector<double> values = numbers_of("--template", text, 8);
  std::vector<Vector2d> corners;
  for (std::size_t i = 0; i < 8; i += 2) {
    corners.emplace_back(values[i], values[i + 1]);
    const Vector2d& px = corners.back();
    require(px.minCoeff() >= 0 && px.x() <= image.cols - 1 && px.y() <= image.rows - 1,
            fmt::format("--template: ({:g}, {:g}) is outside the image of {}x{}", px.x(), px.y(),
                        image.cols, image.rows));
  }
  return corners;
}

/// The camera of a file, or the sequence's own; nothing if none was requested.
std::optional<Camera> camera_of(const TrackPlaneArguments& arguments, const FrameSource& source,
                                const Image& image) {
  if (!arguments.calib) return std::nullopt;
  if (arguments.calib->empty()) {
    const auto camera = source.camera();
    require(camera.has_value(),
            "--calib: " + arguments.in + " has no calibration; name a file with one");
    return camera;
  }
  const Camera camera = read_calib_without_distortion(*arguments.calib, "a plane's motion needs");
  if (camera.width != image.cols || camera.height != image.rows)
    throw FileError(*arguments.calib,
                    fmt::format("is for images of {}x{}, these are {}x{}", camera.width,
                                camera.height, image.cols, image.rows));
  return camera;
}

std::optional<Eigen::Vector3d> normal_of(const TrackPlaneArguments& arguments) {
  if (arguments.normal.empty()) return std::nullopt;
  const std::vector<double> values = numbers_of("--normal", arguments.normal, 3);
  const Eigen::Vector3d normal(values[0], values[1], values[2]);
  require(normal.norm() > 1e-9, "--normal: a direction needs a length");
  return normal.normalized();
}

void write_poses(const std::string& path, const FrameSource& source,
                 const std::vector<PlaneTrack>& tracks) {
  Trajectory trajectory;
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    const auto stamp_ns = source.stamp_ns(i);
    trajectory.has_times = trajectory.has_times && stamp_ns;
    StampedPose pose{stamp_ns.value_or(static_cast<std::int64_t>(i)), {}};
    if (const auto T_ref_cur = pose_of(tracks[i])) pose.T_world_body = T_ref_cur->isometry();
    trajectory.poses.push_back(pose);
  }
  write_trajectory(path, trajectory,
                   path.ends_with(".tum") ? TrajectoryFormat::kTum : TrajectoryFormat::kKitti);
}

void write_drawings(const std::string& path, const FrameSource& source,
                    const std::vector<PlaneTrack>& tracks) {
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    const auto file = std::filesystem::path(path) / fmt::format("{:06d}.png", i);
    write_png(file.string(), track_drawing(source.image(i), tracks[i], i));
  }
}

void check(const TrackPlaneArguments& arguments) {
  const bool calibrated = arguments.calib.has_value();
  arguments.options.check();
  require(arguments.trajectory.empty() || calibrated, "--trajectory: needs --calib");
  require(arguments.normal.empty() || calibrated, "--normal: needs --calib");
  require(arguments.options.model == PlaneModel::kHomography || calibrated,
          "--motion-model: one with a rigid motion needs --calib");
}

void require_free_outputs(const TrackPlaneArguments& arguments) {
  require_free(arguments.out, arguments.force);
  if (!arguments.trajectory.empty()) require_free(arguments.trajectory, arguments.force);
  if (!arguments.draw.empty()) require_free_folder(arguments.draw, arguments.force);
}

std::vector<PlaneTrack> track_all(PlaneTracker& tracker, const FrameSource& source) {
  std::vector<PlaneTrack> tracks;
  Progress progress("tracking", static_cast<std::int64_t>(source.size()));
  for (std::size_t i = 0; i < source.size(); ++i) {
    tracks.push_back(tracker.track(source.image(i)));
    progress.update(static_cast<std::int64_t>(i) + 1);
  }
  return tracks;
}

}  // namespace

std::size_t TrackPlaneResult::tracked() const {
  return static_cast<std::size_t>(
      std::count_if(tracks.begin(), tracks.end(),
                    [](const PlaneTrack& track) { return static_cast<bool>(track.outcome); }));
}

TrackPlaneResult track_plane(const TrackPlaneArguments& arguments) {
  check(arguments);
  const auto normal = normal_of(arguments);
  require_free_outputs(arguments);
  std::optional<OutputFolder> folder;
  if (!arguments.draw.empty()) folder.emplace(arguments.draw);
  const FrameSource source(arguments.in);
  require(
      arguments.trajectory.empty() || !arguments.trajectory.ends_with(".tum") || source.stamp_ns(0),
      "--trajectory: a folder of images has no times, which .tum needs");
  const Image first = source.image(0);
  const Image image_ref = arguments.image.empty() ? first : read_image(arguments.image).grey;
  const auto corners = corners_of(arguments.corners, image_ref);
  const auto camera = camera_of(arguments, source, first);
  const Stopwatch watch;
  PlaneTracker tracker(image_ref, corners, arguments.options, camera, normal);
  if (!tracker.outcome()) throw NoResult("--template: " + tracker.outcome().reason);
  TrackPlaneResult result;
  result.in = arguments.in;
  result.tracks = track_all(tracker, source);
  result.cpu_ms_per_frame = watch.cpu_ms() / static_cast<double>(result.tracks.size());
  result.least_similarity = tracker.least_similarity();
  result.least_similarity_found = tracker.least_similarity_found();
  if (result.tracked() == 0)
    throw NoResult(fmt::format("{}: the template was found in none of {} frames: {}", arguments.in,
                               result.tracks.size(), result.tracks.front().outcome.reason));
  if (!arguments.draw.empty()) write_drawings(arguments.draw, source, result.tracks);
  write_file(arguments.out, track_lines(result.tracks));
  if (!arguments.trajectory.empty()) write_poses(arguments.trajectory, source, result.tracks);
  return result;
}

std::string to_text(const TrackPlaneResult& result) {
  const std::vector<PlaneTrack>& tracks = result.tracks;
  const std::size_t tracked = result.tracked();
  std::string text = fmt::format("{}: {} frames, {} tracked, {} lost\n", result.in, tracks.size(),
                                 tracked, tracks.size() - tracked);
  for (std::size_t i = 0; i < tracks.size(); ++i)
    if (!tracks[i].outcome && (i == 0 || tracks[i - 1].outcome))
      text += fmt::format("  lost at frame {}: {}\n", i, tracks[i].outcome.reason);
    else if (tracks[i].outcome && i > 0 && !tracks[i - 1].outcome)
      text += fmt::format("  found again at frame {} by {}\n", i,
                          plane_track_source_names()[static_cast<std::size_t>(tracks[i].source)]);
  return text + fmt::format("  {:.1f} ms CPU a frame\n", result.cpu_ms_per_frame);
}

std::string to_json(const TrackPlaneResult& result) {
  ordered_json json;
  json["in"] = result.in;
  json["frames"] = result.tracks.size();
  json["tracked"] = result.tracked();
  json["lost"] = result.tracks.size() - result.tracked();
  json["least_likeness"] = result.least_similarity;
  json["least_likeness_found_again"] = result.least_similarity_found;
  json["cpu_ms_per_frame"] = result.cpu_ms_per_frame;
  json["tracks"] = ordered_json::array();
  for (std::size_t i = 0; i < result.tracks.size(); ++i)
    json["tracks"].push_back(track_json(result.tracks[i], i));
  return json_text(json, 2);
}

}  // namespace placegraph::apps
