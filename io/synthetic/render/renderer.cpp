#include <placegraph/graph/core/parallel.h>
#include <placegraph/io/synthetic/render/materials.h>
#include <placegraph/io/synthetic/render/renderer.h>

#include <limits>

namespace placegraph::synthetic {
namespace {

constexpr int kBandRows = 16;
constexpr double kHaze_m = 2500;  ///< distance at which half the light comes from the air
constexpr float kAir = 0.72F;

class BandShader {
 public:
  BandShader(const Scene& scene, const View& view, float contrast, Rendering& out)
      : scene_(scene), view_(view), contrast_(contrast), out_(out) {
    R_ = view.T_scene_cam.rotation().matrix();
  }

  void shade_row(const SampleBand& band, int row_in_band, int row, bool maps) const {
    auto* grey = out_.grey.ptr<float>(row);
    auto* iz = out_.inverse_depth.ptr<float>(row);
    auto* mover = out_.mover.ptr<short>(row);
    for (int u = 0; u < view_.camera.width; ++u) {
      const std::int32_t centre = band.face(0, row_in_band, u);
      grey[u] = pixel(band, row_in_band, row, u, centre);
      iz[u] = 0;
      mover[u] = -1;
      if (centre >= 0) {
        const SeenFace& seen = out_.faces[centre];
        iz[u] = static_cast<float>(seen.iz[0] + seen.iz[1] * u + seen.iz[2] * row);
        mover[u] = static_cast<short>(seen.object);
      }
      if (maps) {
        const Face* face = centre >= 0 ? out_.faces[centre].face : nullptr;
        out_.labels.at<unsigned char>(row, u) =
            static_cast<unsigned char>(face ? face->label : SurfaceClass::kSky);
        out_.planes.at<unsigned short>(row, u) =
            static_cast<unsigned short>(face ? face->plane : 0);
      }
    }
  }

 private:
  bool same_surface(std::int32_t a, std::int32_t b) const {
    if (a == b) return true;
    if (a < 0 || b < 0) return false;
    const Face &fa = *out_.faces[a].face, &fb = *out_.faces[b].face;
    return fa.material == fb.material && fa.seed == fb.seed;
  }

  float pixel(const SampleBand& band, int row_in_band, int row, int u, std::int32_t centre) const {
    constexpr int kN = SampleBand::kSamples;
    std::int32_t ids[kN];
    bool uniform = true;
    for (int k = 0; k < kN; ++k) {
      ids[k] = band.face(k, row_in_band, u);
      uniform = uniform && same_surface(ids[k], centre);
    }
    if (uniform) return surface(centre, u, row);
    // Each surface is shaded once, at the mean of its samples, weighted by their number.
    float sum = 0;
    bool done[kN] = {};
    for (int k = 0; k < kN; ++k) {
      if (done[k]) continue;
      int count = 0, du = 0, dv = 0;
      for (int j = k; j < kN; ++j) {
        if (done[j] || !same_surface(ids[j], ids[k])) continue;
        done[j] = true;
        ++count;
        du += SampleBand::kOffsets[j][0];
        dv += SampleBand::kOffsets[j][1];
      }
      sum += static_cast<float>(count) *
             surface(ids[k], u + du / (256.0 * count), row + dv / (256.0 * count));
    }
    return sum / kN;
  }

  float surface(std::int32_t id, double u, double v) const {
    const Camera& camera = view_.camera;
    if (id < 0) {
      if (!scene_.outdoor) return 0;
      const Eigen::Vector3d ray((u - camera.cx) / camera.fx, (v - camera.cy) / camera.fy, 1);
      return shade_sky(R_ * ray, 1 / camera.fx, scene_.seed);
    }
    const SeenFace& f = out_.faces[id];
    double iz = f.iz[0] + f.iz[1] * u + f.iz[2] * v;
    if (iz < 1e-4) iz = 1e-4;  // a sample beyond the face's horizon, at its very edge
    const double z = 1 / iz;
    const double s = z * (f.qs[0] + f.qs[1] * u + f.qs[2] * v),
                 t = z * (f.qt[0] + f.qt[1] * u + f.qt[2] * v);
    Spot spot;
    spot.s = f.s0 + s;
    spot.t = f.t0 + t;
    spot.su = static_cast<float>(z * (f.qs[1] - s * f.iz[1]));
    spot.sv = static_cast<float>(z * (f.qs[2] - s * f.iz[2]));
    spot.tu = static_cast<float>(z * (f.qt[1] - t * f.iz[1]));
    spot.tv = static_cast<float>(z * (f.qt[2] - t * f.iz[2]));
    spot.finish();
    const float value = shade(scene_, *f.face, spot, contrast_);
    return scene_.outdoor ? mix(value, kAir, static_cast<float>(z / (z + kHaze_m))) : value;
  }

