#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/files/npy_array.h>
#include <placegraph/io/loops/loop_file.h>
#include <placegraph/io/loops/name_index.h>
#include <placegraph/io/loops/number_matrix.h>

#include <cmath>
#include <limits>

#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"

namespace placegraph {
namespace number_matrix_test {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class NumberMatrices : public ::testing::Test {
 protected:
  std::string refusal(const std::string& text, const std::string& name = "m.txt") {
    const std::string path = folder.write(name, text);
    return test::message_of([&] { (void)read_number_matrix(path); });
  }
  test::TemporaryFolder folder;
};

TEST_F(NumberMatrices, AreTheSameAsTextAndAsArrays) {
  for (const std::size_t rows : {1u, 2u, 7u})
    for (const std::size_t columns : {1u, 3u, 11u}) {
      NpyArray array{{rows, columns}, {}};
      std::string text, commas;
      for (std::size_t i = 0; i < rows * columns; ++i) {
        array.values.push_back(0.25 * static_cast<double>(i) - 1);
        const bool last = (i + 1) % columns == 0;
        text += std::to_string(array.values.back()) + (last ? "\n" : " ");
        commas += std::to_string(array.values.back()) + (last ? "\r\n" : ", ");
      }
      for (const std::string& path : {folder.write("m.npy", to_npy(array)), folder.write("m.txt", text),
                                      folder.write("m.csv", commas)}) {
        const NumberMatrix matrix = read_number_matrix(path);
        EXPECT_EQ(matrix.rows, rows);
        EXPECT_EQ(matrix.columns, columns);
        EXPECT_EQ(matrix.values, array.values);
      }
    }
}

TEST_F(NumberMatrices, NameTheLineThatIsNoRow) {
  EXPECT_THAT(refusal("1 2\n3\n"), HasSubstr("m.txt:2: 1 columns, and 2 in the rows before"));
  EXPECT_THAT(refusal("1 2\n3 x\n"), HasSubstr("m.txt:2: value: 'x'"));
  EXPECT_THAT(refusal("# nothing\n"), HasSubstr("has no numbers"));
  EXPECT_THAT(refusal("text", "m.npy"), HasSubstr("no .npy file"));
}

TEST_F(NumberMatrices, ScoresOfAllPairsAreReadByRowsAndNanIsNone) {
  LoopFileOptions options;
  options.format = LoopFileFormat::kMatrix;
  const std::string path = folder.write("s.txt", "0.5 nan 0.25\nnan 1 -3\n");
  const auto found = read_loop_prediction_file(path, options).predictions;
  ASSERT_EQ(found.size(), 4u);
  EXPECT_EQ(found[1].candidate, FrameId(2));
  EXPECT_EQ(found[2].query, FrameId(1));
  EXPECT_DOUBLE_EQ(found[3].score, -3);
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_THAT(test::message_of<ArgumentError>([&] { (void)predictions_of_matrix({0, infinity}, 2); }),
              HasSubstr("query 0: the score of candidate 1 is infinite"));
}

TEST_F(NumberMatrices, ACandidateIsNamedOnceByASearch) {
  EXPECT_THAT(test::message_of<ArgumentError>([&] { (void)predictions_of_search({4, 4}, {}, 2); }),
              HasSubstr("query 0 has candidate 4 already"));
  EXPECT_THAT(test::message_of<ArgumentError>([&] { (void)predictions_of_search({-2, 4}, {}, 2); }),
              HasSubstr("-2 is not an image"));
  EXPECT_THAT(test::message_of<ArgumentError>([&] { (void)predictions_of_search({1, 2, 3}, {}, 2); }),
              HasSubstr("no matrix"));
}

TEST(NameIndex, FindsPathsAndEndsThatOnlyOneImageHas) {
  const NameIndex index({"a/1.jpg", "b/1.jpg", "b/2.jpg"});
  EXPECT_EQ(index.find("b/1.jpg"), FrameId(1));
  EXPECT_EQ(index.find("somewhere/else/2.jpg"), FrameId(2));
  EXPECT_EQ(index.find("1.jpg"), std::nullopt);
  EXPECT_EQ(index.find("3.jpg"), std::nullopt);
  EXPECT_EQ(NameIndex({"c.jpg", "c.jpg"}).find("c.jpg"), std::nullopt);
}

}  // namespace number_matrix_test
}  // namespace placegraph
