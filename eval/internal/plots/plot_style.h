#pragma once
#include <placegraph/eval/internal/plots/plot_canvas.h>

namespace placegraph {

/// Style shared by the plots of curves.
inline constexpr Colour kInk = {40, 40, 40}, kGrid = {228, 228, 228}, kFrame = {120, 120, 120},
                        kWhite = {255, 255, 255};
inline constexpr double kTextPx = 17, kTitlePx = 22;

}  // namespace placegraph
