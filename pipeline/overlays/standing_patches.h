#pragma once
#include <placegraph/frontend/relative_pose/image_motion.h>
#include <placegraph/graph/geometry/camera.h>
#include <placegraph/graph/image/image.h>

#include <cstdint>
#include <optional>
#include <vector>

namespace placegraph {

/// Maximum displacement of a patch that stands still. Chosen.
inline constexpr double kStanding_px = 0.3;

/// An image of one byte a pixel.
void visit_state(auto& archive, Image& image) {
  std::int32_t rows = image.rows, cols = image.cols;
  archive(rows, cols);
  archive.require_left(std::int64_t{rows} * cols);
  if (archive.kReads) image = rows > 0 && cols > 0 ? Image(rows, cols, CV_8UC1) : Image();
  for (int row = 0; row < image.rows; ++row) archive.bytes(image.ptr(row), image.cols);
}

/// Small patches, at most one in each cell of a grid, that are compared with the same pixels of
/// later images. Nothing is searched: a patch stands still, or it is given up and the cell takes
/// another one.
///
/// A patch may stand still for good reason: it is far away and the camera translates, it lies in
/// the direction of motion, or the camera rests. Comparisons count only while patches elsewhere
/// move, and only motions of the camera that move every point of the world speak against a patch.
class StandingPatches {
 public:
  static constexpr int kColumns = 24, kRows = 16;  ///< cells of the grid

  explicit StandingPatches(const Camera& camera);

  /// Compares the patches with an image (CV_8UC1), and takes new ones. Where `mask` is 0 there are
  /// none (may be empty).
  void compare(const Image& image, const Image& mask);
  /// Whether enough patches stand still for so long that the motion of the camera must be asked.
  bool suspects() const;
  /// Judges the patches that have stood still since a comparison by the motion since then; returns
  /// whether it speaks against some of them.
  bool judge(const ImageMotion& motion, int since);
  /// Whether patches elsewhere moved at the last comparison, so that the camera does.
  bool moving() const { return moving_; }
  /// Number of comparisons so far.
  int comparisons() const { return comparisons_; }
  /// Pixels that no patch covers which has stood still for a while (CV_8UC1, 255; 0 elsewhere).
  Image elsewhere() const;
  /// The cells with proven patches, enough of them in one region, and those of other patches of the
  /// region that stand still (kRows x kColumns, CV_8UC1, 255; 0 elsewhere).
  Image proven_cells() const;
  void visit_state(auto& archive) {
    for (Cell& cell : cells_) archive(cell);
    archive(comparisons_);
    if (archive.kReads) take_up_patches();
  }

 private:
  struct Patch {
    cv::Point px;               // its centre
    Image pixels;               // as it was taken, with a border of one pixel
    std::vector<float> grey;    // row by row, without its mean
    std::vector<float> du, dv;  // gradients of the grey values
    Eigen::Matrix2f inverse;    // that of the sum of the squared gradients
    float norm2 = 0;            // sum of the squares of `grey`
    int taken = 0;              // the comparison at which it was taken
    int stood = 0;              // comparisons at which others moved and it did not
    double against = 0;         // in episodes that are certain
    void visit_state(auto& archive) { archive(px.x, px.y, pixels, taken, stood, against); }
  };
  struct Cell {
    std::optional<Patch> patch;
    int moved = 0;    // comparisons at which its patches moved
    int excused = 0;  // the same, when its patch was taken
    void visit_state(auto& archive) { archive(patch, moved, excused); }
  };
  cv::Rect rect(int cell) const;
  std::optional<Patch> take(const Image& image, const Image& mask, int cell) const;
  std::optional<Patch> patch_at(const Image& image, const cv::Point& px) const;
  static Eigen::Matrix2f describe(Patch& patch);
  void take_up_patches();
  cv::Rect centres() const;
  double texture(const Image& image, const cv::Point& px) const;
  bool stands(const Image& image, const Patch& patch) const;
  bool is_suspect(const Cell& cell) const;

  int width_, height_, half_;  // [px]; half the side of a patch
  std::vector<Cell> cells_;
  int comparisons_ = 0;
  bool moving_ = false;
};

}  // namespace placegraph
