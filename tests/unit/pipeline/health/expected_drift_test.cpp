#include <gtest/gtest.h>
#include <placegraph/pipeline/run.h>

#include <algorithm>
#include <cmath>

#include "tests/support/scenes/scene.h"

namespace placegraph {
namespace expected_drift_test {

/// A path of places a metre apart, whose distances are each known to `sigma_m`.
RunResult path_of(int places, double sigma_m) {
  RunResult run;
  run.map.metric = true;
  for (int k = 0; k < places; ++k) {
    Keyframe keyframe;
    keyframe.id = KeyframeId(k);
    keyframe.place = PlaceId(k);
    keyframe.frame = FrameId(k);
    run.map.keyframes.push_back(keyframe);
    Place place;
    place.id = PlaceId(k);
    place.anchor_keyframe = KeyframeId(k);
    place.T_map_place = test::pose({0, 0, 0}, {0, 0, 1.0 * k});
    place.members = {{KeyframeId(k), SE3(), 1}};
    run.map.place_graph.places.push_back(place);
    run.map.frames.push_back({FrameId(k), 10 * k, KeyframeId(k), SE3(), 30});
    if (k == 0) continue;
    RelativePoseConstraint edge;
    edge.from = NodeId(k - 1), edge.to = NodeId(k);
    edge.T_from_to = test::pose({0, 0, 0}, {0, 0, 1});
    edge.information = 1e12 * Matrix6d::Identity();
    edge.information.topLeftCorner<3, 3>() = Eigen::Matrix3d::Identity() / (sigma_m * sigma_m);
    edge.source = ConstraintSource::kOdometry;
    run.map.place_graph.constraints.push_back(edge);
  }
  return run;
}

Judgement judged(RunResult run, const std::vector<DataNote>& notes, double min_posed) {
  return judge(run, notes, min_posed);
}

bool reports_drift(const Judgement& judgement) {
  return std::ranges::any_of(judgement.findings,
                             [](const DataNote& note) { return note.cause == NoteCause::kDrift; });
}

TEST(ExpectedDrift, IsTheDeviationOfTheLastPlaceFromTheFirst) {
  const Judgement judgement = judged(path_of(17, 0.01), {}, 0.5);
  ASSERT_TRUE(judgement.expected_drift_m);
  EXPECT_NEAR(*judgement.expected_drift_m, 0.01 * std::sqrt(3 * 16), 1e-4);
  EXPECT_FALSE(reports_drift(judgement));
}

TEST(ExpectedDrift, ErrorsThatAllMotionsShareAddInProportionToTheMotion) {
  RunResult run = path_of(17, 0.01);
  run.odometry_error.emplace();
  run.odometry_error->independent.topLeftCorner<3, 3>() = 16 * 1e-4 * Eigen::Matrix3d::Identity();
  run.odometry_error->independent.bottomRightCorner<3, 3>() = 1e-12 * Eigen::Matrix3d::Identity();
  // Half a per cent of a length of 16 m.
  run.odometry_error->shared(2, 2) = 0.08 * 0.08;
  const double alone = 0.01 * std::sqrt(3 * 16);
  EXPECT_NEAR(*judge(run, {}, 0.5).expected_drift_m, std::hypot(alone, 0.08), 1e-4);
  // A loop that knows the end ten times better leaves a hundredth of it.
  RelativePoseConstraint loop = run.map.place_graph.constraints.back();
  loop.from = NodeId(0);
  loop.T_from_to = test::pose({0, 0, 0}, {0, 0, 16});
  loop.information.topLeftCorner<3, 3>() = 1e6 * Eigen::Matrix3d::Identity();
  loop.source = ConstraintSource::kLoop;
  run.map.place_graph.constraints.push_back(loop);
  EXPECT_LT(*judge(run, {}, 0.5).expected_drift_m, 0.002);
  run.map.place_graph.constraints.pop_back();
}

TEST(ExpectedDrift, IsInMetresOrNotGiven) {
  RunResult doubted = path_of(17, 0.2);
  doubted.notes = {{"the depth unit is odd", true, NoteCause::kDepthUnit, ""}};
  RunResult unknown = path_of(17, 0.2);
  unknown.map.metric = false;
  for (RunResult* run : {&doubted, &unknown}) {
    const Judgement judgement = judge(*run, {}, 0.5);
    EXPECT_FALSE(judgement.expected_drift_m);
    ASSERT_TRUE(reports_drift(judgement));
    const auto note = std::ranges::find(judgement.findings, NoteCause::kDrift, &DataNote::cause);
    EXPECT_EQ(note->text, "the end is known to 1.39 relative to the beginning, 9 % of the path");
  }
}

TEST(ExpectedDrift, IsReportedBeyondTheTwentiethPartOfThePath) {
  EXPECT_TRUE(reports_drift(judged(path_of(17, 0.2), {}, 0.5)));
}

// A camera that turns at the place has hardly a path, but a view.
TEST(ExpectedDrift, IsComparedWithTheDepthOfTheSceneWhereThePathIsShorter) {
  for (const auto& [depth, reported] :
       {std::pair(10.0, "9 % of the path"), std::pair(20.0, "7 % of the depth of the scene"),
        std::pair(60.0, "")}) {
    RunResult run = path_of(17, 0.2);
    auto& landmark = run.map.landmarks.emplace_back();
    landmark.keyframe = KeyframeId(3);
    landmark.point_cam = {1, 2, depth};
    const Judgement judgement = judge(run, {}, 0.5);
    const auto note = std::ranges::find(judgement.findings, NoteCause::kDrift, &DataNote::cause);
    ASSERT_EQ(note == judgement.findings.end(), std::string(reported).empty()) << depth;
    if (note != judgement.findings.end()) {
      EXPECT_TRUE(note->text.ends_with(reported)) << note->text;
    }
  }
}

TEST(ExpectedDrift, IsUnknownForAPlaceAlone) {
  EXPECT_FALSE(judged(path_of(1, 0.01), {}, 0.5).expected_drift_m);
}

TEST(ExpectedDrift, IgnoresComponentsThatAreNotJoined) {
  RunResult run = path_of(17, 0.01);
  run.map.place_graph.places.back().component = 1;
  run.map.place_graph.constraints.pop_back();
  EXPECT_NEAR(*judge(run, {}, 0.5).expected_drift_m, 0.01 * std::sqrt(3 * 15), 1e-4);
}

}  // namespace expected_drift_test
}  // namespace placegraph
