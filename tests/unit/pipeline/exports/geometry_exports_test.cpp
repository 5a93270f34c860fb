#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/map/map_database.h>
#include <placegraph/io/measurements/point_cloud_file.h>
#include <placegraph/pipeline/exports/colmap_import.h>
#include <placegraph/pipeline/exports/map_export.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>

#include "tests/support/message_of.h"
#include "tests/support/pictures.h"
#include "tests/support/scenes/observed_map.h"
#include "tests/support/temporary_folder.h"

namespace placegraph {
namespace geometry_exports_test {

namespace fs = std::filesystem;
using nlohmann::json;
using test::message_of;
using testing::HasSubstr;

constexpr int kViews = 5, kPoints = 80;

/// A saved map of five keyframes that observe 80 points exactly, and its sequence of images.
class GeometryExports : public testing::Test {
 protected:
  GeometryExports() {
    scene = test::make_scene(test::pinhole(64, 48, 50), test::sideways(kViews), kPoints, random);
    fs::create_directories(folder / "seq/image_0");
    for (int i = 0; i < kViews; ++i)
      test::write_picture(folder / "seq/image_0/00000" + std::to_string(i) + ".png",
                          cv::Mat(48, 64, CV_8UC1, cv::Scalar(50 + 20 * i)));
    const Camera& camera = scene.camera;
    folder.write("seq/calib.txt",
                 "P0: " + std::to_string(camera.fx) + " 0 " + std::to_string(camera.cx) + " 0 0 " +
                     std::to_string(camera.fy) + " " + std::to_string(camera.cy) + " 0 0 0 1 0\n");
    stored.origin.sequence = folder / "seq";
    stored.origin.calibration.emplace().camera = camera;
    stored.map = test::observed_map(scene);
    save();
    arguments.map = folder.path();
    arguments.paths.resize(map_export_forms().size());
  }
  void save() { write_map(folder / "map.db", stored); }
  /// The path of the form of this flag.
  std::string& path(const std::string& flag) {
    const std::vector<MapExportForm> forms = map_export_forms();
    for (std::size_t i = 0; i < forms.size(); ++i)
      if (forms[i].flag == flag) return arguments.paths[i];
    throw std::runtime_error("no form " + flag);
  }
  Random random{3};
  test::PointScene scene;
  test::TemporaryFolder folder;
  StoredMap stored;
  MapExportArguments arguments;
};

TEST_F(GeometryExports, PlyHasTheLandmarks) {
  path("--ply") = folder / "l.ply";
  map_export(arguments);
  const PointCloud cloud = read_point_cloud(folder / "l.ply");
  ASSERT_EQ(cloud.points.size(), std::size_t{kPoints});
  for (std::size_t i = 0; i < kPoints; ++i)
    EXPECT_LT((cloud.points[i] - scene.points_ref[i]).norm(), 1e-5) << i;
  arguments.ascii = true;
  arguments.force = true;
  map_export(arguments);
  const std::string text = test::read_file(folder / "l.ply");
  EXPECT_THAT(text, HasSubstr("ply\nformat ascii 1.0\n"));
  EXPECT_THAT(text, HasSubstr("comment lengths in metres\n"));
  EXPECT_THAT(text, HasSubstr(" 79 7 255 0.02\n"));
}

TEST_F(GeometryExports, ColmapHasImagesAndTracks) {
  path("--colmap") = folder / "model";
  arguments.ascii = true;
  const MapExportResult result = map_export(arguments);
  ASSERT_TRUE(result.colmap);
  EXPECT_EQ(result.colmap->keyframes, std::size_t{kViews});
  EXPECT_EQ(result.colmap->points, std::size_t{kPoints});
  EXPECT_EQ(result.colmap->kept, std::size_t{kViews * kPoints});
  EXPECT_LT(result.colmap->error_px, 1e-3);
  EXPECT_EQ(result.colmap->views, kViews);
  EXPECT_THAT(to_text(result), HasSubstr("COLMAP: 5 keyframes, 80 points, 400 of 400 observations "
                                         "kept (100.0 %), mean reprojection error 0.00 px"));
  const std::string images = test::read_file(folder / "model/images.txt");
  EXPECT_THAT(images, HasSubstr("\n1 1 0 0 0 "));
  EXPECT_THAT(images, HasSubstr(" 1 image_0/000000.png\n"));
  EXPECT_THAT(images, HasSubstr(" 1 image_0/000004.png\n"));
  EXPECT_THAT(test::read_file(folder / "model/cameras.txt"), HasSubstr("1 PINHOLE 64 48 50 51 "));
  EXPECT_THAT(test::read_file(folder / "model/points3D.txt"), HasSubstr(" 79 7 255 "));
}

TEST_F(GeometryExports, ColmapsOtherFormIsRemoved) {
  path("--colmap") = folder / "model";
  arguments.ascii = true;
  map_export(arguments);
  EXPECT_THAT(message_of<ArgumentError>([&] { map_export(arguments); }),
              HasSubstr("model: is not empty; --force writes into it"));
  arguments.ascii = false;
  arguments.force = true;
  map_export(arguments);
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder / "model"))
    names.push_back(entry.path().filename().string());
  EXPECT_THAT(names, testing::UnorderedElementsAre("cameras.bin", "images.bin", "points3D.bin"));
}

