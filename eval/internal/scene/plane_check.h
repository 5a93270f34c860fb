#pragma once
#include <vector>

namespace placegraph {

struct PlaneCheckOptions {
  double overlap = 0.8;  ///< of a region, both ways
  int min_points = 0;    ///< regions of the truth with fewer count for nothing
};

/// What became of a region of the truth.
struct PlaneCheckMatch {
  int truth = 0;   ///< its label
  int found = 0;   ///< the label that it was found as; 0: not
  int points = 0;  ///< of the truth
  int common = 0;  ///< with the found one
};

/// A segmentation into planes against the truth, in the terms of Hoover et al. (1996, "An
/// experimental comparison of range image segmentation algorithms").
struct PlaneCheck {
  int truth = 0;            ///< regions of the truth that count
  int correct = 0;          ///< one found region and it hold `overlap` of each other
  int over_segmented = 0;   ///< several found ones are within it and hold `overlap` of it together
  int under_segmented = 0;  ///< found regions that hold several true ones
  int missed = 0;           ///< true regions that are none of these
  int noise = 0;            ///< found regions that are none of these
  int extra_pieces = 0;     ///< found regions within a true one beyond the first
  std::vector<PlaneCheckMatch> matches;  ///< a line for each region of the truth, by label

  double correct_share() const;
  double over_segmented_per_plane() const;
};

/// Labels of the same points; 0 (and what is negative) is no plane. Points without a true plane
/// count for the found region they are in. Throws ArgumentError if the sizes differ or the options
/// are out of range.
PlaneCheck check_planes(const std::vector<int>& truth, const std::vector<int>& found,
                        const PlaneCheckOptions& options);

}  // namespace placegraph
