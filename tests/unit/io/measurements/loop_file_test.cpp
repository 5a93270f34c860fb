#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/measurements/loop_file.h>

#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"

namespace placegraph {
namespace loop_file_test {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class LoopFile : public ::testing::Test {
 protected:
  std::string refusal(const std::string& text, LoopFileFormat format = LoopFileFormat::kScores) {
    const std::string path = folder.write("found.txt", text);
    return test::message_of([&] { (void)read_loop_predictions(path, format); });
  }
  std::string truth_refusal(const std::string& text) {
    const std::string path = folder.write("gt.txt", text);
    return test::message_of([&] { (void)read_loop_truth(path); });
  }
  LoopTruthFile truth(const std::string& text) {
    return read_loop_truth(folder.write("gt.txt", text));
  }
  test::TemporaryFolder folder;
};

TEST_F(LoopFile, ReadsScoresWithAndWithoutAStage) {
  const auto found =
      read_loop_predictions(folder.write("found.txt", "# ours\n7 3 0.25\n\n9 4 -1e2 geometry\n"),
                            LoopFileFormat::kScores);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].query, FrameId(7));
  EXPECT_EQ(found[0].candidate, FrameId(3));
  EXPECT_DOUBLE_EQ(found[0].score, 0.25);
  EXPECT_DOUBLE_EQ(found[1].score, -100);
  EXPECT_EQ(found[1].stage, "geometry");
  EXPECT_EQ(found[1].line, 4);
}

TEST_F(LoopFile, WritesWhatItReads) {
  write_loop_predictions(folder / "out.txt", {{FrameId(7), FrameId(3), 0.1, "", 0},
                                              {FrameId(8), FrameId(2), -5, "", 0}});
  const auto found = read_loop_predictions(folder / "out.txt", LoopFileFormat::kScores);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_NEAR(found[0].score, 0.1, 1e-9);
  EXPECT_EQ(found[1].candidate, FrameId(2));
}

TEST_F(LoopFile, NamesTheLineOfBrokenScores) {
  EXPECT_THAT(refusal("1 0 1\n2 1\n"), HasSubstr("found.txt:2: 2 columns"));
  EXPECT_THAT(refusal("1 0 1 a b\n"), HasSubstr("found.txt:1: 5 columns"));
  EXPECT_THAT(refusal("1 0 nan\n"), HasSubstr("found.txt:1: score"));
  EXPECT_THAT(refusal("-1 0 1\n"), HasSubstr("found.txt:1: query"));
  EXPECT_THAT(refusal("1 0.5 1\n"), HasSubstr("found.txt:1: candidate"));
  EXPECT_THAT(refusal("1 99999999999 1\n"), HasSubstr("is not an image"));
  EXPECT_THAT(refusal("1 0 1\n1 0 2\n"), HasSubstr("found.txt:2: query 1 has candidate 0 already"));
}

TEST_F(LoopFile, ReadsTheHypothesesOfIbowThatHaveInliers) {
  const auto found =
      read_loop_predictions(folder.write("ibow.txt",
                                         "0\t0\t0\t0\t0\t0\t0.01\t\n90\t100\t95\t0\t0\t12\t0.2\t\n"
                                         "88\t98\t93\t1\t683\t12\t0.2\t\n"),
                            LoopFileFormat::kIbow);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].query, FrameId(2));
  EXPECT_EQ(found[0].candidate, FrameId(93));
  EXPECT_DOUBLE_EQ(found[0].score, 683);
}

