#include <placegraph/frontend/markers/beacon_detector.h>
#include <placegraph/graph/core/error.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <opencv2/imgproc.hpp>

namespace placegraph {
namespace {

/// Grey value of the background: the median of the window's outermost pixels.
double surroundings(const Image& grey, const cv::Rect& window) {
  std::vector<std::uint8_t> rim;
  for (int u = window.x; u < window.x + window.width; ++u) {
    rim.push_back(grey.at<std::uint8_t>(window.y, u));
    rim.push_back(grey.at<std::uint8_t>(window.y + window.height - 1, u));
  }
  for (int v = window.y; v < window.y + window.height; ++v) {
    rim.push_back(grey.at<std::uint8_t>(v, window.x));
    rim.push_back(grey.at<std::uint8_t>(v, window.x + window.width - 1));
  }
  const auto middle = rim.begin() + static_cast<std::ptrdiff_t>(rim.size() / 2);
  std::nth_element(rim.begin(), middle, rim.end());
  return *middle;
}

cv::Rect grown(const cv::Rect& box, const Image& grey) {
  const int margin = 3 + std::max(box.width, box.height) / 2;
  return cv::Rect(box.x - margin, box.y - margin, box.width + 2 * margin, box.height + 2 * margin) &
         cv::Rect(0, 0, grey.cols, grey.rows);
}

/// Computes centre, covariance and shape of the spot around `seed`; false if there is no spot.
bool measure(const Image& grey, const cv::Rect& window, const cv::Point& seed,
             const BeaconDetectorOptions& options, BeaconObservation& spot) {
  const double around = surroundings(grey, window);
  const double peak = grey.at<std::uint8_t>(seed);
  if (peak - around < options.min_contrast) return false;
  const double half = 0.5 * (peak + around);
  Image above, labels;
  cv::compare(grey(window), half, above, cv::CMP_GT);
  cv::connectedComponents(above, labels, 8, CV_32S);
  const int label = labels.at<int>(seed.y - window.y, seed.x - window.x);
  double sum = 0, area = 0;
  Eigen::Vector2d first = Eigen::Vector2d::Zero();
  Eigen::Matrix2d second = Eigen::Matrix2d::Zero(), moments = Eigen::Matrix2d::Zero();
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (int v = 0; v < window.height; ++v)
    for (int u = 0; u < window.width; ++u) {
      if (labels.at<int>(v, u) != label) continue;
      // A bright region that leaves its window is too large for a spot.
      if (u == 0 || v == 0 || u == window.width - 1 || v == window.height - 1) return false;
      const Eigen::Vector2d px(u, v);
      const double weight = grey.at<std::uint8_t>(window.y + v, window.x + u) - half;
      sum += weight;
      first += weight * px;
      area += 1;
      mean += px;
      second += px * px.transpose();
    }
  if (area < options.min_area_px || area > options.max_area_px || sum <= 0) return false;
  const Eigen::Vector2d centre = first / sum;
  mean /= area;
  moments = second - area * mean * mean.transpose();
  // The extent of a pixel is added, so that spots of a few pixels are not degenerate lines.
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(
      Eigen::Matrix2d(moments / area + Eigen::Matrix2d::Identity() / 12), Eigen::EigenvaluesOnly);
  if (std::sqrt(axes.eigenvalues()[0] / axes.eigenvalues()[1]) < options.min_roundness)
    return false;
  constexpr double kNoise = 3;  // noise of a pixel [grey levels]
  const Eigen::Matrix2d spread = second - mean * area * centre.transpose() -
                                 centre * area * mean.transpose() +
                                 area * centre * centre.transpose();
  spot.px = centre + Eigen::Vector2d(window.x, window.y);
  spot.covariance = kNoise * kNoise / (sum * sum) * spread +
                    options.min_sigma_px * options.min_sigma_px * Eigen::Matrix2d::Identity();
  spot.area_px = area;
  return true;
}

}  // namespace

std::vector<BeaconObservation> detect_beacons(const Image& grey,
                                              const BeaconDetectorOptions& options) {
  options.check();
  require(!grey.empty() && grey.type() == CV_8UC1, "detect_beacons: grey image needed");
  Image bright, labels, stats, centroids;
  cv::compare(grey, options.min_grey, bright, cv::CMP_GE);
  const int count = cv::connectedComponentsWithStats(bright, labels, stats, centroids, 8, CV_32S);
  std::vector<BeaconObservation> spots;
  for (int label = 1; label < count; ++label) {
    const int* row = stats.ptr<int>(label);
    if (row[cv::CC_STAT_AREA] > options.max_area_px) continue;
    const cv::Rect box(row[cv::CC_STAT_LEFT], row[cv::CC_STAT_TOP], row[cv::CC_STAT_WIDTH],
                       row[cv::CC_STAT_HEIGHT]);
    cv::Point seed(box.x, box.y);
    int peak = -1;
    for (int v = box.y; v < box.y + box.height; ++v)
      for (int u = box.x; u < box.x + box.width; ++u)
        if (labels.at<int>(v, u) == label && grey.at<std::uint8_t>(v, u) > peak) {
          peak = grey.at<std::uint8_t>(v, u);
          seed = {u, v};
        }
    BeaconObservation spot;
    if (!measure(grey, grown(box, grey), seed, options, spot)) continue;
    // Seeds within one spot are merged.
    const bool known = std::any_of(spots.begin(), spots.end(), [&](const BeaconObservation& other) {
      return (other.px - spot.px).norm() < 1;
    });
    if (!known) spots.push_back(spot);
  }
  std::stable_sort(
      spots.begin(), spots.end(),
      [](const BeaconObservation& a, const BeaconObservation& b) { return a.area_px > b.area_px; });
  return spots;
}

}  // namespace placegraph
