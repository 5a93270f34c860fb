#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace placegraph {

/// A drawing in pixels: four bytes each, blue, green, red and 255, row by row.
struct DrawingPixels {
  int width = 0, height = 0;
  std::vector<unsigned char> bgra;
};

/// Interface of the module libplacegraph_drawing_plugin.so. Only the module links librsvg and
/// cairo, with the fonts that they find. No function throws.
struct DrawingPlugin {
  virtual ~DrawingPlugin() = default;
  /// Draws a picture in SVG on white, `scale` pixels per unit of its view box.
  /// Returns no pixels if the text is no SVG, or larger than 30000 pixels.
  virtual DrawingPixels rasterize(std::string_view svg, double scale) const = 0;
  /// A page of PDF with this picture, 0.75 points per unit: without a date, so that the same
  /// picture gives the same bytes. Empty if the text is no SVG.
  virtual std::string pdf(std::string_view svg) const = 0;
};

/// The version of DrawingPlugin. It changes with every change of the declarations above.
constexpr std::int64_t kDrawingPluginVersion = 1;

constexpr const char* kDrawingPluginFile = "libplacegraph_drawing_plugin.so";

/// The module, loaded by the first call. Any thread may call this function. `wanted` names the
/// purpose, usually the path of a file. Throws FileError, which names `wanted`, the module and the
/// folders of plugin_folders(), if the module is in none of them or cannot be loaded.
const DrawingPlugin& drawing_plugin(const std::string& wanted);

/// Loads the module from the first of the folders that has it in kDrawingPluginVersion. Throws like
/// drawing_plugin().
const DrawingPlugin& load_drawing_plugin(const std::vector<std::string>& folders,
                                         const std::string& wanted);

}  // namespace placegraph
