#include <placegraph/frontend/labels/label_field.h>
#include <placegraph/frontend/labels/model_growth.h>
#include <placegraph/frontend/labels/scene_training.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>

namespace placegraph {

void SceneTrainingOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, SceneTrainingOptions& o) {
  field.group("forest", o.forest, "of both rounds");
  field("variants", o.variants, "of each picture: itself, and as another day might show it",
        {1, 50});
  field("class_power", o.class_power, "rare classes weigh as share^-power", {0, 1});
  field("block", o.block, "pictures of a drive one after the other that are alike", {1, 10000});
}

Image fit_labels(const Image& labels, const Image& picture) {
  if (labels.size() == picture.size()) return labels;
  Image fitted;
  cv::resize(labels, fitted, picture.size(), 0, 0, cv::INTER_NEAREST);
  return fitted;
}

SceneExample make_example(const Image& picture, const Image& labels, int classes, int block) {
  require(labels.type() == CV_8UC1 && labels.size() == picture.size(),
          "make_example: labels of another size");
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

namespace {

/// The class most pixels have, if they are half of all; else void.
int class_of(const int* pixels, int classes, int area) {
  const int* best = std::max_element(pixels, pixels + classes);
  return *best > 0 && 2 * *best >= area ? static_cast<int>(best - pixels) : ForestLesson::kVoid;
}

class Trainer {
 public:
  Trainer(SceneModel model, std::vector<SceneExample> examples, const SceneTrainingOptions& options,
          int threads)
      : model_(std::move(model)),
        examples_(std::move(examples)),
        options_(options),
        threads_(threads),
        n_(static_cast<std::size_t>(model_.class_count())) {}

  SceneModel train(const std::function<void(const std::string&)>& say, const SceneModel* base) {
    make_lesson();
    say("learning what superpixels show, from " + std::to_string(lesson_.rows()) + " of them");
    TrainedForest first = train_forest(lesson_, options_.forest, threads_);
    add_context(first.unseen);
    say("learning what lies around them");
    ForestOptions second_options = options_.forest;
    ++second_options.seed;
    const TrainedForest second = train_forest(lesson_, second_options, threads_);
    model_.first = std::move(first.forest);
    model_.second = second.forest;
    say("learning how classes lie to each other");
    learn_relations();
    fit_field(second.unseen);
    if (base) keep_trees(*base, model_);
    return std::move(model_);
  }

 private:
  // Rows of all examples, feature by feature; the rows themselves are let go of but for what the
  // random field needs.
  void make_lesson() {
    lesson_.classes = model_.class_count();
    std::size_t rows = 0;
    for (const SceneExample& example : examples_)
      rows += static_cast<std::size_t>(example.superpixels.count);
    lesson_.columns.resize(kSuperpixelFeatures);
    for (auto& column : lesson_.columns) column.reserve(rows);
    std::vector<double> shares(n_, 0);
    double sum = 0;
    for (std::size_t e = 0; e < examples_.size(); ++e) {
      SceneExample& example = examples_[e];
      first_row_.push_back(lesson_.rows());
      lesson_.blocks = std::max(lesson_.blocks, example.block + 1);
      for (int i = 0; i < example.superpixels.count; ++i) {
        const int* pixels = example.pixels.data() + static_cast<std::size_t>(i) * n_;
        const int label = class_of(pixels, lesson_.classes,
                                   example.superpixels.shapes[static_cast<std::size_t>(i)].area_px);
        lesson_.label.push_back(static_cast<std::uint8_t>(label));
        lesson_.weight.push_back(label == ForestLesson::kVoid ? 0.0f
                                                              : static_cast<float>(pixels[label]));
        lesson_.block.push_back(example.block);
        if (label != ForestLesson::kVoid)
          shares[static_cast<std::size_t>(label)] += pixels[label], sum += pixels[label];
      }
      for (std::size_t d = 0; d < kSuperpixelFeatures; ++d)
        for (int i = 0; i < example.superpixels.count; ++i)
          lesson_.columns[d].push_back(example.features.row(i)[d]);
      if (!judges_field(e)) example.features = {};
    }
    require(sum > 0, "train_scene_model: no labelled pixel");
    for (std::size_t i = 0; i < lesson_.label.size(); ++i)
      if (lesson_.label[i] != ForestLesson::kVoid)
        lesson_.weight[i] *=
            static_cast<float>(std::pow(shares[lesson_.label[i]] / sum, -options_.class_power));
  }

  /// Whether the field's weights are chosen by this example: some hundred are enough.
  bool judges_field(std::size_t example) const {
    return example % (examples_.size() / 120 + 1) == 0;
  }

  void add_context(const std::vector<float>& unseen) {
    const int dimension = context_dimension(lesson_.classes);
    lesson_.columns.resize(kSuperpixelFeatures + static_cast<std::size_t>(dimension));
    for (std::size_t d = kSuperpixelFeatures; d < lesson_.columns.size(); ++d)
      lesson_.columns[d].reserve(lesson_.label.size());
    for (std::size_t e = 0; e < examples_.size(); ++e) {
      const int count = examples_[e].superpixels.count;
      ByteFeatures bytes{count, lesson_.classes, {}};
      const float* shares = unseen.data() + static_cast<std::size_t>(first_row_[e]) * n_;
      for (std::size_t k = 0; k < static_cast<std::size_t>(count) * n_; ++k)
        bytes.values.push_back(static_cast<std::uint8_t>(shares[k] * 255 + 0.5f));
      const ByteFeatures context = context_features(bytes, examples_[e].superpixels);
      for (int d = 0; d < dimension; ++d)
        for (int i = 0; i < count; ++i)
          lesson_.columns[static_cast<std::size_t>(kSuperpixelFeatures + d)].push_back(
              context.row(i)[d]);
    }
  }

  void learn_relations() {
    RelationCounts counts(lesson_.classes);
    for (std::size_t e = 0; e < examples_.size(); ++e) {
      std::vector<int> labels;
      for (int i = 0; i < examples_[e].superpixels.count; ++i) {
        const int label = lesson_.label[static_cast<std::size_t>(first_row_[e] + i)];
        labels.push_back(label == ForestLesson::kVoid ? -1 : label);
      }
      counts.add(examples_[e].superpixels, labels);
    }
    model_.relations = counts.table();
  }

  std::vector<float> marginals_of(std::size_t e, const std::vector<float>& unseen,
                                  double smoothness, double relation) const {
    const SceneExample& example = examples_[e];
    const auto begin =
        unseen.begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(first_row_[e]) * n_);
    const std::vector<float> shares(
        begin, begin + static_cast<std::ptrdiff_t>(
                           static_cast<std::size_t>(example.superpixels.count) * n_));
    return field_marginals({lesson_.classes, smoothness, relation, model_.relations}, shares,
                           example.superpixels, example.features);
  }

  /// Pixel accuracy plus mean intersection over union of the examples that judge the field.
  double field_score(const std::vector<float>& unseen, double smoothness, double relation) const {
    std::vector<double> truth(n_, 0), answer(n_, 0), both(n_, 0);
    for (std::size_t e = 0; e < examples_.size(); ++e) {
      if (!judges_field(e)) continue;
      const std::vector<float> q = marginals_of(e, unseen, smoothness, relation);
      for (std::size_t i = 0; i < q.size(); i += n_) {
        const auto best = static_cast<std::size_t>(
                              std::max_element(q.begin() + static_cast<std::ptrdiff_t>(i),
                                               q.begin() + static_cast<std::ptrdiff_t>(i + n_)) -
                              q.begin()) -
                          i;
        for (std::size_t c = 0; c < n_; ++c)
          truth[c] += examples_[e].pixels[i + c], answer[best] += examples_[e].pixels[i + c];
        both[best] += examples_[e].pixels[i + best];
      }
    }
    double right = 0, all = 1e-9, overlap = 0, present = 1e-9;
    for (std::size_t c = 0; c < n_; ++c) {
      right += both[c], all += truth[c];
      if (truth[c] > 0) overlap += both[c] / (truth[c] + answer[c] - both[c]), present += 1;
    }
    return right / all + overlap / present;
  }

  void fit_field(const std::vector<float>& unseen) {
    double best = -1;
    for (const double smoothness : {0.0, 0.5, 1.0, 2.0, 3.0})
      for (const double relation : {0.0, 0.15, 0.3, 0.6}) {
        const double score = field_score(unseen, smoothness, relation);
        if (score <= best) continue;
        best = score;
        model_.smoothness = static_cast<float>(smoothness);
        model_.relation_weight = static_cast<float>(relation);
      }
    fit_sharpness(unseen);
  }

  /// The exponent with the least mean -log of the right class's probability.
  void fit_sharpness(const std::vector<float>& unseen) {
    constexpr std::array<float, 9> kPowers = {0.5f, 0.6f, 0.7f, 0.85f, 1.0f,
                                              1.2f, 1.4f, 1.7f, 2.0f};
    std::array<double, kPowers.size()> cost{};
    for (std::size_t e = 0; e < examples_.size(); ++e) {
      if (!judges_field(e)) continue;
      const std::vector<float> q = marginals_of(e, unseen, static_cast<double>(model_.smoothness),
                                                static_cast<double>(model_.relation_weight));
      for (std::size_t k = 0; k < kPowers.size(); ++k) {
        std::vector<float> p = q;
        sharpen(p, lesson_.classes, kPowers[k]);
        for (std::size_t i = 0; i < p.size(); ++i)
          cost[k] -= examples_[e].pixels[i] * static_cast<double>(std::log(std::max(p[i], 1e-6f)));
      }
    }
    model_.sharpness = kPowers[static_cast<std::size_t>(std::min_element(cost.begin(), cost.end()) -
                                                        cost.begin())];
  }

  SceneModel model_;
  std::vector<SceneExample> examples_;
  const SceneTrainingOptions& options_;
  int threads_;
  std::size_t n_;
  ForestLesson lesson_;
  std::vector<int> first_row_;
};

}  // namespace

SceneModel train_scene_model(SceneModel model, std::vector<SceneExample> examples,
                             const SceneTrainingOptions& options, int threads,
                             const std::function<void(const std::string&)>& say,
                             const SceneModel* base) {
  options.check();
  require(model.class_count() >= 2 && !examples.empty(),
          "train_scene_model: nothing to learn from");
  for (const SceneExample& example : examples)
    require(example.pixels.size() ==
                static_cast<std::size_t>(example.superpixels.count) * model.classes.size(),
            "train_scene_model: an example of other classes");
  return Trainer(std::move(model), std::move(examples), options, threads).train(say, base);
}

}  // namespace placegraph
