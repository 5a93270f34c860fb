#pragma once
#include <placegraph/graph/image/image.h>

#include <string>

namespace [[gnu::visibility("default")]] placegraph {

/// Pixels of a picture in SVG, CV_8UC3; `scale` pixels per unit. `wanted` names the purpose.
/// Throws FileError if the module that draws (drawing_plugin.h) is missing, and ArgumentError if
/// the text is no SVG.
Image svg_pixels(const std::string& svg, double scale, const std::string& wanted);

/// Throws FileError, which names what is wanted, if the module that draws is missing.
void require_drawings(const std::string& wanted);

/// True if the name of a file ends in .png, .svg or .pdf.
bool is_plot_name(const std::string& path);

/// The bytes of a file of this name.
/// They are the SVG itself, or a PNG or a PDF of it, as the name ends. Throws FileError, which
/// names the file, and ArgumentError for another ending.
std::string picture_bytes(const std::string& svg, const std::string& path);

}  // namespace placegraph
