#include <gtest/gtest.h>
#include <placegraph/frontend/markers/marker_detector.h>
#include <placegraph/frontend/markers/square_fit.h>
#include <placegraph/graph/core/error.h>

#include "tests/support/message_of.h"
#include "tests/support/scenes/marker_scene.h"
#include "tests/support/seed.h"

namespace placegraph {
namespace marker_detector_test {

using namespace test;

MarkerScene scene_with(std::vector<PlacedMarker> markers, const char* dictionary = "aruco_4x4_50") {
  MarkerScene scene;
  scene.camera = MarkerScene::usual_camera();
  scene.layout.dictionary = dictionary;
  scene.layout.markers = std::move(markers);
  scene.samples = 3;
  return scene;
}

SquareCorners truth(const MarkerScene& scene, int marker, const SE3& T_world_cam) {
  SquareCorners corners;
  const PlacedMarker& placed = scene.layout.markers[marker];
  for (int k = 0; k < 4; ++k)
    corners[k] = *scene.camera.project(T_world_cam.inverse() * placed.T_world_marker *
                                       placed.corners_marker()[k]);
  return corners;
}

double worst_px(const MarkerObservation& observation, const SquareCorners& corners) {
  double worst = 0;
  for (int k = 0; k < 4; ++k)
    worst = std::max(worst, (observation.corners_px[k] - corners[k]).norm());
  return worst;
}

TEST(MarkerDetector, FindsCornersBelowATenthOfAPixelInTheOrderOfAReader) {
  Random random = seeded_random(1);
  const MarkerScene scene = scene_with({{7, 0.2, SE3()}});
  const SE3 T = looking_at_origin(1, 0.5, 0.3, 1.1);
  const auto found = MarkerDetector({}, scene.layout.dictionary).detect(scene.render(T, random));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].id, 7);
  EXPECT_NEAR(found[0].contrast, 180, 20);  // white less black of the scene
  EXPECT_LT(worst_px(found[0], truth(scene, 0, T)), 0.1);
  for (int k = 0; k < 4; ++k) EXPECT_LT(found[0].corner_covariance(k).trace(), 0.1 * 0.1);
}

TEST(MarkerDetector, FollowsTheBendOfALens) {
  Random random = seeded_random(2);
  MarkerScene scene = scene_with({{3, 0.4, SE3()}});
  scene.camera.distortion = Distortion::kRadialTangential;
  scene.camera.coefficients = {-0.28, 0.07, 0, 0, 0};
  const SE3 T = looking_at_origin(0.7, 0.1, 0.3, 0.2);
  const Image image = scene.render(T, random);
  const MarkerDetector detector({}, scene.layout.dictionary);
  const auto straight = detector.detect(image), bent = detector.detect(image, &scene.camera);
  ASSERT_EQ(bent.size(), 1u);
  EXPECT_LT(worst_px(bent[0], truth(scene, 0, T)), 0.1);
  if (!straight.empty()) {
    EXPECT_GT(worst_px(straight[0], truth(scene, 0, T)), 0.3);
  }
}

TEST(MarkerDetector, FindsNearWhatIsExpectedTheSameAsInTheWholeImage) {
  Random random = seeded_random(3);
  const MarkerScene scene =
      scene_with({{1, 0.15, SE3(SO3(), {-0.2, 0, 0})}, {2, 0.15, SE3(SO3(), {0.2, 0.1, 0})}});
  const SE3 T = looking_at_origin(1, 0.2, 0.3, 0.4);
  const Image image = scene.render(T, random);
  const MarkerDetector detector({}, scene.layout.dictionary);
  const auto whole = detector.detect(image);
  ASSERT_EQ(whole.size(), 2u);
  SquareCorners expected = truth(scene, 1, T);
  for (Eigen::Vector2d& corner : expected) corner += Eigen::Vector2d(8, -5);
  const auto near = detector.detect_near(image, {{expected}, {expected}});
  ASSERT_EQ(near.size(), 1u);
  EXPECT_EQ(near[0].id, 2);
  for (int k = 0; k < 4; ++k)
    EXPECT_LT((near[0].corners_px[k] - whole[1].corners_px[k]).norm(), 0.05);
  EXPECT_TRUE(detector.detect_near(image, {}).empty());
  for (Eigen::Vector2d& corner : expected) corner += Eigen::Vector2d(5000, 0);
  EXPECT_TRUE(detector.detect_near(image, {{expected}}).empty());
}

TEST(MarkerDetector, SeesNothingInNoise) {
  Random random = seeded_random(4);
  MarkerScene scene = scene_with({});
  scene.noise = 30;
  EXPECT_TRUE(MarkerDetector({}, "apriltag_36h11").detect(scene.render(SE3(), random)).empty());
}

TEST(MarkerDetector, NamesWhatItDoesNotTake) {
  EXPECT_NE(
      message_of<ArgumentError>([] { MarkerDetector({}, "aruco_9x9"); }).find("apriltag_36h11"),
      std::string::npos);
  MarkerDetectorOptions options;
  options.square.reach_px = 0;
  EXPECT_THROW(MarkerDetector(options, "aruco_4x4_50"), ArgumentError);
  EXPECT_THROW((void)MarkerDetector({}, "aruco_4x4_50").detect(Image()), ArgumentError);
}

TEST(MarkerDictionary, DrawsMarkersOfEveryFamily) {
  for (const std::string& name : marker_dictionaries()) {
    const Image picture = marker_picture(name, 0, 2);
    EXPECT_EQ(picture.cols, 2 * (marker_family(name).bits_per_side + 2)) << name;
    EXPECT_EQ(picture.at<std::uint8_t>(0, 0), 0) << name;
  }
}

TEST(SquareFit, RefusesWhatHasNoSides) {
  const Image plain(100, 100, CV_8UC1, cv::Scalar(90));
  const SquareCorners corners{{{20, 20}, {60, 20}, {60, 60}, {20, 60}}};
  EXPECT_FALSE(fit_square(plain, corners, 0.2, {}));
  Image bright = plain.clone();  // a bright square on a dark ground is none
  bright(cv::Rect(20, 20, 41, 41)) = 200;
  EXPECT_FALSE(fit_square(bright, corners, 0.2, {}));
  Image dark = plain.clone();
  dark(cv::Rect(20, 20, 41, 41)) = 10;
  const auto fit = fit_square(dark, corners, 0.2, {});
  ASSERT_TRUE(fit);
  // The square's pixels reach half a pixel beyond the centres of the outermost.
  EXPECT_LT((fit->corners_px[0] - Eigen::Vector2d(19.5, 19.5)).norm(), 0.02);
  EXPECT_LT((fit->corners_px[2] - Eigen::Vector2d(60.5, 60.5)).norm(), 0.02);
}

}  // namespace marker_detector_test
}  // namespace placegraph
