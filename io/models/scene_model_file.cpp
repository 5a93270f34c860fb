#include <fmt/format.h>
#include <placegraph/graph/core/error.h>
#include <placegraph/io/files/atomic_file.h>
#include <placegraph/io/files/text_file.h>
#include <placegraph/io/models/scene_model_file.h>

#include <array>
#include <bit>
#include <cstring>
#include <filesystem>
#include <fstream>

namespace placegraph {
namespace {

static_assert(std::endian::native == std::endian::little,
              "numbers are written as they lie in memory");

constexpr std::array<char, 8> kSceneMagic = {'P', 'G', 'S', 'C', 'E', 'N', 'E', '\n'};
/// Version of the format and of the features: 2 has superpixels of 10 pixels, 1 of 14.
constexpr std::uint32_t kSceneVersion = 2;

struct SceneHeader {
  std::array<char, 8> magic = kSceneMagic;
  std::uint32_t version = kSceneVersion, bytes = 0, crc = 0;
};
static_assert(sizeof(SceneHeader) == 20);

/// CRC-32 of PNG and zip.
std::uint32_t crc_of(const std::vector<char>& bytes) {
  std::uint32_t crc = ~0u;
  for (const char byte : bytes) {
    crc ^= static_cast<std::uint8_t>(byte);
    for (int bit = 0; bit < 8; ++bit) crc = crc & 1u ? crc >> 1 ^ 0xedb88320u : crc >> 1;
  }
  return ~crc;
}

class Writer {
 public:
  template <class T>
  void put(const T& value) {
    const auto* begin = reinterpret_cast<const char*>(&value);
    bytes.insert(bytes.end(), begin, begin + sizeof(T));
  }
  void put_text(const std::string& text) {
    put(static_cast<std::uint32_t>(text.size()));
    bytes.insert(bytes.end(), text.begin(), text.end());
  }
  std::vector<char> bytes;
};

/// Reads the payload; throws FileError if it ends too early. Its CRC is right, so the writer was
/// wrong.
class Reader {
 public:
  Reader(const std::string& path, const std::vector<char>& bytes) : path_(path), bytes_(bytes) {}
  template <class T>
  T get() {
    T value;
    std::memcpy(&value, take(sizeof(T)), sizeof(T));
    return value;
  }
  std::string get_text() {
    const auto size = get<std::uint32_t>();
    return {take(size), size};
  }
  bool at_end() const { return at_ == bytes_.size(); }

