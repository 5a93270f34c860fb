#include <placegraph/pipeline/report/run_page.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/exports/base64.h>
#include <placegraph/io/scene/floor_plan_file.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include <placegraph/pipeline/report/page.h>
#include <placegraph/pipeline/report/tables/column.h>
#include "tests/support/message_of.h"
#include "tests/support/random_map.h"
#include "tests/support/report_page.h"
#include "tests/support/temporary_folder.h"

namespace placegraph::report {
namespace run_page_test {

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// Saved maps of runs in folders of their own, and the report of them.
class ReportCommand : public testing::Test {
 protected:
  ReportCommand() {
    Random random(3);
    stored = test::random_map(random);
    arguments.out = folder / "report.html";
    arguments.program = "placegraph 1.2.3";
  }
  void save(const std::string& name) {
    std::filesystem::create_directory(folder / name);
    write_map(folder / name + "/map.db", stored);
    arguments.runs.push_back(folder / name);
  }
  json data() const { return test::report_in(arguments.out); }
  test::TemporaryFolder folder;
  StoredMap stored;
  RunPageArguments arguments;
};

TEST_F(ReportCommand, HasWhatTheMapHas) {
  save("town-run");
  const RunPageResult result = write_run_page(arguments);
  EXPECT_EQ(result.runs, 1u);
  EXPECT_EQ(result.bytes, std::filesystem::file_size(arguments.out));
  const json report = data();
  EXPECT_EQ(report["format"], "placegraph-report-1");
  EXPECT_EQ(report["program"], "placegraph 1.2.3");
  EXPECT_EQ(report["title"], "town-run");
  const json& run = report["runs"][0];
  const Map& map = stored.map;
  EXPECT_EQ(run["name"], "town-run");
  EXPECT_EQ(run["sensor"], "mono");
  EXPECT_EQ(run["summary"]["frames"], map.frames.size());
  EXPECT_EQ(run["summary"]["landmarks"], map.landmarks.size());
  EXPECT_EQ(run["summary"]["loops_accepted"], 1);
  EXPECT_EQ(run["judgement"]["verdict"], "doubtful");
  EXPECT_EQ(run["judgement"]["findings"].size(), 2u);
  EXPECT_EQ(run["camera"]["width"], 640);
  EXPECT_EQ(run["components"].size(), map.components().size());
  EXPECT_NEAR(test::rows_in(run["frames"]["pose"]), map.frames.size(), 1);
  EXPECT_NEAR(test::rows_in(run["landmarks"]["position"]), map.landmarks.size(), 1);
  EXPECT_THAT(run["frames"]["reason"]["table"], testing::ElementsAre("only 'few' points"));
  EXPECT_EQ(run["frames"]["truth"], nullptr);  // the recording is not there
  EXPECT_EQ(run["figures"], json::array());
  EXPECT_THAT(run["options"].dump(), HasSubstr("\"seed\""));
  EXPECT_EQ(run["keyframes"]["thumbnails"][0],
            "data:image/jpeg;base64," + to_base64(map.keyframes[0].thumbnail));
  std::vector<std::int32_t> matches;
  for (const LoopRecord& loop : map.loops)
    matches.push_back(static_cast<std::int32_t>(loop.match_frame.value()));
  EXPECT_EQ(run["loops"]["match_frame"], column(matches));
}

/// A room with a column in it, a wall and a door, on a floor 1.2 m below the origin.
FloorPlan small_plan() {
  FloorPlan plan;
  plan.floor_y = 1.2;
  PlanWall wall;
  wall.a = {0, 1}, wall.b = {2, 1}, wall.normal = {0, 1};
  wall.low_m = 0.1, wall.high_m = 2.2;
  wall.place = PlaceId(3);
  plan.walls.push_back(wall);
  plan.doors.push_back({{2, 1}, {3, 1}, 2, true, {}});
  plan.doors.push_back({{3, 1}, {4, 1}, 0, false, {}});
  PlanRoom room;
  room.outline = {{0, 0}, {4, 0}, {4, 3}};
  room.holes = {{{2, 0.5}, {3, 0.5}, {3, 1}}};
  plan.rooms.push_back(room);
  return plan;
}

TEST_F(ReportCommand, HasThePlanAndThePicturesOfTheFolder) {
  save("office");
  std::ofstream(folder / "office/floor_plan.json") << to_json(small_plan());
  std::ofstream(folder / "office/plan.svg") << "<svg/>";
  write_run_page(arguments);
  const json run = data()["runs"][0];
  ASSERT_EQ(run["floor_plan"].size(), 5u);
  EXPECT_EQ(run["floor_plan"][0]["label"], "room");
  EXPECT_EQ(run["floor_plan"][0]["closed"], true);
  EXPECT_EQ(run["floor_plan"][2]["label"], "wall");
  EXPECT_EQ(run["floor_plan"][2]["points"], column(std::vector<float>{0, 1, 2, 1}, 2));
  EXPECT_EQ(run["pictures"][0]["title"], "plan");
  EXPECT_EQ(run["pictures"][0]["svg"], "<svg/>");
  std::ofstream(folder / "office/floor_plan.json") << R"({"walls": 3})";
  arguments.force = true;
  // The map can be shown without a plan that is broken.
  std::string logged;
  write_run_page(arguments, [&](LogLevel, const std::string& text) { logged += text; });
  EXPECT_THAT(logged, AllOf(HasSubstr("floor_plan.json"), HasSubstr("is not a floor plan")));
  EXPECT_TRUE(data()["runs"][0]["floor_plan"].empty());
}

TEST_F(ReportCommand, ThePlanGivesThePlanesOfTheMap) {
  save("office");
  std::ofstream(folder / "office/floor_plan.json") << to_json(small_plan());
  write_run_page(arguments);
  const json run = data()["runs"][0];
  EXPECT_EQ(run["up"], (std::vector<double>{0, -1, 0}));
  ASSERT_EQ(run["planes"].size(), 3u);  // a door whose head was not observed has no plane
  const json &floor = run["planes"][0], &wall = run["planes"][1], &door = run["planes"][2];
  EXPECT_EQ(floor["name"], "floor of room");
  EXPECT_EQ(floor["outline"], column(std::vector<float>{0, 1.2f, 0, 4, 1.2f, 0, 4, 1.2f, 3}, 3));
  ASSERT_EQ(floor["holes"].size(), 1u);
  EXPECT_EQ(floor["holes"][0],
            column(std::vector<float>{2, 1.2f, 0.5f, 3, 1.2f, 0.5f, 3, 1.2f, 1}, 3));
  EXPECT_EQ(wall["name"], "wall of place 3");
  EXPECT_EQ(wall["outline"],
            column(std::vector<float>{0, 1.1f, 1, 2, 1.1f, 1, 2, -1, 1, 0, -1, 1}, 3));
  EXPECT_EQ(door["name"], "closed door");
}

TEST_F(ReportCommand, HasTheTracksOfKeyframes) {
  for (Keyframe& keyframe : stored.map.keyframes) keyframe.observations.clear();
  stored.map.keyframes[0].observations = {{LandmarkId(1), {319.5f, 239.5f}, 0},
                                          {LandmarkId(2), {639.5f, -3}, 0},
                                          {LandmarkId(3), {10, 10}, 1},
                                          {LandmarkId(99999), {10, 10}, 0}};
  stored.map.landmarks[1].observations = 2;
  stored.map.landmarks[2].observations = 5;
  save("town-run");
  write_run_page(arguments);
  const json tracks = data()["runs"][0]["keyframes"]["tracks"];
  // The longest first; neither the second camera nor landmarks that were refused.
  EXPECT_EQ(tracks["landmark"], column(std::vector<std::int32_t>{2, 1}));
  EXPECT_EQ(tracks["pixel"], column(std::vector<std::uint8_t>{255, 0, 128, 128}, 2));
}

TEST_F(ReportCommand, LandmarksHaveTheDeviationOfTheirWorstDirection) {
  stored.map.landmarks.resize(1);
  stored.map.landmarks[0].covariance = Eigen::Vector3d(0.01, 0.04, 0.25).asDiagonal();
  save("town-run");
  write_run_page(arguments);
  EXPECT_EQ(data()["runs"][0]["landmarks"]["sigma_m"], column(std::vector<float>{0.5f}));
}

TEST_F(ReportCommand, HasThePositionOnTheEarth) {
  for (std::size_t i = 0; i < stored.map.frames.size(); ++i)
    stored.map.frames[i].stamp_ns = static_cast<std::int64_t>(i) * 1'000'000'000;
  save("town-run");
  const auto write_earth = [&](const std::string& at, const std::string& tum) {
    std::filesystem::create_directories(folder / at);
    std::ofstream(folder / at + "/georeference.json")
        << R"({"origin": {"latitude_deg": 49, "longitude_deg": 8, "height_m": 115},
               "fixes_used": 12, "residual_rms_m": 0.5})";
    std::ofstream(folder / at + "/trajectory_enu.tum") << tum;
  };
  EXPECT_EQ((write_run_page(arguments), data()["runs"][0]["georeference"]), nullptr);
  arguments.force = true;
  write_earth("town-run/georeference", "0 0 0 0 0 0 0 1\n1 0 5 0 0 0 0 1\n");
  write_run_page(arguments);
  const json earth = data()["runs"][0]["georeference"];
  EXPECT_EQ(earth["fixes_used"], 12);
  EXPECT_EQ(earth["fixes_rejected"], nullptr);
  EXPECT_EQ(earth["track"]["width"], 3);
  const std::vector<double> track = test::doubles_in(earth["track"]);
  ASSERT_EQ(track.size(), 3 * stored.map.frames.size());
  EXPECT_NEAR(track[0], 49, 1e-9);
  EXPECT_NEAR(track[1], 8, 1e-9);
  EXPECT_NEAR(track[3] - 49, 5 / 111200.0, 1e-7);  // 5 m to the north
  EXPECT_TRUE(std::isnan(track[6]));
  write_earth("elsewhere", "900 0 0 0 0 0 0 1\n");
  arguments.georeferences = {folder / "elsewhere"};
  EXPECT_THAT(test::message_of([&] { write_run_page(arguments); }), HasSubstr("is of another map"));
  arguments.georeferences = {folder / "elsewhere", folder / "elsewhere"};
  EXPECT_THAT(test::message_of<ArgumentError>([&] { write_run_page(arguments); }),
              HasSubstr("one folder for each run"));
}

