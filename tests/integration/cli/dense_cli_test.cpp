// `map export --cloud --mesh` of a rendered corridor, compared with its true surfaces.
#include <placegraph/io/measurements/point_cloud_file.h>
#include <placegraph/io/scene/labelled_mesh_file.h>

#include <Eigen/Geometry>
#include <fstream>

#include "tests/support/cli_test.h"

namespace placegraph {
namespace dense_cli_test {

namespace fs = std::filesystem;
using test::CommandResult;
using test::read_file;
using testing::HasSubstr;

/// Distance of a point to a polygon with right angles.
double distance_to(const LabelledMesh& scene, const LabelledMesh::Face& face,
                   const Eigen::Vector3d& p) {
  const auto corner = [&](std::size_t i) {
    return scene.vertices[static_cast<std::size_t>(face.corners[i])];
  };
  const Eigen::Vector3d o = corner(0), a = corner(1) - o, b = corner(face.corners.size() - 1) - o;
  const double s = std::clamp((p - o).dot(a) / a.squaredNorm(), 0.0, 1.0);
  const double t = std::clamp((p - o).dot(b) / b.squaredNorm(), 0.0, 1.0);
  return (p - o - s * a - t * b).norm();
}

/// The median distance of every 50th point of a cloud to the surfaces of a scene.
double median_error(const std::string& cloud_file, const std::string& scene_file) {
  const PointCloud cloud = read_point_cloud(cloud_file);
  const LabelledMesh scene = read_labelled_mesh(scene_file);
  std::vector<double> errors;
  for (std::size_t i = 0; i < cloud.points.size(); i += 50) {
    double least = 1e9;
    for (const LabelledMesh::Face& face : scene.faces)
      least = std::min(least, distance_to(scene, face, cloud.points[i]));
    errors.push_back(least);
  }
  std::ranges::nth_element(errors, errors.begin() + static_cast<std::ptrdiff_t>(errors.size() / 2));
  return errors[errors.size() / 2];
}

/// A drive through a corridor, rendered once for all tests, and its maps.
class DenseCli : public test::CliTest {
 protected:
  static void SetUpTestSuite() {
    made = new test::TemporaryFolder;
    for (const char* command :
         {"synth sequence corridor-loop --frames 30 --size 448x336 --difficulty clean --labels "
          "--stereo --out walk",
          "run walk --sensor rgbd --out rgbd", "run walk --sensor stereo --out stereo",
          "run walk --sensor mono --camera-height 1.4 --out mono"}) {
      const CommandResult result = test::run_placegraph(command, made->path());
      ASSERT_EQ(result.code, 0) << result.err;
    }
  }
  static void TearDownTestSuite() { delete made; }
  static std::string at(const std::string& name) { return *made / name; }
  static inline test::TemporaryFolder* made = nullptr;
};

TEST_F(DenseCli, CloudsAreOnTheTrueSurfaces) {
  struct Limit {
    const char* sensor;
    double most_m;
    std::size_t least_points;
  };
  for (const auto& [sensor, most_m, least_points] :
       {Limit{"rgbd", 0.02, 20000}, Limit{"stereo", 0.05, 3000}}) {
    const CommandResult result = run("map export " + at(sensor) + " --cloud c.ply --force");
    ASSERT_EQ(result.code, 0) << result.err;
    EXPECT_THAT(result.out, HasSubstr("dense: "));
    EXPECT_LT(median_error(dir / "c.ply", at("walk/scene.ply")), most_m) << sensor;
    EXPECT_GT(read_point_cloud(dir / "c.ply").points.size(), least_points) << sensor;
  }
}

TEST_F(DenseCli, OneCameraHasACloud) {
  const CommandResult result = run("map export " + at("mono") + " --cloud c.ply --voxel 0.05");
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("by planes swept between keyframes, voxels of 0.05 m"));
  EXPECT_GT(read_point_cloud(dir / "c.ply").points.size(), 1000u);
}

TEST_F(DenseCli, MeshesAreWrittenInBothForms) {
  const std::string command = "map export " + at("rgbd") + " --voxel 0.05 --mesh ";
  ASSERT_EQ(run(command + "m.ply --cloud c.ply").code, 0);
  ASSERT_EQ(run(command + "again.ply").code, 0);
  EXPECT_EQ(read_file(dir / "m.ply"), read_file(dir / "again.ply"));
  EXPECT_LT(median_error(dir / "m.ply", at("walk/scene.ply")), 0.02);
  ASSERT_EQ(run(command + "m.glb").code, 0);
  EXPECT_EQ(read_file(dir / "m.glb").substr(0, 4), "glTF");
  ASSERT_EQ(run(command + "text.ply --ascii").code, 0);
  EXPECT_THAT(read_file(dir / "text.ply"), HasSubstr("ply\nformat ascii 1.0\n"));
}

TEST_F(DenseCli, BadInputGivesOneLineAndNoFile) {
  const std::string command = "map export " + at("rgbd") + " --cloud c.ply ";
  expect_usage_error(command + "--voxel 0", "--voxel");
  expect_usage_error(command + "--voxel nan", "--voxel");
  expect_usage_error(command + "--voxel 1e-7", "--voxel: 1e-07 is too small");
  expect_usage_error("map export " + at("rgbd") + " --mesh m.obj", ".ply or .glb");
  fs::copy(at("rgbd"), dir / "moved");
  fs::rename(at("walk"), at("gone"));
  expect_usage_error("map export moved --cloud c.ply", "walk");
  expect_usage_error("map export moved --undistorted images", "walk");
  fs::rename(at("gone"), at("walk"));
  EXPECT_FALSE(fs::exists(dir / "c.ply"));
  EXPECT_FALSE(fs::exists(dir / "images"));
}

TEST_F(DenseCli, UndistortedImagesAreNamedByTheModel) {
  ASSERT_EQ(
      run("map export " + at("mono") + " --colmap model --nerf t.json --undistorted images --ascii")
          .code,
      0);
  EXPECT_TRUE(fs::exists(dir / "images/image_0/000000.png"));
  EXPECT_THAT(read_file(dir / "model/images.txt"), HasSubstr(" 1 image_0/000000.png\n"));
  EXPECT_THAT(read_file(dir / "t.json"), HasSubstr("images/image_0/000000.png"));
}

TEST_F(DenseCli, BundlesOfColmapAreAdjusted) {
  ASSERT_EQ(run("map export " + at("stereo") + " --colmap model").code, 0);
  const CommandResult result = run("graph bundle model -o adjusted");
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("mean reprojection error"));
  EXPECT_TRUE(fs::exists(dir / "adjusted/points3D.bin"));
  expect_usage_error("graph bundle model -o adjusted", "--force");
  EXPECT_EQ(run("graph bundle adjusted --kernel cauchy --json").code, 0);
  fs::create_directory(dir / "empty");
  expect_usage_error("graph bundle empty -o other", "cameras.txt");
  EXPECT_FALSE(fs::exists(dir / "other"));
}

}  // namespace dense_cli_test
}  // namespace placegraph
