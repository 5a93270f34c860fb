#pragma once
#include <placegraph/eval/trajectory/result.h>

#include <limits>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

namespace placegraph::report {

// The parts of which every report is made; their types are those of web/src/data/report.ts.

/// What a column has where a value is unknown.
inline constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();

/// A report without content. `program`: name and version of the program.
nlohmann::json bare_report(const std::string& program, const std::string& title);

/// A run without content; `frames` are those of bare_frames.
nlohmann::json bare_run(const std::string& name, nlohmann::json frames);

/// Frames of which only numbers and times are known; all columns have as many rows.
nlohmann::json bare_frames(const std::vector<std::int32_t>& id, const std::vector<double>& stamp_s);

/// A column of poses x y z qx qy qz qw; not a number where there is none.
nlohmann::json pose_column(const std::vector<std::optional<Eigen::Isometry3d>>& poses);

/// The direction up in a top view of these positions, the axis that it leaves out: against y in
/// the frame of a camera, along x or z elsewhere.
nlohmann::json up_axis(const std::vector<std::optional<Eigen::Vector3d>>& positions_m);

/// The figures that have a value.
nlohmann::json describe_figures(const std::vector<Metric>& metrics);

/// A table of texts, under a title; every row has as many cells as there are columns.
nlohmann::json describe_table(const std::string& title, const std::string& protocol,
                              const std::vector<std::string>& columns,
                              const std::vector<std::vector<std::string>>& rows);

/// A picture that the page shows and saves; `svg` is the text of the file.
nlohmann::json describe_picture(const std::string& title, const std::string& caption,
                                const std::string& svg);

}  // namespace placegraph::report
