#include <placegraph/io/calibration/foreign_calibration.h>
#include <placegraph/io/calibration/rectification.h>

#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"

namespace placegraph {
namespace foreign_calibration_test {

using test::message_of;
using test::TemporaryFolder;
using testing::HasSubstr;

struct Foreign {
  const char* program;
  const char* file;
  const char* text;
};

void PrintTo(const Foreign& foreign, std::ostream* out) { *out << foreign.program; }

class ForeignCalibrations : public testing::TestWithParam<Foreign> {};

/// All say the same camera: 320x240, fx 262, fy 263, principal point (159, 119), k1 -0.1.
TEST_P(ForeignCalibrations, AreRead) {
  const TemporaryFolder folder;
  const auto read = read_foreign_calibration(folder.write(GetParam().file, GetParam().text));
  ASSERT_TRUE(read);
  EXPECT_EQ(read->program, GetParam().program);
  const Camera& camera = read->raw.camera;
  EXPECT_EQ(camera.width, 320);
  EXPECT_EQ(camera.height, 240);
  EXPECT_EQ(camera.fx, 262);
  EXPECT_EQ(camera.fy, 263);
  EXPECT_EQ(camera.cx, 159);
  EXPECT_EQ(camera.cy, 119);
  EXPECT_EQ(camera.distortion, Distortion::kRadialTangential);
  EXPECT_EQ(camera.coefficients[0], -0.1);
}

INSTANTIATE_TEST_SUITE_P(
    Programs, ForeignCalibrations,
    testing::Values(
        Foreign{"OpenCV", "c.yaml",
                "%YAML:1.0\n---\nimage_width: 320\nimage_height: 240\n"
                "camera_matrix: !!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d\n"
                "   data: [ 262., 0., 159., 0., 263., 119., 0., 0., 1. ]\n"
                "distortion_coefficients: !!opencv-matrix\n   rows: 1\n   cols: 5\n   dt: d\n"
                "   data: [ -0.1, 0., 0., 0., 0. ]\n"},
        Foreign{"ROS", "c.yaml",
                "image_width: 320\nimage_height: 240\ncamera_name: a\n"
                "camera_matrix: {rows: 3, cols: 3, data: [262, 0, 159, 0, 263, 119, 0, 0, 1]}\n"
                "distortion_model: rational_polynomial\n"
                "distortion_coefficients: {rows: 1, cols: 8, data: [-0.1, 0, 0, 0, 0, 0, 0, 0]}\n"},
        Foreign{"Kalibr", "c.yaml",
                "cam0:\n  camera_model: pinhole\n  distortion_coeffs: [-0.1, 0, 0, 0]\n"
                "  distortion_model: radtan\n  intrinsics: [262, 263, 159, 119]\n"
                "  resolution: [320, 240]\n"},
        Foreign{"ORB-SLAM", "c.yaml",
                "%YAML:1.0\nCamera.type: \"PinHole\"\nCamera.fx: 262.\nCamera.fy: 263.\n"
                "Camera.cx: 159.\nCamera.cy: 119.\nCamera.k1: -0.1\nCamera.width: 320\n"
                "Camera.height: 240\nCamera.bf: 40.0\n"},
        Foreign{
            "RealSense", "c.json",
            "{\"color\": {\"width\": 320, \"height\": 240, \"fx\": 262, \"fy\": 263, \"ppx\": 159, "
            "\"ppy\": 119, \"model\": \"Brown Conrady\", \"coeffs\": [-0.1, 0, 0, 0, 0]}}\n"},
        Foreign{"COLMAP", "cameras.txt",
                "# Camera list\n1 OPENCV 320 240 262 263 159.5 119.5 -0.1 0 0 0\n"}));

TEST(ForeignCalibration, OfEightCoefficientsIsRational) {
  const TemporaryFolder folder;
  const std::string path =
      folder.write("c.yaml",
                   "image_width: 320\nimage_height: 240\n"
                   "camera_matrix: [262, 0, 159, 0, 263, 119, 0, 0, 1]\n"
                   "distortion_coefficients: [0.4, 0.1, 0.001, 0.002, 0.01, 0.7, 0.2, 0.03]\n");
  const auto read = read_foreign_calibration(path);
  ASSERT_TRUE(read);
  EXPECT_TRUE(read->raw.is_rational());
  EXPECT_EQ(read->raw.denominator[1], 0.2);
  // Pixels of the undistorted image come from where OpenCV's model says.
  const UndistortedCamera undistorted = undistort_camera(read->raw);
  for (const auto& [u, v] : {std::pair(20, 30), std::pair(160, 200), std::pair(300, 10)}) {
    const Camera& ideal = undistorted.camera;
    const double x = (u - ideal.cx) / ideal.fx, y = (v - ideal.cy) / ideal.fy, r2 = x * x + y * y;
    const double radial =
        (1 + r2 * (0.4 + r2 * (0.1 + r2 * 0.01))) / (1 + r2 * (0.7 + r2 * (0.2 + r2 * 0.03)));
    const double xd = x * radial + 2 * 0.001 * x * y + 0.002 * (r2 + 2 * x * x);
    const double yd = y * radial + 0.001 * (r2 + 2 * y * y) + 2 * 0.002 * x * y;
    EXPECT_NEAR(undistorted.remap.map_x.at<float>(v, u), 262 * xd + 159, 1e-3);
    EXPECT_NEAR(undistorted.remap.map_y.at<float>(v, u), 263 * yd + 119, 1e-3);
  }
}

TEST(ForeignCalibration, OfTwoCamerasHasARightCameraIfAskedFor) {
  const TemporaryFolder folder;
  const std::string camera =
      "  camera_model: pinhole\n  distortion_coeffs: [-0.1, 0.0, 0.0, 0.0]\n"
      "  distortion_model: radtan\n  intrinsics: [262, 263, 159, 119]\n  resolution: [320, 240]\n";
  const std::string kalibr =
      folder.write("camchain.yaml", "cam0:\n" + camera + "cam1:\n" + camera +
                                        "  T_cn_cnm1:\n  - [1, 0, 0, -0.12]\n  - [0, 1, 0, 0]\n"
                                        "  - [0, 0, 1, 0]\n  - [0, 0, 0, 1]\n");
  EXPECT_FALSE(read_foreign_calibration(kalibr)->right);
  const std::string opencv =
      folder.write("stereo.yaml",
                   "K1: [262, 0, 159, 0, 263, 119, 0, 0, 1]\nD1: [-0.1, 0, 0, 0, 0]\n"
                   "K2: [262, 0, 159, 0, 263, 119, 0, 0, 1]\nD2: [-0.1, 0, 0, 0, 0]\n"
                   "R: [1, 0, 0, 0, 1, 0, 0, 0, 1]\nT: [-0.12, 0, 0]\n");
  for (const std::string& path : {kalibr, opencv}) {
    const auto read = read_foreign_calibration(path, true);
    ASSERT_TRUE(read && read->right) << path;
    EXPECT_NEAR(read->right->T_left_right.translation().x(), 0.12, 1e-12);
    EXPECT_EQ(read->right->raw.camera.coefficients[0], -0.1);
  }
}

TEST(ForeignCalibration, IsNoneOfTheProgramsOwnForm) {
  const TemporaryFolder folder;
  EXPECT_FALSE(read_foreign_calibration(folder.write("c.yaml", "width: 8\nheight: 6\nfx: 10\n")));
  EXPECT_FALSE(read_foreign_calibration(folder.write("c.txt", "10 10 4 3 8 6\n")));
}

TEST(ForeignCalibration, NamesTheLineOfWhatIsNotKnown) {
  const TemporaryFolder folder;
  const auto refusal = [&](const char* file, const std::string& text) {
    const std::string path = folder.write(file, text);
    return message_of([&] { (void)read_foreign_calibration(path); });
  };
  EXPECT_THAT(refusal("c.yaml", "cam0:\n  camera_model: omni\n"),
              HasSubstr("c.yaml:2: Kalibr's calibration: camera_model: 'omni' is not supported"));
  EXPECT_THAT(refusal("c.yaml", "K: [1, 2]\n"), HasSubstr("c.yaml:1: OpenCV's calibration: "));
  EXPECT_THAT(refusal("c.yaml", "K: [9, 0, 4, 0, 9, 3, 0, 0, 1]\nD: [.1, 0, 0, 0, 0, .2]\n"),
              HasSubstr("c.yaml:2: OpenCV's calibration: a radial-tangential lens has 4, 5 or 8"));
  EXPECT_THAT(refusal("c.yaml",
                      "K: [9, 0, 4, 0, 9, 3, 0, 0, 1]\n"
                      "D: [.1, 0, 0, 0, 0, 0, 0, 0, .01, 0, 0, 0]\n"),
              HasSubstr("not 12 (thin prism"));
  EXPECT_THAT(refusal("cameras.txt", "1 FOV 320 240 1 2 3 4 5\n"),
              HasSubstr("cameras.txt:1: COLMAP's calibration: the model 'FOV' is unknown"));
}

const std::string kCam0 = "cam0:\n  camera_model: pinhole\n  intrinsics: [262, 263, 159, 119]\n";
const std::string kCam1 = "cam1:\n  camera_model: pinhole\n  intrinsics: [260, 261, 158, 118]\n";

TEST(ForeignCalibration, TakesTheRotationOfOpenCVAsMatrixOrVector) {
  const TemporaryFolder folder;
  const std::string kitti_cameras =
      "K1: [262, 0, 159, 0, 263, 119, 0, 0, 1]\nD1: [-0.1, 0, 0, 0, 0]\n"
      "K2: [260, 0, 158, 0, 261, 118, 0, 0, 1]\nD2: [-0.2, 0, 0, 0, 0]\n";
  for (const char* R : {"R: [0, -1, 0, 1, 0, 0, 0, 0, 1]\n", "R: [0, 0, 1.5707963267948966]\n"}) {
    const auto read = read_foreign_calibration(
        folder.write("c.yaml", kitti_cameras + R + "T: [-0.1, 0, 0]\n"), true);
    ASSERT_TRUE(read && read->right);
    EXPECT_EQ(read->raw.camera.coefficients[0], -0.1);
    EXPECT_EQ(read->right->raw.camera.coefficients[0], -0.2);
    // p_right = R p_left + T by hand: the right eye's origin is at -R^T T.
    EXPECT_LT((read->right->T_left_right.translation() - Eigen::Vector3d(0, -0.1, 0)).norm(),
              1e-12);
  }
}

TEST(ForeignCalibration, NamesWhatTheRightCameraLacks) {
  const TemporaryFolder folder;
  const auto refusal = [&](const std::string& text) {
    const std::string path = folder.write("c.yaml", text);
    return message_of([&] { (void)read_foreign_calibration(path, true); });
  };
  EXPECT_THAT(refusal(kCam0 + kCam1), HasSubstr("Kalibr's calibration: T_cn_cnm1: is missing"));
  EXPECT_THAT(refusal(kCam0 + kCam1 + "  T_cn_cnm1: [1, 0, 0]\n"),
              HasSubstr("T_cn_cnm1: expected 16 numbers, found 3"));
  const std::string K1 = "K1: [262, 0, 159, 0, 263, 119, 0, 0, 1]\n";
  EXPECT_THAT(refusal(K1), HasSubstr("OpenCV's calibration: K2: is missing"));
  const std::string K2 = "K2: [262, 0, 159, 0, 263, 119, 0, 0, 1]\n";
  EXPECT_THAT(refusal(K1 + K2), HasSubstr("R, T: are missing"));
  EXPECT_THAT(refusal(K1 + K2 + "R: [2, 0, 0, 0, 2, 0, 0, 0, 2]\nT: [-0.1, 0, 0]\n"),
              HasSubstr("c.yaml:3: OpenCV's calibration: rotation: the matrix is"));
}

}  // namespace foreign_calibration_test
}  // namespace placegraph
