#include <placegraph/frontend/flow/corners.h>
#include <placegraph/graph/core/error.h>

#include <Eigen/Core>
#include <array>
#include <cstdint>

namespace placegraph {
namespace {

constexpr int kRadius = 2;  // radius of the window
constexpr int kSide = 2 * kRadius + 1;
/// Scale of a Sobel gradient: a smooth slope of one grey level per pixel has the value 8. With the
/// factor 1/2 of the trace this is the scale of OpenCV's cornerMinEigenVal.
constexpr float kScale = 1.0f / (4 * kSide * 255);

/// Products of gradients of one image row; the first and the last entry are undefined.
struct GradientRow {
  std::vector<std::int32_t> xx, xy, yy;
  explicit GradientRow(std::size_t n = 0) : xx(n, 0), xy(n, 0), yy(n, 0) {}
};

void gradient_products(const Image& image, int v, std::vector<std::int16_t>& gx,
                       std::vector<std::int16_t>& gy, GradientRow& row) {
  const std::uint8_t *above = image.ptr(v - 1), *here = image.ptr(v), *below = image.ptr(v + 1);
  const int n = image.cols;
  std::int16_t *x = gx.data(), *y = gy.data();
  for (int u = 1; u < n - 1; ++u) {
    x[u] = static_cast<std::int16_t>(above[u + 1] - above[u - 1] + 2 * (here[u + 1] - here[u - 1]) +
                                     below[u + 1] - below[u - 1]);
    y[u] = static_cast<std::int16_t>(below[u - 1] - above[u - 1] + 2 * (below[u] - above[u]) +
                                     below[u + 1] - above[u + 1]);
  }
  std::int32_t *xx = row.xx.data(), *xy = row.xy.data(), *yy = row.yy.data();
  for (int u = 1; u < n - 1; ++u) xx[u] = x[u] * x[u];
  for (int u = 1; u < n - 1; ++u) xy[u] = x[u] * y[u];
  for (int u = 1; u < n - 1; ++u) yy[u] = y[u] * y[u];
}

/// Sums over rows, updated by adding the row that enters and subtracting the one that leaves:
/// exact, as they are integers (25 products of at most 1020^2).
void move_sum(std::vector<std::int32_t>& sum, const std::vector<std::int32_t>& enters,
              const std::vector<std::int32_t>& leaves) {
  std::int32_t* s = sum.data();
  const std::int32_t *in = enters.data(), *out = leaves.data();
  for (std::size_t u = 0; u < sum.size(); ++u) s[u] += in[u] - out[u];
}

using Strengths = Eigen::ArrayXf;

/// Sum over the columns of the window [grey levels / 255].
void across(const std::vector<std::int32_t>& column_sums, Strengths& out) {
  const std::int32_t* c = column_sums.data();
  const int n = static_cast<int>(column_sums.size());
  float* o = out.data();
  for (int u = kRadius; u < n - kRadius; ++u)
    o[u] = kScale * kScale * static_cast<float>(c[u - 2] + c[u - 1] + c[u] + c[u + 1] + c[u + 2]);
}

/// Strengths of the image's rows, one after the other.
class StrengthRows {
 public:
  StrengthRows(const Image& image, int first_row)
      : image_(image),
        next_(first_row - kRadius),
        gx_(columns()),
        gy_(columns()),
        fresh_(columns()),
        sum_(columns()),
        xx_(image.cols),
        xy_(image.cols),
        yy_(image.cols) {
    rows_.fill(GradientRow(columns()));
    for (int i = 0; i < 2 * kRadius; ++i) enter();
  }
  /// Computes the strengths of the next row.
  void read(Strengths& strengths) {
    enter();
    across(sum_.xx, xx_);
    across(sum_.xy, xy_);
    across(sum_.yy, yy_);
    strengths = 0.5f * (xx_ + yy_) - ((0.5f * (xx_ - yy_)).square() + xy_.square()).sqrt();
  }

 private:
  std::size_t columns() const { return static_cast<std::size_t>(image_.cols); }
  void enter() {
    GradientRow& oldest = rows_[static_cast<std::size_t>(count_ % kSide)];
    gradient_products(image_, next_++, gx_, gy_, fresh_);
    move_sum(sum_.xx, fresh_.xx, oldest.xx);
    move_sum(sum_.xy, fresh_.xy, oldest.xy);
    move_sum(sum_.yy, fresh_.yy, oldest.yy);
    std::swap(oldest, fresh_);
    ++count_;
  }

  const Image& image_;
  int next_, count_ = 0;
  std::vector<std::int16_t> gx_, gy_;
  std::array<GradientRow, kSide> rows_;
  GradientRow fresh_, sum_;
  Strengths xx_, xy_, yy_;
};

/// One row of strengths and, for every pixel, the highest of three neighbours in the row, the pixel
/// itself included or only those `beside` it. The first and the last entry of these are undefined.
struct PeakRow {
  Strengths strengths, beside, highest;
  explicit PeakRow(Eigen::Index columns)
      : strengths(columns), beside(Strengths::Zero(columns)), highest(Strengths::Zero(columns)) {}
  void read(StrengthRows& rows) {
    rows.read(strengths);
    const Eigen::Index inner = strengths.size() - 2;
    beside.segment(1, inner) = strengths.head(inner).max(strengths.tail(inner));
    highest.segment(1, inner) = beside.segment(1, inner).max(strengths.segment(1, inner));
  }
};

}  // namespace

std::vector<Corner> find_corners(const Image& image, double min_strength, int border,
                                 const Image& blocked, const Image& mask) {
  require(image.type() == CV_8UC1, "find_corners: grey image needed");
  require(border >= kRadius + 2, "find_corners: border must be at least 4");
  for (const Image* of_size : {&blocked, &mask})
    require(of_size->empty() || (of_size->type() == CV_8UC1 && of_size->size() == image.size()),
            "find_corners: blocked and mask must be of the image's size");
  std::vector<Corner> corners;
  if (image.cols - border <= border || image.rows - border <= border) return corners;
  const float threshold = static_cast<float>(min_strength);
  StrengthRows rows(image, border - 1);
  std::array<PeakRow, 3> of{PeakRow(image.cols), PeakRow(image.cols),
                            PeakRow(image.cols)};  // the row above, this one and the one below
  of[0].read(rows);
  of[1].read(rows);
  Strengths highest(image.cols);
  for (int v = border; v < image.rows - border; ++v) {
    of[2].read(rows);
    // All neighbours at once: noise has a peak every few pixels, which defeats branch prediction.
    highest = of[0].highest.max(of[2].highest).max(of[1].beside).max(threshold);
    const float *here = of[1].strengths.data(), *over = highest.data();
    const std::uint8_t* no = blocked.empty() ? nullptr : blocked.ptr(v);
    const std::uint8_t* yes = mask.empty() ? nullptr : mask.ptr(v);
    for (int u = border; u < image.cols - border; ++u) {
      const float s = here[u];
      if (s < over[u] || !(s > threshold) || (no && no[u]) || (yes && !yes[u])) continue;
      corners.push_back({s, u, v});
    }
    std::swap(of[0], of[1]);
    std::swap(of[1], of[2]);
  }
  return corners;
}

}  // namespace placegraph
