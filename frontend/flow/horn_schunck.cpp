#include <placegraph/frontend/flow/horn_schunck.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace placegraph {
namespace {

std::vector<Image> halvings(const Image& grey, int levels) {
  std::vector<Image> pyramid(1);
  Image image;
  grey.convertTo(image, CV_32F);
  cv::GaussianBlur(image, pyramid[0], {0, 0}, 0.6);
  while (static_cast<int>(pyramid.size()) < levels &&
         std::min(pyramid.back().cols, pyramid.back().rows) >= 32) {
    Image half;
    cv::pyrDown(pyramid.back(), half);
    pyramid.push_back(half);
  }
  return pyramid;
}

/// Coefficients of the linearized brightness, I(x + flow) - I0 = du * u + dv * v + rest, in every
/// pixel; zero where the flow leaves the image.
struct Brightness {
  Image du, dv, rest;
};

Brightness linearize(const Image& from, const Image& to, const Image& u, const Image& v) {
  Image map_u(u.size(), CV_32F), map_v(u.size(), CV_32F), inside(u.size(), CV_32F);
  for (int y = 0; y < u.rows; ++y) {
    for (int x = 0; x < u.cols; ++x) {
      const float pu = static_cast<float>(x) + u.at<float>(y, x);
      const float pv = static_cast<float>(y) + v.at<float>(y, x);
      map_u.at<float>(y, x) = pu;
      map_v.at<float>(y, x) = pv;
      inside.at<float>(y, x) = pu >= 0 && pv >= 0 && pu <= static_cast<float>(u.cols - 1) &&
                                       pv <= static_cast<float>(u.rows - 1)
                                   ? 1.F
                                   : 0.F;
    }
  }
  Image moved;
  cv::remap(to, moved, map_u, map_v, cv::INTER_CUBIC, cv::BORDER_REPLICATE);
  // The mean of both images' gradients has the smaller error (second order in the remaining flow).
  const Image mean = 0.5 * (from + moved);
  static const Image kDerivative =
      (cv::Mat_<float>(1, 5) << 1 / 12., -8 / 12., 0, 8 / 12., -1 / 12.);
  const Image none = Image::ones(1, 1, CV_32F);
  Brightness out;
  cv::sepFilter2D(mean, out.du, CV_32F, kDerivative, none, {-1, -1}, 0, cv::BORDER_REPLICATE);
  cv::sepFilter2D(mean, out.dv, CV_32F, none, kDerivative, {-1, -1}, 0, cv::BORDER_REPLICATE);
  out.du = out.du.mul(inside);
  out.dv = out.dv.mul(inside);
  out.rest = (moved - from).mul(inside) - out.du.mul(u) - out.dv.mul(v);
  return out;
}

/// One sweep of over-relaxation in place: moves every pixel to the optimum given its four
/// neighbours, and a little beyond.
void relax(const Brightness& brightness, float alpha2, Image& u, Image& v) {
  // Successive over-relaxation; it converges below 2. Chosen.
  constexpr float kBeyond = 1.85F;
  const int width = u.cols, height = u.rows;
  for (int y = 0; y < height; ++y) {
    const float* iu = brightness.du.ptr<float>(y);
    const float* iv = brightness.dv.ptr<float>(y);
    const float* it = brightness.rest.ptr<float>(y);
    float* u0 = u.ptr<float>(y);
    float* v0 = v.ptr<float>(y);
    const float* u_up = u.ptr<float>(std::max(y - 1, 0));
    const float* v_up = v.ptr<float>(std::max(y - 1, 0));
    const float* u_down = u.ptr<float>(std::min(y + 1, height - 1));
    const float* v_down = v.ptr<float>(std::min(y + 1, height - 1));
    for (int x = 0; x < width; ++x) {
      const int left = std::max(x - 1, 0), right = std::min(x + 1, width - 1);
      const float mean_u = 0.25F * (u0[left] + u0[right] + u_up[x] + u_down[x]);
      const float mean_v = 0.25F * (v0[left] + v0[right] + v_up[x] + v_down[x]);
      const float excess =
          (iu[x] * mean_u + iv[x] * mean_v + it[x]) / (alpha2 + iu[x] * iu[x] + iv[x] * iv[x]);
      u0[x] += kBeyond * (mean_u - iu[x] * excess - u0[x]);
      v0[x] += kBeyond * (mean_v - iv[x] * excess - v0[x]);
    }
  }
}

void median(Image& field, int side) {
  if (side == 1) return;
  Image smooth;
  cv::medianBlur(field, smooth, side);
  field = smooth;
}

}  // namespace

Image horn_schunck(const Image& from, const Image& to, const HornSchunckOptions& options) {
  options.check();
  require(from.type() == CV_8UC1 && !from.empty() && to.type() == CV_8UC1,
          "horn_schunck: grey images are needed");
  require(from.size() == to.size(), "horn_schunck: the images differ in size");
  const std::vector<Image> a = halvings(from, options.levels), b = halvings(to, options.levels);
  Image u = Image::zeros(a.back().size(), CV_32F), v = u.clone();
  for (std::size_t level = a.size(); level-- > 0;) {
    if (u.size() != a[level].size()) {
      const double along = static_cast<double>(a[level].cols) / u.cols;
      const double down = static_cast<double>(a[level].rows) / u.rows;
      Image finer_u, finer_v;
      cv::resize(u, finer_u, a[level].size(), 0, 0, cv::INTER_LINEAR);
      cv::resize(v, finer_v, a[level].size(), 0, 0, cv::INTER_LINEAR);
      u = finer_u * along;
      v = finer_v * down;
    }
    for (int warp = 0; warp < options.warps; ++warp) {
      const Brightness brightness = linearize(a[level], b[level], u, v);
      const auto alpha2 = static_cast<float>(options.alpha * options.alpha);
      for (int i = 0; i < options.iterations; ++i) relax(brightness, alpha2, u, v);
      median(u, options.median_px);
      median(v, options.median_px);
    }
  }
  Image flow(from.size(), CV_32FC2);
  constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();
  for (int y = 0; y < flow.rows; ++y) {
    for (int x = 0; x < flow.cols; ++x) {
      const cv::Vec2f d(u.at<float>(y, x), v.at<float>(y, x));
      const float pu = static_cast<float>(x) + d[0], pv = static_cast<float>(y) + d[1];
      const bool inside = pu >= 0 && pv >= 0 && pu <= static_cast<float>(flow.cols - 1) &&
                          pv <= static_cast<float>(flow.rows - 1);
      flow.at<cv::Vec2f>(y, x) = inside ? d : cv::Vec2f(kUnknown, kUnknown);
    }
  }
  return flow;
}

}  // namespace placegraph
