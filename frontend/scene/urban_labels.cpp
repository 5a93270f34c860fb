#include <placegraph/frontend/scene/urban_labels.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace placegraph {

UrbanLabels label_urban(const SceneModel& urban, const SceneModel& surfaces, const SceneView& view,
                        const LabellerOptions& options) {
  require(urban.kind == SceneModel::Kind::kUrban && surfaces.kind == SceneModel::Kind::kSurfaces &&
              surfaces.class_count() == kSurfaceCount,
          "label_urban: a model of urban classes and one of surfaces are needed");
  constexpr float kOfSurfaces = 0.5f;  // two views of the same superpixels: half as good as two
  const auto n = urban.classes.size();
  UrbanLabels result;
  result.classes = classify_superpixels(urban, view, options);
  const std::vector<float> geometry = classify_superpixels(surfaces, view, options);
  result.surfaces.assign(geometry.size(), 0.0f);
  for (std::size_t i = 0; i < static_cast<std::size_t>(view.superpixels.count); ++i) {
    float* p = result.classes.data() + i * n;
    const float* g = geometry.data() + i * kSurfaceCount;
    std::array<float, kSurfaceCount> before{};
    for (std::size_t c = 0; c < n; ++c) before[static_cast<std::size_t>(urban.surfaces[c])] += p[c];
    // The surface's probability is pooled with what the classes say of it, and shared out again.
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

}  // namespace placegraph
