#include <placegraph/graph/core/error.h>
#include <placegraph/io/exports/base64.h>
#include <placegraph/io/exports/gltf_scene.h>
#include <placegraph/io/files/little_endian.h>

#include <nlohmann/json.hpp>

namespace placegraph {
namespace {

using GltfJson = nlohmann::ordered_json;

// Numbers of the format, glTF 2.0 specification.
constexpr int kGltfFloat = 5126, kGltfByte = 5121;  ///< accessor.componentType
constexpr int kGltfIndex = 5125;
constexpr int kGltfPoints = 0, kGltfLines = 1, kGltfStrip = 3,
              kGltfTriangles = 4;                           ///< primitive.mode
constexpr int kGltfVertices = 34962, kGltfIndices = 34963;  ///< bufferView.target

/// The JSON part and the bytes that it refers to.
class GltfDocument {
 public:
  explicit GltfDocument(const std::string& title) {
    json_["asset"] = {{"version", "2.0"}, {"generator", "placegraph"}};
    json_["extensionsUsed"] = GltfJson::array({"KHR_materials_unlit"});
    json_["scene"] = 0;
    json_["scenes"] = GltfJson::array({{{"name", title}, {"nodes", GltfJson::array({0})}}});
    // Half a rotation about x: the scene's y axis points down, that of the viewer up.
    json_["nodes"] = GltfJson::array({{{"name", "map"}, {"rotation", {1, 0, 0, 0}}}});
    for (const char* part : {"meshes", "materials", "accessors", "bufferViews"})
      json_[part] = GltfJson::array();
  }

  int add_material(const std::string& name, const std::array<double, 3>& rgb) {
    return add("materials", {{"name", name},
                             {"pbrMetallicRoughness",
                              {{"baseColorFactor", {rgb[0], rgb[1], rgb[2], 1.0}},
                               {"metallicFactor", 0.0},
                               {"roughnessFactor", 1.0}}},
                             {"extensions", {{"KHR_materials_unlit", GltfJson::object()}}}});
  }
  int add_positions(const std::vector<Eigen::Vector3d>& positions) {
    Eigen::Vector3f low = positions.front().cast<float>(), high = low;
    const std::size_t begin = bytes_.size();
    for (const Eigen::Vector3d& position : positions) {
      const Eigen::Vector3f p = position.cast<float>();
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
      for (int i = 0; i < 3; ++i) append_number(bytes_, float{p[i]});
    }
    return add("accessors", {{"bufferView", add_view(begin, 0)},
                             {"componentType", kGltfFloat},
                             {"count", positions.size()},
                             {"type", "VEC3"},
                             {"min", {low[0], low[1], low[2]}},
                             {"max", {high[0], high[1], high[2]}}});
  }
  int add_normals(const std::vector<Eigen::Vector3f>& normals) {
    const std::size_t begin = bytes_.size();
    for (const Eigen::Vector3f& normal : normals)
      for (int i = 0; i < 3; ++i) append_number(bytes_, float{normal[i]});
    return add("accessors", {{"bufferView", add_view(begin, 0)},
                             {"componentType", kGltfFloat},
                             {"count", normals.size()},
                             {"type", "VEC3"}});
  }
  int add_faces(const std::vector<std::array<std::int32_t, 3>>& faces) {
    const std::size_t begin = bytes_.size();
    for (const auto& face : faces)
      for (const std::int32_t corner : face) append_number(bytes_, corner);
    return add("accessors", {{"bufferView", add_view(begin, 0, kGltfIndices)},
                             {"componentType", kGltfIndex},
                             {"count", 3 * faces.size()},
                             {"type", "SCALAR"}});
  }
  int add_colours(const std::vector<std::array<std::uint8_t, 3>>& colours) {
    const std::size_t begin = bytes_.size();
    for (const auto& rgb : colours) {
      for (const std::uint8_t value : rgb) append_number(bytes_, value);
      append_number(bytes_, std::uint8_t{255});
    }
    return add("accessors", {{"bufferView", add_view(begin, 4)},
                             {"componentType", kGltfByte},
                             {"normalized", true},
                             {"count", colours.size()},
                             {"type", "VEC4"}});
  }
  void add_mesh(const std::string& name, GltfJson primitives) {
    const int mesh = add("meshes", {{"name", name}, {"primitives", std::move(primitives)}});
    json_["nodes"][0]["children"].push_back(add("nodes", {{"name", name}, {"mesh", mesh}}));
  }

