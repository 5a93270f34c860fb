#include "apps/eval/benchmarks/eval_gate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/trajectories/trajectory_file.h>

#include <filesystem>

#include "apps/eval/benchmarks/eval_record.h"
#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/trajectories.h"

namespace placegraph::apps {
namespace eval_gate_test {

class EvalGateCommand : public testing::Test {
 protected:
  /// A record of one run that stands off by a growing distance.
  std::string record(const std::string& name, double off_m, const std::string& delta = {}) {
    Trajectory drive = test::winding_drive(60, 1, false);
    if (!std::filesystem::exists(folder / "truth.txt"))
      write_trajectory(folder / "truth.txt", drive, TrajectoryFormat::kKitti);
    for (std::size_t i = 0; i < drive.size(); ++i)
      drive.poses[i].T_world_body->translation().x() += off_m * static_cast<double>(i % 7);
    write_trajectory(folder / "run.txt", drive, TrajectoryFormat::kKitti);
    EvalRecordArguments arguments;
    arguments.evaluation.truth = folder / "truth.txt";
    arguments.evaluation.estimates = {folder / "run.txt"};
    if (!delta.empty()) arguments.evaluation.deltas = {delta};
    arguments.name = "00";
    arguments.out = folder / name;
    EXPECT_NE(to_text(eval_record(arguments)).find("00: 1 run"), std::string::npos);
    return folder / name;
  }
  int judged(const std::string& baseline, const std::string& candidate) {
    EvalGateArguments arguments;
    arguments.baseline = baseline;
    arguments.candidates = {candidate};
    return eval_gate(arguments).exit_code();
  }
  test::TemporaryFolder folder;
};

TEST_F(EvalGateCommand, PassesWhatIsTheSameOrBetterAndStopsWhatIsWorse) {
  const std::string before = record("before.json", 0.10), better = record("better.json", 0.05),
                    worse = record("worse.json", 0.20);
  EXPECT_EQ(judged(before, before), 0);
  EXPECT_EQ(judged(before, better), 0);
  EXPECT_EQ(judged(before, worse), 1);
}

TEST_F(EvalGateCommand, CountsAFigureThatTheCandidateLacksAsLost) {
  const std::string plain = record("plain.json", 0.1), with = record("with.json", 0.1, "10f");
  EXPECT_EQ(judged(with, plain), 1);
  EXPECT_EQ(judged(plain, with), 0);
}

TEST_F(EvalGateCommand, RefusesWhatIsNoRecord) {
  const std::string before = record("before.json", 0.1);
  EXPECT_THAT(test::message_of([&] { judged(before, folder / "run.txt"); }),
              testing::HasSubstr("run.txt"));
}

}  // namespace eval_gate_test
}  // namespace placegraph::apps
