#include <placegraph/graph/core/error.h>
#include <placegraph/io/exports/gltf_scene.h>

#include <cstring>
#include <nlohmann/json.hpp>

namespace placegraph {
namespace gltf_scene_test {

using nlohmann::json;

GltfScene small_scene() {
  GltfScene scene;
  scene.title = "a \"map\"";
  scene.points.positions = {{1, 2, 3}, {-1, 5, 0.5}};
  scene.points.colours = {{255, 0, 1}, {2, 3, 4}};
  scene.lines.push_back({"path", {1, 0, 0}, {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}}, {}});
  scene.lines.push_back({"nothing", {1, 0, 0}, {}, {}});
  scene.lines.push_back({"views", {0, 0, 1}, {}, {{Eigen::Vector3d(0, 0, 0), {0, 0, 2}}}});
  return scene;
}

std::uint32_t number_at(const std::string& bytes, std::size_t at) {
  std::uint32_t number = 0;
  EXPECT_LE(at + 4, bytes.size());
  std::memcpy(&number, bytes.data() + at, 4);
  return number;
}

/// The JSON and the bytes of a .glb file.
std::pair<json, std::string> parts_of(const std::string& file) {
  EXPECT_EQ(file.substr(0, 4), "glTF");
  EXPECT_EQ(number_at(file, 4), 2u);
  EXPECT_EQ(number_at(file, 8), file.size());
  const std::size_t length = number_at(file, 12);
  EXPECT_EQ(file.substr(16, 4), "JSON");
  EXPECT_EQ(length % 4, 0u);
  EXPECT_EQ(number_at(file, 20 + length), file.size() - 28 - length);
  EXPECT_EQ(file.substr(24 + length, 4), std::string("BIN\0", 4));
  return {json::parse(file.substr(20, length)), file.substr(28 + length)};
}

/// The positions of a primitive.
std::vector<Eigen::Vector3f> positions_of(const json& gltf, const std::string& bytes,
                                          const json& primitive) {
  const json& accessor = gltf["accessors"][primitive["attributes"]["POSITION"].get<int>()];
  EXPECT_EQ(accessor["componentType"], 5126);
  EXPECT_EQ(accessor["type"], "VEC3");
  const json& view = gltf["bufferViews"][accessor["bufferView"].get<int>()];
  std::vector<Eigen::Vector3f> positions(accessor["count"].get<std::size_t>());
  EXPECT_EQ(view["byteLength"], positions.size() * 12);
  for (std::size_t i = 0; i < positions.size(); ++i)
    std::memcpy(positions[i].data(), bytes.data() + view["byteOffset"].get<std::size_t>() + 12 * i,
                12);
  return positions;
}

TEST(GltfScene, HasPointsStripsAndLines) {
  const auto [gltf, bytes] = parts_of(to_gltf(small_scene(), GltfForm::kGlb));
  EXPECT_EQ(gltf["asset"]["version"], "2.0");
  EXPECT_EQ(gltf["scenes"][0]["name"], "a \"map\"");
  EXPECT_EQ(gltf["scenes"][0]["nodes"], json::array({0}));
  EXPECT_EQ(gltf["nodes"][0]["rotation"], json::array({1, 0, 0, 0}));
  EXPECT_EQ(gltf["nodes"][0]["children"].size(), 3u);
  ASSERT_EQ(gltf["meshes"].size(), 3u);
  const auto primitive = [&](int mesh) { return gltf["meshes"][mesh]["primitives"].at(0); };
  EXPECT_EQ(primitive(0)["mode"], 0);
  EXPECT_EQ(primitive(1)["mode"], 3);
  EXPECT_EQ(primitive(2)["mode"], 1);
  EXPECT_EQ(gltf["meshes"][1]["name"], "path");
  EXPECT_EQ(gltf["meshes"][2]["name"], "views");
  EXPECT_EQ(positions_of(gltf, bytes, primitive(0))[1], Eigen::Vector3f(-1, 5, 0.5));
  EXPECT_EQ(positions_of(gltf, bytes, primitive(1))[2], Eigen::Vector3f(1, 1, 0));
  EXPECT_EQ(positions_of(gltf, bytes, primitive(2))[1], Eigen::Vector3f(0, 0, 2));
  const json& points = gltf["accessors"][primitive(0)["attributes"]["POSITION"].get<int>()];
  EXPECT_EQ(points["min"], json::array({-1, 2, 0.5}));
  EXPECT_EQ(points["max"], json::array({1, 5, 3}));
  const json& colours = gltf["accessors"][primitive(0)["attributes"]["COLOR_0"].get<int>()];
  EXPECT_EQ(colours["componentType"], 5121);
  EXPECT_EQ(colours["normalized"], true);
  const json& view = gltf["bufferViews"][colours["bufferView"].get<int>()];
  EXPECT_EQ(bytes.substr(view["byteOffset"].get<std::size_t>(), 8),
            std::string("\xff\x00\x01\xff\x02\x03\x04\xff", 8));
  EXPECT_EQ(gltf["buffers"][0]["byteLength"], bytes.size());
}

TEST(GltfScene, HasTheSameBytesInBase64) {
  const std::string text = to_gltf(small_scene(), GltfForm::kGltf);
  const json gltf = json::parse(text);
  const auto [in_container, bytes] = parts_of(to_gltf(small_scene(), GltfForm::kGlb));
  const std::string uri = gltf["buffers"][0]["uri"].get<std::string>();
  const std::string start = "data:application/octet-stream;base64,";
  ASSERT_EQ(uri.substr(0, start.size()), start);
  std::string decoded;
  std::uint32_t group = 0;
  int bits = 0;
  for (const char c : uri.substr(start.size())) {
    if (c == '=') break;
    const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    group = group << 6 | static_cast<std::uint32_t>(digits.find(c));
    bits += 6;
    if (bits < 8) continue;
    bits -= 8;
    decoded += static_cast<char>(group >> bits & 255);
  }
  EXPECT_EQ(decoded, bytes);
  EXPECT_EQ(gltf["accessors"], in_container["accessors"]);
}

TEST(GltfScene, MayBeEmpty) {
  const json gltf = json::parse(to_gltf({}, GltfForm::kGltf));
  EXPECT_FALSE(gltf.contains("meshes"));
  EXPECT_FALSE(gltf.contains("buffers"));
}

TEST(GltfScene, RefusesWhatDoesNotFit) {
  GltfScene scene = small_scene();
  scene.points.colours.pop_back();
  EXPECT_THROW(to_gltf(scene, GltfForm::kGlb), ArgumentError);
  scene = small_scene();
  scene.lines[0].strips[0].resize(1);
  EXPECT_THROW(to_gltf(scene, GltfForm::kGlb), ArgumentError);
}

TEST(GltfScene, SurfaceHasNormalsColoursAndIndices) {
  GltfScene scene;
  scene.surface.positions = {{0, 0, 0}, {1, 0, 0}, {0, 2, 0}};
  scene.surface.normals.assign(3, {0, 0, 1});
  scene.surface.rgb.assign(3, {9, 8, 7});
  scene.surface.faces = {{0, 1, 2}};
  const auto [description, bytes] = parts_of(to_gltf(scene, GltfForm::kGlb));
  const json& primitive = description["meshes"][0]["primitives"][0];
  EXPECT_EQ(primitive["mode"], 4);
  const json& indices = description["accessors"][primitive["indices"].get<std::size_t>()];
  EXPECT_EQ(indices["count"], 3);
  EXPECT_EQ(indices["componentType"], 5125);
  const json& view = description["bufferViews"][indices["bufferView"].get<std::size_t>()];
  EXPECT_EQ(view["target"], 34963);
  const auto at = view["byteOffset"].get<std::size_t>();
  for (std::uint32_t i = 0; i < 3; ++i) EXPECT_EQ(number_at(bytes, at + 4 * i), i);
  EXPECT_EQ(description["accessors"][primitive["attributes"]["NORMAL"].get<std::size_t>()]["count"],
            3);
}

}  // namespace gltf_scene_test
}  // namespace placegraph
