#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/exports/colmap_cameras.h>
#include <placegraph/io/exports/colmap_model.h>
#include <placegraph/io/files/little_endian.h>

#include <algorithm>
#include <iterator>
#include <set>

namespace placegraph {
namespace {

/// An entry of a track: an image and the position of the observation in it.
struct ColmapTrackEntry {
  std::uint32_t image = 0, observation = 0;
};

void check_model(const ColmapModel& model, NumberForm form) {
  model.camera.check();
  require(
      model.camera.distortion != Distortion::kRadialTangential || model.camera.coefficients[4] == 0,
      "COLMAP: the camera has a distortion that OPENCV has not, k3");
  std::set<std::uint64_t> ids = {model.camera_id};
  for (const ColmapModel::RawCamera& camera : model.unused_cameras)
    require(ids.insert(camera.id).second,
            fmt::format("COLMAP: the camera id {} is not unique", camera.id));
  ids.clear();
  for (const ColmapModel::Image& image : model.images) {
    require(image.id > 0 && ids.insert(image.id).second,
            fmt::format("COLMAP: the image id {} is not positive or not unique", image.id));
    require(!image.name.empty(), fmt::format("COLMAP: image {} has no name", image.id));
    require(form == NumberForm::kBinary || image.name.find_first_of(" \t\r\n") == std::string::npos,
            "COLMAP: a text has no names with blanks, the binary form has: " + image.name);
    for (const ColmapModel::Observation& observation : image.observations)
      require(observation.point >= 0 &&
                  static_cast<std::size_t>(observation.point) < model.points.size(),
              fmt::format("COLMAP: image {} has an observation of a missing point", image.id));
  }
  ids.clear();
  for (const ColmapModel::Point& point : model.points)
    require(point.id > 0 && ids.insert(point.id).second,
            fmt::format("COLMAP: the point id {} is not positive or not unique", point.id));
}

/// The track of every point, in the order of the images.
std::vector<std::vector<ColmapTrackEntry>> colmap_tracks(const ColmapModel& model) {
  std::vector<std::vector<ColmapTrackEntry>> tracks(model.points.size());
  for (const ColmapModel::Image& image : model.images)
    for (std::size_t i = 0; i < image.observations.size(); ++i)
      tracks[static_cast<std::size_t>(image.observations[i].point)].push_back(
          {image.id, static_cast<std::uint32_t>(i)});
  return tracks;
}

/// w x y z of the rotation of T_cam_world, w not negative, and its translation.
std::array<double, 7> colmap_pose(const SE3& T_world_cam) {
  const SE3 T_cam_world = T_world_cam.inverse();
  Eigen::Quaterniond q = T_cam_world.rotation().quaternion();
  if (q.w() < 0) q.coeffs() *= -1;
  const Eigen::Vector3d& t = T_cam_world.translation();
  std::array<double, 7> pose = {q.w(), q.x(), q.y(), q.z(), t[0], t[1], t[2]};
  for (double& value : pose) value += 0.0;  // no negative zero
  return pose;
}

/// The camera of the images as the files have it.
ColmapModel::RawCamera raw_camera(const Camera& camera, std::uint32_t id) {
  ColmapModel::RawCamera raw{
      id,
      "PINHOLE",
      static_cast<std::uint64_t>(camera.width),
      static_cast<std::uint64_t>(camera.height),
      {camera.fx, camera.fy, camera.cx + kColmapCorner_px, camera.cy + kColmapCorner_px}};
  if (camera.distortion == Distortion::kNone) return raw;
  raw.model = camera.distortion == Distortion::kEquidistant ? "OPENCV_FISHEYE" : "OPENCV";
  for (std::size_t i = 0; i < 4; ++i) raw.parameters.push_back(camera.coefficients[i]);
  return raw;
}

/// All cameras, by their ids.
std::vector<ColmapModel::RawCamera> raw_cameras(const ColmapModel& model) {
  std::vector<ColmapModel::RawCamera> cameras = model.unused_cameras;
  cameras.push_back(raw_camera(model.camera, model.camera_id));
  std::ranges::sort(cameras, {}, &ColmapModel::RawCamera::id);
  return cameras;
}

std::string binary_cameras(const ColmapModel& model) {
  const std::vector<ColmapModel::RawCamera> cameras = raw_cameras(model);
  std::string bytes;
  append_number(bytes, static_cast<std::uint64_t>(cameras.size()));
  for (const ColmapModel::RawCamera& camera : cameras) {
    const ColmapLens* lens = find_colmap_lens(camera.model);
    require(lens != nullptr && lens->parameters == camera.parameters.size(),
            fmt::format("COLMAP: camera {} has no model of the binary form: {} of {} parameters",
                        camera.id, camera.model, camera.parameters.size()));
    append_number(bytes, camera.id);
    append_number(bytes, std::int32_t{lens->id});
    append_number(bytes, camera.width);
    append_number(bytes, camera.height);
    for (const double value : camera.parameters) append_number(bytes, value);
  }
  return bytes;
}

std::string text_cameras(const ColmapModel& model) {
  std::string text = "# CAMERA_ID, MODEL, WIDTH, HEIGHT, PARAMS[]\n";
  for (const ColmapModel::RawCamera& camera : raw_cameras(model))
    text += fmt::format("{} {} {} {} {}\n", camera.id, camera.model, camera.width, camera.height,
                        fmt::join(camera.parameters, " "));
  return text;
}

ColmapFiles binary_colmap(const ColmapModel& model) {
  ColmapFiles files;
  files.cameras = binary_cameras(model);
  append_number(files.images, static_cast<std::uint64_t>(model.images.size()));
  for (const ColmapModel::Image& image : model.images) {
    append_number(files.images, image.id);
    for (const double value : colmap_pose(image.T_world_cam)) append_number(files.images, value);
    append_number(files.images, model.camera_id);
    files.images.append(image.name.c_str(), image.name.size() + 1);
    append_number(files.images, static_cast<std::uint64_t>(image.observations.size()));
    for (const ColmapModel::Observation& observation : image.observations) {
      for (int i = 0; i < 2; ++i) append_number(files.images, observation.px[i] + kColmapCorner_px);
      append_number(files.images, model.points[static_cast<std::size_t>(observation.point)].id);
    }
  }

  const std::vector<std::vector<ColmapTrackEntry>> tracks = colmap_tracks(model);
  append_number(files.points, static_cast<std::uint64_t>(model.points.size()));
  for (std::size_t i = 0; i < model.points.size(); ++i) {
    const ColmapModel::Point& point = model.points[i];
    append_number(files.points, point.id);
    for (int k = 0; k < 3; ++k) append_number(files.points, double{point.p_world[k]});
    for (const std::uint8_t value : point.rgb) append_number(files.points, value);
    append_number(files.points, point.error_px);
    append_number(files.points, static_cast<std::uint64_t>(tracks[i].size()));
    for (const ColmapTrackEntry& entry : tracks[i]) {
      append_number(files.points, entry.image);
      append_number(files.points, entry.observation);
    }
  }
  return files;
}

ColmapFiles text_colmap(const ColmapModel& model) {
  ColmapFiles files;
  files.cameras = text_cameras(model);
  files.images =
      "# IMAGE_ID, QW, QX, QY, QZ, TX, TY, TZ, CAMERA_ID, NAME\n"
      "# POINTS2D[] as (X, Y, POINT3D_ID)\n";
  const auto images = std::back_inserter(files.images);
  for (const ColmapModel::Image& image : model.images) {
    fmt::format_to(images, "{} {} {} {}\n", image.id,
                   fmt::join(colmap_pose(image.T_world_cam), " "), model.camera_id, image.name);
    const char* separator = "";
    for (const ColmapModel::Observation& observation : image.observations) {
      fmt::format_to(images, "{}{} {} {}", separator, observation.px[0] + kColmapCorner_px,
                     observation.px[1] + kColmapCorner_px,
                     model.points[static_cast<std::size_t>(observation.point)].id);
      separator = " ";
    }
    files.images += '\n';
  }

  const std::vector<std::vector<ColmapTrackEntry>> tracks = colmap_tracks(model);
  files.points = "# POINT3D_ID, X, Y, Z, R, G, B, ERROR, TRACK[] as (IMAGE_ID, POINT2D_IDX)\n";
  const auto points = std::back_inserter(files.points);
  for (std::size_t i = 0; i < model.points.size(); ++i) {
    const ColmapModel::Point& point = model.points[i];
    fmt::format_to(points, "{} {} {} {} {} {} {} {}", point.id, point.p_world[0], point.p_world[1],
                   point.p_world[2], point.rgb[0], point.rgb[1], point.rgb[2], point.error_px);
    for (const ColmapTrackEntry& entry : tracks[i])
      fmt::format_to(points, " {} {}", entry.image, entry.observation);
    files.points += '\n';
  }
  return files;
}

}  // namespace

std::vector<std::uint32_t> unused_camera_ids(const ColmapModel& model) {
  std::vector<std::uint32_t> ids;
  for (const ColmapModel::RawCamera& camera : model.unused_cameras) ids.push_back(camera.id);
  return ids;
}

ColmapFiles to_colmap(const ColmapModel& model, NumberForm form) {
  check_model(model, form);
  return form == NumberForm::kBinary ? binary_colmap(model) : text_colmap(model);
}

}  // namespace placegraph