TEST_F(GeometryExports, ColmapNeedsObservationsAndImages) {
  path("--colmap") = folder / "model";
  for (Keyframe& keyframe : stored.map.keyframes) keyframe.observations.clear();
  save();
  EXPECT_THAT(message_of<NoResult>([&] { map_export(arguments); }),
              HasSubstr("model: nothing to write: no landmark has two observations"));
  EXPECT_FALSE(fs::exists(folder / "model"));
  fs::rename(folder / "seq", folder / "moved");
  EXPECT_THAT(message_of([&] { map_export(arguments); }), HasSubstr("/seq"));
}

TEST_F(GeometryExports, NerfFindsTheImagesFromItsFolder) {
  fs::create_directory(folder / "out");
  path("--nerf") = folder / "out/transforms.json";
  map_export(arguments);
  const json written = json::parse(test::read_file(folder / "out/transforms.json"));
  EXPECT_EQ(written["w"], 64);
  ASSERT_EQ(written["frames"].size(), std::size_t{kViews});
  for (int i = 0; i < kViews; ++i) {
    const json& frame = written["frames"][i];
    EXPECT_TRUE(fs::exists(folder / "out/" + frame["file_path"].get<std::string>())) << i;
    EXPECT_NEAR(frame["transform_matrix"][0][3].get<double>(),
                scene.T_ref_cam[static_cast<std::size_t>(i)].translation()[0], 1e-9);
  }
}

TEST_F(GeometryExports, OccupancyIsAPictureAndItsDescription) {
  path("--occupancy") = folder / "floor";
  arguments.resolution_m = 0.1;
  map_export(arguments);
  EXPECT_THAT(test::read_file(folder / "floor.yaml"), HasSubstr("image: \"floor.pgm\"\n"));
  EXPECT_THAT(test::read_file(folder / "floor.yaml"), HasSubstr("resolution: 0.1\n"));
  EXPECT_THAT(test::read_file(folder / "floor.pgm"), testing::StartsWith("P5\n"));
  EXPECT_THAT(message_of<ArgumentError>([&] { map_export(arguments); }),
              HasSubstr("floor.pgm: exists already; --force overwrites it"));
  stored.map.metric = false;
  save();
  path("--occupancy") = folder / "other";
  EXPECT_THAT(message_of<NoResult>([&] { map_export(arguments); }),
              HasSubstr("other: no occupancy grid: the map is not metric"));
  EXPECT_FALSE(fs::exists(folder / "other.pgm"));
}

TEST_F(GeometryExports, GltfHasTrajectoryLandmarksAndKeyframes) {
  path("--gltf") = folder / "map.gltf";
  map_export(arguments);
  const json gltf = json::parse(test::read_file(folder / "map.gltf"));
  ASSERT_EQ(gltf["meshes"].size(), 3u);
  const auto count = [&](int mesh) {
    const int accessor = gltf["meshes"][mesh]["primitives"][0]["attributes"]["POSITION"].get<int>();
    return gltf["accessors"][accessor]["count"].get<int>();
  };
  EXPECT_EQ(count(0), kPoints);
  EXPECT_EQ(count(1), kViews);       // positions of the trajectory
  EXPECT_EQ(count(2), 16 * kViews);  // ends of eight edges a pyramid
  path("--gltf") = folder / "map.glb";
  map_export(arguments);
  EXPECT_EQ(test::read_file(folder / "map.glb").substr(0, 4), "glTF");
  path("--gltf") = folder / "map.obj";
  EXPECT_THAT(message_of<ArgumentError>([&] { map_export(arguments); }),
              HasSubstr("map.obj: the extension is .glb or .gltf"));
}