TEST_F(LoopFile, ReadsTheCandidatesOfARunByTheirColumns) {
  const std::string header = "query,match,inliers,accepted,stage,model,probability\n";
  const auto found = read_loop_predictions(
      folder.write("loops.csv",
                   header + "90,3,41,1,accepted,3d2d,0.98\n90,7,0,0,geometry,none,0.2\n"),
      LoopFileFormat::kRun);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].candidate, FrameId(3));
  EXPECT_EQ(found[0].stage, "accepted");
  EXPECT_DOUBLE_EQ(found[1].score, 0.2);
  EXPECT_THAT(refusal("query,match,stage\n", LoopFileFormat::kRun),
              HasSubstr("found.txt:1: no column probability"));
  EXPECT_THAT(refusal(header + "90,3,41,1\n", LoopFileFormat::kRun),
              HasSubstr("found.txt:2: 4 columns, expected 7"));
  EXPECT_THAT(refusal(header + "90,3,41,1,accepted,3d2d,1.98\n", LoopFileFormat::kRun),
              HasSubstr("found.txt:2: probability"));
  EXPECT_THAT(refusal("", LoopFileFormat::kRun), HasSubstr("is empty"));
}

TEST_F(LoopFile, RefusesATruncatedLineOfIbow) {
  EXPECT_THAT(refusal("0 0 0 0 0 0 0.1\n90 100 95 1\n", LoopFileFormat::kIbow),
              HasSubstr("found.txt:2: 4 columns, expected 7"));
}

TEST_F(LoopFile, TellsTheThreeFormsOfGroundTruthApart) {
  const LoopTruthFile ranges = truth("111 0 110 0 1 2\n112 0 110 -\n");
  EXPECT_EQ(ranges.format, LoopTruthFormat::kRanges);
  EXPECT_FALSE(ranges.truth.unlisted_have_none);
  EXPECT_EQ(ranges.truth.queries.at(FrameId(111)).last, FrameId(110));
  EXPECT_THAT(ranges.truth.queries.at(FrameId(111)).matches,
              ElementsAre(FrameId(0), FrameId(1), FrameId(2)));
  EXPECT_TRUE(ranges.truth.queries.at(FrameId(112)).matches.empty());

  const LoopTruthFile lists = truth("1384 588 589 590 591\n1385 586\n");
  EXPECT_EQ(lists.format, LoopTruthFormat::kLists);
  EXPECT_TRUE(lists.truth.unlisted_have_none);
  EXPECT_THAT(lists.truth.queries.at(FrameId(1385)).matches, ElementsAre(FrameId(586)));

  const LoopTruthFile matrix = truth("0,0,0\n1,1,0\n0,1,1\n");
  EXPECT_EQ(matrix.format, LoopTruthFormat::kMatrix);
  EXPECT_THAT(matrix.truth.queries.at(FrameId(1)).matches, ElementsAre(FrameId(0)));
  EXPECT_THAT(matrix.truth.queries.at(FrameId(2)).matches, ElementsAre(FrameId(1)));
}

TEST_F(LoopFile, NamesTheLineOfBrokenGroundTruth) {
  EXPECT_THAT(truth_refusal(""), HasSubstr("gt.txt: no ground truth in it"));
  EXPECT_THAT(truth_refusal("111 0 110 3\n112 0 110\n"), HasSubstr("gt.txt:2: expected: query"));
  EXPECT_THAT(truth_refusal("111 0 110 3\n112 0 110 111\n"), HasSubstr("gt.txt:2: match 111"));
  EXPECT_THAT(truth_refusal("111 0 110 3 2\n"), HasSubstr("gt.txt:1: the matches do not ascend"));
  EXPECT_THAT(truth_refusal("111 9 8 -\n"), HasSubstr("gt.txt:1: the candidates end"));
  EXPECT_THAT(truth_refusal("111 0 -\n"), HasSubstr("gt.txt:1: '-'"));
  EXPECT_THAT(truth_refusal("5 1 2 3\n5 1\n"), HasSubstr("gt.txt:2: image 5 is listed already"));
  EXPECT_THAT(truth_refusal("5 1 x\n"), HasSubstr("gt.txt:1: image"));
  EXPECT_THAT(truth_refusal("0 1\n1 2\n"), HasSubstr("gt.txt:2: 2 in a matrix"));
  EXPECT_THAT(truth_refusal("0 1\n1\n"), HasSubstr("gt.txt:2: 1 columns in a matrix of 2"));
}

}  // namespace loop_file_test
}  // namespace placegraph
