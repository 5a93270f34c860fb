#pragma once
#include <placegraph/graph/geometry/se3.h>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// What a note is about; the code in result.json is that of to_string.
enum class NoteCause {
  kNone,            ///< information that casts no doubt on results
  kFewPosed,        ///< fewer frames have a pose than required
  kLostFrames,      ///< spans of frames have no pose
  kComponents,      ///< the map has several components in frames of their own
  kJump,            ///< the images jump from one place to another
  kScale,           ///< lengths contradict each other or are implausible
  kCameraHeight,    ///< the camera height above the ground
  kBaseline,        ///< the distance between the cameras
  kCamerasSwapped,  ///< the left and the right images are exchanged
  kRightImageLate,  ///< the right images were taken at another time
  kRightImage,      ///< the right images are not rectified, or show something else
  kDepthUnit,       ///< the unit of the depth images
  kDepthMismatch,   ///< the depth images do not belong to the images
  kCalibration,     ///< focal lengths or principal point
  kDistortion,      ///< lens distortion that the calibration does not contain
  kStaticOverlay,   ///< a region of the images is fixed to the camera
  kTimes,           ///< time stamps
  kImages,          ///< images are dark, blank, blurred or of few grey levels
  kRepeatedFrames,  ///< consecutive images are identical
  kUpsideDown,      ///< the camera is not upright
  kDrift            ///< the expected error at the end is large
};
/// The code of a cause in result.json, such as "static_overlay".
const char* to_string(NoteCause cause);
/// The cause with that code; nothing for another text.
std::optional<NoteCause> note_cause_of(std::string_view code);

/// A remark about input data or about a run.
/// It names the data that were left out and the reason, or the numbers that are suspicious and a
/// possible remedy.
struct DataNote {
  std::string text;                    ///< one line
  bool doubts_scale = false;           ///< lengths may be wrong: results must not be called metric
  NoteCause cause = NoteCause::kNone;  ///< what is in doubt
  std::string advice = {};             ///< what to try next, if the text does not say it
};

/// Covariance of the motion between two places by odometry alone.
///
/// It is in the right tangent of T_from_to.
struct OdometryError {
  Matrix6d independent = Matrix6d::Zero();  ///< if all steps err independently of each other
  /// By the errors that all steps share: of the calibration, and of the baseline, depth unit or
  /// camera height on which the scale rests. They grow in proportion to the motion.
  Matrix6d shared = Matrix6d::Zero();
};

/// How far the result of a run can be trusted.
enum class Verdict {
  kGood,      ///< nothing contradicts the result
  kDoubtful,  ///< a finding limits what the result can be used for
  kFailed     ///< too few frames have a pose
};
/// "good", "doubtful" or "failed".
const char* to_string(Verdict verdict);
/// The verdict of that name; nothing for another text.
std::optional<Verdict> verdict_of(std::string_view name);

/// Judgement of a run by its own evidence, without ground truth.
struct Judgement {
  Verdict verdict = Verdict::kGood;  ///< how far the result can be trusted
  bool metric = false;               ///< whether lengths are in metres: Map::metric of its map
  std::string why_metric;            ///< what gives the map its scale, or why it has none
  std::vector<DataNote> findings;    ///< what is in doubt, each with its cause and what to try next
  /// Standard deviation [m] of the position of the last place relative to the first one of its
  /// component, by the covariances of the place graph; nothing where it is open or not in metres.
  std::optional<double> expected_drift_m;
};

}  // namespace placegraph
