#include <placegraph/io/synthetic/render/materials.h>

namespace placegraph::synthetic {

void Spot::finish() {
  ws = std::abs(su) + std::abs(sv) + 1e-6F;
  wt = std::abs(tu) + std::abs(tv) + 1e-6F;
  const float u2 = su * su + tu * tu, v2 = sv * sv + tv * tv;
  const float area = std::abs(su * tv - sv * tu);
  major = std::sqrt(u2 > v2 ? u2 : v2) + 1e-6F;
  major_s = u2 > v2 ? su : sv;
  major_t = u2 > v2 ? tu : tv;
  minor = area / major + 1e-6F;
}

float octave(const Spot& spot, float wavelength, std::uint32_t seed) {
  constexpr int kMaxTaps = 4;
  const float inverse = 1 / wavelength;
  const float across = spot.minor * inverse, along = spot.major * inverse;
  // Faded from four to two pixels per wavelength across, and where four samples along do not
  // suffice.
  float fade = 2 - 4 * across;
  if (fade <= 0) return 0;
  if (fade > 1) fade = 1;
  if (along > 1.5F) {
    fade *= 2 - along * (1 / 1.5F);
    if (fade <= 0) return 0;
  }
  const double x = spot.s * inverse, y = spot.t * inverse;
  if (along <= 0.6F) return fade * value_noise(x, y, seed);
  int taps = static_cast<int>(along * 2) + 1;
  if (taps > kMaxTaps) taps = kMaxTaps;
  const float step = 1.0F / static_cast<float>(taps);
  float sum = 0;
  for (int i = 0; i < taps; ++i) {
    const float f = ((static_cast<float>(i) + 0.5F) * step - 0.5F) * inverse;
    sum += value_noise(x + spot.major_s * f, y + spot.major_t * f, seed);
  }
  return fade * sum * step;
}

float fractal(const Spot& spot, float longest, float shortest, float gain, std::uint32_t seed) {
  float sum = 0, amplitude = 1;
  Spot rotated = spot;
  for (float wavelength = longest; wavelength >= 0.99F * shortest; wavelength *= 0.5F) {
    if (spot.minor > 0.5F * wavelength) break;
    sum += amplitude * octave(rotated, wavelength, seed);
    amplitude *= gain;
    seed += 0x68bc21ebU;
    // Each octave is rotated by the angle of the 3-4-5 triangle, which hides the lattice
    // directions.
    const double s = rotated.s, t = rotated.t;
    const float a = rotated.major_s, b = rotated.major_t;
    rotated.s = 0.8 * s - 0.6 * t;
    rotated.t = 0.6 * s + 0.8 * t;
    rotated.major_s = 0.8F * a - 0.6F * b;
    rotated.major_t = 0.6F * a + 0.8F * b;
  }
  return sum;
}

float shade(const Scene& scene, const Face& face, const Spot& spot, float contrast) {
  switch (face.material) {
    case Material::kRoad:
      return face.light * shade_road(scene, face, spot, contrast);
    case Material::kRoadside:
      return face.light * shade_roadside(scene, face, spot, contrast);
    case Material::kTerrain:
      return face.light * shade_terrain(face, spot, contrast);
    case Material::kKerb:
      return face.light * shade_kerb(face, spot, contrast);
    case Material::kFacade:
      return face.light * shade_facade(face, spot, contrast);
    case Material::kRoof:
      return face.light * shade_roof(face, spot, contrast);
    case Material::kMasonry:
      return face.light * shade_masonry(face, spot, contrast);
    case Material::kFence:
      return face.light * shade_fence(face, spot, contrast);
    case Material::kFoliage:
      return face.light * shade_foliage(face, spot, contrast);
    case Material::kSign:
      return face.light * shade_sign(face, spot, contrast);
    case Material::kCarSide:
    case Material::kCarEnd:
    case Material::kCarTop:
    case Material::kGlass:
      return face.light * shade_car(face, spot, contrast);
    case Material::kBark:
      return face.light * (0.20F + contrast * 0.09F * fractal(spot, 0.30F, 0.02F, 0.7F, face.seed));
    case Material::kMetal:
      return face.light * (0.30F + 0.25F * hash_unit(face.seed) +
                           contrast * 0.08F * fractal(spot, 0.60F, 0.03F, 0.6F, face.seed));
    case Material::kShadow:
      return face.light * (0.09F + 0.02F * fractal(spot, 0.30F, 0.03F, 0.7F, face.seed));
    case Material::kConcrete:
      return face.light * (0.55F + contrast * 0.10F * fractal(spot, 1.6F, 0.02F, 0.7F, face.seed));
    case Material::kIndoorWall:
    case Material::kIndoorFloor:
    case Material::kCeiling:
    case Material::kDoor:
    case Material::kShelf:
    case Material::kCarton:
      return face.light * shade_indoor(face, spot, contrast);
    case Material::kGlyph:
      return face.light * shade_glyph(scene.glyphs[face.seed], face, spot, contrast);
    case Material::kBeacon:
      return shade_beacon(face, spot);
  }
  return 0;
}

float shade_sky(const Eigen::Vector3d& direction, double pixel_angle, std::uint32_t seed) {
  const double x = direction[0], z = direction[2];
  const double flat = std::sqrt(x * x + z * z) + 1e-9;
  const double rise = -direction[1] / flat;  // tangent of the elevation
  // A circle measured along a square: monotonic in the azimuth and free of libm. [0, 8)
  const double ax = std::abs(x), az = std::abs(z);
  double azimuth = ax < az ? ax / az : 2 - az / ax;
  if (z < 0) azimuth = 4 - azimuth;
  if (x < 0) azimuth = 8 - azimuth;
  if (azimuth >= 8) azimuth -= 8;
  // Noise that is periodic in the azimuth: blended over the last eighth before the seam.
  const double seam = azimuth > 7 ? azimuth - 7 : 0;
  const auto around = [&](double frequency, double y, std::uint32_t salt) {
    const float value = value_noise(azimuth * frequency, y, seed + salt);
    if (seam <= 0) return value;
    return mix(value, value_noise((azimuth - 8) * frequency, y, seed + salt),
               static_cast<float>(seam));
  };
  const float sky =
      0.86F - 0.25F * clamp01(static_cast<float>(rise * 1.6)) + 0.025F * around(5, rise * 12, 3);
  if (rise > 0.075) return sky;
  const double ridge =
      0.030 + 0.018 * around(3, 0.5, 0) + 0.008 * around(11, 0.5, 1) + 0.004 * around(47, 0.5, 2);
  const float coverage = clamp01(static_cast<float>((ridge - rise) / pixel_angle + 0.5));
  if (coverage <= 0) return sky;
  const float hill = 0.42F + 0.06F * around(60, rise * 160, 4) + 0.05F * around(21, rise * 60, 5);
  return mix(sky, hill, coverage);
}

}  // namespace placegraph::synthetic
