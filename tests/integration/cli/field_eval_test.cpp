#include <nlohmann/json.hpp>

#include "tests/support/cli_test.h"
#include "tests/support/data.h"

namespace placegraph {
namespace field_eval_test {

using nlohmann::json;
using testing::HasSubstr;

/// Figures that were computed elsewhere for trajectories as people have them; see the texts beside
/// the files. Negative: not checked, or none is to be given.
struct FieldEvaluation {
  const char* folder;
  const char* truth;
  const char* estimate;
  const char* options;
  double ate_m, rpe_m, rpe_deg;
};

void PrintTo(const FieldEvaluation& e, std::ostream* out) { *out << e.folder << " " << e.estimate; }

class FieldEvaluations : public test::CliTest, public testing::WithParamInterface<FieldEvaluation> {
 protected:
  /// The figures, or a skipped test.
  json figures(const FieldEvaluation& e) {
    const std::string folder = test::cases_dir() + "/" + e.folder + "/";
    const test::CommandResult result = run(std::string("eval ") + folder + e.truth + " " + folder +
                                           e.estimate + " --json " + e.options);
    EXPECT_EQ(result.code, 0) << result.err;
    return json::parse(result.out);
  }
};

TEST_P(FieldEvaluations, GiveTheRightFigures) {
  const FieldEvaluation& e = GetParam();
  PLACEGRAPH_CASE_OR_SKIP(e.folder);
  const json found = figures(e);
  EXPECT_NEAR(found["ate_rmse_m"].get<double>(), e.ate_m, 1e-6);
  if (e.rpe_m < 0) {
    EXPECT_TRUE(found["rpe_trans_m"].is_null() || e.rpe_m == -2);
    return;
  }
  EXPECT_NEAR(found["rpe_trans_m"].get<double>(), e.rpe_m, 1e-6);
  EXPECT_NEAR(found["rpe_rot_deg"].get<double>(), e.rpe_deg, 1e-6);
}

constexpr double kAte = 0.047899, kRpe = 0.026393, kRpeDeg = 0.151578;

INSTANTIATE_TEST_SUITE_P(
    Files, FieldEvaluations,
    testing::Values(
        FieldEvaluation{"eval_byte_order_mark", "truth.tum", "bom.tum", "", kAte, kRpe, kRpeDeg},
        FieldEvaluation{"eval_byte_order_mark", "truth.tum", "bom_comment.tum", "", kAte, kRpe,
                        kRpeDeg},
        FieldEvaluation{"eval_byte_order_mark", "truth.tum", "bom.csv", "", kAte, kRpe, kRpeDeg},
        FieldEvaluation{"eval_byte_order_mark", "truth.kitti", "bom.kitti", "", kAte, kRpe,
                        kRpeDeg},
        FieldEvaluation{"eval_commas_between_numbers", "truth.tum", "tum_commas.csv", "", kAte,
                        kRpe, kRpeDeg},
        FieldEvaluation{"eval_commas_between_numbers", "truth.kitti", "kitti_commas.txt", "", kAte,
                        kRpe, kRpeDeg},
        FieldEvaluation{"eval_frame_index_columns", "truth.kitti", "index_12.txt", "", kAte, kRpe,
                        kRpeDeg},
        FieldEvaluation{"eval_frame_index_columns", "truth.kitti", "matrix_16.txt", "", kAte, kRpe,
                        kRpeDeg},
        FieldEvaluation{"eval_frame_index_columns", "truth.kitti", "index_16.txt", "", kAte, kRpe,
                        kRpeDeg},
        FieldEvaluation{"eval_frame_index_columns", "truth.kitti", "index_12_gaps.txt", "",
                        0.048860, -2, 0},
        FieldEvaluation{"eval_header_names_the_columns", "truth.csv", "estimate.csv", "", 0.054809,
                        0.081931, 0.372025},
        FieldEvaluation{"eval_id_column_last", "truth.tum", "estimate.txt", "", kAte, kRpe,
                        kRpeDeg},
        FieldEvaluation{"eval_nanoseconds_as_decimals", "truth.csv", "scientific.csv", "", kAte,
                        kRpe, kRpeDeg},
        FieldEvaluation{"eval_nanoseconds_as_decimals", "truth.csv", "point_zero.csv", "", kAte,
                        kRpe, kRpeDeg},
        FieldEvaluation{"eval_one_stamp_twice", "truth.tum", "estimate.tum", "", 0.005463, -2, 0},
        FieldEvaluation{"eval_positions_only_truth", "truth_4_columns.tum", "estimate.tum", "",
                        0.054809, -1, 0},
        FieldEvaluation{"eval_positions_only_truth", "truth_zero_quaternion.tum", "estimate.tum",
                        "", 0.054809, -1, 0},
        FieldEvaluation{"eval_positions_only_truth", "truth.csv", "estimate.tum", "--align sim3",
                        0.054809, -1, 0},
        FieldEvaluation{"eval_truth_denser_by_a_fifth", "truth_12hz.tum", "estimate_10hz.tum", "",
                        0.091274, -2, 0}));

class FieldCounts : public test::CliTest {};

TEST_F(FieldCounts, CountsKeyframesOverTheFramesTheyAreAShareOf) {
  PLACEGRAPH_CASE_OR_SKIP("eval_share_of_keyframes");
  const std::string folder = test::cases_dir() + "/eval_share_of_keyframes/";
  const test::CommandResult result =
      run("eval " + folder + "truth_50hz.tum " + folder + "keyframes.tum");
  // The nearest keyframes are 0.1 s apart: 80 frames with that spacing in the time of the truth.
  EXPECT_THAT(result.out, HasSubstr("13 of 80 judged frames posed (16.2 %)"));
  EXPECT_THAT(result.out, HasSubstr("400 frames in the ground truth, 13 in the estimate"));
}

TEST_F(FieldCounts, LosesNoFrameToATruthThatIsDenserByAFifth) {
  PLACEGRAPH_CASE_OR_SKIP("eval_truth_denser_by_a_fifth");
  const std::string folder = test::cases_dir() + "/eval_truth_denser_by_a_fifth/";
  const test::CommandResult result =
      run("eval " + folder + "truth_12hz.tum " + folder + "estimate_10hz.tum --json");
  const json found = json::parse(result.out);
  EXPECT_EQ(found["posed"], 48);
  EXPECT_EQ(found["coverage"], 1.0);
  EXPECT_TRUE(found["lost_frames"].empty());
  EXPECT_THAT(result.err, HasSubstr("32 of the estimate's 80 poses have no ground truth"));
}

}  // namespace field_eval_test
}  // namespace placegraph
