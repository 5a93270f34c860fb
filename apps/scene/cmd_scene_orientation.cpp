#include "apps/scene/cmd_scene_orientation.h"

#include <fmt/format.h>
#include <placegraph/eval/scene/orientation_check.h>
#include <placegraph/frontend/scene/orientation_map.h>
#include <placegraph/frontend/segments/segment_detector.h>
#include <placegraph/frontend/vanishing/scene_directions.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/datasets/open_dataset.h>
#include <placegraph/io/files/atomic_file.h>
#include <placegraph/io/files/image_file.h>
#include <placegraph/io/measurements/plane_truth.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "apps/support/calib_option.h"
#include "apps/support/read_calib.h"
#include "apps/support/output.h"
#include "apps/support/usage.h"

namespace placegraph::apps {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

struct SceneOrientationArguments {
  std::string in, camera, out, drawing;
  int every = 1;
  std::uint64_t seed = 1;
  bool as_json = false, force = false;
  OrientationMapOptions options;
};

struct Seen {
  std::vector<LineSegment> segments;
  std::vector<int> axis;
  SO3 R_cam_manhattan;
  OrientationMap map;
};

Seen see(const Image& image, const Camera& camera, const SceneOrientationArguments& arguments) {
  Seen seen;
  seen.segments = segments_of(detect_segments(image, {}));
  Random random(arguments.seed);
  const SceneDirections scene = find_scene_directions(seen.segments, camera, {}, random);
  if (scene.frames.empty()) {
    seen.map.outcome = scene.vanishing.outcome
                           ? Outcome::failure(Outcome::Code::kNoConsensus, "no rectangular world")
                           : scene.vanishing.outcome;
    return seen;
  }
  seen.axis = scene.frames[0].axis;
  seen.R_cam_manhattan = scene.frames[0].R_cam_manhattan;
  seen.map = compute_orientation_map(seen.segments, seen.axis, camera, seen.R_cam_manhattan,
                                     arguments.options);
  return seen;
}

/// The labels in pale red, green and blue by their axis (the vertical one green), the edges in full
/// colour: nothing of the photograph.
Image draw(const Seen& seen, const Camera& camera) {
  const int vertical = seen.map.vertical_axis;
  cv::Mat3b picture(camera.height, camera.width, cv::Vec3b(255, 255, 255));
  const auto colour = [&](int axis, int full, int rest) {
    const int channel = axis == vertical ? 1 : axis == (vertical + 1) % 3 ? 2 : 0;
    cv::Vec3b c(static_cast<uchar>(rest), static_cast<uchar>(rest), static_cast<uchar>(rest));
    c[channel] = static_cast<uchar>(full);
    return c;
  };
  for (int v = 0; v < picture.rows; ++v)
    for (int u = 0; u < picture.cols; ++u)
      if (const int label = seen.map.labels.at<uchar>(v, u))
        picture(v, u) = colour(label - 1, 255, 190);
  for (std::size_t i = 0; i < seen.segments.size(); ++i) {
    const LineSegment& s = seen.segments[i];
    const cv::Vec3b c = seen.axis[i] < 0 ? cv::Vec3b(170, 170, 170) : colour(seen.axis[i], 200, 0);
    cv::line(picture, cv::Point(cvRound(s.start[0]), cvRound(s.start[1])),
             cv::Point(cvRound(s.end[0]), cvRound(s.end[1])), cv::Scalar(c[0], c[1], c[2]), 1,
             cv::LINE_AA);
  }
  return picture;
}

void write_image(const std::string& path, const Image& image) {
  AtomicFile file(path);
  if (!cv::imwrite(file.temporary_path(), image)) throw FileError(path, "cannot be written");
  file.commit();
}

void run_image(const SceneOrientationArguments& arguments) {
  require(!arguments.camera.empty(), "--calib: an image needs its camera");
  for (const std::string& path : {arguments.out, arguments.drawing})
    if (!path.empty()) require_free(path, arguments.force);
  const Camera camera = read_calib_without_distortion(arguments.camera, "orientation maps need");
  const Image image = read_image(arguments.in).grey;
  require_size(arguments.in, image, camera.width, camera.height);
  const Stopwatch watch;
  const Seen seen = see(image, camera, arguments);
  const double cpu_ms = watch.cpu_ms();
  if (!seen.map.outcome) throw NoAnswer(arguments.in + ": " + seen.map.outcome.reason);
  const Image surfaces = indoor_surfaces(seen.map, camera, seen.R_cam_manhattan);
  if (!arguments.out.empty()) write_image(arguments.out, seen.map.labels);
  if (!arguments.drawing.empty()) write_image(arguments.drawing, draw(seen, camera));
  ordered_json report = {{"in", arguments.in}, {"coverage", seen.map.coverage}};
  for (const IndoorSurface s :
       {IndoorSurface::kFloor, IndoorSurface::kCeiling, IndoorSurface::kWall})
    report[to_string(s)] =
        cv::countNonZero(surfaces == static_cast<int>(s)) / static_cast<double>(surfaces.total());
  const Eigen::Matrix3d R = seen.R_cam_manhattan.matrix();
  report["vertical_axis"] = seen.map.vertical_axis;
  report["R_cam_manhattan"] = ordered_json::array();
  for (int i = 0; i < 3; ++i) report["R_cam_manhattan"].push_back({R(i, 0), R(i, 1), R(i, 2)});
  report["cpu_ms"] = cpu_ms;
  if (arguments.as_json)
    std::puts(report.dump(2).c_str());
  else
    fmt::print("{}: {:.0f} % told: floor {:.0f}, ceiling {:.0f}, walls {:.0f} %; {:.0f} ms CPU\n",
               arguments.in, 100 * seen.map.coverage, 100 * report["floor"].get<double>(),
               100 * report["ceiling"].get<double>(), 100 * report["wall"].get<double>(), cpu_ms);
}

/// Exact surfaces of a rendered sequence, as far as its folder holds them.
class PlaneTruth {
 public:
  PlaneTruth(const std::string& folder, const Dataset& dataset)
      : folder_(folder), dataset_(dataset) {
    const fs::path planes = fs::path(folder) / "planes.txt";
    known_ = fs::exists(planes) && dataset.ground_truth();
    if (!known_) return;
    for (const Eigen::Vector4d& plane : read_planes(planes.string()))
      normals_.emplace_back(plane.head<3>());
  }
  bool known() const { return known_; }
  void check(std::size_t frame, const Seen& seen, OrientationCheck& check) const {
    const auto& T_world_cam = dataset_.ground_truth()->poses.at(frame).T_world_body;
    if (!T_world_cam) return;
    const std::string path =
        (fs::path(folder_) / "planes_0" / fmt::format("{:06d}.png", frame)).string();
    const Image planes = read_image_as_stored(path);
    if (planes.type() != CV_16UC1 || planes.size() != seen.map.labels.size())
      throw FileError(path, "is no 16-bit image of the sequence's size");
    check_orientation(seen.map.labels, seen.R_cam_manhattan.matrix(), planes, normals_,
                      T_world_cam->rotation().matrix().transpose(), check);
  }

