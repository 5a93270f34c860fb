#pragma once
#include <placegraph/io/exports/number_form.h>

#include <cstddef>
#include <string>
#include <vector>

namespace placegraph {

/// Property of an element of a PLY file.
struct PlyProperty {
  const char* type;  ///< such as "float" or "list uchar int"
  const char* name;
};

/// Element of a PLY file.
struct PlyElement {
  const char* name;
  std::size_t count;
  std::vector<PlyProperty> properties;
};

/// The header of a PLY file. Throws ArgumentError for a comment with a line end.
std::string ply_header(NumberForm form, const std::vector<std::string>& comments,
                       const std::vector<PlyElement>& elements);

}  // namespace placegraph
