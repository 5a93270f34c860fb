#include <placegraph/frontend/floor_plan/plane_sweep.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/core/median.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

namespace placegraph {
namespace {

constexpr std::uint8_t kMostCost = 60;
constexpr double kBehind =
    0.01;  // what has less depth in a view, of that in the image, is not seen

struct Level {
  double inverse_depth = 0;
  double sum = 0;  ///< of the paths, of the pixel that has it
  bool distinct = false;
};

/// An image and its camera at half the size, as often as it takes.
void shrink(Image& image, Camera& camera, int max_width_px) {
  while (image.cols > max_width_px && image.rows > 1) {
    cv::resize(image, image, {image.cols / 2, image.rows / 2}, 0, 0, cv::INTER_AREA);
    const double across = 1.0 * image.cols / camera.width, down = 1.0 * image.rows / camera.height;
    camera.width = image.cols, camera.height = image.rows;
    camera.fx *= across, camera.fy *= down;
    camera.cx = (camera.cx + 0.5) * across - 0.5, camera.cy = (camera.cy + 0.5) * down - 0.5;
  }
}

/// Deviation of the noise of an image, from what differs from pixel to pixel both ways (Immerkaer
/// 1996, "Fast noise variance estimation"), by the median, as edges are outliers to it.
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

/// Brightness over the contrast about each pixel, 1 to 255; lighting that changes from view to view
/// leaves it alone.
Image normalized(const Image& image, double noise, const PlaneSweepOptions& options) {
  const cv::Size window(options.window_px, options.window_px);
  Image grey, mean, squares;
  image.convertTo(grey, CV_32F);
  cv::blur(grey, mean, window);
  cv::blur(grey.mul(grey), squares, window);
  Image contrast = squares - mean.mul(mean);
  contrast = cv::max(contrast, 0) + noise * noise;
  cv::sqrt(contrast, contrast);
  constexpr double kUnit = 40;
  Image result;
  Image((grey - mean) / contrast).convertTo(result, CV_8U, kUnit, 128);
  return cv::max(result, 1);
}

class PlaneSweep {
 public:
  PlaneSweep(const Image& image, const Camera& camera, const std::vector<SweptView>& views,
             const PlaneSweepOptions& options)
      : options_(options), camera_(camera) {
    Image small = image;
    shrink(small, camera_, options.max_width_px);
    const double noise = std::max(1.0, options.noise_share * noise_of(small));
    reference_ = normalized(small, noise, options);
    const Eigen::Matrix3d K = camera_.K(), K_inverse = K.inverse();
    for (const SweptView& view : views) {
      Image other = view.image;
      Camera same = camera;
      shrink(other, same, options.max_width_px);
      views_.push_back({normalized(other, noise, options),
                        K * view.T_view_cam.rotation().matrix() * K_inverse,
                        K * view.T_view_cam.translation()});
    }
    kept_ = (views_.size() + 1) / 2;
    choose_levels();
  }

  SweptDepth depth() const {
    SweptDepth result{camera_, Image(reference_.size(), CV_32FC1, cv::Scalar(0)),
                      Image(reference_.size(), CV_32FC1, cv::Scalar(0)),
                      Image(reference_.size(), CV_8UC1, cv::Scalar(0))};
    if (levels_ < 4) return result;
    const CostVolume volume = costs();
    const std::vector<Level> found = winners(volume, sum_over_paths(volume, options_.paths));
    agree(found, result);
    mark_certain(found, result);
    return result;
  }

 private:
  struct View {
    Image image;
    Eigen::Matrix3d turn;  ///< pixels of the image to those of the view, of what is far away
    Eigen::Vector3d move;  ///< change of them with inverse depth
    Eigen::Vector3d at(double u, double v, double inverse_depth) const {
      return turn * Eigen::Vector3d(u, v, 1) + inverse_depth * move;
    }
    /// Pixels that a change of inverse depth moves the point by.
    double rate(double u, double v, double inverse_depth) const {
      const Eigen::Vector3d p = at(u, v, inverse_depth);
      return (move.head<2>() - p.head<2>() * (move[2] / p[2])).norm() / std::abs(p[2]);
    }
  };

