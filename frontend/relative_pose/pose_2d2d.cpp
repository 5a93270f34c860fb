#include <placegraph/frontend/planes/homography.h>
#include <placegraph/frontend/relative_pose/pose_2d2d.h>
#include <placegraph/graph/core/chi_squared.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/ransac.h>

#include <Eigen/Dense>
#include <opencv2/calib3d.hpp>
#include <opencv2/core/eigen.hpp>
#include <opengv/relative_pose/CentralRelativeAdapter.hpp>
#include <opengv/relative_pose/methods.hpp>

namespace placegraph {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

struct PixelViews {
  const Camera& camera;
  const std::vector<Vector2d>& px_ref;
  const std::vector<Vector2d>& px_cur;
  std::vector<Vector3d> x_ref, x_cur;  // rays with z = 1
};

/// Squared Sampson distance [px^2] for x_cur^T E x_ref = 0.
double sampson_px2(const Matrix3d& E, const PixelViews& views, int i) {
  const Vector3d a = E * views.x_ref[i];
  const Vector3d b = E.transpose() * views.x_cur[i];
  const double e = views.x_cur[i].dot(a);
  const double f = 0.5 * (views.camera.fx + views.camera.fy);
  return f * f * e * e / (a.head<2>().squaredNorm() + b.head<2>().squaredNorm());
}

double transfer_px2(const Matrix3d& H, const Matrix3d& H_inverse, const PixelViews& views, int i) {
  const Vector3d forward = H * views.px_ref[i].homogeneous();
  const Vector3d backward = H_inverse * views.px_cur[i].homogeneous();
  return std::max((forward.hnormalized() - views.px_cur[i]).squaredNorm(),
                  (backward.hnormalized() - views.px_ref[i]).squaredNorm());
}

RansacResult<Matrix3d> find_essential(const PixelViews& views, const Pose2d2dOptions& options,
                                      Random& random) {
  const int n = static_cast<int>(views.x_ref.size());
  opengv::bearingVectors_t bearings_ref(n), bearings_cur(n);
  for (int i = 0; i < n; ++i) {
    bearings_ref[i] = views.x_ref[i].normalized();
    bearings_cur[i] = views.x_cur[i].normalized();
  }
  // OpenGV's essential matrices satisfy f1^T E f2 = 0; with the current view as its first they are
  // E_cur_ref: x_cur^T E x_ref = 0.
  const opengv::relative_pose::CentralRelativeAdapter adapter(bearings_cur, bearings_ref);
  const auto solve = [&](const std::vector<int>& sample) {
    std::vector<Matrix3d> models;
    for (const Matrix3d& E : opengv::relative_pose::fivept_nister(adapter, sample))
      if (E.allFinite()) models.push_back(E);
    return models;
  };
  const auto error = [&](const Matrix3d& E, int i) { return sampson_px2(E, views, i); };
  const auto refine = [](const Matrix3d& E, const std::vector<int>&) { return E; };
  return ransac<Matrix3d>(n, 5, options.threshold_px * options.threshold_px, options.ransac, random,
                          solve, error, refine);
}

Matrix3d fit_homography(const PixelViews& views, const std::vector<int>& indices) {
  std::vector<cv::Point2d> from, to;
  for (int i : indices) {
    from.emplace_back(views.px_ref[i].x(), views.px_ref[i].y());
    to.emplace_back(views.px_cur[i].x(), views.px_cur[i].y());
  }
  const cv::Mat H = cv::findHomography(from, to, 0);  // least squares: H_cur_ref
  Matrix3d H_cur_ref = Matrix3d::Zero();
  if (!H.empty()) cv::cv2eigen(H, H_cur_ref);
  return H_cur_ref;
}

RansacResult<Matrix3d> find_homography(const PixelViews& views, const Pose2d2dOptions& options,
                                       Random& random) {
  const int n = static_cast<int>(views.px_ref.size());
  const auto solve = [&](const std::vector<int>& sample) {
    std::vector<Matrix3d> models;
    const Matrix3d H = fit_homography(views, sample);
    if (H.allFinite() && std::abs(H.determinant()) > 1e-9) models.push_back(H);
    return models;
  };
  Matrix3d last = Matrix3d::Zero(), last_inverse = Matrix3d::Zero();
  const auto error = [&](const Matrix3d& H, int i) {
    if (H != last) {
      last = H;
      last_inverse = H.inverse();
    }
    return transfer_px2(H, last_inverse, views, i);
  };
  const auto refine = [&](const Matrix3d& H, const std::vector<int>& inliers) {
    const Matrix3d refined = fit_homography(views, inliers);
    return std::abs(refined.determinant()) > 1e-9 ? refined : H;
  };
  return ransac<Matrix3d>(n, 4, 2 * options.threshold_px * options.threshold_px, options.ransac,
                          random, solve, error, refine);
}

/// The four motions of an essential matrix E = [t]x R of T_cur_ref, as T_ref_cur.
std::vector<SE3> decompose_essential(const Matrix3d& E) {
  const Eigen::JacobiSVD<Matrix3d> svd(E, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Matrix3d U = svd.matrixU(), V = svd.matrixV();
  if (U.determinant() < 0) U.col(2) *= -1;
  if (V.determinant() < 0) V.col(2) *= -1;
  Matrix3d W;
  W << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  std::vector<SE3> motions;
  for (const Matrix3d& R :
       {Matrix3d(U * W * V.transpose()), Matrix3d(U * W.transpose() * V.transpose())})
    for (double sign : {1.0, -1.0}) motions.push_back(SE3(R, sign * U.col(2)).inverse());
  return motions;
}

}  // namespace

Pose2d2dResult estimate_pose_2d2d(const Camera& camera, const std::vector<Vector2d>& px_ref,
                                  const std::vector<Vector2d>& px_cur,
                                  const Pose2d2dOptions& options, Random& random) {
  require(px_ref.size() == px_cur.size(),
          "estimate_pose_2d2d: as many pixels in both views needed");
  PixelViews views{camera, px_ref, px_cur, {}, {}};
  for (std::size_t i = 0; i < px_ref.size(); ++i) {
    views.x_ref.push_back(camera.unproject(px_ref[i]).value_or(Vector3d::UnitZ()));
    views.x_cur.push_back(camera.unproject(px_cur[i]).value_or(Vector3d::UnitZ()));
  }
  Pose2d2dResult result;
  const auto essential = find_essential(views, options, random);
  const auto homography = find_homography(views, options, random);
  if (!essential.outcome && !homography.outcome) {
    result.outcome = essential.outcome;
    return result;
  }
  // Score of an inlier: the bound of two degrees of freedom minus its squared error.
  static const double one = chi_squared_quantile(0.95, 1), two = chi_squared_quantile(0.95, 2);
  const double sigma2 = options.threshold_px * options.threshold_px / one;
  const double allowance = two * sigma2;
  double score_essential = 0, score_homography = 0;
  const Matrix3d H_inverse =
      homography.outcome ? Matrix3d(homography.model.inverse()) : Matrix3d::Zero();
  for (int i = 0; i < static_cast<int>(px_ref.size()); ++i) {
    if (essential.outcome) {
      const double e = sampson_px2(essential.model, views, i);
      if (e < one * sigma2) score_essential += allowance - e;
    }
    if (homography.outcome) {
      const double e = transfer_px2(homography.model, H_inverse, views, i);
      if (e < allowance) score_homography += allowance - e;
    }
  }
  result.homography_share = score_homography / (score_homography + score_essential);
  if (result.homography_share > options.homography_share) {
    result.model = TwoViewModel::kHomography;
    result.inliers = homography.inliers;
    std::vector<Vector2d> px;
    for (int i : homography.inliers) px.push_back(px_ref[i]);
    for (const auto& motion : decompose_homography(camera.K(), homography.model, px)) {
      const double length = motion.T_cur_ref.translation().norm();
      if (length < 1e-9) continue;
      result.T_ref_cur.push_back(
          SE3(motion.T_cur_ref.rotation(), motion.T_cur_ref.translation() / length).inverse());
    }
  } else {
    result.model = TwoViewModel::kEssential;
    result.inliers = essential.inliers;
    result.T_ref_cur = decompose_essential(essential.model);
  }
  result.outcome = result.T_ref_cur.empty() ? Outcome::failure(Outcome::Code::kDegenerate,
                                                               "the model has no translation")
                                            : Outcome::ok();
  return result;
}

}  // namespace placegraph
