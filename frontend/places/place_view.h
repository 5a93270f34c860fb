#pragma once
#include <placegraph/frontend/places/cues/corner_agreement.h>
#include <placegraph/frontend/places/cues/cue_grid.h>
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/image/image.h>
#include <placegraph/graph/place_view.h>

#include <vector>

namespace placegraph {

/// Which cues tell places apart, and how much each counts. A weight of 0 leaves a cue out. The
/// weights make the spread of each cue's similarity over different places about the same; they were
/// chosen together over three sets of images (docs/places.md).
struct PlaceCueOptions {
  double tiny = 1;          ///< the shrunk image itself
  double colour = 1.5;      ///< histograms of hue, saturation and value
  double gradients = 2;     ///< histograms of gradient orientation
  double corners = 0.25;    ///< per e-fold of corners in one similarity beyond corner_floor
  double gabor = 0.15;      ///< statistics of a Gabor filter bank
  int corner_floor = 12;    ///< as many agree by chance
  int tiny_columns = 24;    ///< cells of the shrunk image
  double zoom = 1.25;       ///< a query is also looked at larger and smaller by this
  double shift_loss = 0.1;  ///< of similarity where all of a view lies outside the other
  CornerAgreementOptions corner_agreement;
  void check() const;
};
void visit(OptionVisitor& field, PlaceCueOptions& options);

/// `image`: grey or BGR, 8 bits (ArgumentError otherwise). A `query` costs three scales instead of
/// one; cues of weight 0 stay empty.
PlaceView describe_place(const Image& image, const PlaceCueOptions& options, bool query);

/// What the grids of two views have in common: weighted cosines, 0 for a cue that is left out.
struct GridLikeness {
  double tiny = 0, colour = 0, gradients = 0, gabor = 0;
  double sum() const { return tiny + colour + gradients + gabor; }
};

/// Both views grey or both in colour (ArgumentError otherwise).
GridLikeness grid_likeness(const PlaceView& query, const PlaceView& stored,
                           const PlaceCueOptions& options);

/// What the corners add to it: weight * log(agreeing corners / corner_floor), never negative.
double corner_likeness(const PlaceView& query, const PlaceView& stored,
                       const PlaceCueOptions& options);

/// A second look at hundreds of views: tiny images at half the columns and colours where they
/// stand.
double coarse_likeness(const PlaceView& query, const PlaceView& stored,
                       const PlaceCueOptions& options);

}  // namespace placegraph
