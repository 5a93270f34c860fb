#include <placegraph/graph/image/picture_plugin.h>
#include <placegraph/io/calibration/calibration_file.h>
#include <placegraph/io/datasets/open_dataset.h>
#include <placegraph/io/files/image_list.h>

#include "tests/support/message_of.h"
#include "tiny_images.h"

namespace placegraph {
namespace image_folder_test {

using test::message_of;
using test::TemporaryFolder;
using test::tiny_depth;
using test::tiny_grey;
using test::write_image;
using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;

const std::string kCalibration = "width: 8\nheight: 6\nfx: 10\nfy: 11\ncx: 4\ncy: 3\n";

void write_images(const TemporaryFolder& folder, const std::string& at = "s/") {
  for (int i : {1, 2, 10}) {
    write_image(folder, at + "img" + std::to_string(i) + ".png", tiny_grey(8, 6, i));
  }
}

TEST(ImageList, CountsInsteadOfSpelling) {
  const TemporaryFolder folder;
  for (const char* name : {"b1.png", "a10.JPG", "a9.png", "a009b.png", "notes.txt", ".a.png"}) {
    folder.write(name, "");
  }
  EXPECT_THAT(list_images(folder.path()), ElementsAre(EndsWith("/a9.png"), EndsWith("/a009b.png"),
                                                      EndsWith("/a10.JPG"), EndsWith("/b1.png")));
  EXPECT_THAT(message_of([&] { list_images(folder / "none"); }), HasSubstr("none: "));
}

TEST(ImageFolder, OpensInNaturalOrderAtTheRateItNames) {
  const TemporaryFolder folder;
  write_images(folder);
  folder.write("s/calibration.yaml", kCalibration + "fps: 4\ncamera_height_m: 1.2\n");
  const auto dataset = open_dataset(folder / "s");
  EXPECT_EQ(dataset->format(), "images");
  EXPECT_EQ(dataset->size(), 3u);
  EXPECT_EQ(dataset->stamp_ns(2), 500000000);
  EXPECT_EQ(dataset->calibration(Sensor::kMono).camera_height_m, 1.2);
  EXPECT_TRUE(test::same_pixels(dataset->frame(2, Sensor::kMono).image, tiny_grey(8, 6, 10)));
}

TEST(ImageFolder, TakesRightCamerasDepthTimesAndTruth) {
  const TemporaryFolder folder;
  write_images(folder);
  write_images(folder, "s/right/");
  for (const int i : {1, 2, 10}) {
    write_image(folder, "s/depth/" + std::to_string(i) + ".png", tiny_depth(4, 3, 250));
  }
  folder.write("s/times.txt", "1\n2\n4\n");
  folder.write("s/poses.txt",
               "1 0 0 0 0 1 0 0 0 0 1 0\n1 0 0 7 0 1 0 0 0 0 1 0\n1 0 0 0 0 1 0 0 0 0 1 0\n");
  folder.write("s/calibration.yaml",
               kCalibration +
                   "baseline_m: 0.2\n"
                   "depth:\n  unit_m: 0.01\n  width: 4\n  height: 3\n  fx: 5\n  fy: 5\n  cx: 2\n"
                   "  cy: 1.5\n  sigma_at_1m: 0.02\n"
                   "  T_cam_depth: [1, 0, 0, 0.1, 0, 1, 0, 0, 0, 0, 1, 0]\n");
  const auto dataset = open_dataset(folder / "s");
  EXPECT_THAT(dataset->sensors(), ElementsAre(Sensor::kStereo, Sensor::kRgbd, Sensor::kMono));
  EXPECT_EQ(dataset->calibration(Sensor::kStereo).baseline_m, 0.2);
  const DepthCamera depth = *dataset->calibration(Sensor::kRgbd).depth;
  EXPECT_EQ(depth.camera.width, 4);
  EXPECT_EQ(depth.camera.fx, 5);
  EXPECT_EQ(depth.sigma_at_1m, 0.02);
  EXPECT_EQ(depth.T_cam_depth.translation().x(), 0.1);
  EXPECT_FLOAT_EQ(dataset->frame(0, Sensor::kRgbd).depth.at<float>(0, 0), 2.5f);
  EXPECT_EQ(dataset->stamp_ns(2), 4000000000);
  EXPECT_EQ(dataset->ground_truth()->poses[1].T_world_body->translation().x(), 7);
}

TEST(ImageFolder, UndistortsImagesAndTheDepthRegisteredToThem) {
  const TemporaryFolder folder;
  // A vertical step in image and depth at u = 40: after undistortion both have it at the same
  // place.
  Image image(48, 64, CV_8UC1, cv::Scalar(0)), depth(48, 64, CV_16UC1, cv::Scalar(1000));
  image.colRange(40, 64) = 200;
  depth.colRange(40, 64) = 3000;
  write_image(folder, "s/0.png", image);
  write_image(folder, "s/depth/0.png", depth);
  folder.write("s/calibration.yaml",
               "width: 64\nheight: 48\nfx: 50\nfy: 50\ncx: 31.5\ncy: 23.5\n"
               "distortion:\n  model: radial_tangential\n  coefficients: [-0.2, 0.02, 0, 0]\n");
  const auto dataset = open_dataset(folder / "s");
  const Calibration calibration = dataset->calibration(Sensor::kRgbd);
  EXPECT_EQ(calibration.camera.distortion, Distortion::kNone);
  EXPECT_EQ(calibration.depth->camera.fx, calibration.camera.fx);
  const Frame frame = dataset->frame(0, Sensor::kRgbd);
  for (int v = 1; v < 47; ++v) {  // the border may look just outside the raw image
    for (int u = 1; u < 63; ++u) {
      const float depth_m = frame.depth.at<float>(v, u);
      EXPECT_TRUE(depth_m == 1.0f || depth_m == 3.0f);  // never a mixture of the two
      const int grey = frame.image.at<std::uint8_t>(v, u);
      const bool agree = (grey != 0 || depth_m == 1.0f) && (grey != 200 || depth_m == 3.0f);
      EXPECT_TRUE(agree) << u << " " << v << ": grey " << grey << ", depth " << depth_m;
    }
  }
}

class CalibrationRefuses : public testing::TestWithParam<std::pair<std::string, const char*>> {};

TEST_P(CalibrationRefuses, AndSaysWhereAndWhy) {
  const TemporaryFolder folder;
  write_images(folder);
  folder.write("s/calibration.yaml", GetParam().first);
  EXPECT_THAT(message_of([&] { open_dataset(folder / "s"); }), HasSubstr(GetParam().second));
}

INSTANTIATE_TEST_SUITE_P(
    Faults, CalibrationRefuses,
    testing::Values(
        std::pair{std::string(), "calibration.yaml: width, height: are missing"},
        std::pair{std::string("width: 8\nheight: 6\ncx: 1\ncy: 1\n"),
                  "calibration.yaml: fx, fy: are"},
        std::pair{std::string("width: 8\nheight: 6\nfx: 1\nfy: 1\n"),
                  "calibration.yaml: cx, cy: are"},
        std::pair{kCalibration + "fz: 3\n", "calibration.yaml:7: fz: unknown key"},
        std::pair{kCalibration + "fps: .nan\n", "calibration.yaml:7: fps: expected a number"},
        std::pair{kCalibration + "fps: -1\n", "calibration.yaml:7: fps: '-1' lies outside"},
        std::pair{std::string("width: 1e12\n"), "calibration.yaml:1: width: expected an integer"},
        std::pair{std::string("width: 999999999\n"), "calibration.yaml:1: width: '999999999' lies"},
        std::pair{kCalibration + "distortion: {model: fov}\n",
                  "calibration.yaml:7: distortion.model"},
        std::pair{kCalibration + "distortion: {coefficients: [1, 2, 3, 4]}\n", "model is none"},
        std::pair{kCalibration + "distortion: {model: equidistant, coefficients: [0.1]}\n",
                  "distortion.coefficients: equidistant has 4"},
        std::pair{kCalibration + "distortion: {model: radial_tangential, coefficients: [0.1]}\n",
                  "distortion.coefficients: a radial-tangential lens has 4, 5 or 8"},
        std::pair{kCalibration + "baseline_m: 0.1\ndistortion: {model: radial_tangential, "
                                 "coefficients: [0.1, 0, 0, 0]}\n",
                  "baseline_m: a folder of stereo images must be rectified"},
        std::pair{kCalibration + "baseline_m: 0.1\n", "right: folder of images cannot be read"},
        std::pair{kCalibration + "depth: {fx: 5}\n", "depth: width, height, fx, fy, cx, cy go"},
        std::pair{kCalibration + "depth: {T_cam_depth: [1, 2]}\n", "T_cam_depth: expected 12"},
        std::pair{"width: 9\n" + kCalibration.substr(9), "img1.png: image is 8x6, but 9x6"}));

TEST(ImageFolder, RefusesListsOfDifferentLengths) {
  const TemporaryFolder folder;
  write_images(folder);
  folder.write("s/calibration.yaml", kCalibration);
  folder.write("s/times.txt", "0\n1\n");
  EXPECT_THAT(message_of([&] { open_dataset(folder / "s"); }),
              HasSubstr("times.txt: holds 2 times"));
  folder.write("s/times.txt", "0\n1\n2\n");
  folder.write("s/poses.txt", "1 0 0 0 0 1 0 0 0 0 1 0\n");
  EXPECT_THAT(message_of([&] { open_dataset(folder / "s"); }),
              HasSubstr("poses.txt: holds 1 poses"));
}

/// Five frames of one brightness each, 20 a second; false if this OpenCV writes no MJPG.
bool write_video(const std::string& path) {
  std::vector<Image> frames;
  for (int i = 0; i < 5; ++i) frames.emplace_back(48, 64, CV_8UC3, cv::Scalar::all(40 * i + 20));
  return picture_plugin(path).write_video(path, frames, 20);
}

TEST(ImageFolder, PairsImagesByTheirNumbersOrRefusesThem) {
  const TemporaryFolder folder;
  const auto write_pairs = [&](const std::vector<std::string>& left,
                               const std::vector<std::string>& right) {
    std::filesystem::remove_all(folder / "s");
    for (const std::string& name : left)
      write_image(folder, "s/left/" + name + ".png", tiny_grey(8, 6, 1));
    for (const std::string& name : right)
      write_image(folder, "s/right/" + name + ".png", tiny_grey(8, 6, 2));
    folder.write("s/calibration.yaml", kCalibration + "baseline_m: 0.1\n");
  };
  write_pairs({"l0", "l1", "l2", "l3"}, {"r0", "r1", "r2", "r3"});
  EXPECT_EQ(open_dataset(folder / "s")->size(), 4u);
  // Stamps of two cameras that are triggered together.
  write_pairs({"100.000", "100.100", "100.200"}, {"100.001", "100.099", "100.203"});
  EXPECT_EQ(open_dataset(folder / "s")->size(), 3u);
  // As many, but of other frames.
  write_pairs({"l0", "l1", "l2", "l3"}, {"r0", "r2", "r3", "r4"});
  EXPECT_THAT(message_of([&] { open_dataset(folder / "s"); }),
              HasSubstr("r2.png: would be paired with l1.png"));
  write_pairs({"a", "b"}, {"c", "d"});
  EXPECT_EQ(open_dataset(folder / "s")->size(), 2u);
}

TEST(ImageFolder, RectifiesAPairThatKalibrCalibrated) {
  const TemporaryFolder folder;
  for (int i = 0; i < 3; ++i) {
    const std::string name = std::to_string(i) + ".png";
    write_image(folder, "s/left/" + name, tiny_grey(64, 48, i));
    write_image(folder, "s/right/" + name, tiny_grey(64, 48, i));
  }
  const std::string camera =
      "  camera_model: pinhole\n  distortion_coeffs: [-0.1, 0.01, 0.0, 0.0]\n"
      "  distortion_model: radtan\n  intrinsics: [60, 60, 31.5, 23.5]\n  resolution: [64, 48]\n";
  folder.write("s/calibration.yaml", "cam0:\n" + camera + "cam1:\n" + camera +
                                         "  T_cn_cnm1:\n  - [1, 0, 0, -0.2]\n  - [0, 1, 0, 0]\n"
                                         "  - [0, 0, 1, 0]\n  - [0, 0, 0, 1]\n");
  const auto dataset = open_dataset(folder / "s");
  EXPECT_THAT(dataset->sensors(), ElementsAre(Sensor::kStereo, Sensor::kMono));
  EXPECT_NEAR(dataset->calibration(Sensor::kStereo).baseline_m, 0.2, 1e-9);
  EXPECT_EQ(dataset->frame(1, Sensor::kStereo).right.cols, 64);
  // Without the right eye's images the same file is one camera.
  std::filesystem::remove_all(folder / "s/right");
  EXPECT_THAT(open_dataset(folder / "s")->sensors(), ElementsAre(Sensor::kMono));
  // An eye that is not to the right is told.
  for (int i = 0; i < 3; ++i)
    write_image(folder, "s/right/" + std::to_string(i) + ".png", tiny_grey(64, 48, i));
  folder.write("s/calibration.yaml", "cam0:\n" + camera + "cam1:\n" + camera +
                                         "  T_cn_cnm1:\n  - [1, 0, 0, 0.2]\n  - [0, 1, 0, 0]\n"
                                         "  - [0, 0, 1, 0]\n  - [0, 0, 0, 1]\n");
  EXPECT_THAT(message_of([&] { open_dataset(folder / "s"); }), HasSubstr("calibration.yaml"));
}

TEST(ImageFolder, RotatesTheTruthWithTheRectifiedCamera) {
  const TemporaryFolder folder;
  // Eyes that are rolled against each other by 0.05 rad: truth turns with the left one.
  for (const char* image_path : {"s/left/0.png", "s/right/0.png"})
    write_image(folder, image_path, tiny_grey(64, 48, 1));
  const std::string cam =
      "  camera_model: pinhole\n  intrinsics: [50, 50, 31.5, 23.5]\n  resolution: [64, 48]\n";
  const auto chain = [&](const std::string& x) {
    return "cam0:\n" + cam + "cam1:\n" + cam + "  T_cn_cnm1:\n  - [0.99875026, -0.04997917, 0, " +
           x + "]\n  - [0.04997917, 0.99875026, 0, 0]\n  - [0, 0, 1, 0]\n  - [0, 0, 0, 1]\n";
  };
  folder.write("s/poses.txt", "1 0 0 7 0 1 0 0 0 0 1 0\n");
  folder.write("s/calibration.yaml", chain("-0.1"));
  const auto dataset = open_dataset(folder / "s");
  EXPECT_NEAR(dataset->calibration(Sensor::kStereo).baseline_m, 0.1, 1e-9);
  EXPECT_FALSE(dataset->frame(0, Sensor::kStereo).right.empty());
  const auto& truth = *dataset->ground_truth()->poses[0].T_world_body;
  // The rectified rows follow the baseline, which lies at -R^T t: turned by -0.05 about z.
  EXPECT_NEAR(truth.linear()(0, 0), std::cos(0.05), 1e-6);
  EXPECT_NEAR(truth.linear()(1, 0), -std::sin(0.05), 1e-6);
  EXPECT_EQ(truth.translation().x(), 7);

  folder.write("s/calibration.yaml", chain("0.1"));
  EXPECT_THAT(message_of([&] { open_dataset(folder / "s"); }),
              HasSubstr("calibration.yaml: stereo: the right camera is not to the right"));
}

TEST(VideoFile, HandsOutItsFramesInAnyOrder) {
  const TemporaryFolder folder;
  if (!write_video(folder / "drive.avi")) GTEST_SKIP() << "this OpenCV writes no MJPG videos";
  const std::string size = "width: 64\nheight: 48\nfx: 50\nfy: 50\ncx: 31.5\ncy: 23.5\n";
  for (const char* yaml : {"drive.yaml", "drive.avi.yaml"}) {
    folder.write(yaml, size);
    const auto dataset = open_dataset(folder / "drive.avi");
    std::filesystem::remove(folder / yaml);
    EXPECT_EQ(dataset->name(), "drive");
    EXPECT_EQ(dataset->format(), "video");
    EXPECT_EQ(dataset->size(), 5u);
    EXPECT_EQ(dataset->stamp_ns(1), 50000000);
    for (const std::size_t i : {std::size_t{3}, std::size_t{0}, std::size_t{4}, std::size_t{4}}) {
      const Frame frame = dataset->frame(i, Sensor::kMono);
      EXPECT_EQ(frame.id, FrameId(i));
      EXPECT_EQ(frame.colour.type(), CV_8UC3);
      EXPECT_NEAR(cv::mean(frame.image)[0], 40.0 * static_cast<double>(i) + 20, 3);  // JPEG
    }
  }
}

TEST(VideoFile, IsRefusedWithoutCalibrationOfAnotherSizeOrUnreadable) {
  const TemporaryFolder folder;
  if (!write_video(folder / "drive.avi")) GTEST_SKIP() << "this OpenCV writes no MJPG videos";
  const auto message = [&](const char* name) {
    return message_of([&] { open_dataset(folder / name); });
  };
  EXPECT_THAT(message("drive.avi"),
              HasSubstr("drive.avi: a video needs its calibration beside it"));
  folder.write("drive.yaml", "width: 9\n" + kCalibration.substr(9));
  EXPECT_THAT(message("drive.avi"), HasSubstr("drive.avi: image is 64x48, but 9x6 is expected"));
  folder.write("drive.yaml", kCalibration + "baseline_m: 1\n");
  EXPECT_THAT(message("drive.avi"), HasSubstr("drive.yaml: baseline_m: a video has one camera"));
  folder.write("text.avi", "no video");
  folder.write("text.yaml", kCalibration);
  EXPECT_THAT(message("text.avi"), HasSubstr("text.avi: is not a readable video"));
}

}  // namespace image_folder_test
}  // namespace placegraph
