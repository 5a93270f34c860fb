#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/eval/kitti/kitti_check.h>
#include <placegraph/eval/kitti/kitti_figures.h>
#include <placegraph/eval/trajectory/evaluate.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/trajectories/trajectory_file.h>
#include <placegraph/pipeline/kitti/kitti_benchmark.h>
#include <placegraph/pipeline/kitti/kitti_files.h>

#include <algorithm>
#include <set>

#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/trajectories.h"

namespace placegraph {
namespace kitti_benchmark_test {

namespace fs = std::filesystem;
using test::message_of;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// Two drives of 300 and 250 frames under `truth`, and estimates of them.
class KittiBenchmarkTest : public testing::Test {
 protected:
  void SetUp() override {
    write("truth/03.txt", drive(300));
    write("truth/04/poses.txt", drive(250));
    estimate("mine", 0.01);
  }
  static Trajectory drive(int frames) { return test::winding_drive(frames, 1, false); }

  std::string write(const std::string& name, const Trajectory& trajectory) {
    fs::create_directories(fs::path(folder / name).parent_path());
    write_trajectory(folder / name, trajectory, TrajectoryFormat::kKitti);
    return folder / name;
  }
  void estimate(const std::string& system, double sigma_m) {
    Random random(7);
    write(system + "/03.txt", test::drifting(drive(300), sigma_m, 1e-4, random));
    write(system + "/04.txt", test::drifting(drive(250), sigma_m, 1e-4, random));
  }
  KittiBenchmark judge(const std::vector<std::string>& systems,
                       const std::vector<std::string>& sequences = {}) {
    std::vector<std::string> folders;
    for (const std::string& system : systems) folders.push_back(folder / system);
    return evaluate_kitti(folder / "truth", folders, sequences);
  }
  test::TemporaryFolder folder;
};

TEST_F(KittiBenchmarkTest, FiguresAreThoseOfTheEvaluation) {
  const KittiBenchmark benchmark = judge({"mine"});
  ASSERT_EQ(benchmark.systems.size(), 1u);
  const KittiSystem& system = benchmark.systems.front();
  EXPECT_EQ(system.name, "mine");
  EXPECT_THAT(system.faults, IsEmpty());
  EXPECT_THAT(system.warnings, IsEmpty());
  ASSERT_EQ(system.sequences.size(), 2u);
  std::vector<EvaluationResult> results;
  for (const auto& [truth, estimate] :
       {std::pair("truth/03.txt", "mine/03.txt"), std::pair("truth/04/poses.txt", "mine/04.txt")})
    results.push_back(
        evaluate(read_trajectory(folder / truth), read_trajectory(folder / estimate)));
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(system.sequences[i].figures.t_rel_percent, results[i].segments.t_rel_percent,
                1e-12);
    EXPECT_NEAR(system.sequences[i].figures.r_rel_deg_per_100m,
                results[i].segments.r_rel_deg_per_100m, 1e-12);
    EXPECT_EQ(system.sequences[i].path_m, results[i].path_m);
  }
  const AverageResult mean = average(results);
  EXPECT_EQ(system.mean.segments, mean.segments);
  EXPECT_NEAR(system.mean.t_rel_percent, *mean.pooled_t_rel.value, 1e-12);
  EXPECT_NEAR(system.mean.r_rel_deg_per_100m, *mean.pooled_r_rel.value, 1e-12);
}

TEST_F(KittiBenchmarkTest, ASequenceWithAFaultHasNoFiguresAndItsSystemNoMean) {
  const std::string lines = test::read_file(folder / "mine/04.txt");
  folder.write("mine/04.txt", lines + "1 0 0 0 0 1 0 0 0 0 1 0\n");
  const KittiSystem system = judge({"mine"}).systems.front();
  ASSERT_EQ(system.faults.size(), 1u);
  EXPECT_EQ(to_string(system.faults[0]),
            folder / "mine/04.txt" +
                ": has 251 poses, but the ground truth has 250 frames: every frame needs a pose");
  EXPECT_TRUE(system.sequences[0].figures.outcome);
  EXPECT_TRUE(system.sequences[1].faulty);
  EXPECT_FALSE(system.sequences[1].figures.outcome);
  EXPECT_FALSE(system.mean.outcome);
  EXPECT_THAT(system.mean.outcome.reason, HasSubstr("04"));
  // It is no matter where the other sequence alone is asked for.
  EXPECT_TRUE(judge({"mine"}, {"03"}).systems.front().mean.outcome);
}

TEST_F(KittiBenchmarkTest, AMissingSequenceIsAFault) {
  fs::remove(folder / "mine/03.txt");
  const KittiSystem system = judge({"mine"}).systems.front();
  ASSERT_EQ(system.faults.size(), 1u);
  EXPECT_EQ(system.faults[0].file, folder / "mine/03.txt");
  EXPECT_THAT(system.faults[0].text, HasSubstr("is missing"));
  EXPECT_FALSE(system.mean.outcome);
}

TEST_F(KittiBenchmarkTest, SequencesWithoutTruthAreCheckedInTheirFormByTheFramesOfKitti) {
  for (const std::string& name : kitti_test_sequences())
    write("mine/" + name + ".txt", drive(*kitti_frames(name)));
  const KittiSystem system = judge({"mine"}).systems.front();
  EXPECT_THAT(system.faults, IsEmpty());
  EXPECT_EQ(system.sequences.size(), 13u);
  EXPECT_EQ(system.sequences.back().figures.outcome.code, Outcome::Code::kNotAttempted);
  EXPECT_TRUE(system.mean.outcome);
  write("mine/17.txt", drive(490));
  fs::remove(folder / "mine/21.txt");
  const KittiSystem faulty = judge({"mine"}).systems.front();
  ASSERT_EQ(faulty.faults.size(), 2u);
  EXPECT_THAT(faulty.faults[0].text, HasSubstr("490 poses, but the sequence has 491"));
  EXPECT_THAT(faulty.faults[1].text, HasSubstr("the server wants all of 11 to 21"));
  EXPECT_TRUE(faulty.mean.outcome);  // which is of the sequences with a truth
}

TEST_F(KittiBenchmarkTest, OtherFilesAreNamedAndPassedOver) {
  folder.write("mine/notes.md", "a note");
  folder.write("mine/.hidden", "");
  write("mine/42.txt", drive(3));
  const KittiSystem system = judge({"mine"}).systems.front();
  EXPECT_THAT(system.faults, IsEmpty());
  ASSERT_EQ(system.warnings.size(), 2u);
  EXPECT_EQ(system.warnings[0].file, folder / "mine/42.txt");
  EXPECT_EQ(system.warnings[1].file, folder / "mine/notes.md");
  EXPECT_THAT(judge({"mine"}, {"03"}).systems.front().warnings, IsEmpty());
}

TEST_F(KittiBenchmarkTest, WarnsOfAxesAndOfTheFirstPose) {
  Trajectory inverse = drive(300);
  for (StampedPose& pose : inverse.poses) pose.T_world_body = pose.T_world_body->inverse();
  write("mine/03.txt", inverse);
  Trajectory moved = drive(250);
  for (StampedPose& pose : moved.poses) pose.T_world_body->translation().y() += 1;
  write("mine/04.txt", moved);
  const KittiSystem system = judge({"mine"}).systems.front();
  EXPECT_THAT(system.faults, IsEmpty());
  ASSERT_EQ(system.warnings.size(), 2u);
  EXPECT_THAT(system.warnings[0].text, HasSubstr("looks inverted"));
  EXPECT_THAT(system.warnings[1].text, HasSubstr("first pose is not the identity"));
}

TEST_F(KittiBenchmarkTest, RefusesFoldersThatHoldNothing) {
  fs::create_directories(folder / "empty");
  EXPECT_THAT(message_of<ArgumentError>([&] { (void)judge({"empty"}); }),
              HasSubstr("empty: holds no poses of a sequence"));
  EXPECT_THAT(message_of<ArgumentError>([&] { (void)judge({}); }), HasSubstr("there is none"));
  EXPECT_THAT(message_of<ArgumentError>([&] { (void)judge({"mine"}, {"05"}); }),
              HasSubstr("no true poses of the sequence '05'"));
  EXPECT_THAT(message_of<ArgumentError>([&] {
                (void)judge({"mine", "mine"});
              }),
              HasSubstr("the same name"));
  EXPECT_THROW((void)judge({"absent"}), FileError);
  write("truth/04.txt", drive(250));
  EXPECT_THAT(message_of<ArgumentError>([&] { (void)judge({"mine"}); }),
              HasSubstr("both 04.txt and 04/poses.txt"));
}

TEST_F(KittiBenchmarkTest, ATruthWithoutAPoseIsRefusedWithItsLine) {
  Trajectory lost = drive(300);
  lost.poses[17].T_world_body.reset();
  write("truth/03.txt", lost);
  EXPECT_THAT(message_of<FileError>([&] { (void)judge({"mine"}); }), HasSubstr("03.txt:18: "));
}

std::set<std::string> files_in(const std::string& path) {
  std::set<std::string> files;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(path))
    if (entry.is_regular_file()) files.insert(fs::relative(entry.path(), path).string());
  return files;
}

