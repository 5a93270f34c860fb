#pragma once
#include <placegraph/frontend/places/place_recognizer.h>

#include <vector>

namespace placegraph {

/// What the grids of two views have in common: weighted cosines, 0 for a cue that is left out.
struct GridSimilarity {
  double tiny = 0, colour = 0, gradients = 0, gabor = 0;
  double sum() const { return tiny + colour + gradients + gabor; }
};

/// Both views grey or both in colour (ArgumentError otherwise).
GridSimilarity grid_similarity(const PlaceView& query, const PlaceView& stored,
                               const PlaceCueOptions& options);

/// What the corners add to it: weight * log(agreeing corners / corner_floor), never negative.
double corner_similarity(const PlaceView& query, const PlaceView& stored,
                         const PlaceCueOptions& options);

/// A second look at hundreds of views: tiny images at half the columns and colours where they
/// stand.
double coarse_similarity(const PlaceView& query, const PlaceView& stored,
                         const PlaceCueOptions& options);

}  // namespace placegraph
