#pragma once
#include <placegraph/graph/core/options.h>

namespace [[gnu::visibility("default")]] placegraph {

struct PointTrackerOptions {
  int max_tracks = 500;
  int window_px = 21;
  int pyramid_levels = 4;
  double max_forward_backward_px = 0.8;
  double min_eigenvalue = 2e-4;  ///< of the window's gradient matrix per pixel, grey levels / 255
  int cell_px = 48;              ///< detection balances tracks over cells of this side
  int min_distance_px = 10;
  /// From where steps have led to where the first look is; 0: looks are not sought.
  double max_anchor_shift_px = 3;
  double min_anchor_correlation = 0.8;  ///< with the first look
  double sigma_px = 0.7;                ///< of a step where the first look was not found
  double min_sigma_px = 0.25;           ///< of a look that is found, at least
  double max_sigma_px = 1.5;            ///< a track that has gathered more ends
  void check() const;
};
void visit(OptionVisitor& field, PointTrackerOptions& options);

struct DetectorOptions {
  int max_features = 1000;
  int octaves = 4;
  double scale_factor = 1.3;
  int fast_threshold = 12;  ///< grey levels
  void check() const;
};
void visit(OptionVisitor& field, DetectorOptions& options);

struct MatcherOptions {
  int max_distance = 64;    ///< bits of 256
  double max_ratio = 0.85;  ///< best over second best distance (Lowe 2004)
  void check() const;
};
void visit(OptionVisitor& field, MatcherOptions& options);

struct StereoMatcherOptions {
  int half_width_px = 7, half_height_px = 5;  ///< of the compared patches
  double max_disparity_px = 128;
  double min_score = 0.85;       ///< ZNCC of the best place
  double max_left_right_px = 1;  ///< searching back from the right eye must end this close
  double sigma_disparity_px = 0.3;
  void check() const;
};
void visit(OptionVisitor& field, StereoMatcherOptions& options);

struct RectificationOptions {
  bool enabled = true;
  double prior_sigma_px = 0.3;  ///< of offset, by_x and by_y before anything was seen
  double batch_sigma_px = 0.1;  ///< common to all samples of a batch: the motion's own errors
  double scale_sigma = 0.02;    ///< of the motion's unit before anything was seen
  double scale_drift = 0.002;   ///< of the motion's unit, from one batch to the next
  void check() const;
};
void visit(OptionVisitor& field, RectificationOptions& options);

}  // namespace placegraph
