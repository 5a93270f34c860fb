#pragma once
#include <placegraph/graph/image/image.h>

#include <Eigen/Core>
#include <optional>
#include <vector>

namespace placegraph {

/// The look of an image point where it was first seen, to be found again as it is warped affinely,
/// brighter or darker. Following a point from image to image adds up what each step mistakes; above
/// all, a window that grows as it comes nearer moves along with whatever texture it holds beside
/// its middle, at the same rate in every image, which no noise model describes. The first look does
/// not drift (Shi & Tomasi 1994). Found by inverse composition with gain and bias (Baker & Matthews
/// 2004), so that all but a small product is done once.
class AnchoredPatch {
 public:
  static constexpr int kHalf = 7;  ///< the patch reaches so far from its middle [px]

  /// How the patch lies in an image: point `offset` of the first image, from the patch's middle,
  /// is at px + A offset.
  struct Place {
    Eigen::Vector2f px = Eigen::Vector2f::Zero();
    Eigen::Matrix2f A = Eigen::Matrix2f::Identity();
    /// Of px as found [px^2], by what grey values differ by.
    Eigen::Matrix2f covariance = Eigen::Matrix2f::Zero();
  };

  /// Nothing where the patch leaves the image (CV_8UC1) or shows too little in some direction.
  static std::optional<AnchoredPatch> take(const Image& image, const Eigen::Vector2f& px);

  /// The patch in another image, given near it; `pyramid` as of cv::buildOpticalFlowPyramid.
  /// Nothing where it leaves the image, does not converge within `max_shift_px` of the start, or
  /// does not look alike (correlation below `min_correlation`).
  std::optional<Place> find(const std::vector<Image>& pyramid, const Place& start,
                            float max_shift_px, float min_correlation) const;

  /// Whether so warped a look is still comparable: beyond, a new one had better be taken.
  static bool is_comparable(const Eigen::Matrix2f& A);

 private:
  static constexpr int kSide = 2 * kHalf + 1, kPixels = kSide * kSide;
  /// Gain, bias, shift (2), and the change of A (4), by rows.
  static constexpr int kUnknowns = 8;
  using Row = Eigen::Matrix<float, kPixels, 1>;

  Row grey_;                                                       // grey values
  Eigen::Matrix<float, kUnknowns, kPixels, Eigen::RowMajor> fit_;  // of unknowns to grey values
  Eigen::Matrix2f covariance_;               // of the shift, of grey values that err by one
  Eigen::Matrix<float, kUnknowns, 4> keep_;  // of unknowns to how far A is from its start
};

}  // namespace placegraph
