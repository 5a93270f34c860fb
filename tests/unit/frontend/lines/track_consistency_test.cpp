#include <gtest/gtest.h>
#include <placegraph/frontend/lines/line_triangulation.h>
#include <placegraph/frontend/lines/track_consistency.h>

namespace placegraph {
namespace track_consistency_test {

Camera camera() {
  Camera c;
  c.width = 640, c.height = 480;
  c.fx = c.fy = 500;
  c.cx = 320, c.cy = 240;
  return c;
}

/// An upright line at (x, ., 5) seen from a camera that moves to the right by 0.1 m a frame.
LineMeasurement upright(double x, int frame) {
  const double from_x = 0.1 * frame, u = 320 + 500 * (x - from_x) / 5;
  LineMeasurement s;
  s.T_ref_cam = SE3(SO3(), Eigen::Vector3d(from_x, 0, 0));
  s.seen = {{u, 140}, {u, 340}, 0.2};
  return s;
}

TrackConsistency judge(const std::vector<LineMeasurement>& track) {
  std::vector<SE3> T_ref_cam;
  std::vector<ImageLine::Carriers> seen;
  for (const LineMeasurement& s : track) {
    T_ref_cam.push_back(s.T_ref_cam);
    seen.push_back(s.seen);
  }
  return judge_line_track(camera(), T_ref_cam, seen);
}

TEST(TrackConsistency, ATrackOfOneLineHasNoWrongObservation) {
  std::vector<LineMeasurement> track;
  for (int k = 0; k < 20; ++k) track.push_back(upright(0.3, k));
  const TrackConsistency judged = judge(track);
  EXPECT_TRUE(judged.judged);
  EXPECT_EQ(judged.wrong(), 0);
}

TEST(TrackConsistency, ObservationsAfterAJumpToAnotherEdgeAreWrong) {
  std::vector<LineMeasurement> track;
  for (int k = 0; k < 20; ++k) track.push_back(upright(k < 13 ? 0.3 : 1.1, k));
  const TrackConsistency judged = judge(track);
  EXPECT_TRUE(judged.judged);
  EXPECT_EQ(judged.wrong(), 7);
  EXPECT_TRUE(judged.of_one[12]);
  EXPECT_FALSE(judged.of_one[13]);
}

TEST(TrackConsistency, ACameraThatDoesNotMoveTellsNothing) {
  std::vector<LineMeasurement> track(5, upright(0.3, 0));
  const TrackConsistency judged = judge(track);
  EXPECT_FALSE(judged.judged);
  EXPECT_EQ(judged.wrong(), 0);
}

TEST(TrackConsistency, TwoObservationsAlwaysAgree) {
  EXPECT_FALSE(judge({upright(0.3, 0), upright(0.9, 1)}).judged);
}

}  // namespace track_consistency_test
}  // namespace placegraph
