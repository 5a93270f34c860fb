#include <placegraph/io/datasets/open_dataset.h>

#include "tests/support/message_of.h"
#include "tiny_images.h"

namespace placegraph {
namespace seven_scenes_test {

using test::message_of;
using test::TemporaryFolder;
using test::tiny_depth;
using test::tiny_grey;
using test::write_image;
using testing::ElementsAre;
using testing::HasSubstr;

class SevenScenes : public testing::Test {
 protected:
  void write_frame(int number, bool depth = true) {
    const std::string name = "chess/seq-01/frame-00000" + std::to_string(number);
    write_image(folder, name + ".color.png", tiny_grey(64, 48, number));
    if (depth) write_image(folder, name + ".depth.png", tiny_depth(64, 48, 1500));
    folder.write(name + ".pose.txt",
                 "1 0 0 " + std::to_string(number) + " \n0 1 0 0 \n0 0 1 0.5 \n0 0 0 1 \n");
  }
  std::unique_ptr<Dataset> open() const { return open_dataset(folder / "chess/seq-01"); }
  TemporaryFolder folder;
};

TEST_F(SevenScenes, AreColourDepthAndPosesAtThirtyHertz) {
  for (int i = 0; i < 3; ++i) write_frame(i);
  const auto dataset = open();
  EXPECT_EQ(dataset->format(), "7scenes");
  EXPECT_THAT(dataset->sensors(), ElementsAre(Sensor::kRgbd, Sensor::kMono));
  EXPECT_EQ(dataset->stamp_ns(2), 66666667);
  ASSERT_TRUE(dataset->ground_truth());
  EXPECT_EQ(dataset->ground_truth()->poses[2].T_world_body->translation().x(), 2);
  EXPECT_FLOAT_EQ(dataset->frame(0, Sensor::kRgbd).depth.at<float>(5, 5), 1.5F);
  // A tenth of the size: a tenth of the focal lengths that the data are used with.
  const Calibration calibration = dataset->calibration(Sensor::kRgbd);
  EXPECT_NEAR(calibration.camera.fx, 52.5, 1e-9);
  EXPECT_NEAR(calibration.depth->camera.fx, 58.5, 1e-9);
  EXPECT_THAT(dataset->notes().at(0).text, HasSubstr("has no calibration"));
}

TEST_F(SevenScenes, TakeACalibrationOfTheSceneAndCountWhatIsIncomplete) {
  for (int i = 0; i < 3; ++i) write_frame(i, i != 1);
  folder.write("chess/seq-01/frame-000002.pose.txt", "nan 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n");
  folder.write("chess/calibration.yaml",
               "width: 64\nheight: 48\nfx: 50\nfy: 50\ncx: 31\ncy: 23\ndepth: {unit_m: 0.002}\n");
  const auto dataset = open();
  EXPECT_EQ(dataset->size(), 2u);
  EXPECT_EQ(dataset->calibration(Sensor::kMono).camera.fx, 50);
  EXPECT_THAT(dataset->notes().at(0).text, HasSubstr("1 of 3 frames are skipped"));
  EXPECT_EQ(dataset->ground_truth()->posed(), 1u);
  EXPECT_FLOAT_EQ(dataset->frame(0, Sensor::kRgbd).depth.at<float>(5, 5), 3.0F);
}

TEST_F(SevenScenes, SayWhichSequenceOrPoseIsMeant) {
  for (int i = 0; i < 2; ++i) write_frame(i);
  EXPECT_THAT(message_of([&] { open_dataset(folder / "chess"); }),
              HasSubstr("it contains the sequences seq-01"));
  folder.write("chess/seq-01/frame-000001.pose.txt", "1 0 0 0\n0 1 0 0\n0 0 1\n0 0 0 1\n");
  EXPECT_THAT(message_of([&] { open(); }),
              HasSubstr("frame-000001.pose.txt:3: expected 4 numbers"));
  folder.write("chess/seq-01/frame-000001.pose.txt", "2 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n");
  EXPECT_THAT(message_of([&] { open(); }), HasSubstr("frame-000001.pose.txt: "));
}

TEST(IclNuim, CountsFramesAndInvertsTheTruth) {
  const TemporaryFolder folder;
  std::string pairs;
  for (int i = 0; i < 3; ++i) {
    const std::string name = std::to_string(i) + ".png";
    write_image(folder, "traj0/rgb/" + name, tiny_grey(640, 480, i));
    write_image(folder, "traj0/depth/" + name, tiny_depth(640, 480, 10000));
    pairs += std::to_string(i) + " depth/" + name + " " + std::to_string(i) + " rgb/" + name + "\n";
  }
  folder.write("traj0/associations.txt", pairs);
  folder.write("traj0/livingRoom0.gt.freiburg",
               "1 1 2 3 0 0 0 1\n2 1 2.5 3 0.0998334 0 0 0.9950042\n");
  const auto dataset = open_dataset(folder / "traj0");
  EXPECT_EQ(dataset->stamp_ns(2), 66666666);
  EXPECT_EQ(dataset->calibration(Sensor::kRgbd).camera.fy, 480);
  EXPECT_FLOAT_EQ(dataset->frame(0, Sensor::kRgbd).depth.at<float>(5, 5), 2.0F);
  ASSERT_TRUE(dataset->ground_truth());
  const auto& poses = dataset->ground_truth()->poses;
  EXPECT_FALSE(poses[0].T_world_body);
  ASSERT_TRUE(poses[2].T_world_body);
  EXPECT_NEAR(poses[2].T_world_body->translation().y(), -2.5, 1e-9);
  // A turn about x is one the other way round once y points down.
  const Eigen::AngleAxisd angle_axis(poses[2].T_world_body->rotation());
  EXPECT_NEAR(angle_axis.angle() * angle_axis.axis().x(), -0.2, 1e-5);
  EXPECT_NEAR(poses[2].T_world_body->linear().determinant(), 1, 1e-9);
}

}  // namespace seven_scenes_test
}  // namespace placegraph
