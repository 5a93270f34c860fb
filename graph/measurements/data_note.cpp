#include <placegraph/graph/measurements/data_note.h>

namespace placegraph {

const char* to_string(NoteCause cause) {
  switch (cause) {
    case NoteCause::kNone:
      return "none";
    case NoteCause::kFewPosed:
      return "few_posed";
    case NoteCause::kLostFrames:
      return "lost_frames";
    case NoteCause::kComponents:
      return "components";
    case NoteCause::kJump:
      return "jump";
    case NoteCause::kScale:
      return "scale_questionable";
    case NoteCause::kCameraHeight:
      return "camera_height_questionable";
    case NoteCause::kBaseline:
      return "baseline_questionable";
    case NoteCause::kCamerasSwapped:
      return "cameras_swapped";
    case NoteCause::kRightImageLate:
      return "right_image_late";
    case NoteCause::kRightImage:
      return "right_image_unusable";
    case NoteCause::kDepthUnit:
      return "depth_unit_questionable";
    case NoteCause::kDepthMismatch:
      return "depth_mismatch";
    case NoteCause::kCalibration:
      return "calibration_questionable";
    case NoteCause::kDistortion:
      return "distortion_questionable";
    case NoteCause::kStaticOverlay:
      return "static_overlay";
    case NoteCause::kTimes:
      return "times_questionable";
    case NoteCause::kImages:
      return "images_unusable";
    case NoteCause::kRepeatedFrames:
      return "repeated_frames";
    case NoteCause::kUpsideDown:
      return "upside_down";
    case NoteCause::kDrift:
      return "drift_large";
  }
  return "none";
}

std::optional<NoteCause> note_cause_of(std::string_view code) {
  for (int cause = 0; cause <= static_cast<int>(NoteCause::kDrift); ++cause)
    if (code == to_string(static_cast<NoteCause>(cause))) return static_cast<NoteCause>(cause);
  return std::nullopt;
}

const char* to_string(Verdict verdict) {
  switch (verdict) {
    case Verdict::kGood:
      return "good";
    case Verdict::kDoubtful:
      return "doubtful";
    case Verdict::kFailed:
      return "failed";
  }
  return "failed";
}

std::optional<Verdict> verdict_of(std::string_view name) {
  for (const Verdict verdict : {Verdict::kGood, Verdict::kDoubtful, Verdict::kFailed})
    if (name == to_string(verdict)) return verdict;
  return std::nullopt;
}

}  // namespace placegraph
