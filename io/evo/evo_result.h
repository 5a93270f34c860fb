#pragma once
#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// Numbers of a result of evo: a list (one column) or a matrix, row by row.
struct EvoArray {
  std::size_t rows = 0;        ///< length of the list, or rows of the matrix
  std::size_t columns = 1;     ///< columns of the matrix
  std::vector<double> values;  ///< rows * columns
};

/// A result of evo_ape or evo_rpe, as their `--save_results` writes it.
/// Names and units are evo's own: its label is "APE (m)", its statistics are rmse, mean, median,
/// standard deviation, minimum, maximum and sum of squares.
struct EvoResult {
  std::string title;      ///< what was measured and how it was aligned; may have several lines
  std::string label;      ///< name and unit of the errors
  std::string reference;  ///< name of the ground truth
  std::string estimate;   ///< name of the estimate
  std::vector<std::pair<std::string, double>> statistics;  ///< in the order of the file
  /// error_array, seconds_from_start, timestamps, distances_from_start, distances and others.
  std::map<std::string, EvoArray> arrays;
  /// Texts of trajectories by their names in the archive, which end in .tum or .kitti.
  std::map<std::string, std::string> trajectories;
};

/// Reads a result archive of evo (1.38.1 and earlier).
///
/// The zip archive has info.json, stats.json, arrays as .npy (older ones as .npz, with the same
/// bytes) and, where evo was asked to, the trajectories as .tum or .kitti. Nothing is unpacked to
/// disk, and no size that the archive states is trusted. Throws FileError, which names archive and
/// entry, if it is no such archive, an entry is missing or damaged, a statistic is no finite
/// number, or it unpacks to more than 1 GiB.
EvoResult read_evo_result(const std::string& path);

/// Writes a result archive that evo_res and evo's load_res_file() read.
///
/// The file is replaced as a whole or not at all. Throws FileError if it cannot be written, and
/// ArgumentError for a statistic that is not finite, an array whose number of values is not rows *
/// columns, and a trajectory whose name does not end in .tum or .kitti.
void write_evo_result(const std::string& path, const EvoResult& result);

/// Whether the file is a zip archive, by its first bytes; false if it cannot be read.
bool is_zip_archive(const std::string& path);

}  // namespace placegraph
