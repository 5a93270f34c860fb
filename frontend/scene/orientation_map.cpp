#include <placegraph/frontend/scene/orientation_map.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace placegraph {
namespace {

/// Longest sweep of an edge [image widths]. Chosen.
constexpr double kMaxSweep = 0.6;
/// Radius of the vote among neighbouring cells. Chosen.
constexpr int kSmoothingCells = 2;

/// Edges on a raster, a bit for each axis, and the search from a cell towards a vanishing point.
class Sweeper {
 public:
  struct Hit {
    int axis = -1;        ///< axis of the edge that was met; -1: none, or edges of two axes
    double distance = 0;  ///< distance of the edge [cells]
  };

  Sweeper(const std::vector<LineSegment>& segments, const std::vector<int>& axis,
          const Camera& camera, const SO3& R_cam_manhattan, const OrientationMapOptions& options)
      : cell_px_(options.cell_px),
        reach_(kMaxSweep * camera.width / options.cell_px),
        bits_(static_cast<int>(std::ceil(camera.height / options.cell_px)),
              static_cast<int>(std::ceil(camera.width / options.cell_px)), CV_8UC1, cv::Scalar(0)) {
    for (std::size_t i = 0; i < segments.size(); ++i)
      if (axis[i] >= 0) draw(segments[i], static_cast<std::uint8_t>(1U << axis[i]));
    const Eigen::Matrix3d M = camera.K() * R_cam_manhattan.matrix();
    for (int a = 0; a < 3; ++a) vanishing_[a] = M.col(a);
  }

  int rows() const { return bits_.rows; }
  int cols() const { return bits_.cols; }
  bool is_edge(int u, int v) const { return bits_.at<std::uint8_t>(v, u) != 0; }

  /// Searches from the middle of a cell along the line through the vanishing point of `along`,
  /// towards it (`sign` > 0) or away from it.
  Hit walk(int u, int v, int along, int sign) const {
    const Eigen::Vector3d& w = vanishing_[along];
    const Eigen::Vector2d from(u, v), px = cell_px_ * (from.array() + 0.5).matrix();
    Eigen::Vector2d direction = w.head<2>() - w[2] * px;
    const double length = direction.cwiseAbs().maxCoeff();
    if (length < 1e-9) return {};
    // If the direction points behind the camera, its image is on the other side, and the opposite
    // search leads to the vanishing point.
    double steps = reach_;
    if (sign * w[2] > 0) steps = std::min(steps, length / (std::abs(w[2]) * cell_px_));
    direction *= sign / length;
    for (int k = 1; k <= static_cast<int>(steps); ++k) {
      const Eigen::Vector2d at = from + k * direction;
      const int x = static_cast<int>(std::lround(at[0])), y = static_cast<int>(std::lround(at[1]));
      if (x < 0 || y < 0 || x >= cols() || y >= rows()) break;
      const unsigned met = bits_.at<std::uint8_t>(y, x) & ~(1U << along);
      if (met == 0) continue;
      const double distance = k * direction.norm();
      for (int a = 0; a < 3; ++a)
        if (met == 1U << a) return {a, distance};
      return {-1, distance};
    }
    return {};
  }

 private:
  /// Draws four-connected lines, so that no search passes through.
  void draw(const LineSegment& segment, std::uint8_t bit) {
    const double length = segment.length();
    const int steps = std::max(1, static_cast<int>(std::ceil(4 * length / cell_px_)));
    for (int k = 0; k <= steps; ++k) {
      const Eigen::Vector2d at =
          (segment.start + segment.vector() * (static_cast<double>(k) / steps)) / cell_px_;
      const int x = static_cast<int>(std::floor(at[0])), y = static_cast<int>(std::floor(at[1]));
      if (x >= 0 && y >= 0 && x < cols() && y < rows()) bits_.at<std::uint8_t>(y, x) |= bit;
    }
  }

