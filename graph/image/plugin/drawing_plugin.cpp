// The module libplacegraph_drawing_plugin.so, see drawing_plugin.h. It depends on librsvg alone.
#include <cairo-pdf.h>
#include <librsvg/rsvg.h>
#include <placegraph/graph/image/drawing_plugin.h>

#include <cmath>
#include <cstring>
#include <memory>

namespace placegraph {
namespace {

struct Deleter {
  void operator()(RsvgHandle* handle) const { g_object_unref(handle); }
  void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
  void operator()(cairo_t* context) const { cairo_destroy(context); }
};
using Handle = std::unique_ptr<RsvgHandle, Deleter>;
using Surface = std::unique_ptr<cairo_surface_t, Deleter>;
using Context = std::unique_ptr<cairo_t, Deleter>;

struct Picture {
  Handle handle;
  double width = 0, height = 0;  ///< size of the view box
};

/// The picture in the text; without a handle if it is no SVG with a view box.
Picture parse(std::string_view svg) {
  Picture picture;
  Handle handle(
      rsvg_handle_new_from_data(reinterpret_cast<const guint8*>(svg.data()), svg.size(), nullptr));
  if (!handle) return picture;
  gboolean has_width = 0, has_height = 0, has_box = 0;
  RsvgLength width, height;
  RsvgRectangle box;
  rsvg_handle_get_intrinsic_dimensions(handle.get(), &has_width, &width, &has_height, &height,
                                       &has_box, &box);
  if (!has_box || !(box.width > 0 && box.height > 0)) return picture;
  return {std::move(handle), box.width, box.height};
}

bool render(const Picture& picture, cairo_t* context, double width, double height) {
  const RsvgRectangle whole = {0, 0, width, height};
  return rsvg_handle_render_document(picture.handle.get(), context, &whole, nullptr) &&
         cairo_status(context) == CAIRO_STATUS_SUCCESS;
}

cairo_status_t append(void* bytes, const unsigned char* data, unsigned int size) {
  static_cast<std::string*>(bytes)->append(reinterpret_cast<const char*>(data), size);
  return CAIRO_STATUS_SUCCESS;
}

struct RsvgPlugin : DrawingPlugin {
  DrawingPixels rasterize(std::string_view svg, double scale) const override {
    constexpr double kLargest = 30000;  // cairo's pictures have sides below 32768 pixels
    const Picture picture = parse(svg);
    if (!picture.handle || !(scale > 0)) return {};
    const double width = std::round(picture.width * scale),
                 height = std::round(picture.height * scale);
    if (!(width >= 1 && height >= 1 && width <= kLargest && height <= kLargest)) return {};
    DrawingPixels pixels{static_cast<int>(width), static_cast<int>(height), {}};
    const Surface surface(
        cairo_image_surface_create(CAIRO_FORMAT_RGB24, pixels.width, pixels.height));
    if (cairo_surface_status(surface.get()) != CAIRO_STATUS_SUCCESS) return {};
    {
      const Context context(cairo_create(surface.get()));
      cairo_set_source_rgb(context.get(), 1, 1, 1);
      cairo_paint(context.get());
      if (!render(picture, context.get(), width, height)) return {};
    }
    cairo_surface_flush(surface.get());
    const unsigned char* from = cairo_image_surface_get_data(surface.get());
    const auto stride = static_cast<std::size_t>(cairo_image_surface_get_stride(surface.get()));
    const std::size_t row = 4 * static_cast<std::size_t>(pixels.width);
    pixels.bgra.resize(row * static_cast<std::size_t>(pixels.height));
    for (std::size_t y = 0; y < static_cast<std::size_t>(pixels.height); ++y)
      std::memcpy(pixels.bgra.data() + y * row, from + y * stride, row);
    for (std::size_t i = 3; i < pixels.bgra.size(); i += 4) pixels.bgra[i] = 255;
    return pixels;
  }

  std::string pdf(std::string_view svg) const override {
    constexpr double kPointsPerUnit = 0.75;
    const Picture picture = parse(svg);
    if (!picture.handle) return {};
    const double width = kPointsPerUnit * picture.width, height = kPointsPerUnit * picture.height;
    std::string bytes;
    const Surface surface(cairo_pdf_surface_create_for_stream(append, &bytes, width, height));
    // The surface takes the present time as its date if it is given none.
    cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_CREATE_DATE, "");
    const Context context(cairo_create(surface.get()));
    if (!render(picture, context.get(), width, height)) return {};
    cairo_show_page(context.get());
    cairo_surface_finish(surface.get());
    return cairo_surface_status(surface.get()) == CAIRO_STATUS_SUCCESS ? bytes : std::string();
  }
};

}  // namespace
}  // namespace placegraph

extern "C" __attribute__((visibility("default"))) std::int64_t placegraph_drawing_plugin_version() {
  return placegraph::kDrawingPluginVersion;
}

extern "C" __attribute__((visibility("default"))) const void* placegraph_drawing_plugin() {
  static const placegraph::RsvgPlugin plugin;
  return static_cast<const placegraph::DrawingPlugin*>(&plugin);
}
