#include <placegraph/pipeline/map/map_options.h>

namespace placegraph {

void LocalizerOptions::check() const {
  check_ranges(*this);
  loops.check();
}

void visit(OptionVisitor& field, LocalizerOptions& o) {
  field.group("recognizer", o.recognizer, "likeness of two views");
  field.group("sequence", o.sequence, "evidence of the images around");
  field("min_probability", o.min_probability, "of an answer", {0.5, 1});
  field("calibration_views", o.calibration_views,
        "views of the map that tell how wrong answers look, at most", {10, 1e6});
  field("geometry", o.geometry, "verify by features where the map has their depth");
}

void MapLearnerOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, MapLearnerOptions& o) {
  field.group("cues", o.cues, "what tells places apart, and how much each counts");
  field("similar", o.similar, "share of what neighbours have in common, below which a place ends",
        {0, 1});
}

void PlaceLabelOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, PlaceLabelOptions& o) {
  field("min_probability", o.min_probability,
        "mean over a place's views, below which it stays without label", {0, 1});
}

}  // namespace placegraph
