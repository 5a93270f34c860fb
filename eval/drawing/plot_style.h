#pragma once
#include <placegraph/eval/drawing/svg_canvas.h>

#include <cstddef>

namespace placegraph {

/// Colours and sizes that all plots share.
inline constexpr Colour kInk = {40, 40, 40}, kFaint = {105, 105, 105}, kGrid = {228, 228, 228},
                        kFrame = {120, 120, 120}, kWhite = {255, 255, 255},
                        kReference = {150, 150, 150}, kLink = {0, 158, 115},
                        kRejected = {213, 94, 0};
inline constexpr double kTitlePx = 20, kHeadingPx = 16, kTextPx = 15, kTickPx = 13.5;
/// Space around the inside of a panel: numbers and names of its axes, its heading.
inline constexpr double kLeftMargin = 84, kBottomMargin = 62, kTopMargin = 36, kRightMargin = 26,
                        kBarMargin = 104;

/// The least range of an axis of errors [m]: what is smaller is shown as none.
inline constexpr double kLeastError = 1e-3;

/// The stroke of the curve of a number: colours of Okabe and Ito, which colour-blind readers can
/// distinguish, and from the seventh curve on dashes too.
Stroke curve_stroke(std::size_t curve);

}  // namespace placegraph
