#include "apps/image/scene/scene_orientation.h"

#include <fmt/format.h>
#include <placegraph/eval/drawing/picture_bytes.h>
#include <placegraph/eval/drawing/picture_legend.h>
#include <placegraph/frontend/segments/segment_detector.h>
#include <placegraph/frontend/vanishing/scene_directions.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/text/json_text.h>
#include <placegraph/io/datasets/open_dataset.h>
#include <placegraph/io/files/image_file.h>
#include <placegraph/io/files/output_file.h>
#include "apps/image/scene/plane_truth.h"

#include <filesystem>
#include <nlohmann/json.hpp>
#include <opencv2/imgproc.hpp>

#include "apps/support/output.h"
#include "apps/support/read_calib.h"
#include "apps/support/usage.h"

namespace placegraph::apps {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

struct SeenOrientation {
  std::vector<LineSegment> segments;
  std::vector<int> axis;
  SO3 R_cam_manhattan;
  OrientationMap map;
};

SeenOrientation see(const Image& image, const Camera& camera,
                    const SceneOrientationArguments& arguments) {
  SeenOrientation seen;
  seen.segments = segments_of(detect_segments(image, {}));
  Random random(arguments.seed);
  const SceneDirections scene = find_scene_directions(seen.segments, camera, {}, random);
  if (scene.frames.empty()) {
    seen.map.outcome = scene.vanishing.outcome
                           ? Outcome::failure(Outcome::Code::kNoConsensus, "no Manhattan frame")
                           : scene.vanishing.outcome;
    return seen;
  }
  seen.axis = scene.frames[0].axis;
  seen.R_cam_manhattan = scene.frames[0].R_cam_manhattan;
  seen.map = compute_orientation_map(seen.segments, seen.axis, camera, seen.R_cam_manhattan,
                                     arguments.options);
  return seen;
}

/// The colour of an axis of the Manhattan frame: the vertical one green, the others red and blue.
cv::Vec3b axis_colour(int axis, int vertical, int full, int rest) {
  const int channel = axis == vertical ? 1 : axis == (vertical + 1) % 3 ? 2 : 0;
  cv::Vec3b c(static_cast<uchar>(rest), static_cast<uchar>(rest), static_cast<uchar>(rest));
  c[channel] = static_cast<uchar>(full);
  return c;
}

constexpr int kPale = 190;

/// The labels in pale colours of their axes, white where there is none.
Image coloured(const OrientationMap& map) {
  cv::Mat3b drawing(map.labels.size(), cv::Vec3b(255, 255, 255));
  for (int v = 0; v < drawing.rows; ++v)
    for (int u = 0; u < drawing.cols; ++u)
      if (const int label = map.labels.at<uchar>(v, u))
        drawing(v, u) = axis_colour(label - 1, map.vertical_axis, 255, kPale);
  return drawing;
}

std::vector<LegendEntry> surface_legend(int vertical) {
  const auto entry = [&](int axis, const char* text) {
    const cv::Vec3b c = axis_colour(axis, vertical, 255, kPale);
    return area_entry(text, {c[2], c[1], c[0]});
  };
  return {entry(vertical, "floor, ceiling"), entry((vertical + 1) % 3, "walls of one direction"),
          entry((vertical + 2) % 3, "walls of the other direction")};
}

/// The surfaces and, in full colour, the edges that show them, without the photograph.
Image draw(const SeenOrientation& seen, const std::string& wanted) {
  const int vertical = seen.map.vertical_axis;
  Image drawing = coloured(seen.map);
  for (std::size_t i = 0; i < seen.segments.size(); ++i) {
    const LineSegment& s = seen.segments[i];
    const cv::Vec3b c =
        seen.axis[i] < 0 ? cv::Vec3b(170, 170, 170) : axis_colour(seen.axis[i], vertical, 200, 0);
    cv::line(drawing, cv::Point(cvRound(s.start[0]), cvRound(s.start[1])),
             cv::Point(cvRound(s.end[0]), cvRound(s.end[1])), cv::Scalar(c[0], c[1], c[2]), 1,
             cv::LINE_AA);
  }
  std::vector<LegendEntry> legend = surface_legend(vertical);
  legend.push_back({"edge, in the colour of its axis", {{0, 200, 0}, 1.5}});
  legend.push_back({"edge along no axis", {{170, 170, 170}, 1.5}});
  return with_legend(drawing, legend, wanted);
}

void write_map(const std::string& path, const OrientationMap& map, bool ids) {
  write_image(
      path, ids ? map.labels : with_legend(coloured(map), surface_legend(map.vertical_axis), path));
}

/// Throws FileError if the module that draws legends is missing.
void require_legends(const SceneOrientationArguments& arguments) {
  if (!arguments.drawing.empty()) require_drawings(arguments.drawing);
  if (!arguments.out.empty() && !arguments.ids) require_drawings(arguments.out);
}

SceneOrientationResult orientation_of_image(const SceneOrientationArguments& arguments) {
  require(!arguments.camera.empty(), "--calib: an image needs its camera");
  for (const std::string& path : {arguments.out, arguments.drawing})
    if (!path.empty()) require_free(path, arguments.force);
  const Camera camera = read_calib_without_distortion(arguments.camera, "orientation maps need");
  const Image image = read_image(arguments.in).grey;
  require_size(arguments.in, image, camera.width, camera.height);
  const Stopwatch watch;
  const SeenOrientation seen = see(image, camera, arguments);
  const double cpu_ms = watch.cpu_ms();
  if (!seen.map.outcome) throw NoResult(arguments.in + ": " + seen.map.outcome.reason);
  const Image surfaces = indoor_surfaces(seen.map, camera, seen.R_cam_manhattan);
  if (!arguments.out.empty()) write_map(arguments.out, seen.map, arguments.ids);
  if (!arguments.drawing.empty()) write_image(arguments.drawing, draw(seen, arguments.drawing));
  const auto share = [&](PlanSurface surface) {
    return cv::countNonZero(surfaces == static_cast<int>(surface)) /
           static_cast<double>(surfaces.total());
  };
  const ImageOrientation found{
      seen.map.coverage,         share(PlanSurface::kFloor), share(PlanSurface::kCeiling),
      share(PlanSurface::kWall), seen.map.vertical_axis,     seen.R_cam_manhattan.matrix()};
  return {arguments.in, found, cpu_ms, {}};
}

/// True surfaces of a rendered sequence, if its folder has them.
class RenderedSurfaces {
 public:
  RenderedSurfaces(const std::string& folder, const Dataset& dataset)
      : folder_(folder), dataset_(dataset) {
    const fs::path planes = fs::path(folder) / "planes.txt";
    known_ = fs::exists(planes) && dataset.ground_truth();
    if (!known_) return;
    for (const Eigen::Vector4d& plane : read_planes(planes.string()))
      normals_.emplace_back(plane.head<3>());
  }
  bool known() const { return known_; }
  void check(std::size_t frame, const SeenOrientation& seen, OrientationCheck& check) const {
    const auto& T_world_cam = dataset_.ground_truth()->poses.at(frame).T_world_body;
    if (!T_world_cam) return;
    const std::string path =
        (fs::path(folder_) / "planes_0" / fmt::format("{:06d}.png", frame)).string();
    const Image planes = read_image_as_stored(path);
    if (planes.type() != CV_16UC1 || planes.size() != seen.map.labels.size())
      throw FileError(path, "is not a 16-bit image of the sequence's size");
    check_orientation(seen.map.labels, seen.R_cam_manhattan.matrix(), planes, normals_,
                      T_world_cam->rotation().matrix().transpose(), check);
  }

