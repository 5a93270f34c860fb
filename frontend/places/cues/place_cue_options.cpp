#include <placegraph/frontend/places/cues/place_cue_options.h>

namespace placegraph {

void CornerAgreementOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, CornerAgreementOptions& o) {
  field("width_px", o.width_px, "width to which images are resized for their corners", {64, 4096});
  field("max_corners", o.max_corners, "maximum number of corners in an image", {50, 5000});
  field("max_distance", o.max_distance, "maximum Hamming distance of a match [bits of 256]",
        {1, 256});
  field("max_ratio", o.max_ratio, "maximum ratio of best to second best distance", {0.1, 1});
  field("tolerance", o.tolerance,
        "maximum position error of an agreeing corner, as a share of the width", {0.001, 1});
}

void PlaceCueOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, PlaceCueOptions& o) {
  field("tiny", o.tiny, "weight of the shrunk image", {0, 100});
  field("colour", o.colour, "weight of the colour histograms", {0, 100});
  field("gradients", o.gradients, "weight of the gradient histograms", {0, 100});
  field("corners", o.corners, "weight of log(agreeing corners / corner_floor)", {0, 100});
  field("gabor", o.gabor, "weight of statistics of a Gabor filter bank", {0, 100});
  field("corner_floor", o.corner_floor, "number of corners that agree by chance", {1, 1000});
  field("tiny_columns", o.tiny_columns, "width of the shrunk image [px]", {8, 128});
  field("zoom", o.zoom, "factor by which a query is also enlarged and reduced", {1, 2});
  field("shift_loss", o.shift_loss, "loss of similarity for a shift by the whole image", {0, 1});
  field.group("corner_agreement", o.corner_agreement,
              "corners that agree in one similarity transformation");
}

}  // namespace placegraph
