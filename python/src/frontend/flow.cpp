#include <fmt/format.h>
#include <placegraph/eval/scene/flow_error.h>
#include <placegraph/frontend/flow/corners.h>
#include <placegraph/frontend/flow/optical_flow.h>
#include <placegraph/graph/core/error.h>

#include <opencv2/core.hpp>

#include "python/src/frontend/flow_vectors.h"

namespace placegraph::python {
namespace {

using namespace nb::literals;

ImageResult<float> dense_flow(const GreyArgument& image_from, const GreyArgument& image_to,
                              const std::optional<std::string>& method,
                              const OptionsArgument<FlowOptions>& options) {
  const Image from = image_from.get("image_from"), to = image_to.get("image_to");
  FlowOptions chosen = options.get();
  if (method) chosen.method = choice_of<FlowMethod>(*method, flow_method_names(), "method");
  const WithoutGil released;
  try {
    return {optical_flow(from, to, chosen)};
  } catch (const cv::Exception&) {  // images without room for OpenCV's windows
    throw ArgumentError(
        fmt::format("image_from: {} x {} pixels are too few for the method '{}'", from.rows,
                    from.cols, flow_method_names().at(static_cast<std::size_t>(chosen.method))));
  }
}

template <class Options>
using PointFlow = std::vector<FlowVector> (*)(const Image&, const Image&,
                                              const std::vector<Eigen::Vector2d>&, const Options&);

/// A method that measures given points.
template <class Options, PointFlow<Options> method>
FlowVectors flow_at(const GreyArgument& image_from, const GreyArgument& image_to,
                    const ArrayArgument<double>& points, const OptionsArgument<Options>& options) {
  const Image from = image_from.get("image_from"), to = image_to.get("image_to");
  const std::vector<Eigen::Vector2d> px = points_2d(points, "points");
  const Options chosen = options.get();
  const WithoutGil released;
  return {method(from, to, px, chosen)};
}

FlowVectors flow_at_key_pixels(const GreyArgument& image_from, const GreyArgument& image_to,
                               const OptionsArgument<KeyPixelFlowOptions>& options) {
  const Image from = image_from.get("image_from"), to = image_to.get("image_to");
  const KeyPixelFlowOptions chosen = options.get();
  const WithoutGil released;
  return {key_pixel_flow(from, to, chosen)};
}

using Array = ReadOnlyArray<double>;

/// Pixels and strengths of corners.
std::pair<Array, Array> corners_of(const GreyArgument& image, double min_strength, int border,
                                   const GreyArgument& mask) {
  const Image grey = image.get("image"), allowed = mask.get_optional("mask");
  require(min_strength >= 0, "min_strength: it must not be negative");
  require(border >= 4, "border: at least 4 pixels are needed");
  require(allowed.empty() || allowed.size() == grey.size(), "mask: it has another size than image");
  std::vector<double> px, strength;
  {
    const WithoutGil released;
    for (const Corner& corner : find_corners(grey, min_strength, border, {}, allowed)) {
      px.insert(px.end(), {static_cast<double>(corner.u), static_cast<double>(corner.v)});
      strength.push_back(corner.strength);
    }
  }
  const std::size_t n = strength.size();
  return {owned_array(std::move(px), {n, 2}), owned_array(std::move(strength), {n})};
}

FlowError error_of(const FlowArgument& flow, const FlowArgument& truth, double min_px,
                   double max_px) {
  const Image found = flow.get("flow"), wanted = truth.get("truth");
  require(found.size() == wanted.size(), "truth: it has another size than flow");
  require(min_px >= 0 && min_px < max_px, "min_px: from 0 to less than max_px is needed");
  const WithoutGil released;
  return flow_error(found, wanted, {min_px, max_px});
}

FlowVectors sampled(const GreyArgument& image_from, const FlowArgument& flow, int cell_px) {
  const Image from = image_from.get("image_from"), dense = flow.get("flow");
  require(from.size() == dense.size(), "flow: it has another size than image_from");
  require(cell_px >= 1, "cell_px: it must be above 0");
  const WithoutGil released;
  return {sampled_flow(from, dense, cell_px)};
}

ReadOnlyArray<std::int32_t> kinds_of(const FlowVectors& flow) {
  static_assert(sizeof(FlowVector::Kind) == sizeof(std::int32_t));
  const std::size_t shape[1] = {flow.vectors.size()};
  const std::int64_t strides[1] = {sizeof(FlowVector) / sizeof(std::int32_t)};
  const void* first = flow.vectors.empty() ? nullptr : &flow.vectors.front().kind;
  return {first, 1, shape, nb::find(flow), strides};
}

void bind_results(nb::module_& m) {
  const auto column = [](auto FlowVector::*member) {
    return [member](const FlowVectors& v) { return column_of(v.vectors, member, v); };
  };
  nb::class_<FlowVectors>(m, "FlowVectors", "Displacements of points between two images.")
      .def("__len__", [](const FlowVectors& v) { return v.vectors.size(); })
      .def_prop_ro("px", column(&FlowVector::px), "Points in the first image, N x 2 [px].")
      .def_prop_ro("flow", column(&FlowVector::flow), "Displacements, N x 2 [px]; see `kind`.")
      .def_prop_ro("covariance", column(&FlowVector::covariance),
                   "Covariances of the displacements, N x 2 x 2 [px^2]. For a normal flow it has "
                   "the variance of its own direction only.")
      .def_prop_ro("kind", &kinds_of,
                   "What is known of each: 0 nothing, 1 the component along the gradient (normal "
                   "flow), 2 the whole displacement; N of int32.");
  nb::class_<FlowError>(m, "FlowError", doc("FlowError"))
      .def_ro("pixels", &FlowError::pixels, doc("FlowError::pixels"))
      .def_ro("compared", &FlowError::compared, doc("FlowError::compared"))
      .def_ro("coverage", &FlowError::coverage, doc("FlowError::coverage"))
      .def_ro("mean_px", &FlowError::mean_px, doc("FlowError::mean_px"))
      .def_ro("median_px", &FlowError::median_px, "Median end-point error of the compared pixels.")
      .def_ro("share_beyond_3px", &FlowError::share_beyond_3px,
              "Share of the compared pixels with an error above 3 px.");
}

}  // namespace

void bind_flow(nb::module_& m) {
  bind_option_set<FlowOptions>(m, "FlowOptionSet", doc("FlowOptions"));
  bind_option_set<LucasKanadeOptions>(m, "LucasKanadeOptionSet", doc("LucasKanadeOptions"));
  bind_option_set<InterpolationFlowOptions>(m, "InterpolationFlowOptionSet",
                                            doc("InterpolationFlowOptions"));
  bind_option_set<KeyPixelFlowOptions>(m, "KeyPixelFlowOptionSet", doc("KeyPixelFlowOptions"));
  bind_results(m);
  m.def("optical_flow", &dense_flow, "image_from"_a, "image_to"_a, "method"_a = nb::none(),
        "options"_a = nb::none(),
        "Displacements from one image to the next, H x W x 2 float32 (right, down) in pixels, NaN "
        "where the method has no result or only normal flow.\n\nImages: H x W uint8 of one size. "
        "`method`, of `flow_methods()`, takes precedence over that of the options; the default is "
        "'dis'. Methods that measure points have NaN between those of the grid (or between "
        "key-pixels).");
  m.def("flow_methods", &flow_method_names, doc("flow_method_names"));
  m.def("lucas_kanade", &flow_at<LucasKanadeOptions, lucas_kanade>, "image_from"_a, "image_to"_a,
        "points"_a, "options"_a = nb::none(), doc("lucas_kanade"));
  m.def("interpolation_flow", &flow_at<InterpolationFlowOptions, interpolation_flow>,
        "image_from"_a, "image_to"_a, "points"_a, "options"_a = nb::none(),
        doc("interpolation_flow"));
  m.def("key_pixel_flow", &flow_at_key_pixels, "image_from"_a, "image_to"_a,
        "options"_a = nb::none(), doc("key_pixel_flow"));
  m.def("sampled_flow", &sampled, "image_from"_a, "flow"_a, "cell_px"_a = 16, doc("sampled_flow"));
  m.def("find_corners", &corners_of, "image"_a, "min_strength"_a = 1e-4, "border"_a = 4,
        "mask"_a = nb::none(),
        "Detects corners (Shi & Tomasi 1994), row by row from the top: their pixels (N x 2) and "
        "their strengths (N).\n\nA corner is a pixel whose gradient matrix, summed over 5x5 pixels,"
        " has a least eigenvalue (grey levels / 255, per pixel) above `min_strength` and at least "
        "that of all eight neighbours. Nothing is found within `border` pixels of the sides or "
        "where `mask` (H x W uint8) is 0.");
  m.def("flow_error", &error_of, "flow"_a, "truth"_a, "min_px"_a = 0.0,
        "max_px"_a = std::numeric_limits<double>::infinity(),
        "Error of an optical flow over the pixels whose true flow is known, stays inside the image "
        "and is from `min_px` to `max_px` long.\n\nBoth are H x W x 2 float32 [px], NaN where "
        "unknown.");
}

}  // namespace placegraph::python
