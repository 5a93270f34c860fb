#include <placegraph/graph/image/picture.h>
#include <placegraph/io/datasets/open_dataset.h>

#include <opencv2/imgproc.hpp>

#include "tests/support/data.h"
#include "tests/support/message_of.h"
#include "tiny_images.h"

namespace placegraph {
namespace kitti_odometry_test {

using test::message_of;
using test::TemporaryFolder;
using test::tiny_depth;
using test::tiny_grey;
using test::write_image;
using test::write_numbered;
using testing::ElementsAre;
using testing::HasSubstr;
namespace fs = std::filesystem;

const std::string kP0 = "P0: 10 0 4 0 0 11 3 0 0 0 1 0\n";
const std::string kP1 = "P1: 10 0 4 -5 0 11 3 0 0 0 1 0\n";
const std::string kPoses =
    "1 0 0 0 0 1 0 0 0 0 1 0\n1 0 0 0 0 1 0 0 0 0 1 1\n1 0 0 0 0 1 0 0 0 0 1 2\n";

/// Three mono frames without times and truth.
void write_mono(const TemporaryFolder& folder, const std::string& at = "s/") {
  write_numbered(folder, at + "image_0", 3);
  folder.write(at + "calib.txt", kP0);
}

std::string opening_fails_with(const TemporaryFolder& folder, const std::string& at = "s") {
  return message_of([&] { open_dataset(folder / at); });
}

TEST(KittiOdometry, OpensTheSmallestSequenceAtTenHertz) {
  const TemporaryFolder folder;
  write_mono(folder);
  const auto dataset = open_dataset(folder / "s/");
  EXPECT_EQ(dataset->name(), "s");
  EXPECT_EQ(dataset->format(), "kitti");
  EXPECT_EQ(dataset->size(), 3u);
  EXPECT_THAT(dataset->sensors(), ElementsAre(Sensor::kMono));
  EXPECT_EQ(dataset->stamp_ns(2), 200000000);
  EXPECT_EQ(fs::path(dataset->image_path(2)).filename(), "000002.png");
  EXPECT_THROW((void)dataset->image_path(3), ArgumentError);
  EXPECT_FALSE(dataset->ground_truth());
  const Calibration calibration = dataset->calibration(Sensor::kMono);
  EXPECT_EQ(calibration.camera.width, 8);
  EXPECT_EQ(calibration.camera.height, 6);
  EXPECT_EQ(calibration.camera.fx, 10);
  EXPECT_EQ(calibration.camera.fy, 11);
  EXPECT_EQ(calibration.camera.cx, 4);
  EXPECT_EQ(calibration.camera.cy, 3);
  EXPECT_FALSE(calibration.camera_height_m);
  const Frame frame = dataset->frame(1, Sensor::kMono);
  EXPECT_EQ(frame.id, FrameId(1));
  EXPECT_EQ(frame.stamp_ns, 100000000);
  EXPECT_TRUE(test::same_pixels(frame.image, tiny_grey(8, 6, 1)));
  EXPECT_TRUE(frame.colour.empty() && frame.right.empty() && frame.depth.empty());
}

TEST(KittiOdometry, ReadsStereoTimesAndTruth) {
  const TemporaryFolder folder;
  write_mono(folder);
  write_numbered(folder, "s/image_1", 3, 8, 6, 50);
  folder.write("s/calib.txt", kP0 + kP1 + "Tr: 1 2 3\n");
  folder.write("s/times.txt", "0.0\n1.037359e-01\n0.3\n");
  folder.write("s/poses.txt", kPoses);
  const auto dataset = open_dataset(folder / "s");
  EXPECT_THAT(dataset->sensors(), ElementsAre(Sensor::kStereo, Sensor::kMono));
  EXPECT_EQ(dataset->calibration(Sensor::kStereo).baseline_m, 0.5);
  EXPECT_EQ(dataset->calibration(Sensor::kMono).baseline_m, 0);
  EXPECT_TRUE(dataset->frame(2, Sensor::kMono).right.empty());
  EXPECT_TRUE(test::same_pixels(dataset->frame(2, Sensor::kStereo).right, tiny_grey(8, 6, 52)));
  EXPECT_EQ(dataset->stamp_ns(1), 103735900);
  ASSERT_TRUE(dataset->ground_truth());
  EXPECT_TRUE(dataset->ground_truth()->has_times);
  EXPECT_EQ(dataset->ground_truth()->poses[1].stamp_ns, 103735900);
  EXPECT_EQ(dataset->ground_truth()->poses[2].T_world_body->translation().z(), 2);
  EXPECT_THROW(dataset->calibration(Sensor::kRgbd), ArgumentError);
  EXPECT_THROW(dataset->frame(0, Sensor::kRgbd), ArgumentError);
  EXPECT_THROW(dataset->frame(3, Sensor::kMono), ArgumentError);
  EXPECT_THROW(dataset->stamp_ns(3), ArgumentError);
}

TEST(KittiOdometry, IsRectifiedIfItsFileDescribesAPair) {
  const TemporaryFolder folder;
  write_mono(folder);
  EXPECT_FALSE(open_dataset(folder / "s")->images_rectified());
  folder.write("s/calib.txt", kP0 + kP1);  // the right images are not there
  EXPECT_TRUE(open_dataset(folder / "s")->images_rectified());
}

TEST(KittiOdometry, FindsTheTruthOfTheBenchmarksOwnLayout) {
  const TemporaryFolder folder;
  write_mono(folder, "dataset/sequences/07/");
  folder.write("dataset/poses/07.txt", kPoses);
  for (const char* path :
       {"dataset/sequences/07", "dataset/sequences/07/", "dataset/poses/../sequences/07"}) {
    const auto dataset = open_dataset(folder / path);
    EXPECT_EQ(dataset->name(), "07");
    ASSERT_TRUE(dataset->ground_truth()) << path;
    EXPECT_EQ(dataset->ground_truth()->size(), 3u);
  }
}

TEST(KittiOdometry, TakesTheColourCamerasWhereTheGreyOnesAreAbsent) {
  const TemporaryFolder folder;
  // Camera 2 stands 0.06 m left of camera 0 (its P[3] = +0.6 = fx * 0.06), camera 3 0.54 m to its
  // right.
  folder.write("s/calib.txt",
               kP0 + "P2: 10 0 4 0.6 0 11 3 0 0 0 1 0\n" + "P3: 10 0 4 -4.8 0 11 3 0 0 0 1 0\n");
  Image colour(6, 8, CV_8UC3, cv::Scalar(200, 100, 50));
  for (int i = 0; i < 3; ++i) {
    write_image(folder, "s/image_2/00000" + std::to_string(i) + ".png", colour);
    write_image(folder, "s/image_3/00000" + std::to_string(i) + ".png", colour);
  }
  // Turned by 90 degrees about y: camera x is world -z.
  folder.write("s/poses.txt", "0 0 1 1 0 1 0 0 -1 0 0 0\n" + kPoses.substr(0, 48));
  const auto dataset = open_dataset(folder / "s");
  EXPECT_NEAR(dataset->calibration(Sensor::kStereo).baseline_m, 0.54, 1e-12);
  const Frame frame = dataset->frame(0, Sensor::kStereo);
  EXPECT_TRUE(test::same_pixels(frame.colour, colour));
  Image grey;
  cv::cvtColor(colour, grey, cv::COLOR_BGR2GRAY);
  EXPECT_TRUE(test::same_pixels(frame.image, grey));
  EXPECT_TRUE(test::same_pixels(frame.right, grey));
  const Eigen::Vector3d t = dataset->ground_truth()->poses[0].T_world_body->translation();
  EXPECT_LT((t - Eigen::Vector3d(1, 0, 0.06)).norm(), 1e-12);
}

TEST(KittiOdometry, HandsDepthOverInMetresOfItsOwnCamera) {
  const TemporaryFolder folder;
  write_mono(folder);
  Image depth = tiny_depth(10, 7, 1500);
  depth.at<std::uint16_t>(2, 3) = 65535;
  depth.at<std::uint16_t>(2, 4) = 0;
  for (int i = 0; i < 3; ++i)
    write_image(folder, "s/depth_0/00000" + std::to_string(i) + ".png", depth);
  folder.write("s/calib_depth.txt",
               "P0: 12 0 5 0 0 12 3 0 0 0 1 0\nT_cam_depth: 1 0 0 0.025 0 1 0 0 0 0 1 0\n");
  const auto dataset = open_dataset(folder / "s");
  EXPECT_THAT(dataset->sensors(), ElementsAre(Sensor::kRgbd, Sensor::kMono));
  const DepthCamera camera = *dataset->calibration(Sensor::kRgbd).depth;
  EXPECT_EQ(camera.camera.width, 10);
  EXPECT_EQ(camera.camera.fx, 12);
  EXPECT_EQ(camera.T_cam_depth.translation(), Eigen::Vector3d(0.025, 0, 0));
  EXPECT_FALSE(dataset->calibration(Sensor::kMono).depth);
  const Frame frame = dataset->frame(0, Sensor::kRgbd);
  ASSERT_EQ(frame.depth.type(), CV_32FC1);
  EXPECT_FLOAT_EQ(frame.depth.at<float>(0, 0), 1.5f);
  EXPECT_EQ(frame.depth.at<float>(2, 3), 0);
  EXPECT_EQ(frame.depth.at<float>(2, 4), 0);
  EXPECT_TRUE(dataset->frame(0, Sensor::kMono).depth.empty());
}

TEST(KittiOdometry, TakesDepthWithoutCalibrationAsRegistered) {
  const TemporaryFolder folder;
  write_mono(folder);
  for (int i = 0; i < 3; ++i) {
    write_image(folder, "s/depth_0/00000" + std::to_string(i) + ".png", tiny_depth(8, 6, 20));
  }
  EXPECT_EQ(open_dataset(folder / "s")->calibration(Sensor::kRgbd).depth->camera.fx, 10);
  folder.write("s/calib_depth.txt", "P0: 12 0 5 0 0 12 3 0 0 0 1 0\nunit_m: 0.01\n");
  EXPECT_FLOAT_EQ(open_dataset(folder / "s")->frame(1, Sensor::kRgbd).depth.at<float>(0, 0), 0.2f);
}

TEST(KittiOdometry, ReadsTheCameraHeightOfARenderedWorld) {
  const TemporaryFolder folder;
  write_mono(folder);
  folder.write("s/world.yaml", "world: town-loop\ncamera_height_m: 1.65\n");
  EXPECT_EQ(open_dataset(folder / "s")->calibration(Sensor::kMono).camera_height_m, 1.65);
  folder.write("s/world.yaml", "world: town-loop\n");
  EXPECT_FALSE(open_dataset(folder / "s")->calibration(Sensor::kMono).camera_height_m);
  folder.write("s/world.yaml", "world: x\ncamera_height_m: high\n");
  EXPECT_THAT(opening_fails_with(folder), HasSubstr("world.yaml:2: camera_height_m: is not a"));
  folder.write("s/world.yaml", "camera_height_m: -1\n");
  EXPECT_THAT(opening_fails_with(folder), HasSubstr("world.yaml:1: camera_height_m: must be"));
}

TEST(KittiOdometry, NamesTheFileAndLineOfABadCalibration) {
  const TemporaryFolder folder;
  write_mono(folder);
  const auto message = [&](const std::string& calibration) {
    folder.write("s/calib.txt", calibration);
    return opening_fails_with(folder);
  };
  EXPECT_THAT(message("P1: 1\n"), HasSubstr("calib.txt:1: P1: expected 12 numbers, found 1"));
  EXPECT_THAT(message(kP1), HasSubstr("calib.txt: has no line P0:"));
  EXPECT_THAT(message(kP0 + kP0), HasSubstr("calib.txt:2: P0: is there twice"));
  EXPECT_THAT(message("\nP0: 10 0 4 0 0 x 3 0 0 0 1 0\n"),
              HasSubstr("calib.txt:2: P0: 'x' is not"));
  EXPECT_THAT(message("P0: nan 0 4 0 0 11 3 0 0 0 1 0\n"), HasSubstr("calib.txt:1: P0: 'nan'"));
  EXPECT_THAT(message("P0: -1 0 4 0 0 11 3 0 0 0 1 0\n"),
              HasSubstr("calib.txt:1: P0: is not a proj"));
  EXPECT_THAT(message("P0: 10 0 4 0 0 11 3 0 0 0 2 0\n"),
              HasSubstr("calib.txt:1: P0: is not a proj"));
  write_numbered(folder, "s/image_1", 3);
  EXPECT_THAT(message(kP0 + "P1: 10 0 4 5 0 11 3 0 0 0 1 0\n"),
              HasSubstr("calib.txt:2: P1: baseline is -0.5 m, not positive"));
  EXPECT_THAT(message(kP0 + "P1: 12 0 4 -5 0 11 3 0 0 0 1 0\n"),
              HasSubstr("calib.txt:2: P1: has other intrinsics than P0"));
}

TEST(KittiOdometry, RefusesListsOfDifferentLengths) {
  const TemporaryFolder folder;
  write_mono(folder);
  folder.write("s/times.txt", "0\n1\n");
  EXPECT_THAT(opening_fails_with(folder), HasSubstr("times.txt: holds 2 entries, but there are 3"));
  folder.write("s/times.txt", "0\n1\n2\n");
  folder.write("s/poses.txt", kPoses + kPoses);
  EXPECT_THAT(opening_fails_with(folder), HasSubstr("poses.txt: holds 6 entries, but there are 3"));
  folder.write("s/poses.txt", "0 0 0 0 0 0 0 1\n");
  EXPECT_THAT(opening_fails_with(folder), HasSubstr("poses.txt: has times of its own"));
  folder.write("s/poses.txt", kPoses);
  folder.write("s/calib.txt", kP0 + kP1);
  write_numbered(folder, "s/image_1", 2);
  EXPECT_THAT(opening_fails_with(folder), HasSubstr("image_1: holds 2 entries, but there are 3"));
}

TEST(KittiOdometry, SaysWhichImageIsMissing) {
  const TemporaryFolder folder;
  write_mono(folder);
  write_image(folder, "s/image_0/000002.jpg", tiny_grey(8, 6, 2));
  EXPECT_THAT(opening_fails_with(folder), HasSubstr("image 2 is there twice"));
  fs::remove(folder / "s/image_0/000002.jpg");
  fs::remove(folder / "s/image_0/000001.png");
  EXPECT_THAT(opening_fails_with(folder),
              HasSubstr("image_0: image 000001.* is missing (the last is 000002)"));
  fs::remove_all(folder / "s/image_0");
  fs::create_directories(folder / "s/image_0");
  EXPECT_THAT(opening_fails_with(folder), HasSubstr("image_0: holds no images"));
}

TEST(KittiOdometry, RefusesImagesThatAreCutEmptyForeignOrOfAnotherSize) {
  const TemporaryFolder folder;
  write_mono(folder);
  const auto message = [&](const std::string& bytes) {
    const auto dataset = open_dataset(folder / "s");
    folder.write("s/image_0/000001.png", bytes);
    return message_of([&] { dataset->frame(1, Sensor::kMono); });
  };
  const std::string whole = test::read_file(folder / "s/image_0/000001.png");
  EXPECT_THAT(message(whole.substr(0, whole.size() / 2)), HasSubstr("000001.png: image is trunc"));
  EXPECT_THAT(message(""), HasSubstr("000001.png: image file is empty"));
  EXPECT_THAT(message("no picture"), HasSubstr("000001.png: is no readable image"));
  const std::string jpeg_text = encode_picture("a.jpg", tiny_grey(64, 64, 0));
  EXPECT_THAT(message(jpeg_text.substr(0, jpeg_text.size() - 20)), HasSubstr("is truncated"));
  // The end of a thumbnail in the head is not the image's.
  const std::string thumbnail("\xff\xd8\xff\xe1\x00\x06\xff\xd9\x00\x00", 10);
  EXPECT_THAT(message(thumbnail + jpeg_text.substr(2, jpeg_text.size() - 22)),
              HasSubstr("is truncated"));
  EXPECT_THAT(message(jpeg_text), HasSubstr("000001.png: image is 64x64, but 8x6 is expected"));
  const auto dataset = open_dataset(folder / "s");
  fs::remove(folder / "s/image_0/000002.png");
  EXPECT_THAT(message_of([&] { dataset->frame(2, Sensor::kMono); }),
              HasSubstr("000002.png: image is missing"));
}

TEST(KittiOdometry, RefusesDepthOfEightBits) {
  const TemporaryFolder folder;
  write_mono(folder);
  write_numbered(folder, "s/depth_0", 3);
  EXPECT_THAT(opening_fails_with(folder),
              HasSubstr("000000.png: depth image must have one channel"));
}

TEST(OpenDataset, SaysWhatItLookedFor) {
  const TemporaryFolder folder;
  folder.write("s/readme", "");
  EXPECT_THAT(opening_fails_with(folder), HasSubstr("no sequence is recognized here; looked for"));
  EXPECT_THAT(opening_fails_with(folder, "none"), HasSubstr("none: no such file or folder"));
}

struct RealSequence {
  const char* name;
  std::size_t frames;
  int width, height;
  std::vector<Sensor> sensors;
};

class RealKittiLayout : public testing::TestWithParam<RealSequence> {};

TEST_P(RealKittiLayout, OpensAndHandsOverItsFirstAndLastFrame) {
  PLACEGRAPH_DATA_OR_SKIP(path, std::string("sequences/") + GetParam().name);
  const auto dataset = open_dataset(path);
  EXPECT_EQ(dataset->name(), GetParam().name);
  EXPECT_EQ(dataset->size(), GetParam().frames);
  EXPECT_EQ(dataset->sensors(), GetParam().sensors);
  ASSERT_TRUE(dataset->ground_truth());
  EXPECT_EQ(dataset->ground_truth()->posed(), GetParam().frames);
  const Sensor sensor = dataset->sensors().front();
  for (const std::size_t i : {std::size_t{0}, dataset->size() - 1}) {
    const Frame frame = dataset->frame(i, sensor);
    EXPECT_EQ(frame.image.size(), cv::Size(GetParam().width, GetParam().height));
    EXPECT_EQ(frame.image.type(), CV_8UC1);
    const cv::Size right = sensor == Sensor::kStereo ? frame.image.size() : cv::Size();
    EXPECT_EQ(frame.right.size(), right);
    if (sensor == Sensor::kRgbd) {
      double farthest_m = 0;
      cv::minMaxLoc(frame.depth, nullptr, &farthest_m);
      EXPECT_GT(farthest_m, 0.5);
      EXPECT_LT(farthest_m, 10);  // a kitchen
      EXPECT_EQ(frame.colour.type(), CV_8UC3);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Data, RealKittiLayout,
    testing::Values(
        RealSequence{"kitti00_mono200", 200, 1241, 376, {Sensor::kMono}},
        RealSequence{"kitti0095_mono268", 268, 1242, 375, {Sensor::kMono}},
        RealSequence{"kitti06_stereo51", 51, 1226, 370, {Sensor::kStereo, Sensor::kMono}},
        RealSequence{"sevenscenes_rgbd334", 334, 640, 480, {Sensor::kRgbd, Sensor::kMono}},
        RealSequence{"cube_planar200", 200, 752, 480, {Sensor::kMono}}),
    [](const auto& test) { return std::string(test.param.name); });

}  // namespace kitti_odometry_test
}  // namespace placegraph
