#include "apps/run/run_report.h"

#include <gtest/gtest.h>

namespace placegraph::apps {
namespace run_report_test {

using nlohmann::json;

RunReport small_report() {
  RunReport report;
  report.out = "out";
  report.summary = {
      {"sequence", "town"},     {"sensor", "mono"}, {"frames", 4},    {"posed", 3},
      {"posed_online", 2},      {"keyframes", 2},   {"places", 1},    {"loops_accepted", 0},
      {"wall_s", 1.25},         {"cpu_s", 0.5},     {"path_m", 12.5}, {"unposed", json::array()},
      {"stages", json::array()}};
  return report;
}

TEST(RunReportText, SaysWhatWasFoundInAColumn) {
  EXPECT_EQ(to_text(small_report()),
            "town         mono, 3 of 4 frames posed (2 online), 2 keyframes, 1 places, 0 loops\n"
            "             1.2 s, 125.0 ms CPU a frame, results in out\n");
}

TEST(RunReportText, SaysWhyFramesHaveNoPoseAndHowFarTheyAreOff) {
  RunReport report = small_report();
  report.summary["sequence"] = "a long name of a folder";
  report.summary["unposed"] = {{{"reason", "8 points, 12 needed"}, {"frames", 1}},
                               {{"reason", "too dark"}, {"frames", 2}}};
  report.summary["motion"] = {{"constraints", 3}, {"median_deviation", 0.75}};
  report.summary["evaluation"] = {{"se3", {{"ate_rmse_m", 0.125}}},
                                  {"sim3", {{"ate_rmse_m", nullptr}}}};
  report.summary["floor_plan"] = {{"walls", 4}, {"doors", 1}, {"rooms", 2}};
  report.summary["semantic_map"] = {{"cells", 100}, {"keyframes", 2}};
  EXPECT_EQ(
      to_text(report),
      "a long name of a folder mono, 3 of 4 frames posed (2 online), 2 keyframes, 1 places, "
      "0 loops\n"
      "             no pose: 8 points, 12 needed (1 frame)\n"
      "             no pose: too dark (2 frames)\n"
      "             motion by other sensors: 3 constraints, deviation 0.75 times the stated one\n"
      "             ATE 0.1250 m (se3), path 12.5 m\n"
      "             floor plan: 4 walls, 1 doors, 2 rooms\n"
      "             street map: 100 cells of 2 keyframes\n"
      "             1.2 s, 125.0 ms CPU a frame, results in out\n");
}

TEST(RunReportText, DividesTheTimesOfStagesByCallsAndByFrames) {
  RunReport report = small_report();
  report.summary["stages"] = {{{"name", "reading"}, {"cpu_s", 0.02}, {"calls", 2}}};
  EXPECT_EQ(stages_text(report),
            "stage                      calls   CPU ms/call  CPU ms/frame\n"
            "reading                        2         10.00          5.00\n");
}

TEST(RunReportText, IsResultJsonForMachines) {
  const RunReport report = small_report();
  EXPECT_EQ(json::parse(to_json(report)), report.summary);
}

}  // namespace run_report_test
}  // namespace placegraph::apps
