#pragma once
#include <placegraph/frontend/internal/planes/homography_fit.h>
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/internal/core/random.h>

namespace placegraph {

struct PlanarRegionsOptions {
  double noise_px = 1;          ///< of a match, per coordinate and view: where the estimate starts
  double noise_confidence = 5;  ///< matches that `noise_px` weighs in the estimate of the noise
  double tail_freedom = 3;      ///< of the noise, Student t: the smaller, the heavier the tails
  double smoothness = 1;        ///< cost of two neighbours with different labels [nats]
  int neighbours = 6;           ///< of each match, near in both views
  int samples = 500;            ///< of four matches, per plane that is looked for
  int sample_neighbours = 20;   ///< a sample lies among so many nearest of its first match
  int min_matches = 8;          ///< a plane with fewer is none
  int max_planes = 20;
  void check() const;
};
void visit(OptionVisitor& field, PlanarRegionsOptions& options);

struct PlanarRegion {
  Eigen::Matrix3d H_cur_ref;               ///< of Frobenius norm one, det > 0
  Eigen::Matrix<double, 9, 9> covariance;  ///< of its entries, row by row; of rank eight
  int matches = 0;
  double cost = 0;  ///< of its matches by the noise [nats]
};

struct PlanarRegionsResult {
  Outcome outcome;
  std::vector<int> labels;            ///< of each match: 0 on no plane, k on regions[k - 1]
  std::vector<PlanarRegion> regions;  ///< most matches first
  TransferNoise noise;                ///< estimated: of a match on its plane
  double description_length = 0;      ///< of the answer [nats]; that of no plane is zero
};

/// The planes on which matches of two views lie, their number unknown: sequential search by local
/// samples with competition of all models for the matches (PEARL: Isack & Boykov 2012; proposals
/// one by one: Barath & Matas 2019), all in one cost, a description length in nats:
///  - a match on a plane: -log of the density of its transfer error (TransferNoise), and of the
///  share
///    of such matches; on none: the log of the area over which the current view's matches lie, and
///    of their share;
///  - a plane: what its four points and their precision cost;
///  - neighbouring matches with different labels: `smoothness` (so large planes have no privilege,
///    and scattered matches make no plane).
/// Models are refined by refine_homography, the noise re-estimated, planes dropped or merged as
/// long as the cost falls; the search begins at several noises, and the least cost wins. Outcomes:
/// too few data (under min_matches), no consensus (no plane is worth its cost).
[[nodiscard]] PlanarRegionsResult find_planar_regions(const PointMatches& matches,
                                                      const PlanarRegionsOptions& options,
                                                      Random& random);

}  // namespace placegraph
