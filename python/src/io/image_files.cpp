#include <placegraph/graph/core/error.h>
#include <placegraph/io/files/image_file.h>
#include <placegraph/io/sensors/imu_file.h>

#include <nanobind/stl/array.h>
#include <array>
#include <opencv2/imgproc.hpp>

#include "python/src/arrays.h"
#include "python/src/graph/images.h"

namespace placegraph::python {
namespace {

using namespace nb::literals;

/// Pixels of an array that are read: H x W, or H x W x 3 or 4 of uint8; H x W of uint16.
Image pixels_of(nb::handle array) {
  const std::string wanted =
      "image: an array of uint8, H x W, H x W x 3 or H x W x 4 (BGR), or of uint16, H x W, whose "
      "rows follow each other is needed";
  nb::ndarray<nb::ro, nb::device::cpu, nb::c_contig> view;
  if (!nb::try_cast(array, view)) throw ArgumentError(wanted);
  const bool deep = view.dtype() == nb::dtype<std::uint16_t>();
  const std::size_t channels = view.ndim() == 3 ? view.shape(2) : 1;
  const bool fits = view.ndim() == (channels == 1 ? 2u : 3u) &&
                    (channels == 1 || (!deep && (channels == 3 || channels == 4))) &&
                    (deep || view.dtype() == nb::dtype<std::uint8_t>());
  if (!fits || view.size() == 0 || view.shape(0) > 32767 || view.shape(1) > 32767)
    throw ArgumentError(wanted);
  return Image(static_cast<int>(view.shape(0)), static_cast<int>(view.shape(1)),
               CV_MAKETYPE(deep ? CV_16U : CV_8U, static_cast<int>(channels)),
               const_cast<void*>(view.data()));
}

void write(const std::string& path, nb::handle array) {
  const Image image = pixels_of(array);
  const WithoutGil released;
  write_image(path, image);
}

nb::tuple read(const std::string& path) {
  const GreyAndColour image = [&] {
    const WithoutGil released;
    return read_image(path);
  }();
  return nb::make_tuple(array_of(image.grey, Access::kReadWrite),
                        array_of(image.colour, Access::kReadWrite));
}

/// OpenCV names a pattern by the second row's second and third pixel.
nb::object demosaic(nb::handle array, const std::string& pattern) {
  constexpr std::array<std::pair<const char*, int>, 4> kCodes = {{{"rggb", cv::COLOR_BayerBG2BGR},
                                                                  {"bggr", cv::COLOR_BayerRG2BGR},
                                                                  {"gbrg", cv::COLOR_BayerGR2BGR},
                                                                  {"grbg", cv::COLOR_BayerGB2BGR}}};
  const Image grey = grey_image(array, "image");
  require(grey.rows >= 4 && grey.cols >= 4, "image: it is smaller than 4 x 4 pixels");
  for (const auto& [name, code] : kCodes) {
    if (pattern != name) continue;
    Image colour;
    {
      const WithoutGil released;
      cv::demosaicing(grey, colour, code);
    }
    return array_of(colour, Access::kReadWrite);
  }
  throw ArgumentError("pattern: one of rggb, bggr, gbrg, grbg is needed, not '" + pattern + "'");
}

void write_imu_arrays(const std::string& folder, const ArrayArgument<std::int64_t>& stamps_ns,
                      const ArrayArgument<double>& gyro_rad_s,
                      const ArrayArgument<double>& accel_m_s2, double rate_hz,
                      const std::array<double, 4>& noise) {
  const auto stamps = stamps_ns.get("stamps_ns", {kAny});
  const auto n = static_cast<int>(stamps.size());
  const auto gyro = gyro_rad_s.get("gyro_rad_s", {n, 3});
  const auto accel = accel_m_s2.get("accel_m_s2", {n, 3});
  require(rate_hz > 0, "rate_hz: it is not positive");
  for (const double density : noise) require(density > 0, "noise: a density is not positive");
  ImuRecording recording;
  recording.rate_hz = rate_hz;
  recording.noise = {noise[0], noise[1], noise[2], noise[3]};
  for (std::size_t i = 0; i < stamps.size(); ++i) {
    require(i == 0 || stamps.data()[i] > stamps.data()[i - 1],
            "stamps_ns: row " + std::to_string(i) + " does not increase");
    recording.samples.push_back({stamps.data()[i], Eigen::Vector3d(gyro.data() + 3 * i),
                                 Eigen::Vector3d(accel.data() + 3 * i)});
  }
  const WithoutGil released;
  write_imu(folder, recording);
}

}  // namespace

void bind_image_files(nb::module_& m) {
  m.def(
      "read_image", &read, "path"_a,
      nb::sig("def read_image(path: str) -> "
              "tuple[numpy.typing.NDArray[numpy.uint8], numpy.typing.NDArray[numpy.uint8] | None]"),
      "Reads an image: grey, H x W uint8, and colour, H x W x 3 uint8 (BGR), or None where the "
      "file has no colour. FileError names a file that is missing or broken.");
  m.def("write_image", &write, "path"_a, "image"_a, doc("write_image"));
  m.def("demosaic", &demosaic, "image"_a, "pattern"_a,
        nb::sig("def demosaic(image: numpy.typing.NDArray[numpy.uint8], pattern: str) -> "
                "numpy.typing.NDArray[numpy.uint8]"),
        "Colour, H x W x 3 uint8 (BGR), of an image behind a Bayer filter, H x W uint8. "
        "`pattern`: the colours of the upper left 2 x 2 pixels, row by row: 'rggb', 'bggr', "
        "'gbrg' or 'grbg'.");
  m.def("write_imu", &write_imu_arrays, "folder"_a, "stamps_ns"_a, "gyro_rad_s"_a, "accel_m_s2"_a,
        "rate_hz"_a, "noise"_a,
        "Writes inertial measurements (N, N x 3, N x 3) in EuRoC's format. `noise`: densities of "
        "gyroscope and accelerometer, and of the random walks of their biases.");
}

}  // namespace placegraph::python
