#include <placegraph/frontend/scene/scene_masks.h>
#include <placegraph/graph/core/error.h>

#include <opencv2/imgproc.hpp>

namespace placegraph {
namespace {

constexpr auto kSkyMask = static_cast<std::size_t>(Surface::kSky);
constexpr auto kGroundMask = static_cast<std::size_t>(Surface::kGround);
constexpr auto kObjectMask = static_cast<std::size_t>(Surface::kObject);

void check_sizes(const std::vector<float>& surfaces, const SceneView& view) {
  require(surfaces.size() == static_cast<std::size_t>(view.superpixels.count) * kSurfaceCount &&
              !view.superpixels.index.empty(),
          "mask_scene: the sizes do not agree");
}

const float* of_pixel(const std::vector<float>& surfaces, const SceneView& view, int v, int u) {
  return surfaces.data() +
         static_cast<std::size_t>(view.superpixels.index.at<int>(v, u)) * kSurfaceCount;
}

/// 255 where a surface has at least this probability, at the size of the image.
Image where(std::size_t surface, double least, const std::vector<float>& surfaces,
            const SceneView& view) {
  Image found(view.superpixels.rows, view.superpixels.cols, CV_8UC1);
  for (int v = 0; v < found.rows; ++v)
    for (int u = 0; u < found.cols; ++u)
      found.at<std::uint8_t>(v, u) =
          static_cast<double>(of_pixel(surfaces, view, v, u)[surface]) >= least ? 255 : 0;
  const cv::Size size(view.cols, view.rows);
  if (found.size() != size) cv::resize(found, found, size, 0, 0, cv::INTER_NEAREST);
  return found;
}

}  // namespace

SceneMasks mask_scene(const std::vector<float>& surfaces, const SceneView& view,
                      const SceneMaskOptions& options) {
  options.check();
  check_sizes(surfaces, view);
  SceneMasks masks;
  if (options.ground) masks.ground = where(kGroundMask, options.min_ground, surfaces, view);
  masks.still = Image(view.rows, view.cols, CV_8UC1, cv::Scalar(255));
  if (options.moving) {
    Image moving = where(kObjectMask, options.min_moving, surfaces, view);
    if (options.margin_px > 0) {
      const int side = 2 * options.margin_px + 1;
      cv::dilate(moving, moving, cv::getStructuringElement(cv::MORPH_RECT, {side, side}));
    }
    masks.still = ~moving;
  }
  masks.use = masks.still.clone();
  if (options.sky) masks.use.setTo(0, where(kSkyMask, options.min_sky, surfaces, view));
  const double left = cv::countNonZero(masks.use);
  if (left < options.min_share * static_cast<double>(masks.use.total())) {
    masks.use = Image();
    masks.still = Image();
  }
  return masks;
}

SurfaceShares surface_shares(const std::vector<float>& surfaces, const SceneView& view) {
  check_sizes(surfaces, view);
  SurfaceShares shares;
  const Superpixels& s = view.superpixels;
  for (int v = 0; v < s.rows; ++v) {
    auto& half = 2 * v < s.rows ? shares.above : shares.below;
    for (int u = 0; u < s.cols; ++u)
      for (std::size_t c = 0; c < kSurfaceCount; ++c)
        half[c] += static_cast<double>(of_pixel(surfaces, view, v, u)[c]);
  }
  const int above = (s.rows + 1) / 2, below = s.rows - above;
  for (double& share : shares.above) share /= static_cast<double>(above) * s.cols;
  for (double& share : shares.below) share /= static_cast<double>(below) * s.cols;
  return shares;
}

}  // namespace placegraph
