// What commands say of pairs of images, held against what people marked: planes of point matches
// and matches of segments.
#include <fmt/format.h>
#include <placegraph/io/internal/files/text_file.h>

#include <cstdio>
#include <exception>
#include <sstream>

#include "tests/support/scenes/planes_world.h"
#include "tests/support/segment_groups.h"

namespace placegraph {
namespace {

/// Column `column`, from 0, of the lines of a file.
std::vector<int> read_column(const std::string& path, int column) {
  TextFile file(path);
  std::vector<int> values;
  for (std::string_view line; file.next_data(line);) {
    std::istringstream fields{std::string(line)};
    std::string field;
    for (int i = 0; i <= column; ++i) fields >> field;
    values.push_back(std::stoi(field));
  }
  return values;
}

void score_planes(const std::string& truth_file, const std::string& labels_file) {
  constexpr int kTruth = 4;  // xA yA xB yB label
  const std::vector<int> truth = read_column(truth_file, kTruth);
  const double wrong = test::misclassification(truth, read_column(labels_file, 0));
  fmt::print("matches\t{}\nplanes\t{}\nmisclassified_percent\t{:.3f}\n", truth.size(),
             *std::max_element(truth.begin(), truth.end()), 100 * wrong);
}

void score_lines(const std::string& groups_file, const std::string& matches_file) {
  const std::vector<int> a = read_column(matches_file, 0), b = read_column(matches_file, 1);
  std::set<std::pair<int, int>> found;
  for (std::size_t i = 0; i < a.size(); ++i) found.emplace(a[i], b[i]);
  const auto groups = test::read_segment_groups(groups_file);
  const test::SegmentJudgement judgement = test::judge_segment_matches(found, groups);
  fmt::print("groups\t{}\nmatches\t{}\nprecision\t{:.4f}\nrecall\t{:.4f}\nrecall_pairs\t{:.4f}\n",
             groups.size(), found.size(), judgement.precision, judgement.recall_groups,
             judgement.recall_pairs);
}

}  // namespace
}  // namespace placegraph

int main(int argc, char** argv) {
  const std::string what = argc == 4 ? argv[1] : "";
  try {
    if (what == "planes")
      placegraph::score_planes(argv[2], argv[3]);
    else if (what == "lines")
      placegraph::score_lines(argv[2], argv[3]);
    else
      throw std::runtime_error(
          "usage: bench_pair_scores planes TRUTH LABELS | lines GROUPS MATCHES");
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
  return 0;
}
