#include <placegraph/pipeline/report/evaluation_page.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/eval/trajectory/evaluate.h>

#include <placegraph/pipeline/report/tables/column.h>
#include "tests/support/report_page.h"
#include "tests/support/trajectories.h"

namespace placegraph::report {
namespace evaluation_page_test {

using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

/// A drive of 200 frames, estimated beside its path.
EvaluationResult evaluated(const std::string& name, double off_m, bool lost = false,
                           bool timed = false) {
  const Trajectory truth = test::winding_drive(200, 1, timed);
  Trajectory estimate = truth;
  for (StampedPose& pose : estimate.poses) pose.T_world_body->translation().x() += off_m;
  if (lost) estimate.poses[7].T_world_body.reset();
  EvaluationOptions options;
  options.alignment = Alignment::kNone;
  options.association = Association::kIndex;
  options.segments.lengths_m = {20};
  return evaluate(truth, estimate, options, name);
}

class EvalReport : public testing::Test {
 protected:
  json write(const EvaluationPage& page) {
    write_evaluation_page(folder / "page.html", page, "placegraph 1.2.3");
    return test::report_in(folder / "page.html");
  }
  test::TemporaryFolder folder;
};

TEST_F(EvalReport, HasEveryEstimateInTheFrameOfTheTruth) {
  const json report = write({"street", {evaluated("a", 0.25), evaluated("b", 0.5)}, false});
  EXPECT_EQ(report["title"], "a, b against street");
  ASSERT_EQ(report["runs"].size(), 2u);
  const json& run = report["runs"][1];
  EXPECT_EQ(run["name"], "b");
  EXPECT_EQ(run["recording"], "street");
  EXPECT_EQ(run["aligned"], "none");
  EXPECT_EQ(run["sensor"], nullptr);
  EXPECT_EQ(run["options"], nullptr);
  EXPECT_EQ(run["summary"]["frames"], 200);
  EXPECT_EQ(run["summary"]["posed"], 200);
  EXPECT_EQ(run["summary"]["keyframes"], nullptr);
  EXPECT_EQ(run["frames"]["online"], nullptr);
  EXPECT_EQ(test::rows_in(run["frames"]["pose"]), 200u);
  EXPECT_EQ(run["frames"]["error_m"], column(std::vector<float>(200, 0.5f)));
  EXPECT_EQ(run["figures"][0]["name"], "ATE RMSE");
  EXPECT_NEAR(run["figures"][0]["value"].get<double>(), 0.5, 1e-6);
  EXPECT_THAT(run["figures"][0]["protocol"].get<std::string>(), HasSubstr("align none"));
  EXPECT_EQ(run["tables"][0]["title"], "Errors");
  EXPECT_EQ(run["tables"][0]["rows"][0][0], "position [m]");
  const json& last = run["tables"].back();
  EXPECT_EQ(last["title"], "Errors of segments by speed");
  EXPECT_EQ(run["tables"][run["tables"].size() - 2]["rows"][0][0], "20 m");
  // What the reader may choose as a graph: components of the error and relative errors.
  ASSERT_GE(run["frame_series"].size(), 5u);
  for (const json& series : run["frame_series"])
    EXPECT_EQ(test::rows_in(run["frames"][series["column"].get<std::string>()]), 200u)
        << series["title"];
  EXPECT_EQ(run["frame_series"][0]["title"], "Error along the path");
  std::vector<std::string> titles;
  for (const json& picture : report["pictures"]) {
    titles.push_back(picture["title"]);
    EXPECT_THAT(picture["svg"].get<std::string>(), HasSubstr("<svg"));
  }
  EXPECT_THAT(titles, ElementsAre("Evaluation", "Coordinates", "Roll, pitch and yaw",
                                  "Relative errors of consecutive frames",
                                  "Errors over the lengths of segments", "Quartiles of the errors",
                                  "Densities of the errors"));
  EXPECT_EQ(report["tables"], json::array());
}

TEST_F(EvalReport, LostFramesHaveNoComponentAndNoError) {
  const json run = write({"street", {evaluated("a", 0.5, true)}, false})["runs"][0];
  std::vector<std::int32_t> component(200, 0);
  component[7] = -1;
  EXPECT_EQ(run["frames"]["component"], column(component));
  EXPECT_EQ(run["summary"]["posed"], 199);
}

TEST_F(EvalReport, SaysThatTimesAreAssumedWhereThereAreNone) {
  const json untimed = write({"street", {evaluated("a", 0.5)}, false})["runs"][0];
  EXPECT_THAT(untimed["notes"].dump(), HasSubstr("10 frames a second are assumed"));
  std::vector<double> stamp_s;
  for (int i = 0; i < 200; ++i) stamp_s.push_back(i / 10.0);
  EXPECT_EQ(untimed["frames"]["stamp_s"], column(stamp_s));
  const json timed = write({"street", {evaluated("a", 0.5, false, true)}, false})["runs"][0];
  EXPECT_THAT(timed["notes"].dump(), Not(HasSubstr("assumed")));
}

TEST_F(EvalReport, SequencesHaveAveragesAndAreNotCompared) {
  const json report = write({"all", {evaluated("00", 0.25), evaluated("01", 0.75)}, true});
  EXPECT_EQ(report["runs"][0]["recording"], "00");
  EXPECT_EQ(report["runs"][1]["recording"], "01");
  ASSERT_EQ(report["tables"].size(), 1u);
  EXPECT_EQ(report["tables"][0]["title"], "Averages");
  EXPECT_EQ(report["tables"][0]["rows"][0],
            (std::vector<std::string>{"ATE RMSE, mean of the sequences", "0.5 m"}));
}

TEST_F(EvalReport, LeavesOutWhatCouldNotBeEvaluated) {
  EvaluationResult failed;
  failed.name = "broken";
  failed.outcome = Outcome::failure(Outcome::Code::kTooFewData, "two poses");
  const json report = write({"street", {evaluated("a", 0.5), failed}, false});
  EXPECT_EQ(report["runs"].size(), 1u);
}

TEST_F(EvalReport, NamesAreNoTags) {
  const std::string name = "<img src=x onerror=alert(1)>";
  const json report = write({name, {evaluated(name, 0.5)}, false});
  EXPECT_THAT(test::read_file(folder / "page.html"), Not(HasSubstr("<img src=x onerror")));
  EXPECT_EQ(report["runs"][0]["name"], name);
  EXPECT_THAT(report["pictures"][0]["svg"].get<std::string>(), Not(HasSubstr("<img")));
}

}  // namespace evaluation_page_test
}  // namespace placegraph::report
