#include <fmt/format.h>
#include <placegraph/io/files/text_file.h>
#include <placegraph/io/trajectories/submitted_poses.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string_view>

namespace placegraph {
namespace {

constexpr std::size_t kNumbers = 12;
/// Rotations of numbers with four digits behind the point pass (2e-4), those with three do not:
/// they turn by up to a twentieth of a degree, which is seen in r_rel. Chosen.
constexpr double kSubmittedTolerance = 1e-3;

/// The kinds of faults of a line; each is reported once, with its first line.
enum class LineFault { kCount, kNumber, kLost, kFinite, kRotation, kMirror };
constexpr std::size_t kLineFaults = 6;

struct FoundFault {
  int line = 0, lines = 0;
  std::string text;
};

/// What a line of another number of fields may be.
const char* likely_form(std::size_t fields) {
  switch (fields) {
    case 8:
      return " (a time and a quaternion, as TUM's files have?)";
    case 13:
      return " (a time or a number of the frame beside the pose?)";
    case 16:
      return " (a whole 4x4 matrix?)";
    default:
      return "";
  }
}

class SubmissionReader {
 public:
  explicit SubmissionReader(const std::string& path) : file_(path) {
    result_.poses.has_times = false;
    if (file_.position() > 0)
      result_.faults.push_back({1, "begins with a byte order mark, which is not part of a number"});
  }

  SubmittedPoses read() {
    std::string_view line;
    while (file_.next(line)) {
      split_blank(line, fields_);
      if (!fields_.empty())
        result_.poses.poses.push_back(
            {static_cast<std::int64_t>(result_.poses.size()), pose_of_line()});
    }
    if (result_.poses.poses.empty()) result_.faults.push_back({0, "holds no pose"});
    for (const FoundFault& fault : found_)
      if (fault.lines > 0)
        result_.faults.push_back({fault.line, fault.lines == 1
                                                  ? fault.text
                                                  : fmt::format("{} (likewise on {} lines in all)",
                                                                fault.text, fault.lines)});
    std::ranges::stable_sort(result_.faults, {}, &PoseFileFault::line);
    return std::move(result_);
  }

 private:
  std::nullopt_t fault(LineFault kind, std::string text) {
    FoundFault& found = found_[static_cast<std::size_t>(kind)];
    if (found.lines++ == 0) {
      found.line = file_.line();
      found.text = std::move(text);
    }
    return std::nullopt;
  }

  std::optional<Eigen::Isometry3d> pose_of_line() {
    if (fields_.size() != kNumbers)
      return fault(LineFault::kCount, fmt::format("{} numbers, not 12{}", fields_.size(),
                                                  likely_form(fields_.size())));
    Eigen::Isometry3d T_world_cam = Eigen::Isometry3d::Identity();
    std::size_t nans = 0, finite = 0;
    for (std::size_t i = 0; i < kNumbers; ++i) {
      const std::optional<double> value = parse_double(fields_[i]);
      if (!value)
        return fault(LineFault::kNumber,
                     in_quotes(fields_[i]) + " is not a number (blanks stand between numbers)");
      nans += std::isnan(*value);
      finite += std::isfinite(*value);
      T_world_cam.matrix()(static_cast<Eigen::Index>(i / 4), static_cast<Eigen::Index>(i % 4)) =
          *value;
    }
    if (nans == kNumbers)
      return fault(LineFault::kLost, "twelve nan: a lost frame needs a pose here, too");
    if (finite < kNumbers)
      return fault(LineFault::kFinite,
                   fmt::format("{} of 12 numbers are not finite", kNumbers - finite));
    return if_rotation(T_world_cam);
  }

  std::optional<Eigen::Isometry3d> if_rotation(const Eigen::Isometry3d& T_world_cam) {
    const Eigen::Matrix3d R = T_world_cam.linear();
    const double off = (R.transpose() * R - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
    const double determinant = R.determinant();
    if (off <= kSubmittedTolerance && determinant < 0)
      return fault(LineFault::kMirror, "the 3x3 part is a reflection: its determinant is -1");
    if (off > kSubmittedTolerance || std::abs(determinant - 1) > kSubmittedTolerance)
      return fault(LineFault::kRotation,
                   fmt::format("the 3x3 part is not a rotation (R^T R differs from 1 by {:.3g}, "
                               "determinant {:.6g})",
                               off, determinant));
    return T_world_cam;
  }

  TextFile file_;
  std::vector<std::string_view> fields_;
  std::array<FoundFault, kLineFaults> found_;
  SubmittedPoses result_;
};

}  // namespace

SubmittedPoses read_submitted_poses(const std::string& path) {
  return SubmissionReader(path).read();
}

}  // namespace placegraph
