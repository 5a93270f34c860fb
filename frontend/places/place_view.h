#pragma once
#include <placegraph/frontend/places/place_recognizer.h>

#include <vector>

namespace placegraph {

/// Similarities of the grids of two views: weighted cosines, 0 for a cue that is left out.
struct GridSimilarity {
  double tiny = 0, colour = 0, gradients = 0, gabor = 0;
  double sum() const { return tiny + colour + gradients + gabor; }
};

/// Compares the grids; both views must be grey or both in colour (ArgumentError otherwise).
GridSimilarity grid_similarity(const PlaceView& query, const PlaceView& stored,
                               const PlaceCueOptions& options);

/// Similarity of the corners: weight * log(agreeing corners / corner_floor), never negative.
double corner_similarity(const PlaceView& query, const PlaceView& stored,
                         const PlaceCueOptions& options);

/// Second coarse comparison of hundreds of views: tiny images at half the columns, colours without
/// shifts.
double coarse_similarity(const PlaceView& query, const PlaceView& stored,
                         const PlaceCueOptions& options);

}  // namespace placegraph
