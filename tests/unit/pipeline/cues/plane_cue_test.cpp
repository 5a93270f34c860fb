#include <gtest/gtest.h>
#include <placegraph/graph/core/angle.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/pipeline/cues/plane_cue.h>

#include <Eigen/Dense>

#include "tests/support/scenes/window_world.h"

namespace placegraph {
namespace plane_cue_test {

using test::make_window_world;
using test::WindowWorld;
using test::WindowWorldOptions;

using Seen = std::vector<std::optional<PlaneId>>;

/// A rectangle of a plane of the map: its middle, two directions of unit length and half extents.
struct Patch {
  Eigen::Vector3d middle, u, v;
  double half_u = 1, half_v = 1;
};

/// A stereo drive along z, whose keyframes see patches.
struct Drive {
  WindowWorld world;
  SlidingWindow window;
  PlaneCue planes;
  Random random{5};
  std::int64_t next = 0;

  static WindowWorld make() {
    Random random(9);
    WindowWorldOptions options;
    options.keyframes = 14;
    options.landmarks = 100;
    options.stereo = true;
    options.step_m = 0.4;
    return make_window_world(options, random);
  }
  static SlidingWindowOptions window_options() {
    SlidingWindowOptions options;
    options.max_keyframes = 6;
    options.hold_oldest = true;
    return options;
  }
  explicit Drive(const PlaneLandmarkOptions& options = {})
      : world(make()), window(window_options(), world.camera), planes(options) {}

