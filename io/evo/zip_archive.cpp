#include <fmt/format.h>
#include <minizip/unzip.h>
#include <minizip/zip.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/evo/zip_archive.h>
#include <placegraph/io/files/atomic_file.h>
#include <placegraph/io/files/text_file.h>
#include <zlib.h>

#include <algorithm>
#include <memory>
#include <set>

namespace placegraph {
namespace {

constexpr std::size_t kMostZipEntries = 1000;            ///< chosen: evo writes about ten
constexpr std::size_t kZipPiece = std::size_t{1} << 20;  ///< bytes that are unpacked at once
constexpr std::size_t kMostZipName = 4096;               ///< the longest path of most systems

struct ZipReader {
  explicit ZipReader(const std::string& path) : file(unzOpen64(path.c_str())) {}
  ~ZipReader() {
    if (file != nullptr) unzClose(file);
  }
  ZipReader(const ZipReader&) = delete;
  ZipReader& operator=(const ZipReader&) = delete;
  unzFile file;
};

[[noreturn]] void fail_in_zip(const std::string& path, const std::string& entry,
                              const std::string& message) {
  throw FileError(path, in_quotes(entry) + ": " + message);
}

/// Unpacks the present entry; with `before` bytes of others there may be `most`.
std::string unpacked(const ZipReader& zip, const std::string& path, const std::string& name,
                     std::size_t before, std::size_t most) {
  if (unzOpenCurrentFile(zip.file) != UNZ_OK)
    fail_in_zip(path, name, "is packed in a way that is not known");
  std::string bytes;
  for (int count = 1; count > 0;) {
    const std::size_t begin = bytes.size();
    bytes.resize(begin + kZipPiece);
    count = unzReadCurrentFile(zip.file, bytes.data() + begin, kZipPiece);
    bytes.resize(begin + static_cast<std::size_t>(std::max(count, 0)));
    if (count < 0) fail_in_zip(path, name, "is damaged");
    if (before + bytes.size() > most)
      throw FileError(path, fmt::format("unpacks to more than {} bytes", most));
  }
  if (unzCloseCurrentFile(zip.file) == UNZ_CRCERROR)
    fail_in_zip(path, name, "is damaged: its checksum is another one");
  return bytes;
}

std::string name_of_entry(const ZipReader& zip, const std::string& path) {
  unz_file_info64 info{};
  std::string name(kMostZipName, '\0');
  if (unzGetCurrentFileInfo64(zip.file, &info, name.data(), name.size(), nullptr, 0, nullptr, 0) !=
      UNZ_OK)
    throw FileError(path, "its list of entries is damaged");
  if (info.size_filename >= kMostZipName)
    throw FileError(path, "has an entry whose name is too long");
  name.resize(info.size_filename);
  if ((info.flag & 1) != 0) fail_in_zip(path, name, "is encrypted");
  return name;
}

}  // namespace

std::vector<ZipEntry> read_zip(const std::string& path, const std::vector<std::string>& endings,
                               std::size_t most_bytes) {
  require_input_file(path);
  const ZipReader zip(path);
  if (zip.file == nullptr) throw FileError(path, "cannot be opened as a zip archive");
  std::vector<ZipEntry> entries;
  std::set<std::string> names;
  std::size_t bytes = 0;
  int state = unzGoToFirstFile(zip.file);
  for (; state == UNZ_OK; state = unzGoToNextFile(zip.file)) {
    const std::string name = name_of_entry(zip, path);
    if (!names.insert(name).second) fail_in_zip(path, name, "stands twice in the archive");
    if (names.size() > kMostZipEntries)
      throw FileError(path, fmt::format("has more than {} entries", kMostZipEntries));
    if (std::ranges::none_of(endings, [&](const std::string& e) { return name.ends_with(e); }))
      continue;
    entries.push_back({name, unpacked(zip, path, name, bytes, most_bytes)});
    bytes += entries.back().bytes.size();
  }
  if (state != UNZ_END_OF_LIST_OF_FILE) throw FileError(path, "its list of entries is damaged");
  return entries;
}

void write_zip(const std::string& path, const std::vector<ZipEntry>& entries) {
  AtomicFile file(path);
  const zipFile zip = zipOpen64(file.temporary_path().c_str(), APPEND_STATUS_CREATE);
  bool written = zip != nullptr;
  zip_fileinfo info{};
  info.tmz_date.tm_year = 1980;  // the first that zip knows: no time is written
  info.tmz_date.tm_mday = 1;
  for (const ZipEntry& entry : entries) {
    constexpr int kLarge = 1;  // the form for 4 GiB and more, which all readers know
    const bool large = entry.bytes.size() >= 0xFFFFFFFF;
    written = written && zipOpenNewFileInZip64(zip, entry.name.c_str(), &info, nullptr, 0, nullptr,
                                               0, nullptr, Z_DEFLATED, Z_DEFAULT_COMPRESSION,
                                               large ? kLarge : 0) == ZIP_OK;
    for (std::size_t at = 0; written && at < entry.bytes.size(); at += kZipPiece)
      written = zipWriteInFileInZip(
                    zip, entry.bytes.data() + at,
                    static_cast<unsigned>(std::min(kZipPiece, entry.bytes.size() - at))) == ZIP_OK;
    written = written && zipCloseFileInZip(zip) == ZIP_OK;
  }
  if (zip != nullptr) written = zipClose(zip, nullptr) == ZIP_OK && written;
  if (!written) throw FileError(path, "cannot be written");
  file.commit();
}

}  // namespace placegraph