TEST_F(ReportCommand, RunsOfOneRecordingCanBeCompared) {
  stored.origin.sequence = "/data/kitti/00/";
  save("first");
  stored.origin.sequence = "/elsewhere/00";
  save("second");
  write_run_page(arguments);
  EXPECT_EQ(data()["runs"][0]["recording"], "00");
  EXPECT_EQ(data()["runs"][1]["recording"], "00");
}

TEST_F(ReportCommand, ShowsSeveralRuns) {
  save("first");
  stored.judgement.reset();
  save("second");
  arguments.title = "two runs";
  write_run_page(arguments);
  const json report = data();
  EXPECT_EQ(report["title"], "two runs");
  ASSERT_EQ(report["runs"].size(), 2u);
  EXPECT_EQ(report["runs"][1]["name"], "second");
  EXPECT_EQ(report["runs"][1]["judgement"], nullptr);
}

TEST_F(ReportCommand, NamesOfFoldersAreNoTags) {
  const std::string name = "<img src=x onerror=alert(1)><!--</script>";
  std::filesystem::create_directory(folder / "<img src=x onerror=alert(1)><!--<");
  save("<img src=x onerror=alert(1)><!--<" + std::string("/script>"));
  write_run_page(arguments);
  EXPECT_THAT(test::read_file(arguments.out), Not(HasSubstr("onerror=alert(1)><")));
  EXPECT_THAT(data()["runs"][0]["folder"].get<std::string>(), HasSubstr(name));
}

