#include <placegraph/io/synthetic/render/materials.h>

namespace placegraph::synthetic {

float shade_foliage(const Face& face, const Spot& spot, float contrast) {
  // Leaves in the sun and holes of shade: a steep curve makes clumps with edges.
  const float leaves = fractal(spot, 0.8F, 0.02F, 1.0F, face.seed);
  const float lit = clamp01(0.45F + 0.50F * leaves);
  return 0.06F + 0.05F * hash_unit(face.seed, 1) + contrast * 0.52F * lit * lit +
         (1 - contrast) * 0.17F;
}

float shade_sign(const Face& face, const Spot& spot, float contrast) {
  // A board with a border and a pattern of its own on a 4 x 4 grid.
  const float s = static_cast<float>(spot.s), t = static_cast<float>(spot.t);
  const float w = face.width, h = face.height;
  const float inner =
      pulse(s, 0.07F * w, 0.93F * w, spot.ws) * pulse(t, 0.07F * h, 0.93F * h, spot.wt);
  const int i = floor_int(s * 4 / w), j = floor_int(t * 4 / h);
  const std::uint32_t k = hash_cell(i, j, face.seed);
  const float x0 = static_cast<float>(i) * 0.25F * w, y0 = static_cast<float>(j) * 0.25F * h;
  const float cell = pulse(s, x0, x0 + 0.25F * w, spot.ws) * pulse(t, y0, y0 + 0.25F * h, spot.wt);
  const float tone = (k & 3U) == 0 ? 0.12F : 0.82F;
  return mix(0.20F, mix(0.80F, tone, cell), inner) +
         contrast * 0.02F * octave(spot, 0.2F, face.seed);
}

float shade_car(const Face& face, const Spot& spot, float contrast) {
  const float paint_hash = face.style;  // one paint for the whole car
  const float paint = paint_hash < 0.45F ? 0.10F + 0.25F * paint_hash
                                         : (paint_hash < 0.75F ? 0.35F + 0.2F * paint_hash : 0.80F);
  const float s = static_cast<float>(spot.s), t = static_cast<float>(spot.t);
  const float ws = spot.ws, wt = spot.wt, w = face.width, h = face.height;
  const float dirt = contrast * 0.04F * fractal(spot, 0.9F, 0.02F, 0.75F, face.seed);
  float value = paint + dirt + 0.10F * clamp01(t / (h + 0.01F)) - 0.05F;
  if (face.material == Material::kGlass) {
    // Dark panes between light pillars, with the world mirrored dimly.
    const float pane =
        pulse(s, 0.07F, 0.5F * w - 0.04F, ws) + pulse(s, 0.5F * w + 0.04F, w - 0.07F, ws);
    const float mirror = 0.10F + contrast * 0.09F * fractal(spot, 0.8F, 0.05F, 0.7F, face.seed);
    return mix(value, mirror, clamp01(pane) * pulse(t, 0.05F, h - 0.05F, wt));
  }
  if (face.material == Material::kCarSide) {
    value -= 0.10F * (pulse(s, 0.5F * w - 0.012F, 0.5F * w + 0.012F, ws) +
                      pulse(s, 0.27F * w - 0.012F, 0.27F * w + 0.012F, ws));
    value -= 0.12F * pulse(t, 0.60F * h, 0.60F * h + 0.03F, wt);  // crease
    const float foot = pulse(t, -1.0F, 0.18F, wt);
    value = mix(value, 0.05F, foot);
    for (const float x : {0.19F * w, 0.80F * w}) {
      const float px = s - x, py = t - 0.31F;
      if (px * px + py * py > 0.5F) continue;
      value = mix(value, 0.05F, disc(px, py, 0.36F, spot.major));
      value = mix(value, 0.50F, disc(px, py, 0.20F, spot.major));
      value = mix(value, 0.15F, disc(px, py, 0.07F, spot.major));
    }
    return value;
  }
  if (face.material == Material::kCarEnd) {
    const float lamps = pulse(s, 0.08F, 0.40F, ws) + pulse(s, w - 0.40F, w - 0.08F, ws);
    value = mix(value, hash_unit(face.seed) < 0.5F ? 0.85F : 0.30F,
                clamp01(lamps) * pulse(t, 0.62F * h, 0.85F * h, wt));
    const float plate =
        pulse(s, 0.5F * w - 0.26F, 0.5F * w + 0.26F, ws) * pulse(t, 0.35F, 0.47F, wt);
    const float letters = periodic_pulse(s, 0.075F, 0, 0.04F, ws) * pulse(t, 0.37F, 0.45F, wt);
    value = mix(value, mix(0.88F, 0.12F, 0.8F * letters), plate);
    return mix(value, 0.05F, pulse(t, -1.0F, 0.22F, wt));
  }
  return value;
}

}  // namespace placegraph::synthetic
