#include <gmock/gmock.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/datasets/evaluated_files.h>

#include <filesystem>
#include <fstream>

#include "tests/support/temporary_folder.h"

namespace placegraph {
namespace evaluated_files_test {

using testing::ElementsAre;
namespace fs = std::filesystem;

class EvaluatedFilesTest : public testing::Test {
 protected:
  void touch(const std::string& file) {
    fs::create_directories(fs::path(dir / file).parent_path());
    std::ofstream(dir / file) << "";
  }
  test::TemporaryFolder dir;
};

TEST_F(EvaluatedFilesTest, ArePairedByNameOrElseByTheOnlyStem) {
  for (const char* file : {"truth/b.tum", "truth/a.kitti", "truth/c.csv", "truth/.hidden",
                           "est/a.tum", "est/b.tum", "est/b.csv", "est/.hidden", "est/d.tum"})
    touch(file);
  const PairedFiles paired = pair_files(dir / "truth", dir / "est");
  ASSERT_EQ(paired.pairs.size(), 2u);
  EXPECT_EQ(paired.pairs[0].name, "a");
  EXPECT_EQ(paired.pairs[0].truth, dir / "truth/a.kitti");
  EXPECT_EQ(paired.pairs[0].estimate, dir / "est/a.tum");
  EXPECT_EQ(paired.pairs[1].estimate, dir / "est/b.tum");  // the same name, although b.csv is there
  EXPECT_THAT(paired.alone, ElementsAre(dir / "truth/c.csv"));
}

TEST_F(EvaluatedFilesTest, AreRefusedWhereTwoCouldBeMeantAndWhereNothingIsPaired) {
  for (const char* file : {"truth/a.kitti", "est/a.tum", "est/a.csv", "other/x.tum"}) touch(file);
  EXPECT_THROW((void)pair_files(dir / "truth", dir / "est"), ArgumentError);
  EXPECT_THROW((void)pair_files(dir / "truth", dir / "other"), ArgumentError);
}

TEST_F(EvaluatedFilesTest, HaveTheShortestNamesThatAreUnique) {
  EXPECT_THAT(distinct_names({"a/x.tum", "b/y.tum"}), ElementsAre("x.tum", "y.tum"));
  EXPECT_THAT(distinct_names({"a/x.tum", "b/x.tum"}), ElementsAre("a", "b"));
  EXPECT_THAT(distinct_names({"1/a/x.tum", "2/a/x.tum", "y.tum"}),
              ElementsAre("1/a/x.tum", "2/a/x.tum", "y.tum"));
  EXPECT_THAT(distinct_names({"runs/one/", "runs/two/"}), ElementsAre("one", "two"));
  EXPECT_THAT(distinct_names({"same.tum", "same.tum"}), ElementsAre("same.tum", "same.tum"));
}

TEST_F(EvaluatedFilesTest, OfARunAreThoseWithTimesWhereTheTruthHasThem) {
  for (const char* file : {"run/trajectory_optimized.kitti", "kitti/poses.txt", "kitti/times.txt",
                           "bare/poses.txt", "alone.txt"})
    touch(file);
  fs::create_directories(dir / "euroc");
  EXPECT_TRUE(is_run_folder(dir / "run"));
  EXPECT_FALSE(is_run_folder(dir / "kitti"));
  EXPECT_EQ(trajectory_of_run(dir / "run", false), dir / "run/trajectory_optimized.kitti");
  EXPECT_EQ(trajectory_of_run(dir / "run", true), dir / "run/trajectory_optimized.tum");
  for (const char* timed : {"kitti", "kitti/poses.txt", "euroc", "any.tum", "any.csv"})
    EXPECT_TRUE(truth_has_times(dir / timed)) << timed;
  for (const char* bare : {"bare", "bare/poses.txt", "alone.txt"})
    EXPECT_FALSE(truth_has_times(dir / bare)) << bare;
  EXPECT_EQ(times_beside(dir / "kitti"), dir / "kitti/times.txt");
  EXPECT_EQ(times_beside(dir / "kitti/poses.txt"), dir / "kitti/times.txt");
  EXPECT_EQ(times_beside(dir / "bare"), "");
  EXPECT_EQ(times_beside(dir / "kitti/times.txt"), "");
}

TEST_F(EvaluatedFilesTest, TruthIsThatOfAFileOrOfASequence) {
  touch("kitti/times.txt");
  const std::string pose = "1 0 0 2 0 1 0 3 0 0 1 4\n";
  std::ofstream(dir / "kitti/poses.txt") << pose << pose;
  std::ofstream(dir / "kitti/times.txt") << "0\n0.5\n";
  const Trajectory folder = read_truth(dir / "kitti");
  EXPECT_EQ(folder.size(), 2u);
  EXPECT_FALSE(folder.has_times);
  const Trajectory timed = read_truth(dir / "kitti", times_beside(dir / "kitti"));
  EXPECT_TRUE(timed.has_times);
  EXPECT_EQ(timed.size(), 2u);
  EXPECT_THROW((void)read_truth(dir / "none"), FileError);
  EXPECT_THROW((void)read_truth(dir / "kitti", dir / "none"), FileError);
}

}  // namespace evaluated_files_test
}  // namespace placegraph
