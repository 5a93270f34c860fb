#pragma once
#include <placegraph/frontend/places/recognition_options.h>
#include <placegraph/graph/core/options.h>
#include <placegraph/pipeline/loops/loop_options.h>

namespace [[gnu::visibility("default")]] placegraph {

/// Options for the localization of images in a saved map.
struct LocalizerOptions {
  /// Appearance comparison; its cues must be those with which the map was described.
  PlaceRecognizerOptions recognizer;
  /// Combination of the evidence of consecutive images. Images before and after count, so that
  /// evidence is accumulated over a longer span than in online use.
  SequenceFilterOptions sequence{.memory = 0.97};
  double min_probability = 0.95;  ///< minimum probability of a placed image
  /// Maximum number of keyframes of the map used to calibrate probabilities.
  int calibration_views = 300;
  bool geometry = true;  ///< verify by features where the map contains their depth
  LoopOptions loops;     ///< options of the run that made the map; used if `geometry`
  void check() const;
};
void visit(OptionVisitor& field, LocalizerOptions& options);

/// Options for learning a map of places from images alone, without motion.
struct MapLearnerOptions {
  PlaceCueOptions cues;  ///< descriptors with which images are compared
  /// A place ends where the similarity of an image to the first image of the place falls below this
  /// share of its similarity to the previous image. The similarity that any two images have in
  /// common is subtracted from both.
  double similar = 0.5;
  void check() const;
};
void visit(OptionVisitor& field, MapLearnerOptions& options);

/// Options for labelling places with an image classifier.
struct PlaceLabelOptions {
  /// Minimum mean probability over a place's keyframes for the place to be labelled.
  double min_probability = 0.5;
  void check() const;
};
void visit(OptionVisitor& field, PlaceLabelOptions& options);

}  // namespace placegraph
