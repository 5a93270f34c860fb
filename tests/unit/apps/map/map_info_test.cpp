#include "apps/map/map_info.h"

#include <gtest/gtest.h>

#include "tests/support/message_of.h"
#include "tests/support/random_map.h"
#include "tests/support/temporary_folder.h"

namespace placegraph::apps {
namespace map_info_test {

using nlohmann::json;
using test::message_of;
using testing::HasSubstr;

TEST(MapInfoCommand, CountsWhatTheMapHolds) {
  const test::TemporaryFolder folder;
  Random random(3);
  const StoredMap stored = test::random_map(random);
  write_map(folder / "map.db", stored);
  const json info = map_info({folder.path()}).summary;
  EXPECT_EQ(info["file"], folder / "map.db");
  EXPECT_EQ(info["finished"], stored.finished);
  EXPECT_EQ(info["sequence"], "/data/somewhere");
  EXPECT_EQ(info["places"], 4);
  EXPECT_EQ(info["components"], 2);
  EXPECT_EQ(info["keyframes"], stored.map.keyframes.size());
  EXPECT_EQ(info["views"], stored.map.keyframes.size());
  EXPECT_EQ(info["landmarks"], 2500);
  EXPECT_EQ(info["constraints"], 3);
  EXPECT_EQ(info["loops_accepted"], 1);
  EXPECT_EQ(info["frames"], stored.map.frames.size());
  EXPECT_EQ(info["image"], json({{"width", 640}, {"height", 480}}));
  std::size_t features = 0;
  for (const Keyframe& keyframe : stored.map.keyframes) features += keyframe.features.size();
  EXPECT_EQ(info["features"], features);
}

TEST(MapInfoCommand, TheWayLeadsOverFramesThatHaveAPose) {
  const test::TemporaryFolder folder;
  Random random(3);
  StoredMap stored = test::random_map(random, 1);
  Map& map = stored.map;
  map.place_graph.places[0].T_map_place = SE3();
  map.frames.clear();
  for (int i = 0; i < 4; ++i) {  // at x = 0, 3, nowhere, 5
    FrameRecord record{FrameId(i), 100 * i, KeyframeId(0),
                       SE3(SO3(), Eigen::Vector3d(i == 3 ? 5 : 3 * i, 0, 0)), 9};
    if (i == 2) record = {FrameId(i), 100 * i, std::nullopt, std::nullopt, 0};
    map.frames.push_back(record);
  }
  map.keyframes.resize(1);
  map.keyframes[0].frame = FrameId(0);
  map.place_graph.places[0].members.resize(1);
  map.landmarks.clear();
  map.loops.clear();
  map.trajectory_online.poses.resize(4);
  stored.history = {};
  write_map(folder / "map.db", stored);
  const json info = map_info({folder / "map.db"}).summary;
  EXPECT_EQ(info["frames"], 4);
  EXPECT_EQ(info["posed"], 3);
  EXPECT_NEAR(info["path_length"].get<double>(), 5, 1e-9);
}

TEST(MapInfoCommand, ListsThePlacesIfAsked) {
  const test::TemporaryFolder folder;
  Random random(3);
  StoredMap stored = test::random_map(random);
  stored.map.metric = stored.judgement->metric = false;
  write_map(folder / "map.db", stored);
  EXPECT_FALSE(map_info({folder.path()}).summary.contains("place_list"));
  const MapInfoResult result = map_info({folder.path(), true});
  const json& list = result.summary["place_list"];
  const std::vector<Place>& places = stored.map.place_graph.places;
  ASSERT_EQ(list.size(), places.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    EXPECT_EQ(list[i]["id"], places[i].id.value());
    EXPECT_EQ(list[i]["keyframes"], places[i].members.size());
    EXPECT_EQ(list[i]["frame"], stored.map.find_keyframe(places[i].anchor_keyframe)->frame.value());
    EXPECT_NEAR(list[i]["position"][2].get<double>(), places[i].T_map_place.translation().z(),
                1e-9);
  }
  const std::string text = to_text(result);
  EXPECT_THAT(text, HasSubstr(" units (scale unknown)\n"));
  EXPECT_THAT(text, HasSubstr("\n place  component  frame  keyframes  position x y z [units]"));
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 7 + static_cast<long>(places.size()));
}

TEST(MapInfoCommand, NamesTheFileThatIsNoMap) {
  const test::TemporaryFolder folder;
  EXPECT_THAT(message_of([&] { map_info({folder.path()}); }),
              HasSubstr("map.db: there is no such file"));
  folder.write("map.db", "no map");
  EXPECT_THAT(message_of([&] { map_info({folder.path()}); }), HasSubstr("map.db"));
}

TEST(MapInfoText, SaysItInSixLines) {
  MapInfoResult result;
  result.summary = {{"file", "out/map.db"},
                    {"schema", 7},
                    {"finished", false},
                    {"verdict", nullptr},
                    {"sequence", "/data/town"},
                    {"sensor", "stereo"},
                    {"places", 4},
                    {"components", 2},
                    {"component_trajectories", json::array()},
                    {"constraints", 3},
                    {"loops_accepted", 1},
                    {"frames", 40},
                    {"posed", 38},
                    {"keyframes", 9},
                    {"path_length", 12.345},
                    {"metric", true},
                    {"features", 2000},
                    {"views", 9},
                    {"landmarks", 2500},
                    {"file_bytes", 1'250'000},
                    {"features_bytes", 400'000},
                    {"views_bytes", 60'000},
                    {"landmarks_bytes", 0}};
  EXPECT_EQ(to_text(result),
            "out/map.db: schema 7, broken off, not judged\n"
            "  from     /data/town (stereo)\n"
            "  places   4 in 2 components, 3 constraints, 1 loops\n"
            "  frames   40, 38 posed, 9 keyframes, path 12.3 m\n"
            "  content  2000 features, 9 views, 2500 landmarks\n"
            "  size     1.2 MB: features 0.4, views 0.1, landmarks 0.0\n");
  EXPECT_EQ(json::parse(to_json(result)), result.summary);
}

}  // namespace map_info_test
}  // namespace placegraph::apps
