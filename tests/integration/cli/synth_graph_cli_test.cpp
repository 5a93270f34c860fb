// `placegraph synth graph`.
#include "tests/support/cli_test.h"

namespace placegraph {
namespace synth_graph_cli_test {

namespace fs = std::filesystem;
using test::write_file;

class SynthGraphCli : public test::CliTest {};

TEST_F(SynthGraphCli, RefusesWhatDoesNotBelongTogether) {
  expect_usage_error("synth graph castle -o a.g2o", "castle: neither manhattan-walk");
  expect_usage_error("synth graph manhattan-walk --laps 2 -o a.g2o", "--laps is no option of");
  expect_usage_error("synth graph grid-world --closures 2 -o a.g2o", "--closures is no option");
  expect_usage_error("synth graph grid-world --3d -o a.g2o", "--3d is no option");
  expect_usage_error("synth graph long-loop --loop-share 1 -o a.g2o", "--loop-share is no option");
  expect_usage_error("synth graph long-loop --poses 0 -o a.g2o", "poses");
  write_file(dir / "in.g2o", "VERTEX_SE2 0 0 0 0\n");
  expect_usage_error("synth graph in.g2o -o a.g2o", "--rotation-noise");
  expect_usage_error("synth graph in.g2o --false-loops 3 -o a.g2o", "the graph has no loop");
  expect_usage_error("synth graph grid-world --false-loops -1 -o a.g2o",
                     "--false-loops: Value -1 not in range");
  expect_usage_error("synth graph grid-world --poses 2000000000 -o a.g2o",
                     "--poses: Value 2000000000 not in range");
  expect_usage_error("synth graph in.g2o --rotation-noise 1 --poses 3 -o a.g2o", "--poses");
  expect_usage_error("synth graph grid-world -o in.g2o", "--force");
  EXPECT_FALSE(fs::exists(dir / "a.g2o"));
}

}  // namespace synth_graph_cli_test
}  // namespace placegraph
