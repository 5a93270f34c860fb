#pragma once
#include <placegraph/graph/core/options.h>
#include <placegraph/graph/core/outcome.h>
#include <placegraph/graph/image/image.h>

#include <Eigen/Core>
#include <vector>

namespace placegraph {

struct WideMatcherOptions {
  int max_features = 6000;      ///< of an image
  double min_contrast = 0.006;  ///< of a feature, of the whole range of grey
  double max_ratio = 0.85;      ///< best over second best distance (Lowe 2004)
  double epipolar_px = 1.5;     ///< inliers of the fundamental matrix lie this close
  int min_inliers = 16;
  void check() const { check_ranges(*this); }
};
void visit(OptionVisitor& field, WideMatcherOptions& options);

/// A point seen in two images, with what its surroundings say about the motion around it.
struct PointPair {
  Eigen::Vector2d px_a = Eigen::Vector2d::Zero(), px_b = Eigen::Vector2d::Zero();
  Eigen::Matrix2d rotation_b_a = Eigen::Matrix2d::Identity();  ///< similarity: scale times rotation
};

/// Points of one image as match_wide compares them, made ready for any number of comparisons.
struct WideBaselineFeatures {
  std::vector<Eigen::Vector2d> px;
  std::vector<double> angle_rad, size_px;
  Image descriptors;  ///< CV_32FC1, a row each
};

/// SIFT (Lowe 2004) with the square roots of normalized histograms, whose distance is Hellinger's
/// (Arandjelovic & Zisserman 2012). `mask`, if not empty, has zeros where no point is wanted.
WideBaselineFeatures detect_wide(const Image& image, const WideMatcherOptions& options,
                                 const Image& mask = {});

/// Mutually best matches that pass the ratio test, before any geometry.
std::vector<PointPair> match_points(const WideBaselineFeatures& a, const WideBaselineFeatures& b,
                                    double max_ratio);

struct WideMatches {
  Outcome outcome;               ///< kNoConsensus: `F_b_a` and `pairs` say nothing
  std::vector<PointPair> pairs;  ///< inliers of F_b_a
  Eigen::Matrix3d F_b_a = Eigen::Matrix3d::Zero();  ///< (px_b, 1)^T F_b_a (px_a, 1) = 0
  int candidates = 0;  ///< mutually best matches before the geometry was asked
};

/// Matches of points across a wide baseline between cameras that need not be known: SIFT (Lowe
/// 2004) compared by the Hellinger kernel (Arandjelovic & Zisserman 2012), mutually best, held
/// together by one fundamental matrix (MAGSAC++, Barath et al. 2020, by OpenCV; its samples are the
/// same in every run). Where all points lie on one plane the matrix is one of many that hold; the
/// pairs are right all the same. Images: CV_8UC1, else ArgumentError.
WideMatches match_wide(const Image& a, const Image& b, const WideMatcherOptions& options);

}  // namespace placegraph
