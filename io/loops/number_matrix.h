#pragma once
#include <cstddef>
#include <string>
#include <vector>

namespace placegraph {

/// A matrix of numbers, row by row.
struct NumberMatrix {
  std::size_t rows = 0, columns = 0;
  std::vector<double> values;
};

/// Whether a file's name ends in `.npy`.
bool is_npy(const std::string& path);

/// Reads a matrix of a `.npy` file of numbers, or of a text with any separator and an optional
/// header. A list is a matrix of one column. Throws FileError, with the line of a text: empty, not a
/// number, rows of different lengths, objects of Python.
NumberMatrix read_number_matrix(const std::string& path);

}  // namespace placegraph
