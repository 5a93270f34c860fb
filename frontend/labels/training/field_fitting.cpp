#include <placegraph/frontend/labels/training/field_fitting.h>
#include <placegraph/frontend/labels/label_field.h>
#include <placegraph/frontend/labels/scene_labeller.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace placegraph {
namespace {

/// Predictions of the field with given weights for the examples that are used to choose them.
class FieldTrial {
 public:
  FieldTrial(const std::vector<SceneExample>& examples, const SceneTrainingSet& training_set,
             const std::vector<float>& shares, const RelationTable& relations)
      : examples_(examples),
        training_set_(training_set),
        shares_(shares),
        relations_(relations),
        n_(static_cast<std::size_t>(training_set.classes())) {}

  /// Pixel accuracy plus mean intersection over union.
  double score(double smoothness, double relation) const {
    std::vector<double> truth(n_, 0), prediction(n_, 0), both(n_, 0);
    for (std::size_t e = 0; e < examples_.size(); ++e) {
      if (!judges_field(e, examples_.size())) continue;
      const std::vector<float> q = marginals_of(e, smoothness, relation);
      for (std::size_t i = 0; i < q.size(); i += n_) {
        const auto best = static_cast<std::size_t>(
                              std::max_element(q.begin() + static_cast<std::ptrdiff_t>(i),
                                               q.begin() + static_cast<std::ptrdiff_t>(i + n_)) -
                              q.begin()) -
                          i;
        for (std::size_t c = 0; c < n_; ++c)
          truth[c] += examples_[e].pixels[i + c], prediction[best] += examples_[e].pixels[i + c];
        both[best] += examples_[e].pixels[i + best];
      }
    }
    double right = 0, all = 1e-9, overlap = 0, present = 1e-9;
    for (std::size_t c = 0; c < n_; ++c) {
      right += both[c], all += truth[c];
      if (truth[c] > 0) overlap += both[c] / (truth[c] + prediction[c] - both[c]), present += 1;
    }
    return right / all + overlap / present;
  }

  /// Exponent with the least mean -log of the correct class's probability.
  float sharpness(double smoothness, double relation) const {
    // Candidates. Chosen.
    constexpr std::array<float, 9> kPowers = {0.5f, 0.6f, 0.7f, 0.85f, 1.0f,
                                              1.2f, 1.4f, 1.7f, 2.0f};
    std::array<double, kPowers.size()> cost{};
    for (std::size_t e = 0; e < examples_.size(); ++e) {
      if (!judges_field(e, examples_.size())) continue;
      const std::vector<float> q = marginals_of(e, smoothness, relation);
      for (std::size_t k = 0; k < kPowers.size(); ++k) {
        std::vector<float> p = q;
        sharpen(p, training_set_.classes(), kPowers[k]);
        for (std::size_t i = 0; i < p.size(); ++i)
          cost[k] -= examples_[e].pixels[i] * static_cast<double>(std::log(std::max(p[i], 1e-6f)));
      }
    }
    return kPowers[static_cast<std::size_t>(std::min_element(cost.begin(), cost.end()) -
                                            cost.begin())];
  }

 private:
  std::vector<float> marginals_of(std::size_t e, double smoothness, double relation) const {
    const SceneExample& example = examples_[e];
    const auto begin = shares_.begin() + static_cast<std::ptrdiff_t>(training_set_.first_share(e));
    const std::vector<float> shares(
        begin, begin + static_cast<std::ptrdiff_t>(
                           static_cast<std::size_t>(example.superpixels.count) * n_));
    return field_marginals({training_set_.classes(), smoothness, relation, relations_}, shares,
                           example.superpixels, example.features);
  }

  const std::vector<SceneExample>& examples_;
  const SceneTrainingSet& training_set_;
  const std::vector<float>& shares_;
  const RelationTable& relations_;
  std::size_t n_;
};

}  // namespace

RelationTable learn_relations(const std::vector<SceneExample>& examples,
                              const SceneTrainingSet& training_set) {
  RelationCounts counts(training_set.rows.classes);
  for (std::size_t e = 0; e < examples.size(); ++e) {
    std::vector<int> labels;
    for (int i = 0; i < examples[e].superpixels.count; ++i) {
      const int label =
          training_set.rows.label[static_cast<std::size_t>(training_set.first_row[e] + i)];
      labels.push_back(label == ForestTrainingSet::kVoid ? -1 : label);
    }
    counts.add(examples[e].superpixels, labels);
  }
  return counts.table();
}

void fit_field(const std::vector<SceneExample>& examples, const SceneTrainingSet& training_set,
               const std::vector<float>& shares, SceneModel& model) {
  const FieldTrial field(examples, training_set, shares, model.relations);
  double best = -1;
  for (const double smoothness : {0.0, 0.5, 1.0, 2.0, 3.0})
    for (const double relation : {0.0, 0.15, 0.3, 0.6}) {
      const double score = field.score(smoothness, relation);
      if (score <= best) continue;
      best = score;
      model.smoothness = static_cast<float>(smoothness);
      model.relation_weight = static_cast<float>(relation);
    }
  model.sharpness = field.sharpness(static_cast<double>(model.smoothness),
                                    static_cast<double>(model.relation_weight));
}

}  // namespace placegraph
