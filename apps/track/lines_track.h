#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace placegraph::apps {

struct LinesTrackArguments {
  std::string sequence;               ///< data set
  std::string sensor = "auto";        ///< auto, mono, stereo or rgbd
  std::string cues = "lines";         ///< cues of the motion estimate; they include lines
  std::vector<std::string> settings;  ///< options of the run, "key=value"
  std::string out;     ///< file for the tracks, `id frame u1 v1 u2 v2` per line [px]; empty: none
  bool force = false;  ///< overwrite `out`
};

/// Check of line observations against the true poses.
struct LineTracksJudgement {
  std::size_t judged = 0;     ///< observations of lines whose position follows from the true poses
  std::size_t wrong = 0;      ///< judged observations that are not on the line
  std::size_t undecided = 0;  ///< observations of other lines
  double wrong_percent() const;
};

struct LinesTrackResult {
  std::string sequence;             ///< name of the sequence
  std::size_t tracks = 0;           ///< number of line tracks
  double median_length_frames = 0;  ///< median length of all tracks [frames]
  std::size_t tracks_of_use = 0;    ///< tracks of at least three frames
  double median_length_of_use = 0;  ///< median length of those [frames]; 0 if there are none
  std::optional<LineTracksJudgement> judgement;  ///< set if the sequence has true poses
};

/// Tracks straight edges through a sequence: `placegraph track lines`.
/// With true poses, wrong observations are counted. Throws ArgumentError, FileError, and NoResult
/// if no line was tracked or the run was broken off; then nothing is written.
LinesTrackResult lines_track(const LinesTrackArguments& arguments);

/// One line.
std::string to_text(const LinesTrackResult& result);
std::string to_json(const LinesTrackResult& result);

}  // namespace placegraph::apps
