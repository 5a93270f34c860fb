#pragma once
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// Which regions match.
struct PlaneCheckOptions {
  double overlap = 0.8;  ///< least share of each of two regions that is in the other
  int min_points = 0;    ///< regions of the truth with fewer points are ignored
};

/// The match of a region of the truth.
struct PlaneCheckMatch {
  int truth = 0;   ///< its label
  int found = 0;   ///< label of the found region; 0: not found
  int points = 0;  ///< points of the true region
  int common = 0;  ///< points in both regions
};

/// A segmentation into planes, compared with the truth.
/// Its terms are those of Hoover et al. (1996, "An experimental comparison of range image
/// segmentation algorithms").
struct PlaneCheck {
  int truth = 0;    ///< regions of the truth that count
  int correct = 0;  ///< regions that share `overlap` with one found region, in both directions
  int over_segmented = 0;                ///< regions of which several found ones cover `overlap`
  int under_segmented = 0;               ///< found regions that cover several true ones
  int missed = 0;                        ///< true regions that are none of these
  int noise = 0;                         ///< found regions that are none of these
  int extra_pieces = 0;                  ///< found regions within a true one beyond the first
  std::vector<PlaneCheckMatch> matches;  ///< one for each region of the truth, by label

  double correct_share() const;
  double over_segmented_per_plane() const;
};

/// Compares labels of the same points; 0 and negative labels mean no plane.
/// Points without a true plane count for the found region that they belong to. Throws ArgumentError
/// if the sizes differ or the options are out of range.
PlaneCheck check_planes(const std::vector<int>& truth, const std::vector<int>& found,
                        const PlaneCheckOptions& options);

}  // namespace placegraph
