#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/pipeline/scene/map_keyframes.h>
#include <placegraph/pipeline/scene/street_mapper.h>

#include <numbers>
#include <set>

#include "tests/support/ids.h"
#include "tests/support/scenes/posed_map.h"

namespace placegraph {
namespace street_mapper_test {

using namespace test;

SceneModel model_of(SceneModel::Kind kind, std::vector<std::string> classes) {
  SceneModel model;
  model.kind = kind;
  model.classes = std::move(classes);
  model.surfaces.assign(model.classes.size(), Surface::kVertical);
  return model;
}

StreetMapper mapper_of(double baseline_m = 0.5) {
  StreetMapperOptions options;
  options.labelling.moving = "";  // no class of these models moves
  options.grid.min_weight = 1;
  options.grid.min_observations = 1;
  return {options,
          Calibration{.camera = {640, 480, 500, 500, 320, 240},
                      .baseline_m = baseline_m,
                      .depth = {},
                      .camera_height_m = {}},
          model_of(SceneModel::Kind::kUrban, {"Road", "Building"}),
          model_of(SceneModel::Kind::kSurfaces, {"sky", "ground", "vertical", "object"})};
}

/// A wall at z = 10 of the world, as a camera there sees it.
KeyframeStreetPoints observation_of_wall(std::int64_t keyframe, const SE3& T_world_cam) {
  KeyframeStreetPoints observation;
  observation.keyframe = KeyframeId(keyframe);
  observation.shares = {0.1F, 0.9F};
  for (double x = -2; x < 2; x += 0.1)
    for (double y = -2; y < 1; y += 0.1) {
      StreetPoint point;
      point.point = (T_world_cam.inverse() * Eigen::Vector3d(x, y, 10.05)).cast<float>();
      point.height_m = static_cast<float>(1.5 - y);
      observation.points.push_back(point);
    }
  return observation;
}

std::set<int> depths_of(const StreetMap& map) {
  std::set<int> rows;
  for (const StreetCell& cell : map.cells)
    if (cell.label == 1) rows.insert(cell.at[2]);
  return rows;
}

TEST(StreetMapper, FusesObservationsAgainWhereALoopMovedThem) {
  const SE3 first, second(SO3::exp({0, 0.3, 0}), Eigen::Vector3d(0.5, 0, 1));
  // Before the loop the second place is thought to be 2 m farther.
  const SE3 drifted(second.rotation(), second.translation() + Eigen::Vector3d(0, 0, 2));
  StreetMapper mapper = mapper_of();
  mapper.add(observation_of_wall(0, first));
  mapper.add(observation_of_wall(1, second));
  const StreetMap before = mapper.fuse(posed_map({first, drifted}));
  ASSERT_TRUE(before.outcome) << before.outcome.reason;
  EXPECT_EQ(depths_of(before), (std::set<int>{33, 40}));  // cells of 0.3 m: 10.05 and 12.05 m
  const StreetMap after = mapper.fuse(posed_map({first, second}));
  EXPECT_EQ(depths_of(after), std::set<int>{33});
}

TEST(StreetMapper, ReplacesTheEarlierDataOfAKeyframe) {
  StreetMapper mapper = mapper_of();
  mapper.add(observation_of_wall(0, SE3()));
  KeyframeStreetPoints other = observation_of_wall(0, SE3());
  for (StreetPoint& point : other.points) point.point[2] += 2;
  mapper.add(other);
  EXPECT_EQ(depths_of(mapper.fuse(posed_map({SE3()}))), std::set<int>{40});
}

TEST(StreetMapper, TakesPosesBeforeCorrectionsByTheirStamps) {
  Map map = posed_map({SE3(), SE3()});
  map.trajectory_online.poses.push_back({100, SE3(SO3(), Eigen::Vector3d(1, 2, 3)).isometry()});
  const KeyframePoses online = online_poses_of(map);
  EXPECT_FALSE(online(KeyframeId(0)));
  ASSERT_TRUE(online(KeyframeId(1)));
  EXPECT_EQ(online(KeyframeId(1))->translation(), Eigen::Vector3d(1, 2, 3));
  EXPECT_TRUE(poses_of(map)(KeyframeId(0)));
  EXPECT_FALSE(poses_of(map)(KeyframeId(2)));
}

TEST(StreetMapper, UsesKeyframesThatAreAStepApart) {
  std::vector<SE3> poses;
  for (int i = 0; i < 10; ++i) poses.emplace_back(SO3(), Eigen::Vector3d(0, 0, 0.4 * i));
  const Map map = posed_map(poses);
  std::vector<KeyframeId> ids;
  for (const Keyframe* keyframe : keyframes_apart(map, 1, 0.1)) ids.push_back(keyframe->id);
  EXPECT_EQ(ids, test::ids<KeyframeId>({0, 3, 6, 9}));
}

TEST(StreetMapper, TellsWhatIsSeenFromEachPlace) {
  StreetMapper mapper = mapper_of();
  mapper.add(observation_of_wall(1, SE3()));
  const auto shares = class_shares(mapper, posed_map({SE3(), SE3()}));
  ASSERT_EQ(shares.size(), 2U);
  EXPECT_TRUE(shares[0].empty());
  EXPECT_NEAR(shares[1][1], 0.9, 1e-4);
}

TEST(StreetMapper, RefusesModelsAndClassesThatItCannotUse) {
  const Calibration calibration{.camera = {640, 480, 500, 500, 320, 240},
                                .baseline_m = 0.5,
                                .depth = {},
                                .camera_height_m = {}};
  const SceneModel urban = model_of(SceneModel::Kind::kUrban, {"Road", "Car"});
  const SceneModel surfaces =
      model_of(SceneModel::Kind::kSurfaces, {"sky", "ground", "vertical", "object"});
  StreetMapperOptions options;
  options.labelling.moving = "Car,Tram";
  EXPECT_THROW(StreetMapper(options, calibration, urban, surfaces), ArgumentError);
  options.labelling.moving = "Car";
  EXPECT_NO_THROW(StreetMapper(options, calibration, urban, surfaces));
  EXPECT_THROW(StreetMapper(options, calibration, surfaces, urban), ArgumentError);
}

TEST(StreetMapper, SaysWhyThereIsNoMap) {
  Map map = posed_map({SE3()});
  EXPECT_EQ(mapper_of().fuse(map).outcome.code, Outcome::Code::kTooFewData);
  EXPECT_EQ(mapper_of(0).fuse(map).outcome.reason, "a stereo camera is required");
  map.metric = false;
  EXPECT_EQ(mapper_of().fuse(map).outcome.reason, "the map is not metric");
}

TEST(StreetMapper, LaysItsCellsOutByTheGivenVertical) {
  StreetMapper mapper = mapper_of();
  mapper.add(observation_of_wall(0, SE3()));
  // A map that stands on its head: down is -y of it.
  const SE3 T_map_cam(SO3::exp({0, 0, std::numbers::pi}), Eigen::Vector3d::Zero());
  const KeyframePoses poses = [&](KeyframeId) -> std::optional<SE3> { return T_map_cam; };
  const StreetMap as_seen = mapper.fuse(poses);
  const StreetMap with_vertical = mapper.fuse(poses, -Eigen::Vector3d::UnitY());
  ASSERT_TRUE(as_seen.outcome && with_vertical.outcome);
  EXPECT_EQ(as_seen.cells.size(), with_vertical.cells.size());
  EXPECT_EQ(depths_of(as_seen), depths_of(with_vertical));
}

TEST(StreetMapper, LeavesOutKeyframesWithoutAPose) {
  StreetMapper mapper = mapper_of();
  mapper.add(observation_of_wall(0, SE3()));
  mapper.add(observation_of_wall(1, SE3(SO3(), Eigen::Vector3d(0, 0, 3))));
  const auto only_first = [](KeyframeId keyframe) {
    return keyframe == KeyframeId(0) ? std::optional(SE3()) : std::nullopt;
  };
  EXPECT_EQ(depths_of(mapper.fuse(only_first)), std::set<int>{33});
  const auto none = [](KeyframeId) { return std::optional<SE3>(); };
  EXPECT_EQ(mapper.fuse(none).outcome.reason, "no keyframe has a pose");
}

TEST(StreetMapper, MonocularTellsNothing) {
  StreetMapper mapper = mapper_of();
  Frame frame;
  frame.image = Image(480, 640, CV_8UC1, cv::Scalar(90));
  mapper.add(KeyframeId(0), frame, SE3());  // without a right image
  EXPECT_TRUE(mapper.observations().empty());
}

TEST(StreetMapper, ReadsTheKeyframesOfAMapThatAreApartAndSaysHowFarItIs) {
  std::vector<SE3> poses;
  for (int i = 0; i < 6; ++i) poses.emplace_back(SO3(), Eigen::Vector3d(0, 0, 0.6 * i));
  StreetMapper mapper = mapper_of();
  std::vector<KeyframeId> read;
  std::vector<std::size_t> done;
  add_keyframes(
      mapper, posed_map(poses), {},
      [&](const Keyframe& keyframe) {
        read.push_back(keyframe.id);
        return Frame();
      },
      [&](std::size_t i, std::size_t all) {
        done.push_back(i);
        EXPECT_EQ(all, 3u);
      });
  EXPECT_EQ(read, test::ids<KeyframeId>({0, 2, 4}));  // a metre apart
  EXPECT_EQ(done, (std::vector<std::size_t>{1, 2, 3}));
}

TEST(StreetMapper, SharesOfClassesAreOfAllPointsOfAPlace) {
  StreetMapper mapper = mapper_of();
  KeyframeStreetPoints wall = observation_of_wall(0, SE3()), road = observation_of_wall(1, SE3());
  road.shares = {0.7F, 0.3F};
  road.points.resize(wall.points.size() / 3);
  mapper.add(wall);
  mapper.add(road);
  Map map = posed_map({SE3(), SE3()});
  map.keyframes[1].place = PlaceId(0);  // both are of one place
  map.place_graph.places[0].members.push_back({KeyframeId(1), SE3(), 1});
  map.place_graph.places[1].members.clear();
  const auto shares = class_shares(mapper, map);
  ASSERT_EQ(shares.size(), 2U);
  ASSERT_EQ(shares[0].size(), 2U);
  // Three parts of 0.9 and one of 0.3.
  EXPECT_NEAR(shares[0][1], 0.75, 0.01);
  EXPECT_NEAR(shares[0][0] + shares[0][1], 1, 1e-5);
  EXPECT_TRUE(shares[1].empty());
}

}  // namespace street_mapper_test
}  // namespace placegraph
