#pragma once
#include <placegraph/graph/recognition/word_tree.h>

#include <string>

namespace [[gnu::visibility("default")]] placegraph {

/// Reads a vocabulary of visual words from one binary file.
///
/// It has "PGWORDS\n", then in 32 bits each, little-endian, the version of the format (1), the kind
/// (0 binary, 1 float), the dimension, the numbers of words and of nodes; then the nodes (first
/// child, children, word), the centres and the weights of the words. Throws FileError with the byte
/// of the fault: another kind of file, another version, truncated, data after its end, sizes that
/// do not fit the file, an invalid tree.
WordTree read_vocabulary(const std::string& path);

/// Writes atomically. Throws FileError; ArgumentError if the tree has a problem().
void write_vocabulary(const std::string& path, const WordTree& tree);

}  // namespace placegraph
