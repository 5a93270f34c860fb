#include <placegraph/io/synthetic/render/materials.h>

namespace placegraph::synthetic {
namespace {

/// Plain wall of a house: plaster, brick, boards or stone blocks by seed.
float wall_surface(const Face& face, const Spot& spot, std::uint32_t wall_seed, float contrast) {
  const float tone = 0.30F + 0.55F * hash_unit(wall_seed, 1);
  const float stains = fractal(spot, 2.8F, 0.02F, 0.88F, face.seed);
  float value = tone + contrast * 0.055F * stains;
  const float kind = hash_unit(wall_seed, 2);
  if (kind < 0.3F) {  // bricks in running bond
    const float course = 0.075F;
    const int row = floor_int(spot.t / course);
    const float joint = periodic_pulse(spot.t, course, 0, 0.012F, spot.wt);
    const float head = periodic_pulse(spot.s + (row & 1) * 0.125, 0.25F, 0, 0.012F, spot.ws);
    const float own =
        hash_unit(hash_cell(floor_int((spot.s + (row & 1) * 0.125) * 4), row, wall_seed));
    const float fade = clamp01(1.6F - 25.0F * spot.wt);
    value = tone * 0.75F + contrast * (0.055F * stains + 0.16F * fade * (own - 0.5F)) +
            0.14F * clamp01(joint + head);
  } else if (kind < 0.45F) {  // boards
    value -= contrast * 0.16F * periodic_pulse(spot.t, 0.2F, 0, 0.025F, spot.wt);
  } else if (kind < 0.6F) {  // blocks
    const float w = 0.9F, h = 0.45F;
    const int row = floor_int(spot.t / h);
    const double s = spot.s + (row & 1) * 0.45;
    const float joints = clamp01(periodic_pulse(spot.t, h, 0, 0.03F, spot.wt) +
                                 periodic_pulse(s, w, 0, 0.03F, spot.ws));
    const float own = hash_unit(hash_cell(floor_int(s / w), row, wall_seed));
    value += contrast * (0.12F * clamp01(1.6F - 4.0F * spot.wt) * (own - 0.5F) - 0.15F * joints);
  }
  return value;
}

struct WindowGrid {
  float spacing, storey, left, right, sill, head, margin;
  int columns, rows;
};

WindowGrid window_grid(const Face& face, std::uint32_t wall_seed) {
  WindowGrid g;
  g.spacing = 2.0F + 1.8F * hash_unit(wall_seed, 3);
  g.storey = 2.7F + 0.5F * hash_unit(wall_seed, 4);
  const float width = g.spacing * (0.35F + 0.22F * hash_unit(wall_seed, 5));
  g.left = 0.5F * (g.spacing - width);
  g.right = g.left + width;
  g.sill = 0.85F + 0.2F * hash_unit(wall_seed, 6);
  g.head = g.sill + 1.1F + 0.4F * hash_unit(wall_seed, 7);
  g.columns = static_cast<int>((face.width - 0.6F) / g.spacing);
  g.rows = static_cast<int>((face.height - 0.3F) / g.storey);
  g.margin = 0.5F * (face.width - static_cast<float>(g.columns) * g.spacing);
  return g;
}

/// A place within the window grid's cell of one window or door.
struct Bay {
  float x, y;       ///< from the cell's lower left corner [m]
  float field;      ///< share of the pixel on the grid
  float near;       ///< 1 where single windows are resolved, 0 far away
  std::uint32_t h;  ///< seed of the cell
};

float shade_door(const WindowGrid& g, const Spot& spot, const Bay& bay, float value) {
  const float x = bay.x, y = bay.y, field = bay.field, ws = spot.ws, wt = spot.wt;
  const float leaf = pulse(x, g.left, g.left + 1.0F, ws) * pulse(y, 0.05F, 2.1F, wt);
  const float frame = pulse(x, g.left - 0.1F, g.left + 1.1F, ws) * pulse(y, 0, 2.2F, wt);
  const float pane = pulse(x, g.left + 0.3F, g.left + 0.7F, ws) * pulse(y, 1.2F, 1.8F, wt);
  value = mix(value, 0.75F, frame * field);
  value = mix(value, 0.14F + 0.4F * hash_unit(bay.h, 10), leaf * field);
  return mix(value, 0.08F, pane * field);
}

/// Grey of a window's pane with its bars; curtains, half drawn blinds and reflections vary by
/// window.
float shade_pane(const WindowGrid& g, const Spot& spot, const Bay& bay, float frame_tone,
                 float contrast) {
  const float x = bay.x, y = bay.y, near = bay.near, ws = spot.ws, wt = spot.wt;
  const std::uint32_t h = bay.h;
  float glass = 0.10F + near * contrast * 0.22F * hash_unit(h, 12) * hash_unit(h, 13);
  const float drawn = g.sill + (g.head - g.sill) * hash_unit(h, 14);
  if (hash_unit(h, 15) < 0.45F) glass += near * 0.40F * pulse(y, drawn, g.head, wt);
  glass += near * contrast * 0.07F * octave(spot, 0.7F, h);
  const float mid = 0.5F * (g.left + g.right);
  const float bars = clamp01(pulse(x, mid - 0.04F, mid + 0.04F, ws) +
                             pulse(y, g.head - 0.42F, g.head - 0.36F, wt));
  return mix(glass, frame_tone, near * bars);
}

}  // namespace

float shade_facade(const Face& face, const Spot& spot, float contrast) {
  const auto wall_seed =
      static_cast<std::uint32_t>(face.style * 1048576.0F);  // one for all four walls
  float value = wall_surface(face, spot, wall_seed, contrast);
  const float t = static_cast<float>(spot.t);
  const float ws = spot.ws, wt = spot.wt;
  // Plinth and a ledge at each storey, a gutter below the roof.
  const WindowGrid g = window_grid(face, wall_seed);
  value = mix(value, 0.5F * value, pulse(t, -3.0F, 0.45F, wt));
  const float ledge = periodic_pulse(t - 0.1, g.storey, 0, 0.10F, wt) * pulse(t, 1.5F, 99.0F, wt);
  value += contrast * 0.16F * ledge * (hash_unit(wall_seed, 8) < 0.6F ? 1.0F : -1.0F);
  value = mix(value, 0.20F, pulse(t, face.height - 0.16F, face.height, wt));
  if (g.columns < 1 || g.rows < 1) return value;

  const double sx = spot.s - g.margin;
  const float field =
      pulse(static_cast<float>(sx), 0, static_cast<float>(g.columns) * g.spacing, ws) *
      pulse(t, 0, static_cast<float>(g.rows) * g.storey, wt);
  if (field <= 0) return value;
  const auto opening = [&](float grow) {
    return field * periodic_pulse(sx, g.spacing, g.left - grow, g.right + grow, ws) *
           periodic_pulse(spot.t, g.storey, g.sill - grow, g.head + grow, wt);
  };
  const int column = floor_int(sx / g.spacing), row = floor_int(spot.t / g.storey);
  const std::uint32_t h = hash_cell(column, row, face.seed + 3);
  const float near = clamp01(1.5F - 1.5F * (ws + wt));  // single windows are resolved
  const float x = static_cast<float>(sx - column * static_cast<double>(g.spacing));
  const float y = static_cast<float>(spot.t - row * static_cast<double>(g.storey));

  const Bay bay{x, y, field, near, h};
  const bool door = row == 0 && hash_unit(h, 9) < 0.22F;
  if (door) return shade_door(g, spot, bay, value);
  const float frame_tone = hash_unit(wall_seed, 11) < 0.7F ? 0.80F : 0.16F;
  value = mix(value, frame_tone, opening(0.09F));
  value = mix(value, shade_pane(g, spot, bay, frame_tone, contrast), opening(0.0F));
  // Shutters beside, or a balcony's railing below.
  if (hash_unit(wall_seed, 16) < 0.4F) {
    const float shutters =
        pulse(x, g.left - 0.42F, g.left - 0.1F, ws) + pulse(x, g.right + 0.1F, g.right + 0.42F, ws);
    value = mix(value, 0.15F + 0.35F * hash_unit(wall_seed, 17),
                near * field * clamp01(shutters) * pulse(y, g.sill, g.head, wt));
  } else if (row > 0 && hash_unit(h, 18) < 0.3F) {
    const float rail = pulse(x, g.left - 0.3F, g.right + 0.3F, ws) * pulse(y, 0.1F, 0.95F, wt);
    const float rods = periodic_pulse(x, 0.14F, 0, 0.05F, ws);
    value = mix(value, mix(value, 0.10F, rods), near * field * rail);
  }
  return value;
}

float shade_roof(const Face& face, const Spot& spot, float contrast) {
  const float rows = periodic_pulse(spot.t, 0.32F, 0, 0.06F, spot.wt);
  const float columns = periodic_pulse(spot.s, 0.28F, 0, 0.05F, spot.ws);
  const float tone = 0.18F + 0.28F * hash_unit(face.seed);
  return tone + contrast * (0.06F * fractal(spot, 4.0F, 0.04F, 0.8F, face.seed) - 0.12F * rows -
                            0.05F * columns);
}

float shade_masonry(const Face& face, const Spot& spot, float contrast) {
  const float h = 0.12F + 0.25F * hash_unit(face.seed, 1), w = h * (1.6F + hash_unit(face.seed, 2));
  const int row = floor_int(spot.t / h);
  const double s = spot.s + (row & 1) * 0.5 * w;
  const float joints = clamp01(periodic_pulse(spot.t, h, 0, 0.025F, spot.wt) +
                               periodic_pulse(s, w, 0, 0.025F, spot.ws));
  const float own = hash_unit(hash_cell(floor_int(s / w), row, face.seed)) - 0.5F;
  const float near = clamp01(1.6F - 3.0F * (spot.ws + spot.wt));
  return 0.35F + 0.25F * hash_unit(face.seed, 3) +
         contrast * (0.30F * near * own + 0.07F * fractal(spot, 1.2F, 0.02F, 0.8F, face.seed) -
                     0.18F * joints);
}

float shade_fence(const Face& face, const Spot& spot, float contrast) {
  const float gap = periodic_pulse(spot.s, 0.16F, 0, 0.045F, spot.ws);
  const float rails =
      pulse(static_cast<float>(spot.t), 0.2F, 0.28F, spot.wt) +
      pulse(static_cast<float>(spot.t), face.height - 0.3F, face.height - 0.22F, spot.wt);
  const std::uint32_t h = hash_cell(floor_int(spot.s / 0.16), 0, face.seed);
  const float near = clamp01(1.5F - 8.0F * spot.ws);
  float value = 0.25F + 0.4F * hash_unit(face.seed, 1) +
                contrast * 0.16F * near * (hash_unit(h) - 0.5F) +
                contrast * 0.06F * fractal(spot, 1.0F, 0.02F, 0.8F, face.seed);
  value = mix(value, 0.08F, gap * (1 - 0.7F * clamp01(rails)));
  return value;
}

}  // namespace placegraph::synthetic
