#include <placegraph/frontend/align/direct_motion.h>
#include <placegraph/frontend/align/direct_motion_equations.h>
#include <placegraph/frontend/flow/grey_pyramid.h>
#include <placegraph/graph/core/error.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

namespace placegraph {
namespace {

/// Minimum number of samples in view on the finest level (25 for each of the six coordinates).
/// Chosen.
constexpr int kMinDirectSamples = 150;
/// Maximum number of iterations per level. Chosen.
constexpr int kDirectIterations = 12;
/// Mean displacement of the samples by a step that ends a level. Chosen.
constexpr double kDirectConverged_px = 0.01;
/// Minimum share of the samples that is in view. Chosen.
constexpr double kMinVisibleShare = 0.3;
/// Minimum correlation of observed and predicted grey values. Chosen; as for the ground plane.
constexpr double kMinDirectAgreement = 0.5;
/// Minimum share of inliers among the samples in view. Chosen.
constexpr double kMinDirectInlierShare = 0.4;
/// Side of the tiles within which residuals may be correlated. Chosen.
constexpr int kDirectTile_px = 32;

using Code = Outcome::Code;

/// Pixel of greatest gradient of each cell of q x q pixels, among those with a patch in `patch_of`.
std::vector<DirectReference::Sample> strongest(const Image& image, const Image& patch_of, int q,
                                               const Camera& camera, double scale, int tile_px) {
  std::vector<DirectReference::Sample> samples;
  const int tiles_across = camera.width / tile_px + 1;
  for (int v0 = 2; v0 < image.rows - 2; v0 += q)
    for (int u0 = 2; u0 < image.cols - 2; u0 += q) {
      double best = 0;
      int u_best = -1, v_best = -1;
      for (int v = v0; v < std::min(v0 + q, image.rows - 2); ++v) {
        const auto* patch = patch_of.ptr<std::uint8_t>(v);
        const auto *above = image.ptr<float>(v - 1), *row = image.ptr<float>(v),
                   *below = image.ptr<float>(v + 1);
        for (int u = u0; u < std::min(u0 + q, image.cols - 2); ++u) {
          if (!patch[u]) continue;
          const double du = row[u + 1] - row[u - 1], dv = below[u] - above[u];
          if (du * du + dv * dv <= best) continue;
          best = du * du + dv * dv;
          u_best = u, v_best = v;
        }
      }
      if (u_best < 0) continue;
      const int u = u_best, v = v_best;
      const Eigen::Vector2d px(u * scale, v * scale);
      samples.push_back(
          {{(px.x() - camera.cx) / camera.fx, (px.y() - camera.cy) / camera.fy, 1},
           {0.5 * (image.at<float>(v, u + 1) - image.at<float>(v, u - 1)),
            0.5 * (image.at<float>(v + 1, u) - image.at<float>(v - 1, u))},
           image.at<float>(v, u),
           patch_of.at<std::uint8_t>(v, u) - 1,
           static_cast<int>(px.y()) / tile_px * tiles_across + static_cast<int>(px.x()) / tile_px});
    }
  return samples;
}

/// Patch of each pixel of a level, counted from one; the first if there are several.
Image patches_on(const cv::Size& size, const std::vector<SurfacePatch>& patches, double scale) {
  Image patch_of(size, CV_8UC1, cv::Scalar(0));
  for (std::size_t k = patches.size(); k-- > 0;)
    for (const Eigen::Vector2f& p : patches[k].support_px) {
      const double reach = patches[k].reach_px / scale;
      const cv::Rect box(
          cv::Point(cvRound(p.x() / scale - reach), cvRound(p.y() / scale - reach)),
          cv::Point(cvRound(p.x() / scale + reach) + 1, cvRound(p.y() / scale + reach) + 1));
      patch_of(box & cv::Rect(cv::Point(), size)).setTo(static_cast<double>(k + 1));
    }
  return patch_of;
}

Outcome judge(const DirectMotion& motion, int visible) {
  if (visible < kMinDirectSamples || motion.visible_share < kMinVisibleShare)
    return Outcome::failure(Code::kTooFewData,
                            std::to_string(visible) + " pixels of surfaces in view");
  if (!(motion.agreement >= kMinDirectAgreement))
    return Outcome::failure(Code::kInconsistent, "correlation " + std::to_string(motion.agreement));
  if (!(motion.inlier_share >= kMinDirectInlierShare))
    return Outcome::failure(Code::kInconsistent,
                            "share of inliers " + std::to_string(motion.inlier_share));
  if (!(motion.last_step_px < 0.5))
    return Outcome::failure(Code::kNotConverged,
                            "last step " + std::to_string(motion.last_step_px) + " px");
  return Outcome::ok();
}

}  // namespace

DirectReference::DirectReference(const std::vector<Image>& pyramid, const Camera& camera,
                                 std::vector<SurfacePatch> patches,
                                 const DirectMotionOptions& options)
    : camera_(camera), patches_(std::move(patches)) {
  options.check();
  require(camera.distortion == Distortion::kNone && !pyramid.empty() && patches_.size() < 255,
          "direct reference: an undistorted camera, a pyramid and at most 254 planes needed");
  for (std::size_t i = 0; i < pyramid.size() && static_cast<int>(i) < options.levels; ++i) {
    const double scale = std::ldexp(1.0, static_cast<int>(i));
    const Image patch_of = patches_on(pyramid[i].size(), patches_, scale);
    const double pixels = cv::countNonZero(patch_of);
    const int q = std::max(1, static_cast<int>(std::ceil(std::sqrt(pixels / options.samples))));
    levels_.push_back(strongest(pyramid[i], patch_of, q, camera_, scale, kDirectTile_px));
  }
}

DirectMotion align_motion(const DirectReference& reference, const std::vector<Image>& pyramid_cur,
                          const SE3& T_ref_cur_start, const MotionGuess& guess) {
  require(!pyramid_cur.empty(), "align_motion: a pyramid without levels");
  DirectMotion motion;
  motion.T_ref_cur = T_ref_cur_start;
  motion.covariance.setZero();
  DirectEquations equations(reference, T_ref_cur_start, guess);
  const auto levels = std::min(reference.levels().size(), pyramid_cur.size());
  // Samples of a coarse level that is used: ten for each coordinate. Chosen.
  constexpr std::size_t kCoarseSamples = 60;
  for (std::size_t i = levels; i-- > 0;) {
    if (i > 0 && reference.levels()[i].size() < kCoarseSamples) continue;
    for (int k = 0; k < kDirectIterations; ++k) {
      equations.linearize(pyramid_cur[i], static_cast<int>(i));
      ++motion.iterations;
      if (!equations.step()) {
        motion.outcome =
            Outcome::failure(equations.visible() < 30 ? Code::kTooFewData : Code::kDegenerate,
                             "the samples do not determine a step");
        return motion;
      }
      motion.last_step_px = equations.step_px();
      if (equations.step_px() < kDirectConverged_px) break;
    }
  }
  equations.linearize(pyramid_cur[0], 0);
  equations.report(motion);
  motion.outcome = judge(motion, equations.visible());
  if (motion.outcome && !equations.covariance(motion))
    motion.outcome =
        Outcome::failure(Code::kDegenerate, "a direction of the motion is unobservable");
  return motion;
}

SE3 search_motion(const DirectReference& reference, const std::vector<Image>& pyramid_cur,
                  const SE3& T_ref_cur, const Eigen::Matrix<double, 6, 1>& sigmas,
                  const DirectMotionOptions& options) {
  const int level =
      static_cast<int>(std::min(reference.levels().size(), pyramid_cur.size())) - 1 > 1 ? 2 : 0;
  const auto& all = reference.levels().at(static_cast<std::size_t>(level));
  // Samples of the search: the cost. Chosen.
  constexpr std::size_t kSamples = 400;
  std::vector<DirectReference::Sample> samples;
  for (std::size_t i = 0; i < all.size(); i += all.size() / kSamples + 1) samples.push_back(all[i]);
  const Image& image = pyramid_cur[static_cast<std::size_t>(level)];
  const auto member = [&](const Eigen::VectorXd& z) {
    return T_ref_cur.plus(sigmas.cwiseProduct(z.head<6>()));
  };
  const PopulationCost cost = [&](const Eigen::VectorXd& z) {
    return -correlation_at(reference, samples, image, level, member(z).inverse());
  };
  return member(swarm_search(cost, 6, options.swarm).points.front());
}

}  // namespace placegraph
