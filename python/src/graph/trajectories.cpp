#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/graph/geometry/se3.h>
#include <placegraph/graph/geometry/repeated_stamps.h>
#include <placegraph/graph/geometry/trajectory_edit.h>
#include <placegraph/io/trajectories/trajectory_file.h>
#include <placegraph/io/trajectories/trajectory_filter.h>

#include <cmath>
#include <filesystem>
#include <limits>

#include "python/src/arrays.h"
#include "python/src/values/value_class.h"
#include "python/src/warnings.h"

namespace placegraph::python {
namespace {

using namespace nb::literals;

/// N x 4 x 4; frames without a pose have NaN.
ReadOnlyArray<double> poses_of(const Trajectory& trajectory) {
  std::vector<double> values;
  values.reserve(16 * trajectory.size());
  for (const StampedPose& pose : trajectory.poses)
    append_rows(pose.T_world_body
                    ? Eigen::Matrix4d(pose.T_world_body->matrix())
                    : Eigen::Matrix4d::Constant(std::numeric_limits<double>::quiet_NaN()),
                values);
  return owned_array(std::move(values), {trajectory.size(), 4, 4});
}

ReadOnlyArray<std::int64_t> stamps_of(const Trajectory& trajectory) {
  std::vector<std::int64_t> stamps;
  for (const StampedPose& pose : trajectory.poses) stamps.push_back(pose.stamp_ns);
  return owned_array(std::move(stamps), {trajectory.size()});
}

/// The trajectory, after its warnings have become those of Python.
Trajectory doubted(Trajectory trajectory) {
  for (const std::string& warning : trajectory.warnings) warn(warning);
  return trajectory;
}

/// The pose of a row of matrices; nothing if it has NaN.
std::optional<Eigen::Isometry3d> pose_in(const double* values, std::size_t row) {
  using RowMajor = Eigen::Matrix<double, 4, 4, Eigen::RowMajor>;
  const Eigen::Map<const RowMajor> matrix(values);
  if (matrix.hasNaN()) return std::nullopt;
  require(matrix.allFinite(), fmt::format("poses: row {} is not finite", row));
  const Eigen::Matrix3d R = matrix.topLeftCorner<3, 3>();
  require((R.transpose() * R - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() < 1e-2 &&
              R.determinant() > 0 && matrix.row(3) == Eigen::RowVector4d(0, 0, 0, 1),
          fmt::format("poses: row {} is no rigid motion", row));
  Eigen::Isometry3d T;
  T.matrix() = matrix;
  return T;
}

Trajectory from_arrays(const ArrayArgument<std::int64_t>& stamps_argument,
                       const ArrayArgument<double>& poses_argument) {
  const auto stamps_ns = stamps_argument.get("stamps_ns", {kAny});
  const auto poses = poses_argument.get("poses", {kAny, 4, 4}, Values::kUnchecked);
  require(stamps_ns.shape(0) == poses.shape(0),
          fmt::format("poses: {} stamps and {} poses", stamps_ns.shape(0), poses.shape(0)));
  Trajectory trajectory;
  std::vector<RepeatedStamp> repeated;
  for (std::size_t i = 0; i < poses.shape(0); ++i) {
    const StampedPose pose{stamps_ns.data()[i], pose_in(poses.data() + 16 * i, i)};
    const std::int64_t before_ns =
        trajectory.poses.empty() ? pose.stamp_ns - 1 : trajectory.poses.back().stamp_ns;
    require(pose.stamp_ns >= before_ns, fmt::format("stamps_ns: row {} goes back", i));
    if (pose.stamp_ns == before_ns)
      repeated.push_back({i, trajectory.size() - 1, pose.T_world_body});
    else
      trajectory.poses.push_back(pose);
  }
  require(repeated.size() <= trajectory.size(),
          fmt::format("stamps_ns: {} of {} rows have the stamp of the row before", repeated.size(),
                      poses.shape(0)));
  if (!repeated.empty())
    trajectory.warnings.push_back(
        repeated_stamps_warning("stamps_ns: row ", trajectory.poses, repeated));
  return doubted(std::move(trajectory));
}

Trajectory read_file(const std::filesystem::path& path, const std::filesystem::path& times) {
  return doubted([&] {
    const WithoutGil released;
    return read_trajectory(path.string(), times.string());
  }());
}

std::string text_of(const Trajectory& trajectory) {
  return fmt::format("<placegraph.Trajectory: {} of {} frames posed, path length {:.4g}>",
                     trajectory.posed(), trajectory.size(), trajectory.path_length());
}

Trajectory from_pandas(const nb::object& table) {
  return nb::cast<Trajectory>(
      nb::module_::import_("placegraph._tables").attr("trajectory_of_table")(table));
}

nb::object table_of(const Trajectory& trajectory) {
  constexpr const char* kColumns[] = {"x", "y", "z", "qx", "qy", "qz", "qw"};
  std::vector<double> columns[std::size(kColumns)];
  for (const StampedPose& pose : trajectory.poses) {
    Eigen::Matrix<double, 7, 1> row;
    row.setConstant(std::numeric_limits<double>::quiet_NaN());
    if (pose.T_world_body)
      row << pose.T_world_body->translation(),
          SE3(*pose.T_world_body).rotation().quaternion().coeffs();
    for (Eigen::Index i = 0; i < row.size(); ++i) columns[i].push_back(row[i]);
  }
  nb::dict table;
  table["stamp_ns"] = stamps_of(trajectory);
  for (std::size_t i = 0; i < std::size(kColumns); ++i)
    table[kColumns[i]] = owned_array(std::move(columns[i]), {trajectory.size()});
  return module_for("pandas", "pandas").attr("DataFrame")(table);
}

/// The frames of a slice of Python. Throws ArgumentError for one against the order of time.
Trajectory sliced(const Trajectory& trajectory, const nb::slice& slice) {
  Py_ssize_t begin = 0, end = 0, step = 0;
  if (PySlice_Unpack(slice.ptr(), &begin, &end, &step) != 0) throw nb::python_error();
  require(step > 0, "slice: its step must be positive, because a trajectory is in time order");
  const Py_ssize_t count =
      PySlice_AdjustIndices(static_cast<Py_ssize_t>(trajectory.size()), &begin, &end, step);
  Trajectory part;
  part.has_times = trajectory.has_times;
  part.numbered = trajectory.numbered || !trajectory.has_times;
  part.has_orientation = trajectory.has_orientation;
  for (Py_ssize_t i = 0; i < count; ++i)
    part.poses.push_back(trajectory.poses[static_cast<std::size_t>(begin + i * step)]);
  return part;
}

/// A frame by its number, from the end if it is negative.
StampedPose frame_of(const Trajectory& trajectory, nb::handle which) {
  Py_ssize_t i = PyNumber_AsSsize_t(which.ptr(), PyExc_IndexError);
  if (i == -1 && PyErr_Occurred()) throw nb::python_error();
  const auto size = static_cast<Py_ssize_t>(trajectory.size());
  if (i < 0) i += size;
  if (i < 0 || i >= size)
    throw nb::index_error(fmt::format("the trajectory has {} frames", size).c_str());
  return trajectory.poses[static_cast<std::size_t>(i)];
}

void bind_elements(nb::class_<Trajectory>& trajectory) {
  trajectory.def("__len__", &Trajectory::size)
      .def("__getitem__", &sliced, "which"_a, "The frames of a slice, whose step is positive.")
      .def("__getitem__", &frame_of, "which"_a,
           nb::sig("def __getitem__(self, which: typing.SupportsIndex) -> StampedPose"),
           "A frame by its number, from the end if it is negative.")
      .def(
          "__iter__", [](nb::handle self) { return nb::steal(PySeqIter_New(self.ptr())); },
          nb::sig("def __iter__(self) -> collections.abc.Iterator[StampedPose]"),
          "The frames in time order.");
}

void bind_stamped_pose(nb::module_& m) {
  nb::class_<StampedPose> pose(m, "StampedPose", "One frame of a trajectory: its time and pose.");
  bind_value(pose, Hash::kByValue);
  pose.def_ro("stamp_ns", &StampedPose::stamp_ns, doc("StampedPose::stamp_ns"))
      .def_prop_ro(
          "T_world_body",
          [](const StampedPose& p) {
            return p.T_world_body ? std::optional(SE3(*p.T_world_body)) : std::nullopt;
          },
          "The pose, of the nearest rotation to that of the matrix; None where the frame is lost.")
      .def("__repr__", [](const StampedPose& p) {
        if (!p.T_world_body)
          return fmt::format("<placegraph.StampedPose: {} ns, lost>", p.stamp_ns);
        const Eigen::Vector3d t = p.T_world_body->translation();
        return fmt::format("<placegraph.StampedPose: {} ns at [{:.6g}, {:.6g}, {:.6g}]>",
                           p.stamp_ns, t.x(), t.y(), t.z());
      });
}

void bind_functions(nb::module_& m) {
  m.def(
      "merge_trajectories",
      [](std::vector<Trajectory> parts, bool keep_first) {
        return merge(std::move(parts), keep_first ? Overlap::kFirstKept : Overlap::kRefused)
            .trajectory;
      },
      "parts"_a, nb::kw_only(), "keep_first"_a = false,
      "Joins trajectories of one body in one world, in the order of their times.\n\n"
      "`keep_first`: of trajectories that overlap in time the one that begins first is kept there. "
      "Raises ArgumentError for an overlap otherwise, and for trajectories without times.");
  m.def(
      "filter_steps",
      [] {
        std::vector<std::pair<std::string, std::string>> steps;
        for (const FilterStepForm& step : filter_step_forms())
          steps.emplace_back(step.form, step.text);
        return steps;
      },
      "The steps of `Trajectory.apply`: how each is written, and what it does.");
}

void bind_making(nb::class_<Trajectory>& trajectory) {
  trajectory.def(nb::init<>(), "No poses.")
      .def_static(
          "from_arrays", &from_arrays, "stamps_ns"_a, "poses"_a,
          "A trajectory of stamps (N, int64) [ns] and matrices T_world_body (N x 4 x 4).\n\n"
          "A matrix with NaN is that of a frame without a pose. Of rows with one stamp the first "
          "is kept, with a warning (Doubt). Raises ArgumentError for stamps that go back and matrices "
          "that are no rigid motions.")
      .def_static("from_pandas", &from_pandas, "table"_a,
                  nb::sig("def from_pandas(table: pandas.DataFrame) -> Trajectory"),
                  "A trajectory of the rows of a DataFrame.\n\n"
                  "The names of the columns are those of a header that `read` obeys: stamp_ns or "
                  "another time, or `frame`, x, y, z, qx, qy, qz, qw, or the entries of matrices; "
                  "an index of times or of floats [s] is the time if no column is. Raises "
                  "FileError for a table without such columns.")
      .def_static(
          "read", &read_file, "path"_a, "times"_a = "",
          "Reads a trajectory from a text file with one pose per line.\n\n"
          "A header that names the columns is used; otherwise the number of fields decides: KITTI "
          "(3x4 or 4x4), TUM, EuRoC. Blanks, tabs, commas or semicolons separate the fields. "
          "COLMAP's images.txt and images.bin and transforms.json are read, too. "
          "Without times, stamps are the numbers of the frames and `has_times` is False, unless "
          "`times` names a file with one time [s] per line and frame. Of lines with one time the "
          "first is kept, with a warning (Doubt). Raises FileError with the line: missing, empty, "
          "of unknown format, not a number, times that go back or numbers not increasing, not a "
          "rotation (tolerance 1e-2), no orientation.");
}

void bind_content(nb::class_<Trajectory>& trajectory) {
  trajectory
      .def(
          "write",
          [](const Trajectory& t, const std::filesystem::path& path, TrajectoryFormat format) {
            write_trajectory(path.string(), t, format);
          },
          "path"_a, "format"_a = TrajectoryFormat::kTum, nb::call_guard<WithoutGil>(),
          doc("write_trajectory"))
      .def("__repr__", [](const Trajectory& each) { return text_of(each); })
      .def_prop_ro("posed", &Trajectory::posed, doc("Trajectory::posed"))
      .def_prop_ro("path_length", &Trajectory::path_length, doc("Trajectory::path_length"))
      .def_ro("has_times", &Trajectory::has_times, doc("Trajectory::has_times"))
      .def_prop_ro("warnings", as_tuple(&Trajectory::warnings), doc("Trajectory::warnings"))
      .def_prop_ro("stamps_ns", &stamps_of, kNew,
                   "Stamps, N of int64 [ns]; numbers of frames where has_times is false.\n\n"
                   "`from_arrays` makes a trajectory with others.")
      .def_prop_ro("poses", &poses_of, kNew,
                   "Matrices T_world_body, N x 4 x 4; NaN where there is none.\n\n"
                   "`from_arrays` makes a trajectory with others.");
}

void bind_changes(nb::class_<Trajectory>& trajectory) {
  trajectory
      .def(
          "resample",
          [](const Trajectory& t, const ArrayArgument<std::int64_t>& stamps_ns, double max_gap_s) {
            const auto stamps = stamps_ns.get("stamps_ns", {kAny});
            require(max_gap_s > 0, "max_gap_s: it is not positive");
            for (std::size_t i = 1; i < stamps.size(); ++i)
              require(stamps.data()[i] > stamps.data()[i - 1],
                      fmt::format("stamps_ns: row {} does not increase", i));
            return resample(t, {stamps.data(), stamps.data() + stamps.size()}, max_gap_s);
          },
          "stamps_ns"_a, "max_gap_s"_a = 0.2,
          "The poses at other stamps [ns] (N, int64), interpolated. Stamps that have no pose on "
          "both sides within `max_gap_s` get none.")
      .def(
          "pose_at",
          [](const Trajectory& t, std::int64_t stamp_ns, double max_gap_s) {
            require(max_gap_s >= 0, "max_gap_s: it must be a number that is not negative");
            return interpolate(t, stamp_ns, max_gap_s);
          },
          "stamp_ns"_a, "max_gap_s"_a = 1.0,
          "The pose T_world_body at a time [ns] between two frames that have one; None outside the "
          "trajectory, beside a lost frame, or across a gap wider than `max_gap_s`.\n\n"
          "The translation is interpolated linearly, the rotation along the geodesic.")
      .def(
          "apply",
          [](const Trajectory& t, const std::string& chain) {
            return TrajectoryFilter(chain).apply(t);
          },
          "chain"_a, nb::call_guard<WithoutGil>(),
          "The trajectory after a chain of steps, as \"crop 10:60; downsample 0.5m\".\n\n"
          "`filter_steps()` lists them. Raises ArgumentError with the step and its number, "
          "NoResult if a step leaves no pose.")
      .def(
          "split",
          [](const Trajectory& t, std::optional<double> every_s) {
            return every_s ? split_every(t, *every_s)
                           : split_at_gaps(t, 1e-9 * static_cast<double>(longest_spacing_ns(t)));
          },
          "every_s"_a = nb::none(),
          "Parts of that length [s]; without one the parts between gaps of more than five median "
          "spacings. Raises ArgumentError for a trajectory without times.")
      .def("to_pandas", &table_of, nb::sig("def to_pandas(self) -> pandas.DataFrame"),
           "A row for each frame: stamp_ns, x, y, z, qx, qy, qz, qw; NaN where there is no pose.");
}

}  // namespace

void bind_trajectories(nb::module_& m) {
  bind_stamped_pose(m);
  nb::enum_<TrajectoryFormat>(m, "TrajectoryFormat", "Formats in which trajectories are written.")
      .value("KITTI", TrajectoryFormat::kKitti)
      .value("TUM", TrajectoryFormat::kTum)
      .value("EUROC", TrajectoryFormat::kEuroc);
  nb::class_<Trajectory> trajectory(m, "Trajectory", doc("Trajectory"));
  bind_value(trajectory, Hash::kByValue);
  bind_elements(trajectory);
  bind_making(trajectory);
  bind_content(trajectory);
  bind_changes(trajectory);
  bind_functions(m);
}

}  // namespace placegraph::python
