#pragma once

namespace placegraph::apps {

// Types of options that are paths: what the command writes, and what it reads. Those that are
// checked to exist (CLI::ExistingPath and the like) are read, too. See shell/path_options.h.
inline constexpr const char* kOutput = "OUTPUT";
inline constexpr const char* kInput = "INPUT";
inline constexpr const char* kInputFile = "INPUT:FILE";  ///< or the name of what is installed

// Descriptions of flags that several commands share.
inline constexpr const char* kJsonText = "print the result as JSON";
inline constexpr const char* kForceText = "overwrite existing outputs";
inline constexpr const char* kIdsText =
    "write the numbers of classes, planes or axes, not colours with a legend";
inline constexpr const char* kSeedText = "seed of the random numbers";
inline constexpr const char* kSetText = "set one option, key=value; may be repeated";
inline constexpr const char* kThreadsText = "number of threads; the result does not depend on it";
inline constexpr const char* kMapText = "map.db, or a folder written by `placegraph run`";
inline constexpr const char* kRangeText = "first and last image to use, counted from 0";
inline constexpr const char* kSequenceText =
    "the images are consecutive: use the evidence of neighbouring images";
inline constexpr const char* kSensorText = "sensor to assume; auto takes the best that is recorded";
inline constexpr const char* kTimesText = "file of times, one per line [s]";
inline constexpr const char* kApplyText =
    "steps that change the trajectory first, as \"crop 10:60; downsample 0.5m\": docs/datasets.md "
    "lists them";
inline constexpr const char* kReportText = "file for a page that shows the result in a browser";
inline constexpr const char* kPlotText = "draw the result as .png, .svg or .pdf";
inline constexpr const char* kConfigText =
    "YAML file of options, or the name of an installed one; see `placegraph config`";
inline constexpr const char* kModelText = "model to use instead of the installed one";
inline constexpr const char* kCameraHeightText = "height of the camera above the ground [m]";
inline constexpr const char* kRecognizerText =
    "recognizer of yours: exec:COMMAND, onnx:FILE or descriptors:FILE.npy; see docs/recognizers.md";
inline constexpr const char* kAppearanceText =
    "appearance features to compare, joined by commas; with --recognizer: beside it";
inline constexpr const char* kProfileText = "print the CPU time of every stage";

}  // namespace placegraph::apps
