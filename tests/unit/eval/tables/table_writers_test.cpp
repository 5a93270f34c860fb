#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <placegraph/eval/tables/table_writers.h>
#include <placegraph/graph/core/error.h>

#include <nlohmann/json.hpp>

namespace placegraph {
namespace table_writers_test {

using ::testing::HasSubstr;
using ::testing::Not;

/// Two figures of two systems, of which one failed on a sequence, with an interval.
FigureTable example() {
  FigureTable table;
  table.caption = "ATE & co, aligned by se3";
  table.corner = "sequence";
  table.best = TableBest::kRow;
  table.columns = {
      {"ours", "ATE RMSE", "m"}, {"orb_slam3", "ATE RMSE", "m"}, {"ours", "t_rel", "%"}};
  TableCell interval{0.553, {{0.5, 0.61}}, "", "", 1}, worse{0.612, {}, "", "", 1},
      share{1.25, {}, "", "", 1}, lost;
  lost.note = "failed: lost after 12 s";
  table.rows = {{"fr1_desk", {interval, worse, share}, false},
                {"fr2|xyz", {worse, lost, lost}, false},
                {"mean", {worse, lost, share}, true}};
  table.notes = {"t_rel over 100 m"};
  return table;
}

TEST(TableWriters, TextHasAlignedColumnsMarksAndNotes) {
  EXPECT_EQ(to_text(example()),
            "ATE & co, aligned by se3\n\n"
            "          ATE RMSE [m]                      t_rel [%]\n"
            "sequence   ours                  orb_slam3   ours\n"
            "fr1_desk  0.553* [0.500, 0.610]  0.612       1.25\n"
            "fr2|xyz   0.612                      - (1)      - (1)\n"
            "\n"
            "mean      0.612                      - (1)   1.25\n"
            "\n* best of its row\n(1) failed: lost after 12 s\nt_rel over 100 m\n");
}

TEST(TableWriters, CsvKeepsEveryDigitAndTheNotes) {
  FigureTable table = example();
  table.rows[0].cells[0].value = 0.1234567890123456;
  EXPECT_EQ(to_csv(table),
            "sequence,ATE RMSE [m] ours,ATE RMSE [m] ours low,ATE RMSE [m] ours high,"
            "ATE RMSE [m] orb_slam3,t_rel [%] ours,notes\n"
            "fr1_desk,0.1234567890123456,0.5,0.61,0.612,1.25,\n"
            "fr2|xyz,0.612,,,,,ATE RMSE [m] orb_slam3: failed: lost after 12 s; t_rel [%] ours: "
            "failed: lost after 12 s\n"
            "mean,0.612,,,,1.25,ATE RMSE [m] orb_slam3: failed: lost after 12 s\n");
}

TEST(TableWriters, LatexIsABooktabsTable) {
  EXPECT_EQ(to_latex(example()), R"(\begin{table}
  \centering
  \caption{ATE \& co, aligned by se3}
  \begin{tabular}{lrrr}
  \toprule
   & \multicolumn{2}{c}{ATE RMSE {[}m{]}} & \multicolumn{1}{c}{t\_rel {[}\%{]}} \\
  \cmidrule(lr){2-3} \cmidrule(lr){4-4}
  sequence & ours & orb\_slam3 & ours \\
  \midrule
  fr1\_desk & \textbf{0.553} {[}0.500, 0.610{]} & 0.612 & 1.25 \\
  fr2\textbar{}xyz & 0.612 & --\textsuperscript{1} & --\textsuperscript{1} \\
  \midrule
  mean & 0.612 & --\textsuperscript{1} & 1.25 \\
  \bottomrule
  \end{tabular}

  \smallskip
  {\footnotesize
  \textsuperscript{1} failed: lost after 12 s\\
  t\_rel over 100 m\\
  }
\end{table}
)");
}

TEST(TableWriters, MarkdownIsATableOfGitHub) {
  EXPECT_EQ(to_markdown(example()),
            "ATE &amp; co, aligned by se3\n\n"
            "| sequence | ATE RMSE \\[m\\] ours | ATE RMSE \\[m\\] orb\\_slam3 | "
            "t\\_rel \\[%\\] ours |\n"
            "|---|---:|---:|---:|\n"
            "| fr1\\_desk | **0.553** \\[0.500, 0.610\\] | 0.612 | 1.25 |\n"
            "| fr2\\|xyz | 0.612 | - (1) | - (1) |\n"
            "| mean | 0.612 | - (1) | 1.25 |\n"
            "\n(1) failed: lost after 12 s\n\nt\\_rel over 100 m\n");
}

TEST(TableWriters, JsonHasNullWhereThereIsNoFigure) {
  const auto json = nlohmann::json::parse(to_json(example()));
  EXPECT_EQ(json["columns"][1]["group"], "ATE RMSE");
  EXPECT_EQ(json["columns"][1]["unit"], "m");
  const auto& cells = json["rows"][0]["cells"];
  EXPECT_EQ(cells[0]["value"], 0.553);
  EXPECT_EQ(cells[0]["low"], 0.5);
  EXPECT_EQ(cells[0]["high"], 0.61);
  EXPECT_EQ(cells[0]["best"], true);
  EXPECT_FALSE(cells[1].contains("best"));
  EXPECT_TRUE(json["rows"][1]["cells"][1]["value"].is_null());
  EXPECT_EQ(json["rows"][1]["cells"][1]["note"], "failed: lost after 12 s");
  EXPECT_EQ(json["rows"][2]["summary"], true);
}

TEST(TableWriters, HtmlIsOnePageThatLoadsNothing) {
  const std::string page = to_html(example());
  EXPECT_THAT(page, HasSubstr("<!DOCTYPE html>"));
  EXPECT_THAT(page, HasSubstr(to_html_fragment(example())));
  EXPECT_THAT(page, Not(HasSubstr("src=")));
  EXPECT_THAT(page, Not(HasSubstr("href=")));
  EXPECT_THAT(page, HasSubstr("<caption>ATE &amp; co, aligned by se3</caption>"));
  EXPECT_THAT(page, HasSubstr("<td><b>0.553</b> <small>[0.500, 0.610]</small></td>"));
  EXPECT_THAT(page, HasSubstr("<td>–<sup title=\"failed: lost after 12 s\">1</sup></td>"));
  EXPECT_THAT(page, HasSubstr("<th scope=\"colgroup\" colspan=\"2\">ATE RMSE [m]</th>"));
}

/// Names with all that the languages give a meaning to.
TEST(TableWriters, NamesAreEscaped) {
  FigureTable table;
  table.corner = "a";
  table.columns = {{"x", "", ""}};
  table.rows = {{R"(a_b|c&d<e>"f" g,h %#${}\~^'`*[i])", {TableCell{1.0, {}, "", "", 1}}, false}};
  EXPECT_THAT(to_csv(table), HasSubstr(R"("a_b|c&d<e>""f"" g,h %#${}\~^'`*[i]",1,)"));
  EXPECT_THAT(to_latex(table),
              HasSubstr(R"(a\_b\textbar{}c\&d\textless{}e\textgreater{}\char34{}f\char34{} g,h )"
                        R"(\%\#\$\{\}\textbackslash{}\textasciitilde{}\textasciicircum{}'`*{[}i{]})"
                        R"( & 1)"));
  EXPECT_THAT(to_markdown(table),
              HasSubstr(R"(| a\_b\|c&amp;d&lt;e&gt;"f" g,h %\#${}\\\~^'\`\*\[i\] |)"));
  EXPECT_THAT(to_html(table),
              HasSubstr(R"(a_b|c&amp;d&lt;e&gt;&quot;f&quot; g,h %#${}\~^&#39;`*[i])"));
  EXPECT_EQ(nlohmann::json::parse(to_json(table))["rows"][0]["name"], table.rows[0].name);
  table.rows[0].name = "two\nlines";
  for (const char* path : {"t.md", "t.tex", "t.txt"})
    EXPECT_THAT(table_file_text(table, path), HasSubstr("two lines")) << path;
}

/// The comparison tables of eval trajectory are tables of this form.
TEST(TableWriters, TextsStandInPlaceOfNumbersAndDecimalsMayBeFixed) {
  FigureTable table;
  table.corner = "estimate";
  table.columns = {{"posed", "", ""}, {"ATE RMSE", "", "m"}};
  table.columns[1].decimals = 4;
  TableCell posed;
  posed.text = "59/60";
  table.rows = {{"a", {posed, TableCell{0.5, {}, "", "", 1}}, false}};
  EXPECT_EQ(to_text(table), "estimate  posed  ATE RMSE [m]\na         59/60        0.5000\n");
  EXPECT_THAT(to_latex(table), HasSubstr("a & 59/60 & 0.5000"));
}

TEST(TableWriters, AFileIsWrittenAsItsNameEnds) {
  const FigureTable table = example();
  EXPECT_EQ(table_file_text(table, "a/t.md"), to_markdown(table));
  EXPECT_EQ(table_file_text(table, "t.tex"), to_latex(table));
  EXPECT_EQ(table_file_text(table, "t.csv"), to_csv(table));
  EXPECT_EQ(table_file_text(table, "t.json"), to_json(table));
  EXPECT_EQ(table_file_text(table, "t.html"), to_html(table));
  EXPECT_EQ(table_file_text(table, "t.txt"), to_text(table));
  for (const std::string& ending : table_file_endings())
    EXPECT_NO_THROW((void)table_file_text(table, "t" + ending));
  EXPECT_THROW((void)table_file_text(table, "t.doc"), ArgumentError);
}

TEST(TableWriters, ATableWithoutRowsIsItsHeads) {
  FigureTable table;
  table.corner = "sequence";
  table.columns = {{"x", "", "m"}};
  EXPECT_EQ(to_text(table), "sequence  x [m]\n");
  EXPECT_EQ(to_csv(table), "sequence,x [m],notes\n");
  EXPECT_EQ(to_latex(FigureTable()), "");
}

}  // namespace table_writers_test
}  // namespace placegraph
