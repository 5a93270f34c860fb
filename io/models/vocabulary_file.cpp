#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/files/atomic_file.h>
#include <placegraph/io/files/text_file.h>
#include <placegraph/io/models/vocabulary_file.h>

#include <array>
#include <bit>
#include <cstring>
#include <filesystem>
#include <fstream>

namespace placegraph {
namespace {

static_assert(std::endian::native == std::endian::little, "the file is read as it lies in memory");
static_assert(sizeof(WordTree::Node) == 12 && sizeof(BinaryDescriptor) == 32);

constexpr std::array<char, 8> kWordsMagic = {'P', 'G', 'W', 'O', 'R', 'D', 'S', '\n'};
constexpr std::uint32_t kWordsVersion = 1;

struct WordsHeader {
  std::array<char, 8> magic = kWordsMagic;
  std::uint32_t version = kWordsVersion, kind = 0, dimension = 0, words = 0, nodes = 0;
};
static_assert(sizeof(WordsHeader) == 28);

constexpr std::uint64_t kMostBytes = std::uint64_t{1} << 31;

template <class T>
void put(std::ofstream& stream, const std::vector<T>& values) {
  stream.write(reinterpret_cast<const char*>(values.data()),
               static_cast<std::streamsize>(values.size() * sizeof(T)));
}

template <class T>
void get(std::ifstream& stream, std::vector<T>& values, std::size_t count) {
  values.resize(count);
  stream.read(reinterpret_cast<char*>(values.data()),
              static_cast<std::streamsize>(count * sizeof(T)));
}

std::uint64_t size_of(const WordsHeader& h) {
  const std::uint64_t centre = h.kind == 0 ? sizeof(BinaryDescriptor) : 4ull * h.dimension;
  return sizeof(WordsHeader) + h.nodes * (sizeof(WordTree::Node) + centre) + 4ull * h.words;
}

WordsHeader read_header(std::ifstream& stream, const std::string& path, std::uint64_t size) {
  WordsHeader header;
  stream.read(reinterpret_cast<char*>(&header), sizeof(WordsHeader));
  const auto begin = static_cast<std::size_t>(stream.gcount());
  if (begin < kWordsMagic.size() || header.magic != kWordsMagic)
    throw FileError(path, "byte 0: not a vocabulary (it does not begin with PGWORDS)");
  if (begin < sizeof(WordsHeader))
    throw FileError(path, fmt::format("byte {}: ends within the header", begin));
  if (header.version != kWordsVersion)
    throw FileError(path, fmt::format("byte 8: version {} of a vocabulary; only {} is supported",
                                      header.version, kWordsVersion));
  if (header.kind > 1) throw FileError(path, fmt::format("byte 12: kind {}", header.kind));
  constexpr std::uint32_t kMostNumbers = 65536;
  if (header.kind == 1 && (header.dimension == 0 || header.dimension > kMostNumbers))
    throw FileError(path, fmt::format("byte 16: {} numbers a word", header.dimension));
  if (header.words == 0 || header.words > header.nodes || header.nodes > 1u << 30)
    throw FileError(path, fmt::format("byte 20: {} words, {} nodes", header.words, header.nodes));
  if (size > kMostBytes)
    throw FileError(path, fmt::format("{} bytes: a vocabulary is not larger than 2 GiB", size));
  if (size != size_of(header))
    throw FileError(path, fmt::format("byte {}: {}, and {} words of {} nodes take {}", size,
                                      size < size_of(header) ? "truncated" : "goes on too long",
                                      header.words, header.nodes, size_of(header)));
  return header;
}

}  // namespace

WordTree read_vocabulary(const std::string& path) {
  require_input_file(path);
  std::error_code error;
  const std::uint64_t size =
      std::filesystem::is_regular_file(path, error) ? std::filesystem::file_size(path, error) : 0;
  std::ifstream stream(path, std::ios::binary);
  if (error || !stream || !std::filesystem::is_regular_file(path))
    throw FileError(path, "cannot be read");
  const WordsHeader header = read_header(stream, path, size);
  WordTree tree;
  tree.kind = header.kind == 0 ? WordTree::Kind::kBinary : WordTree::Kind::kFloat;
  tree.dimension = header.kind == 0 ? 0 : static_cast<int>(header.dimension);
  tree.words = static_cast<int>(header.words);
  get(stream, tree.nodes, header.nodes);
  if (header.kind == 0)
    get(stream, tree.bit_centres, header.nodes);
  else
    get(stream, tree.centres, static_cast<std::size_t>(header.nodes) * header.dimension);
  get(stream, tree.idf, header.words);
  if (!stream) throw FileError(path, "cannot be read to its end");
  if (const auto problem = tree.problem()) throw FileError(path, "no tree of words: " + *problem);
  return tree;
}

void write_vocabulary(const std::string& path, const WordTree& tree) {
  if (const auto problem = tree.problem())
    throw ArgumentError("write_vocabulary: no tree of words: " + *problem);
  WordsHeader header;
  header.kind = tree.kind == WordTree::Kind::kBinary ? 0 : 1;
  header.dimension = static_cast<std::uint32_t>(tree.dimension);
  header.words = static_cast<std::uint32_t>(tree.words);
  header.nodes = static_cast<std::uint32_t>(tree.nodes.size());
  AtomicFile file(path);
  file.stream().write(reinterpret_cast<const char*>(&header), sizeof(WordsHeader));
  put(file.stream(), tree.nodes);
  put(file.stream(), tree.bit_centres);
  put(file.stream(), tree.centres);
  put(file.stream(), tree.idf);
  file.commit();
}

}  // namespace placegraph
