// A module of an older version.
#include <cstdint>

extern "C" [[gnu::visibility("default")]] std::int64_t placegraph_picture_plugin_version() {
  return 7;
}
extern "C" [[gnu::visibility("default")]] const void* placegraph_picture_plugin() {
  return nullptr;
}
