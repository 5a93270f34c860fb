#pragma once
#include <placegraph/graph/core/options.h>

namespace [[gnu::visibility("default")]] placegraph {

/// Count of the corners of two images that match and agree in one similarity transformation.
struct CornerAgreementOptions {
  int width_px = 320;      ///< width to which all images are resized, smaller ones too
  int max_corners = 300;   ///< maximum number of corners in an image
  int max_distance = 70;   ///< maximum Hamming distance of a match [bits of 256]
  double max_ratio = 0.8;  ///< maximum ratio of best to second best distance
  /// Maximum position error of an agreeing corner, as a share of the width.
  double tolerance = 0.06;
  void check() const;
};
void visit(OptionVisitor& field, CornerAgreementOptions& options);

/// Cues by which the appearance of images is compared, and their weights.
///
/// A weight of 0 leaves a cue out. With the defaults the similarities of all cues spread about
/// equally over different places; they were chosen over three sets of images
/// (docs/place_recognition.md).
struct PlaceCueOptions {
  double tiny = 1;        ///< weight of the shrunk image itself
  double colour = 1.5;    ///< weight of histograms of hue, saturation and value
  double gradients = 2;   ///< weight of histograms of gradient orientation
  double corners = 0.25;  ///< weight of log(agreeing corners / corner_floor)
  double gabor = 0.15;    ///< weight of statistics of a Gabor filter bank
  /// Number of corners that agree by chance; this many or fewer add nothing.
  int corner_floor = 12;
  int tiny_columns = 24;    ///< width of the shrunk image [px]
  double zoom = 1.25;       ///< factor by which a query is also enlarged and reduced
  double shift_loss = 0.1;  ///< loss of similarity for a shift by the whole image
  CornerAgreementOptions corner_agreement;  ///< count of agreeing corners
  void check() const;
};
void visit(OptionVisitor& field, PlaceCueOptions& options);

}  // namespace placegraph
