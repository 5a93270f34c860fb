#include "python/src/graph/images.h"

#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/image/frame.h>

namespace placegraph::python {
namespace {

using namespace nb::literals;

/// Keeps a Python object alive as long as an OpenCV image uses its pixels.
class ArrayAllocator : public cv::MatAllocator {
 public:
  cv::UMatData* allocate(int, const int*, int, void*, std::size_t*, cv::AccessFlag,
                         cv::UMatUsageFlags) const override {
    return nullptr;
  }
  bool allocate(cv::UMatData*, cv::AccessFlag, cv::UMatUsageFlags) const override { return false; }
  void deallocate(cv::UMatData* data) const override {
    {
      const nb::gil_scoped_acquire gil;
      nb::handle(static_cast<PyObject*>(data->userdata)).dec_ref();
    }
    delete data;
  }
};

/// The element type of an array, in numpy's words.
std::string type_text(nb::handle array) {
  if (!nb::hasattr(array, "dtype")) return "another type";
  const nb::object dtype = array.attr("dtype");
  return nb::str(nb::handle(dtype)).c_str();
}

nb::dlpack::dtype dtype_of(const Image& image) {
  switch (image.depth()) {
    case CV_8U:
      return nb::dtype<std::uint8_t>();
    case CV_16U:
      return nb::dtype<std::uint16_t>();
    case CV_32S:
      return nb::dtype<std::int32_t>();
    case CV_32F:
      return nb::dtype<float>();
    default:
      return nb::dtype<double>();
  }
}

Image image_of(nb::handle array, const char* argument, int type, const char* wanted) {
  nb::ndarray<nb::ro, nb::device::cpu> view;
  if (!nb::try_cast(array, view) || !view.is_valid())
    throw ArgumentError(fmt::format("{}: {} is needed", argument, wanted));
  const std::size_t channels = CV_MAT_CN(type), dimensions = channels == 1 ? 2 : 3;
  const bool floats = CV_MAT_DEPTH(type) == CV_32F;
  const bool fits = view.ndim() == dimensions && (dimensions == 2 || view.shape(2) == channels) &&
                    view.dtype() == (floats ? nb::dtype<float>() : nb::dtype<std::uint8_t>());
  if (!fits || view.shape(0) == 0 || view.shape(1) == 0 || view.shape(0) > 32767 ||
      view.shape(1) > 32767) {
    std::string shape;
    for (std::size_t i = 0; i < view.ndim(); ++i)
      shape += (i ? " x " : "") + std::to_string(view.shape(i));
    throw ArgumentError(fmt::format("{}: {} is needed, this one is {} of {}", argument, wanted,
                                    shape, type_text(array)));
  }
  const auto width = static_cast<std::int64_t>(channels);
  if (view.stride(1) != width || (dimensions == 3 && view.stride(2) != 1) ||
      view.stride(0) < static_cast<std::int64_t>(view.shape(1)) * width)
    throw ArgumentError(
        fmt::format("{}: its rows must be contiguous (numpy.ascontiguousarray)", argument));
  static ArrayAllocator allocator;
  const std::size_t step = static_cast<std::size_t>(view.stride(0)) * CV_ELEM_SIZE1(type);
  Image image(static_cast<int>(view.shape(0)), static_cast<int>(view.shape(1)), type,
              const_cast<void*>(view.data()), step);
  auto* data = new cv::UMatData(&allocator);
  data->userdata = array.inc_ref().ptr();
  data->refcount = 1;
  image.u = data;
  image.allocator = &allocator;
  return image;
}

}  // namespace

nb::object array_of(const Image& image, Access access) {
  if (image.empty()) return nb::none();
  auto* owner = new Image(image);
  const nb::capsule keep(owner, [](void* p) noexcept { delete static_cast<Image*>(p); });
  const std::size_t channels = static_cast<std::size_t>(image.channels());
  const std::size_t shape[3] = {static_cast<std::size_t>(image.rows),
                                static_cast<std::size_t>(image.cols), channels};
  const std::int64_t strides[3] = {static_cast<std::int64_t>(image.step1()),
                                   static_cast<std::int64_t>(channels), 1};
  const std::size_t dimensions = channels == 1 ? 2 : 3;
  const auto dtype = dtype_of(image);
  if (access == Access::kReadOnly)
    return nb::cast(
        nb::ndarray<nb::numpy, nb::ro>(owner->data, dimensions, shape, keep, strides, dtype));
  return nb::cast(nb::ndarray<nb::numpy>(owner->data, dimensions, shape, keep, strides, dtype));
}

Image grey_image(nb::handle array, const char* argument) {
  return image_of(array, argument, CV_8UC1, "a grey image, H x W of uint8,");
}
Image colour_image(nb::handle array, const char* argument) {
  return image_of(array, argument, CV_8UC3, "a colour image, H x W x 3 of uint8 (BGR),");
}
Image depth_image(nb::handle array, const char* argument) {
  return image_of(array, argument, CV_32FC1, "a depth image, H x W of float32 [m],");
}
Image flow_image(nb::handle array, const char* argument) {
  return image_of(array, argument, CV_32FC2, "an optical flow, H x W x 2 of float32 [px],");
}

void bind_images(nb::module_& m) {
  const auto view = [](Image Frame::*member) {
    return [member](const Frame& frame) { return array_of(frame.*member, Access::kReadOnly); };
  };
  const nb::sig grey("def image(self) -> numpy.typing.NDArray[numpy.uint8]");
  nb::class_<Frame>(m, "Frame",
                    "The images taken at one time, as views that must not be written to; missing "
                    "images are None.")
      .def_prop_ro(
          "id", [](const Frame& f) { return f.id.value(); }, doc("Frame::id"))
      .def_ro("stamp_ns", &Frame::stamp_ns, "Time [ns].")
      .def_prop_ro("image", view(&Frame::image), grey,
                   "Image of the left or only camera, H x W uint8.")
      .def_prop_ro("right", view(&Frame::right),
                   nb::sig("def right(self) -> numpy.typing.NDArray[numpy.uint8] | None"),
                   "Image of the right camera of a rectified pair, H x W uint8.")
      .def_prop_ro("depth", view(&Frame::depth),
                   nb::sig("def depth(self) -> numpy.typing.NDArray[numpy.float32] | None"),
                   "Depth image, H x W float32 [m]; 0: nothing was measured.")
      .def_prop_ro("colour", view(&Frame::colour),
                   nb::sig("def colour(self) -> numpy.typing.NDArray[numpy.uint8] | None"),
                   "Colour version of the image, H x W x 3 uint8 (BGR).")
      .def_prop_ro("mask", view(&Frame::mask),
                   nb::sig("def mask(self) -> numpy.typing.NDArray[numpy.uint8] | None"),
                   "Mask of the image, H x W uint8; 0: ignored.");
}

}  // namespace placegraph::python
