#include <placegraph/pipeline/map/map_options.h>

namespace placegraph {

void LocalizerOptions::check() const {
  check_ranges(*this);
  loops.check();
}

void visit(OptionVisitor& field, LocalizerOptions& o) {
  field.group("recognizer", o.recognizer, "appearance comparison of two views");
  field.group("sequence", o.sequence, "combination of the evidence of neighbouring images");
  field("min_probability", o.min_probability, "minimum probability of a placed image", {0.5, 1});
  field("calibration_views", o.calibration_views,
        "maximum number of map keyframes used to calibrate probabilities", {10, 1e6});
  field("geometry", o.geometry, "verify by features where the map contains their depth");
}

void MapLearnerOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, MapLearnerOptions& o) {
  field.group("cues", o.cues, "descriptors that distinguish places, and their weights");
  field.formerly("alike")("similar", o.similar,
                          "share of the similarity of neighbours below which a place ends", {0, 1});
}

void PlaceLabelOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, PlaceLabelOptions& o) {
  field("min_probability", o.min_probability,
        "minimum mean probability over a place's views for a label", {0, 1});
}

}  // namespace placegraph
