#include <placegraph/frontend/floor_plan/plane_sweep.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/median.h>

#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

namespace placegraph {
namespace {

/// Smoothness over neighbouring pixels (Hirschmueller 2008: two penalties). Chosen; the cost of
/// a pixel is at most kMostCost.
constexpr PathCosts kPathCosts = {.step = 8, .jump = 32};

/// Displacement between two planes in the image that moves most. About a pixel
/// (docs/floor_plan.md).
constexpr double kLevelStep_px = 1;
/// Maximum number of planes; their spacing grows if more would be needed. Chosen.
constexpr int kMaxSweptPlanes = 192;
/// Window over which brightness and contrast are normalized. Chosen; odd.
constexpr int kNormalizedWindow_px = 9;
/// Weakest contrast that is normalized to full strength, in standard deviations of the image noise,
/// but at least one grey level. Chosen.
constexpr double kNoiseShare = 2.7;
/// Window over which costs are averaged. Chosen; odd.
constexpr int kCostBlock_px = 5;
/// Relative lead that a depth must have over any other. Chosen.
constexpr double kUniqueness = 0.05;
/// Standard deviation of the position of a surface in another image. Chosen; planes a
/// pixel apart alone give 1 / sqrt(12) px.
constexpr double kSweptSigma_px = 0.3;

// Differences beyond are outliers; kUnit is one deviation. Chosen.
constexpr std::uint8_t kMostCost = 60;

/// Halves an image and its camera until the width is small enough.
void shrink(Image& image, Camera& camera, int max_width_px) {
  while (image.cols > max_width_px && image.rows > 1) {
    cv::resize(image, image, {image.cols / 2, image.rows / 2}, 0, 0, cv::INTER_AREA);
    const double across = 1.0 * image.cols / camera.width, down = 1.0 * image.rows / camera.height;
    camera.width = image.cols, camera.height = image.rows;
    camera.fx *= across, camera.fy *= down;
    camera.cx = (camera.cx + 0.5) * across - 0.5, camera.cy = (camera.cy + 0.5) * down - 0.5;
  }
}

/// Standard deviation of the noise of an image, from second differences in both directions
/// (Immerkaer 1996, "Fast noise variance estimation"), by the median, as edges are outliers.
double noise_of(const Image& image) {
  const cv::Matx33f mask(1, -2, 1, -2, 4, -2, 1, -2, 1);
  constexpr double kMaskNorm = 6;  // root of the sum of its squares
  Image response;
  cv::filter2D(image, response, CV_32F, mask);
  std::vector<double> sizes;
  for (int v = 1; v + 1 < image.rows; v += 2)
    for (int u = 1; u + 1 < image.cols; u += 2) sizes.push_back(std::abs(response.at<float>(v, u)));
  return sizes.empty() ? 0 : 1.4826 / kMaskNorm * median_of(sizes);
}

/// Brightness over the contrast around each pixel, 1 to 255; lighting that changes between views
/// has no effect.
Image normalized(const Image& image, double noise) {
  const cv::Size window(kNormalizedWindow_px, kNormalizedWindow_px);
  Image grey, mean, squares;
  image.convertTo(grey, CV_32F);
  cv::blur(grey, mean, window);
  cv::blur(grey.mul(grey), squares, window);
  Image contrast = squares - mean.mul(mean);
  contrast = cv::max(contrast, 0) + noise * noise;
  cv::sqrt(contrast, contrast);
  // Grey levels of one standard deviation: three fit 8 bits.
  constexpr double kUnit = 40;
  Image result;
  Image((grey - mean) / contrast).convertTo(result, CV_8U, kUnit, 128);
  return cv::max(result, 1);
}

/// Search: the cost of every level of depth for each pixel, and the selected level.
class PlaneSweep {
 public:
  PlaneSweep(const Image& image, const Camera& camera, const std::vector<SweptView>& views,
             const PlaneSweepOptions& options)
      : options_(options) {
    Image small = image;
    Camera small_camera = camera;
    shrink(small, small_camera, options.max_width_px);
    const double noise = std::max(1.0, kNoiseShare * noise_of(small));
    reference_ = normalized(small, noise);
    std::vector<SE3> T_view_cam;
    for (const SweptView& view : views) {
      T_view_cam.push_back(view.T_view_cam);
      Image other = view.image;
      Camera same = camera;
      shrink(other, same, options.max_width_px);
      views_.push_back(normalized(other, noise));
    }
    geometry_ =
        sweep_geometry(small_camera, T_view_cam,
                       {options.min_depth_m, options.max_depth_m, kLevelStep_px, kMaxSweptPlanes});
  }

  SweptDepth depth() const {
    std::vector<PixelDepth> found(reference_.total());
    if (geometry_.levels >= 4) {
      const CostVolume volume = costs();
      found = winners(volume, sum_over_paths(volume, kPathCosts));
    }
    return agreed_depth(found, geometry_, kSweptSigma_px);
  }

 private:
  /// Clears pixels behind a view, by the homography of a plane.
  static void hide_behind(const Eigen::Matrix3d& H, Image& warped) {
    constexpr double kBehind = SweepGeometry::kBehind;
    const auto depth = [&](int u, int v) { return H(2, 0) * u + H(2, 1) * v + H(2, 2); };
    const int u = warped.cols - 1, v = warped.rows - 1;
    if (std::min({depth(0, 0), depth(u, 0), depth(0, v), depth(u, v)}) >= kBehind) return;
    for (int y = 0; y <= v; ++y)
      for (int x = 0; x <= u; ++x)
        if (depth(x, y) < kBehind) warped.at<std::uint8_t>(y, x) = 0;
  }