  double inverse_depth(double level) const { return 1 / options_.max_depth_m + level * step_; }

  void choose_levels() {
    const double low = 1 / options_.max_depth_m, high = 1 / options_.min_depth_m;
    const double middle = 0.5 * (low + high);
    double fastest = 0;
    for (const View& view : views_)
      for (const double across : {0.0, 0.5, 1.0})
        for (const double down : {0.0, 0.5, 1.0}) {
          const double u = across * (camera_.width - 1), v = down * (camera_.height - 1);
          if (view.at(u, v, middle)[2] >= kBehind)
            fastest = std::max(fastest, view.rate(u, v, middle));
        }
    levels_ = static_cast<int>(
        std::clamp(fastest * (high - low) / options_.step_px, 0.0, 1.0 * options_.max_planes));
    step_ = (high - low) / std::max(1, levels_ - 1);
  }

  /// Takes out what lies behind a view, by the homography of a plane.
  static void hide_behind(const Eigen::Matrix3d& H, Image& warped) {
    const auto depth = [&](int u, int v) { return H(2, 0) * u + H(2, 1) * v + H(2, 2); };
    const int u = warped.cols - 1, v = warped.rows - 1;
    if (std::min({depth(0, 0), depth(u, 0), depth(0, v), depth(u, v)}) >= kBehind) return;
    for (int y = 0; y <= v; ++y)
      for (int x = 0; x <= u; ++x)
        if (depth(x, y) < kBehind) warped.at<std::uint8_t>(y, x) = 0;
  }

