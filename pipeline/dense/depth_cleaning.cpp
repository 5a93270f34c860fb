#include <placegraph/pipeline/dense/depth_cleaning.h>

#include <cmath>
#include <opencv2/imgproc.hpp>

namespace placegraph {
namespace {

/// Sums over the windows around the pixels.
Image window_sums(const Image& values, int radius_px) {
  Image sums;
  const int side = 2 * radius_px + 1;
  cv::boxFilter(values, sums, CV_64F, {side, side}, {-1, -1}, false, cv::BORDER_CONSTANT);
  return sums;
}

/// Sums of the products of column, row and inverse depth over the windows.
struct WindowMoments {
  Image n, u, v, w, uu, uv, vv, uw, vw;
};

WindowMoments moments_of(const Image& depth, int radius_px) {
  const auto image = [&](auto value) {
    Image values(depth.size(), CV_64FC1, cv::Scalar(0));
    for (int v = 0; v < depth.rows; ++v)
      for (int u = 0; u < depth.cols; ++u)
        if (const float z = depth.at<float>(v, u); z > 0)
          values.at<double>(v, u) = value(double(u), double(v), 1.0 / z);
    return window_sums(values, radius_px);
  };
  return {image([](double, double, double) { return 1.0; }),
          image([](double u, double, double) { return u; }),
          image([](double, double v, double) { return v; }),
          image([](double, double, double w) { return w; }),
          image([](double u, double, double) { return u * u; }),
          image([](double u, double v, double) { return u * v; }),
          image([](double, double v, double) { return v * v; }),
          image([](double u, double, double w) { return u * w; }),
          image([](double, double v, double w) { return v * w; })};
}

/// The plane p . x = 1 around a pixel in the camera frame; zero where the window determines none.
Eigen::Vector3d plane_at(const WindowMoments& sums, const Camera& camera, int v, int u,
                         double least) {
  const double n = sums.n.at<double>(v, u);
  if (n < least) return Eigen::Vector3d::Zero();
  const auto mean = [&](const Image& image) { return image.at<double>(v, u) / n; };
  const double mu = mean(sums.u), mv = mean(sums.v), mw = mean(sums.w);
  const double uu = mean(sums.uu) - mu * mu, uv = mean(sums.uv) - mu * mv;
  const double vv = mean(sums.vv) - mv * mv;
  const double uw = mean(sums.uw) - mu * mw, vw = mean(sums.vw) - mv * mw;
  const double determinant = uu * vv - uv * uv;
  if (!(determinant > 0.1)) return Eigen::Vector3d::Zero();
  const double a = (vv * uw - uv * vw) / determinant, b = (uu * vw - uv * uw) / determinant;
  const double c = mw - a * mu - b * mv;
  return {a * camera.fx, b * camera.fy, a * camera.cx + b * camera.cy + c};
}

}  // namespace

void limit_uncertainty(KeyframeDepth& depth, double most_share) {
  for (int v = 0; v < depth.depth.rows; ++v)
    for (int u = 0; u < depth.depth.cols; ++u) {
      float& z = depth.depth.at<float>(v, u);
      if (!(depth.sigma_inverse.at<float>(v, u) * z <= most_share)) z = 0;
    }
}

void remove_edges(KeyframeDepth& depth, double bend) {
  // Bend beyond the noise of a depth edge: 0.3 % of normal errors. Chosen.
  constexpr double kSigmas = 3;
  const Image& z = depth.depth;
  Image edge(z.size(), CV_8UC1, cv::Scalar(0));
  const auto is_edge = [&](int v, int u, int down, int right) {
    const float before = z.at<float>(v - down, u - right), after = z.at<float>(v + down, u + right);
    if (!(before > 0) || !(after > 0)) return false;
    const double w = 1.0 / z.at<float>(v, u);
    return std::abs(1.0 / before + 1.0 / after - 2 * w) >
           kSigmas * depth.sigma_inverse.at<float>(v, u) + bend * w;
  };
  for (int v = 0; v < z.rows; ++v)
    for (int u = 0; u < z.cols; ++u) {
      if (!(z.at<float>(v, u) > 0)) continue;
      const bool across = u > 0 && u + 1 < z.cols && is_edge(v, u, 0, 1);
      const bool down = v > 0 && v + 1 < z.rows && is_edge(v, u, 1, 0);
      if (across || down) edge.at<std::uint8_t>(v, u) = 255;
    }
  cv::dilate(edge, edge, cv::getStructuringElement(cv::MORPH_CROSS, {3, 3}));
  depth.depth.setTo(0, edge);
}

void estimate_normals(KeyframeDepth& depth, int radius_px, double least_cosine) {
  const WindowMoments sums = moments_of(depth.depth, radius_px);
  const int side = 2 * radius_px + 1;
  const double least = 0.5 * side * side;
  const Camera& camera = depth.camera;
  depth.normal = Image(depth.depth.size(), CV_32FC3, cv::Scalar(0, 0, 0));
  for (int v = 0; v < depth.depth.rows; ++v)
    for (int u = 0; u < depth.depth.cols; ++u) {
      float& z = depth.depth.at<float>(v, u);
      if (!(z > 0)) continue;
      const Eigen::Vector3d plane = plane_at(sums, camera, v, u, least);
      const Eigen::Vector3d ray((u - camera.cx) / camera.fx, (v - camera.cy) / camera.fy, 1);
      const double size = plane.norm();
      if (size == 0 || !(plane.dot(ray) >= least_cosine * size * ray.norm())) {
        z = 0;
        continue;
      }
      const Eigen::Vector3f normal = (-plane / size).cast<float>();
      depth.normal.at<cv::Vec3f>(v, u) = {normal[0], normal[1], normal[2]};
    }
}

}  // namespace placegraph
