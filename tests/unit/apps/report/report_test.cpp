#include "apps/report/report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/internal/exports/base64.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "apps/report/column.h"
#include "apps/report/page.h"
#include "tests/support/message_of.h"
#include "tests/support/random_map.h"
#include "tests/support/temporary_folder.h"

namespace placegraph::apps {
namespace {

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
  /// The data in the page that was written.
  json data() const {
    const std::string page = test::read_file(arguments.out);
    const std::string begin = "<script id=\"placegraph-report\" type=\"application/json\">";
    const std::size_t at = page.find(begin);
    EXPECT_NE(at, std::string::npos);
    const std::size_t first = at + begin.size();
    return json::parse(page.substr(first, page.find("</script>", first) - first));
  }
  static std::size_t rows(const json& column, std::size_t bytes) {
    return column["data"].get<std::string>().size() / 4 * 3 /
           (bytes * column["width"].get<std::size_t>());
  }
  test::TemporaryFolder folder;
  StoredMap stored;
  ReportArguments arguments;
};

TEST_F(ReportCommand, HasWhatTheMapHas) {
  save("town-run");
  const ReportResult result = report(arguments);
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
  EXPECT_NEAR(rows(run["frames"]["pose"], 4), map.frames.size(), 1);
  EXPECT_NEAR(rows(run["landmarks"]["position"], 4), map.landmarks.size(), 1);
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

TEST_F(ReportCommand, HasThePlanAndThePicturesOfTheFolder) {
  save("office");
  std::ofstream(folder / "office/floor_plan.json")
      << R"({"walls": [{"a": [0, 1], "b": [2, 3]}], "doors": [],
             "rooms": [{"label": "", "outline": [[0, 0], [4, 0], [4, 3]], "holes": []}]})";
  std::ofstream(folder / "office/plan.svg") << "<svg/>";
  report(arguments);
  const json run = data()["runs"][0];
  ASSERT_EQ(run["floor_plan"].size(), 2u);
  EXPECT_EQ(run["floor_plan"][0]["label"], "room");
  EXPECT_EQ(run["floor_plan"][0]["closed"], true);
  EXPECT_EQ(run["floor_plan"][1]["label"], "wall");
  EXPECT_EQ(run["floor_plan"][1]["points"], column(std::vector<float>{0, 1, 2, 3}, 2));
  EXPECT_EQ(run["pictures"][0]["title"], "plan");
  EXPECT_EQ(run["pictures"][0]["svg"], "<svg/>");
  std::ofstream(folder / "office/floor_plan.json") << R"({"walls": 3})";
  arguments.force = true;
  EXPECT_THAT(test::message_of([&] { report(arguments); }),
              AllOf(HasSubstr("floor_plan.json"), HasSubstr("is no floor plan")));
}

TEST_F(ReportCommand, ShowsSeveralRuns) {
  save("first");
  stored.judgement.reset();
  save("second");
  arguments.title = "two runs";
  report(arguments);
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
  report(arguments);
  EXPECT_THAT(test::read_file(arguments.out), Not(HasSubstr("onerror=alert(1)><")));
  EXPECT_THAT(data()["runs"][0]["folder"].get<std::string>(), HasSubstr(name));
}

TEST_F(ReportCommand, RefusesWhatIsNoRunAndWritesNothing) {
  arguments.runs = {folder / "nowhere"};
  EXPECT_THAT(test::message_of([&] { report(arguments); }), HasSubstr("nowhere"));
  EXPECT_FALSE(std::filesystem::exists(arguments.out));
}

TEST_F(ReportCommand, KeepsAnExistingFile) {
  save("town-run");
  report(arguments);
  EXPECT_THROW(report(arguments), ArgumentError);
  arguments.force = true;
  EXPECT_NO_THROW(report(arguments));
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

}  // namespace
}  // namespace placegraph::apps