 private:
  std::string folder_;
  const Dataset& dataset_;
  bool known_ = false;
  std::vector<Eigen::Vector3d> normals_;
};

void run_sequence_of_images(const SceneOrientationArguments& arguments) {
  const auto dataset = open_dataset(arguments.in);
  for (const std::string& path : {arguments.out, arguments.drawing})
    if (!path.empty()) require_free_folder(path, arguments.force);
  for (const std::string& path : {arguments.out, arguments.drawing})
    if (!path.empty()) make_output_folder(path);
  const Camera camera = arguments.camera.empty() ? dataset->calibration(Sensor::kMono).camera
                                                 : read_calib_without_distortion(
                                                       arguments.camera, "orientation maps need");
  const PlaneTruth truth(arguments.in, *dataset);
  OrientationCheck check;
  int images = 0, told = 0;
  double coverage = 0, cpu_ms = 0;
  for (std::size_t i = 0; i < dataset->size(); i += static_cast<std::size_t>(arguments.every)) {
    const Frame frame = dataset->frame(i, Sensor::kMono);
    const Stopwatch watch;
    Seen seen = see(frame.image, camera, arguments);
    cpu_ms += watch.cpu_ms();
    ++images;
    if (!seen.map.outcome) seen.map.labels = Image(frame.image.size(), CV_8UC1, cv::Scalar(0));
    told += static_cast<bool>(seen.map.outcome);
    coverage += seen.map.coverage;
    const std::string name = fmt::format("{:06d}.png", i);
    if (!arguments.out.empty())
      write_image((fs::path(arguments.out) / name).string(), seen.map.labels);
    if (!arguments.drawing.empty() && seen.map.outcome)
      write_image((fs::path(arguments.drawing) / name).string(), draw(seen, camera));
    if (truth.known()) truth.check(i, seen, check);
  }
  ordered_json report = {{"in", arguments.in},
                         {"images", images},
                         {"told", told},
                         {"coverage", coverage / std::max(1, images)},
                         {"cpu_ms", cpu_ms / std::max(1, images)}};
  if (truth.known())
    report["check"] = {
        {"pixels", check.judged}, {"coverage", check.coverage()}, {"accuracy", check.accuracy()}};
  if (arguments.as_json)
    std::puts(report.dump(2).c_str());
  else
    fmt::print(
        "{}: {} of {} images told, {:.1f} % of their pixels{}; {:.0f} ms CPU an image\n",
        arguments.in, told, images, 100 * coverage / std::max(1, images),
        truth.known() ? fmt::format(", {:.1f} % of those rightly", 100 * check.accuracy()) : "",
        cpu_ms / std::max(1, images));
  if (told == 0) throw NoAnswer(arguments.in + ": no image shows a rectangular world");
}

void run(const SceneOrientationArguments& arguments) {
  arguments.options.check();
  require(arguments.every >= 1, "--every: must be at least 1");
  if (fs::is_directory(arguments.in))
    run_sequence_of_images(arguments);
  else
    run_image(arguments);
}

}  // namespace

