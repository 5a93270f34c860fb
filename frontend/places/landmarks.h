#pragma once
#include <placegraph/frontend/places/llc_codes.h>

namespace placegraph {

struct LandmarkOptions;

/// Groups key-points by mean shift (Comaniciu & Meer 2002) with a flat kernel.
///
/// Each key-point climbs the density of all; those with the same mode are one region. Returns the
/// region of each position, 0, 1, ... in the order of their first key-points; empty for an empty
/// list.
std::vector<int> group_positions(const std::vector<Eigen::Vector2f>& positions, double bandwidth);

/// Region of an image that may be found again: the code of its key-points and its position.
struct ImageLandmark {
  Eigen::VectorXf code;  ///< largest share of each word in the region, of unit length
  Eigen::Vector2f centre = Eigen::Vector2f::Zero();  ///< centre, as a share of the width
  int features = 0;
};

/// Finds the landmarks of an image, most key-points first. `codes`: codes of the features, in their
/// order.
std::vector<ImageLandmark> find_landmarks(const FloatFeatures& features,
                                          const std::vector<LlcCode>& codes, int words,
                                          const LandmarkOptions& options);

/// Similarity of two views' landmarks, in [0, 1].
///
/// The mean over the landmarks of the query, weighted by the roots of their numbers of key-points,
/// of the largest inner product with a landmark of the other view at most `max_shift` away.
double landmark_similarity(const std::vector<ImageLandmark>& query,
                           const std::vector<ImageLandmark>& stored, double max_shift);

}  // namespace placegraph