  std::string text(GltfForm form) {
    while (bytes_.size() % 4 != 0) bytes_ += '\0';
    for (const char* part : {"meshes", "materials", "accessors", "bufferViews"})
      if (json_[part].empty()) json_.erase(part);
    if (!bytes_.empty()) {
      json_["buffers"] = GltfJson::array({GltfJson::object({{"byteLength", bytes_.size()}})});
      if (form == GltfForm::kGltf)
        json_["buffers"][0]["uri"] = "data:application/octet-stream;base64," + to_base64(bytes_);
    }
    std::string json = json_.dump(form == GltfForm::kGltf ? 1 : -1, ' ', false,
                                  GltfJson::error_handler_t::replace);
    return form == GltfForm::kGltf ? json + "\n" : container(std::move(json));
  }

 private:
  int add(const char* part, GltfJson value) {
    json_[part].push_back(std::move(value));
    return static_cast<int>(json_[part].size()) - 1;
  }
  int add_view(std::size_t begin, int stride, int target = kGltfVertices) {
    GltfJson view = {{"buffer", 0},
                     {"byteOffset", begin},
                     {"byteLength", bytes_.size() - begin},
                     {"target", target}};
    if (stride > 0) view["byteStride"] = stride;
    return add("bufferViews", std::move(view));
  }
  /// The binary container: a header, the JSON and the bytes, each of a length divisible by 4.
  std::string container(std::string json) const {
    constexpr std::uint32_t kMagic = 0x46546C67, kJson = 0x4E4F534A, kBytes = 0x004E4942;
    while (json.size() % 4 != 0) json += ' ';
    const std::size_t length = 12 + 8 + json.size() + (bytes_.empty() ? 0 : 8 + bytes_.size());
    require(length <= 0xffffffffU, "glTF: more than 4 GiB");
    std::string file;
    for (const std::uint32_t number : {kMagic, 2U, static_cast<std::uint32_t>(length),
                                       static_cast<std::uint32_t>(json.size()), kJson})
      append_number(file, number);
    file += json;
    if (bytes_.empty()) return file;
    append_number(file, static_cast<std::uint32_t>(bytes_.size()));
    append_number(file, kBytes);
    return file + bytes_;
  }

  GltfJson json_;
  std::string bytes_;
};

void add_gltf_lines(const GltfScene::Lines& lines, GltfDocument& document) {
  GltfJson primitives = GltfJson::array();
  std::vector<Eigen::Vector3d> ends;
  for (const auto& pair : lines.pairs) ends.insert(ends.end(), pair.begin(), pair.end());
  if (ends.empty() && lines.strips.empty()) return;
  const int material = document.add_material(lines.name, lines.rgb);
  const auto add_primitive = [&](const std::vector<Eigen::Vector3d>& positions, int mode) {
    primitives.push_back({{"attributes", {{"POSITION", document.add_positions(positions)}}},
                          {"mode", mode},
                          {"material", material}});
  };
  for (const auto& strip : lines.strips) {
    require(strip.size() >= 2, "glTF: a polyline of less than two points");
    add_primitive(strip, kGltfStrip);
  }
  if (!ends.empty()) add_primitive(ends, kGltfLines);
  document.add_mesh(lines.name, std::move(primitives));
}

void add_gltf_surface(const TriangleMesh& surface, GltfDocument& document) {
  if (surface.faces.empty()) return;
  const int material = document.add_material("surface", {1, 1, 1});
  const int positions = document.add_positions(surface.positions);
  const int normals = document.add_normals(surface.normals);
  const int colours = document.add_colours(surface.rgb);
  const int faces = document.add_faces(surface.faces);
  document.add_mesh(
      "surface",
      GltfJson::array(
          {{{"attributes", {{"POSITION", positions}, {"NORMAL", normals}, {"COLOR_0", colours}}},
            {"indices", faces},
            {"mode", kGltfTriangles},
            {"material", material}}}));
}

}  // namespace

std::string to_gltf(const GltfScene& scene, GltfForm form) {
  require(scene.points.positions.size() == scene.points.colours.size(),
          "glTF: there are not as many colours as points");
  GltfDocument document(scene.title);
  if (!scene.points.positions.empty()) {
    const int material = document.add_material("landmarks", {1, 1, 1});
    const int positions = document.add_positions(scene.points.positions);
    const int colours = document.add_colours(scene.points.colours);
    document.add_mesh(
        "landmarks",
        GltfJson::array({{{"attributes", {{"POSITION", positions}, {"COLOR_0", colours}}},
                          {"mode", kGltfPoints},
                          {"material", material}}}));
  }
  for (const GltfScene::Lines& lines : scene.lines) add_gltf_lines(lines, document);
  add_gltf_surface(scene.surface, document);
  return document.text(form);
}

}  // namespace placegraph
