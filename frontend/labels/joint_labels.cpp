#include <placegraph/frontend/labels/joint_labels.h>
#include <placegraph/frontend/labels/label_field.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace placegraph {
namespace {

void require_kinds(const SceneModel& urban, const SceneModel& surfaces) {
  require(urban.kind == SceneModel::Kind::kUrban && surfaces.kind == SceneModel::Kind::kSurfaces &&
              surfaces.class_count() == kSurfaceCount,
          "label_jointly: needs a model of urban classes and one of surfaces");
}

/// Probability of each surface by the classes of a superpixel.
std::array<float, kSurfaceCount> surface_shares(const SceneModel& urban, const float* p) {
  std::array<float, kSurfaceCount> shares{};
  for (std::size_t c = 0; c < urban.classes.size(); ++c)
    shares[static_cast<std::size_t>(urban.surfaces[c])] += p[c];
  return shares;
}

/// Pools the probabilities of the surface by its model and by the classes, and rescales the
/// classes.
JointLabels pool(const SceneModel& urban, std::vector<float> classes,
                 const std::vector<float>& geometry) {
  // Two estimates from the same superpixels are not independent.
  constexpr float kOfSurfaces = 0.5f;
  const auto n = urban.classes.size();
  JointLabels result;
  result.classes = std::move(classes);
  result.surfaces.assign(geometry.size(), 0.0f);
  for (std::size_t i = 0; i < geometry.size() / kSurfaceCount; ++i) {
    float* p = result.classes.data() + i * n;
    const float* g = geometry.data() + i * kSurfaceCount;
    const std::array<float, kSurfaceCount> before = surface_shares(urban, p);
    std::array<float, kSurfaceCount> pooled{};
    float sum = 0;
    for (std::size_t s = 0; s < kSurfaceCount; ++s)
      sum += pooled[s] =
          before[s] > 0 ? std::pow(before[s], 1 - kOfSurfaces) * std::pow(g[s], kOfSurfaces) : 0.0f;
    if (sum <= 0) sum = 1, std::copy(before.begin(), before.end(), pooled.begin());
    for (std::size_t s = 0; s < kSurfaceCount; ++s)
      result.surfaces[i * kSurfaceCount + s] = pooled[s] / sum;
    for (std::size_t c = 0; c < n; ++c) {
      const auto s = static_cast<std::size_t>(urban.surfaces[c]);
      if (before[s] > 0) p[c] *= pooled[s] / sum / before[s];
    }
  }
  return result;
}

}  // namespace

JointLabels label_jointly(const SceneModel& urban, const SceneModel& surfaces,
                          const SceneView& view, const LabellerOptions& options) {
  require_kinds(urban, surfaces);
  std::vector<float> classes = classify_superpixels(urban, view, options);
  return pool(urban, std::move(classes), classify_superpixels(surfaces, view, options));
}

JointLabels join_evidence(const SceneModel& urban, const JointLabels& alone, const SceneView& view,
                          const std::vector<float>& log_likelihoods,
                          const LabellerOptions& options) {
  const auto n = urban.classes.size();
  const std::size_t size = static_cast<std::size_t>(view.superpixels.count) * n;
  require(log_likelihoods.size() == size && alone.classes.size() == size,
          "join_evidence: needs a likelihood for each superpixel and class");
  JointLabels result = alone;
  for (std::size_t i = 0; i < static_cast<std::size_t>(view.superpixels.count); ++i) {
    float* p = result.classes.data() + i * n;
    const float* log_likelihood = log_likelihoods.data() + i * n;
    const float most = *std::max_element(log_likelihood, log_likelihood + n);
    float sum = 0;
    for (std::size_t c = 0; c < n; ++c)
      sum += p[c] = std::max(p[c], 1e-4f) * std::exp(log_likelihood[c] - most);
    for (std::size_t c = 0; c < n; ++c) p[c] /= sum;
  }
  LabelField field{urban.class_count(), 0, 0, urban.relations};
  if (options.field) field.smoothness = static_cast<double>(urban.smoothness);
  if (options.field && options.relations)
    field.relation_weight = static_cast<double>(urban.relation_weight);
  result.classes = field_marginals(field, result.classes, view.superpixels, view.features);
  for (std::size_t i = 0; i < static_cast<std::size_t>(view.superpixels.count); ++i) {
    const auto shares = surface_shares(urban, result.classes.data() + i * n);
    std::copy(shares.begin(), shares.end(),
              result.surfaces.begin() + static_cast<std::ptrdiff_t>(i * kSurfaceCount));
  }
  return result;
}

SceneLabels street_labels(const std::vector<float>& probabilities, int classes,
                          const SceneView& view, double street, double unknown_below) {
  require(street >= 0 && street <= 1, "street_labels: a probability is needed");
  constexpr double kNever = 2;
  const double least = street > 0 ? (1 - street) / street : kNever;  // street P(c) >= 1 - street
  return most_probable(probabilities, classes, view, std::max(least, unknown_below));
}

}  // namespace placegraph
