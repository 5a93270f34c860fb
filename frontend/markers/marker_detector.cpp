#include <placegraph/frontend/flow/flow_vector.h>
#include <placegraph/frontend/markers/marker_detector.h>
#include <placegraph/frontend/markers/marker_dictionary.h>
#include <placegraph/frontend/markers/square_fit.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <cmath>
#include <opencv2/aruco.hpp>

namespace placegraph {

struct MarkerDetector::TagFamily {
  cv::Ptr<cv::aruco::Dictionary> dictionary;
};

MarkerDetector::MarkerDetector(const MarkerDetectorOptions& options, const std::string& dictionary)
    : options_(options), dictionary_(dictionary) {
  options_.check();
  const MarkerFamily family = marker_family(dictionary);
  family_ = std::make_shared<const TagFamily>(TagFamily{cv::makePtr<cv::aruco::Dictionary>(
      family.codes, family.bits_per_side, family.correctable_bits)});
}

void MarkerDetector::detect_in(const Image& grey, int left, int top, int right, int bottom,
                               const Camera* lens, std::vector<MarkerObservation>& found) const {
  const cv::Rect window(left, top, right - left, bottom - top);
  const double longest = std::max(window.width, window.height);
  if (std::min(window.width, window.height) < options_.min_side_px + 8) return;
  const auto parameters = cv::aruco::DetectorParameters::create();
  parameters->minMarkerPerimeterRate = 4 * options_.min_side_px / longest;
  parameters->errorCorrectionRate = options_.correction;
  // Least distance of two outlines; of nearer ones only the outermost is used. It is small so that
  // the outline of the sheet does not hide the marker printed on it.
  parameters->minMarkerDistanceRate = 0.02;
  // Threshold of dark pixels below their surroundings [grey levels]: above the noise, whose
  // thousands of specks would all be traced otherwise.
  constexpr double kSigmas = 3, kMost_grey = 20;
  parameters->adaptiveThreshConstant = std::clamp(kSigmas * image_noise(grey(window)),
                                                  parameters->adaptiveThreshConstant, kMost_grey);
  std::vector<std::vector<cv::Point2f>> squares;
  std::vector<int> ids;
  cv::aruco::detectMarkers(grey(window), family_->dictionary, squares, ids, parameters);
  const double border_share = 1.0 / (family_->dictionary->markerSize + 2);
  for (std::size_t i = 0; i < ids.size(); ++i) {
    SquareCorners corners;
    for (int k = 0; k < 4; ++k)
      corners[k] = Eigen::Vector2d(squares[i][k].x + left, squares[i][k].y + top);
    const auto fit = fit_square(grey, corners, border_share, options_.square, lens);
    if (!fit) continue;
    found.push_back({ids[i], fit->corners_px, fit->covariance, fit->contrast});
  }
}

namespace {

/// Whether two detections are the same marker, from two windows or both sides of a thick line.
void drop_copies(std::vector<MarkerObservation>& found) {
  std::stable_sort(
      found.begin(), found.end(),
      [](const MarkerObservation& a, const MarkerObservation& b) { return a.id < b.id; });
  const auto same = [](const MarkerObservation& a, const MarkerObservation& b) {
    // Distance of corners of one marker. Chosen.
    constexpr double kSame_px = 3;
    if (a.id != b.id) return false;
    for (int k = 0; k < 4; ++k)
      if ((a.corners_px[k] - b.corners_px[k]).norm() > kSame_px) return false;
    return true;
  };
  found.erase(std::unique(found.begin(), found.end(), same), found.end());
}

}  // namespace

std::vector<MarkerObservation> MarkerDetector::detect(const Image& grey, const Camera* lens) const {
  require(!grey.empty() && grey.type() == CV_8UC1, "MarkerDetector: grey image needed");
  std::vector<MarkerObservation> found;
  detect_in(grey, 0, 0, grey.cols, grey.rows, lens, found);
  drop_copies(found);
  return found;
}

std::vector<MarkerObservation> MarkerDetector::detect_near(
    const Image& grey, const std::vector<ExpectedSquare>& expected, const Camera* lens) const {
  require(!grey.empty() && grey.type() == CV_8UC1, "MarkerDetector: grey image needed");
  std::vector<MarkerObservation> found;
  for (const ExpectedSquare& square : expected) {
    Eigen::Vector2d low = square.corners_px[0], high = low;
    for (const Eigen::Vector2d& corner : square.corners_px) {
      low = low.cwiseMin(corner);
      high = high.cwiseMax(corner);
    }
    if (!low.allFinite() || !high.allFinite()) continue;
    constexpr double kLeastMargin_px = 12, kPaper = 0.15;  // white margin of a marker [widths]
    const double width = (high - low).maxCoeff();
    const double reach =
        square.within_px ? kPaper * width + *square.within_px : options_.search_margin * width;
    const double margin = std::max(kLeastMargin_px, reach);
    const auto inside = [](double value, int size) {
      return static_cast<int>(std::clamp(std::round(value), 0.0, static_cast<double>(size)));
    };
    detect_in(grey, inside(low.x() - margin, grey.cols), inside(low.y() - margin, grey.rows),
              inside(high.x() + margin, grey.cols), inside(high.y() + margin, grey.rows), lens,
              found);
  }
  drop_copies(found);
  return found;
}

}  // namespace placegraph
