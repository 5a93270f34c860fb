#pragma once
#include <placegraph/frontend/planes/homography_fit.h>
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/core/random.h>

namespace [[gnu::visibility("default")]] placegraph {

/// Options of find_planar_regions.
struct PlanarRegionsOptions {
  double noise_px = 1;          ///< initial noise of a match, per coordinate and view
  double noise_confidence = 5;  ///< weight of `noise_px` in the noise estimate, in matches
  /// Degrees of freedom of the noise, Student t; smaller has heavier tails.
  double tail_freedom = 3;
  double smoothness = 1;  ///< cost of two neighbours with different labels [nats]
  int neighbours = 6;     ///< number of neighbours of each match, near in both views
  int samples = 500;      ///< number of samples of four matches per search of a plane
  /// A sample is drawn from this many nearest neighbours of its first match.
  int sample_neighbours = 20;
  int min_matches = 8;  ///< minimum number of matches of a plane
  int max_planes = 20;
  void check() const;
};
void visit(OptionVisitor& field, PlanarRegionsOptions& options);

/// Matches of two views on one plane.
struct PlanarRegion {
  Eigen::Matrix3d H_cur_ref;               ///< homography of Frobenius norm one, det > 0
  Eigen::Matrix<double, 9, 9> covariance;  ///< covariance of its entries, row by row; rank eight
  int matches = 0;
  double cost = 0;  ///< cost of its matches under the noise [nats]
};

/// The planes of the matches of two views.
struct PlanarRegionsResult {
  Outcome outcome;
  std::vector<int> labels;            ///< label of each match: 0 on no plane, k on regions[k - 1]
  std::vector<PlanarRegion> regions;  ///< most matches first
  TransferNoise noise;                ///< estimated noise of a match on its plane
  /// Description length of the result [nats]; without any plane it is zero.
  double description_length = 0;
};

/// Finds the planes on which matches of two views are; their number is unknown.
///
/// Sequential search by local samples, with competition of all models for the matches (PEARL: Isack
/// & Boykov 2012; proposals one by one: Barath & Matas 2019). The single cost is a description
/// length in nats:
/// - a match on a plane: -log of the density of its transfer error (TransferNoise), and of the
///   share of such matches; on none: the log of the area that the current view's matches cover, and
///   of their share;
/// - a plane: the cost of its four points with their precision;
/// - neighbouring matches with different labels: `smoothness` (so that large planes have no
///   advantage, and scattered matches do not form a plane).
///
/// Models are refined by refine_homography, the noise is estimated again, planes are dropped or
/// merged as long as the cost decreases; the search is repeated from several noise levels, and the
/// least cost is kept. Outcomes: too few data (under min_matches), no consensus (no plane reduces
/// the cost).
[[nodiscard]] PlanarRegionsResult find_planar_regions(const PointMatches& matches,
                                                      const PlanarRegionsOptions& options,
                                                      Random& random);

}  // namespace placegraph
