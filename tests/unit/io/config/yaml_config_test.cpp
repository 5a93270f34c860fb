#include <placegraph/io/config/yaml_config.h>

#include <sstream>

#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"

namespace placegraph {
namespace yaml_config_test {

using test::message_of;
using test::TemporaryFolder;
using testing::ElementsAre;
using testing::HasSubstr;

enum class Metric { kSsd, kZncc };

struct FlowOptions {
  int levels = 3;
  double epsilon = 0.01;
  Metric metric = Metric::kSsd;
};
void visit(OptionVisitor& field, FlowOptions& o) {
  field("levels", o.levels, "pyramid levels", {1, 8});
  field("epsilon", o.epsilon, "step at which to stop [px]", {0, 1});
  field.choice("metric", o.metric, {"ssd", "zncc"}, "similarity");
}

struct FrontendOptions {
  bool enabled = true;
  FlowOptions flow;
  std::vector<double> weights = {1, 0.5};
};
void visit(OptionVisitor& field, FrontendOptions& o) {
  field("enabled", o.enabled, "whether it runs");
  field.group("flow", o.flow, "optical flow");
  field("weights", o.weights, "weights of the levels", {0, 1});
}

struct SystemOptions {
  std::uint64_t seed = 1;
  std::string name = "a: \"b\"";
  double limit = 2.5;
  FrontendOptions frontend;
};
void visit(OptionVisitor& field, SystemOptions& o) {
  field("seed", o.seed, "of every random stream");
  field("name", o.name, "of the run");
  field("limit", o.limit, "anything");
  field.group("frontend", o.frontend, "images to measurements");
}

TEST(ReadOptions, SetsWhatIsNamedAndLeavesTheRest) {
  const TemporaryFolder folder;
  SystemOptions options;
  read_options(folder.write("c.yaml",
                            "seed: 18446744073709551615\n"
                            "frontend:\n"
                            "  enabled: false\n"
                            "  flow: {levels: 5, metric: zncc}\n"
                            "  weights: [0.25, 1, 0]\n"),
               options);
  EXPECT_EQ(options.seed, 18446744073709551615u);
  EXPECT_FALSE(options.frontend.enabled);
  EXPECT_EQ(options.frontend.flow.levels, 5);
  EXPECT_EQ(options.frontend.flow.metric, Metric::kZncc);
  EXPECT_THAT(options.frontend.weights, ElementsAre(0.25, 1, 0));
  EXPECT_EQ(options.frontend.flow.epsilon, 0.01);
  EXPECT_EQ(options.name, "a: \"b\"");
}

TEST(ReadOptions, TakesAnEmptyFileAndEmptyGroups) {
  const TemporaryFolder folder;
  SystemOptions options;
  read_options(folder.write("c.yaml", ""), options);
  read_options(folder.write("c.yaml", "# only a comment\nfrontend:\n"), options);
  EXPECT_EQ(options.frontend.flow.levels, 3);
}

class ReadOptionsRefuses : public testing::TestWithParam<std::pair<const char*, const char*>> {};

TEST_P(ReadOptionsRefuses, AndSaysWhereAndWhy) {
  const TemporaryFolder folder;
  const std::string path = folder.write("c.yaml", GetParam().first);
  SystemOptions options;
  EXPECT_THAT(message_of([&] { read_options(path, options); }), HasSubstr(GetParam().second));
  EXPECT_EQ(list_options(options)[0].value, list_options(SystemOptions{})[0].value);
  EXPECT_EQ(options.frontend.flow.levels, 3);
}

INSTANTIATE_TEST_SUITE_P(
    Faults, ReadOptionsRefuses,
    testing::Values(
        std::pair{"frontend:\n  flow:\n    level: 3\n",
                  "c.yaml:3: frontend.flow.level: unknown key"},
        std::pair{"seed: 5\nlimits: 3\n", "c.yaml:2: limits: unknown key"},
        std::pair{"seed: 5\nseed: 6\n", "c.yaml:2: seed: duplicate key"},
        std::pair{"frontend:\n  flow: {levels: 4, levels: 5}\n",
                  "c.yaml:2: frontend.flow.levels: duplicate key"},
        std::pair{"frontend:\n  flow:\n    levels: 9\n",
                  "c.yaml:3: frontend.flow.levels: '9' lies outside [1, 8]"},
        std::pair{"frontend:\n  flow:\n    levels: 2.5\n",
                  "c.yaml:3: frontend.flow.levels: expected an integer, found '2.5'"},
        std::pair{"frontend: {flow: {levels: \"5\"}}", "c.yaml:1: frontend.flow.levels: expected"},
        std::pair{"frontend: {flow: {levels: 99999999999}}", "c.yaml:1: frontend.flow.levels: exp"},
        std::pair{"frontend: {flow: {levels: }}", "c.yaml:1: frontend.flow.levels: expected"},
        std::pair{"limit: .nan", "c.yaml:1: limit: expected a number, found '.nan'"},
        std::pair{"limit: nan", "c.yaml:1: limit: expected a number, found 'nan'"},
        std::pair{"limit: inf", "c.yaml:1: limit: expected a number, found 'inf'"},
        std::pair{"limit: 1e999", "c.yaml:1: limit: expected a number"},
        std::pair{"limit: 1 2", "c.yaml:1: limit: expected a number"},
        std::pair{"frontend: {flow: {epsilon: .inf}}",
                  "frontend.flow.epsilon: '.inf' lies outside"},
        std::pair{"limit: [1]", "c.yaml:1: limit: expected a number, found a list"},
        std::pair{"name: [a]", "c.yaml:1: name: expected a text, found a list"},
        std::pair{"seed: -1", "c.yaml:1: seed: expected an integer from 0, found '-1'"},
        std::pair{"frontend:\n  enabled: yes\n",
                  "c.yaml:2: frontend.enabled: expected true or false, found 'yes'"},
        std::pair{"frontend:\n  flow:\n    metric: sad\n",
                  "c.yaml:3: frontend.flow.metric: expected one of ssd | zncc, found 'sad'"},
        std::pair{"frontend:\n  weights: 1\n", "c.yaml:2: frontend.weights: expected a list"},
        std::pair{"frontend:\n  weights: [0.5,\n    2]\n",
                  "c.yaml:3: frontend.weights: '2' lies outside [0, 1]"},
        std::pair{"frontend: 3\n", "c.yaml:1: frontend: expected keys and values, found '3'"},
        std::pair{"- a\n", "c.yaml:1: the file: expected keys and values"},
        std::pair{"seed: 5\n  name: [\n", "c.yaml:"},
        std::pair{"seed: 5\n---\nseed: 6\n", "c.yaml: holds several YAML documents"},
        std::pair{"a: {b: [", "c.yaml:"}));

TEST(ReadOptions, RefusesAFileThatIsMissingOrNestedWithoutEnd) {
  const TemporaryFolder folder;
  SystemOptions options;
  EXPECT_THAT(message_of([&] { read_options(folder / "none.yaml", options); }),
              HasSubstr("none.yaml: "));
  const std::string deep = folder.write("deep.yaml", "limit: " + std::string(100000, '['));
  EXPECT_THAT(message_of([&] { read_options(deep, options); }), HasSubstr("deep.yaml"));
}

TEST(SetOption, SetsOneKeyOfAnyType) {
  SystemOptions options;
  set_option(options, "frontend.flow.levels=7");
  set_option(options, "frontend.weights=[0, 0.5]");
  set_option(options, "frontend.enabled=false");
  set_option(options, "frontend.flow.metric=zncc");
  set_option(options, "name=x=y");
  set_option(options, "limit=-1e3");
  EXPECT_EQ(options.frontend.flow.levels, 7);
  EXPECT_THAT(options.frontend.weights, ElementsAre(0, 0.5));
  EXPECT_FALSE(options.frontend.enabled);
  EXPECT_EQ(options.frontend.flow.metric, Metric::kZncc);
  EXPECT_EQ(options.name, "x=y");
  EXPECT_EQ(options.limit, -1000);
}

TEST(SetOption, NamesTheKeyAndThoseThatLookLikeIt) {
  SystemOptions options;
  const auto message = [&](const char* assignment) {
    return message_of<ArgumentError>([&] { set_option(options, assignment); });
  };
  EXPECT_THAT(message("frontend.flow.level=3"),
              HasSubstr("--set frontend.flow.level=3: unknown key; similar: frontend.flow.levels"));
  EXPECT_THAT(message("levels=3"), HasSubstr("similar: frontend.flow.levels"));
  EXPECT_EQ(message("zzzzzzzzzzzz=3"), "--set zzzzzzzzzzzz=3: unknown key");
  EXPECT_THAT(message("frontend.flow=3"), HasSubstr("is a group of options"));
  EXPECT_THAT(message("frontend.flow.levels=many"), HasSubstr("expected an integer, found 'many'"));
  EXPECT_THAT(message("frontend.flow.levels=0"), HasSubstr("lies outside [1, 8]"));
  EXPECT_THAT(message("frontend.flow.levels="), HasSubstr("expected an integer, found nothing"));
  EXPECT_THAT(message("seed"), HasSubstr("expected key=value"));
  EXPECT_THAT(message("frontend.weights=[1"), HasSubstr("the value is not YAML"));
  EXPECT_EQ(options.frontend.flow.levels, 3);
}

TEST(DumpOptions, IsReadBackAsTheSameOptions) {
  const TemporaryFolder folder;
  SystemOptions options;
  options.limit = 0.1 + 0.2;
  options.name = "line\nbreak: #\t'\"";
  options.frontend.flow.metric = Metric::kZncc;
  options.frontend.weights = {};
  const std::string dumped = dump_options(options);
  SystemOptions read;
  read_options(folder.write("c.yaml", dumped), read);
  EXPECT_EQ(read.limit, options.limit);
  EXPECT_EQ(read.name, options.name);
  EXPECT_EQ(read.frontend.flow.metric, Metric::kZncc);
  EXPECT_TRUE(read.frontend.weights.empty());
  EXPECT_EQ(dump_options(read), dumped);
  EXPECT_THAT(dumped, HasSubstr("    # pyramid levels (1 to 8)\n    levels: 3\n"));
  EXPECT_THAT(dumped, HasSubstr("  # optical flow\n  flow:\n"));
}

TEST(OptionsMarkdown, HasOneListAGroup) {
  const std::string text = options_markdown(SystemOptions{});
  EXPECT_THAT(text, HasSubstr("## `frontend.flow`\n\noptical flow\n\n- `levels` = `3` "
                              "(1 to 8; advanced): pyramid levels\n- `epsilon`"));
  EXPECT_THAT(text, HasSubstr("- `metric` = `ssd` (ssd | zncc; advanced): similarity\n"));
  EXPECT_THAT(text, HasSubstr("## `frontend`, continued\n\n- `weights`"));
}

TEST(OptionsMarkdown, WrapsLongLines) {
  std::vector<OptionEntry> entries(1);
  entries[0].path = "key";
  entries[0].value = "1";
  for (int i = 0; i < 60; ++i) entries[0].doc += "word ";
  std::istringstream lines(options_markdown(entries));
  int count = 0;
  for (std::string line; std::getline(lines, line); ++count) EXPECT_LE(line.size(), 100u);
  EXPECT_EQ(count, 5);  // an empty one before the list
}

struct RenamedGroup {
  int levels = 3;
};
void visit(OptionVisitor& field, RenamedGroup& o) {
  field.formerly("depth")("levels", o.levels, "pyramid levels", {1, 8});
}

struct RenamedOptions {
  double sigma_px = 1;
  RenamedGroup direct;
};
void visit(OptionVisitor& field, RenamedOptions& o) {
  field.formerly("sigma")("sigma_px", o.sigma_px, "noise [px]", {0, 10});
  field.formerly("surfaces").group("direct", o.direct, "direct alignment");
}

class FormerKeys : public testing::Test {
 protected:
  RenamedOptions options;
  std::vector<std::string> notes;
  LogSink log = [this](LogLevel, const std::string& note) { notes.push_back(note); };
};

TEST_F(FormerKeys, AreReadFromFilesWithANoteEach) {
  const TemporaryFolder folder;
  const std::string path = folder.write("old.yaml", "sigma: 2\nsurfaces:\n  depth: 5\n");
  read_options(path, options, log);
  EXPECT_EQ(options.sigma_px, 2);
  EXPECT_EQ(options.direct.levels, 5);
  EXPECT_THAT(notes,
              ElementsAre(path + ":1: 'sigma' is an old spelling of 'sigma_px'",
                          path + ":3: 'surfaces' is an old spelling of 'direct'",
                          path + ":3: 'direct.depth' is an old spelling of 'direct.levels'"));
}

TEST_F(FormerKeys, MayBeMixedWithPresentOnes) {
  const TemporaryFolder folder;
  read_options(folder.write("mixed.yaml", "direct: {depth: 4}\nsigma_px: 3\n"), options, log);
  EXPECT_EQ(options.direct.levels, 4);
  EXPECT_EQ(options.sigma_px, 3);
  EXPECT_EQ(notes.size(), 1u);
}

TEST_F(FormerKeys, AreRefusedBesideThePresentOne) {
  const TemporaryFolder folder;
  const std::string path = folder.write("both.yaml", "sigma_px: 3\nsigma: 2\n");
  EXPECT_THAT(message_of<FileError>([&] { read_options(path, options); }),
              HasSubstr("both.yaml:2: sigma: is an old spelling of sigma_px, which is also there"));
  EXPECT_EQ(options.sigma_px, 1);
}

TEST_F(FormerKeys, ArePartsOfASetting) {
  set_option(options, "surfaces.depth=6", log);
  EXPECT_EQ(options.direct.levels, 6);
  set_option(options, "direct.depth=7", log);
  EXPECT_EQ(options.direct.levels, 7);
  set_option(options, "direct.levels=8", log);
  EXPECT_THAT(notes, ElementsAre("--set 'surfaces.depth' is an old spelling of 'direct.levels'",
                                 "--set 'direct.depth' is an old spelling of 'direct.levels'"));
}

TEST_F(FormerKeys, AreNotSuggestedForUnknownOnes) {
  const TemporaryFolder folder;
  const std::string path = folder.write("unknown.yaml", "direct: {levles: 5}\n");
  EXPECT_THAT(message_of<FileError>([&] { read_options(path, options); }),
              HasSubstr("direct.levles: unknown key; did you mean levels?"));
}

struct RetiredOptions {
  double sigma_px = 1;
};
void visit(OptionVisitor& field, RetiredOptions& o) {
  field("sigma_px", o.sigma_px, "noise [px]", {0, 10});
  field.retired({{"blur_px", 1.5}});
  field.retired({{"levels", 3}, {"step_px", 2}}, "direct");
}

class RetiredKeys : public testing::Test {
 protected:
  RetiredOptions options;
  std::vector<std::string> notes;
  LogSink log = [this](LogLevel, const std::string& note) { notes.push_back(note); };
};

TEST_F(RetiredKeys, AreReadFromFilesWithANoteEach) {
  const TemporaryFolder folder;
  const std::string path =
      folder.write("old.yaml", "blur_px: 7\nsigma_px: 2\ndirect: {levels: 3, step_px: 4}\n");
  read_options(path, options, log);
  EXPECT_EQ(options.sigma_px, 2);
  const std::string unused = "; the value here is not used";
  EXPECT_THAT(notes, ElementsAre(path + ":1: 'blur_px' is a constant now, 1.5" + unused,
                                 path + ":3: 'direct.levels' is a constant now, 3" + unused,
                                 path + ":3: 'direct.step_px' is a constant now, 2" + unused));
}

TEST_F(RetiredKeys, DoNotHideUnknownOnes) {
  const TemporaryFolder folder;
  const std::string inside = folder.write("inside.yaml", "direct: {levles: 3}\n");
  EXPECT_THAT(message_of<FileError>([&] { read_options(inside, options); }),
              HasSubstr("inside.yaml:1: direct.levles: unknown key"));
  EXPECT_THAT(message_of<ArgumentError>([&] { set_option(options, "direct.levles=3"); }),
              HasSubstr("unknown key"));
}

TEST_F(RetiredKeys, MayBeSetWithANote) {
  set_option(options, "direct.levels=5", log);
  set_option(options, "blur_px=1.5", log);
  EXPECT_THAT(notes,
              ElementsAre("--set 'direct.levels' is a constant now, 3; the value here is not used",
                          "--set 'blur_px' is a constant now, 1.5; the value here is not used"));
}

TEST_F(RetiredKeys, AreListedApart) {
  EXPECT_EQ(list_options(options).size(), 1u);
  std::vector<std::string> found;
  for (const OptionEntry& entry : list_retired_options(options))
    found.push_back(entry.path + ' ' + entry.value);
  EXPECT_THAT(found, ElementsAre("blur_px 1.5", "direct.levels 3", "direct.step_px 2"));
}

}  // namespace yaml_config_test
}  // namespace placegraph
