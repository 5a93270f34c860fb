#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/loops/loop_file.h>

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

// The same four predictions in the forms in which tools write tables.
TEST_F(LoopFile, TablesOfAnySeparatorHeaderAndNumbersAreTheSame) {
  for (const char* text :
       {"60 0 0.5\n60 1 0.25\n61 7 -2\n62 3 1e-3\n", "60,0,0.5\n60,1,0.25\n61,7,-2\n62,3,1e-3\n",
        "60; 0; 0.5\n60; 1; 0.25\n61; 7; -2\n62; 3; 1e-3\n",
        "60\t0\t0.5\n60\t1\t0.25\n61\t7\t-2\n62\t3\t1e-3\n",
        "query,candidate,score\n60,0,0.5\n60,1,0.25\n61,7,-2\n62,3,1e-3\n",
        "\xef\xbb\xbfscore,candidate,query\r\n0.5,0,60\r\n0.25,1,60\r\n-2,7,61\r\n1e-3,3,62\r\n",
        ",query,candidate,score\n0,60,0,0.5\n1,60,1,0.25\n2,61,7,-2\n3,62,3,1e-3\n",
        "# query candidate score\n60 0 0.5\n60 1 0.25\n61 7 -2\n62 3 1e-3\n",
        "# candidate query score\n0 60 0.5\n1 60 0.25\n7 61 -2\n3 62 1e-3\n",
        "Query_ID,Match,Similarity,seconds\n60,0,0.5,9\n60,1,0.25,9\n61,7,-2,9\n62,3,1e-3,9\n",
        "6.000000000000000000e+01 0.000000e+00 5.0e-01\n60.0 1.0 0.25\n61 7 -2\n62 3 1e-3\n"}) {
    const auto found =
        read_loop_predictions(folder.write("found.csv", text), LoopFileFormat::kScores);
    ASSERT_EQ(found.size(), 4u) << text;
    EXPECT_EQ(found[1].query, FrameId(60)) << text;
    EXPECT_EQ(found[1].candidate, FrameId(1)) << text;
    EXPECT_DOUBLE_EQ(found[2].score, -2) << text;
    EXPECT_EQ(found[3].candidate, FrameId(3)) << text;
  }
}

TEST_F(LoopFile, AHeaderSaysWhatScoresAre) {
  const auto kind = [&](const std::string& header) {
    return read_loop_prediction_file(folder.write("found.csv", header + "\n1,0,0.5\n"), {}).scores;
  };
  EXPECT_EQ(kind("query,candidate,distance"), ScoreKind::kDistance);
  EXPECT_EQ(kind("query,candidate,score"), ScoreKind::kSimilarity);
  EXPECT_EQ(read_loop_prediction_file(folder.write("found.csv", "1,0,0.5\n"), {}).scores,
            std::nullopt);
  EXPECT_THAT(refusal("query,score\n1,0.5\n"), HasSubstr("names no column candidate"));
  EXPECT_THAT(refusal("query,candidate,score\n1,0,0.5\n2,1\n"),
              HasSubstr("found.txt:3: 2 columns, and the header names 3"));
}

TEST_F(LoopFile, ResultsOfASearchAreRowsOfCandidates) {
  LoopFileOptions options;
  options.format = LoopFileFormat::kTopK;
  options.scores_of_top_k = folder.write("distances.txt", "0.1 0.2\n0.3 0\n");
  const std::string path = folder.write("indices.txt", "5 7\n2 -1\n");
  const auto found = read_loop_prediction_file(path, options).predictions;
  ASSERT_EQ(found.size(), 3u);
  EXPECT_EQ(found[2].query, FrameId(1));
  EXPECT_EQ(found[2].candidate, FrameId(2));
  EXPECT_DOUBLE_EQ(found[1].score, 0.2);
  options.scores_of_top_k.clear();
  EXPECT_DOUBLE_EQ(read_loop_prediction_file(path, options).predictions[1].score, -2);
  options.scores_of_top_k = folder.write("distances.txt", "0.1\n");
  EXPECT_THAT(test::message_of([&] { (void)read_loop_prediction_file(path, options); }),
              HasSubstr("has 1 x 1 scores"));
}

TEST_F(LoopFile, NamesOfImagesStandForThem) {
  ImageSet queries, database;
  queries.names = {"query/q1.jpg", "query/q2.jpg"};
  database.names = {"db/a/1.jpg", "db/b/1.jpg", "db/c.jpg"};
  LoopFileOptions options;
  options.queries = &queries;
  options.candidates = &database;
  const auto read = [&](const std::string& text) {
    return read_loop_prediction_file(folder.write("pairs.txt", text), options).predictions;
  };
  const auto found = read("query/q2.jpg db/c.jpg\nq2.jpg db/b/1.jpg\nq1.jpg db/a/1.jpg\n");
  ASSERT_EQ(found.size(), 3u);
  EXPECT_EQ(found[0].query, FrameId(1));
  EXPECT_EQ(found[1].candidate, FrameId(1));
  EXPECT_GT(found[0].score, found[1].score);
  EXPECT_DOUBLE_EQ(read("q1.jpg,db/c.jpg,0.5\n")[0].score, 0.5);
  EXPECT_THAT(test::message_of([&] { (void)read("q1.jpg 1.jpg\n"); }),
              HasSubstr("pairs.txt:1: candidate: '1.jpg' is none of its images"));
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
  EXPECT_THAT(matrix.truth.queries.at(FrameId(1)).matches, ElementsAre(FrameId(0), FrameId(1)));
  EXPECT_THAT(matrix.truth.queries.at(FrameId(2)).matches, ElementsAre(FrameId(1), FrameId(2)));
}

TEST_F(LoopFile, ACommentBeforeListsIsNoHeaderOfTheirColumns) {
  const LoopTruthFile lists = truth("# query match\n10 3\n11 4 5\n");
  EXPECT_EQ(lists.format, LoopTruthFormat::kLists);
  EXPECT_THAT(lists.truth.queries.at(FrameId(11)).matches, ElementsAre(FrameId(4), FrameId(5)));
}

TEST_F(LoopFile, AMatrixOfTwoSetsNeedsNotBeSquare) {
  for (const char* text : {"1 0 0 0\n1 1 0 0\n0 0 1 0\n", "1,0,0,0\n1,1,0,0\n0,0,1,0\n",
                           "1.0 0.0 0.0 0.0\n1.0 1.0 0.0 0.0\n0.0 0.0 1.0 0.0\n",
                           "d0;d1;d2;d3\n1;0;0;0\n1;1;0;0\n0;0;1;0\n",
                           ",d0,d1,d2,d3\nq0,1,0,0,0\nq1,1,1,0,0\nq2,0,0,1,0\n"}) {
    const LoopTruthFile matrix = truth(text);
    EXPECT_EQ(matrix.format, LoopTruthFormat::kMatrix) << text;
    EXPECT_EQ(matrix.truth.protocol, LoopProtocol::kQueryDatabase) << text;
    EXPECT_THAT(matrix.truth.queries.at(FrameId(1)).matches, ElementsAre(FrameId(0), FrameId(1)));
    EXPECT_EQ(matrix.form, "a matrix of 3 x 4 matches") << text;
  }
  EXPECT_EQ(truth("1 1 0\n1 1 1\n0 1 1\n").truth.protocol, LoopProtocol::kUndecided);
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
