#include <placegraph/graph/core/error.h>
#include <placegraph/io/datasets/open_dataset.h>
#include <placegraph/io/sensors/imu_file.h>

#include "python/src/arrays.h"

namespace placegraph::python {
namespace {

using namespace nb::literals;

ReadOnlyArray<std::int64_t> stamps_of(const Dataset& dataset) {
  std::vector<std::int64_t> stamps;
  for (std::size_t i = 0; i < dataset.size(); ++i) stamps.push_back(dataset.stamp_ns(i));
  return owned_array(std::move(stamps), {dataset.size()});
}

ReadOnlyArray<std::int64_t> imu_stamps(const ImuRecording& imu) {
  std::vector<std::int64_t> stamps;
  for (const ImuSample& sample : imu.samples) stamps.push_back(sample.stamp_ns);
  return owned_array(std::move(stamps), {imu.samples.size()});
}

/// One of the vectors of every sample, N x 3.
ReadOnlyArray<double> imu_rows(const ImuRecording& imu, Eigen::Vector3d ImuSample::*member) {
  std::vector<double> values;
  for (const ImuSample& sample : imu.samples)
    values.insert(values.end(), (sample.*member).data(), (sample.*member).data() + 3);
  return owned_array(std::move(values), {imu.samples.size(), 3});
}

void bind_imu(nb::module_& m) {
  nb::class_<ImuNoise>(m, "ImuNoise", doc("ImuNoise"))
      .def_ro("gyro", &ImuNoise::gyro, doc("ImuNoise::gyro"))
      .def_ro("accel", &ImuNoise::accel, doc("ImuNoise::accel"))
      .def_ro("gyro_bias_walk", &ImuNoise::gyro_bias_walk, doc("ImuNoise::gyro_bias_walk"))
      .def_ro("accel_bias_walk", &ImuNoise::accel_bias_walk, doc("ImuNoise::accel_bias_walk"));
  nb::class_<ImuRecording>(m, "ImuRecording", doc("ImuRecording"))
      .def("__len__", [](const ImuRecording& r) { return r.samples.size(); })
      .def_ro("rate_hz", &ImuRecording::rate_hz, doc("ImuRecording::rate_hz"))
      .def_ro("noise", &ImuRecording::noise, doc("ImuRecording::noise"))
      .def_prop_ro("stamps_ns", &imu_stamps, kNew, "Times of the readings [ns], N of int64.")
      .def_prop_ro(
          "gyro_rad_s", [](const ImuRecording& r) { return imu_rows(r, &ImuSample::gyro_rad_s); },
          kNew, "Angular velocity in the body frame, bias included [rad/s], N x 3.")
      .def_prop_ro(
          "accel_m_s2", [](const ImuRecording& r) { return imu_rows(r, &ImuSample::accel_m_s2); },
          kNew, "Specific force in the body frame: -gravity at rest [m/s^2], N x 3.");
  m.def("read_imu", &read_imu, "folder"_a, nb::call_guard<WithoutGil>(), doc("read_imu"));
}

}  // namespace

void bind_datasets(nb::module_& m) {
  nb::class_<Dataset>(m, "Dataset", doc("Dataset"))
      .def_prop_ro("name", &Dataset::name, doc("Dataset::name"))
      .def_prop_ro("format", &Dataset::format, doc("Dataset::format"))
      .def("__len__", &Dataset::size)
      .def_prop_ro(
          "sensors", [](const Dataset& d) { return TupleOf{d.sensors()}; }, doc("Dataset::sensors"))
      .def("calibration", &Dataset::calibration, "sensor"_a, doc("Dataset::calibration"))
      .def("stamp_ns", &Dataset::stamp_ns, "index"_a, doc("Dataset::stamp_ns"))
      .def_prop_ro("stamps_ns", &stamps_of, kNew, "Times of all frames [ns], N of int64.")
      .def("image_path", &Dataset::image_path, "index"_a, doc("Dataset::image_path"))
      .def("frame", &Dataset::frame, "index"_a, "sensor"_a, nb::call_guard<WithoutGil>(),
           doc("Dataset::frame"))
      .def_prop_ro("ground_truth", &Dataset::ground_truth, doc("Dataset::ground_truth"))
      .def_prop_ro("images_rectified", &Dataset::images_rectified, doc("Dataset::images_rectified"))
      .def("notes", &Dataset::notes, doc("Dataset::notes"));
  m.def("open_dataset", &open_dataset, "path"_a, nb::call_guard<WithoutGil>(),
        "Recognizes the layout of a folder or video file and opens it as a sequence.\n\n"
        "Raises FileError if none is recognized, `path` does not exist or the sequence is broken.");
  bind_imu(m);
}

}  // namespace placegraph::python
