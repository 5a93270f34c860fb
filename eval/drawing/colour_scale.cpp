#include <placegraph/eval/drawing/figure.h>
#include <placegraph/eval/drawing/plot_style.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace placegraph {

Colour scale_colour(double share) {
  // Ninths of matplotlib's viridis (van der Walt and Smith 2015, CC0); its last fifth, which is
  // pale on white, is left out.
  constexpr Colour kStops[] = {{68, 1, 84},    {71, 44, 122},  {59, 81, 139},
                               {44, 113, 142}, {33, 144, 141}, {39, 173, 129},
                               {92, 200, 99},  {170, 220, 50}, {225, 213, 20}};
  const double at = std::clamp(share, 0.0, 1.0) * (std::size(kStops) - 1);
  const auto below = std::min(static_cast<std::size_t>(at), std::size(kStops) - 2);
  const double rest = at - static_cast<double>(below);
  const auto mixed = [&](int a, int b) {
    return static_cast<int>(std::lround(a + rest * (b - a)));
  };
  const Colour &a = kStops[below], &b = kStops[below + 1];
  return {mixed(a.red, b.red), mixed(a.green, b.green), mixed(a.blue, b.blue)};
}

Stroke curve_stroke(std::size_t curve) {
  constexpr Colour kColours[] = {{0, 114, 178}, {213, 94, 0},   {204, 121, 167},
                                 {230, 159, 0}, {86, 180, 233}, {0, 0, 0}};
  constexpr const char* kDashes[] = {"", "9 4", "2.5 3.5", "10 3 2.5 3"};
  constexpr std::size_t kCount = std::size(kColours);
  return {kColours[curve % kCount], 2, 1, kDashes[curve / kCount % std::size(kDashes)]};
}

}  // namespace placegraph
