#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/parallel.h>
#include <placegraph/io/measurements/flow_file.h>
#include <placegraph/io/scene/labelled_mesh_file.h>
#include <placegraph/io/synthetic/writers/sequence_folder.h>
#include <placegraph/io/synthetic/writers/sequence_writer.h>
#include <placegraph/io/trajectories/trajectory_file.h>

#include <cmath>
#include <mutex>

namespace placegraph {

using synthetic::SequenceFolder;

namespace {

constexpr double kOutdoorDepthUnit_m = 1.0 / 256;  // as KITTI: 256 m
constexpr double kIndoorDepthUnit_m = 0.001;

Image encode_depth(const Image& depth_m, double unit_m) {
  Image out(depth_m.size(), CV_16UC1);
  for (int v = 0; v < out.rows; ++v) {
    for (int u = 0; u < out.cols; ++u) {
      const double steps = std::floor(depth_m.at<float>(v, u) / unit_m + 0.5);
      // 65535 means "nothing measured" elsewhere: not used, nor is anything beyond.
      out.at<unsigned short>(v, u) = static_cast<unsigned short>(steps < 65535 ? steps : 0);
    }
  }
  return out;
}

std::string projection(const char* key, const Camera& c, double baseline_m) {
  return fmt::format("{}: {:.9e} 0 {:.9e} {:.9e} 0 {:.9e} {:.9e} 0 0 0 1 0\n", key, c.fx, c.cx,
                     -c.fx * baseline_m, c.fy, c.cy);
}

double depth_unit_m(const SyntheticWorld& world) {
  return world.is_indoor() ? kIndoorDepthUnit_m : kOutdoorDepthUnit_m;
}

std::string world_yaml(const SyntheticWorld& world) {
  const SyntheticOptions& o = world.options();
  const std::string defects = defect_list(o.defects);
  std::string text =
      fmt::format("# A rendered sequence; {}\nworld: {}\ndifficulty: {}\nseed: {}\nframes: {}\n",
                  defects.empty() ? "everything here is exact." : "its files have these defects.",
                  world.name(), to_string(o.difficulty), o.seed, world.size());
  if (!defects.empty()) text += "defects:\n" + defects;
  const std::optional<double> height_m = world.calibration().camera_height_m;
  if (height_m) text += fmt::format("camera_height_m: {}\n", *height_m);
  text += "classes: [";
  const auto names = SyntheticWorld::class_names();
  for (std::size_t i = 0; i < names.size(); ++i) text += (i ? ", " : "") + names[i];
  return text + "]\n";
}

/// The class list for training and evaluation of street labels.
std::string class_list() {
  std::string text;
  for (const SceneClass& c : SyntheticWorld::scene_classes())
    text += fmt::format("{} {} {}\n", c.id, c.name, c.surface ? surface_name(*c.surface) : "-");
  return text;
}

std::string readme(const SyntheticWorld& world, const SyntheticContents& contents) {
  std::string text =
      "Rendered by `placegraph synth sequence`. KITTI odometry layout, poses.txt = T_world_cam0, "
      "exact.\n";
  if (world.calibration().camera_height_m)
    text +=
        "The camera is camera_height_m (world.yaml) above the rendered ground, measured "
        "vertically.\n";
  if (!defect_list(world.options().defects).empty())
    text +=
        "Images, times and calibration, camera_height_m and the depth camera's too, have the "
        "defects that world.yaml lists.\n";
  text += contents.right ? "image_0, image_1: left and right camera" : "image_0: camera";
  text += ", 8-bit grey, rectified, without distortion.\n";
  if (contents.depth)
    text += fmt::format(
        "depth_0: 16-bit, one step = {} m along the optical axis, 0 = none; same camera as "
        "image_0.\n",
        depth_unit_m(world));
  if (contents.labels)
    text +=
        "labels_0: 8-bit, index into `classes` of world.yaml; CLASSES.txt, outdoors: which class "
        "of "
        "a street each is.\n"
        "scene.ply: what stands still, polygons with a class each, in the frame of poses.txt.\n";
  if (contents.planes)
    text +=
        "planes_0: 16-bit, line of planes.txt counted from 0 (0 = none); a line is nx ny nz d,\n"
        "  n . p = d in the frame of poses.txt.\n";
  if (contents.flow)
    text +=
        "flow_0: to the next frame, KITTI's 16-bit form: (R, G) = 64 * (du, dv) + 2^15, B = "
        "valid.\n"
        "  Moving objects are followed; hidden points are valid, points out of the image too.\n";
  return text;
}

void write_frame(const SyntheticWorld& world, const SequenceFolder& folder, std::size_t index,
                 const SyntheticContents& contents) {
  const SyntheticFrame frame = world.render(index, contents);
  const std::string file = fmt::format("{:06d}.png", index);
  folder.write("image_0/" + file, frame.frame.image);
  if (contents.right) folder.write("image_1/" + file, frame.frame.right);
  if (contents.depth)
    folder.write("depth_0/" + file, encode_depth(frame.frame.depth, depth_unit_m(world)));
  if (contents.labels) folder.write("labels_0/" + file, frame.labels);
  if (contents.planes) folder.write("planes_0/" + file, frame.planes);
  if (contents.flow && !frame.flow.empty())
    folder.write("flow_0/" + file, encode_kitti_flow(frame.flow));
}

void write_texts(const SyntheticWorld& world, const SequenceFolder& folder,
                 const SyntheticContents& contents) {
  const Calibration calibration = world.calibration();
  folder.write("calib.txt", projection("P0", calibration.camera, 0) +
                                projection("P1", calibration.camera, calibration.baseline_m));
  if (contents.depth)
    folder.write("calib_depth.txt", projection("P0", calibration.depth->camera, 0) +
                                        fmt::format("unit_m: {}\n", depth_unit_m(world)));
  std::string times;
  for (std::size_t i = 0; i < world.size(); ++i)
    times +=
        fmt::format("{}.{:09d}\n", world.stamp_ns(i) / 1000000000, world.stamp_ns(i) % 1000000000);
  folder.write("times.txt", times);
  write_trajectory((folder.path() / "poses.txt").string(), world.ground_truth(),
                   TrajectoryFormat::kKitti);
  folder.write("world.yaml", world_yaml(world));
  folder.write("README.txt", readme(world, contents));
  if (!world.floor_plan().empty()) folder.write("floorplan.json", world.floor_plan());
  if (contents.labels) folder.write("scene.ply", to_ply(world.static_mesh()));
  if (contents.labels && !world.is_indoor()) folder.write("CLASSES.txt", class_list());
  if (contents.planes) {
    std::string text;
    for (const Eigen::Vector4d& p : world.planes())
      text += fmt::format("{:.9f} {:.9f} {:.9f} {:.9f}\n", p[0], p[1], p[2], p[3]);
    folder.write("planes.txt", text);
  }
}

}  // namespace

void write_sequence(const SyntheticWorld& world, const std::string& path,
                    const SequenceWriterOptions& options,
                    const std::function<void(std::size_t)>& progress) {
  SequenceFolder folder(path, options.force);
  const SyntheticContents& contents = options.contents;
  folder.make("image_0");
  if (contents.right) folder.make("image_1");
  if (contents.depth) folder.make("depth_0");
  if (contents.labels) folder.make("labels_0");
  if (contents.planes) folder.make("planes_0");
  if (contents.flow) folder.make("flow_0");
  write_texts(world, folder, contents);

  std::mutex mutex;
  std::size_t done = 0;
  parallel_for(static_cast<int>(world.size()), options.threads, [&](int index) {
    write_frame(world, folder, static_cast<std::size_t>(index), contents);
    const std::lock_guard<std::mutex> lock(mutex);
    ++done;
    if (progress) progress(done);
  });
  folder.put_in_place({"image_0", "image_1", "depth_0", "labels_0", "planes_0", "flow_0",
                       "calib.txt", "times.txt", "poses.txt", "calib_depth.txt", "planes.txt",
                       "world.yaml", "README.txt", "floorplan.json", "CLASSES.txt", "scene.ply"});
}

}  // namespace placegraph
