#include <placegraph/pipeline/report/loop_images.h>
#include <placegraph/pipeline/report/loops_page.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/io/exports/base64.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <placegraph/pipeline/report/tables/column.h>
#include "tests/support/random_map.h"
#include "tests/support/report_page.h"

namespace placegraph::report {
namespace loops_page_test {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

/// Queries 10 to 12 have true matches 1 to 3, query 13 has none. The system is right for 10, wrong
/// for 11 and silent for 12; 13 is wrong.
class LoopsReport : public testing::Test {
 protected:
  LoopsReport() {
    for (const int query : {10, 11, 12})
      page.truth.queries[FrameId(query)] = {FrameId(0), FrameId(5), {FrameId(query - 9)}};
    page.truth.queries[FrameId(13)] = {FrameId(0), FrameId(5), {}};
    page.protocol = "matches listed per query";
    predict(10, 1, 0.9);
    predict(11, 4, 0.25);
    predict(13, 2, 0.5);
    judge("ours", folder / "loops.csv");
  }
  void predict(int query, int candidate, double score) {
    predictions.push_back({FrameId(query), FrameId(candidate), score, "geometry", 0});
  }
  void judge(const std::string& name, const std::string& file) {
    page.systems = {{name, file, judge_loops(page.truth, predictions), {}}};
  }
  json write() {
    write_loops_page(folder / "page.html", page, "placegraph 1.2.3",
                     [this](LogLevel, const std::string& message) { logged += message; });
    return test::report_in(folder / "page.html");
  }
  test::TemporaryFolder folder;
  std::vector<LoopPrediction> predictions;
  LoopsPage page;
  std::string logged;
};

TEST_F(LoopsReport, ListsRightWrongAndMissedLoops) {
  const std::vector<PageLoop> loops = page_loops(page.systems[0].benchmark, page.truth);
  ASSERT_EQ(loops.size(), 4u);
  const auto is = [](const PageLoop& loop, int query, int match, const std::string& verdict) {
    return loop.query == FrameId(query) && loop.match == FrameId(match) && loop.verdict == verdict;
  };
  EXPECT_TRUE(is(loops[0], 10, 1, "right"));
  EXPECT_TRUE(is(loops[1], 11, 4, "wrong"));
  EXPECT_TRUE(is(loops[2], 12, 3, "missed"));
  EXPECT_TRUE(is(loops[3], 13, 2, "wrong"));
  EXPECT_EQ(loops[0].rank, 1);
  EXPECT_EQ(loops[0].reason, "geometry");
  EXPECT_EQ(loops[2].reason, "nothing was proposed");
  EXPECT_TRUE(std::isnan(loops[2].score));
}

TEST_F(LoopsReport, AMissedLoopNamesACandidateThatWasOldEnough) {
  page.truth.queries[FrameId(12)].matches = {FrameId(2), FrameId(3), FrameId(8), FrameId(11)};
  page.truth.min_age = 9;
  judge("ours", "");
  const std::vector<PageLoop> loops = page_loops(page.systems[0].benchmark, page.truth);
  const auto missed = std::ranges::find(loops, FrameId(12), &PageLoop::query);
  ASSERT_NE(missed, loops.end());
  EXPECT_EQ(missed->verdict, "missed");
  EXPECT_EQ(missed->match, FrameId(3));
}

TEST_F(LoopsReport, WithoutPosesHasFiguresButNoTrajectory) {
  const json report = write();
  const json& run = report["runs"][0];
  EXPECT_EQ(run["name"], "ours");
  EXPECT_EQ(run["summary"]["frames"], 14);
  EXPECT_EQ(run["summary"]["posed"], 0);
  EXPECT_EQ(run["components"], json::array());
  EXPECT_EQ(run["loops"]["judged"], true);
  EXPECT_EQ(run["loops"]["probability"], nullptr);
  EXPECT_EQ(run["loops"]["stage"], text_column({"right", "wrong", "missed", "wrong"}));
  EXPECT_EQ(run["loops"]["query_frame"], column(std::vector<std::int32_t>{10, 11, 12, 13}));
  EXPECT_EQ(run["figures"][0]["name"], "average precision");
  EXPECT_NEAR(run["figures"][0]["value"].get<double>(), 1.0 / 3, 1e-12);
  EXPECT_EQ(run["figures"][0]["protocol"], page.protocol);
  EXPECT_EQ(run["keyframes"]["thumbnails"], json::array());
  EXPECT_THAT(report["pictures"][0]["svg"].get<std::string>(), HasSubstr("ours: AP 0.333"));
}

TEST_F(LoopsReport, WithPosesHasTheTrajectory) {
  Trajectory& poses = page.poses.emplace();
  poses.has_times = false;
  for (int i = 0; i < 14; ++i)
    poses.poses.push_back({i, Eigen::Isometry3d(Eigen::Translation3d(i, 0, 3 * i))});
  poses.poses[3].T_world_body.reset();
  const json run = write()["runs"][0];
  EXPECT_EQ(run["summary"]["posed"], 13);
  EXPECT_EQ(run["up"], (std::array<int, 3>{0, -1, 0}));
  std::vector<std::int32_t> component(14, 0);
  component[3] = -1;
  EXPECT_EQ(run["frames"]["component"], column(component));
  EXPECT_EQ(test::rows_in(run["frames"]["pose"]), 14u);
}

TEST_F(LoopsReport, ProbabilitiesHaveATableOfTheirReliability) {
  page.systems[0].reliability = reliability_of(page.systems[0].benchmark.candidates);
  const json run = write()["runs"][0];
  EXPECT_EQ(run["loops"]["similarity"], nullptr);
  EXPECT_EQ(test::rows_in(run["loops"]["probability"]), 4u);
  EXPECT_EQ(run["tables"][0]["title"], "Reliability of the probabilities");
  EXPECT_EQ(run["tables"][0]["rows"].size(), 3u);
}

TEST_F(LoopsReport, TakesThumbnailsFromTheMapBesideThePredictions) {
  Random random(3);
  StoredMap stored = test::random_map(random);
  stored.map.keyframes[0].frame = FrameId(1);
  stored.map.keyframes[0].thumbnail = "\xff\xd8 a picture";
  write_map(folder / "map.db", stored);
  const json keyframes = write()["runs"][0]["keyframes"];
  ASSERT_GE(keyframes["thumbnails"].size(), 1u);
  EXPECT_EQ(keyframes["thumbnails"][0],
            "data:image/jpeg;base64," + to_base64("\xff\xd8 a picture"));
}

TEST_F(LoopsReport, AMapThatIsNoneLeavesOutTheImages) {
  folder.write("map.db", "no database");
  const json run = write()["runs"][0];
  EXPECT_THAT(logged, HasSubstr("no images for the report"));
  EXPECT_EQ(run["keyframes"]["thumbnails"], json::array());
}

TEST_F(LoopsReport, NamesAreNoTags) {
  const std::string name = "<img src=x onerror=alert(1)>";
  judge(name, "");
  const json report = write();
  EXPECT_THAT(test::read_file(folder / "page.html"), Not(HasSubstr("<img src=x onerror")));
  EXPECT_EQ(report["runs"][0]["name"], name);
  EXPECT_THAT(report["pictures"][0]["svg"].get<std::string>(), Not(HasSubstr("<img")));
}

}  // namespace loops_page_test
}  // namespace placegraph::report
