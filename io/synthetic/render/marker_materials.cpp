#include <placegraph/io/synthetic/render/materials.h>

namespace placegraph::synthetic {

/// A marker printed on white paper that is one cell wider on every side; the face's s runs to the
/// right and its t down on the upright marker.
float shade_glyph(const Glyph& glyph, const Face& face, const Spot& spot, float contrast) {
  constexpr float kMiddle = 0.48F, kSwing = 0.40F;
  const float cell = face.width / static_cast<float>(glyph.cells + 2);
  const auto s = static_cast<float>(spot.s), t = static_cast<float>(spot.t);
  const auto index = [&](float at) { return floor_int(at / cell) - 1; };
  const int left = index(s - 0.5F * spot.ws), right = index(s + 0.5F * spot.ws);
  const int top = index(t - 0.5F * spot.wt), bottom = index(t + 0.5F * spot.wt);
  // Sums the black part of the pixel over the cells.
  float black = 0;
  for (int row = top > 0 ? top : 0; row <= bottom && row < glyph.cells; ++row)
    for (int column = left > 0 ? left : 0; column <= right && column < glyph.cells; ++column) {
      if (glyph.white[static_cast<std::size_t>(row * glyph.cells + column)]) continue;
      const float x = cell * static_cast<float>(column + 1), y = cell * static_cast<float>(row + 1);
      black += pulse(s, x, x + cell, spot.ws) * pulse(t, y, y + cell, spot.wt);
    }
  return kMiddle + contrast * kSwing * (1 - 2 * black);
}

/// A lamp in a dark housing; it saturates the camera.
float shade_beacon(const Face& face, const Spot& spot) {
  constexpr float kHousing = 0.06F, kLamp = 1.6F,
                  kRadius = 0.25F;  // the radius is a share of the housing's width
  const auto s = static_cast<float>(spot.s), t = static_cast<float>(spot.t);
  const float w = face.width;
  return mix(kHousing, kLamp, disc(s - 0.5F * w, t - 0.5F * w, kRadius * w, spot.major));
}

}  // namespace placegraph::synthetic
