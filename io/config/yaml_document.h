#pragma once
// Inside io only: the one header that names yaml-cpp.
#include <yaml-cpp/yaml.h>

#include <optional>
#include <string>
#include <vector>

namespace placegraph {

/// A YAML file of one document, with errors that name file and line. Throws FileError if it is
/// missing, larger than 16 MiB, not YAML, or of several documents. An empty file is a null root.
class YamlDocument {
 public:
  explicit YamlDocument(std::string path);
  /// Parses a text; errors name `path`.
  YamlDocument(std::string path, const std::string& text);

  const YAML::Node& root() const { return root_; }
  const std::string& path() const { return path_; }
  [[noreturn]] void fail(const YAML::Node& at, const std::string& message) const;

  /// Members of a map, by key; FileError if they are absent (all but `optional_`) or of another
  /// type.
  YAML::Node member(const YAML::Node& map, const std::string& key) const;
  double number(const YAML::Node& map, const std::string& key) const;
  std::optional<double> optional_number(const YAML::Node& map, const std::string& key) const;
  std::string text(const YAML::Node& map, const std::string& key) const;
  /// Exactly `count` finite numbers, or any number of them up to 64 if `count` is 0.
  std::vector<double> numbers(const YAML::Node& map, const std::string& key,
                              std::size_t count) const;

 private:
  void load(const std::string& text);
  std::string path_;
  YAML::Node root_;
};

/// 1-based line of a node, 0 if it has none.
int yaml_line(const YAML::Node& node);

/// The finite number or .inf in a plain scalar; nothing for quoted ones, nan and other text.
std::optional<double> yaml_number(const YAML::Node& node);

}  // namespace placegraph