  const Scene& scene_;
  const View& view_;
  float contrast_;
  Rendering& out_;
  Eigen::Matrix3d R_;
};

/// Maps a point of this camera at this moment to the other camera at the other moment.
AffineMap point_map(const SE3& T_other_cur) {
  return {T_other_cur.rotation().matrix(), T_other_cur.translation()};
}

}  // namespace

Rendering render(const Scene& scene, const View& view, float contrast, bool maps, int threads) {
  const int width = view.camera.width, height = view.camera.height;
  Rendering out;
  out.faces = gather_faces(scene, view);
  out.grey.create(height, width, CV_32FC1);
  out.inverse_depth.create(height, width, CV_32FC1);
  out.mover.create(height, width, CV_16SC1);
  if (maps) {
    out.labels.create(height, width, CV_8UC1);
    out.planes.create(height, width, CV_16UC1);
  }
  const BandShader shader(scene, view, contrast, out);
  const int bands = (height + kBandRows - 1) / kBandRows;
  const auto render_bands = [&](int first, int step) {
    SampleBand band(width, kBandRows);
    for (int b = first; b < bands; b += step) {
      check_interruption();
      const int top = b * kBandRows, rows = std::min(kBandRows, height - top);
      band.rasterize(out.faces, top, rows);
      for (int r = 0; r < rows; ++r) shader.shade_row(band, r, top + r, maps);
    }
  };
  const int lanes = std::max(1, std::min(threads, bands));
  parallel_for(lanes, lanes, [&](int lane) { render_bands(lane, lanes); });
  return out;
}

Image depth_image(const Rendering& rendering) {
  Image depth(rendering.inverse_depth.size(), CV_32FC1);
  for (int v = 0; v < depth.rows; ++v) {
    const auto* iz = rendering.inverse_depth.ptr<float>(v);
    auto* z = depth.ptr<float>(v);
    for (int u = 0; u < depth.cols; ++u) z[u] = iz[u] > 0 ? 1 / iz[u] : 0;
  }
  return depth;
}

Image flow_image(const Scene& scene, const Rendering& rendering, const View& view,
                 const View& next) {
  const Camera& camera = view.camera;
  const SE3 T_next_scene = next.T_scene_cam.inverse();
  std::vector<AffineMap> maps{point_map(T_next_scene * view.T_scene_cam)};
  std::vector<bool> known{true};
  for (const MovingObject& mover : scene.movers) {
    const auto now = mover.T_scene_object(view.time_s), then = mover.T_scene_object(next.time_s);
    known.push_back(now && then);
    maps.push_back(known.back()
                       ? point_map(T_next_scene * *then * now->inverse() * view.T_scene_cam)
                       : AffineMap{});
  }
  constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  Image flow(camera.height, camera.width, CV_32FC2, cv::Scalar::all(kUnknown));
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      const int object = rendering.mover.at<short>(v, u) + 1;
      if (!known[object]) continue;
      const double iz = rendering.inverse_depth.at<float>(v, u);
      const Eigen::Vector3d ray((u - camera.cx) / camera.fx, (v - camera.cy) / camera.fy, 1);
      // The point is scaled by 1/z, which also works for points at infinity.
      const Eigen::Vector3d p = maps[object].linear * ray + maps[object].offset * iz;
      if (p[2] < 1e-3) continue;
      flow.at<cv::Vec2f>(v, u) =
          cv::Vec2f(static_cast<float>(camera.fx * p[0] / p[2] + camera.cx - u),
                    static_cast<float>(camera.fy * p[1] / p[2] + camera.cy - v));
    }
  }
  return flow;
}

}  // namespace placegraph::synthetic
