#include <placegraph/frontend/cloud_planes/cloud_plane_baselines.h>
#include <placegraph/frontend/cloud_planes/cloud_planes.h>
#include <placegraph/frontend/cloud_planes/cloud_points.h>
#include <placegraph/frontend/cloud_planes/planar_segments.h>
#include <placegraph/frontend/cloud_planes/planarity.h>
#include <placegraph/frontend/cloud_planes/planarity_model.h>
#include <placegraph/frontend/cloud_planes/plane_labels.h>
#include <placegraph/frontend/cloud_planes/super_points.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/ransac.h>

#include <algorithm>
#include <map>
#include <numeric>

namespace placegraph {
namespace {

constexpr int kLeastPoints = 12;  ///< least number of points of a cloud

/// Plane of most of a segment's points, by RANSAC on some of them and least squares on all near
/// ones; nothing if those are too small a share of all.
FittedPlane robust_plane(const PlanarSegment& segment, const CloudPoints& points,
                         const SuperPoints& cloud, double sigmas, double least_share,
                         Random& random) {
  // Samples of RANSAC and rounds of the fit. Chosen.
  constexpr int kSamples = 300, kRounds = 2;
  std::vector<int> all;
  for (const int c : segment.cells)
    all.insert(all.end(), cloud.order.begin() + cloud.cells[c].begin,
               cloud.order.begin() + cloud.cells[c].end);
  std::vector<int> some;
  const std::size_t stride = all.size() / kSamples + 1;
  for (std::size_t k = 0; k < all.size(); k += stride) some.push_back(all[k]);
  const RansacOptions options{.max_iterations = 60, .confidence = 0.999, .min_inliers = 3};
  const auto point = [&](int k) -> const Eigen::Vector3d& { return points.xyz[some[k]]; };
  const auto found = ransac<FittedPlane>(
      static_cast<int>(some.size()), 3, sigmas * sigmas, options, random,
      [&](const std::vector<int>& s) {
        const FittedPlane plane = plane_through(point(s[0]), point(s[1]), point(s[2]));
        return plane.ok ? std::vector<FittedPlane>{plane} : std::vector<FittedPlane>{};
      },
      [&](const FittedPlane& plane, int k) {
        const double off = residual_sigmas(plane, points.fit[some[k]], points.model);
        return off * off;
      },
      [&](const FittedPlane& plane, const std::vector<int>& inliers) {
        PlaneSums sums;
        for (const int k : inliers) sums.add(points.fit[some[k]], points.model);
        const FittedPlane fit = sums.fit(points.model);
        return fit.ok ? fit : plane;
      });
  FittedPlane best = found.outcome ? found.model : segment.plane;
  for (int round = 0; round < kRounds; ++round) {
    PlaneSums sums;
    for (const int i : all)
      if (residual_sigmas(best, points.fit[i], points.model) < sigmas)
        sums.add(points.fit[i], points.model);
    const FittedPlane fit = sums.fit(points.model);
    if (!fit.ok || sums.count() < least_share * static_cast<double>(all.size())) return {};
    best = fit;
  }
  return best;
}

/// Splits segments with more than one plane: the super-points on the main plane, and the others,
/// again.
std::vector<PlanarSegment> split(std::vector<PlanarSegment> segments, const CloudPoints& points,
                                 const SuperPoints& cloud, const CloudPlanesOptions& options,
                                 Random& random) {
  // Deviations of points of a plane, and the share of them that keeps it. Chosen.
  constexpr double kNear = 2.5, kLeastShare = 0.1;
  const double least = std::max(8, options.min_points / 4);
  std::vector<PlanarSegment> result;
  while (!segments.empty()) {
    PlanarSegment segment = std::move(segments.back());
    segments.pop_back();
    if (segment.sums.count() < least || !segment.plane.ok) continue;
    if (segment.cells.size() > 1 && !is_one_plane(segment, cloud, points.model)) {
      const FittedPlane plane =
          robust_plane(segment, points, cloud, options.inlier_sigmas, kLeastShare, random);
      std::vector<int> on, off;
      for (const int c : segment.cells) {
        const PlaneSums& sums = cloud.cells[c].sums;
        const bool near =
            plane.ok && sums.misfit(plane, points.model) <
                            kNear * sums.count() * sums.inflation(plane, points.model);
        (near ? on : off).push_back(c);
      }
      if (on.empty()) continue;
      if (!off.empty()) {
        segments.push_back(make_segment(std::move(off), cloud, points.model));
        segment = make_segment(std::move(on), cloud, points.model);
        if (segment.sums.count() < least || !segment.plane.ok) continue;
      }
    }
    result.push_back(std::move(segment));
  }
  return result;
}

/// All steps up to the classification of segments.
std::vector<PlanarSegment> find_segments(const CloudPoints& points, const SuperPoints& cloud,
                                         const CloudPlanesOptions& options, Random& random) {
  std::vector<PlanarSegment> segments = cut_into_segments(cloud, points.model, options.max_cut);
  segments = split(std::move(segments), points, cloud, options, random);
  return merge_coplanar(std::move(segments), cloud, points.model);
}

PlaneLabels planes_by_cuts(const CloudPoints& points, const CloudPlanesOptions& options,
                           const PlanarityModel& planarity, std::vector<double>& probabilities) {
  // A majority. Chosen.
  constexpr double kLeastShare = 0.5;
  Random random(options.seed);
  const SuperPoints cloud = make_super_points(points);
  const auto contacts = contacts_of_cells(cloud);
  PlaneLabels result;
  result.labels.assign(points.xyz.size(), -1);
  for (const PlanarSegment& segment : find_segments(points, cloud, options, random)) {
    const double probability =
        planarity.probability(planarity_features(segment, points, cloud, contacts));
    if (probability < options.min_probability) continue;
    const FittedPlane plane =
        robust_plane(segment, points, cloud, options.inlier_sigmas, kLeastShare, random);
    if (!plane.ok) continue;
    for (const int c : segment.cells)
      for (int k = cloud.cells[c].begin; k < cloud.cells[c].end; ++k)
        result.labels[cloud.order[k]] = static_cast<int>(result.planes.size());
    result.planes.push_back(plane);
    probabilities.push_back(probability);
  }
  spread_labels(points, cloud, options.inlier_sigmas, result);
  // Share of the area that points cover. Chosen.
  constexpr double kPorous = 0.5;
  drop_porous(points, kPorous, result);
  std::vector<int> kept;
  drop_small(points, std::max(4, options.min_points / 4), options.min_points, result, &kept);
  std::vector<double> of_kept;
  for (const int k : kept) of_kept.push_back(probabilities[k]);
  probabilities = std::move(of_kept);
  return result;
}

/// Patches of surfaces are thin relative to the whole cloud; points throughout a volume are not.
bool fills_a_volume(const CloudPoints& points, const CloudPlanesOptions& options) {
  constexpr double kThickest = 0.05;  // share of half the extent
  if (points.model.noise != PointNoise::kIsotropic) return false;
  return points.noise.sigma(0) * options.flatness > kThickest * points.model.flatness;
}

void fill(const CloudPoints& points, const PlaneLabels& found,
          const std::vector<double>& probabilities, CloudPlanesResult& result) {
  std::vector<int> order(found.planes.size()), number(order.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return found.sums[a].count() > found.sums[b].count(); });
  for (std::size_t k = 0; k < order.size(); ++k) {
    const int i = order[k];
    number[i] = static_cast<int>(k) + 1;
    CloudPlane plane;
    plane.plane = found.planes[i].plane;
    plane.points = static_cast<int>(found.sums[i].count());
    plane.chi2_per_dof = found.planes[i].chi2 / std::max(1.0, plane.points - 3.0);
    plane.covariance = found.planes[i].covariance * std::max(1.0, plane.chi2_per_dof);
    if (!probabilities.empty()) plane.probability = probabilities[i];
    result.planes.push_back(plane);
  }
  for (int i = 0; i < points.size(); ++i)
    if (found.labels[i] >= 0) result.labels[points.source[i]] = number[found.labels[i]];
}

}  // namespace