  CostVolume costs() const {
    CostVolume volume(camera_.width, camera_.height, levels_);
    std::vector<Image> best(kept_);
    Image warped, cost, lower;
    for (int level = 0; level < levels_; ++level) {
      for (Image& b : best) b = Image(reference_.size(), CV_8UC1, cv::Scalar(kMostCost));
      for (const View& view : views_) {
        Eigen::Matrix3d H = view.turn;
        H.col(2) += inverse_depth(level) * view.move;
        const cv::Matx33d h(H(0, 0), H(0, 1), H(0, 2), H(1, 0), H(1, 1), H(1, 2), H(2, 0), H(2, 1),
                            H(2, 2));
        cv::warpPerspective(view.image, warped, h, reference_.size(),
                            cv::INTER_LINEAR | cv::WARP_INVERSE_MAP);
        hide_behind(H, warped);
        cv::absdiff(reference_, warped, cost);
        cv::min(cost, kMostCost, cost);
        cost.setTo(kMostCost, warped == 0);
        cv::blur(cost, cost, {options_.block_px, options_.block_px});
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
      for (int v = 0; v < camera_.height; ++v) {
        const std::uint8_t* row = cost.ptr<std::uint8_t>(v);
        std::uint8_t* to = volume.costs.data() + volume.at(0, v) + level;
        for (int u = 0; u < camera_.width; ++u, to += levels_) *to = row[u];
      }
    }
    return volume;
  }

  /// Of the costs of a pixel, at the levels where views show it.
  double mean_where_seen(const std::uint8_t* cost) const {
    double sum = 0;
    int seen = 0;
    for (int d = 0; d < levels_; ++d)
      if (cost[d] < kMostCost) sum += cost[d], ++seen;
    return seen ? sum / seen : 0;
  }

  /// The level of each pixel, if no other is about as good; inverse depth 0 where there is none.
  std::vector<Level> winners(const CostVolume& volume,
                             const std::vector<std::uint16_t>& sums) const {
    std::vector<Level> found(static_cast<std::size_t>(camera_.width) * camera_.height);
    Image fine(reference_.size(), CV_16SC1, cv::Scalar(0));  // in sixteenths of a level
    for (int v = 0; v < camera_.height; ++v)
      for (int u = 0; u < camera_.width; ++u) {
        const std::uint16_t* sum = sums.data() + volume.at(u, v);
        const int best = static_cast<int>(std::min_element(sum, sum + levels_) - sum);
        if (best == 0 || best == levels_ - 1) continue;
        int second = 1 << 16;
        for (int d = 0; d < levels_; ++d)
          if (std::abs(d - best) > 1) second = std::min<int>(second, sum[d]);
        if (second * (1 - options_.uniqueness) < sum[best]) continue;
        const double bend = sum[best - 1] + sum[best + 1] - 2.0 * sum[best];
        const double shift = bend > 0 ? 0.5 * (sum[best - 1] - sum[best + 1]) / bend : 0;
        const std::uint8_t* cost = volume.costs.data() + volume.at(u, v);
        found[static_cast<std::size_t>(v) * camera_.width + u] = {
            inverse_depth(best + shift), 1.0 * sum[best],
            cost[best] < options_.distinct * mean_where_seen(cost)};
        fine.at<std::int16_t>(v, u) = static_cast<std::int16_t>(std::lround(16 * (best + shift)));
      }
    constexpr int kSpeckle_px = 50, kSpeckleRange = 32;
    cv::filterSpeckles(fine, 0, kSpeckle_px, kSpeckleRange);
    for (std::size_t i = 0; i < found.size(); ++i)
      if (fine.ptr<std::int16_t>()[i] == 0) found[i] = {};
    return found;
  }

  /// Keeps what the better half of the views agrees to: the pixel of a point there goes to the
  /// point with the least costs of all that fall on it, and that is this one or has its depth.
  void agree(const std::vector<Level>& found, SweptDepth& result) const {
    std::vector<Image> told(views_.size());
    const auto pixel_of = [&](const View& view, int u, int v, double inverse_depth) {
      const Eigen::Vector3d p = view.at(u, v, inverse_depth);
      return p[2] < kBehind ? cv::Point(-1, -1)
                            : cv::Point(cvRound(p[0] / p[2]), cvRound(p[1] / p[2]));
    };
    const auto inside = [&](const cv::Point& p) {
      return p.x >= 0 && p.y >= 0 && p.x < camera_.width && p.y < camera_.height;
    };
    const auto each = [&](const auto& look) {
      for (int v = 0; v < camera_.height; ++v)
        for (int u = 0; u < camera_.width; ++u)
          if (const Level& level = found[static_cast<std::size_t>(v) * camera_.width + u];
              level.inverse_depth > 0)
            look(u, v, level);
    };
    for (std::size_t i = 0; i < views_.size(); ++i) {
      told[i] = Image(reference_.size(), CV_32FC2, cv::Scalar(0, 1e9));
      each([&](int u, int v, const Level& level) {
        const cv::Point at = pixel_of(views_[i], u, v, level.inverse_depth);
        if (!inside(at)) return;
        cv::Vec2f& best = told[i].at<cv::Vec2f>(at);
        if (level.sum < best[1])
          best = {static_cast<float>(level.inverse_depth), static_cast<float>(level.sum)};
      });
    }
    each([&](int u, int v, const Level& level) {
      double information = 0;
      std::size_t agreed = 0;
      for (std::size_t i = 0; i < views_.size(); ++i) {
        const cv::Point at = pixel_of(views_[i], u, v, level.inverse_depth);
        if (!inside(at)) continue;
        if (std::abs(told[i].at<cv::Vec2f>(at)[0] - level.inverse_depth) > 1.5 * step_) continue;
        information += std::pow(views_[i].rate(u, v, level.inverse_depth) / options_.sigma_px, 2);
        ++agreed;
      }
      // About the point that the camera moves to nothing tells a depth.
      constexpr double kMostDeviation = 0.2;  // of a depth, as a share of it
      const double sigma = 1 / std::sqrt(information);
      if (agreed < kept_ || !(sigma < kMostDeviation * level.inverse_depth)) return;
      result.depth_m.at<float>(v, u) = static_cast<float>(1 / level.inverse_depth);
      result.sigma_inverse.at<float>(v, u) = static_cast<float>(sigma);
    });
  }

  /// Pixels about which all tell their depth by themselves, and the same one.
  void mark_certain(const std::vector<Level>& found, SweptDepth& result) const {
    constexpr int kReach = 2;
    const auto at = [&](int u, int v) -> const Level& {
      return found[static_cast<std::size_t>(v) * camera_.width + u];
    };
    for (int v = kReach; v + kReach < camera_.height; ++v)
      for (int u = kReach; u + kReach < camera_.width; ++u) {
        const double depth = at(u, v).inverse_depth;
        bool certain = result.depth_m.at<float>(v, u) > 0;
        for (int y = v - kReach; certain && y <= v + kReach; ++y)
          for (int x = u - kReach; certain && x <= u + kReach; ++x)
            certain = at(x, y).distinct && result.depth_m.at<float>(y, x) > 0 &&
                      std::abs(at(x, y).inverse_depth - depth) < 3 * step_;
        if (certain) result.certain.at<std::uint8_t>(v, u) = 255;
      }
  }

  const PlaneSweepOptions& options_;
  Camera camera_;
  Image reference_;
  std::vector<View> views_;
  std::size_t kept_ = 1;
  int levels_ = 0;
  double step_ = 0;  ///< of inverse depth between levels
};

}  // namespace

void PlaneSweepOptions::check() const {
  check_ranges(*this);
  require(min_depth_m < max_depth_m, "max_depth_m: must be above min_depth_m");
  require(window_px % 2 == 1, "window_px: must be odd");
  require(block_px % 2 == 1, "block_px: must be odd");
}

void visit(OptionVisitor& field, PlaneSweepOptions& o) {
  field("min_depth_m", o.min_depth_m, "of surfaces", {0.01, 1000});
  field("max_depth_m", o.max_depth_m, "of surfaces", {0.02, 10000});
  field("max_width_px", o.max_width_px, "wider images are halved", {32, 10000});
  field("step_px", o.step_px, "between two planes, where a view moves most", {0.1, 10});
  field("max_planes", o.max_planes, "farther apart where more would be needed", {8, 1000});
  field("window_px", o.window_px, "over which brightness and contrast are made alike", {3, 51});
  field("noise_share", o.noise_share, "contrast below so much noise counts for little", {0, 100});
  field("block_px", o.block_px, "over which costs are averaged", {1, 31});
  field("path_step", o.paths.step, "cost of neighbours one plane apart", {0, 1000});
  field("path_jump", o.paths.jump, "cost of neighbours farther apart", {0, 1000});
  field("uniqueness", o.uniqueness, "by which a depth must be better than any other", {0, 1});
  field("distinct", o.distinct, "cost of a depth that the pixel tells by itself, of its mean cost",
        {0, 1});
  field("sigma_px", o.sigma_px, "of where a surface is seen in another view", {0.01, 10});
}

SweptDepth sweep_planes(const Image& image, const Camera& camera,
                        const std::vector<SweptView>& views, const PlaneSweepOptions& options) {
  options.check();
  camera.check();
  require(camera.distortion == Distortion::kNone,
          "plane sweep: a camera without distortion is needed");
  const auto fits = [&](const Image& i) {
    return i.type() == CV_8UC1 && i.cols == camera.width && i.rows == camera.height;
  };
  require(fits(image) && std::all_of(views.begin(), views.end(),
                                     [&](const SweptView& view) { return fits(view.image); }),
          "plane sweep: grey images of the camera's size are needed");
  return PlaneSweep(image, camera, views, options).depth();
}

}  // namespace placegraph
