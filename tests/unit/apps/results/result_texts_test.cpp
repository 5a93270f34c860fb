#include <gtest/gtest.h>
#include <placegraph/pipeline/results/result_json.h>

#include <nlohmann/json.hpp>

#include "apps/results/result_texts.h"

namespace placegraph::apps {
namespace result_texts_test {

TEST(JudgementText, IsOneLineForAGoodRun) {
  Judgement judgement;
  judgement.metric = true;
  judgement.why_metric = "by the baseline of 0.54 m";
  EXPECT_EQ(judgement_text(describe_judgement(judgement), "  "),
            "good: lengths are in metres, by the baseline of 0.54 m; nothing contradicts the "
            "result\n");
  judgement.expected_drift_m = 0.123;
  EXPECT_EQ(judgement_text(describe_judgement(judgement), "  "),
            "good: lengths are in metres, by the baseline of 0.54 m; expected drift at the end "
            "0.12 m; nothing contradicts the result\n");
}

TEST(JudgementText, HasALineForEachFinding) {
  Judgement judgement;
  judgement.verdict = Verdict::kDoubtful;
  judgement.why_metric = "one camera alone does not observe the scale";
  judgement.findings = {
      {"3 of 9 frames are lost", false, NoteCause::kLostFrames, "look at these images"},
      {"the clock jumps", false, NoteCause::kTimes, ""}};
  EXPECT_EQ(judgement_text(describe_judgement(judgement), "  "),
            "doubtful: scale unknown, one camera alone does not observe the scale\n"
            "  lost_frames: 3 of 9 frames are lost; look at these images\n"
            "  times_questionable: the clock jumps\n");
}

TEST(JudgementText, IsMadeOfTheKeysOfResultJson) {
  Judgement judgement;
  judgement.verdict = Verdict::kFailed;
  judgement.findings = {{"none", false, NoteCause::kFewPosed, "more light"}};
  const nlohmann::json described = describe_judgement(judgement);
  EXPECT_EQ(described["verdict"], "failed");
  EXPECT_EQ(described["metric"], false);
  EXPECT_FALSE(described.contains("expected_drift_m"));
  EXPECT_EQ(described["findings"],
            nlohmann::json::array(
                {{{"cause", "few_posed"}, {"text", "none"}, {"advice", "more light"}}}));
}

TEST(ComponentsText, SaysWhichFramesEachHas) {
  const auto component = [](bool main, int posed, int first, int last) {
    return nlohmann::json{
        {"main", main}, {"posed", posed}, {"first_frame", first}, {"last_frame", last}};
  };
  const nlohmann::json first = component(true, 5, 10, 14), other = component(false, 3, 15, 17);
  EXPECT_EQ(components_text({first, other}),
            "2 components, each in a frame of its own: 5 frames from 10 to 14 (main); 3 frames "
            "from 15 to 17");
  EXPECT_EQ(components_text(nlohmann::json::array({first})), "");
}

}  // namespace result_texts_test
}  // namespace placegraph::apps
