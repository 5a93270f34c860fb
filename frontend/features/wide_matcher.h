#pragma once
#include <placegraph/frontend/features/feature_options.h>
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/core/outcome.h>
#include <placegraph/graph/image/image.h>

#include <Eigen/Core>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// A point in two images, with the local motion estimated from its surroundings.
struct PointPair {
  Eigen::Vector2d px_a = Eigen::Vector2d::Zero(), px_b = Eigen::Vector2d::Zero();
  Eigen::Matrix2d rotation_b_a = Eigen::Matrix2d::Identity();  ///< similarity: scale times rotation
};

/// Point features of one image for match_points.
struct WideBaselineFeatures {
  std::vector<Eigen::Vector2d> px;
  std::vector<double> angle_rad, size_px;
  Image descriptors;  ///< CV_32FC1, one row per feature
};

/// Detects SIFT features (Lowe 2004) with square-root normalized histograms.
///
/// Their Euclidean distance is the Hellinger distance (Arandjelovic & Zisserman 2012). `mask`, if
/// not empty, has zeros where features are excluded.
WideBaselineFeatures detect_wide(const Image& image, const WideMatcherOptions& options,
                                 const Image& mask = {});

/// Mutually best matches that pass the ratio test, without a geometric check.
std::vector<PointPair> match_points(const WideBaselineFeatures& a, const WideBaselineFeatures& b,
                                    double max_ratio);

/// Matches across a wide baseline.
struct WideMatches {
  Outcome outcome;               ///< kNoConsensus: `F_b_a` and `pairs` are meaningless
  std::vector<PointPair> pairs;  ///< inliers of F_b_a
  Eigen::Matrix3d F_b_a = Eigen::Matrix3d::Zero();  ///< (px_b, 1)^T F_b_a (px_a, 1) = 0
  int candidates = 0;  ///< mutually best matches before the geometric check
};

/// Matches points across a wide baseline between cameras that may be uncalibrated.
///
/// SIFT (Lowe 2004) compared by the Hellinger kernel (Arandjelovic & Zisserman 2012), mutually
/// best, inliers of one fundamental matrix (MAGSAC++, Barath et al. 2020, by OpenCV; its samples
/// are the same in every run). If all points are on one plane the matrix is one of many possible
/// ones; the pairs are still correct. Images: CV_8UC1, else ArgumentError.
WideMatches match_wide(const Image& a, const Image& b, const WideMatcherOptions& options);

}  // namespace placegraph
