#include <fmt/format.h>
#include <placegraph/graph/core/median.h>
#include <placegraph/pipeline/health/depth_unit_check.h>

#include <algorithm>

namespace placegraph {

void DepthUnitCheck::add(const Frame& frame) {
  // Chosen: one image in ten and one pixel in 64 give the median at little cost.
  constexpr int kFramesAnImage = 10, kStepPx = 8;
  // Distances of an image with a median. Chosen.
  constexpr std::size_t kFewest = 100;
  if (frame.depth.empty() || frames_++ % kFramesAnImage != 0) return;
  std::vector<float> distances;
  for (int v = 0; v < frame.depth.rows; v += kStepPx)
    for (int u = 0; u < frame.depth.cols; u += kStepPx)
      if (const float z = frame.depth.at<float>(v, u); z > 0) distances.push_back(z);
  if (distances.size() < kFewest) return;
  const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
  std::nth_element(distances.begin(), middle, distances.end());
  medians_m_.push_back(*middle);
}

std::optional<DataNote> DepthUnitCheck::note() const {
  // Images that are judged. Chosen.
  constexpr std::size_t kFewest = 3;
  // Depth cameras measure from about 0.3 to 10 m (docs/datasets.md). Chosen by the faults of group
  // "fixed" (tests/faults/README.md).
  constexpr double kNearest_m = 0.4, kFarthest_m = 8;
  if (medians_m_.size() < kFewest) return std::nullopt;
  const double median_m = median_of(medians_m_);
  if (median_m > kNearest_m && median_m < kFarthest_m) return std::nullopt;
  return DataNote{fmt::format("half of the distances in the depth images are {} {:.3g} m: depth "
                              "cameras measure from about 0.3 to 10 m",
                              median_m < kNearest_m ? "below" : "beyond", median_m),
                  true, NoteCause::kDepthUnit,
                  "give the unit of the depth images: 1 mm, or a 5000th of a metre as in TUM's "
                  "folders"};
}

}  // namespace placegraph
