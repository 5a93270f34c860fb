#include <placegraph/io/synthetic/render/rasterizer.h>

#include <algorithm>

namespace placegraph::synthetic {
namespace {

constexpr double kNear_m = 0.05;
constexpr double kGuard_px = 3000;  // corners further out are clipped, so that fixed point suffices
constexpr int kMaxCorners = 10;

struct Polygon {
  std::array<Eigen::Vector3d, kMaxCorners> p;
  int n = 0;
};

/// Keeps the side where plane . p >= offset (Sutherland & Hodgman 1974).
void clip(Polygon& polygon, const Eigen::Vector3d& plane, double offset) {
  Polygon out;
  for (int i = 0; i < polygon.n; ++i) {
    const Eigen::Vector3d &a = polygon.p[i], &b = polygon.p[(i + 1) % polygon.n];
    const double da = plane.dot(a) - offset, db = plane.dot(b) - offset;
    if (da >= 0 && out.n < kMaxCorners) out.p[out.n++] = a;
    if ((da >= 0) != (db >= 0) && out.n < kMaxCorners) {
      // The cut is computed from the inner end, so that two faces on one edge cut it at the same
      // bits.
      const Eigen::Vector3d &in = da >= 0 ? a : b, &outside = da >= 0 ? b : a;
      const double di = da >= 0 ? da : db, d_out = da >= 0 ? db : da;
      out.p[out.n++] = in + (outside - in) * (di / (di - d_out));
    }
  }
  polygon = out;
}

struct Frustum {
  std::array<Eigen::Vector3d, 4> sides;  // inward unit normals in the camera frame
};

Frustum make_frustum(const Camera& camera) {
  const double l = (-0.5 - camera.cx) / camera.fx, r = (camera.width - 0.5 - camera.cx) / camera.fx;
  const double t = (-0.5 - camera.cy) / camera.fy,
               b = (camera.height - 0.5 - camera.cy) / camera.fy;
  return {{Eigen::Vector3d(1, 0, -l).normalized(), Eigen::Vector3d(-1, 0, r).normalized(),
           Eigen::Vector3d(0, 1, -t).normalized(), Eigen::Vector3d(0, -1, b).normalized()}};
}

class Gatherer {
 public:
  Gatherer(const View& view, std::vector<SeenFace>& out)
      : camera_(view.camera), frustum_(make_frustum(view.camera)), out_(out) {}

  void add_part(const Part& part, const SE3& T_cam_part, int object) {
    const Eigen::Vector3d centre = T_cam_part * part.centre;
    if (centre[2] + part.radius < kNear_m) return;
    for (const Eigen::Vector3d& side : frustum_.sides) {
      if (side.dot(centre) < -part.radius) return;
    }
    if (part.radius * camera_.fx < 0.4 * (centre[2] - part.radius)) return;  // under a pixel
    R_ = T_cam_part.rotation().matrix();
    t_ = T_cam_part.translation();
    camera_position_ = -(R_.transpose() * t_);
    for (const Face& face : part.faces) add_face(face, object);
  }

 private:
  void add_face(const Face& face, int object) {
    const double facing = face.normal.dot(camera_position_ - face.corners[0]);
    if (face.two_sided ? std::abs(facing) < 1e-9 : facing < 1e-9) return;
    Polygon polygon;
    polygon.n = face.count;
    bool near = false, wide = false;
    int outside[4] = {0, 0, 0, 0};
    for (int i = 0; i < face.count; ++i) {
      polygon.p[i] = R_ * face.corners[i] + t_;
      near |= polygon.p[i][2] < kNear_m;
      for (int k = 0; k < 4; ++k) outside[k] += frustum_.sides[k].dot(polygon.p[i]) < 0;
    }
    for (int k = 0; k < 4; ++k) {
      if (outside[k] == face.count) return;
    }
    if (near) clip(polygon, Eigen::Vector3d::UnitZ(), kNear_m);
    if (polygon.n < 3) return;
    for (int i = 0; i < polygon.n; ++i) {
      const Eigen::Vector3d& p = polygon.p[i];
      wide |= std::abs(p[0]) * camera_.fx > kGuard_px * p[2] ||
              std::abs(p[1]) * camera_.fy > kGuard_px * p[2];
    }
    if (wide) {
      const double x = kGuard_px / camera_.fx, y = kGuard_px / camera_.fy;
      clip(polygon, {1, 0, x}, 0);
      clip(polygon, {-1, 0, x}, 0);
      clip(polygon, {0, 1, y}, 0);
      clip(polygon, {0, -1, y}, 0);
      if (polygon.n < 3) return;
    }
    SeenFace seen;
    seen.face = &face;
    seen.object = object;
    if (!to_pixels(polygon, seen)) return;
    set_coefficients(face, seen);
    out_.push_back(seen);
  }

  bool to_pixels(const Polygon& polygon, SeenFace& seen) const {
    std::int64_t x_min = INT64_MAX, x_max = INT64_MIN;
    seen.y_min = INT64_MAX;
    seen.y_max = INT64_MIN;
    seen.corners = polygon.n;
    for (int i = 0; i < polygon.n; ++i) {
      const Eigen::Vector3d& p = polygon.p[i];
      const double u = camera_.fx * p[0] / p[2] + camera_.cx,
                   v = camera_.fy * p[1] / p[2] + camera_.cy;
      seen.x[i] = static_cast<std::int32_t>(std::floor(u * 256 + 0.5));
      seen.y[i] = static_cast<std::int32_t>(std::floor(v * 256 + 0.5));
      x_min = std::min<std::int64_t>(x_min, seen.x[i]);
      x_max = std::max<std::int64_t>(x_max, seen.x[i]);
      seen.y_min = std::min<std::int64_t>(seen.y_min, seen.y[i]);
      seen.y_max = std::max<std::int64_t>(seen.y_max, seen.y[i]);
    }
    return x_max > -128 && x_min < camera_.width * 256 && seen.y_max > -128 &&
           seen.y_min < camera_.height * 256 && seen.y_max > seen.y_min && x_max > x_min;
  }

