#pragma once
#include <placegraph/frontend/internal/markers/marker_options.h>
#include <placegraph/frontend/internal/markers/square_fit.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace placegraph {

/// A marker in an image. Corners: top left, top right, bottom right, bottom left, as somebody reads
/// it (those of PlacedMarker::corners_marker).
struct MarkerObservation {
  int id = 0;
  SquareCorners corners_px;
  /// Of the corners together, [x0 y0 x1 y1 ...] [px^2].
  Eigen::Matrix<double, 8, 8> covariance = Eigen::Matrix<double, 8, 8>::Identity();
  double contrast = 0;  ///< of the square with its surroundings, grey levels

  /// Of one corner [px^2].
  Eigen::Matrix2d corner_covariance(int corner) const {
    return covariance.block<2, 2>(2 * corner, 2 * corner);
  }
};

/// Where a marker should be in an image.
struct ExpectedSquare {
  SquareCorners corners_px;  ///< in any order
  /// It may be so far from there; without, as far as MarkerDetectorOptions::search_margin says.
  std::optional<double> within_px = std::nullopt;
};

/// Finds the square markers of a dictionary: quadrangles and their codes by OpenCV's aruco
/// (Garrido-Jurado et al. 2014), corners by `fit_square`.
class MarkerDetector {
 public:
  /// Throws ArgumentError for an option out of range, or a dictionary that is not known.
  MarkerDetector(const MarkerDetectorOptions& options, const std::string& dictionary);

  /// All markers of the image (CV_8UC1, else ArgumentError), in the order of their ids. `lens`: the
  /// camera if it bends straight lines.
  std::vector<MarkerObservation> detect(const Image& grey, const Camera* lens = nullptr) const;
  /// The same, looked for only around where markers are expected: a tenth of the work for a marker
  /// of a tenth of the image.
  std::vector<MarkerObservation> detect_near(const Image& grey,
                                             const std::vector<ExpectedSquare>& expected,
                                             const Camera* lens = nullptr) const;

  const std::string& dictionary() const { return dictionary_; }

 private:
  struct DirectionCluster;
  void detect_in(const Image& grey, int left, int top, int right, int bottom, const Camera* lens,
                 std::vector<MarkerObservation>& found) const;

  MarkerDetectorOptions options_;
  std::string dictionary_;
  std::shared_ptr<const DirectionCluster> family_;
};

}  // namespace placegraph
