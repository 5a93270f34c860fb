#include <placegraph/frontend/places/cues/place_cue_options.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>

namespace placegraph {

void CornerAgreementOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, CornerAgreementOptions& o) {
  field("width_px", o.width_px, "width to which images are resized for their corners", {64, 4096});
  field("max_corners", o.max_corners, "maximum number of corners in an image", {50, 5000});
  field.retired({{"max_distance", 70}, {"max_ratio", 0.8}, {"tolerance", 0.06}});
}

void PlaceCueOptions::check() const { check_ranges(*this); }

void visit(OptionVisitor& field, PlaceCueOptions& o) {
  field("tiny", o.tiny, "weight of the shrunk image", {0, 100});
  field("colour", o.colour, "weight of the colour histograms", {0, 100});
  field("gradients", o.gradients, "weight of the gradient histograms", {0, 100});
  field("corners", o.corners, "weight of log(agreeing corners / corner_floor)", {0, 100});
  field("gabor", o.gabor, "weight of statistics of a Gabor filter bank", {0, 100});
  field("zoom", o.zoom, "factor by which a query is also enlarged and reduced", {1, 2});
  field.group("corner_agreement", o.corner_agreement,
              "corners that agree in one similarity transformation");
  field.retired({{"corner_floor", 12}, {"tiny_columns", 24}, {"shift_loss", 0.1}});
}

const std::vector<std::string>& place_cue_names() {
  static const std::vector<std::string> names = {"tiny", "colour", "gradients", "gabor", "corners"};
  return names;
}

PlaceCueOptions only_cues(PlaceCueOptions options, const std::vector<std::string>& names) {
  double* const weights[] = {&options.tiny, &options.colour, &options.gradients, &options.gabor,
                             &options.corners};
  const std::vector<std::string>& known = place_cue_names();
  std::vector<bool> named(known.size(), false);
  for (const std::string& name : names) {
    const auto found = std::ranges::find(known, name);
    if (found == known.end()) {
      std::string all;
      for (const std::string& one : known) all += (all.empty() ? "" : ", ") + one;
      throw ArgumentError("'" + name + "' is none of " + all);
    }
    named[static_cast<std::size_t>(found - known.begin())] = true;
  }
  for (std::size_t i = 0; i < known.size(); ++i)
    if (!named[i]) *weights[i] = 0;
  return options;
}

}  // namespace placegraph
