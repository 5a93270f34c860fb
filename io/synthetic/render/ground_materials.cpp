#include <placegraph/io/synthetic/render/materials.h>
#include <placegraph/io/synthetic/render/road_field.h>

namespace placegraph::synthetic {
namespace {

// Ground faces have world x as s and world z as t, so that textures continue across faces.

/// A line of width `w` where noise crosses zero; it fades out below the pixel size.
float crack(const Spot& spot, float wavelength, float width, std::uint32_t seed) {
  const float reach = spot.major * 0.7F;
  if (reach > wavelength * 0.4F) return 0;
  const double s = spot.s / wavelength, t = spot.t / wavelength;
  // The value changes by about 2 a wavelength: |value| / 2 * wavelength estimates the distance.
  constexpr float kWiggle = 0.35F;
  const float blur = width + reach, scale = 0.40F * wavelength;
  const float broad = value_noise(s, t, seed);
  if ((std::abs(broad) - kWiggle) * scale >= blur) return 0;
  const float distance =
      scale * std::abs(broad + kWiggle * value_noise(s * 4.1, t * 4.1, seed + 1));
  return clamp01(1 - distance / blur) * (width / blur);
}

/// Rectangular repairs, tar edged, at most one in a cell of the plane.
float repairs(const Spot& spot, float base, std::uint32_t seed) {
  constexpr float kCell = 5.0F;
  const int cx = floor_int(spot.s / kCell), cz = floor_int(spot.t / kCell);
  const std::uint32_t h = hash_cell(cx, cz, seed);
  if (hash_unit(h) > 0.55F) return base;
  const float x = static_cast<float>(spot.s - cx * static_cast<double>(kCell));
  const float z = static_cast<float>(spot.t - cz * static_cast<double>(kCell));
  const float x0 = 0.3F + 1.8F * hash_unit(h, 1), x1 = x0 + 0.6F + 1.8F * hash_unit(h, 2);
  const float z0 = 0.3F + 1.8F * hash_unit(h, 3), z1 = z0 + 0.6F + 1.8F * hash_unit(h, 4);
  const float tone = (hash_unit(h, 5) - 0.6F) * 0.14F;
  const float inside = pulse(x, x0, x1, spot.ws) * pulse(z, z0, z1, spot.wt);
  const float border =
      pulse(x, x0 - 0.04F, x1 + 0.04F, spot.ws) * pulse(z, z0 - 0.04F, z1 + 0.04F, spot.wt);
  return base + tone * inside - 0.13F * (border - inside);
}

/// Manhole and gully covers: dark rings with a bright rim.
float covers(const Spot& spot, float base, std::uint32_t seed) {
  constexpr float kCell = 11.0F;
  const int cx = floor_int(spot.s / kCell), cz = floor_int(spot.t / kCell);
  const std::uint32_t h = hash_cell(cx, cz, seed);
  if (hash_unit(h) > 0.8F) return base;
  const float x = static_cast<float>(spot.s - (cx + 0.1 + 0.8 * hash_unit(h, 1)) * kCell);
  const float z = static_cast<float>(spot.t - (cz + 0.1 + 0.8 * hash_unit(h, 2)) * kCell);
  if (x * x + z * z > 4) return base;
  const float w = spot.major;
  const float outer = disc(x, z, 0.40F, w), inner = disc(x, z, 0.32F, w);
  const float ribs =
      periodic_pulse(x, 0.09F, 0, 0.045F, spot.ws) * periodic_pulse(z, 0.09F, 0, 0.045F, spot.wt);
  const float lid = 0.16F + 0.30F * ribs;
  return mix(base, mix(0.42F, lid, inner), outer);
}

/// Light and dark blotches like the shadows of trees and houses; soft edged, metres wide.
float shadow(const Spot& spot, std::uint32_t seed) {
  constexpr float kBegin = 0.28F, kFull = 0.48F, kDepth = 0.55F, kFine = 0.25F;
  const float broad = octave(spot, 14.0F, seed) + 0.6F * octave(spot, 4.5F, seed + 1);
  // The finest octave matters only near a blotch's edge.
  if (broad + kFine <= kBegin) return 1;
  if (broad - kFine >= kFull) return 1 - kDepth;
  const float n = broad + kFine * octave(spot, 1.1F, seed + 2);
  return 1 - kDepth * clamp01((n - kBegin) / (kFull - kBegin));
}

float lane_marks(const RoadField::Sample& at, const Spot& spot, float base, float wear) {
  if (!at.marked) return base;
  const std::uint32_t h = mix_bits(at.road * 77U + 5U);
  // The field's axes rotate with the road: the spot's width across and along is bounded by its box.
  const float w = spot.minor > 0.02F ? spot.minor : 0.02F;
  const float side = std::abs(at.lateral);
  float paint = 0;
  const float dash = periodic_pulse(at.along, 6.0F, 0.0F, 2.5F, spot.major);
  if (hash_unit(h, 1) < 0.85F) paint = pulse(at.lateral, -0.07F, 0.07F, w) * dash;
  if (hash_unit(h, 2) < 0.75F)
    paint += pulse(side, at.half_width - 0.42F, at.half_width - 0.30F, w);
  return mix(base, 0.72F, clamp01(paint) * wear);
}

}  // namespace

float shade_road(const Scene& scene, const Face& face, const Spot& spot, float contrast) {
  const std::uint32_t seed = face.seed;
  const RoadField::Sample at =
      scene.road ? scene.road->sample(spot.s, spot.t) : RoadField::Sample{};
  const float broad = fractal(spot, 4.5F, 1.1F, 0.75F, seed);
  const float grain = fractal(spot, 0.25F, 0.0075F, 1.0F, seed + 11);
  float value = 0.36F + contrast * (0.030F * broad + 0.062F * grain);
  value = repairs(spot, value, seed + 21);
  value -= contrast * 0.30F * crack(spot, 2.7F, 0.030F, seed + 31);
  // Cracked stretches alternate with whole ones.
  const float bad = octave(spot, 23.0F, seed + 35);
  if (bad > 0.1F)
    value -= contrast * 0.30F * clamp01(bad * 3) * crack(spot, 0.9F, 0.022F, seed + 33);
  if (at.marked) {
    const float seam = 1.9F + 0.25F * value_noise(at.along * 0.13, 0.5, seed + 41);
    const float w = spot.minor > 0.03F ? spot.minor : 0.03F;
    value -= contrast * 0.14F * pulse(at.lateral, seam, seam + 0.05F, w);
  }
  value = lane_marks(at, spot, value, clamp01(0.75F + 0.5F * grain));
  value = covers(spot, value, seed + 51);
  // Gutter: dirt gathers at the edge.
  value *= 1 - 0.35F * clamp01(1 + at.edge * 2.5F);
  return value * shadow(spot, seed + 61);
}

float shade_roadside(const Scene& scene, const Face& face, const Spot& spot, float contrast) {
  const std::uint32_t seed = face.seed;
  const float edge = scene.road ? scene.road->edge_distance(spot.s, spot.t) : 5.0F;
  const float blur = spot.major > 0.02F ? spot.major : 0.02F;
  const float grain = fractal(spot, 1.3F, 0.02F, 0.90F, seed + 3);
  // Slabs: joints every 50 cm, each slab of its own tone.
  const float joint = 1 - (1 - periodic_pulse(spot.s, 0.5F, 0.0F, 0.02F, spot.ws)) *
                              (1 - periodic_pulse(spot.t, 0.5F, 0.0F, 0.02F, spot.wt));
  const std::uint32_t h = hash_cell(floor_int(spot.s * 2), floor_int(spot.t * 2), seed);
  const float own = (hash_unit(h) - 0.5F) * clamp01(1.5F - 3.0F * spot.major);
  float paving = 0.50F + contrast * (0.12F * own + 0.045F * grain - 0.20F * joint);
  const float kerbstone = 0.64F + contrast * 0.05F * grain;
  paving = mix(paving, kerbstone, clamp01((0.17F - edge) / blur + 0.5F));
  const float lawn = 0.25F + contrast * 0.10F * (grain + octave(spot, 3.1F, seed + 7));
  const float border = 2.45F + 0.12F * value_noise(spot.s * 0.8, spot.t * 0.8, seed + 5);
  return mix(paving, lawn, clamp01((edge - border) / blur + 0.5F)) * shadow(spot, seed + 61);
}

float shade_terrain(const Face& face, const Spot& spot, float contrast) {
  const float grain = fractal(spot, 12.0F, 0.03F, 0.80F, face.seed);
  return 0.27F + contrast * 0.06F * grain;
}

float shade_kerb(const Face& face, const Spot& spot, float contrast) {
  const float joint = periodic_pulse(spot.s, 1.0F, 0.0F, 0.03F, spot.ws);
  return 0.42F + contrast * (0.08F * fractal(spot, 0.6F, 0.02F, 0.8F, face.seed) - 0.25F * joint);
}

}  // namespace placegraph::synthetic
