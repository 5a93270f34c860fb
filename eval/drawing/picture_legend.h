#pragma once
#include <placegraph/eval/drawing/figure.h>
#include <placegraph/graph/image/image.h>

#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// A strip of this width with notes above a legend, on white: CV_8UC3.
/// `wanted` names the purpose. Throws FileError if the module that draws is missing.
Image legend_strip(const std::vector<LegendEntry>& entries, const std::vector<std::string>& notes,
                   int width_px, const std::string& wanted);

/// The entry of a filled area in this colour.
LegendEntry area_entry(const std::string& text, Colour colour);

/// The picture (CV_8UC3) above a strip; what is narrower gets white at its right.
Image stacked(const Image& bgr, const Image& strip);

/// The picture with its legend below, which is at least 320 pixels wide.
Image with_legend(const Image& bgr, const std::vector<LegendEntry>& entries,
                  const std::string& wanted);

/// A colour for the n-th of many areas, such as planes; neighbours in number differ in hue.
Colour area_colour(std::size_t number);

}  // namespace placegraph
