#include <gtest/gtest.h>
#include <placegraph/graph/recognition/word_tree.h>

namespace placegraph {
namespace word_tree_test {

WordTree tree_of(std::vector<WordTree::Node> nodes, int words) {
  WordTree tree;
  tree.nodes = std::move(nodes);
  tree.words = words;
  tree.bit_centres.resize(tree.nodes.size());
  tree.idf.assign(static_cast<std::size_t>(words), 1);
  return tree;
}

TEST(WordTree, FindsNothingWrongWithATree) {
  EXPECT_FALSE(tree_of({{-1, 0, 0}}, 1).problem());
  EXPECT_FALSE(tree_of({{1, 2, -1}, {3, 1, -1}, {-1, 0, 0}, {-1, 0, 1}}, 2).problem());
}

TEST(WordTree, NamesTheNodeThatIsWrong) {
  EXPECT_EQ(tree_of({}, 0).problem(), "no root");
  EXPECT_EQ(tree_of({{0, 1, -1}}, 0).problem(), "node 0 has children outside the tree");
  EXPECT_EQ(tree_of({{1, 3, -1}, {-1, 0, 0}}, 1).problem(), "node 0 has children outside the tree");
  EXPECT_EQ(tree_of({{-1, 0, 0}, {-1, 0, 0}}, 1).problem(), "node 1 has no parent");
  EXPECT_EQ(tree_of({{1, 2, -1}, {2, 1, -1}, {-1, 0, 0}}, 1).problem(), "node 2 has two parents");
  EXPECT_EQ(tree_of({{1, 2, -1}, {-1, 0, 0}, {-1, 0, 0}}, 1).problem(),
            "node 2 has another's word");
  EXPECT_EQ(tree_of({{1, 1, -1}, {-1, 0, 5}}, 1).problem(), "node 1 is a leaf without a word");
  EXPECT_EQ(tree_of({{-1, 0, 0}}, 2).problem(), "a word has no leaf");
  WordTree tree = tree_of({{-1, 0, 0}}, 1);
  tree.idf.clear();
  EXPECT_EQ(tree.problem(), "not one weight per word");
  tree.bit_centres.clear();
  EXPECT_EQ(tree.problem(), "not one centre per node");
}

}  // namespace word_tree_test
}  // namespace placegraph
