#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace placegraph::apps {

struct LinesTrackArguments {
  std::string sequence;               ///< data set
  std::string sensor = "auto";        ///< auto, mono, stereo or rgbd
  std::string cues = "lines";         ///< what the motion is seen by, lines among them
  std::vector<std::string> settings;  ///< "key=value", of the run
  std::string out;     ///< file of the tracks, `id frame u1 v1 u2 v2` a line [px]; empty: none
  bool force = false;  ///< overwrite `out`
};

/// What the true poses say of the sightings of lines.
struct LineTracksJudgement {
  std::size_t judged = 0;     ///< of lines whose place the true poses tell
  std::size_t wrong = 0;      ///< of those: not where the line is
  std::size_t undecided = 0;  ///< of other lines
  double wrong_percent() const;
};

struct LinesTrackResult {
  std::string sequence;                          ///< its name
  std::size_t tracks = 0;                        ///< lines that were followed
  double median_length_frames = 0;               ///< of the tracks
  std::size_t tracks_of_use = 0;                 ///< of three frames and more
  double median_length_of_use = 0;               ///< of those [frames]; 0 if there are none
  std::optional<LineTracksJudgement> judgement;  ///< where the sequence has true poses
};

/// `placegraph lines track`: runs a sequence and follows the straight edges through it; with true
/// poses, counts wrong ones. Throws ArgumentError, FileError, and NoAnswer where no line was
/// followed or the run was broken off; then nothing is written.
LinesTrackResult lines_track(const LinesTrackArguments& arguments);

/// One line.
std::string to_text(const LinesTrackResult& result);
std::string to_json(const LinesTrackResult& result);

}  // namespace placegraph::apps
