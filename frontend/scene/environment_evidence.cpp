#include <placegraph/frontend/scene/environment.h>
#include <placegraph/frontend/scene/environment_evidence.h>
#include <placegraph/frontend/scene/evidence_kind.h>
#include <placegraph/frontend/scene/scene_masks.h>
#include <placegraph/frontend/vanishing/manhattan_frame.h>
#include <placegraph/graph/core/quantile.h>

#include <algorithm>
#include <cmath>

namespace placegraph {
namespace {

double log_of(double length) { return std::log10(std::max(1e-2, length)); }

}  // namespace

const std::array<const char*, kEvidenceCount>& evidence_names() {
  static const std::array<const char*, kEvidenceCount> names{
      "sky_above", "ground_above", "vertical_above", "ground_below", "vertical_below",
      "object",    "lines",        "upright",        "level",        "rectangular",
      "spread",    "tall",         "depth",          "side",         "above"};
  return names;
}

void EnvironmentEvidence::see(const SurfaceShares& shares) {
  const auto at = [](const auto& half, Surface s) { return half[static_cast<std::size_t>(s)]; };
  values[kSkyAbove] = at(shares.above, Surface::kSky);
  values[kGroundAbove] = at(shares.above, Surface::kGround);
  values[kVerticalAbove] = at(shares.above, Surface::kVertical);
  values[kGroundBelow] = at(shares.below, Surface::kGround);
  values[kVerticalBelow] = at(shares.below, Surface::kVertical);
  values[kObject] = (at(shares.above, Surface::kObject) + at(shares.below, Surface::kObject)) / 2;
}

void EnvironmentEvidence::see(const std::vector<LineSegment>& segments, const Camera& camera) {
  constexpr double kTilt = 0.14;  // sine of 8 degrees
  double all = 0, upright = 0, level = 0, rectangular = 0;
  for (const LineSegment& segment : segments) {
    const double length = segment.length();
    all += length;
    if (std::abs(segment.vector().x()) < kTilt * length) upright += length;
    if (std::abs(segment.vector().y()) < kTilt * length) level += length;
  }
  values[kLines] = std::log10(1e-2 + all / (camera.width + camera.height));
  if (segments.size() < 10) return;
  Random random(0);
  const ManhattanFrame frame = estimate_manhattan_frame(segments, camera, {}, {}, random);
  if (frame.outcome)
    for (std::size_t i = 0; i < segments.size(); ++i)
      if (frame.axis[i] >= 0) rectangular += segments[i].length();
  values[kUpright] = upright / all;
  values[kLevel] = level / all;
  values[kRectangular] = rectangular / all;
}

void EnvironmentEvidence::see(const std::vector<Eigen::Vector3d>& points_cam, bool metric) {
  // Points with quantiles. Chosen.
  constexpr std::size_t kFewest = 20;
  std::vector<double> depth, side, above;
  for (const Eigen::Vector3d& p : points_cam) {
    if (!(p.z() > 0)) continue;
    depth.push_back(p.z());
    side.push_back(std::abs(p.x()));
    above.push_back(-p.y());
  }
  if (depth.size() < kFewest) return;
  const double middle = quantile_of(depth, 0.5), high = quantile_of(above, 0.95);
  values[kSpread] = std::log10(quantile_of(depth, 0.9) / quantile_of(depth, 0.1));
  values[kTall] = high / middle;
  if (!metric) return;
  values[kDepth] = log_of(middle);
  values[kSide] = log_of(quantile_of(side, 0.5));
  values[kAbove] = log_of(high);
}

}  // namespace placegraph