 private:
  std::string folder_;
  const Dataset& dataset_;
  bool known_ = false;
  std::vector<Eigen::Vector3d> normals_;
};

SceneOrientationResult orientation_of_sequence(const SceneOrientationArguments& arguments) {
  const auto dataset = open_dataset(arguments.in);
  for (const std::string& path : {arguments.out, arguments.drawing})
    if (!path.empty()) require_free_folder(path, arguments.force);
  for (const std::string& path : {arguments.out, arguments.drawing})
    if (!path.empty()) make_output_folder(path);
  const Camera camera = arguments.camera.empty() ? dataset->calibration(Sensor::kMono).camera
                                                 : read_calib_without_distortion(
                                                       arguments.camera, "orientation maps need");
  const RenderedSurfaces truth(arguments.in, *dataset);
  OrientationCheck check;
  SequenceOrientation found;
  double cpu_ms = 0;
  for (std::size_t i = 0; i < dataset->size(); i += static_cast<std::size_t>(arguments.every)) {
    const Frame frame = dataset->frame(i, Sensor::kMono);
    const Stopwatch watch;
    SeenOrientation seen = see(frame.image, camera, arguments);
    cpu_ms += watch.cpu_ms();
    ++found.images;
    if (!seen.map.outcome) seen.map.labels = Image(frame.image.size(), CV_8UC1, cv::Scalar(0));
    found.labelled += static_cast<bool>(seen.map.outcome);
    found.coverage += seen.map.coverage;
    const std::string name = fmt::format("{:06d}.png", i);
    if (!arguments.out.empty())
      write_map((fs::path(arguments.out) / name).string(), seen.map, arguments.ids);
    if (!arguments.drawing.empty() && seen.map.outcome)
      write_image((fs::path(arguments.drawing) / name).string(), draw(seen, arguments.drawing));
    if (truth.known()) truth.check(i, seen, check);
  }
  found.coverage /= std::max(1, found.images);
  if (truth.known()) found.check = check;
  SceneOrientationResult result{arguments.in, found, cpu_ms / std::max(1, found.images), {}};
  if (found.labelled == 0) result.no_result = arguments.in + ": no image shows a Manhattan frame";
  return result;
}

ordered_json described(const ImageOrientation& found) {
  ordered_json report = {{"coverage", found.coverage},
                         {to_string(PlanSurface::kFloor), found.floor},
                         {to_string(PlanSurface::kCeiling), found.ceiling},
                         {to_string(PlanSurface::kWall), found.wall},
                         {"vertical_axis", found.vertical_axis},
                         {"R_cam_manhattan", ordered_json::array()}};
  const Eigen::Matrix3d& R = found.R_cam_manhattan;
  for (int i = 0; i < 3; ++i) report["R_cam_manhattan"].push_back({R(i, 0), R(i, 1), R(i, 2)});
  return report;
}

ordered_json described(const SequenceOrientation& found) {
  return {{"images", found.images}, {"told", found.labelled}, {"coverage", found.coverage}};
}

std::string text_of(const ImageOrientation& found) {
  return fmt::format("{:.0f} % labelled: floor {:.0f}, ceiling {:.0f}, walls {:.0f} %",
                     100 * found.coverage, 100 * found.floor, 100 * found.ceiling,
                     100 * found.wall);
}

std::string text_of(const SequenceOrientation& found) {
  return fmt::format(
      "{} of {} images labelled, {:.1f} % of their pixels{}", found.labelled, found.images,
      100 * found.coverage,
      found.check ? fmt::format(", {:.1f} % of those correctly", 100 * found.check->accuracy())
                  : "");
}

}  // namespace

SceneOrientationResult scene_orientation(const SceneOrientationArguments& arguments) {
  arguments.options.check();
  require(arguments.every >= 1, "--every: must be at least 1");
  require_legends(arguments);
  return fs::is_directory(arguments.in) ? orientation_of_sequence(arguments)
                                        : orientation_of_image(arguments);
}

std::string to_json(const SceneOrientationResult& result) {
  ordered_json report = {{"in", result.in}};
  report.update(std::visit([](const auto& found) { return described(found); }, result.found));
  report["cpu_ms"] = result.cpu_ms;
  const auto* sequence = std::get_if<SequenceOrientation>(&result.found);
  if (sequence && sequence->check)
    report["check"] = {{"pixels", sequence->check->judged},
                       {"coverage", sequence->check->coverage()},
                       {"accuracy", sequence->check->accuracy()}};
  return json_text(report, 2);
}

std::string to_text(const SceneOrientationResult& result) {
  const bool sequence = std::holds_alternative<SequenceOrientation>(result.found);
  return fmt::format("{}: {}; {:.0f} ms CPU{}\n", result.in,
                     std::visit([](const auto& found) { return text_of(found); }, result.found),
                     result.cpu_ms, sequence ? " an image" : "");
}

}  // namespace placegraph::apps
