#include <placegraph/frontend/flow/anchored_patch.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

namespace placegraph {
namespace {

constexpr int kHalf = AnchoredPatch::kHalf;
/// Standard deviation of the weights [px]: the centre has more weight than the border, which is
/// more likely to show another surface.
constexpr float kWeightSigma = 5;
/// Standard deviations of grey values and of A between two views; their ratio is the weight of the
/// prior of A.
constexpr float kGreySigma = 4, kWarpSigma = 0.1f;
/// Factor of the standard deviation of a fit because the errors of neighbouring pixels, which share
/// the blur, are correlated.
constexpr float kSimilar = 2;

/// Bilinear samples. Precondition: all of the patch is inside the image.
template <typename Row>
void sample(const Image& image, const AnchoredPatch::Place& place, Row& grey) {
  const std::size_t step = image.step;
  int i = 0;
  for (int v = -kHalf; v <= kHalf; ++v) {
    float x = place.px.x() - kHalf * place.A(0, 0) + v * place.A(0, 1);
    float y = place.px.y() - kHalf * place.A(1, 0) + v * place.A(1, 1);
    for (int u = -kHalf; u <= kHalf; ++u, ++i, x += place.A(0, 0), y += place.A(1, 0)) {
      const int x0 = static_cast<int>(x), y0 = static_cast<int>(y);
      const float a = x - x0, b = y - y0;
      const unsigned char* p = image.data + y0 * step + x0;
      const float top = p[0] + a * (p[1] - p[0]);
      const float bottom = p[step] + a * (p[step + 1] - p[step]);
      grey[i] = top + b * (bottom - top);
    }
  }
}

bool is_inside(const Image& image, const AnchoredPatch::Place& place) {
  const Eigen::Vector2f reach = kHalf * place.A.cwiseAbs().rowwise().sum();
  return place.px.allFinite() && reach.allFinite() && place.px.x() - reach.x() >= 1 &&
         place.px.y() - reach.y() >= 1 && place.px.x() + reach.x() < image.cols - 2 &&
         place.px.y() + reach.y() < image.rows - 2;
}

/// The level on which a patch so magnified has about the resolution of the first image.
int level_of(const Eigen::Matrix2f& A, int levels) {
  const float magnification = std::sqrt(std::abs(A.determinant()));
  return std::clamp(static_cast<int>(std::lround(std::log2(std::max(magnification, 1.f)))), 0,
                    levels - 1);
}

}  // namespace

std::optional<AnchoredPatch> AnchoredPatch::take(const Image& image, const Eigen::Vector2f& px) {
  const Place place{px, Eigen::Matrix2f::Identity()};
  Place grown = place;
  grown.A *= (kHalf + 1.f) / kHalf;
  if (!is_inside(image, grown)) return std::nullopt;
  AnchoredPatch patch;
  sample(image, place, patch.grey_);
  Row right, left, below, above;
  sample(image, {px + Eigen::Vector2f(1, 0), place.A}, right);
  sample(image, {px - Eigen::Vector2f(1, 0), place.A}, left);
  sample(image, {px + Eigen::Vector2f(0, 1), place.A}, below);
  sample(image, {px - Eigen::Vector2f(0, 1), place.A}, above);

  Eigen::Matrix<float, kPixels, kUnknowns> M;
  Row weight;
  int i = 0;
  for (int v = -kHalf; v <= kHalf; ++v)
    for (int u = -kHalf; u <= kHalf; ++u, ++i) {
      const float gx = (right[i] - left[i]) / 2, gy = (below[i] - above[i]) / 2;
      M.row(i) << patch.grey_[i], 1, gx, gy, gx * u, gx * v, gy * u, gy * v;
      weight[i] = std::exp(-static_cast<float>(u * u + v * v) / (2 * kWeightSigma * kWeightSigma));
    }
  const Eigen::Matrix<float, kUnknowns, kPixels> MtW = M.transpose() * weight.asDiagonal();
  Eigen::Matrix<double, kUnknowns, kUnknowns> H = (MtW * M).cast<double>();
  const double firm = (kGreySigma / kWarpSigma) * (kGreySigma / kWarpSigma);
  for (int k = 4; k < kUnknowns; ++k) H(k, k) += firm;
  // If the grey values are only noise, the shift is uncertain by more than a pixel.
  const Eigen::LDLT<Eigen::Matrix<double, kUnknowns, kUnknowns>> solved(H);
  if (solved.info() != Eigen::Success || solved.vectorD().minCoeff() <= 0) return std::nullopt;
  const Eigen::Matrix<double, kUnknowns, kUnknowns> inverse =
      solved.solve(Eigen::Matrix<double, kUnknowns, kUnknowns>::Identity());
  if (!(inverse.block<2, 2>(2, 2).trace() * kGreySigma * kGreySigma < 0.5)) return std::nullopt;
  patch.covariance_ = inverse.block<2, 2>(2, 2).cast<float>();
  patch.fit_ = inverse.cast<float>() * MtW;
  patch.keep_ = (inverse.rightCols<4>() * firm).cast<float>();
  return patch;
}

std::optional<AnchoredPatch::Place> AnchoredPatch::find(const std::vector<Image>& pyramid,
                                                        const Place& start, float max_shift_px,
                                                        float min_correlation) const {
  // The pyramid has the derivatives of each level after it.
  const int stride = pyramid.size() > 1 && pyramid[1].channels() == 2 ? 2 : 1;
  const int level = level_of(start.A, static_cast<int>(pyramid.size()) / stride);
  const float unit = static_cast<float>(1 << level);
  const Image& image = pyramid[level * stride];
  Place place{start.px / unit, start.A / unit};
  const Eigen::Matrix2f A_start = place.A;
  const Eigen::Matrix2f A_start_inverse = A_start.inverse();
  Row grey;
  // Iterations at most. Chosen.
  constexpr int kMost = 15;
  for (int iteration = 0;; ++iteration) {
    if (!is_inside(image, place) || (place.px * unit - start.px).norm() > max_shift_px)
      return std::nullopt;
    sample(image, place, grey);
    const Eigen::Matrix2f strayed = A_start_inverse * place.A - Eigen::Matrix2f::Identity();
    Eigen::Matrix<float, kUnknowns, 1> x =
        fit_ * grey +
        keep_ * Eigen::Vector4f(strayed(0, 0), strayed(0, 1), strayed(1, 0), strayed(1, 1));
    if (!(x[0] > 0.2f && x[0] < 5)) return std::nullopt;
    x.tail<6>() /= x[0];
    // The patch is grey(A (I + D)^-1 (offset - shift)), the inverse of the warp of the image.
    Eigen::Matrix2f D;
    D << x[4], x[5], x[6], x[7];
    const Eigen::Matrix2f back = (Eigen::Matrix2f::Identity() + D).inverse();
    const Eigen::Vector2f shift = place.A * (back * x.segment<2>(2));
    place.A = place.A * back;
    place.px -= shift;
    if (!place.px.allFinite() || !place.A.allFinite()) return std::nullopt;
    if (shift.norm() * unit < 0.05f) break;
    if (iteration == kMost) return std::nullopt;
  }
  const Row a = grey_.array() - grey_.mean(), b = grey.array() - grey.mean();
  const float power = std::max(1e-6f, b.squaredNorm()), like = std::max(1e-6f, a.squaredNorm());
  const float correlation = a.dot(b) / std::sqrt(like * power);
  if (!(correlation >= min_correlation)) return std::nullopt;
  // Residual of the fit in grey values of the first patch.
  const float noise = std::sqrt(like * std::max(0.f, 1 - correlation * correlation) / kPixels);
  place.px *= unit;
  place.A *= unit;
  place.covariance =
      kSimilar * kSimilar * noise * noise * place.A * covariance_ * place.A.transpose();
  return place;
}

bool AnchoredPatch::is_comparable(const Eigen::Matrix2f& A) {
  const float det = A.determinant(), square = A.squaredNorm();
  // Singular values s1 >= s2 from s1 s2 and s1^2 + s2^2.
  if (!(det > 0)) return false;
  const float root = std::sqrt(std::max(0.f, square * square / 4 - det * det));
  const float s1 = std::sqrt(square / 2 + root), s2 = std::sqrt(std::max(0.f, square / 2 - root));
  return s1 < 2.5f && s2 > 0.4f && s1 < 2.5f * s2;
}

}  // namespace placegraph
