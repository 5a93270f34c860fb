#pragma once
#include <placegraph/graph/core/options.h>

namespace [[gnu::visibility("default")]] placegraph {

/// Tracking of corners from frame to frame by pyramidal Lucas-Kanade.
///
/// At keyframes the drift of each track is corrected by its anchor, the image patch at its start.
struct PointTrackerOptions {
  int max_tracks = 500;    ///< maximum number of points tracked at once
  int window_px = 21;      ///< side of the Lucas-Kanade window, odd
  int pyramid_levels = 4;  ///< levels of the image pyramid, the full image included
  /// Maximum error of a point tracked forward and back [px]; beyond, the track ends.
  double max_forward_backward_px = 0.8;
  /// Minimum eigenvalue of the window's gradient matrix per pixel, for grey levels / 255.
  double min_eigenvalue = 2e-4;
  int cell_px = 48;          ///< side of the cells over which detection balances tracks
  int min_distance_px = 10;  ///< minimum distance of a new point from others
  /// Maximum correction of a track to its anchor at a keyframe [px]; 0: no anchors.
  double max_anchor_shift_px = 3;
  /// Minimum correlation with the anchor; below it a new anchor is taken.
  double min_anchor_correlation = 0.8;
  double sigma_px = 0.7;  ///< noise added at a keyframe where the anchor was not found
  void check() const;
};
void visit(OptionVisitor& field, PointTrackerOptions& options);

/// Detection of features with binary descriptors of 256 bits.
struct DetectorOptions {
  int max_features = 1000;    ///< maximum number of features per image
  int octaves = 4;            ///< number of levels of the image pyramid
  double scale_factor = 1.3;  ///< ratio of the sizes of two levels
  int fast_threshold = 12;    ///< threshold of the FAST corner test [grey levels of 255]
  void check() const;
};
void visit(OptionVisitor& field, DetectorOptions& options);

/// Matching of binary descriptors.
struct MatcherOptions {
  int max_distance = 64;    ///< maximum Hamming distance of a match [bits of 256]
  double max_ratio = 0.85;  ///< maximum ratio of best to second best distance (Lowe 2004)
  void check() const;
};
void visit(OptionVisitor& field, MatcherOptions& options);

/// Search for points of the left image in the right image of a rectified stereo pair.
struct StereoMatcherOptions {
  int half_width_px = 7, half_height_px = 5;  ///< half the size of the compared patches
  double max_disparity_px = 128;              ///< maximum disparity searched
  double min_score = 0.85;          ///< minimum zero-mean normalized cross-correlation of a match
  double max_left_right_px = 1;     ///< maximum error of the search back into the left image
  double sigma_disparity_px = 0.3;  ///< standard deviation of a disparity
  void check() const;
};
void visit(OptionVisitor& field, StereoMatcherOptions& options);

/// Self-calibration of a stereo pair: estimation of its rectification error from motion.
///
/// The error of a disparity is offset + by_x x + by_y y at the ray (x, y, 1). The motion
/// determines depths up to a scale, which is estimated together with the error.
struct RectificationOptions {
  bool enabled = true;          ///< estimate the error and correct disparities by it
  double prior_sigma_px = 0.3;  ///< initial standard deviation of offset, by_x and by_y
  /// Standard deviation of the error common to the samples of a keyframe.
  double batch_sigma_px = 0.1;
  double scale_sigma = 0.02;   ///< initial relative standard deviation of the motion's scale
  double scale_drift = 0.002;  ///< random walk of that scale from keyframe to keyframe
  void check() const;
};
void visit(OptionVisitor& field, RectificationOptions& options);

/// Options of the matching across wide baselines.
struct WideMatcherOptions {
  int max_features = 6000;      ///< maximum number of features of an image
  double min_contrast = 0.006;  ///< minimum contrast of a feature, as a share of the grey range
  double max_ratio = 0.85;      ///< maximum ratio of best to second best distance (Lowe 2004)
  double epipolar_px = 1.5;     ///< maximum epipolar distance of an inlier
  int min_inliers = 16;         ///< minimum inliers of the fundamental matrix
  void check() const { check_ranges(*this); }
};
void visit(OptionVisitor& field, WideMatcherOptions& options);

}  // namespace placegraph
