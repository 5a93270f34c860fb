#include "apps/viewer/map_mending.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/map/map_database.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "tests/support/scenes/square_map.h"
#include "tests/support/temporary_folder.h"

namespace placegraph::apps {
namespace map_mending_test {

using nlohmann::json;
using ::testing::HasSubstr;

class MapMendingTest : public ::testing::Test {
 protected:
  MapMendingTest() {
    write_map(dir / "map.db", test::square_map(true));
    pages.emplace(std::vector{dir.path()}, "placegraph");
    mending.emplace(*pages);
  }
  HttpResponse ask(const json& edit) { return mending->edit(edit.dump()); }
  json done(const json& edit) {
    const HttpResponse response = ask(edit);
    EXPECT_EQ(response.status, 200) << response.body;
    return json::parse(response.body);
  }
  bool loop_shown() const { return pages->first()->map.loops.at(0).accepted(); }

  const json refuse = {{"action", "refuse"}, {"query_frame", 40}, {"match_frame", 0}};
  const json optimize = {{"action", "optimize"}}, undo = {{"action", "undo"}};
  test::TemporaryFolder dir;
  std::optional<RunPages> pages;
  std::optional<MapMending> mending;
};

TEST_F(MapMendingTest, ThePagesShowWhatWasEdited) {
  EXPECT_FALSE(mending->unsaved());
  const json answer = done(refuse);
  EXPECT_EQ(answer["text"], "refused the loop of frames 40 and 0");
  EXPECT_EQ(answer["edits"], json::array({"refused the loop of frames 40 and 0"}));
  EXPECT_EQ(answer["optimized"], false);
  EXPECT_EQ(answer["unsaved"], true);
  EXPECT_FALSE(loop_shown());
  const json optimized = done(optimize);
  EXPECT_EQ(optimized["optimized"], true);
  EXPECT_EQ(optimized["edits"].size(), 2U);
  EXPECT_EQ(optimized["edits"][1], optimized["text"]);
  EXPECT_TRUE(mending->unsaved());
}

TEST_F(MapMendingTest, EveryEditCanBeTakenBack) {
  const Map before = pages->first()->map;
  done(refuse);
  done(optimize);
  EXPECT_EQ(done(undo)["edits"].size(), 1U);
  EXPECT_FALSE(loop_shown());
  const json untouched = done(undo);
  EXPECT_EQ(untouched["unsaved"], false);
  EXPECT_EQ(untouched["edits"], json::array());
  EXPECT_TRUE(loop_shown());
  const auto position = [](const Map& map) {
    return map.S_map_keyframe(KeyframeId(4)).translation().eval();
  };
  EXPECT_EQ(position(pages->first()->map), position(before));
  EXPECT_EQ(ask(undo).status, 409);
}

TEST_F(MapMendingTest, SavesTheEditedMapBesideTheOriginal) {
  const std::string original = test::read_file(dir / "map.db");
  done(refuse);
  const json saved = done({{"action", "save"}, {"name", "my_map-2"}});
  EXPECT_EQ(saved["unsaved"], false);
  EXPECT_FALSE(mending->unsaved());
  EXPECT_THAT(saved["text"].get<std::string>(), HasSubstr("my_map-2.db"));
  EXPECT_FALSE(read_map(dir / "my_map-2.db").map.loops.at(0).accepted());
  EXPECT_EQ(test::read_file(dir / "map.db"), original);
  const HttpResponse twice = ask({{"action", "save"}, {"name", "my_map-2"}});
  EXPECT_EQ(twice.status, 409);
  EXPECT_THAT(json::parse(twice.body)["error"].get<std::string>(), HasSubstr("it exists already"));
  EXPECT_EQ(ask({{"action", "save"}, {"name", "map"}}).status, 409);
  done(optimize);
  EXPECT_TRUE(mending->unsaved());
  done(undo);
  EXPECT_FALSE(mending->unsaved());  // the saved state again
}

TEST_F(MapMendingTest, AFileNameIsPlain) {
  for (const std::string name : {"", "../other", "a/b", "a.db", "a b", "\xc3\xa4", "/tmp/x"}) {
    const HttpResponse response =
        mending->edit(R"({"action": "save", "name": ")" + name + "\"}");
    EXPECT_EQ(response.status, 400) << name;
    EXPECT_THAT(response.body, HasSubstr("name: ")) << name;
  }
  EXPECT_EQ(ask({{"action", "save"}, {"name", std::string(65, 'a')}}).status, 400);
  done({{"action", "save"}, {"name", std::string(64, 'a')}});
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(dir.path()), {}), 2);
}

TEST_F(MapMendingTest, WhatIsNoEditChangesNothing) {
  const std::string before = mending->edits().body;
  for (const char* body :
       {"", "{", "[]", "3", "{}", R"({"action": 3})", R"({"action": "delete"})",
        R"({"action": "refuse"})", R"({"action": "refuse", "query_frame": 40})",
        R"({"action": "add", "query_frame": -1, "match_frame": 0})",
        R"({"action": "add", "query_frame": "40", "match_frame": 0})",
        R"({"action": "accept", "query_frame": 40.5, "match_frame": 0})", R"({"action": "save"})"})
    EXPECT_EQ(mending->edit(body).status, 400) << body;
  for (const json& edit :
       {json{{"action", "refuse"}, {"query_frame", 30}, {"match_frame", 0}},
        json{{"action", "accept"}, {"query_frame", 40}, {"match_frame", 0}},
        json{{"action", "add"}, {"query_frame", 999}, {"match_frame", 0}}}) {
    const HttpResponse response = ask(edit);
    EXPECT_EQ(response.status, 409) << edit;
    EXPECT_FALSE(json::parse(response.body)["error"].get<std::string>().empty());
  }
  EXPECT_EQ(mending->edits().body, before);
  EXPECT_EQ(json::parse(before),
            (json{{"edits", json::array()}, {"unsaved", false}, {"optimized", true}}));
}

TEST_F(MapMendingTest, AMapThatNoRunCanContinueCannotBeEdited) {
  StoredMap imported = test::square_map(false);
  imported.history = {};
  write_map(dir / "imported.db", imported);
  RunPages others({dir / "imported.db"}, "placegraph");
  EXPECT_THROW(MapMending{others}, ArgumentError);
}

}  // namespace map_mending_test
}  // namespace placegraph::apps
