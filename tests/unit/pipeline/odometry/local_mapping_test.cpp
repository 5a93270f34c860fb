#include <gtest/gtest.h>
#include <placegraph/pipeline/odometry/local_mapping.h>

#include "tests/support/scenes/window_world.h"
#include "tests/support/scripted_tracker.h"

namespace placegraph {
namespace local_mapping_test {

using namespace test;
using Calls = std::vector<std::string>;

constexpr double kBaseline_m = 0.5;
constexpr std::int64_t kSecond = 1'000'000'000;

/// Points in a box before a camera that goes sideways and ahead.
std::vector<Eigen::Vector3d> box_of_points() {
  Random random(3);
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 150; ++i)
    points.emplace_back(random.uniform(-4, 7), random.uniform(-2, 2), random.uniform(5, 25));
  return points;
}
SE3 pose_of(int k) {
  return SE3(SO3::exp({0.01 * (k % 3), 0.01 * k, 0}),
             Eigen::Vector3d(0.5 * k, 0.1 * (k % 2), 0.3 * k));
}

struct Mapping {
  StageTimes times;
  OdometryOptions options;
  Calibration calibration;
  ScriptedTracker tracker;
  std::optional<LocalMapping> mapping;
  std::optional<LocalMap> map;

  explicit Mapping(double baseline_m = 0, std::optional<double> height_m = {},
                   const std::string& cues = "points,plane") {
    options.cues = cues;
    options.rectification.prior_sigma_px = 1;
    calibration.camera = window_camera();
    calibration.baseline_m = baseline_m;
    calibration.camera_height_m = height_m;
    mapping.emplace(options, calibration, LogSink(), times);
    map.emplace(options.window, calibration.camera,
                baseline_m > 0 ? Scale::kMetric : Scale::kArbitrary);
  }
  std::optional<LocalMapping::Added> add(int k, const SE3& T_odom_cam) {
    Frame frame;
    frame.id = FrameId(k);
    frame.stamp_ns = k * kSecond;
    return mapping->add(frame, T_odom_cam, tracker, *map);
  }
  /// Observations of the points by the newest keyframe: `seen` is where a point appears. Every
  /// `lifetime` keyframes they are taken for new ones.
  void watch(const std::function<WindowObservation(const Eigen::Vector3d& p_cam,
                                                   const RectificationError&)>& seen,
             std::int64_t lifetime = 100) {
    tracker.observation = [=](const RectificationError& rectification, LocalMap& of) {
      static const std::vector<Eigen::Vector3d> points = box_of_points();
      const std::int64_t first_id = 1000 * (of.newest().value() / lifetime);
      const SE3 T_cam_odom = pose_of(static_cast<int>(of.newest().value())).inverse();
      for (std::size_t i = 0; i < points.size(); ++i) {
        WindowObservation o = seen(T_cam_odom * points[i], rectification);
        o.keyframe = of.newest();
        o.landmark = LandmarkId(first_id + static_cast<std::int64_t>(i));
        if (!of.window().landmark(o.landmark)) of.window().add_landmark(o.landmark, points[i]);
        of.window().add_observation(o);
      }
    };
  }
};

TEST(LocalMapping, AKeyframePassesThroughAllItsSteps) {
  Mapping m;
  const auto added = m.add(4, pose_of(0));
  ASSERT_TRUE(added);
  EXPECT_EQ(added->keyframe.id, KeyframeId(0));
  EXPECT_EQ(added->keyframe.frame.id, FrameId(4));
  EXPECT_EQ(added->posed_again.size(), 1u);
  EXPECT_FALSE(added->rescale);
  EXPECT_EQ(m.tracker.asked, (Calls{"prepare", "observe", "prune", "settle", "finish"}));
  EXPECT_EQ(m.tracker.scales, std::vector<double>{1});
  EXPECT_EQ(m.map->median_depth(), 5);
  EXPECT_LT(distance_m(m.map->pose(KeyframeId(0)), pose_of(0)), 1e-12);
}

TEST(LocalMapping, AFrameThatShowsNothingIsNoKeyframe) {
  Mapping m;
  m.tracker.shows_a_keyframe = false;
  EXPECT_FALSE(m.add(0, SE3()));
  EXPECT_TRUE(m.map->empty());
  EXPECT_EQ(m.tracker.asked, Calls{"prepare"});
}

TEST(LocalMapping, TheWindowKeepsItsSize) {
  Mapping m;
  m.watch([](const Eigen::Vector3d& p_cam, const RectificationError&) {
    WindowObservation o;
    o.px = *window_camera().project(p_cam);
    return o;
  });
  for (int k = 0; k < 14; ++k) ASSERT_TRUE(m.add(k, pose_of(k)));
  EXPECT_EQ(m.map->window().keyframes().size(), 10u);
  EXPECT_EQ(m.map->window_begin(), KeyframeId(4));
  EXPECT_LT(distance_m(m.map->pose(KeyframeId(0)), pose_of(0)),
            1e-6);  // it has left the window, and is kept
}

TEST(LocalMapping, TheWindowIsOptimized) {
  Mapping m;
  m.watch([](const Eigen::Vector3d& p_cam, const RectificationError&) {
    WindowObservation o;
    o.px = *window_camera().project(p_cam);
    return o;
  });
  for (int k = 0; k < 5; ++k)
    (void)m.add(k, pose_of(k) * SE3(SO3::exp({0, 0.004 * k, 0}), Eigen::Vector3d(0, 0.02 * k, 0)));
  // Exact pixels: what is left is the freedom of the map as a whole.
  const SE3 found = m.map->pose(KeyframeId(0)).inverse() * m.map->pose(KeyframeId(4)),
            truth = pose_of(0).inverse() * pose_of(4);
  EXPECT_LT(angle_rad(found, truth), 1e-3);
}

TEST(LocalMapping, AMeasuredScaleIsHandedToTheFramesBetween) {
  Mapping m;
  std::vector<MotionStep> steps;
  for (int k = 0; k < 8; ++k) {
    MotionStep step;
    step.from_ns = k * kSecond, step.to_ns = (k + 1) * kSecond;
    step.T_from_to = SE3(SO3(), Eigen::Vector3d(0, 0, 3));
    step.covariance = 1e-4 * Matrix6d::Identity();
    steps.push_back(step);
  }
  m.mapping->scale().use_motion(std::make_shared<const MeasuredMotion>(steps));
  std::optional<LocalMapping::Added> added;
  int k = 0;
  for (; k < 8 && !(added && added->rescale); ++k)
    added = m.add(k, SE3(SO3(), Eigen::Vector3d(0, 0, k)));
  ASSERT_TRUE(added->rescale);
  EXPECT_NEAR(added->rescale->factor, 3, 1e-6);
  EXPECT_NEAR(m.tracker.scales.back(), 3, 1e-6);
  EXPECT_TRUE(m.map->metric());
  EXPECT_NEAR(m.map->pose(m.map->newest()).translation().z(), 3 * (k - 1), 1e-6);
}

TEST(LocalMapping, AStereoCameraLearnsWhatItsPairIsOffBy) {
  const double error_px = -0.4, fb = window_camera().fx * kBaseline_m;
  const auto pair = [&](const Eigen::Vector3d& p_cam, const RectificationError& known) {
    WindowObservation o;
    o.px = *window_camera().project(p_cam);
    o.inverse_depth = 1 / p_cam.z() + (error_px - known.at(p_cam.head<2>() / p_cam.z())) / fb;
    o.sigma_inverse_depth = 0.3 / fb;
    return o;
  };
  Mapping m(kBaseline_m);
  m.watch(pair, 4);
  for (int k = 0; k < 20; ++k) ASSERT_TRUE(m.add(k, pose_of(k)));
  EXPECT_EQ(m.tracker.rectifications.front().offset_px, 0);
  // Poses and points are fitted to the disparities as they were, so that new points show what is
  // left of the error by and by.
  double before = 0;
  for (const RectificationError& known : m.tracker.rectifications) {
    EXPECT_LE(known.offset_px, before + 1e-9);
    EXPECT_GT(known.offset_px, error_px);
    before = known.offset_px;
  }
  // Points are new every four keyframes: four times there are some that can tell, and the window
  // hides no more than nine tenths of what was left before.
  EXPECT_LT(before, (1 - std::pow(0.9, 4)) * error_px);
  // Two images at once show distortion as an error of their rectification, so no lens is sought.
  EXPECT_TRUE(std::isinf(m.mapping->lens().estimate().sigma_k1));
  EXPECT_EQ(m.mapping->lens().estimate().k1, 0);
}

TEST(LocalMapping, AFullWindowOfASingleCameraShowsItsLens) {
  constexpr double kK1 = 0.002;
  Mapping m;
  m.watch([](const Eigen::Vector3d& p_cam, const RectificationError&) {
    const Eigen::Vector2d x = p_cam.head<2>() / p_cam.z();
    const Eigen::Vector2d bent = x * (1 + kK1 * x.squaredNorm());
    WindowObservation o;
    o.px = *window_camera().project({bent.x(), bent.y(), 1});
    return o;
  });
  for (int k = 0; k < 10; ++k) ASSERT_TRUE(m.add(k, pose_of(k)));
  EXPECT_EQ(m.mapping->lens().estimate().k1, 0);  // the window is not full yet
  ASSERT_TRUE(m.add(10, pose_of(10)));
  // Poses and points have been fitted to straight rays: linear about there.
  EXPECT_NEAR(m.mapping->lens().estimate().k1, kK1, 0.3 * kK1);
}

TEST(LocalMapping, TheScaleComesFromTheGroundOrFromLinesOnIt) {
  EXPECT_TRUE(Mapping(0, 1.6).mapping->scale().uses_ground_plane());
  EXPECT_FALSE(Mapping(0, 1.6).mapping->scale().uses_floor_lines());
  EXPECT_TRUE(Mapping(0, 1.6, "lines").mapping->scale().uses_floor_lines());
  EXPECT_FALSE(Mapping(0, 1.6, "points,lines").mapping->scale().available());
  EXPECT_FALSE(Mapping(0).mapping->scale().available());
  EXPECT_FALSE(Mapping(kBaseline_m, 1.6).mapping->scale().available());
}

}  // namespace local_mapping_test
}  // namespace placegraph