TEST_F(ReportCommand, RefusesWhatIsNoRunAndWritesNothing) {
  arguments.runs = {folder / "nowhere"};
  EXPECT_THAT(test::message_of([&] { write_run_page(arguments); }), HasSubstr("nowhere"));
  EXPECT_FALSE(std::filesystem::exists(arguments.out));
}

TEST_F(ReportCommand, KeepsAnExistingFile) {
  save("town-run");
  write_run_page(arguments);
  EXPECT_THROW(write_run_page(arguments), ArgumentError);
  arguments.force = true;
  EXPECT_NO_THROW(write_run_page(arguments));
}

TEST(ReportPage, HasOnePlaceForItsData) {
  const std::string_view page = empty_page();
  constexpr std::string_view kMarker = "<!--placegraph-report-->";
  const std::size_t at = page.find(kMarker);
  ASSERT_NE(at, std::string_view::npos);
  EXPECT_EQ(page.find(kMarker, at + 1), std::string_view::npos);
  EXPECT_THAT(page_with({{"a", "</script>\xff"}}),
              HasSubstr("\"a\":\"\\u003c/script>\xef\xbf\xbd\""));
}

TEST(RunPage, HasAnExtensionThatBrowsersKnow) {
  for (const char* name : {"a.html", "b/c.d.htm"}) EXPECT_NO_THROW(require_page_name(name));
  for (const char* name : {"a", "a.html/b", "a.HTML", "a.html.gz", ".html"})
    EXPECT_THAT(test::message_of<ArgumentError>([&] { require_page_name(name); }),
                testing::EndsWith("a page ends in .html"));
}

}  // namespace run_page_test
}  // namespace placegraph::report
