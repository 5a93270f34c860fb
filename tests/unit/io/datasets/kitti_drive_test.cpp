#include <placegraph/io/datasets/open_dataset.h>

#include "tests/support/message_of.h"
#include "tiny_images.h"

namespace placegraph {
namespace kitti_drive_test {

using test::message_of;
using test::TemporaryFolder;
using test::tiny_grey;
using testing::ElementsAre;
using testing::HasSubstr;
namespace fs = std::filesystem;

const std::string kCalibration =
    "calib_time: 09-Jan-2012 13:57:47\nS_rect_00: 8 6\n"
    "P_rect_00: 10 0 4 0 0 11 3 0 0 0 1 0\nP_rect_01: 10 0 4 -5 0 11 3 0 0 0 1 0\n"
    "P_rect_02: 10 0 4 0.6 0 11 3 0 0 0 1 0\n";

/// A drive as it ships: the calibration is one folder up.
class KittiDrive : public testing::Test {
 protected:
  void write_image(int camera, int number) {
    test::write_image(folder,
                      "day/drive_sync/image_0" + std::to_string(camera) + "/data/000000000" +
                          std::to_string(number) + ".png",
                      tiny_grey(8, 6, number));
  }
  void write_drive(int kitti_cameras) {
    for (int camera = 0; camera < kitti_cameras; ++camera)
      for (int number = 0; number < 4; ++number) write_image(camera, number);
    folder.write("day/calib_cam_to_cam.txt", kCalibration);
    folder.write("day/drive_sync/image_00/timestamps.txt",
                 "2011-09-26 13:02:25.500000000\n2011-09-26 13:02:25.600000000\n"
                 "2011-09-26 13:02:25.700000128\n2011-09-26 13:02:25.800000000\n");
  }
  std::unique_ptr<Dataset> open() const { return open_dataset(folder / "day/drive_sync"); }
  TemporaryFolder folder;
};

TEST_F(KittiDrive, IsTwoGreyCamerasWithTheirTimes) {
  write_drive(2);
  const auto dataset = open();
  EXPECT_EQ(dataset->format(), "kitti_raw");
  EXPECT_EQ(dataset->size(), 4u);
  EXPECT_TRUE(dataset->images_rectified());
  EXPECT_THAT(dataset->sensors(), ElementsAre(Sensor::kStereo, Sensor::kMono));
  EXPECT_EQ(dataset->calibration(Sensor::kStereo).baseline_m, 0.5);
  EXPECT_EQ(dataset->stamp_ns(0), 0);
  EXPECT_EQ(dataset->stamp_ns(2), 200000128);
  EXPECT_TRUE(test::same_pixels(dataset->frame(3, Sensor::kStereo).right, tiny_grey(8, 6, 3)));
}

TEST_F(KittiDrive, LeavesOutWhatMonocularLacksAndKeepsTheTimes) {
  write_drive(2);
  fs::remove(folder / "day/drive_sync/image_01/data/0000000001.png");
  folder.write("day/drive_sync/poses.txt",
               "1 0 0 0 0 1 0 0 0 0 1 0\n1 0 0 0 0 1 0 0 0 0 1 1\n1 0 0 0 0 1 0 0 0 0 1 2\n"
               "1 0 0 0 0 1 0 0 0 0 1 3\n");
  const auto dataset = open();
  EXPECT_EQ(dataset->size(), 3u);
  EXPECT_EQ(dataset->stamp_ns(1), 200000128);
  ASSERT_TRUE(dataset->ground_truth());
  EXPECT_EQ(dataset->ground_truth()->poses[1].T_world_body->translation().z(), 2);
  EXPECT_THAT(
      dataset->notes().at(0).text,
      HasSubstr("1 of 4 images of the left camera and 0 of 3 of the right camera are skipped"));
}

TEST_F(KittiDrive, SaysWhatIsMissingOrOfAnotherKind) {
  write_drive(1);
  fs::remove(folder / "day/calib_cam_to_cam.txt");
  EXPECT_THAT(message_of([&] { open(); }), HasSubstr("calib_cam_to_cam.txt"));
  // The unrectified drive has larger images.
  std::string extract = kCalibration;
  folder.write("day/drive_sync/calib.txt", extract.replace(extract.find("8 6"), 3, "9 6"));
  EXPECT_THAT(message_of([&] { open(); }), HasSubstr("is 8 x 6, but"));
  EXPECT_THAT(message_of([&] { open(); }), HasSubstr("(_extract)"));
  folder.write("day/drive_sync/calib.txt", kCalibration);
  EXPECT_EQ(open()->size(), 4u);
  EXPECT_THAT(message_of([&] { open_dataset(folder / "day"); }),
              HasSubstr("it contains the sequences drive_sync: name one of them"));
  folder.write("day/drive_sync/image_00/timestamps.txt", "2011-09-26 13:02:25.500000000\n");
  EXPECT_THAT(message_of([&] { open(); }), HasSubstr("holds 1 times, but there is an image 1"));
  fs::remove(folder / "day/drive_sync/image_00/timestamps.txt");
  EXPECT_THAT(open()->notes().at(0).text, HasSubstr("timestamps.txt is missing"));
}

TEST(KittiOdometryNearly, ReportsMissingFiles) {
  const TemporaryFolder folder;
  test::write_numbered(folder, "s/image_0", 3);
  EXPECT_THAT(message_of([&] { open_dataset(folder / "s"); }),
              HasSubstr("calib.txt is missing (KITTI: a line P0: with twelve numbers)"));
  folder.write("s/calib.txt", "P_rect_00: 10 0 4 0 0 11 3 0 0 0 1 0\n");
  EXPECT_EQ(open_dataset(folder / "s")->size(), 3u);
  test::write_numbered(folder, "t/left", 3);
  test::write_numbered(folder, "t/right", 3);
  EXPECT_THAT(message_of([&] { open_dataset(folder / "t"); }),
              HasSubstr("calibration.yaml is missing"));
}

}  // namespace kitti_drive_test
}  // namespace placegraph
