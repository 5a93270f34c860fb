#include <placegraph/io/synthetic/render/depth_sensor.h>
#include <placegraph/io/synthetic/render/hash_noise.h>

#include <algorithm>
#include <vector>

namespace placegraph::synthetic {
namespace {

constexpr float kEdgeStep = 0.03F;  ///< least step of inverse depth at a depth edge, as a share
constexpr int kFlyingReach_px = 2, kShadowReach_px = 4;
constexpr double kPatch_m = 0.25;  ///< size of the patches that return no light
constexpr std::uint32_t kFlying = 1, kBetween = 2, kNoise = 3, kRough = 4;  ///< salts of the noise

/// The depth edges of an image: where inverse depth jumps by more than its slope beside the jump,
/// which a plane never does.
struct DepthEdges {
  explicit DepthEdges(const cv::Size& size)
      : near(size, CV_32FC1, cv::Scalar(0)),
        far(size, CV_32FC1, cv::Scalar(0)),
        shadow(size, CV_8UC1, cv::Scalar(0)) {}
  Image near, far;  ///< CV_32FC1: inverse depths of an edge's sides within kFlyingReach_px, or 0
  Image shadow;     ///< CV_8UC1: 1 on the far side of an edge within kShadowReach_px
};

class EdgeFinder {
 public:
  explicit EdgeFinder(const Image& inverse_depth)
      : iz_(inverse_depth), edges_(inverse_depth.size()) {}

  DepthEdges find() {
    for (int v = 0; v < iz_.rows; ++v) {
      for (int u = 0; u < iz_.cols; ++u) {
        if (u >= 1 && u + 2 < iz_.cols) test(u, v, 1, 0);
        if (v >= 1 && v + 2 < iz_.rows) test(u, v, 0, 1);
      }
    }
    return std::move(edges_);
  }

 private:
  float at(int u, int v) const { return iz_.ptr<float>(v)[u]; }

  /// Tests the step from (u, v) to the next pixel.
  void test(int u, int v, int du, int dv) {
    const float a = at(u, v), b = at(u + du, v + dv);
    const float high = std::max(a, b), low = std::min(a, b);
    if (low <= 0 || high - low <= kEdgeStep * high) return;
    const float slope =
        std::max(std::abs(a - at(u - du, v - dv)), std::abs(at(u + 2 * du, v + 2 * dv) - b));
    if (high - low > slope + kEdgeStep * high) mark(u, v, du, dv, high, low);
  }

  void mark(int u, int v, int du, int dv, float high, float low) {
    const int r = kShadowReach_px - 1;
    for (int y = std::max(0, v - r); y <= std::min(iz_.rows - 1, v + dv + r); ++y) {
      for (int x = std::max(0, u - r); x <= std::min(iz_.cols - 1, u + du + r); ++x) {
        if (at(x, y) < 0.5F * (high + low)) edges_.shadow.ptr<unsigned char>(y)[x] = 1;
        const int distance = std::max(std::max(u - x, x - u - du), std::max(v - y, y - v - dv));
        if (distance >= kFlyingReach_px) continue;
        float &near = edges_.near.ptr<float>(y)[x], &far = edges_.far.ptr<float>(y)[x];
        far = near > 0 ? std::min(far, low) : low;
        near = std::max(near, high);
      }
    }
  }

