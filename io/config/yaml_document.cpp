#include <placegraph/graph/core/error.h>
#include <placegraph/io/config/yaml_document.h>
#include <placegraph/io/files/text_file.h>

#include <cmath>
#include <limits>

namespace placegraph {
namespace {

constexpr std::size_t kMaxBytes = std::size_t{1} << 24;

std::string read_text(const std::string& path) {
  TextFile file(path);
  std::string text;
  std::string_view line;
  while (file.next(line)) {
    // OpenCV's "%YAML:1.0" is not a valid directive of YAML.
    if (!line.starts_with("%YAML:")) text.append(line);
    text.push_back('\n');
    if (text.size() > kMaxBytes) throw FileError(path, "is larger than 16 MiB");
  }
  return text;
}

}  // namespace

int yaml_line(const YAML::Node& node) {
  if (!node.IsDefined()) return 0;
  const YAML::Mark mark = node.Mark();
  return mark.is_null() ? 0 : mark.line + 1;
}

std::optional<double> yaml_number(const YAML::Node& node) {
  if (!node.IsDefined() || !node.IsScalar() || node.Tag() == "!") return std::nullopt;
  const std::string& text = node.Scalar();
  if (text == ".inf" || text == "+.inf") return std::numeric_limits<double>::infinity();
  if (text == "-.inf") return -std::numeric_limits<double>::infinity();
  const std::optional<double> value = parse_double(text);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

YamlDocument::YamlDocument(std::string path) : path_(std::move(path)) { load(read_text(path_)); }

YamlDocument::YamlDocument(std::string path, const std::string& text) : path_(std::move(path)) {
  load(text);
}

void YamlDocument::load(const std::string& text) {
  try {
    const std::vector<YAML::Node> documents = YAML::LoadAll(text);
    if (documents.size() > 1) throw FileError(path_, "holds several YAML documents");
    if (!documents.empty()) root_ = documents[0];
  } catch (const YAML::Exception& error) {
    throw FileError(path_, error.mark.is_null() ? 0 : error.mark.line + 1, error.msg);
  }
}

void YamlDocument::fail(const YAML::Node& at, const std::string& message) const {
  throw FileError(path_, yaml_line(at), message);
}

YAML::Node YamlDocument::member(const YAML::Node& map, const std::string& key) const {
  if (!map.IsMap()) fail(map, "expected keys and values, among them " + key);
  const YAML::Node node = map[key];
  if (!node.IsDefined()) fail(map, key + ": is missing");
  return node;
}

double YamlDocument::number(const YAML::Node& map, const std::string& key) const {
  const YAML::Node node = member(map, key);
  const std::optional<double> value = yaml_number(node);
  if (!value || std::isinf(*value)) fail(node, key + ": is not a finite number");
  return *value;
}

std::optional<double> YamlDocument::optional_number(const YAML::Node& map,
                                                    const std::string& key) const {
  if (!map.IsMap() || !map[key].IsDefined()) return std::nullopt;
  return number(map, key);
}

std::string YamlDocument::text(const YAML::Node& map, const std::string& key) const {
  const YAML::Node node = member(map, key);
  if (!node.IsScalar()) fail(node, key + ": is not a text");
  return node.Scalar();
}

std::vector<double> YamlDocument::numbers(const YAML::Node& map, const std::string& key,
                                          std::size_t count) const {
  const YAML::Node node = member(map, key);
  const bool fits = node.IsSequence() && (count > 0 ? node.size() == count : node.size() <= 64);
  if (!fits) {
    fail(node, key + ": expected " + (count > 0 ? std::to_string(count) : "a list of at most 64") +
                   " numbers");
  }
  std::vector<double> values;
  for (const YAML::Node& element : node) {
    const std::optional<double> value = yaml_number(element);
    if (!value || std::isinf(*value)) fail(element, key + ": an element is not a finite number");
    values.push_back(*value);
  }
  return values;
}

}  // namespace placegraph
