#include "apps/views/cmd_track_plane.h"

#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/files/image_file.h>
#include <placegraph/io/files/text_file.h>
#include <placegraph/io/trajectories/trajectory_file.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "apps/support/calib_option.h"
#include "apps/support/read_calib.h"
#include "apps/support/frame_source.h"
#include "apps/support/output.h"
#include "apps/support/progress.h"
#include "apps/support/usage.h"
#include "apps/views/plane_track_files.h"

namespace placegraph::apps {
namespace {

using Eigen::Vector2d;
using nlohmann::ordered_json;

struct TrackPlaneArguments {
  std::string in, corners, image, calibration, normal, out, draw, trajectory;
  bool calibrated = false, json = false, force = false;
  PlaneTrackerOptions options;
};

/// "1,2.5,3": as many numbers as asked for.
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

/// The camera of a file, or the sequence's own; nothing where none was asked for.
std::optional<Camera> camera_of(const TrackPlaneArguments& arguments, const FrameSource& source,
                                const Image& image) {
  if (!arguments.calibrated) return std::nullopt;
  if (arguments.calibration.empty()) {
    const auto camera = source.camera();
    require(camera.has_value(),
            "--calib: " + arguments.in + " has no calibration; name a file with one");
    return camera;
  }
  const Camera camera =
      read_calib_without_distortion(arguments.calibration, "a plane's motion needs");
  if (camera.width != image.cols || camera.height != image.rows)
    throw FileError(arguments.calibration,
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

void print(const TrackPlaneArguments& arguments, const PlaneTracker& tracker,
           const std::vector<PlaneTrack>& tracks, double cpu_ms) {
  const auto tracked = static_cast<std::size_t>(
      std::count_if(tracks.begin(), tracks.end(),
                    [](const PlaneTrack& track) { return static_cast<bool>(track.outcome); }));
  const double per_frame = cpu_ms / static_cast<double>(tracks.size());
  if (arguments.json) {
    ordered_json json;
    json["in"] = arguments.in;
    json["frames"] = tracks.size();
    json["tracked"] = tracked;
    json["lost"] = tracks.size() - tracked;
    json["least_likeness"] = tracker.least_likeness();
    json["least_likeness_found_again"] = tracker.least_likeness_found();
    json["cpu_ms_per_frame"] = per_frame;
    json["tracks"] = ordered_json::array();
    for (std::size_t i = 0; i < tracks.size(); ++i)
      json["tracks"].push_back(track_json(tracks[i], i));
    std::puts(json.dump(2).c_str());
    return;
  }
  fmt::print("{}: {} frames, {} tracked, {} lost\n", arguments.in, tracks.size(), tracked,
             tracks.size() - tracked);
  for (std::size_t i = 0; i < tracks.size(); ++i)
    if (!tracks[i].outcome && (i == 0 || tracks[i - 1].outcome))
      fmt::print("  lost at frame {}: {}\n", i, tracks[i].outcome.reason);
    else if (tracks[i].outcome && i > 0 && !tracks[i - 1].outcome)
      fmt::print("  found again at frame {} by {}\n", i,
                 plane_track_source_names()[static_cast<std::size_t>(tracks[i].source)]);
  fmt::print("  {:.1f} ms CPU a frame\n", per_frame);
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

void draw(const std::string& path, const FrameSource& source,
          const std::vector<PlaneTrack>& tracks) {
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    const auto file = std::filesystem::path(path) / fmt::format("{:06d}.png", i);
    write_file(file.string(), track_picture(source.image(i), tracks[i], i));
  }
}

void run(TrackPlaneArguments& arguments) {
  PlaneTrackerOptions& options = arguments.options;
  options.check();
  require(arguments.trajectory.empty() || arguments.calibrated, "--trajectory: needs --calib");
  require(arguments.normal.empty() || arguments.calibrated, "--normal: needs --calib");
  require(options.model == PlaneModel::kHomography || arguments.calibrated,
          "--model: one with a rigid motion needs --calib");
  require(arguments.trajectory != arguments.out, "--trajectory: the same file as --out");
  const auto normal = normal_of(arguments);
  require_free(arguments.out, arguments.force);
  if (!arguments.trajectory.empty()) require_free(arguments.trajectory, arguments.force);
  if (!arguments.draw.empty()) require_free_folder(arguments.draw, arguments.force);

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
  PlaneTracker tracker(image_ref, corners, options, camera, normal);
  if (!tracker.outcome()) throw NoAnswer("--template: " + tracker.outcome().reason);
  std::vector<PlaneTrack> tracks;
  {
    Progress progress("tracking", static_cast<std::int64_t>(source.size()));
    for (std::size_t i = 0; i < source.size(); ++i) {
      tracks.push_back(tracker.track(source.image(i)));
      progress.update(static_cast<std::int64_t>(i) + 1);
    }
  }
  const double cpu_ms = watch.cpu_ms();
  if (std::none_of(tracks.begin(), tracks.end(),
                   [](const PlaneTrack& track) { return static_cast<bool>(track.outcome); }))
    throw NoAnswer(fmt::format("{}: the template is in none of {} frames: {}", arguments.in,
                               tracks.size(), tracks.front().outcome.reason));
  if (!arguments.draw.empty()) draw(arguments.draw, source, tracks);
  write_file(arguments.out, track_lines(tracks));
  if (!arguments.trajectory.empty()) write_poses(arguments.trajectory, source, tracks);
  print(arguments, tracker, tracks, cpu_ms);
}

/// An option whose value is one of an enum's names.
template <class Enum>
void add_choice(CLI::App& command, const std::string& name, Enum& value,
                const std::vector<std::string>& names, const std::string& doc) {
  command
      .add_option_function<std::string>(
          name,
          [&value, names](const std::string& chosen) {
            const auto at = std::find(names.begin(), names.end(), chosen) - names.begin();
            value = static_cast<Enum>(at);
          },
          doc)
      ->check(CLI::IsMember(names))
      ->default_str(names[static_cast<std::size_t>(value)]);
}

}  // namespace

void add_track_plane_command(CLI::App& app) {
  auto arguments = std::make_shared<TrackPlaneArguments>();
  TrackPlaneArguments& a = *arguments;
  CLI::App* command = app.add_subcommand("track-plane", "Follow a planar region of an image");
  command->footer(
      "placegraph track-plane sequence --template 100,80,300,80,300,220,100,220 --out track.txt");
  command->add_option("DIR", a.in, "a sequence, or a folder of images")
      ->required()
      ->check(CLI::ExistingPath);
  command
      ->add_option("--template", a.corners,
                   "x1,y1,...,x4,y4: corners of the region [px], around it, in the first image")
      ->required();
  command->add_option("--template-image", a.image, "image that the corners are of instead")
      ->check(CLI::ExistingFile);
  command
      ->add_option("-o,--out", a.out,
                   "a line a frame: number, tracked or lost, x1 y1 ... x4 y4 [px], similarity")
      ->required();
  CLI::Option* calibration =
      command
          ->add_option("--calib", a.calibration,
                       "also the motion before the plane, with the sequence's own camera or that "
                       "of a file: a line fx fy cx cy width height [px], or a calibration.yaml")
          ->expected(0, 1);
  add_choice(*command, "--model", a.options.model, plane_model_names(), "how it may move");
  add_choice(*command, "--similarity", a.options.align.gradient.similarity, similarity_names(),
             "what is made great");
  add_choice(*command, "--optimizer", a.options.align.optimizer, align_optimizer_names(),
             "how it is found from frame to frame");
  command->add_option("--normal", a.normal,
                      "nx,ny,nz: the plane's, in the camera of the template, where it is known");
  command->add_option("--trajectory", a.trajectory,
                      "poses of the camera in units of the plane's distance; .tum or KITTI's form");
  command->add_option("--draw", a.draw, "folder for the frames with the region's outline");
  command->add_option("--seed", a.options.align.swarm.seed, "of the searches")
      ->capture_default_str();
  command->add_flag("--json", a.json, "print JSON");
  command->add_flag("--force", a.force, "overwrite outputs");
  command->callback([arguments, calibration] {
    arguments->calibrated = calibration->count() > 0;
    run(*arguments);
  });
}

}  // namespace placegraph::apps