TEST_F(GeometryExports, McapHasTrajectoryAndLandmarks) {
  path("--mcap") = folder / "map.mcap";
  map_export(arguments);
  const std::string file = test::read_file(folder / "map.mcap");
  for (const char* part : {"foxglove.FrameTransform", "foxglove.PosesInFrame",
                           "foxglove.PointCloud", "\"parent_frame_id\":\"world\"", "/landmarks"})
    EXPECT_THAT(file, HasSubstr(part));
  for (FrameRecord& frame : stored.map.frames) {
    frame.keyframe.reset();
    frame.T_keyframe_frame.reset();
  }
  save();
  path("--mcap") = folder / "none.mcap";
  EXPECT_THAT(message_of<NoResult>([&] { map_export(arguments); }),
              HasSubstr("no frame of the component has a pose"));
}

TEST_F(GeometryExports, ColmapsModelIsImportedAsTheSameMap) {
  path("--colmap") = folder / "model";
  map_export(arguments);
  const StoredMap imported = import_colmap(folder / "model", stored.origin.sequence, true);
  EXPECT_EQ(imported.map.frames.size(), std::size_t{kViews});
  EXPECT_EQ(imported.map.landmarks.size(), std::size_t{kPoints});
  EXPECT_TRUE(imported.map.metric);
  EXPECT_EQ(imported.origin.sequence, stored.origin.sequence);
  ASSERT_EQ(imported.map.keyframes.size(), stored.map.keyframes.size());
  for (std::size_t i = 0; i < kViews; ++i) {
    const Keyframe& keyframe = imported.map.keyframes[i];
    EXPECT_EQ(keyframe.frame, stored.map.keyframes[i].frame);
    ASSERT_EQ(keyframe.observations.size(), std::size_t{kPoints});
    for (std::size_t k = 0; k < kPoints; ++k)
      EXPECT_LT((keyframe.observations[k].px - stored.map.keyframes[i].observations[k].px).norm(),
                1e-4);
    EXPECT_LT(
        (imported.map.S_map_keyframe(keyframe.id).translation() - scene.T_ref_cam[i].translation())
            .norm(),
        1e-3);
  }
  ASSERT_EQ(imported.map.landmarks.size(), std::size_t{kPoints});
  for (std::size_t i = 0; i < kPoints; ++i) {
    const PointLandmark& landmark = imported.map.landmarks[i];
    EXPECT_EQ(landmark.rgb, stored.map.landmarks[i].rgb);
    EXPECT_EQ(landmark.observations, kViews);
    EXPECT_LT((imported.map.position(landmark) - scene.points_ref[i]).norm(), 0.01) << i;
  }
}

TEST_F(GeometryExports, AnImportNeedsTheImagesAndTheirSize) {
  path("--colmap") = folder / "model";
  arguments.ascii = true;
  map_export(arguments);
  const auto import = [&] { (void)import_colmap(folder / "model", folder / "seq", false); };
  const std::string cameras = test::read_file(folder / "model/cameras.txt");
  folder.write("model/cameras.txt", "1 PINHOLE 640 480 500 500 320 240\n");
  EXPECT_THAT(message_of<ArgumentError>(import),
              HasSubstr("seq: images of 64x48, the model's camera has 640x480"));
  folder.write("model/cameras.txt", cameras);
  fs::remove(folder / "seq/image_0/000004.png");
  EXPECT_THAT(message_of<ArgumentError>(import),
              HasSubstr("seq: image image_0/000004.png of the model is missing"));
  folder.write("model/images.txt", "");
  EXPECT_THAT(message_of<NoResult>(import), HasSubstr("has no image"));
}

TEST_F(GeometryExports, AnImportTakesNamesOfFilesAndLeavesOtherFramesLost) {
  folder.write("model/cameras.txt", "1 PINHOLE 64 48 50 50 32 24\n");
  folder.write("model/images.txt",
               "1 1 0 0 0 0 0 -2 1 000003.png\n2 3 9 4 5 9\n2 1 0 0 0 0 0 0 1 000001.png\n\n");
  folder.write("model/points3D.txt", "9 1 2 3 4 5 6 0.1 1 0\n");
  const Map map = import_colmap(folder / "model", folder / "seq", false).map;
  EXPECT_FALSE(map.metric);
  ASSERT_EQ(map.keyframes.size(), 2u);
  EXPECT_EQ(map.keyframes[0].frame, FrameId(1));
  EXPECT_EQ(map.keyframes[1].frame, FrameId(3));
  EXPECT_EQ(map.keyframes[1].observations.size(), 1u);  // the point is there once
  ASSERT_EQ(map.landmarks.size(), 1u);
  EXPECT_EQ(map.landmarks[0].observations, 1);
  EXPECT_TRUE(map.position(map.landmarks[0]).isApprox(Eigen::Vector3d(1, 2, 3)));
  EXPECT_EQ(map.trajectory_optimized().posed(), 2u);
  EXPECT_EQ(map.frames[0].reason, "not an image of the model");
}

