#include "apps/map/map_import.h"

#include <gtest/gtest.h>

namespace placegraph::apps {
namespace map_import_test {

TEST(MapImport, SaysWhatTheMapHolds) {
  MapImportResult result{.out = "a.db", .keyframes = 5, .frames = 7, .landmarks = 80};
  result.observations = 400;
  EXPECT_EQ(to_text(result), "a.db: 5 keyframes of 7 frames, 80 landmarks, 400 observations\n");
}

}  // namespace map_import_test
}  // namespace placegraph::apps