  static DepthPlane seen_from(const SE3& T_map_cam, const Patch& patch) {
    DepthPlane plane;
    const Eigen::Vector3d n = patch.u.cross(patch.v);
    plane.plane_cam = transform_to(T_map_cam, Plane3(n, n.dot(patch.middle)));
    plane.covariance = plane_information(plane.plane_cam, 0.1 * kRadPerDeg, 0.004).inverse();
    for (double a = -1; a <= 1; a += 0.1)
      for (double b = -1; b <= 1; b += 0.1)
        plane.points_cam.push_back(
            T_map_cam.inverse() *
            (patch.middle + a * patch.half_u * patch.u + b * patch.half_v * patch.v));
    return plane;
  }
  /// The next keyframe, which sees these patches.
  Seen see(const std::vector<Patch>& patches) {
    const std::int64_t id = next++;
    const SE3& T_map_cam = world.T_map_cam[static_cast<std::size_t>(id)];
    window.add_keyframe(KeyframeId(id), T_map_cam);
    add_view(window, world, KeyframeId(id), 0, random);
    std::vector<DepthPlane> seen;
    for (const Patch& patch : patches) seen.push_back(seen_from(T_map_cam, patch));
    const Seen result = planes.add(KeyframeId(id), seen, window);
    if (id > 0) {
      EXPECT_TRUE(window.optimize().outcome);
    }
    planes.prune(window);
    window.marginalize();
    return result;
  }
};

const Eigen::Vector3d kX(1, 0, 0), kY(0, 1, 0), kZ(0, 0, 1);
/// A wall ahead, one on the left, and the first one's continuation far to the right.
const Patch kAhead{{0, 0, 12}, kX, kY, 2, 1.5};
const Patch kLeft{{-3, 0, 9}, kZ, kY, 2, 1.5};
const Patch kFarRight{{9, 0, 12}, kX, kY, 2, 1.5};

TEST(PlaneCue, BeginWithTheSecondObservation) {
  Drive drive;
  EXPECT_EQ(drive.see({kAhead, kLeft}), (Seen{std::nullopt, std::nullopt}));
  EXPECT_TRUE(drive.planes.landmarks().empty());
  const Seen second = drive.see({kLeft, kAhead});
  EXPECT_EQ(second, (Seen{PlaneId(1), PlaneId(2)}));
  EXPECT_EQ(drive.window.planes(), (std::vector{PlaneId(1), PlaneId(2)}));
  EXPECT_EQ(plane_observations(drive.window).size(), 4u);
  for (int k = 0; k < 8; ++k) EXPECT_EQ(drive.see({kAhead, kLeft}), (Seen{PlaneId(2), PlaneId(1)}));
}

TEST(PlaneCue, OneSeenOnceIsNone) {
  Drive drive;
  drive.see({kAhead});
  for (int k = 0; k < 7; ++k) EXPECT_EQ(drive.see({}), Seen{});
  // The keyframe that saw it has left.
  EXPECT_EQ(drive.see({kAhead}), Seen{std::nullopt});
  EXPECT_TRUE(drive.window.planes().empty());
}

TEST(PlaneCue, ACoplanarSurfaceElsewhereIsAnotherOne) {
  Drive drive;
  drive.see({kAhead});
  EXPECT_EQ(drive.see({kAhead}), Seen{PlaneId(1)});
  EXPECT_EQ(drive.see({kFarRight}), Seen{std::nullopt});
  EXPECT_EQ(drive.see({kFarRight, kAhead}), (Seen{PlaneId(2), PlaneId(1)}));
}

TEST(PlaneCue, TheOtherSideOfAThinWallIsAnotherOne) {
  Patch back = kAhead;
  back.middle.z() += 0.01;
  std::vector<DepthPlane> seen{Drive::seen_from(SE3(), kAhead)};
  PlaneCue planes({});
  SlidingWindow window(Drive::window_options(), test::window_camera());
  const Matrix6d sure = 1e8 * Matrix6d::Identity();
  // Two keyframes before the wall, two behind it that look back.
  const std::vector<SE3> T_map_cam{SE3(), SE3(SO3(), {0.2, 0, 0}),
                                   SE3(SO3::exp({0, std::numbers::pi, 0}), {0, 0, 24}),
                                   SE3(SO3::exp({0, std::numbers::pi, 0}), {0.2, 0, 24})};
  std::vector<Seen> results;
  for (std::size_t k = 0; k < 4; ++k) {
    const auto id = static_cast<std::int64_t>(k);
    window.add_keyframe(KeyframeId(id), T_map_cam[k]);
    if (k > 0)
      add_motion(window, {KeyframeId(id - 1), KeyframeId(id),
                          T_map_cam[k - 1].inverse() * T_map_cam[k], sure});
    results.push_back(planes.add(KeyframeId(id),
                                 {Drive::seen_from(T_map_cam[k], k < 2 ? kAhead : back)}, window));
  }
  EXPECT_EQ(results[1], Seen{PlaneId(1)});
  EXPECT_EQ(results[2], Seen{std::nullopt});
  EXPECT_EQ(results[3], Seen{PlaneId(2)});
}

TEST(PlaneCue, ALeafBeforeItsWallIsSeparatedWhereBothAreSeenAndElseLeftAlone) {
  Patch leaf = kAhead;
  leaf.middle.z() -= 0.03;
  leaf.half_u = 0.5;
  Drive drive;
  drive.see({kAhead, leaf});
  EXPECT_EQ(drive.see({kAhead, leaf}), (Seen{PlaneId(1), PlaneId(2)}));
  EXPECT_EQ(drive.see({leaf, kAhead}), (Seen{PlaneId(2), PlaneId(1)}));
  // Half way between the two, alone: it may be either.
  Patch either = leaf;
  either.middle.z() += 0.014;
  EXPECT_EQ(drive.see({either}), Seen{std::nullopt});
  EXPECT_EQ(drive.planes.landmarks(), (std::vector{PlaneId(1), PlaneId(2)}));
}

TEST(PlaneCue, AreRememberedForAWhile) {
  PlaneLandmarkOptions options;
  options.patience = 8;
  Drive patient(options);
  patient.see({kAhead});
  EXPECT_EQ(patient.see({kAhead}), Seen{PlaneId(1)});
  for (int k = 0; k < 7; ++k) patient.see({});
  EXPECT_EQ(patient.see({kAhead}), Seen{PlaneId(1)});

  options.patience = 3;
  Drive hasty(options);
  hasty.see({kAhead});
  hasty.see({kAhead});
  for (int k = 0; k < 7; ++k) hasty.see({});
  EXPECT_TRUE(hasty.planes.landmarks().empty());
  EXPECT_TRUE(hasty.window.planes().empty());
}

TEST(PlaneCue, TheOneUnseenForLongestMakesRoom) {
  PlaneLandmarkOptions options;
  options.max_landmarks = 1;
  Drive drive(options);
  drive.see({kAhead});
  drive.see({kAhead});
  drive.see({kLeft});
  EXPECT_EQ(drive.see({kLeft}), Seen{PlaneId(2)});
  EXPECT_EQ(drive.planes.landmarks(), std::vector{PlaneId(2)});
}

TEST(PlaneCue, BeginAnewAfterAReset) {
  Drive drive;
  drive.see({kAhead});
  drive.see({kAhead});
  drive.planes.reset();
  EXPECT_TRUE(drive.planes.landmarks().empty());
}

TEST(PlaneCue, RefuseOptionsThatCannotBe) {
  PlaneLandmarkOptions options;
  options.min_overlap = 2;
  EXPECT_THROW(PlaneCue{options}, ArgumentError);
  options = {};
  options.depth.cell_px = 0;
  EXPECT_THROW(PlaneCue{options}, ArgumentError);
}

}  // namespace plane_cue_test
}  // namespace placegraph
