#include <placegraph/frontend/labels/training/scene_training_set.h>
#include <placegraph/frontend/labels/training/scene_variants.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/parallel.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace placegraph {
namespace {

/// Class of most pixels if they are at least half of all, else void.
int class_of(const int* pixels, int classes, int area) {
  const int* best = std::max_element(pixels, pixels + classes);
  return *best > 0 && 2 * *best >= area ? static_cast<int>(best - pixels)
                                        : ForestTrainingSet::kVoid;
}

/// Block of each image: up to `most` consecutive images of one sequence, which are similar.
std::vector<int> blocks_of(const std::vector<SceneTrainingImage>& images, int most) {
  std::vector<int> block;
  int in_block = 0;
  for (std::size_t i = 0; i < images.size(); ++i) {
    const bool same = i > 0 && images[i].sequence == images[i - 1].sequence;
    const bool full = ++in_block > most;
    if (!same || full) in_block = 1;
    block.push_back(i == 0 ? 0 : block.back() + (!same || full ? 1 : 0));
  }
  return block;
}

}  // namespace

Image fit_labels(const Image& labels, const Image& picture) {
  if (labels.size() == picture.size()) return labels;
  Image fitted;
  cv::resize(labels, fitted, picture.size(), 0, 0, cv::INTER_NEAREST);
  return fitted;
}

SceneExample make_example(const Image& picture, const Image& labels, int classes, int block) {
  require(labels.type() == CV_8UC1 && labels.size() == picture.size(),
          "make_example: the labels have another size");
  SceneView view = view_scene(picture);
  SceneExample example;
  example.block = block;
  example.features = std::move(view.features);
  example.superpixels = std::move(view.superpixels);
  const Image& index = example.superpixels.index;
  const Image fitted = fit_labels(labels, index);
  example.pixels.assign(static_cast<std::size_t>(example.superpixels.count * classes), 0);
  for (int v = 0; v < index.rows; ++v)
    for (int u = 0; u < index.cols; ++u) {
      const int label = fitted.at<std::uint8_t>(v, u);
      if (label < classes)
        ++example.pixels[static_cast<std::size_t>(index.at<int>(v, u) * classes + label)];
    }
  example.superpixels.index = Image();
  return example;
}

std::vector<SceneExample> make_examples(const std::vector<SceneTrainingImage>& images, int classes,
                                        const SceneTrainingOptions& options, int threads,
                                        const std::function<void(std::size_t)>& described) {
  const int count = static_cast<int>(images.size()) * options.variants;
  const std::vector<int> block = blocks_of(images, options.block);
  std::vector<SceneExample> examples(static_cast<std::size_t>(count));
  constexpr int kPart = 16;  // images between two reports of the progress
  for (int begin = 0; begin < count; begin += kPart) {
    parallel_for(std::min(kPart, count - begin), threads, [&](int k) {
      const auto at = static_cast<std::size_t>(begin + k), which = at % images.size();
      const std::size_t variant = at / images.size();
      const auto [image, labels_of_image] = images[which].read();
      Image bgr = scene_picture(image);
      Image labels = fit_labels(labels_of_image, bgr);
      if (variant > 0) {
        Random random(options.forest.seed, at);
        SceneVariant drawn = vary_scene(bgr, labels, 255, variant % 2 == 1, random);
        bgr = drawn.bgr, labels = drawn.labels;
      }
      examples[at] = make_example(bgr, labels, classes, block[which]);
    });
    if (described) described(static_cast<std::size_t>(std::min(begin + kPart, count)));
  }
  return examples;
}

bool judges_field(std::size_t example, std::size_t examples) {
  return example % (examples / 120 + 1) == 0;
}

SceneTrainingSet make_training_set(std::vector<SceneExample>& examples, int classes,
                                   double class_power) {
  SceneTrainingSet result;
  ForestTrainingSet& training_set = result.rows;
  const auto n = static_cast<std::size_t>(classes);
  training_set.classes = classes;
  std::size_t rows = 0;
  for (const SceneExample& example : examples)
    rows += static_cast<std::size_t>(example.superpixels.count);
  training_set.columns.resize(kSuperpixelFeatures);
  for (auto& column : training_set.columns) column.reserve(rows);
  std::vector<double> shares(n, 0);
  double sum = 0;
  for (std::size_t e = 0; e < examples.size(); ++e) {
    SceneExample& example = examples[e];
    result.first_row.push_back(training_set.rows());
    training_set.blocks = std::max(training_set.blocks, example.block + 1);
    for (int i = 0; i < example.superpixels.count; ++i) {
      const int* pixels = example.pixels.data() + static_cast<std::size_t>(i) * n;
      const int label = class_of(pixels, training_set.classes,
                                 example.superpixels.shapes[static_cast<std::size_t>(i)].area_px);
      training_set.label.push_back(static_cast<std::uint8_t>(label));
      training_set.weight.push_back(
          label == ForestTrainingSet::kVoid ? 0.0f : static_cast<float>(pixels[label]));
      training_set.block.push_back(example.block);
      if (label != ForestTrainingSet::kVoid)
        shares[static_cast<std::size_t>(label)] += pixels[label], sum += pixels[label];
    }
    for (std::size_t d = 0; d < kSuperpixelFeatures; ++d)
      for (int i = 0; i < example.superpixels.count; ++i)
        training_set.columns[d].push_back(example.features.row(i)[d]);
    if (!judges_field(e, examples.size())) example.features = {};
  }
  require(sum > 0, "train_scene_model: no labelled pixel");
  for (std::size_t i = 0; i < training_set.label.size(); ++i)
    if (training_set.label[i] != ForestTrainingSet::kVoid)
      training_set.weight[i] *=
          static_cast<float>(std::pow(shares[training_set.label[i]] / sum, -class_power));
  return result;
}

void add_context(const std::vector<SceneExample>& examples, const std::vector<float>& shares,
                 SceneTrainingSet& training_set) {
  ForestTrainingSet& rows = training_set.rows;
  const int dimension = context_dimension(rows.classes);
  rows.columns.resize(kSuperpixelFeatures + static_cast<std::size_t>(dimension));
  for (std::size_t d = kSuperpixelFeatures; d < rows.columns.size(); ++d)
    rows.columns[d].reserve(rows.label.size());
  for (std::size_t e = 0; e < examples.size(); ++e) {
    const int count = examples[e].superpixels.count;
    ByteFeatures bytes{count, rows.classes, {}};
    const float* seen = shares.data() + training_set.first_share(e);
    for (std::size_t k = 0;
         k < static_cast<std::size_t>(count) * static_cast<std::size_t>(rows.classes); ++k)
      bytes.values.push_back(static_cast<std::uint8_t>(seen[k] * 255 + 0.5f));
    const ByteFeatures context = context_features(bytes, examples[e].superpixels);
    for (int d = 0; d < dimension; ++d)
      for (int i = 0; i < count; ++i)
        rows.columns[static_cast<std::size_t>(kSuperpixelFeatures + d)].push_back(
            context.row(i)[d]);
  }
}

}  // namespace placegraph
