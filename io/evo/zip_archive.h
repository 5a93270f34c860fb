#pragma once
#include <cstddef>
#include <string>
#include <vector>

namespace placegraph {

/// A file in a zip archive.
struct ZipEntry {
  std::string name;   ///< with its folders in the archive
  std::string bytes;  ///< unpacked
};

/// How many bytes an archive may unpack to. Chosen: 10^7 errors with their times take 0.4 GB.
inline constexpr std::size_t kMostZipBytes = std::size_t{1} << 30;

/// Reads the files of a zip archive whose names have one of these endings; others stay packed.
///
/// Nothing is written to disk. Throws FileError, which names archive and entry, if it is no zip
/// archive, has more than 1000 entries or two of one name, or an entry is encrypted, damaged (by
/// its checksum) or larger than it says; and if all that is read exceeds `most_bytes`. No size that
/// stands in the archive sizes an allocation.
std::vector<ZipEntry> read_zip(const std::string& path, const std::vector<std::string>& endings,
                               std::size_t most_bytes = kMostZipBytes);

/// Writes a zip archive of these files, in their order; equal files give equal bytes.
/// The archive is replaced as a whole or not at all. Throws FileError if it cannot be written.
void write_zip(const std::string& path, const std::vector<ZipEntry>& entries);

}  // namespace placegraph
