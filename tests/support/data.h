#pragma once
#include <cstdlib>
#include <filesystem>
#include <string>

#include "tests/support/paths.h"

namespace placegraph::test {

/// The folder of research data: PLACEGRAPH_DATA, else ../shared/data beside the project; empty if
/// neither exists.
inline std::string data_dir() {
  if (const char* dir = std::getenv("PLACEGRAPH_DATA")) return dir;
  const std::filesystem::path beside =
      std::filesystem::path(source_dir()) / ".." / "shared" / "data";
  return std::filesystem::is_directory(beside) ? beside.string() : std::string();
}

/// The folder of inputs from the field, with their right values: PLACEGRAPH_CASES, else
/// ../shared/cases beside the project.
inline std::string cases_dir() {
  if (const char* dir = std::getenv("PLACEGRAPH_CASES")) return dir;
  return (std::filesystem::path(source_dir()) / ".." / "shared" / "cases").string();
}

}  // namespace placegraph::test

/// Skips the test with a message unless the folder of cases has this one.
#define PLACEGRAPH_CASE_OR_SKIP(name)                                                          \
  if (!std::filesystem::exists(std::filesystem::path(placegraph::test::cases_dir()) / (name))) \
  GTEST_SKIP() << "case absent: " << (name)

/// Skips the test with a message unless data_dir()/relative exists; defines `name` as its path.
#define PLACEGRAPH_DATA_OR_SKIP(name, relative)                             \
  const std::string name = placegraph::test::data_dir() + "/" + (relative); \
  if (!std::filesystem::exists(name)) GTEST_SKIP() << "research data absent: " << (relative)
