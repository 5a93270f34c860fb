#include <placegraph/frontend/flow/grey_pyramid.h>
#include <placegraph/graph/core/error.h>

#include <opencv2/imgproc.hpp>

namespace placegraph {
namespace {

/// Catmull-Rom weights of the four pixels around, for the fraction t.
void weights(double t, double w[4]) {
  const double t2 = t * t, t3 = t2 * t;
  w[0] = 0.5 * (-t3 + 2 * t2 - t);
  w[1] = 0.5 * (3 * t3 - 5 * t2 + 2);
  w[2] = 0.5 * (-3 * t3 + 4 * t2 + t);
  w[3] = 0.5 * (t3 - t2);
}

void slopes(double t, double w[4]) {
  const double t2 = t * t;
  w[0] = 0.5 * (-3 * t2 + 4 * t - 1);
  w[1] = 0.5 * (9 * t2 - 10 * t);
  w[2] = 0.5 * (-9 * t2 + 8 * t + 1);
  w[3] = 0.5 * (3 * t2 - 2 * t);
}

double dot(const float* row, const double w[4]) {
  return w[0] * row[0] + w[1] * row[1] + w[2] * row[2] + w[3] * row[3];
}

}  // namespace

std::vector<Image> grey_pyramid(const Image& grey, int levels) {
  require(grey.type() == CV_8UC1 && !grey.empty(), "grey_pyramid: a grey image is needed");
  std::vector<Image> pyramid(1);
  Image image;
  grey.convertTo(image, CV_32F);
  // Interpolation attenuates white noise between pixels more than at pixels, which would bias an
  // alignment towards positions between pixels; smoothed noise is attenuated equally everywhere.
  cv::GaussianBlur(image, pyramid[0], {5, 5}, 1);
  while (static_cast<int>(pyramid.size()) < levels) {
    if (image.cols < 16 || image.rows < 16) break;
    Image half;
    cv::pyrDown(image, half);
    pyramid.push_back(half);
    image = half;
  }
  return pyramid;
}

GreySample sample_bicubic(const Image& image, double u, double v) {
  const int u0 = static_cast<int>(u), v0 = static_cast<int>(v);
  double wu[4], wv[4], su[4], sv[4];
  weights(u - u0, wu), weights(v - v0, wv);
  slopes(u - u0, su), slopes(v - v0, sv);
  GreySample sample;
  for (int k = 0; k < 4; ++k) {
    const float* row = image.ptr<float>(v0 - 1 + k) + u0 - 1;
    const double value = dot(row, wu);
    sample.value += wv[k] * value;
    sample.du += wv[k] * dot(row, su);
    sample.dv += sv[k] * value;
  }
  return sample;
}

double value_bicubic(const Image& image, double u, double v) {
  const int u0 = static_cast<int>(u), v0 = static_cast<int>(v);
  double wu[4], wv[4], value = 0;
  weights(u - u0, wu), weights(v - v0, wv);
  for (int k = 0; k < 4; ++k) value += wv[k] * dot(image.ptr<float>(v0 - 1 + k) + u0 - 1, wu);
  return value;
}

}  // namespace placegraph
