// Evaluates a custom place recognizer: judge_recognizer SEQUENCE
// The ground truth of the sequence determines which images show the same place.
#include <placegraph/eval/loops/loop_benchmark.h>
#include <placegraph/eval/loops/loop_truth_from_poses.h>
#include <placegraph/placegraph.h>

#include <cstdio>

using namespace placegraph;

/// The descriptor of an image: its mean grey values in cells of 40 x 40 pixels.
Eigen::VectorXd describe(const Image& image) {
  const int rows = image.rows / 40, cols = image.cols / 40;
  Eigen::VectorXd cells = Eigen::VectorXd::Zero(rows * cols);
  for (int v = 0; v < rows * 40; ++v)
    for (int u = 0; u < cols * 40; ++u)
      cells[v / 40 * cols + u / 40] += image.at<unsigned char>(v, u);
  cells.array() -= cells.mean();
  return cells.normalized();
}

int main(int argc, char** argv) try {
  if (argc != 2) {
    std::fprintf(stderr, "usage: %s SEQUENCE\n", argv[0]);
    return 2;
  }
  const auto dataset = open_dataset(argv[1]);
  if (!dataset->ground_truth()) throw ArgumentError(std::string(argv[1]) + ": no ground truth");
  RevisitOptions revisit;
  revisit.min_age = 20;  // images; younger ones are similar because the camera has hardly moved

  std::vector<Eigen::VectorXd> views;
  std::vector<LoopPrediction> predictions;
  for (std::size_t i = 0; i < dataset->size(); ++i) {
    views.push_back(describe(dataset->frame(i, Sensor::kMono).image));
    LoopPrediction best;
    best.query = FrameId(static_cast<std::int64_t>(i));
    best.score = -1;
    for (std::size_t j = 0; j + static_cast<std::size_t>(revisit.min_age) <= i; ++j)
      if (const double similarity = views[i].dot(views[j]); similarity > best.score) {
        best.candidate = FrameId(static_cast<std::int64_t>(j));
        best.score = similarity;
      }
    if (best.score > -1) predictions.push_back(best);
  }
  const LoopTruth truth = loop_truth_from_poses(*dataset->ground_truth(), revisit);
  const LoopBenchmark result = judge_loops(truth, predictions);
  std::printf("%d images show a place again; average precision %.3f\n", result.positives,
              result.curve.average_precision.value_or(0));
  return 0;
} catch (const Error& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}
