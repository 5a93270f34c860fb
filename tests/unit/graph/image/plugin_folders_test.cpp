#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/graph/image/picture_plugin.h>
#include <placegraph/graph/image/plugin_folders.h>

#include <cstdlib>
#include <filesystem>
#include <set>

namespace placegraph {
namespace plugin_folders_test {

namespace fs = std::filesystem;

TEST(PluginFolders, TheNamedFolderStandsFirstAndTheBuildTreeSecond) {
  unsetenv("PLACEGRAPH_PLUGIN_DIR");
  const std::vector<std::string> usual = plugin_folders();
  ASSERT_GE(usual.size(), 3u);
  EXPECT_TRUE(fs::exists(fs::path(usual[0]) / kPicturePluginFile)) << usual[0];
  setenv("PLACEGRAPH_PLUGIN_DIR", "/some/where", 1);
  const std::vector<std::string> named = plugin_folders();
  unsetenv("PLACEGRAPH_PLUGIN_DIR");
  ASSERT_EQ(named.size(), usual.size() + 1);
  EXPECT_EQ(named[0], "/some/where");
  EXPECT_TRUE(std::equal(usual.begin(), usual.end(), named.begin() + 1));
}

TEST(PluginFolders, ThoseBesideTheProgramAreAmongThemAndNoneTwice) {
  const fs::path program = fs::read_symlink("/proc/self/exe");
  const std::vector<std::string> folders = plugin_folders();
  EXPECT_THAT(folders, testing::Contains((program.parent_path() / "placegraph").string()));
  EXPECT_EQ(std::set<std::string>(folders.begin(), folders.end()).size(), folders.size());
}

TEST(PluginFolders, AnEmptyNameIsNone) {
  unsetenv("PLACEGRAPH_PLUGIN_DIR");
  const std::vector<std::string> usual = plugin_folders();
  setenv("PLACEGRAPH_PLUGIN_DIR", "", 1);
  EXPECT_EQ(plugin_folders(), usual);
  unsetenv("PLACEGRAPH_PLUGIN_DIR");
}

}  // namespace plugin_folders_test
}  // namespace placegraph