  const Image& iz_;
  DepthEdges edges_;
};

/// Cosine of the angle between the ray of a pixel and the normal of the surface there.
float incidence(const Image& inverse_depth, const Camera& camera, int u, int v) {
  const auto at = [&](int x, int y) {
    return inverse_depth.ptr<float>(
        std::clamp(y, 0, inverse_depth.rows - 1))[std::clamp(x, 0, inverse_depth.cols - 1)];
  };
  // The smaller of two slopes is that of the surface, where the other one crosses an edge.
  const auto smaller = [](float a, float b) { return std::abs(a) < std::abs(b) ? a : b; };
  const float iz = at(u, v), du = smaller(at(u + 1, v) - iz, iz - at(u - 1, v)),
              dv = smaller(at(u, v + 1) - iz, iz - at(u, v - 1));
  // Inverse depth is the product of the ray and the normal over the plane's distance.
  const Eigen::Vector3d ray((u - camera.cx) / camera.fx, (v - camera.cy) / camera.fy, 1);
  const double x = camera.fx * du, y = camera.fy * dv;
  const Eigen::Vector3d normal(x, y, iz - ray[0] * x - ray[1] * y);
  return static_cast<float>(iz / (normal.norm() * ray.norm()));
}

/// How little light of a surface's spot returns, in [-1, 1]: smooth patches fixed to the scene.
float absorption(const Eigen::Vector3d& p, std::uint32_t seed) {
  // The plane noise is sheared with height, so that it varies along walls and along floors.
  const double x = (p[0] + 0.37 * p[1]) / kPatch_m, y = (p[2] + 0.61 * p[1]) / kPatch_m;
  return 0.75F * value_noise(x, y, seed) + 0.25F * value_noise(3 * x, 3 * y, seed + 1);
}

/// The least reliable share of the pixels with a surface: CV_8UC1, 1 = no measurement.
Image find_holes(const Image& inverse_depth, const DepthEdges& edges, const View& view,
                 double share, std::uint32_t noise_seed, std::uint32_t surface_seed) {
  const Camera& camera = view.camera;
  Image score(inverse_depth.size(), CV_32FC1);
  std::vector<float> ordered;
  for (int v = 0; v < score.rows; ++v) {
    const auto* iz = inverse_depth.ptr<float>(v);
    for (int u = 0; u < score.cols; ++u) {
      if (iz[u] <= 0) continue;
      const Eigen::Vector3d ray((u - camera.cx) / camera.fx, (v - camera.cy) / camera.fy, 1);
      const float grazing = clamp01((0.35F - incidence(inverse_depth, camera, u, v)) * 4);
      const float value = absorption(view.T_scene_cam * (ray / iz[u]), surface_seed) +
                          1.2F * grazing + 0.8F * edges.shadow.ptr<unsigned char>(v)[u] +
                          0.2F * hash_unit(hash_cell(u, v, noise_seed + kRough));
      score.ptr<float>(v)[u] = value;
      ordered.push_back(value);
    }
  }
  Image holes(inverse_depth.size(), CV_8UC1, cv::Scalar(0));
  const auto kept = static_cast<std::size_t>((1 - share) * static_cast<double>(ordered.size()));
  if (kept >= ordered.size()) return holes;
  std::nth_element(ordered.begin(), ordered.begin() + static_cast<std::ptrdiff_t>(kept),
                   ordered.end());
  for (int v = 0; v < score.rows; ++v)
    for (int u = 0; u < score.cols; ++u)
      if (inverse_depth.ptr<float>(v)[u] > 0 && score.ptr<float>(v)[u] >= ordered[kept])
        holes.ptr<unsigned char>(v)[u] = 1;
  return holes;
}

/// What the camera takes for the inverse depth of a pixel.
float perceived(float inverse_depth, float near, float far, const DepthSensor& sensor,
                std::uint32_t h) {
  double iz = inverse_depth;
  if (near > 0 && hash_unit(h, kFlying) < static_cast<float>(sensor.flying_pixels)) {
    const double a = hash_unit(h, kBetween);  // depth, not its inverse, is spread evenly
    iz = 1 / ((1 - a) / near + a / far);
  }
  if (sensor.noise > 0) iz += sensor.noise * hash_normal(mix_bits(h + kNoise));
  if (sensor.step > 0) iz = sensor.step * std::floor(iz / sensor.step + 0.5);
  return static_cast<float>(iz);
}

}  // namespace

Image measure_depth(const Image& inverse_depth, const View& view, const DepthSensor& sensor,
                    std::uint32_t noise_seed, std::uint32_t surface_seed) {
  const DepthEdges edges = sensor.holes > 0 || sensor.flying_pixels > 0
                               ? EdgeFinder(inverse_depth).find()
                               : DepthEdges(inverse_depth.size());
  const Image holes = sensor.holes > 0 ? find_holes(inverse_depth, edges, view, sensor.holes,
                                                    noise_seed, surface_seed)
                                       : Image(inverse_depth.size(), CV_8UC1, cv::Scalar(0));
  Image depth(inverse_depth.size(), CV_32FC1, cv::Scalar(0));
  for (int v = 0; v < depth.rows; ++v) {
    for (int u = 0; u < depth.cols; ++u) {
      const float exact = inverse_depth.ptr<float>(v)[u];
      if (exact <= 0 || holes.ptr<unsigned char>(v)[u]) continue;
      const float iz = perceived(exact, edges.near.ptr<float>(v)[u], edges.far.ptr<float>(v)[u],
                                 sensor, hash_cell(u, v, noise_seed));
      if (iz > 0) depth.ptr<float>(v)[u] = static_cast<float>(sensor.scale / iz);
    }
  }
  return depth;
}

}  // namespace placegraph::synthetic
