#include <placegraph/io/datasets/open_dataset.h>

#include "tests/support/message_of.h"
#include "tiny_images.h"

namespace placegraph {
namespace tum_rgbd_test {

using test::message_of;
using test::TemporaryFolder;
using test::tiny_depth;
using test::tiny_grey;
using test::write_image;
using testing::ElementsAre;
using testing::HasSubstr;

const std::string kCalibration = "width: 8\nheight: 6\nfx: 10\nfy: 11\ncx: 4\ncy: 3\n";

/// Three colour images at 1.0, 1.1, 1.2 s; depth at 1.005 and 1.19 s; truth at 0.95 ... 1.25 s.
void write_sequence(const TemporaryFolder& folder, const std::string& at = "s/") {
  for (int i = 0; i < 3; ++i) {
    write_image(folder, at + "rgb/" + std::to_string(i) + ".png", tiny_grey(8, 6, i));
  }
  write_image(folder, at + "depth/a.png", tiny_depth(8, 6, 5000));
  write_image(folder, at + "depth/b.png", tiny_depth(8, 6, 10000));
  folder.write(at + "rgb.txt", "# time file\n1.0 rgb/0.png\n1.1 rgb/1.png\n1.2 rgb/2.png\n");
  folder.write(at + "depth.txt", "# time file\n1.005 depth/a.png\n1.19 depth/b.png\n");
  folder.write(at + "groundtruth.txt",
               "# t tx ty tz qx qy qz qw\n0.95 0 0 0 0 0 0 1\n1.05 1 0 0 0 0 0 1\n"
               "1.15 1 0 0 0 0 0 1\n1.25 1 4 0 0 0 0 1\n");
  folder.write(at + "calibration.yaml", kCalibration);
}

TEST(TumRgbd, AssociatesColourDepthAndTruthByTime) {
  const TemporaryFolder folder;
  write_sequence(folder);
  const auto dataset = open_dataset(folder / "s");
  EXPECT_EQ(dataset->format(), "tum");
  EXPECT_THAT(dataset->sensors(), ElementsAre(Sensor::kRgbd, Sensor::kMono));
  ASSERT_EQ(dataset->size(), 2u);  // no depth within 20 ms of 1.1 s
  EXPECT_EQ(dataset->stamp_ns(0), 1000000000);
  EXPECT_EQ(dataset->stamp_ns(1), 1200000000);
  const Frame frame = dataset->frame(1, Sensor::kRgbd);
  EXPECT_TRUE(test::same_pixels(frame.image, tiny_grey(8, 6, 2)));
  EXPECT_FLOAT_EQ(frame.depth.at<float>(3, 3), 2.0f);  // 5000 steps a metre
  ASSERT_TRUE(dataset->ground_truth());
  const Trajectory& truth = *dataset->ground_truth();
  ASSERT_EQ(truth.size(), 2u);
  // T_world_cam, half way between its neighbours.
  EXPECT_LT((truth.poses[0].T_world_body->translation() - Eigen::Vector3d(0.5, 0, 0)).norm(),
            1e-12);
  EXPECT_LT((truth.poses[1].T_world_body->translation() - Eigen::Vector3d(1, 2, 0)).norm(), 1e-12);
}

TEST(TumRgbd, WithoutDepthIsMonoWithEveryImage) {
  const TemporaryFolder folder;
  write_sequence(folder);
  std::filesystem::remove(folder / "s/depth.txt");
  std::filesystem::remove(folder / "s/groundtruth.txt");
  const auto dataset = open_dataset(folder / "s");
  EXPECT_EQ(dataset->size(), 3u);
  EXPECT_THAT(dataset->sensors(), ElementsAre(Sensor::kMono));
  EXPECT_FALSE(dataset->ground_truth());
}

TEST(TumRgbd, LeavesFramesFarFromAnyTruthWithoutAPose) {
  const TemporaryFolder folder;
  write_sequence(folder);
  folder.write("s/groundtruth.txt", "1.15 1 0 0 0 0 0 1\n1.25 1 4 0 0 0 0 1\n");
  const auto dataset = open_dataset(folder / "s");
  EXPECT_FALSE(dataset->ground_truth()->poses[0].T_world_body);
  EXPECT_TRUE(dataset->ground_truth()->poses[1].T_world_body);
}

TEST(TumRgbd, ReadsPairsFromAssociationsInEitherOrder) {
  const TemporaryFolder folder;
  write_sequence(folder);
  std::filesystem::remove(folder / "s/rgb.txt");
  std::filesystem::remove(folder / "s/depth.txt");
  std::vector<std::string> colour, depth;
  for (const char* kind : {"rgb", "depth"})
    for (const auto& entry : std::filesystem::directory_iterator(folder / "s/" + kind))
      (kind[0] == 'r' ? colour : depth)
          .push_back(std::string(kind) + "/" + entry.path().filename().string());
  ASSERT_GE(std::min(colour.size(), depth.size()), 2u);
  std::sort(colour.begin(), colour.end());
  std::sort(depth.begin(), depth.end());
  folder.write("s/associations.txt", "1.0 " + colour[0] + " 1.01 " + depth[0] + "\n1.1 " +
                                         colour[1] + " 1.11 " + depth[1] + "\n");
  const auto dataset = open_dataset(folder / "s");
  EXPECT_EQ(dataset->size(), 2u);
  EXPECT_EQ(dataset->stamp_ns(1), 1'100'000'000);
  EXPECT_EQ(dataset->sensors().front(), Sensor::kRgbd);
  folder.write("s/associations.txt", "1.01 " + depth[0] + " 1.0 " + colour[0] + "\n");
  EXPECT_EQ(open_dataset(folder / "s")->stamp_ns(0), 1'000'000'000);
  folder.write("s/associations.txt", "1.01 " + depth[0] + "\n");
  EXPECT_THAT(message_of([&] { open_dataset(folder / "s"); }),
              HasSubstr("associations.txt:1: expected time, image, time and depth image, found 2"));
}

TEST(TumRgbd, TellsWhatItLeavesOut) {
  const TemporaryFolder folder;
  write_sequence(folder);
  EXPECT_THAT(open_dataset(folder / "s")->notes().front().text,
              HasSubstr("no depth image within 20 ms"));
  std::filesystem::remove(folder / "s/depth.txt");
  EXPECT_THAT(open_dataset(folder / "s")->notes().front().text, HasSubstr("depth.txt is missing"));
}

TEST(TumRgbd, KnowsTheBenchmarksLensesByTheFoldersName) {
  const TemporaryFolder folder;
  for (const char* name :
       {"rgbd_dataset_freiburg1_xyz", "rgbd_dataset_freiburg2_desk", "fr3_office"}) {
    const std::string at = std::string(name) + "/";
    write_image(folder, at + "rgb/0.png", Image(480, 640, CV_8UC3, cv::Scalar(10, 20, 30)));
    write_image(folder, at + "depth/0.png", tiny_depth(640, 480, 5000));
    folder.write(at + "rgb.txt", "1.0 rgb/0.png\n");
    folder.write(at + "depth.txt", "1.0 depth/0.png\n");
    const auto dataset = open_dataset(folder / name);
    const Calibration calibration = dataset->calibration(Sensor::kRgbd);
    EXPECT_EQ(calibration.camera.distortion, Distortion::kNone);
    EXPECT_EQ(calibration.depth->camera.fx, calibration.camera.fx);
    EXPECT_EQ(calibration.depth->camera.cx, calibration.camera.cx);
    EXPECT_NEAR(calibration.camera.fx, 525, 25) << name;
    const Frame frame = dataset->frame(0, Sensor::kRgbd);
    EXPECT_EQ(frame.colour.at<cv::Vec3b>(200, 300), cv::Vec3b(10, 20, 30));
    EXPECT_FLOAT_EQ(frame.depth.at<float>(200, 300), 1);
  }
  // fr3 has no distortion: its intrinsics are handed over as they are.
  EXPECT_EQ(open_dataset(folder / "fr3_office")->calibration(Sensor::kMono).camera.fy, 539.2);
}

TEST(TumRgbd, DoesNotTakeOtherNamesForTheBenchmarks) {
  const TemporaryFolder folder;
  for (const char* name :
       {"room_fr30", "office_fr1080p", "my_fr2_room", "frank", "afreiburg1", "freiburg12"}) {
    folder.write(std::string(name) + "/rgb.txt", "1.0 rgb/0.png\n");
    EXPECT_THAT(message_of([&] { open_dataset(folder / name); }),
                HasSubstr("the intrinsics are unknown"))
        << name;
  }
}

TEST(TumRgbd, NamesTheFileAndLineOfEveryFault) {
  const TemporaryFolder folder;
  write_sequence(folder);
  const auto message = [&](const std::string& file, const std::string& text) {
    const std::string path = folder / "s/" + file;
    const std::string before = test::read_file(path);
    folder.write("s/" + file, text);
    const std::string seen = message_of([&] { open_dataset(folder / "s"); });
    folder.write("s/" + file, before);
    return seen;
  };
  EXPECT_THAT(message("rgb.txt", "# c\n1.0\n"), HasSubstr("rgb.txt:2: expected a time and a file"));
  EXPECT_THAT(message("rgb.txt", "1 a\nnan b\n"), HasSubstr("rgb.txt:2: time: 'nan'"));
  EXPECT_THAT(message("rgb.txt", "1 a\n1 b\n"), HasSubstr("rgb.txt:2: time '1' does not increase"));
  EXPECT_THAT(message("rgb.txt", "# c\n"), HasSubstr("rgb.txt: holds no images"));
  EXPECT_THAT(message("rgb.txt", "1.0 rgb/9.png\n"), HasSubstr("9.png: image is missing"));
  EXPECT_THAT(message("depth.txt", "9.0 depth/a.png\n"), HasSubstr("depth.txt: no depth image is"));
  EXPECT_THAT(message("groundtruth.txt", "1 2 3\n"), HasSubstr("groundtruth.txt:1: "));
  EXPECT_THAT(message("groundtruth.txt", "1 0 0 0 0 1 0 0 0 0 1 0\n"), HasSubstr("without times"));
  EXPECT_THAT(message("calibration.yaml", kCalibration + "baseline_m: 1\n"),
              HasSubstr("one camera"));
  EXPECT_THAT(message("calibration.yaml", "width: 9\n" + kCalibration.substr(9)),
              HasSubstr("0.png: image is 8x6, but 9x6 is expected"));
  std::filesystem::remove(folder / "s/calibration.yaml");
  EXPECT_THAT(message_of([&] { open_dataset(folder / "s"); }),
              HasSubstr("s: the intrinsics are unknown"));
}

}  // namespace tum_rgbd_test
}  // namespace placegraph