TEST_F(KittiBenchmarkTest, TheFilesAreThoseOfTheDevkit) {
  write_kitti_files(judge({"mine"}), folder / "out", "svg");
  std::set<std::string> expected = {"figures.csv",      "stats.txt",        "errors/03.txt",
                                    "errors/04.txt",    "plot_path/03.txt", "plot_path/04.txt",
                                    "plot_path/03.svg", "plot_path/04.svg"};
  for (const std::string name : {"03", "04", "avg"})
    for (const std::string ending : {"tl", "rl", "ts", "rs"})
      for (const std::string format : {"txt", "svg"})
        expected.insert("plot_error/" + name + "_" + ending + "." + format);
  EXPECT_EQ(files_in(folder / "out"), expected);
  const KittiSystem system = judge({"mine"}).systems.front();
  EXPECT_EQ(test::read_file(folder / "out/stats.txt"), kitti_stats_text(system.mean));
  EXPECT_EQ(test::read_file(folder / "out/errors/04.txt"),
            kitti_segments_text(system.sequences[1].segments));
  EXPECT_EQ(test::read_file(folder / "out/plot_error/avg_rs.txt"),
            kitti_rotations_text(system.mean.by_speed));
  EXPECT_THAT(
      message_of<ArgumentError>([&] { write_kitti_files(judge({"mine"}), folder / "out", "svg"); }),
      HasSubstr("is not empty"));
}

