#include <placegraph/frontend/flow/flow_vector.h>
#include <placegraph/graph/core/error.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

namespace placegraph {

Image flow_image(const std::vector<FlowVector>& vectors, int width, int height) {
  Image image(height, width, CV_32FC2, cv::Scalar::all(std::numeric_limits<double>::quiet_NaN()));
  for (const FlowVector& vector : vectors) {
    if (vector.kind != FlowVector::Kind::kFull) continue;
    const auto u = static_cast<int>(std::lround(vector.px.x()));
    const auto v = static_cast<int>(std::lround(vector.px.y()));
    if (u < 0 || v < 0 || u >= width || v >= height) continue;
    image.at<cv::Vec2f>(v, u) = {static_cast<float>(vector.flow.x()),
                                 static_cast<float>(vector.flow.y())};
  }
  return image;
}

std::vector<Eigen::Vector2d> flow_grid(int width, int height, int step_px) {
  require(step_px > 0, "flow_grid: the step must be positive");
  std::vector<Eigen::Vector2d> points;
  for (int v = step_px / 2; v < height; v += step_px)
    for (int u = step_px / 2; u < width; u += step_px) points.emplace_back(u, v);
  return points;
}

double image_noise(const Image& image) {
  // One row in eight: the cost. Chosen.
  constexpr int kStep = 8;
  constexpr double kLeast = 0.5, kMaskNorm = 6, kQuartile = 0.3186;  // quartile of |x|, x normal
  std::vector<int> responses;
  for (int v = 1; v + 1 < image.rows; v += kStep) {
    const auto *above = image.ptr<unsigned char>(v - 1), *here = image.ptr<unsigned char>(v),
               *below = image.ptr<unsigned char>(v + 1);
    for (int u = 1; u + 1 < image.cols; u += kStep)
      responses.push_back(std::abs(above[u - 1] - 2 * above[u] + above[u + 1] - 2 * here[u - 1] +
                                   4 * here[u] - 2 * here[u + 1] + below[u - 1] - 2 * below[u] +
                                   below[u + 1]));
  }
  if (responses.empty()) return kLeast;
  const auto quartile = responses.begin() + static_cast<std::ptrdiff_t>(responses.size() / 4);
  std::nth_element(responses.begin(), quartile, responses.end());
  return std::max(kLeast, *quartile / (kMaskNorm * kQuartile));
}

Eigen::Matrix2d track_covariance(const Image& image, const Eigen::Vector2d& px, int window_px,
                                 double noise_grey) {
  const int half = window_px / 2;
  const int u0 = std::clamp(static_cast<int>(std::lround(px.x())), 1, image.cols - 2);
  const int v0 = std::clamp(static_cast<int>(std::lround(px.y())), 1, image.rows - 2);
  double xx = 0, xy = 0, yy = 0;
  int pixels = 0;
  for (int v = std::max(1, v0 - half); v <= std::min(image.rows - 2, v0 + half); ++v) {
    const auto *above = image.ptr<unsigned char>(v - 1), *here = image.ptr<unsigned char>(v),
               *below = image.ptr<unsigned char>(v + 1);
    for (int u = std::max(1, u0 - half); u <= std::min(image.cols - 2, u0 + half); ++u, ++pixels) {
      const int x = above[u + 1] - above[u - 1] + 2 * (here[u + 1] - here[u - 1]) + below[u + 1] -
                    below[u - 1];
      const int y =
          below[u - 1] - above[u - 1] + 2 * (below[u] - above[u]) + below[u + 1] - above[u + 1];
      xx += x * x;
      xy += x * y;
      yy += y * y;
    }
  }
  // Sobel gradients are eight times the grey levels per pixel; their noise is sqrt(12) that of a
  // pixel.
  const double share = 12 * noise_grey * noise_grey * pixels;
  Eigen::Matrix2d G;
  G << xx - share, xy, xy, yy - share;
  G /= 64;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> eigen(G);
  const double variance = 2 * noise_grey * noise_grey;
  const double least = variance / (static_cast<double>(window_px) * window_px);
  const Eigen::Vector2d information = eigen.eigenvalues().cwiseMax(least);
  return variance * eigen.eigenvectors() * information.cwiseInverse().asDiagonal() *
         eigen.eigenvectors().transpose();
}

std::vector<FlowVector> sampled_flow(const Image& from, const Image& flow, int cell_px) {
  require(from.type() == CV_8UC1 && flow.type() == CV_32FC2 && from.size() == flow.size(),
          "sampled_flow: a grey image and its flow are needed");
  require(cell_px > 1, "sampled_flow: cells must have at least two pixels a side");
  const double noise_grey = image_noise(from), middle = 0.5 * (cell_px - 1);
  const int window_px = cell_px | 1;
  // Variance for gradients as strong as those of the noise, see track_covariance.
  const double most_px2 = 2 * 64 / (12.0 * window_px * window_px);
  std::vector<FlowVector> vectors;
  for (int top = 0; top < flow.rows; top += cell_px)
    for (int left = 0; left < flow.cols; left += cell_px) {
      FlowVector nearest;
      double least = std::numeric_limits<double>::infinity();
      for (int v = top; v < std::min(top + cell_px, flow.rows); ++v)
        for (int u = left; u < std::min(left + cell_px, flow.cols); ++u) {
          const auto& d = flow.at<cv::Vec2f>(v, u);
          const double away = std::hypot(u - left - middle, v - top - middle);
          if (away >= least || !std::isfinite(d[0]) || !std::isfinite(d[1])) continue;
          least = away;
          nearest = {FlowVector::Kind::kFull, {u, v}, {d[0], d[1]}, {}};
        }
      if (nearest.kind == FlowVector::Kind::kNone) continue;
      nearest.covariance = track_covariance(from, nearest.px, window_px, noise_grey);
      if (nearest.covariance.trace() < most_px2) vectors.push_back(nearest);
    }
  return vectors;
}

}  // namespace placegraph