  CostVolume costs() const {
    const int levels = geometry_.levels;
    CostVolume volume(reference_.cols, reference_.rows, levels);
    std::vector<Image> best(geometry_.better_half());
    Image warped, cost, lower;
    for (int level = 0; level < levels; ++level) {
      for (Image& b : best) b = Image(reference_.size(), CV_8UC1, cv::Scalar(kMostCost));
      for (std::size_t i = 0; i < views_.size(); ++i) {
        const Eigen::Matrix3d H = geometry_.views[i].homography(geometry_.inverse_depth(level));
        const cv::Matx33d h(H(0, 0), H(0, 1), H(0, 2), H(1, 0), H(1, 1), H(1, 2), H(2, 0), H(2, 1),
                            H(2, 2));
        cv::warpPerspective(views_[i], warped, h, reference_.size(),
                            cv::INTER_LINEAR | cv::WARP_INVERSE_MAP);
        hide_behind(H, warped);
        cv::absdiff(reference_, warped, cost);
        cv::min(cost, kMostCost, cost);
        cost.setTo(kMostCost, warped == 0);
        cv::blur(cost, cost, {kCostBlock_px, kCostBlock_px});
        for (Image& b : best) {
          cv::min(b, cost, lower);
          cv::max(b, cost, cost);
          lower.copyTo(b);
        }
      }
      cost.create(reference_.size(), CV_8UC1);
      Image sum(reference_.size(), CV_16UC1, cv::Scalar(0));
      for (const Image& b : best) cv::add(sum, b, sum, cv::noArray(), CV_16U);
      sum.convertTo(cost, CV_8U, 1.0 / static_cast<double>(best.size()));
      for (int v = 0; v < reference_.rows; ++v) {
        const std::uint8_t* row = cost.ptr<std::uint8_t>(v);
        std::uint8_t* to = volume.costs.data() + volume.at(0, v) + level;
        for (int u = 0; u < reference_.cols; ++u, to += levels) *to = row[u];
      }
    }
    return volume;
  }

  /// Mean of the costs of a pixel over the levels at which it is in a view.
  double mean_where_seen(const std::uint8_t* cost) const {
    double sum = 0;
    int seen = 0;
    for (int d = 0; d < geometry_.levels; ++d)
      if (cost[d] < kMostCost) sum += cost[d], ++seen;
    return seen ? sum / seen : 0;
  }

  /// Level of each pixel, if no other is about as good; inverse depth 0 where there is none.
  std::vector<PixelDepth> winners(const CostVolume& volume,
                                  const std::vector<std::uint16_t>& sums) const {
    std::vector<PixelDepth> found(static_cast<std::size_t>(reference_.cols) * reference_.rows);
    Image fine(reference_.size(), CV_16SC1, cv::Scalar(0));  // in sixteenths of a level
    for (int v = 0; v < reference_.rows; ++v)
      for (int u = 0; u < reference_.cols; ++u) {
        const std::uint16_t* sum = sums.data() + volume.at(u, v);
        const int best = static_cast<int>(std::min_element(sum, sum + geometry_.levels) - sum);
        if (best == 0 || best == geometry_.levels - 1) continue;
        int second = 1 << 16;
        for (int d = 0; d < geometry_.levels; ++d)
          if (std::abs(d - best) > 1) second = std::min<int>(second, sum[d]);
        if (second * (1 - kUniqueness) < sum[best]) continue;
        const double bend = sum[best - 1] + sum[best + 1] - 2.0 * sum[best];
        const double shift = bend > 0 ? 0.5 * (sum[best - 1] - sum[best + 1]) / bend : 0;
        const std::uint8_t* cost = volume.costs.data() + volume.at(u, v);
        found[static_cast<std::size_t>(v) * reference_.cols + u] = {
            geometry_.inverse_depth(best + shift), 1.0 * sum[best],
            cost[best] < options_.distinct * mean_where_seen(cost)};
        fine.at<std::int16_t>(v, u) = static_cast<std::int16_t>(std::lround(16 * (best + shift)));
      }
    // Smaller parts are removed; their depths differ by two levels, in sixteenths. Chosen.
    constexpr int kSpeckle_px = 50, kSpeckleRange = 32;
    cv::filterSpeckles(fine, 0, kSpeckle_px, kSpeckleRange);
    for (std::size_t i = 0; i < found.size(); ++i)
      if (fine.ptr<std::int16_t>()[i] == 0) found[i] = {};
    return found;
  }

  const PlaneSweepOptions& options_;
  SweepGeometry geometry_;
  Image reference_;
  std::vector<Image> views_;  ///< as many as the geometry has
};

}  // namespace

SweptDepth sweep_planes(const Image& image, const Camera& camera,
                        const std::vector<SweptView>& views, const PlaneSweepOptions& options) {
  options.check();
  camera.check();
  require(camera.distortion == Distortion::kNone, "plane sweep: needs a camera without distortion");
  const auto fits = [&](const Image& i) {
    return i.type() == CV_8UC1 && i.cols == camera.width && i.rows == camera.height;
  };
  require(fits(image) && std::all_of(views.begin(), views.end(),
                                     [&](const SweptView& view) { return fits(view.image); }),
          "plane sweep: needs grey images of the camera's size");
  return PlaneSweep(image, camera, views, options).depth();
}

}  // namespace placegraph
