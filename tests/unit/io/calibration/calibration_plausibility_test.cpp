#include <placegraph/io/calibration/calibration_plausibility.h>

#include "tests/support/message_of.h"

namespace placegraph {
namespace calibration_plausibility_test {

using test::message_of;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

Camera camera_of(int width, int height, double f, double cx, double cy) {
  return {width, height, f, f, cx, cy, Distortion::kNone, {}};
}

Camera lens(std::array<double, 5> coefficients, Distortion model = Distortion::kRadialTangential) {
  return {320, 240, 262.5, 262.5, 159.5, 119.5, model, coefficients};
}

std::vector<std::string> texts(const Calibration& calibration);

std::vector<std::string> texts(const Camera& camera) {
  Calibration calibration;
  calibration.camera = camera;
  return texts(calibration);
}

std::vector<std::string> texts(const Calibration& calibration) {
  std::vector<std::string> result;
  for (const DataNote& note : odd_calibration(calibration)) {
    EXPECT_TRUE(note.doubts_scale) << note.text;
    result.push_back(note.text);
  }
  return result;
}

TEST(OddCalibration, IsThatOfImagesOfAnotherSize) {
  EXPECT_THAT(
      texts(camera_of(620, 188, 706, 601, 183)),
      ElementsAre(HasSubstr("for images of about 1202x366; scale fx, fy, cx and cy by 0.516")));
  EXPECT_THAT(texts(camera_of(2482, 752, 706, 601, 183)), ElementsAre(HasSubstr("about 1202x366")));
  EXPECT_THAT(texts(camera_of(640, 480, 500, 320, -20)),
              ElementsAre(HasSubstr("for other images?")));
  // Cropped images have their principal point off the middle.
  EXPECT_THAT(texts(camera_of(400, 188, 353, 300, 91)), IsEmpty());
  EXPECT_THAT(texts(camera_of(320, 240, 500, 320, 120)), IsEmpty());
}

TEST(OddCalibration, HasLengthsThatAreNoMetres) {
  Calibration calibration;
  calibration.camera = camera_of(640, 480, 500, 320, 240);
  for (const double right : {0.03, 0.54, 1.2}) {
    calibration.baseline_m = right;
    EXPECT_THAT(texts(calibration), IsEmpty()) << right;
  }
  for (const double wrong : {10.0, 26.25, 100.0, 1e-4}) {
    calibration.baseline_m = wrong;
    EXPECT_THAT(texts(calibration), ElementsAre(HasSubstr("a baseline of "))) << wrong;
  }
  calibration.baseline_m = 0;
  calibration.camera_height_m = 165;
  EXPECT_THAT(texts(calibration), ElementsAre(HasSubstr("a camera height of 165 m")));
  calibration.camera_height_m = 1.65;
  calibration.depth = DepthCamera{calibration.camera, SE3(SO3(), {25, 0, 0}), 0.005};
  EXPECT_THAT(texts(calibration),
              ElementsAre(HasSubstr("the depth camera is 25 m from the camera")));
}

TEST(PlausibleCamera, HasALensThatIsMonotonicWithinTheImage) {
  const auto refusal = [](const Camera& camera) {
    return message_of([&] { (void)undistort_plausibly("c.yaml", camera); });
  };
  EXPECT_THAT(refusal(lens({8.27, -627.8, -0.065, 0.0136, -3.28})),
              HasSubstr("c.yaml: distortion: the lens model is not monotonic beyond "));
  EXPECT_THAT(refusal(lens({-0.8, 0, 0, 0, 0})), HasSubstr("not monotonic beyond 113 px"));
  EXPECT_THAT(refusal(lens({-1.5, 0, 0, 0, 0})), HasSubstr("not monotonic"));
  EXPECT_THAT(refusal(lens({-2, 0, 0, 0, 0}, Distortion::kEquidistant)),
              HasSubstr("not monotonic"));
  EXPECT_THAT(refusal(lens({30, 0, 0, 0, 0})), HasSubstr("% of the image remain"));
  EXPECT_THAT(refusal(lens({5, 900, 0, 0, 0})), HasSubstr("% of the image remain"));
}

TEST(PlausibleCamera, MayHaveAStrongLens) {
  for (const Camera& sound :
       {lens({-0.3, 0.1, 0, 0, 0}), lens({-0.28, 0.074, 0, 0, 0}), lens({0.26, -0.95, 0, 0, 1.16}),
        lens({-0.01, 0.04, -0.04, 0.01, 0}, Distortion::kEquidistant)})
    EXPECT_NO_THROW((void)undistort_plausibly("c.yaml", sound));
}

TEST(PlausibleCamera, MayHaveARationalLensThatIsMonotonicWithinTheImage) {
  RawCamera raw(lens({0, 0, 0, 0, 0}));
  // r / (1 + k4 r^2) comes to 1 / (2 sqrt(k4)) and turns back.
  set_radial_tangential({0, 0, 0, 0, 0, 0.1, 0, 0}, raw);
  EXPECT_NO_THROW((void)undistort_plausibly("c.yaml", raw));
  set_radial_tangential({0, 0, 0, 0, 0, 2, 0, 0}, raw);
  EXPECT_THAT(message_of([&] { (void)undistort_plausibly("c.yaml", raw); }),
              HasSubstr("c.yaml: distortion: the lens model is not monotonic beyond "));
}

TEST(PlausibleCamera, HasNoNormalizedIntrinsics) {
  EXPECT_THAT(
      message_of([] { require_plausible_camera("c.yaml", camera_of(640, 480, 0.8, 0.5, 0.5)); }),
      HasSubstr("c.yaml: fx, fy: 0.8, 0.8 are no focal lengths [px] of a 640x480 image"));
}

}  // namespace calibration_plausibility_test
}  // namespace placegraph
