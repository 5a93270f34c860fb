#pragma once
#include <cstddef>
#include <string>
#include <vector>

namespace placegraph {

/// Numbers of a `.npy` file of numpy: a list, or a matrix row by row.
struct NpyArray {
  std::vector<std::size_t> shape;  ///< one size for a list, two for a matrix, none for a number
  std::vector<double> values;      ///< as many as the product of the sizes
};

/// Reads the bytes of a `.npy` file of versions 1 to 3.
///
/// Floats of 4 and 8 bytes, integers of 1 to 8 bytes and truth values, little-endian; in the order
/// of C or of Fortran. `what` names the file in messages. Throws FileError for another type (objects
/// are never unpickled), more than two dimensions, a damaged header, or a number of bytes that is not
/// the one of the shape.
NpyArray read_npy(const std::string& bytes, const std::string& what);

/// The bytes of a `.npy` file, version 1, of 8-byte floats.
/// Throws ArgumentError if the number of values is not that of the shape.
std::string to_npy(const NpyArray& array);

}  // namespace placegraph
