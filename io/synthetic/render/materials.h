#pragma once
#include <placegraph/io/synthetic/render/hash_noise.h>
#include <placegraph/io/synthetic/render/world.h>

namespace placegraph::synthetic {

/// The spot of a surface in one pixel: its centre in surface coordinates [m] and the parallelogram
/// that the pixel covers there. Every material is band-limited by it.
struct Spot {
  double s = 0, t = 0;
  float su = 0, tu = 0, sv = 0, tv = 0;  ///< derivatives by pixel column and row [m/px]

  void finish();                   ///< computes the members below
  float ws = 0, wt = 0;            ///< width of the bounding box [m]
  float major_s = 0, major_t = 0;  ///< the longer side of the parallelogram [m]
  float major = 0, minor = 0;      ///< its length, and the width across it [m]
};

/// Noise of one octave in [-1, 1] with the given wavelength [m], averaged along the spot's longer
/// side by up to four samples and faded out before its wavelength falls below two pixels.
float octave(const Spot& spot, float wavelength, std::uint32_t seed);

/// Octaves with wavelengths longest, longest/2, ... down to shortest, each `gain` times the former.
float fractal(const Spot& spot, float longest, float shortest, float gain, std::uint32_t seed);

/// Grey value in [0, ~1] of `face` at `spot` in full daylight (or room light). `contrast` scales
/// every texture about its mean.
float shade(const Scene& scene, const Face& face, const Spot& spot, float contrast);

/// Grey value of the sky and the far hills in this direction, at infinite distance (scene frame,
/// any length).
float shade_sky(const Eigen::Vector3d& direction, double pixel_angle, std::uint32_t seed);

// One file each: ground_materials, building_materials, object_materials, indoor_materials,
// marker_materials.
float shade_road(const Scene& scene, const Face& face, const Spot& spot, float contrast);
float shade_roadside(const Scene& scene, const Face& face, const Spot& spot, float contrast);
float shade_terrain(const Face& face, const Spot& spot, float contrast);
float shade_kerb(const Face& face, const Spot& spot, float contrast);
float shade_facade(const Face& face, const Spot& spot, float contrast);
float shade_roof(const Face& face, const Spot& spot, float contrast);
float shade_masonry(const Face& face, const Spot& spot, float contrast);
float shade_fence(const Face& face, const Spot& spot, float contrast);
float shade_foliage(const Face& face, const Spot& spot, float contrast);
float shade_sign(const Face& face, const Spot& spot, float contrast);
float shade_car(const Face& face, const Spot& spot, float contrast);
float shade_indoor(const Face& face, const Spot& spot, float contrast);
float shade_glyph(const Glyph& glyph, const Face& face, const Spot& spot, float contrast);
float shade_beacon(const Face& face, const Spot& spot);

}  // namespace placegraph::synthetic
