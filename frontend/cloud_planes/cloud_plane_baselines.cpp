#include <placegraph/frontend/cloud_planes/cloud_plane_baselines.h>
#include <placegraph/graph/core/angle.h>
#include <placegraph/graph/core/random.h>
#include <placegraph/graph/core/ransac.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace placegraph {
namespace {

/// Points around one, by neighbours of neighbours, itself first.
void patch_of(const CloudPoints& points, int i, std::size_t count, std::vector<int>& patch) {
  patch.assign(1, i);
  for (std::size_t k = 0; k < patch.size() && patch.size() < count; ++k)
    for (int n = points.begin[patch[k]]; n < points.begin[patch[k] + 1]; ++n)
      if (std::find(patch.begin(), patch.end(), points.neighbours[n]) == patch.end())
        patch.push_back(points.neighbours[n]);
}

/// Largest connected piece of marked points; its marks are reset to 0.
std::vector<int> largest_piece(const CloudPoints& points, const std::vector<int>& marked,
                               std::vector<char>& mark) {
  std::vector<int> best, piece;
  for (const int i : marked) mark[i] = 1;
  for (const int start : marked) {
    if (!mark[start]) continue;
    piece.assign(1, start);
    mark[start] = 0;
    for (std::size_t k = 0; k < piece.size(); ++k)
      for (int n = points.begin[piece[k]]; n < points.begin[piece[k] + 1]; ++n) {
        const int j = points.neighbours[n];
        if (!mark[j]) continue;
        mark[j] = 0;
        piece.push_back(j);
      }
    if (piece.size() > best.size()) best.swap(piece);
  }
  return best;
}

FittedPlane fit_to(const CloudPoints& points, const std::vector<int>& some) {
  PlaneSums sums;
  for (const int i : some) sums.add(points.fit[i], points.model);
  return sums.fit(points.model);
}

/// Best of the planes through three points near each other, by the number of sampled points within.
FittedPlane draw_plane(const CloudPoints& points, const std::vector<int>& left,
                       const std::vector<int>& labels, double sigmas, Random& random) {
  // Samples of RANSAC and points that score them: the cost. Chosen.
  constexpr int kDraws = 400, kScored = 2000;
  constexpr std::size_t kLeastPatch = 30, kMostPatch = 400;
  std::vector<int> patch, scored;
  const std::size_t stride = left.size() / kScored + 1;
  for (std::size_t k = 0; k < left.size(); k += stride) scored.push_back(left[k]);
  FittedPlane best;
  int most = 0, needed = kDraws;
  for (int draw = 0; draw < needed; ++draw) {
    const int first = left[random.index(static_cast<int>(left.size()))];
    patch_of(points, first, draw % 2 == 0 ? kLeastPatch : kMostPatch, patch);
    std::erase_if(patch, [&](int i) { return labels[i] >= 0; });
    if (patch.size() < 3) continue;
    const int second = patch[random.index(static_cast<int>(patch.size()))];
    const int third = patch[random.index(static_cast<int>(patch.size()))];
    const FittedPlane plane =
        plane_through(points.xyz[first], points.xyz[second], points.xyz[third]);
    if (!plane.ok) continue;
    int inside = 0;
    for (const int i : scored)
      inside += residual_sigmas(plane, points.fit[i], points.model) < sigmas;
    if (inside <= most) continue;
    most = inside;
    best = plane;
  }
  return best;
}

}  // namespace

PlaneLabels planes_by_ransac(const CloudPoints& points, const CloudPlanesOptions& options) {
  // Planes in a row without enough points that end the search. Chosen.
  constexpr int kFailures = 3;
  Random random(options.seed);
  PlaneLabels result;
  result.labels.assign(points.xyz.size(), -1);
  std::vector<int> left(points.xyz.size());
  std::iota(left.begin(), left.end(), 0);
  std::vector<char> mark(points.xyz.size(), 0);
  int failures = 0;
  while (static_cast<int>(left.size()) >= options.min_points && failures < kFailures) {
    FittedPlane plane = draw_plane(points, left, result.labels, options.inlier_sigmas, random);
    std::vector<int> piece;
    for (int round = 0; round < 3 && plane.ok; ++round) {
      std::vector<int> inside;
      for (const int i : left)
        if (residual_sigmas(plane, points.fit[i], points.model) < options.inlier_sigmas)
          inside.push_back(i);
      piece = largest_piece(points, inside, mark);
      plane = fit_to(points, piece);
    }
    if (!plane.ok || static_cast<int>(piece.size()) < options.min_points) {
      ++failures;
      continue;
    }
    for (const int i : piece) result.labels[i] = static_cast<int>(result.planes.size());
    result.planes.push_back(plane);
    std::erase_if(left, [&](int i) { return result.labels[i] >= 0; });
  }
  refit(points, result);
  return result;
}

PlaneLabels planes_by_growing(const CloudPoints& points, const CloudPlanesOptions& options) {
  // Points of a patch. Chosen.
  constexpr std::size_t kPatch = 25;
  const double rotation_cos = std::cos(deg_to_rad(10));
  PlaneLabels result;
  result.labels.assign(points.xyz.size(), -1);
  std::vector<FittedPlane> local(points.xyz.size());
  std::vector<double> rough(points.xyz.size());
  std::vector<int> patch, seeds;
  for (int i = 0; i < points.size(); ++i) {
    patch_of(points, i, kPatch, patch);
    local[i] = fit_to(points, patch);
    if (!local[i].ok) continue;
    rough[i] = local[i].chi2 / static_cast<double>(patch.size());
    seeds.push_back(i);
  }
  std::stable_sort(seeds.begin(), seeds.end(), [&](int a, int b) { return rough[a] < rough[b]; });
  for (const int seed : seeds) {
    if (result.labels[seed] >= 0) continue;
    std::vector<int> region{seed};
    FittedPlane plane = local[seed];
    PlaneSums sums;
    sums.add(points.fit[seed], points.model);
    std::size_t next_fit = 2 * kPatch;
    const int label = static_cast<int>(result.planes.size());
    result.labels[seed] = label;
    for (std::size_t k = 0; k < region.size(); ++k)
      for (int n = points.begin[region[k]]; n < points.begin[region[k] + 1]; ++n) {
        const int j = points.neighbours[n];
        if (result.labels[j] >= 0 || !local[j].ok) continue;
        if (std::abs(local[j].plane.normal.dot(plane.plane.normal)) < rotation_cos ||
            residual_sigmas(plane, points.fit[j], points.model) > options.inlier_sigmas)
          continue;
        result.labels[j] = label;
        region.push_back(j);
        sums.add(points.fit[j], points.model);
        if (region.size() < next_fit) continue;
        const FittedPlane fit = sums.fit(points.model);
        if (fit.ok) plane = fit;
        next_fit = region.size() * 3 / 2;
      }
    if (static_cast<int>(region.size()) < options.min_points) {
      // Too small: its points are released, but the seed is not used again.
      for (const int i : region) result.labels[i] = -1;
      local[seed].ok = false;
      continue;
    }
    result.planes.push_back(plane);
  }
  refit(points, result);
  return result;
}

}  // namespace placegraph
