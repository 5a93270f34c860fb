#include <gtest/gtest.h>
#include <placegraph/graph/core/angle.h>
#include <placegraph/pipeline/lines/line_translation.h>

#include "tests/unit/pipeline/lines/edge_tracks.h"

namespace placegraph {
namespace line_translation_test {

using namespace test;

using Eigen::Vector3d;

/// A straight corridor along z of the odometry frame: four edges along it, seen from two keyframes
/// `way` apart, the second rolled by `roll_rad`. The window holds the second one with an error.
struct Corridor {
  SlidingWindow window{{}, line_camera()};
  LineObservations observations;
  std::vector<VanishingDirectionTracker::DirectionCluster> clusters{
      {Vector3d::UnitZ(), 1e-3, {LineId(1), LineId(2), LineId(3), LineId(4)}}};

  explicit Corridor(const Vector3d& path, const Vector3d& error = Vector3d::Zero(),
                    double roll_rad = 0) {
    const SO3 rolled = SO3::exp({0, 0, roll_rad});
    const SE3 first, second(rolled, path);
    window.add_keyframe(KeyframeId(0), first);
    window.add_keyframe(KeyframeId(1), SE3(rolled, path + error));
    for (int i = 1; i <= 4; ++i) {
      const double x = i % 2 ? -1.5 : 1.5, y = i <= 2 ? -1 : 1;
      for (int k = 0; k < 2; ++k) {
        const LineTrack track =
            track_of(LineId(i), k ? second : first, Vector3d(x, y, 6), Vector3d(x, y, 20));
        observations[LineId(i)].push_back(
            {KeyframeId(k), track.edge.line.carriers(0.1), std::nullopt});
      }
    }
  }
  std::vector<MotionObservation> course(double depth = 3) const {
    return translation_along_lines(window, line_camera(), clusters, observations, KeyframeId(1),
                                   depth, deg_to_rad(2.0));
  }
};

TEST(LineTranslation, EdgesAlongTheWaySayThatTheCameraStayedOnTheirDirection) {
  // The window thinks that the camera went 4 cm aside on a way of 1 m.
  const Corridor corridor({0, 0, 1}, {0.04, 0, 0});
  const auto motions = corridor.course();
  ASSERT_EQ(motions.size(), 1u);
  EXPECT_EQ(motions[0].from, KeyframeId(0));
  EXPECT_EQ(motions[0].to, KeyframeId(1));
  EXPECT_NEAR((motions[0].T_from_to.translation() - Vector3d(0, 0, 1)).norm(), 0, 1e-9);
  // Across the way it is known, along the way and in rotation it is not.
  const auto& information = motions[0].information;
  EXPECT_GT(information(0, 0), 100);
  EXPECT_GT(information(1, 1), 100);
  EXPECT_NEAR(information(2, 2), 0, 1e-6 * information(0, 0));
  EXPECT_EQ((information.bottomRightCorner<3, 3>().norm()), 0);
}

TEST(LineTranslation, InformationIsThatOfTheNewestKeyframesAxes) {
  const double roll_rad = 0.7;
  const auto a = Corridor({0, 0, 1}).course();
  const auto b = Corridor({0, 0, 1}, Vector3d::Zero(), roll_rad).course();
  ASSERT_EQ(a.size(), 1u);
  ASSERT_EQ(b.size(), 1u);
  const Eigen::Matrix3d R = SO3::exp({0, 0, roll_rad}).matrix();
  const Eigen::Matrix3d wanted = a[0].information.topLeftCorner<3, 3>();
  const Eigen::Matrix3d rotated = R * b[0].information.topLeftCorner<3, 3>() * R.transpose();
  EXPECT_GT(wanted(0, 0) / wanted(1, 1) + wanted(1, 1) / wanted(0, 0), 2.5);  // the axes differ
  EXPECT_LT((rotated - wanted).norm(), 0.05 * wanted.norm());
}

TEST(LineTranslation, TwiceAsDeepIsHalfAsWellKnown) {
  const Corridor corridor({0, 0, 1});
  const auto near = corridor.course(3), far = corridor.course(6);
  ASSERT_EQ(near.size(), 1u);
  ASSERT_EQ(far.size(), 1u);
  EXPECT_NEAR(far[0].information(0, 0) / near[0].information(0, 0), 0.25, 1e-9);
}

TEST(LineTranslation, AWayAcrossTheEdgesHoldsNothing) {
  // So short that the planes of the edges hardly turn.
  EXPECT_TRUE(Corridor({0.02, 0, 0.02}).course().empty());
  EXPECT_FALSE(Corridor({0, 0, 0.02}).course().empty());
}

TEST(LineTranslation, LinesOfTheWindowAndLinesThatRotatedDoNotCount) {
  Corridor placed({0, 0, 1});
  for (int i = 1; i <= 4; ++i) placed.window.add_line(LineId(i), Line3());
  EXPECT_TRUE(placed.course().empty());
  // The camera left the edges' direction by 30 cm: their planes turned by more than two degrees.
  EXPECT_TRUE(Corridor({0.3, 0, 2}, {-0.3, 0, 0}).course().empty());
}

TEST(LineTranslation, OnlyTheLastObservationInTheNewestKeyframeCounts) {
  Corridor corridor({0, 0, 1});
  for (auto& [id, seen] : corridor.observations) seen.pop_back();
  EXPECT_TRUE(corridor.course().empty());
}

}  // namespace line_translation_test
}  // namespace placegraph