TEST_F(GeometryExports, AreThoseOfTheComponent) {
  for (std::size_t i = 3; i < kViews; ++i) stored.map.place_graph.places[i].component = 3;
  stored.map.landmarks[0].keyframe = KeyframeId(4);
  save();
  path("--ply") = folder / "other.ply";
  path("--nerf") = folder / "other.json";
  arguments.component = 3;
  map_export(arguments);
  EXPECT_EQ(read_point_cloud(folder / "other.ply").points.size(), 1u);
  EXPECT_EQ(json::parse(test::read_file(folder / "other.json"))["frames"].size(), 2u);
}

TEST_F(GeometryExports, UndistortedImagesReplaceTheDistortedOnes) {
  stored.origin.lens_k1 = -0.2;
  save();
  cv::Mat taken(48, 64, CV_8UC1);
  for (int u = 0; u < 64; ++u) taken.col(u).setTo(4 * u);
  test::write_picture(folder / "seq/image_0/000000.png", taken);
  path("--colmap") = folder / "model";
  path("--nerf") = folder / "t.json";
  EXPECT_THAT(to_text(map_export(arguments)),
              HasSubstr("; the named images are distorted by k1 = -0.2000\n"));
  path("--undistorted") = folder / "images";
  arguments.force = true;
  arguments.ascii = true;
  EXPECT_THAT(to_text(map_export(arguments)), testing::Not(HasSubstr("distorted")));
  EXPECT_THAT(test::read_file(folder / "model/images.txt"), HasSubstr(" 1 image_0/000000.png\n"));
  const json frames = json::parse(test::read_file(folder / "t.json"))["frames"];
  EXPECT_EQ(frames[0]["file_path"], "images/image_0/000000.png");
  const cv::Mat written = test::read_grey_picture(folder / "images/image_0/000000.png");
  ASSERT_EQ(written.size(), taken.size());
  // The columns bend: at the middle of the height they are elsewhere than at the border.
  EXPECT_GT(cv::norm(written.row(0), written.row(24), cv::NORM_INF), 2);
}

TEST_F(GeometryExports, UndistortedImagesAreAllOrNone) {
  fs::remove(folder / "seq/image_0/000004.png");
  test::write_picture(folder / "seq/image_0/000003.png", cv::Mat(10, 10, CV_8UC1, cv::Scalar(0)));
  test::write_picture(folder / "seq/image_0/000004.png", cv::Mat(48, 64, CV_8UC1, cv::Scalar(0)));
  path("--undistorted") = folder / "images";
  EXPECT_THAT(message_of([&] { map_export(arguments); }), HasSubstr("000003.png"));
  EXPECT_FALSE(fs::exists(folder / "images"));
}

TEST_F(GeometryExports, DenseFormsNeedVoxelsLandmarksAndImages) {
  path("--cloud") = folder / "c.ply";
  for (const double side : {0.0, -1.0, std::nan("")}) {
    arguments.voxel = side;
    EXPECT_THAT(message_of<ArgumentError>([&] { map_export(arguments); }),
                HasSubstr("--voxel: must be positive"));
  }
  arguments.voxel = 1e-5;
  EXPECT_THAT(message_of<ArgumentError>([&] { map_export(arguments); }),
              HasSubstr("--voxel: 1e-05 is too small: one keyframe shows"));
  arguments.voxel.reset();
  EXPECT_THAT(message_of<NoResult>([&] { map_export(arguments); }),
              HasSubstr("c.ply: no depth on which keyframes agree"));
  path("--mesh") = folder / "m.obj";
  EXPECT_THAT(message_of<ArgumentError>([&] { map_export(arguments); }),
              HasSubstr("m.obj: the extension is .ply or .glb"));
  path("--mesh").clear();
  for (Keyframe& keyframe : stored.map.keyframes) keyframe.observations.clear();
  save();
  EXPECT_THAT(message_of<NoResult>([&] { map_export(arguments); }),
              HasSubstr("c.ply: the range of depths is unknown"));
  EXPECT_FALSE(fs::exists(folder / "c.ply"));
}

}  // namespace geometry_exports_test
}  // namespace placegraph
