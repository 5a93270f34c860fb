#include <placegraph/graph/core/error.h>
#include <placegraph/pipeline/overlays/standing_patches.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <opencv2/imgproc.hpp>

namespace placegraph {
namespace {

/// Minimum distance from a patch that stands still to the nearest pixel at which the motion allows
/// it. Chosen.
constexpr double kMinContradiction_px = 0.5;
/// Number of episodes that prove a patch to move with the camera. Chosen.
constexpr int kMinEpisodes = 2;
/// Minimum number of proven patches in a region that is masked. Chosen.
constexpr int kMinPatches = 6;

/// Patches are taken in one of so many cells at a comparison.
constexpr int kInterleaved = 4;

/// The smaller eigenvalue of the sum of squared gradients, `a`, `b`, `c` its elements uu, uv, vv.
double smaller_eigenvalue(double a, double b, double c) {
  return 0.5 * (a + c - std::hypot(a - c, 2 * b));
}

/// By how much an episode speaks against a patch that should have moved: 1 if the motion is
/// certain, less than 0 if it agrees.
double speaks_against(const ImageMotion::Displacement& must, double least_px) {
  constexpr double kNoise_px = 0.1, kUsual = 2, kCertain = 6;  // in standard deviations
  const double px = must.px.norm();
  const double sigmas = px < least_px ? 0 : px / std::hypot(must.sigma_px, kNoise_px);
  const double squared = std::min(sigmas * sigmas, kCertain * kCertain);
  return (squared - kUsual * kUsual) / (kCertain * kCertain - kUsual * kUsual);
}

}  // namespace

StandingPatches::StandingPatches(const Camera& camera)
    : width_(camera.width),
      height_(camera.height),
      half_(std::clamp(camera.width / 160, 3, 8)),
      cells_(static_cast<std::size_t>(kColumns) * kRows) {}

cv::Rect StandingPatches::rect(int cell) const {
  const int column = cell % kColumns, row = cell / kColumns;
  const cv::Point begin(column * width_ / kColumns, row * height_ / kRows);
  return {begin, cv::Point((column + 1) * width_ / kColumns, (row + 1) * height_ / kRows)};
}

/// The pixels around which a patch with its border is within the image.
cv::Rect StandingPatches::centres() const {
  return {half_ + 1, half_ + 1, width_ - 2 * half_ - 2, height_ - 2 * half_ - 2};
}

void StandingPatches::compare(const Image& image, const Image& mask) {
  // Patches that must move, and their share, for the camera to move; comparisons for which a patch
  // is excused at most. Chosen.
  constexpr int kFewest = 8, kMostExcused = 50;
  constexpr double kMovingShare = 0.25;
  ++comparisons_;
  std::vector<Cell*> standing, moved;
  for (Cell& cell : cells_)
    if (cell.patch && !mask.empty() && mask.at<std::uint8_t>(cell.patch->px) == 0)
      cell.patch.reset();
    else if (cell.patch)
      (stands(image, *cell.patch) ? standing : moved).push_back(&cell);
  // A cell whose patch moved waits until it is taken again: so many cells are in motion.
  const auto in_motion = static_cast<double>(kInterleaved * moved.size());
  moving_ = moved.size() >= kFewest &&
            in_motion >= kMovingShare * (in_motion + static_cast<double>(standing.size()));
  for (Cell* cell : standing) cell->patch->stood += moving_;
  for (Cell* cell : moved) {
    cell->patch.reset();
    if (moving_) cell->moved = std::min(cell->moved + 1, kMostExcused);
  }
  for (int c = comparisons_ % kInterleaved; c < static_cast<int>(cells_.size());
       c += kInterleaved) {
    Cell& cell = cells_[c];
    if (cell.patch) continue;
    cell.patch = take(image, mask, c);
    cell.excused = cell.moved;
  }
}

/// The patch with most texture of nine that cover a cell.
std::optional<StandingPatches::Patch> StandingPatches::take(const Image& image, const Image& mask,
                                                            int cell) const {
  // Chosen: nine patches.
  constexpr int kSide = 3;
  const cv::Rect inside = centres();
  const cv::Rect within = rect(cell);
  double most = 0;
  cv::Point best;
  for (int i = 0; i < kSide * kSide; ++i) {
    const cv::Point px(within.x + (2 * (i % kSide) + 1) * within.width / (2 * kSide),
                       within.y + (2 * (i / kSide) + 1) * within.height / (2 * kSide));
    if (!inside.contains(px) || (!mask.empty() && mask.at<std::uint8_t>(px) == 0)) continue;
    const double found = texture(image, px);
    if (found > most) most = found, best = px;
  }
  return most > 0 ? patch_at(image, best) : std::nullopt;
}

/// Texture of every other pixel of a patch.
double StandingPatches::texture(const Image& image, const cv::Point& px) const {
  int uu = 0, uv = 0, vv = 0;
  for (int v = px.y - half_; v <= px.y + half_; v += 2) {
    const std::uint8_t* row = image.ptr<std::uint8_t>(v);
    const std::uint8_t* above = image.ptr<std::uint8_t>(v - 1);
    const std::uint8_t* below = image.ptr<std::uint8_t>(v + 1);
    for (int u = px.x - half_; u <= px.x + half_; u += 2) {
      const int du = row[u + 1] - row[u - 1], dv = below[u] - above[u];
      uu += du * du, uv += du * dv, vv += dv * dv;
    }
  }
  return smaller_eigenvalue(uu, uv, vv);
}

/// Nothing if its position could not be measured to a fraction of `standing_px`.
std::optional<StandingPatches::Patch> StandingPatches::patch_at(const Image& image,
                                                                const cv::Point& px) const {
  constexpr double kNoise_grey = 3, kFraction = 0.25;  // noise: that of two grey values
  Patch patch;
  patch.px = px;
  patch.taken = comparisons_;
  const int side = 2 * half_ + 3;
  patch.pixels = image(cv::Rect(px.x - half_ - 1, px.y - half_ - 1, side, side));
  const Eigen::Matrix2f information = describe(patch);
  const double sigma_px = kFraction * kStanding_px;
  if (smaller_eigenvalue(information(0, 0), information(0, 1), information(1, 1)) <
      std::pow(kNoise_grey / sigma_px, 2))
    return std::nullopt;
  patch.pixels = patch.pixels.clone();
  return patch;
}

/// Computes grey values and gradients of the pixels of a patch; returns the sum of the squared
/// gradients.
Eigen::Matrix2f StandingPatches::describe(Patch& patch) {
  Eigen::Matrix2f sum = Eigen::Matrix2f::Zero();
  for (int v = 1; v + 1 < patch.pixels.rows; ++v) {
    const std::uint8_t* row = patch.pixels.ptr<std::uint8_t>(v);
    const std::uint8_t* above = patch.pixels.ptr<std::uint8_t>(v - 1);
    const std::uint8_t* below = patch.pixels.ptr<std::uint8_t>(v + 1);
    for (int u = 1; u + 1 < patch.pixels.cols; ++u) {
      patch.grey.push_back(row[u]);
      const Eigen::Vector2f g(0.5F * (row[u + 1] - row[u - 1]), 0.5F * (below[u] - above[u]));
      patch.du.push_back(g.x());
      patch.dv.push_back(g.y());
      sum += g * g.transpose();
    }
  }
  const auto count = static_cast<float>(patch.grey.size());
  const float mean = std::accumulate(patch.grey.begin(), patch.grey.end(), 0.F) / count;
  for (float& grey : patch.grey) grey -= mean, patch.norm2 += grey * grey;
  patch.inverse = sum.inverse();
  return sum;
}

/// Computes what is not saved of the patches.
void StandingPatches::take_up_patches() {
  const int side = 2 * half_ + 3;
  for (Cell& cell : cells_) {
    if (!cell.patch) continue;
    require(cell.patch->pixels.size() == cv::Size(side, side) && centres().contains(cell.patch->px),
            "the saved patches are those of another camera");
    describe(*cell.patch);
  }
}

/// Whether the image shows the patch where it was taken, up to gain and offset: its displacement by
/// a step of Lucas and Kanade is that of a patch at rest.
bool StandingPatches::stands(const Image& image, const Patch& patch) const {
  // Correlation of a patch that is recognized. Chosen, as for anchors of tracks.
  constexpr float kLeastCorrelation = 0.8F;
  float sum = 0, squares = 0, product = 0;
  Eigen::Vector2f of_patch = Eigen::Vector2f::Zero(), of_image = of_patch, of_one = of_patch;
  std::size_t i = 0;
  for (int v = patch.px.y - half_; v <= patch.px.y + half_; ++v) {
    const std::uint8_t* row = image.ptr<std::uint8_t>(v);
    for (int u = patch.px.x - half_; u <= patch.px.x + half_; ++u, ++i) {
      const float grey = row[u];
      const Eigen::Vector2f g(patch.du[i], patch.dv[i]);
      sum += grey, squares += grey * grey, product += grey * patch.grey[i];
      of_patch += patch.grey[i] * g, of_image += grey * g, of_one += g;
    }
  }
  const float mean = sum / static_cast<float>(patch.grey.size());
  const float norm2 = squares - sum * mean;
  if (norm2 <= 0 || product < kLeastCorrelation * std::sqrt(norm2 * patch.norm2)) return false;
  const float gain = product / norm2;
  const Eigen::Vector2f shift = patch.inverse * (gain * (of_image - mean * of_one) - of_patch);
  return shift.norm() < kStanding_px;
}

/// Where patches used to move, one must stand still for long.
bool StandingPatches::is_suspect(const Cell& cell) const {
  // Comparisons in a row. Chosen.
  constexpr int kComparisons = 4;
  return cell.patch && cell.patch->stood >= kComparisons + cell.excused;
}

bool StandingPatches::suspects() const {
  return std::ranges::count_if(cells_, [this](const Cell& c) { return is_suspect(c); }) >=
         kMinPatches;
}

bool StandingPatches::judge(const ImageMotion& motion, int since) {
  bool found = false;
  for (Cell& cell : cells_) {
    if (!is_suspect(cell) || cell.patch->taken > since) continue;
    const auto must = motion.least_displacement({cell.patch->px.x, cell.patch->px.y});
    if (!must) continue;
    const double spoken = speaks_against(*must, kMinContradiction_px);
    cell.patch->against = std::max(0.0, cell.patch->against + spoken);
    found = found || spoken > 0;
  }
  return found;
}

Image StandingPatches::elsewhere() const {
  // Comparisons in a row. Chosen.
  constexpr int kComparisons = 2;
  Image mask(height_, width_, CV_8UC1, cv::Scalar(255));
  for (int c = 0; c < static_cast<int>(cells_.size()); ++c)
    if (cells_[c].patch && cells_[c].patch->stood >= kComparisons) mask(rect(c)).setTo(0);
  return mask;
}

Image StandingPatches::proven_cells() const {
  // Chosen: episodes that speak against a patch by less than all count in part.
  constexpr double kTolerance = 0.5;
  Image cells = Image::zeros(kRows, kColumns, CV_8UC1), labels;
  for (int c = 0; c < kRows * kColumns; ++c)
    if (is_suspect(cells_[c])) cells.at<std::uint8_t>(c / kColumns, c % kColumns) = 255;
  cv::morphologyEx(cells, cells, cv::MORPH_CLOSE, Image::ones(3, 3, CV_8UC1));
  std::vector<int> proven(cv::connectedComponents(cells, labels), 0);
  for (int c = 0; c < kRows * kColumns; ++c)
    if (is_suspect(cells_[c]) && cells_[c].patch->against >= kMinEpisodes - kTolerance)
      ++proven[labels.at<int>(c / kColumns, c % kColumns)];
  for (int c = 0; c < kRows * kColumns; ++c)
    if (proven[labels.at<int>(c / kColumns, c % kColumns)] < kMinPatches)
      cells.at<std::uint8_t>(c / kColumns, c % kColumns) = 0;
  return cells;
}

}  // namespace placegraph
