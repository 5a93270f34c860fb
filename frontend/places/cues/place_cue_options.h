#pragma once
#include <placegraph/graph/core/options.h>

#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// Count of the corners of two images that match and agree in one similarity transformation.
struct CornerAgreementOptions {
  int width_px = 320;     ///< width to which all images are resized, smaller ones too
  int max_corners = 300;  ///< maximum number of corners in an image
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
  double zoom = 1.25;     ///< factor by which a query is also enlarged and reduced
  CornerAgreementOptions corner_agreement;  ///< count of agreeing corners
  void check() const;
};
void visit(OptionVisitor& field, PlaceCueOptions& options);

/// Names of the cues: the keys of their weights.
const std::vector<std::string>& place_cue_names();
/// The same options with weight 0 for every cue that is not named.
/// Throws ArgumentError for a name that is not one of place_cue_names().
PlaceCueOptions only_cues(PlaceCueOptions options, const std::vector<std::string>& names);

}  // namespace placegraph