CloudPlanesResult find_cloud_planes(const PointCloud& cloud, const CloudPlanesOptions& options,
                                    const PlanarityModel& planarity) {
  options.check();
  const CloudPoints points = prepare_cloud(cloud, options.flatness);
  CloudPlanesResult result;
  result.labels.assign(cloud.points.size(), 0);
  result.noise = points.noise;
  result.from_origin = points.model.noise == PointNoise::kAlongRay;
  if (points.size() < kLeastPoints) {
    result.outcome =
        Outcome::failure(Outcome::Code::kTooFewData, std::to_string(points.size()) + " points, " +
                                                         std::to_string(kLeastPoints) + " needed");
    return result;
  }
  result.outcome = Outcome::ok();
  if (fills_a_volume(points, options)) return result;
  std::vector<double> probabilities;
  const PlaneLabels found = options.method == CloudPlanesMethod::kRansac
                                ? planes_by_ransac(points, options)
                            : options.method == CloudPlanesMethod::kGrowing
                                ? planes_by_growing(points, options)
                                : planes_by_cuts(points, options, planarity, probabilities);
  fill(points, found, probabilities, result);
  return result;
}

std::vector<PlanaritySample> planarity_samples(const PointCloud& cloud,
                                               const std::vector<int>& labels,
                                               const CloudPlanesOptions& options) {
  // Shares of one label in a segment that is an example for either class. Chosen.
  constexpr double kPlane = 0.9, kNoPlane = 0.6;
  require(labels.size() == cloud.points.size(), "planarity_samples: one label a point is needed");
  std::vector<PlanaritySample> samples;
  const CloudPoints points = prepare_cloud(cloud, options.flatness);
  if (points.size() < kLeastPoints) return samples;
  const SuperPoints super_points = make_super_points(points);
  const auto contacts = contacts_of_cells(super_points);
  Random random(options.seed);
  for (const PlanarSegment& segment : find_segments(points, super_points, options, random)) {
    std::map<int, int> share;
    for (const int c : segment.cells)
      for (int i = super_points.cells[c].begin; i < super_points.cells[c].end; ++i)
        ++share[labels[points.source[super_points.order[i]]]];
    int most = 0;
    for (const auto& [label, count] : share)
      if (label > 0) most = std::max(most, count);
    const double purity = most / segment.sums.count();
    if (purity < kPlane && purity > kNoPlane) continue;
    samples.push_back(
        {planarity_features(segment, points, super_points, contacts), purity >= kPlane});
  }
  return samples;
}

}  // namespace placegraph
