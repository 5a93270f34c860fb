#include <gtest/gtest.h>
#include <placegraph/pipeline/lens_correction.h>

#include <cmath>
#include <opencv2/core.hpp>

#include "tests/support/scenes/scene.h"
#include "tests/support/seed.h"

namespace placegraph {
namespace lens_correction_test {

/// What tracks show of a lens: clear, from three stretches of motion, unless changed.
LensDistortion seen_of(double k1, double sigma_k1 = 0.001) {
  LensDistortion seen;
  seen.k1 = k1;
  seen.sigma_k1 = sigma_k1;
  seen.effect = 1;
  seen.stretches = 3;
  return seen;
}

Calibration calibration() {
  Calibration calibration;
  calibration.camera = test::pinhole(160, 120, 130);
  return calibration;
}

TEST(RunLens, CountsAsDistortedWhatIsLargeClearAndSeenTwice) {
  const LensOptions options;
  EXPECT_FALSE(is_clear(LensDistortion(), options));  // before the first estimate
  EXPECT_TRUE(is_distorted(seen_of(-0.1), options));
  LensDistortion seen = seen_of(-0.1, 0.1 / options.min_sigmas * 1.01);
  EXPECT_FALSE(is_clear(seen, options));
  seen = seen_of(0.1);
  seen.effect = options.min_effect;
  EXPECT_FALSE(is_clear(seen, options));
  seen = seen_of(0.1);
  seen.stretches = 1;
  EXPECT_TRUE(is_clear(seen, options));
  EXPECT_FALSE(is_distorted(seen, options));
  LensOptions off;
  off.enabled = false;
  EXPECT_FALSE(is_clear(seen_of(0.1), off));
}

TEST(RunLens, TheSignOfALensDoesNotMatterToARestart) {
  Random random = test::seeded_random(21);
  int restarts = 0, undone = 0;
  for (int trial = 0; trial < 500; ++trial) {
    const int pass = random.index(3);
    const double removed = pass == 0 ? 0 : random.uniform(-0.3, 0.3);
    const LensDistortion seen =
        seen_of(random.uniform(-0.3, 0.3), std::pow(10, random.uniform(-4, -1)));
    LensDistortion mirrored = seen;
    mirrored.k1 = -seen.k1;
    const auto change = change_of_k1(removed, seen, pass, {}),
               other = change_of_k1(-removed, mirrored, pass, {});
    ASSERT_EQ(change.has_value(), other.has_value());
    if (!change) continue;
    ++restarts;
    EXPECT_EQ(*change, -*other);
    EXPECT_LT(pass, 2);  // a run begins again twice at most
    if (*change == seen.k1) continue;
    ++undone;  // wholly, and only what the rest contradicts by half
    EXPECT_EQ(removed + *change, 0);
    EXPECT_LT(std::abs(removed + seen.k1), 0.5 * std::abs(removed));
  }
  EXPECT_GE(restarts, 100);
  EXPECT_GE(undone, 10);
}

TEST(RunLens, ARefinementNeedsATenthOfWhatWasRemoved) {
  EXPECT_EQ(change_of_k1(-0.2, seen_of(-0.03), 1, {}), -0.03);
  EXPECT_FALSE(change_of_k1(-0.2, seen_of(-0.019), 1, {}));
  EXPECT_FALSE(change_of_k1(-0.2, seen_of(-0.03, 0.021), 1, {}));  // 1.4 standard deviations
  EXPECT_FALSE(change_of_k1(0, seen_of(-0.03), 1, {}));
  LensOptions off;
  off.enabled = false;
  EXPECT_FALSE(change_of_k1(-0.2, seen_of(-0.03), 1, off));
}

TEST(RunLens, TheNoteTellsTheWholeDistortionAndWhatWasRemoved) {
  const std::string some = distortion_note(-0.1, seen_of(-0.02)).text;
  EXPECT_NE(some.find("k1 = -0.1200 +- 0.0010; -0.1000 of it"), std::string::npos) << some;
  const std::string none = distortion_note(0, seen_of(-0.02)).text;
  EXPECT_NE(none.find("none of it was removed"), std::string::npos) << none;
}

TEST(RunLens, WithoutADistortionImagesAndCalibrationStay) {
  LensCorrection lens(calibration());
  lens.add(-0.2);
  EXPECT_EQ(lens.k1(), -0.2);
  lens.reset();
  EXPECT_EQ(lens.k1(), 0);
  EXPECT_EQ(lens.calibration().camera.fx, 130);
  const Image image(120, 160, CV_8UC1, cv::Scalar(7));
  EXPECT_EQ(lens.corrected(image).data, image.data);  // not even a copy
  EXPECT_EQ(lens.mask_as_taken(image).data, image.data);
}

TEST(RunLens, DistortionsThatAreAddedAreOne) {
  LensCorrection twice(calibration()), once(calibration());
  twice.add(-0.25);
  twice.add(0.125);
  once.add(-0.125);
  const Camera a = twice.calibration().camera, b = once.calibration().camera;
  EXPECT_EQ(a.K(), b.K());
  EXPECT_EQ(a.distortion, Distortion::kNone);
}

TEST(RunLens, ACorrectedImageShowsWhatItsCalibrationSays) {
  // Grey values that are linear in the direction of the ray, as the distorted lens takes them.
  const auto grey = [](const Eigen::Vector3d& ray) { return 128 + 90 * ray[0] + 60 * ray[1]; };
  for (const double k1 : {-0.2, 0.15}) {
    LensCorrection lens(calibration());
    lens.add(k1);
    Camera taken_by = calibration().camera;
    taken_by.distortion = Distortion::kRadialTangential;
    taken_by.coefficients = {k1};
    Frame frame;
    frame.image = Image(120, 160, CV_8UC1);
    frame.mask = Image(120, 160, CV_8UC1, cv::Scalar(255));
    for (int v = 0; v < 120; ++v)
      for (int u = 0; u < 160; ++u) {
        const Eigen::Vector3d ray = *taken_by.unproject({u, v});
        frame.image.at<std::uint8_t>(v, u) = static_cast<std::uint8_t>(std::lround(grey(ray)));
        if (ray[0] > 0) frame.mask.at<std::uint8_t>(v, u) = 0;
      }
    lens.apply(frame);
    const Camera camera = lens.calibration().camera;
    int wrong = 0;
    for (int v = 2; v < 118; ++v)
      for (int u = 2; u < 158; ++u) {
        const Eigen::Vector3d ray = *camera.unproject({u, v});
        wrong += std::abs(frame.image.at<std::uint8_t>(v, u) - grey(ray)) > 1.2;  // rounded twice
        if (std::abs(ray[0]) < 0.01) continue;  // a pixel beside the edge
        wrong += (frame.mask.at<std::uint8_t>(v, u) == 0) != (ray[0] > 0);
      }
    EXPECT_EQ(wrong, 0) << k1;
  }
}

TEST(RunLens, AMaskOfCorrectedImagesMarksTheSamePixelsOfTakenOnes) {
  LensCorrection lens(calibration());
  lens.add(-0.2);
  Image mask(120, 160, CV_8UC1, cv::Scalar(255));
  mask(cv::Rect(30, 20, 40, 60)).setTo(0);
  Frame frame;
  frame.image = Image(120, 160, CV_8UC1, cv::Scalar(0));
  frame.mask = lens.mask_as_taken(mask);
  const double masked = 120 * 160 - cv::countNonZero(frame.mask);
  EXPECT_NE(masked, 40 * 60);  // the lens moves its border
  lens.apply(frame);
  int different = 0;
  for (int v = 5; v < 115; ++v)
    for (int u = 5; u < 155; ++u)
      different += frame.mask.at<std::uint8_t>(v, u) != mask.at<std::uint8_t>(v, u);
  EXPECT_LE(different, 200);  // at most a pixel along its border of 200
}

}  // namespace lens_correction_test
}  // namespace placegraph
