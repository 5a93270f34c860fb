#pragma once
#include <array>
#include <string>
#include <utility>

namespace [[gnu::visibility("default")]] placegraph {

/// Whether an estimator's result may be used, and if not, why.
/// It is the first member of every result struct whose computation the data may not allow; the
/// evidence beside it (inliers, condition, residual) is always filled. Test it before the estimate
/// is used: `if (!result.outcome) ...`.
struct [[nodiscard]] Outcome {
  /// The kind of failure, for programs that treat kinds differently.
  enum class Code {
    kOk,            ///< the estimate may be used
    kTooFewData,    ///< fewer measurements than the method needs
    kNoConsensus,   ///< RANSAC found no model with enough support
    kDegenerate,    ///< the measurements leave the wanted quantity unobservable
    kNotConverged,  ///< the iteration stopped without reaching a minimum
    kInconsistent,  ///< an estimate exists but contradicts a prior or a gate
    kNotAttempted,  ///< the default: nothing was computed yet
  };

  Code code = Code::kNotAttempted;  ///< the kind of outcome; `if (outcome)` tests for kOk
  std::string reason;               ///< one readable line; empty if ok

  /// True if the estimate may be used.
  explicit operator bool() const { return code == Code::kOk; }

  /// Success, without a reason.
  static Outcome ok() { return {Code::kOk, {}}; }
  /// Failure of the given kind; `reason` is one line with the value found and the value needed.
  static Outcome failure(Code code, std::string reason) { return {code, std::move(reason)}; }
};

/// What speaks against a result although there is one.
enum class DoubtKind {
  kChi2Above,       ///< chi2 of a graph is far above what its information lets expect
  kChi2Below,       ///< chi2 of a graph is far below what its information lets expect
  kNotUnique,       ///< constraints leave directions of a graph free
  kLoopsNotJudged,  ///< too few loops of a graph agree for a robust method to judge them
  kHeldComponents,  ///< components of a graph have no reference but a node that is held
  kGraphFile,       ///< a graph's file has lines or words that are passed over
  kTrajectories,    ///< times or axes of an estimate look like another convention
  kNotJudged,       ///< predictions of loops for images without ground truth are not judged
  kScoreOrder,      ///< the smaller scores of a recognizer seem to be the more certain ones
  kHeadings,        ///< the headings of true poses are unknown, or all the same
  kQueryRefused,    ///< an image that should be localized is refused unread
  kRecording,       ///< images, calibration or motion of a recording are not as they should be
  kRetiredOption,   ///< an option of a file is a constant now
};
/// All kinds, in their order.
inline constexpr std::array kDoubtKinds = {
    DoubtKind::kChi2Above,      DoubtKind::kChi2Below,      DoubtKind::kNotUnique,
    DoubtKind::kLoopsNotJudged, DoubtKind::kHeldComponents, DoubtKind::kGraphFile,
    DoubtKind::kTrajectories,   DoubtKind::kNotJudged,      DoubtKind::kScoreOrder,
    DoubtKind::kHeadings,       DoubtKind::kQueryRefused,   DoubtKind::kRecording,
    DoubtKind::kRetiredOption};
/// The name of a kind: "chi2_above", "chi2_below" and so on.
const char* to_string(DoubtKind kind);

/// A doubt about a result: commands print it as a warning, the Python package warns with it.
struct Doubt {
  DoubtKind kind;    ///< the subject
  std::string text;  ///< one readable line: the value found, and what it may mean
};

/// The name of a code: "ok", "too few data", "no consensus", "degenerate" and so on.
const char* to_string(Outcome::Code code);

}  // namespace placegraph
