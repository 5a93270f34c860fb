#pragma once
#include <placegraph/graph/core/options.h>

namespace [[gnu::visibility("default")]] placegraph {

/// Corners followed from frame to frame by pyramidal Lucas-Kanade.
///
/// At keyframes each track is corrected by its anchor, the image patch where it began, so that it
/// does not drift.
struct PointTrackerOptions {
  int max_tracks = 500;    ///< most points followed at once
  int window_px = 21;      ///< side of the Lucas-Kanade window, odd
  int pyramid_levels = 4;  ///< levels of the image pyramid, the full image included
  /// Largest distance of a point tracked there and back from its start; beyond, the track ends.
  double max_forward_backward_px = 0.8;
  /// Least eigenvalue of the window's gradient matrix per pixel, for grey levels / 255.
  double min_eigenvalue = 2e-4;
  int cell_px = 48;          ///< detection balances tracks over cells of this side
  int min_distance_px = 10;  ///< least distance of a new point from others
  /// Largest correction of a track at a keyframe to where its anchor is found; 0: no anchors.
  double max_anchor_shift_px = 3;
  /// Least correlation with the anchor; below it a new anchor is taken.
  double min_anchor_correlation = 0.8;
  double sigma_px = 0.7;       ///< noise added at a keyframe where the anchor was not found
  double min_sigma_px = 0.25;  ///< least standard deviation of a point whose anchor was found
  double max_sigma_px = 1.5;   ///< a track whose accumulated noise is larger ends
  void check() const;
};
void visit(OptionVisitor& field, PointTrackerOptions& options);

/// Detection of features with binary descriptors of 256 bits.
struct DetectorOptions {
  int max_features = 1000;    ///< most features per image
  int octaves = 4;            ///< levels of the image pyramid
  double scale_factor = 1.3;  ///< ratio of the sizes of two levels
  int fast_threshold = 12;    ///< of the FAST corner test [grey levels of 255]
  void check() const;
};
void visit(OptionVisitor& field, DetectorOptions& options);

/// Matching of binary descriptors.
struct MatcherOptions {
  int max_distance = 64;    ///< largest Hamming distance of a match [bits of 256]
  double max_ratio = 0.85;  ///< largest ratio of best to second best distance (Lowe 2004)
  void check() const;
};
void visit(OptionVisitor& field, MatcherOptions& options);

/// Search for points of the left image in the right image of a rectified stereo pair.
struct StereoMatcherOptions {
  int half_width_px = 7, half_height_px = 5;  ///< half the size of the compared patches
  double max_disparity_px = 128;              ///< largest disparity searched
  double min_score = 0.85;          ///< least zero-mean normalized cross-correlation of a match
  double max_left_right_px = 1;     ///< largest error of the search back into the left image
  double sigma_disparity_px = 0.3;  ///< standard deviation of a disparity
  void check() const;
};
void visit(OptionVisitor& field, StereoMatcherOptions& options);

/// Self-calibration of a stereo pair: the error of its rectification, from motion.
///
/// The error of a disparity is offset + by_x x + by_y y at the ray (x, y, 1). The motion gives
/// depths up to a scale, which is estimated beside it.
struct RectificationOptions {
  bool enabled = true;          ///< estimate the error and correct disparities by it
  double prior_sigma_px = 0.3;  ///< standard deviation of offset, by_x and by_y at first
  double batch_sigma_px = 0.1;  ///< of the error that all samples of a keyframe have in common
  double scale_sigma = 0.02;    ///< relative standard deviation of the motion's scale at first
  double scale_drift = 0.002;   ///< random walk of that scale from keyframe to keyframe
  void check() const;
};
void visit(OptionVisitor& field, RectificationOptions& options);

}  // namespace placegraph
