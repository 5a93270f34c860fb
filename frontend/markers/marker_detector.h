#pragma once
#include <placegraph/frontend/markers/marker_options.h>
#include <placegraph/graph/geometry/camera.h>
#include <placegraph/graph/image/image.h>

#include <Eigen/Core>
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// Names of the supported families of square markers.
///
/// "aruco_4x4_50" to "aruco_7x7_1000", "aruco_original", "apriltag_16h5" to "apriltag_36h11".
std::vector<std::string> marker_dictionaries();

/// Pixels of the four corners of a square.
using SquareCorners = std::array<Eigen::Vector2d, 4>;

/// A marker in an image.
///
/// Corners: top left, top right, bottom right, bottom left of the upright marker (those of
/// PlacedMarker::corners_marker).
struct MarkerObservation {
  int id = 0;                ///< number in its dictionary
  SquareCorners corners_px;  ///< see above
  /// Joint covariance of the corners, [x0 y0 x1 y1 ...] [px^2].
  Eigen::Matrix<double, 8, 8> covariance = Eigen::Matrix<double, 8, 8>::Identity();
  double contrast = 0;  ///< contrast of the square to its surroundings [grey levels]

  /// Covariance of one corner [px^2].
  Eigen::Matrix2d corner_covariance(int corner) const {
    return covariance.block<2, 2>(2 * corner, 2 * corner);
  }
};

/// Predicted image of a marker.
struct ExpectedSquare {
  SquareCorners corners_px;  ///< in any order
  /// Maximum distance from the prediction; by default given by
  /// MarkerDetectorOptions::search_margin.
  std::optional<double> within_px = std::nullopt;
};

/// Detects the square markers of a dictionary.
///
/// Quadrangles and their codes by OpenCV's aruco (Garrido-Jurado et al. 2014), corners by
/// `fit_square`.
class MarkerDetector {
 public:
  /// Throws ArgumentError for an option out of range, or an unknown dictionary.
  MarkerDetector(const MarkerDetectorOptions& options, const std::string& dictionary);

  /// Detects all markers of the image (CV_8UC1, else ArgumentError), in the order of their ids.
  ///
  /// `lens`: the camera if it has distortion.
  std::vector<MarkerObservation> detect(const Image& grey, const Camera* lens = nullptr) const;
  /// Detects markers only around their predicted positions.
  ///
  /// A tenth of the work for a marker of a tenth of the image.
  std::vector<MarkerObservation> detect_near(const Image& grey,
                                             const std::vector<ExpectedSquare>& expected,
                                             const Camera* lens = nullptr) const;

  /// Name of the dictionary.
  const std::string& dictionary() const { return dictionary_; }

 private:
  struct TagFamily;
  void detect_in(const Image& grey, int left, int top, int right, int bottom, const Camera* lens,
                 std::vector<MarkerObservation>& found) const;

  MarkerDetectorOptions options_;
  std::string dictionary_;
  std::shared_ptr<const TagFamily> family_;
};

}  // namespace placegraph
