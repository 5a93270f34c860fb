#include <gmock/gmock.h>
#include <placegraph/graph/core/random.h>
#include <placegraph/io/exports/colmap_model.h>
#include <placegraph/io/exports/nerf_transforms.h>
#include <placegraph/io/trajectories/trajectory_file.h>

#include "tests/support/message_of.h"
#include "tests/support/random_map.h"
#include "tests/support/temporary_folder.h"

namespace placegraph {
namespace posed_images_test {

using test::message_of;
using test::TemporaryFolder;
using testing::HasSubstr;

std::string transforms(const std::vector<std::string>& names) {
  std::vector<NerfImage> images;
  for (std::size_t i = 0; i < names.size(); ++i)
    images.push_back({names[i], SE3(SO3(), {static_cast<double>(i), 0, 0})});
  Camera camera;
  camera.width = 640, camera.height = 480;
  camera.fx = camera.fy = 500, camera.cx = 320, camera.cy = 240;
  return to_nerf_transforms(camera, images);
}

TEST(PosedImages, OfAllThreeFormsAreThePosesOfOneModelInOurAxes) {
  Random random(5);
  for (int world = 0; world < 10; ++world) {
    SCOPED_TRACE("world " + std::to_string(world) + " of seed 5");
    const TemporaryFolder folder;
    ColmapModel model;
    model.camera.width = 640, model.camera.height = 480;
    model.camera.fx = model.camera.fy = 500, model.camera.cx = 320, model.camera.cy = 240;
    std::vector<NerfImage> images;
    for (int i = 0; i < 6; ++i) {
      // In the file against the order of the names.
      const std::string name = "images/frame" + std::to_string(30 - 5 * i) + ".png";
      const SE3 T_world_cam = test::random_pose(random);
      model.images.push_back({static_cast<std::uint32_t>(i + 1), name, T_world_cam, {}});
      images.push_back({name, T_world_cam});
    }
    const std::vector<std::string> paths = {
        folder.write("images.txt", to_colmap(model, NumberForm::kText).images),
        folder.write("images.bin", to_colmap(model, NumberForm::kBinary).images),
        folder.write("transforms.json", to_nerf_transforms(model.camera, images))};
    for (const std::string& path : paths) {
      SCOPED_TRACE(path);
      const Trajectory read = read_trajectory(path);
      ASSERT_EQ(read.size(), 6u);
      EXPECT_FALSE(read.has_times);
      EXPECT_TRUE(read.numbered);
      for (std::size_t i = 0; i < 6; ++i) {
        EXPECT_EQ(read.poses[i].stamp_ns, 5 * static_cast<std::int64_t>(i) + 5);
        const Eigen::Matrix4d expected = model.images[5 - i].T_world_cam.matrix();
        EXPECT_LT((read.poses[i].T_world_body->matrix() - expected).cwiseAbs().maxCoeff(), 1e-9);
      }
    }
  }
}

TEST(PosedImages, HaveTheTimesThatTheirNamesConsistOf) {
  const TemporaryFolder folder;
  const Trajectory euroc = read_trajectory(folder.write(
      "e.json", transforms({"a/1403636579763555584.png", "a/1403636579813555456.png"})));
  EXPECT_TRUE(euroc.has_times);
  EXPECT_EQ(euroc.poses[1].stamp_ns, 1403636579813555456);
  const Trajectory tum = read_trajectory(
      folder.write("t.json", transforms({"./rgb/1305031102.175304", "./rgb/1305031102.211214"})));
  EXPECT_TRUE(tum.has_times);
  EXPECT_EQ(tum.poses[0].stamp_ns, 1305031102175304000);
}

TEST(PosedImages, WithoutNumbersInTheirNamesAreCounted) {
  const TemporaryFolder folder;
  const Trajectory read = read_trajectory(folder.write("t.json", transforms({"b.png", "a.png"})));
  EXPECT_FALSE(read.numbered);
  EXPECT_EQ(read.poses[0].stamp_ns, 0);
  EXPECT_EQ(read.poses[0].T_world_body->translation().x(), 1);  // a.png
}

TEST(PosedImages, OfSeveralCamerasAreRefused) {
  const TemporaryFolder folder;
  const std::string path = folder.write("t.json", transforms({"left/0001.png", "right/0001.png"}));
  EXPECT_THAT(message_of([&] { read_trajectory(path); }),
              HasSubstr("images left/0001.png and right/0001.png have one number, 1"));
}

TEST(PosedImages, NameWhatIsWrong) {
  const TemporaryFolder folder;
  const auto message = [&](const char* name, const std::string& text) {
    const std::string path = folder.write(name, text);
    return message_of([&] { read_trajectory(path); });
  };
  EXPECT_THAT(message("t.json", "{}"), HasSubstr("t.json: is JSON, but no transforms.json"));
  EXPECT_THAT(message("t.json", "{\"frames\": []}"), HasSubstr("holds no posed images"));
  EXPECT_THAT(message("t.json", "{\"frames\": [{\"file_path\": \"a\"}]}"),
              HasSubstr("t.json: is no transforms.json: "));
  EXPECT_THAT(message("t.json", "{\"frames\": [{\"file_path\": \"a\", \"transform_matrix\": "
                                "[[2,0,0,0],[0,2,0,0],[0,0,2,0],[0,0,0,1]]}]}"),
              HasSubstr("the transform_matrix of 'a' is not that of a rigid motion"));
  EXPECT_THAT(message("t.json", "{\"frames\": "), HasSubstr("t.json: is not valid JSON"));
  EXPECT_THAT(message("images.bin", "abc"), HasSubstr("images.bin: truncated"));
  EXPECT_THAT(message("images.txt", "1 0 0 0 0 0 0 0 1 a.png\n\n"), HasSubstr("images.txt"));
}

}  // namespace posed_images_test
}  // namespace placegraph
