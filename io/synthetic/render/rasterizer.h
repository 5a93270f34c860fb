#pragma once
#include <placegraph/graph/geometry/camera.h>
#include <placegraph/io/synthetic/render/world.h>

#include <cstdint>
#include <vector>

namespace placegraph::synthetic {

/// A face in the image of one camera: everything is affine in the pixel (u, v), so that depth and
/// surface coordinates at a pixel cost a division: 1/z = iz . (1, u, v), s = s0 + z * (qs . (1, u,
/// v)).
struct SeenFace {
  const Face* face = nullptr;
  int object = -1;  ///< index of the mover, -1 = static
  std::array<double, 3> iz, qs, qt;
  double s0 = 0, t0 = 0;
  int corners = 0;                    ///< number of corners of the clipped polygon
  std::array<std::int32_t, 10> x, y;  ///< its corners [1/256 px]
  std::int64_t y_min = 0, y_max = 0;
};

/// The camera pose and the time of one image.
struct View {
  Camera camera;  ///< without distortion
  SE3 T_scene_cam;
  double time_s = 0;
};

/// The faces of `scene` in front of the camera, clipped at 5 cm and at a margin around the image.
/// Movers are placed at view.time_s.
std::vector<SeenFace> gather_faces(const Scene& scene, const View& view);

/// Samples of one band of rows: each pixel is sampled at its centre (sample 0) and at four more
/// points, so that edges are smooth and exact maps are exact at the centre.
class SampleBand {
 public:
  static constexpr int kSamples = 5;
  static constexpr int kOffsets[kSamples][2] = {
      {0, 0}, {-96, 32}, {-32, -96}, {96, -32}, {32, 96}};  ///< [1/256 px]

  SampleBand(int width, int rows);
  /// Resolves visibility for the rows [first, first + rows) by a z-buffer over 1/z. Coverage is
  /// decided in integers: faces that share an edge neither overlap nor leave a gap.
  void rasterize(const std::vector<SeenFace>& faces, int first, int rows);
  /// Index of the visible face, -1 = nothing.
  std::int32_t face(int sample, int row, int column) const {
    return ids_[(static_cast<std::size_t>(sample) * rows_ + row) * stride_ + column];
  }

 private:
  void draw(const SeenFace& face, std::int32_t id, int first, int rows);

  int width_, rows_, stride_;
  std::vector<float> iz_;
  std::vector<std::int32_t> ids_;
};

}  // namespace placegraph::synthetic
