#pragma once
#include <placegraph/frontend/internal/places/llc_codes.h>

namespace placegraph {

struct LandmarkOptions {
  double bandwidth = 0.08;  ///< of the width, about which key-points are of one landmark
  int min_features = 3;     ///< of a landmark
  double max_shift = 0.25;  ///< of the width, between two views of a landmark
  int max_landmarks = 40;   ///< of a view, those of most key-points
  void check() const;
};
void visit(OptionVisitor& field, LandmarkOptions& options);

/// Key-points grouped by mean shift (Comaniciu & Meer 2002): each climbs the density of all,
/// measured with a flat kernel, and those that arrive together are one region. The region of each
/// position, 0, 1, ... in the order of their first key-points; none for an empty list.
std::vector<int> group_positions(const std::vector<Eigen::Vector2f>& positions, double bandwidth);

/// A region of an image that may be found again: what its key-points show, and where it was.
struct ImageLandmark {
  Eigen::VectorXf code;  ///< largest share of each word in it, of unit length
  Eigen::Vector2f centre = Eigen::Vector2f::Zero();  ///< as a share of the width
  int features = 0;
};

/// The landmarks of an image, most key-points first. `codes`: of the features, in their order.
std::vector<ImageLandmark> find_landmarks(const FloatFeatures& features,
                                          const std::vector<LlcCode>& codes, int words,
                                          const LandmarkOptions& options);

/// How alike two views' landmarks are, in [0, 1]: the mean over those of the query, weighed by the
/// roots of their key-points, of the largest inner product with one of the other view at most
/// `max_shift` away.
double landmark_similarity(const std::vector<ImageLandmark>& query,
                           const std::vector<ImageLandmark>& stored, double max_shift);

}  // namespace placegraph