  double cell_px_, reach_;
  Image bits_;
  std::array<Eigen::Vector3d, 3> vanishing_;
};

/// Support of the three orientations at a cell: the number of the four sweeps of each that support
/// it, with more weight for nearer edges; 0 without a sweep of each of its two axes.
std::array<double, 3> support_of(const Sweeper& sweeper, int u, int v, double halfway) {
  // for_[c][b]: support of normal c by sweeps along b.
  double for_[3][3] = {};
  for (int b = 0; b < 3; ++b)
    for (const int sign : {-1, 1}) {
      const Sweeper::Hit hit = sweeper.walk(u, v, b, sign);
      if (hit.axis < 0) continue;
      for_[3 - b - hit.axis][b] += 0.5 * halfway / (halfway + hit.distance);
    }
  std::array<double, 3> support{};
  for (int c = 0; c < 3; ++c) {
    const double first = for_[c][(c + 1) % 3], second = for_[c][(c + 2) % 3];
    if (first > 0 && second > 0) support[c] = 0.5 * (first + second);
  }
  return support;
}

/// The best orientation, or 0 if the second one is as good.
std::uint8_t choose(const cv::Vec3f& support, double margin, float& confidence) {
  int best = 0;
  for (int c = 1; c < 3; ++c)
    if (support[c] > support[best]) best = c;
  const float second = std::max(support[(best + 1) % 3], support[(best + 2) % 3]);
  confidence = 0;
  if (support[best] <= 0 || support[best] < margin * second) return 0;
  confidence = support[best];
  return static_cast<std::uint8_t>(best + 1);
}

/// Sums over all neighbours; to exclude those behind an edge would cost more time, and edges are
/// thin.
cv::Mat3f smoothed(const cv::Mat3f& support, int radius) {
  if (radius == 0) return support;
  cv::Mat3f mean;
  cv::blur(support, mean, {2 * radius + 1, 2 * radius + 1});
  return mean;
}

int axes_with_edges(const std::vector<int>& axis) {
  std::array<bool, 3> seen{};
  for (const int a : axis)
    if (a >= 0) seen[a] = true;
  return static_cast<int>(std::count(seen.begin(), seen.end(), true));
}

}  // namespace

const char* to_string(PlanSurface surface) {
  static constexpr const char* kNames[] = {"none", "floor", "ceiling", "wall"};
  return kNames[static_cast<int>(surface)];
}

OrientationMap compute_orientation_map(const std::vector<LineSegment>& segments,
                                       const std::vector<int>& axis, const Camera& camera,
                                       const SO3& R_cam_manhattan,
                                       const OrientationMapOptions& options) {
  options.check();
  require(segments.size() == axis.size(), "orientation map: needs an axis for every segment");
  OrientationMap map;
  const Eigen::Matrix3d R = R_cam_manhattan.matrix();
  R.row(1).cwiseAbs().maxCoeff(&map.vertical_axis);
  map.labels = Image(camera.height, camera.width, CV_8UC1, cv::Scalar(0));
  map.confidence = Image(camera.height, camera.width, CV_32FC1, cv::Scalar(0));
  if (axes_with_edges(axis) < 2) {
    map.outcome = Outcome::failure(Outcome::Code::kTooFewData, "edges of fewer than two axes");
    return map;
  }
  const Sweeper sweeper(segments, axis, camera, R_cam_manhattan, options);
  cv::Mat3f support(sweeper.rows(), sweeper.cols(), cv::Vec3f(0, 0, 0));
  const double halfway = 0.15 * camera.width / options.cell_px;
  for (int v = 0; v < sweeper.rows(); ++v)
    for (int u = 0; u < sweeper.cols(); ++u) {
      const auto s = support_of(sweeper, u, v, halfway);
      for (int c = 0; c < 3; ++c) support(v, u)[c] = static_cast<float>(s[c]);
    }
  support = smoothed(support, kSmoothingCells);
  cv::Mat1b labels(support.size(), 0);
  cv::Mat1f confidence(support.size(), 0);
  for (int v = 0; v < support.rows; ++v)
    for (int u = 0; u < support.cols; ++u) {
      labels(v, u) = choose(support(v, u), options.min_margin, confidence(v, u));
      if (confidence(v, u) < options.min_confidence) labels(v, u) = 0;
    }
  std::size_t labelled = 0;
  for (int v = 0; v < camera.height; ++v)
    for (int u = 0; u < camera.width; ++u) {
      const int y = static_cast<int>(v / options.cell_px),
                x = static_cast<int>(u / options.cell_px);
      map.labels.at<std::uint8_t>(v, u) = labels(y, x);
      map.confidence.at<float>(v, u) = confidence(y, x);
      labelled += labels(y, x) != 0;
    }
  map.coverage =
      static_cast<double>(labelled) / (static_cast<double>(camera.width) * camera.height);
  map.outcome = Outcome::ok();
  return map;
}

Image indoor_surfaces(const OrientationMap& map, const Camera& camera, const SO3& R_cam_manhattan) {
  Eigen::Vector3d down = R_cam_manhattan.matrix().col(map.vertical_axis);
  if (down[1] < 0) down = -down;
  const Eigen::Vector3d horizon = camera.K().inverse().transpose() * down;
  Image surfaces(map.labels.size(), CV_8UC1, cv::Scalar(0));
  for (int v = 0; v < surfaces.rows; ++v)
    for (int u = 0; u < surfaces.cols; ++u) {
      const int axis = map.labels.at<std::uint8_t>(v, u) - 1;
      PlanSurface surface = axis < 0 ? PlanSurface::kNone : PlanSurface::kWall;
      if (axis == map.vertical_axis)
        surface =
            horizon.dot(Eigen::Vector3d(u, v, 1)) > 0 ? PlanSurface::kFloor : PlanSurface::kCeiling;
      surfaces.at<std::uint8_t>(v, u) = static_cast<std::uint8_t>(surface);
    }
  return surfaces;
}

}  // namespace placegraph
