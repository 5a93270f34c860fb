#include <placegraph/graph/core/error.h>
#include <placegraph/io/files/text_file.h>
#include <placegraph/io/measurements/class_list.h>

#include <algorithm>

namespace placegraph {

std::vector<SceneClass> read_class_list(const std::string& path) {
  constexpr std::int64_t kLargest = 254;
  TextFile file(path);
  std::vector<SceneClass> classes;
  std::string_view line;
  std::vector<std::string_view> fields;
  while (file.next_data(line)) {
    split_blank(line, fields);
    if (fields.size() != 3)
      file.fail(std::to_string(fields.size()) + " columns, expected: number name surface");
    const std::int64_t id = file.integer(fields[0], "number");
    if (id < 0 || id > kLargest)
      file.fail("number: " + in_quotes(fields[0]) + " is not the number of a class");
    SceneClass read{static_cast<int>(id), std::string(fields[1]),
                    surface_of_name(std::string(fields[2]))};
    if (!read.surface && fields[2] != "-")
      file.fail("surface: " + in_quotes(fields[2]) +
                " is neither sky, ground, vertical, object nor -");
    const auto same = [&](const SceneClass& c) {
      return c.id == read.id || (c.name == read.name && c.surface != read.surface);
    };
    if (std::any_of(classes.begin(), classes.end(), same))
      file.fail("class " + std::to_string(read.id) + " " + in_quotes(read.name) +
                " is there already");
    classes.push_back(std::move(read));
  }
  if (std::none_of(classes.begin(), classes.end(),
                   [](const SceneClass& c) { return c.surface.has_value(); }))
    throw FileError(path, "no class is scored");
  std::sort(classes.begin(), classes.end(),
            [](const SceneClass& a, const SceneClass& b) { return a.id < b.id; });
  return classes;
}

}  // namespace placegraph