 private:
  const char* take(std::size_t size) {
    if (bytes_.size() - at_ < size) throw FileError(path_, "a model that ends too early");
    at_ += size;
    return bytes_.data() + at_ - size;
  }
  const std::string& path_;
  const std::vector<char>& bytes_;
  std::size_t at_ = 0;
};

// A node is written as its feature and threshold, a leaf as a mark, the bits of the classes with a
// share, and these shares. The order determines where the other branch begins.
void put_forest(Writer& out, const DecisionForest& forest) {
  const auto n = static_cast<std::size_t>(forest.classes);
  out.put(static_cast<std::uint32_t>(forest.dimension));
  out.put(static_cast<std::uint32_t>(forest.roots.size()));
  out.put(static_cast<std::uint32_t>(forest.nodes.size()));
  for (const DecisionForest::Node& node : forest.nodes) {
    out.put(node.feature);
    if (node.feature != DecisionForest::kLeaf) {
      out.put(static_cast<std::uint8_t>(node.threshold));
      continue;
    }
    const std::uint8_t* shares = forest.leaves.data() + node.other * n;
    for (std::size_t begin = 0; begin < n; begin += 8) {
      std::uint8_t mask = 0;
      for (std::size_t c = begin; c < std::min(begin + 8, n); ++c)
        if (shares[c] != 0) mask = static_cast<std::uint8_t>(mask | 1u << (c - begin));
      out.put(mask);
    }
    for (std::size_t c = 0; c < n; ++c)
      if (shares[c] != 0) out.put(shares[c]);
  }
}

void get_leaf(Reader& in, DecisionForest& forest, DecisionForest::Node& node) {
  const auto n = static_cast<std::size_t>(forest.classes);
  node.other = static_cast<std::uint32_t>(forest.leaves.size() / n);
  std::vector<std::uint8_t> masks((n + 7) / 8);
  for (std::uint8_t& mask : masks) mask = in.get<std::uint8_t>();
  for (std::size_t c = 0; c < n; ++c)
    forest.leaves.push_back((masks[c / 8] >> (c % 8) & 1u) != 0 ? in.get<std::uint8_t>()
                                                                : std::uint8_t{0});
}

DecisionForest get_forest(Reader& in, int classes, const std::string& path) {
  DecisionForest forest;
  forest.classes = classes;
  forest.dimension = static_cast<int>(in.get<std::uint32_t>() & 0xffffu);
  const auto trees = in.get<std::uint32_t>(), nodes = in.get<std::uint32_t>();
  std::vector<std::uint32_t> open;  // nodes whose other branch has not begun
  bool begins_tree = true;
  for (std::uint32_t i = 0; i < nodes; ++i) {
    if (begins_tree) forest.roots.push_back(i);
    begins_tree = false;
    DecisionForest::Node node;
    node.feature = in.get<std::uint16_t>();
    if (node.feature != DecisionForest::kLeaf) {
      node.threshold = in.get<std::uint8_t>();
      open.push_back(i);
    } else {
      get_leaf(in, forest, node);
      begins_tree = open.empty();
      if (!open.empty()) {
        forest.nodes[open.back()].other = i + 1;
        open.pop_back();
      }
    }
    forest.nodes.push_back(node);
  }
  if (!open.empty() || forest.roots.size() != trees)
    throw FileError(path, "a forest whose trees do not end");
  return forest;
}

std::vector<char> payload_of(const std::string& path) {
  constexpr std::uint32_t kMostBytes = 1u << 30;
  require_input_file(path);
  std::ifstream stream(path, std::ios::binary);
  if (!stream || !std::filesystem::is_regular_file(path)) throw FileError(path, "cannot be read");
  SceneHeader header;
  stream.read(reinterpret_cast<char*>(&header), sizeof(SceneHeader));
  const auto begin = static_cast<std::size_t>(stream.gcount());
  if (begin < kSceneMagic.size() || header.magic != kSceneMagic)
    throw FileError(path, "byte 0: not a scene model (it does not begin with PGSCENE)");
  if (begin < sizeof(SceneHeader))
    throw FileError(path, fmt::format("byte {}: ends within the header", begin));
  if (header.version != kSceneVersion)
    throw FileError(path, fmt::format("byte 8: version {} of a scene model; only {} is supported",
                                      header.version, kSceneVersion));
  const std::uint64_t size = std::filesystem::file_size(path),
                      whole = sizeof(SceneHeader) + std::uint64_t{header.bytes};
  if (size != whole)
    throw FileError(path, fmt::format("byte {}: {}, the header says {} bytes", size,
                                      size < whole ? "truncated" : "goes on too long", whole));
  if (header.bytes > kMostBytes)
    throw FileError(path, fmt::format("{} bytes: a scene model is not larger than 1 GiB", size));
  std::vector<char> payload(header.bytes);
  stream.read(payload.data(), static_cast<std::streamsize>(payload.size()));
  if (!stream) throw FileError(path, "cannot be read to its end");
  if (const std::uint32_t crc = crc_of(payload); crc != header.crc)
    throw FileError(path, fmt::format("changed since it was written: its CRC is {:08x}, not {:08x}",
                                      crc, header.crc));
  return payload;
}

std::vector<float> get_table(Reader& in, std::size_t count) {
  std::vector<float> table;
  for (std::size_t i = 0; i < count; ++i) table.push_back(in.get<float>());
  return table;
}

}  // namespace

SceneModel read_scene_model(const std::string& path) {
  const std::vector<char> payload = payload_of(path);
  Reader in(path, payload);
  SceneModel model;
  const auto kind = in.get<std::uint32_t>(), classes = in.get<std::uint32_t>();
  if (kind > 1 || classes < 2 || classes > 64)
    throw FileError(path, fmt::format("kind {} of {} classes", kind, classes));
  model.kind = static_cast<SceneModel::Kind>(kind);
  for (std::uint32_t c = 0; c < classes; ++c) {
    model.classes.push_back(in.get_text());
    const auto surface = in.get<std::uint8_t>();
    if (surface >= kSurfaceCount)
      throw FileError(path, fmt::format("a class of surface {}", surface));
    model.surfaces.push_back(static_cast<Surface>(surface));
  }
  model.origin = in.get_text();
  model.smoothness = in.get<float>();
  model.relation_weight = in.get<float>();
  model.sharpness = in.get<float>();
  model.relations.above = get_table(in, std::size_t{classes} * classes);
  model.relations.beside = get_table(in, std::size_t{classes} * classes);
  model.first = get_forest(in, model.class_count(), path);
  model.second = get_forest(in, model.class_count(), path);
  if (!in.at_end()) throw FileError(path, "a model that goes on too long");
  if (const auto problem = model.problem()) throw FileError(path, "no model: " + *problem);
  return model;
}

void write_scene_model(const std::string& path, const SceneModel& model) {
  if (const auto problem = model.problem())
    throw ArgumentError("write_scene_model: no model: " + *problem);
  Writer out;
  out.put(static_cast<std::uint32_t>(model.kind));
  out.put(static_cast<std::uint32_t>(model.classes.size()));
  for (std::size_t c = 0; c < model.classes.size(); ++c) {
    out.put_text(model.classes[c]);
    out.put(static_cast<std::uint8_t>(model.surfaces[c]));
  }
  out.put_text(model.origin);
  out.put(model.smoothness);
  out.put(model.relation_weight);
  out.put(model.sharpness);
  for (const std::vector<float>* table : {&model.relations.above, &model.relations.beside})
    for (const float value : *table) out.put(value);
  put_forest(out, model.first);
  put_forest(out, model.second);
  SceneHeader header;
  header.bytes = static_cast<std::uint32_t>(out.bytes.size());
  header.crc = crc_of(out.bytes);
  AtomicFile file(path);
  file.stream().write(reinterpret_cast<const char*>(&header), sizeof(SceneHeader));
  file.stream().write(out.bytes.data(), static_cast<std::streamsize>(out.bytes.size()));
  file.commit();
}

}  // namespace placegraph
