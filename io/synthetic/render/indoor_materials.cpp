#include <placegraph/io/synthetic/render/materials.h>

#include <algorithm>

namespace placegraph::synthetic {
namespace {

/// A picture, notice board or poster in some cells along the wall, each of its own design.
float pictures(const Face& face, const Spot& spot, float base) {
  constexpr float kCell = 1.6F;
  const int cell = floor_int(spot.s / kCell);
  const std::uint32_t h = hash_cell(cell, 3, face.seed);
  if (hash_unit(h) > 0.7F) return base;
  const float x = static_cast<float>(spot.s - cell * static_cast<double>(kCell));
  const float y = static_cast<float>(spot.t);
  const float w = 0.35F + 0.75F * hash_unit(h, 1), high = 0.3F + 0.6F * hash_unit(h, 2);
  const float x0 = 0.1F + (kCell - 0.2F - w) * hash_unit(h, 3), y0 = 1.05F + 0.4F * hash_unit(h, 4);
  // Only whole pictures are drawn: this piece of the wall may end at a door or begin above one.
  const auto along = [&](int i) { return face.s_axis.dot(face.corners[i] - face.origin); };
  const double from = cell * static_cast<double>(kCell) + x0, a = along(0), b = along(1);
  if (from < std::min(a, b) + 0.05 || from + w > std::max(a, b) - 0.05) return base;
  if (face.t_axis.dot(face.corners[0] - face.origin) > 0.5) return base;
  const float frame = pulse(x, x0, x0 + w, spot.ws) * pulse(y, y0, y0 + high, spot.wt);
  constexpr float kFrame = 0.03F;
  const float inner = pulse(x, x0 + kFrame, x0 + w - kFrame, spot.ws) *
                      pulse(y, y0 + kFrame, y0 + high - kFrame, spot.wt);
  const int n = 3 + static_cast<int>(hash_unit(h, 5) * 4);
  const int i = floor_int((x - x0) * static_cast<float>(n) / w),
            j = floor_int((y - y0) * static_cast<float>(n) / high);
  const float cw = w / static_cast<float>(n), ch = high / static_cast<float>(n);
  const float cx = x0 + static_cast<float>(i) * cw, cy = y0 + static_cast<float>(j) * ch;
  const float inside = pulse(x, cx, cx + cw, spot.ws) * pulse(y, cy, cy + ch, spot.wt);
  const float tone = 0.12F + 0.75F * hash_unit(hash_cell(i, j, h));
  float print = mix(0.55F, tone, inside) + 0.12F * fractal(spot, 0.12F, 0.01F, 0.8F, h);
  return mix(mix(base, 0.15F + 0.5F * hash_unit(h, 6), frame), print, inner);
}

float wall(const Face& face, const Spot& spot, float contrast) {
  const float s = static_cast<float>(spot.s), t = static_cast<float>(spot.t);
  const float grain = fractal(spot, 1.5F, 0.008F, 0.75F, face.seed);
  float value = 0.52F + 0.22F * hash_unit(static_cast<std::uint32_t>(face.style * 65536.0F) + 1U) +
                contrast * 0.05F * grain;
  if (face.style > 0.5F) {  // a painted lower half
    value = mix(value, value * 0.65F, pulse(t, -1, 1.0F, spot.wt));
  }
  value = mix(value, 0.22F, pulse(t, -1, 0.10F, spot.wt));  // skirting
  value = pictures(face, spot, value);
  // Sockets and switches.
  const int cell = floor_int(s / 2.3F);
  const std::uint32_t h = hash_cell(cell, 9, face.seed);
  if (hash_unit(h) < 0.6F) {
    const float x = s - (static_cast<float>(cell) + 0.2F + 0.6F * hash_unit(h, 1)) * 2.3F;
    const float y = t - (hash_unit(h, 2) < 0.5F ? 0.30F : 1.10F);
    value = mix(value, 0.92F, pulse(x, -0.05F, 0.05F, spot.ws) * pulse(y, -0.05F, 0.05F, spot.wt));
    value = mix(value, 0.12F, disc(x, y, 0.022F, spot.major));
  }
  return value;
}

float floor_surface(const Face& face, const Spot& spot, float contrast) {
  const float grain = fractal(spot, 2.0F, 0.008F, 0.78F, face.seed);
  if (face.style < 0.33F) {  // tiles
    const std::uint32_t h = hash_cell(floor_int(spot.s / 0.4), floor_int(spot.t / 0.4), face.seed);
    const float joint = 1 - (1 - periodic_pulse(spot.s, 0.4F, 0, 0.012F, spot.ws)) *
                                (1 - periodic_pulse(spot.t, 0.4F, 0, 0.012F, spot.wt));
    const float near = clamp01(1.5F - 4.0F * spot.major);
    return 0.48F + contrast * (0.16F * near * (hash_unit(h) - 0.5F) + 0.04F * grain) - 0.2F * joint;
  }
  if (face.style < 0.66F) {  // boards
    const int row = floor_int(spot.t / 0.14);
    const double s = spot.s + 1.7 * hash_unit(hash_cell(row, 0, face.seed));
    const std::uint32_t h = hash_cell(floor_int(s / 1.9), row, face.seed);
    const float joint = clamp01(periodic_pulse(spot.t, 0.14F, 0, 0.008F, spot.wt) +
                                periodic_pulse(s, 1.9F, 0, 0.008F, spot.ws));
    const float near = clamp01(1.5F - 10.0F * spot.wt);
    Spot stretched = spot;
    stretched.s *= 0.15;
    stretched.major_s *= 0.15F;
    const float vein = fractal(stretched, 0.10F, 0.01F, 0.8F, h);
    return 0.40F +
           contrast * (0.14F * near * (hash_unit(h) - 0.5F) + 0.03F * near * vein + 0.03F * grain) -
           0.18F * joint;
  }
  const float speck = fractal(spot, 0.12F, 0.008F, 0.9F, face.seed + 3);  // worn concrete
  float value = 0.42F + contrast * (0.055F * grain + 0.05F * speck);
  const float joint = clamp01(periodic_pulse(spot.s, 3.0F, 0, 0.02F, spot.ws) +
                              periodic_pulse(spot.t, 3.0F, 0, 0.02F, spot.wt));
  return value - 0.2F * joint;
}

float ceiling(const Face& face, const Spot& spot, float contrast) {
  const float grid = 1 - (1 - periodic_pulse(spot.s, 0.6F, 0, 0.025F, spot.ws)) *
                             (1 - periodic_pulse(spot.t, 0.6F, 0, 0.025F, spot.wt));
  const int i = floor_int(spot.s / 0.6), j = floor_int(spot.t / 0.6);
  const std::uint32_t h = hash_cell(i, j, face.seed);
  const float near = clamp01(1.5F - 2.0F * spot.major);
  float value = 0.66F + contrast * 0.06F * fractal(spot, 0.5F, 0.01F, 0.85F, face.seed);
  value += contrast * 0.08F * near * (hash_unit(h) - 0.5F);
  const float x = static_cast<float>(spot.s - i * 0.6), y = static_cast<float>(spot.t - j * 0.6);
  if (hash_unit(h, 1) < 0.10F) {  // a lamp
    value = mix(value, 1.0F, pulse(x, 0.05F, 0.55F, spot.ws) * pulse(y, 0.05F, 0.55F, spot.wt));
  } else if (hash_unit(h, 1) < 0.16F) {  // an air outlet
    const float slots = periodic_pulse(x, 0.08F, 0, 0.04F, spot.ws);
    value = mix(value, mix(0.6F, 0.15F, slots),
                pulse(x, 0.08F, 0.52F, spot.ws) * pulse(y, 0.08F, 0.52F, spot.wt));
  }
  return value - 0.25F * grid;
}

float door_leaf(const Face& face, const Spot& spot, float contrast) {
  const float s = static_cast<float>(spot.s), t = static_cast<float>(spot.t), w = face.width;
  float value = 0.22F + 0.5F * hash_unit(face.seed) +
                contrast * 0.05F * fractal(spot, 0.6F, 0.01F, 0.8F, face.seed);
  const float frame =
      1 - pulse(s, 0.07F, w - 0.07F, spot.ws) * pulse(t, -1, face.height - 0.07F, spot.wt);
  const float plate = pulse(s, 0.3F, 0.7F, spot.ws) * pulse(t, 1.5F, 1.7F, spot.wt);
  const int i = floor_int((s - 0.3F) * 20);
  const float letter = hash_unit(hash_cell(i, 0, face.seed)) < 0.5F ? 0.1F : 0.9F;
  value = mix(value, 0.9F, plate);
  value = mix(value, letter, plate * pulse(t, 1.55F, 1.65F, spot.wt));
  value = mix(value, 0.85F, disc(s - (w - 0.17F), t - 1.05F, 0.045F, spot.major));
  if (hash_unit(face.seed, 2) < 0.4F)
    value = mix(value, 0.08F, pulse(s, 0.3F, w - 0.3F, spot.ws) * pulse(t, 1.1F, 1.4F, spot.wt));
  return mix(value, 0.80F, clamp01(frame));
}

}  // namespace

float shade_indoor(const Face& face, const Spot& spot, float contrast) {
  switch (face.material) {
    case Material::kIndoorFloor:
      return floor_surface(face, spot, contrast);
    case Material::kCeiling:
      return ceiling(face, spot, contrast);
    case Material::kDoor:
      return door_leaf(face, spot, contrast);
    case Material::kShelf: {  // steel with holes
      const float holes = periodic_pulse(spot.t, 0.1F, 0, 0.03F, spot.wt) *
                          periodic_pulse(spot.s, 0.1F, 0.03F, 0.06F, spot.ws);
      return 0.32F + 0.2F * hash_unit(face.seed) - 0.25F * holes +
             contrast * 0.05F * fractal(spot, 0.8F, 0.01F, 0.8F, face.seed);
    }
    case Material::kCarton: {
      const float s = static_cast<float>(spot.s), t = static_cast<float>(spot.t);
      const float w = face.width, h = face.height;
      float value = 0.34F + 0.3F * hash_unit(face.seed) +
                    contrast * 0.05F * fractal(spot, 0.5F, 0.01F, 0.8F, face.seed);
      value = mix(value, value * 1.35F, pulse(s, 0.46F * w, 0.54F * w, spot.ws));  // tape
      const float x = s - w * (0.1F + 0.4F * hash_unit(face.seed, 1)),
                  y = t - h * (0.15F + 0.4F * hash_unit(face.seed, 2));
      const float label = pulse(x, 0, 0.3F * w, spot.ws) * pulse(y, 0, 0.25F * h, spot.wt);
      const int bar = floor_int(x * 60);
      const float code = hash_unit(hash_cell(bar, 1, face.seed)) < 0.5F ? 0.1F : 0.92F;
      value = mix(value, mix(0.92F, code, clamp01(1.5F - 60 * spot.ws)), label);
      return mix(value, 0.15F,
                 clamp01(1 - pulse(s, 0.012F, w - 0.012F, spot.ws) *
                                 pulse(t, 0.012F, h - 0.012F, spot.wt)));
    }
    default:
      return wall(face, spot, contrast);
  }
}

}  // namespace placegraph::synthetic