  /// a . r as an affine function of the pixel, r = ((u - cx)/fx, (v - cy)/fy, 1).
  std::array<double, 3> affine(const Eigen::Vector3d& a) const {
    const double du = a[0] / camera_.fx, dv = a[1] / camera_.fy;
    return {a[2] - du * camera_.cx - dv * camera_.cy, du, dv};
  }

  void set_coefficients(const Face& face, SeenFace& seen) const {
    const Eigen::Vector3d normal = R_ * face.normal;
    const double distance = face.normal.dot(face.corners[0] - camera_position_);
    seen.iz = affine(normal / distance);
    seen.qs = affine(R_ * face.s_axis);
    seen.qt = affine(R_ * face.t_axis);
    seen.s0 = face.s_axis.dot(camera_position_ - face.origin);
    seen.t0 = face.t_axis.dot(camera_position_ - face.origin);
  }

  const Camera& camera_;
  Frustum frustum_;
  std::vector<SeenFace>& out_;
  Eigen::Matrix3d R_;
  Eigen::Vector3d t_, camera_position_;
};

}  // namespace

std::vector<SeenFace> gather_faces(const Scene& scene, const View& view) {
  std::vector<SeenFace> faces;
  faces.reserve(16384);
  Gatherer gatherer(view, faces);
  const SE3 T_cam_scene = view.T_scene_cam.inverse();
  for (const Part& part : scene.parts) gatherer.add_part(part, T_cam_scene, -1);
  for (std::size_t i = 0; i < scene.movers.size(); ++i) {
    if (const auto T_scene_object = scene.movers[i].T_scene_object(view.time_s))
      gatherer.add_part(scene.movers[i].part, T_cam_scene * *T_scene_object, static_cast<int>(i));
  }
  return faces;
}

SampleBand::SampleBand(int width, int rows)
    : width_(width),
      rows_(rows),
      stride_((width + 7) / 8 * 8),
      iz_(static_cast<std::size_t>(kSamples) * rows * stride_),
      ids_(iz_.size()) {}

void SampleBand::rasterize(const std::vector<SeenFace>& faces, int first, int rows) {
  std::fill(iz_.begin(), iz_.end(), 0.0F);
  std::fill(ids_.begin(), ids_.end(), -1);
  const std::int64_t top = first * std::int64_t{256} - 128,
                     bottom = (first + rows) * std::int64_t{256};
  for (std::size_t i = 0; i < faces.size(); ++i) {
    if (faces[i].y_max >= top && faces[i].y_min <= bottom)
      draw(faces[i], static_cast<std::int32_t>(i), first, rows);
  }
}

void SampleBand::draw(const SeenFace& face, std::int32_t id, int first, int rows) {
  struct Edge {
    std::int64_t x, y, y_end, slope;  // slope in 2^-32; from the upper end, whichever face asks
  };
  std::array<Edge, kMaxCorners> edges;
  int n = 0;
  for (int i = 0; i < face.corners; ++i) {
    const int j = (i + 1) % face.corners;
    if (face.y[i] == face.y[j]) continue;
    const int a = face.y[i] < face.y[j] ? i : j, b = a == i ? j : i;
    edges[n++] = {face.x[a], face.y[a], face.y[b],
                  (std::int64_t{face.x[b]} - face.x[a]) * (std::int64_t{1} << 32) /
                      (std::int64_t{face.y[b]} - face.y[a])};
  }
  for (int k = 0; k < kSamples; ++k) {
    const std::int64_t dx = kOffsets[k][0], dy = kOffsets[k][1];
    const auto row_of = [&](std::int64_t y) { return static_cast<int>((y - dy + 255) >> 8); };
    const int row_begin = std::max(first, row_of(face.y_min)),
              row_end = std::min(first + rows, row_of(face.y_max));
    for (int row = row_begin; row < row_end; ++row) {
      const std::int64_t y = row * std::int64_t{256} + dy;
      std::int64_t left = INT64_MAX, right = INT64_MIN;
      for (int e = 0; e < n; ++e) {
        if (y < edges[e].y || y >= edges[e].y_end) continue;
        const std::int64_t x = edges[e].x + ((edges[e].slope * (y - edges[e].y)) >> 32);
        left = std::min(left, x);
        right = std::max(right, x);
      }
      if (left >= right) continue;
      const int begin = static_cast<int>(std::max<std::int64_t>(0, (left - dx + 255) >> 8));
      const int end = static_cast<int>(std::min<std::int64_t>(width_, (right - dx + 255) >> 8));
      if (begin >= end) continue;
      const double u = begin + dx / 256.0, v = row + dy / 256.0;
      const float base = static_cast<float>(face.iz[0] + face.iz[1] * u + face.iz[2] * v),
                  step = static_cast<float>(face.iz[1]);
      const std::size_t at =
          (static_cast<std::size_t>(k) * rows_ + (row - first)) * stride_ + begin;
      float* iz = &iz_[at];
      std::int32_t* ids = &ids_[at];
      const int count = end - begin;
      for (int i = 0; i < count; ++i) {
        const float value = base + step * static_cast<float>(i);
        const bool nearer = value > iz[i];
        iz[i] = nearer ? value : iz[i];
        ids[i] = nearer ? id : ids[i];
      }
    }
  }
}

}  // namespace placegraph::synthetic
