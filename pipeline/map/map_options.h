#pragma once
#include <placegraph/frontend/places/recognition_options.h>
#include <placegraph/graph/core/options.h>
#include <placegraph/pipeline/loops/loop_options.h>

namespace [[gnu::visibility("default")]] placegraph {

struct LocalizerOptions {
  PlaceRecognizerOptions recognizer;  ///< its cues are those of the map
  /// Images behind and ahead count, and none hurries: evidence is gathered over a longer way than
  /// where only the past is known.
  SequenceFilterOptions sequence{.memory = 0.97};
  double min_probability = 0.95;  ///< of an answer
  int calibration_views = 300;    ///< of the map, that tell how wrong answers look, at most
  bool geometry = true;           ///< verify by features where the map has their depth
  LoopOptions loops;              ///< as the run that made the map
  void check() const;
};
void visit(OptionVisitor& field, LocalizerOptions& options);

struct MapLearnerOptions {
  PlaceCueOptions cues;
  /// A place ends where a view has less than this share of what neighbouring views have in common
  /// (beyond any two views) with the place's first.
  double alike = 0.5;
  void check() const;
};
void visit(OptionVisitor& field, MapLearnerOptions& options);

struct PlaceLabelOptions {
  double min_probability = 0.5;  ///< mean over a place's views, below which it stays without label
  void check() const;
};
void visit(OptionVisitor& field, PlaceLabelOptions& options);

}  // namespace placegraph