TEST_F(KittiBenchmarkTest, SeveralSystemsHaveFoldersAndShareThePlots) {
  estimate("theirs", 0.05);
  write_kitti_files(judge({"mine", "theirs"}), folder / "out", "none");
  const std::set<std::string> files = files_in(folder / "out");
  EXPECT_TRUE(files.contains("mine/stats.txt"));
  EXPECT_TRUE(files.contains("theirs/plot_error/avg_tl.txt"));
  EXPECT_TRUE(std::ranges::none_of(files, [](const auto& f) { return f.ends_with(".svg"); }));
  write_kitti_files(judge({"mine", "theirs"}), folder / "out", "svg", true);
  EXPECT_THAT(test::read_file(folder / "out/plot_path/03.svg"), HasSubstr("theirs"));
}

TEST_F(KittiBenchmarkTest, NothingIsWrittenForASubmissionWithFaults) {
  fs::remove(folder / "mine/03.txt");
  EXPECT_THROW(write_kitti_files(judge({"mine"}), folder / "out", "svg"), ArgumentError);
  EXPECT_FALSE(fs::exists(folder / "out"));
  EXPECT_THROW(write_kitti_files(judge({"mine"}, {"04"}), folder / "out", "gif"), ArgumentError);
}

}  // namespace kitti_benchmark_test
}  // namespace placegraph
