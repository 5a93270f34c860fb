#pragma once
#include <placegraph/graph/image/image.h>

#include <Eigen/Core>
#include <optional>
#include <vector>

namespace placegraph {

/// The image patch around a point where its track began, to correct the drift of the track.
///
/// The patch is found in later images under an affine warp with gain and bias. Tracking from image
/// to image accumulates the errors of all steps. Above all, a window whose content grows as the
/// camera approaches is drawn by the texture beside its centre at the same rate in every image,
/// which no noise model describes. The first patch does not drift (Shi & Tomasi 1994). It is
/// aligned by inverse composition (Baker & Matthews 2004), so that all but a small product is
/// computed once.
class AnchoredPatch {
 public:
  static constexpr int kHalf = 7;  ///< half the side of the patch [px]

  /// Position and warp of the patch in an image.
  ///
  /// The point at `offset` from the patch's centre in the first image is at px + A offset.
  struct Place {
    Eigen::Vector2f px = Eigen::Vector2f::Zero();
    Eigen::Matrix2f A = Eigen::Matrix2f::Identity();
    /// Covariance of px [px^2] from the residuals of the grey values.
    Eigen::Matrix2f covariance = Eigen::Matrix2f::Zero();
  };

  /// Takes a patch; nothing if it leaves the image (CV_8UC1) or has too little texture.
  static std::optional<AnchoredPatch> take(const Image& image, const Eigen::Vector2f& px);

  /// Finds the patch in another image from a start near it.
  ///
  /// `pyramid` is that of cv::buildOpticalFlowPyramid. Nothing if the patch leaves the image, does
  /// not converge within `max_shift_px` of the start, or its correlation is below
  /// `min_correlation`.
  std::optional<Place> find(const std::vector<Image>& pyramid, const Place& start,
                            float max_shift_px, float min_correlation) const;

  /// Whether a patch with this warp is still comparable; if not, a new patch should be taken.
  static bool is_comparable(const Eigen::Matrix2f& A);

 private:
  static constexpr int kSide = 2 * kHalf + 1, kPixels = kSide * kSide;
  /// Unknowns: gain, bias, shift (2), and the change of A (4), by rows.
  static constexpr int kUnknowns = 8;
  using Row = Eigen::Matrix<float, kPixels, 1>;

  Row grey_;                                                       // grey values
  Eigen::Matrix<float, kUnknowns, kPixels, Eigen::RowMajor> fit_;  // from grey values to unknowns
  Eigen::Matrix2f covariance_;                                     // shift's, for a unit grey error
  Eigen::Matrix<float, kUnknowns, 4> keep_;  // from the deviation of A from its start to unknowns
};

}  // namespace placegraph
