#pragma once
#include <placegraph/frontend/places/recognition_options.h>
#include <placegraph/graph/core/options.h>
#include <placegraph/pipeline/loops/loop_options.h>

namespace [[gnu::visibility("default")]] placegraph {

/// How MapLocalizer places images in a saved map.
struct LocalizerOptions {
  PlaceRecognizerOptions recognizer;  ///< its cues must be those that the map was described by
  /// Evidence of consecutive images. Images before and after count, so that it is gathered over
  /// longer than where only the past is known.
  SequenceFilterOptions sequence{.memory = 0.97};
  double min_probability = 0.95;  ///< least probability of an answer
  int calibration_views = 300;    ///< most keyframes of the map used to calibrate probabilities
  bool geometry = true;           ///< verify by features where the map has their depth
  LoopOptions loops;              ///< as the run that made the map; used if `geometry`
  void check() const;
};
void visit(OptionVisitor& field, LocalizerOptions& options);

/// How a map of places is learned from images alone, without motion.
struct MapLearnerOptions {
  PlaceCueOptions cues;  ///< descriptors that images are compared by
  /// A place ends where the similarity of an image to the place's first one falls below this share
  /// of its similarity to the image before. Both are taken beyond what any two images have in
  /// common.
  double similar = 0.5;
  void check() const;
};
void visit(OptionVisitor& field, MapLearnerOptions& options);

/// How places are labelled by a classifier of images.
struct PlaceLabelOptions {
  /// Mean probability over a place's keyframes below which the place stays without a label.
  double min_probability = 0.5;
  void check() const;
};
void visit(OptionVisitor& field, PlaceLabelOptions& options);

}  // namespace placegraph