void add_scene_orientation_command(CLI::App& scene) {
  auto arguments = std::make_shared<SceneOrientationArguments>();
  SceneOrientationArguments& a = *arguments;
  CLI::App* command = scene.add_subcommand(
      "orientation", "How the surface behind each pixel is turned, from straight edges");
  command->footer(
      "placegraph scene orientation image.png --calib K.txt --out map.png --draw map_drawn.png");
  command->add_option("IMAGE", a.in, "an image, or a sequence: then --out and --draw are folders")
      ->required()
      ->check(CLI::ExistingPath);
  add_calib_option(*command, a.camera, kCalibFile);
  command->add_option("--out", a.out, "8-bit PNG: 0 none, else 1 + axis of the surface's normal");
  command->add_option("--draw", a.drawing, "PNG of the surfaces and edges in their axes' colours");
  command->add_option("--every", a.every, "of a sequence, every n-th image")->capture_default_str();
  command->add_option("--min-confidence", a.options.min_confidence, "of a pixel that is told")
      ->capture_default_str();
  command->add_option("--min-margin", a.options.min_margin, "of the best against the second")
      ->capture_default_str();
  command->add_option("--seed", a.seed, "of the random samples")->capture_default_str();
  command->add_flag("--json", a.as_json, "print JSON");
  command->add_flag("--force", a.force, "replace what is there");
  command->callback([arguments] { run(*arguments); });
}

}  // namespace placegraph::apps
