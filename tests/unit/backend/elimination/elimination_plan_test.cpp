#include <gtest/gtest.h>
#include <placegraph/backend/elimination/elimination_plan.h>

#include <sys/resource.h>

#include <algorithm>
#include <random>
#include <set>
#include <vector>

namespace placegraph {
namespace elimination_plan_test {

VariableSets sets_of(const std::vector<std::vector<int>>& members) {
  VariableSets sets;
  for (const std::vector<int>& set : members) {
    sets.members.insert(sets.members.end(), set.begin(), set.end());
    sets.close();
  }
  return sets;
}

/// The edges of a square grid.
std::vector<std::vector<int>> grid(int side) {
  std::vector<std::vector<int>> edges;
  for (int v = 0; v < side; ++v)
    for (int u = 0; u < side; ++u) {
      if (u + 1 < side) edges.push_back({v * side + u, v * side + u + 1});
      if (v + 1 < side) edges.push_back({v * side + u, (v + 1) * side + u});
    }
  return edges;
}

/// Steps of the variables, after checks of what holds for every plan: each variable is eliminated
/// once, children precede their parents, separators are eliminated later.
std::vector<int> steps_of(const EliminationPlan& plan, int variables) {
  std::vector<int> step(variables, -1);
  int next = 0;
  for (const FrontPlan& front : plan.fronts)
    for (const int v : front.frontal) {
      EXPECT_EQ(step[v], -1) << "variable " << v << " is eliminated twice";
      step[v] = next++;
    }
  EXPECT_EQ(next, variables);
  for (int f = 0; f < static_cast<int>(plan.fronts.size()); ++f) {
    const FrontPlan& front = plan.fronts[f];
    EXPECT_EQ(front.parent < 0, front.separator.empty());
    if (front.parent < 0) continue;
    EXPECT_GT(front.parent, f);
    const std::vector<int>& above = plan.fronts[front.parent].frontal;
    EXPECT_NE(std::ranges::find(above, front.separator.front()), above.end());
    for (const int v : front.separator) EXPECT_GT(step[v], step[front.frontal.back()]);
  }
  return step;
}

/// Every set lies within the front that eliminates the first of its variables.
void expect_covered(const EliminationPlan& plan, const std::vector<std::vector<int>>& sets) {
  for (const std::vector<int>& set : sets) {
    const auto front = std::ranges::find_if(plan.fronts, [&](const FrontPlan& candidate) {
      return std::ranges::any_of(candidate.frontal,
                                 [&](int v) { return std::ranges::find(set, v) != set.end(); });
    });
    ASSERT_NE(front, plan.fronts.end());
    std::set<int> members(front->frontal.begin(), front->frontal.end());
    members.insert(front->separator.begin(), front->separator.end());
    for (const int v : set) EXPECT_TRUE(members.contains(v)) << "variable " << v;
  }
}

TEST(EliminationPlan, ATreeFillsNothingIn) {
  std::mt19937 random(3);
  const int variables = 200;
  std::vector<std::vector<int>> edges;
  for (int v = 1; v < variables; ++v) edges.push_back({static_cast<int>(random() % v), v});
  const EliminationPlan plan =
      plan_elimination(variables, sets_of(edges), std::vector<char>(variables, 0), 0);
  steps_of(plan, variables);
  expect_covered(plan, edges);
  for (const FrontPlan& front : plan.fronts)
    EXPECT_LE(front.frontal.size() + front.separator.size(), 2u);
}

TEST(EliminationPlan, AGridFillsInLessThanHalfOfItsBand) {
  const int side = 30, variables = side * side;
  const std::vector<std::vector<int>> edges = grid(side);
  const EliminationPlan plan =
      plan_elimination(variables, sets_of(edges), std::vector<char>(variables, 0), 0);
  steps_of(plan, variables);
  expect_covered(plan, edges);
  std::size_t entries = 0;
  for (const FrontPlan& front : plan.fronts) {
    const std::size_t own = front.frontal.size();
    entries += own * (own + 1) / 2 + own * front.separator.size();
  }
  EXPECT_LT(entries, static_cast<std::size_t>(variables * side / 2));
}

TEST(EliminationPlan, LateVariablesComeAfterAllOthers) {
  const int side = 12, variables = side * side;
  std::vector<std::vector<int>> sets = grid(side);
  sets.push_back({0, 17, 40, 77, 101});  // what was left of eliminated variables
  std::vector<char> late(variables, 0);
  for (const int v : {0, 5, 66, 143}) late[v] = 1;
  const EliminationPlan plan = plan_elimination(variables, sets_of(sets), late, 0);
  const std::vector<int> step = steps_of(plan, variables);
  expect_covered(plan, sets);
  for (int v = 0; v < variables; ++v)
    EXPECT_EQ(late[v] != 0, step[v] >= variables - 4) << "variable " << v;
}

TEST(EliminationPlan, VariablesWithoutSetsAndAllLateOnesArePlannedToo) {
  EXPECT_TRUE(plan_elimination(0, {}, {}, 0.1).fronts.empty());
  EXPECT_EQ(plan_elimination(1, {}, {1}, 0.1).fronts.size(), 1u);  // the first pose of a graph
  const EliminationPlan plan = plan_elimination(3, sets_of({{1}}), {1, 1, 1}, 0.1);
  steps_of(plan, 3);
  EXPECT_EQ(plan.fronts.size(), 3u);
}

TEST(EliminationPlan, ASetIsOneFrontWithoutZeros) {
  std::vector<std::vector<int>> sets = {{4, 1, 7, 2, 9}, {4, 7}, {9, 1, 2}};
  const EliminationPlan plan = plan_elimination(10, sets_of(sets), std::vector<char>(10, 0), 0);
  steps_of(plan, 10);
  expect_covered(plan, sets);
  EXPECT_EQ(plan.fronts.size(), 6u);  // five variables without a set, and the set
}

TEST(EliminationPlan, ChildrenAreMergedAsLongAsZerosAreFew) {
  const int side = 20, variables = side * side;
  const std::vector<std::vector<int>> edges = grid(side);
  const auto planned = [&](double zero_share) {
    const EliminationPlan plan =
        plan_elimination(variables, sets_of(edges), std::vector<char>(variables, 0), zero_share);
    steps_of(plan, variables);
    expect_covered(plan, edges);
    return plan.fronts.size();
  };
  EXPECT_LT(planned(0.3), planned(0));
  EXPECT_EQ(planned(1), 1u);
}

/// The most memory that the process has held [kB].
long peak_kB() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss;
}

// Separators of many fronts under one: pairs of all members would be 6 * 10^8, of 4 bytes or more each.
TEST(EliminationPlan, ManyLargeSetsThatOverlapTakeNoMemoryForPairs) {
  const long before = peak_kB();
  const int variables = 2200;
  std::vector<std::vector<int>> sets(300);
  for (int s = 0; s < static_cast<int>(sets.size()); ++s) {
    sets[s].resize(2100);
    for (int i = 0; i < 2100; ++i) sets[s][i] = (i + s) % variables;
  }
  const EliminationPlan plan =
      plan_elimination(variables, sets_of(sets), std::vector<char>(variables, 0), 0.1);
  steps_of(plan, variables);
  expect_covered(plan, sets);
  // 300 sets of 2100 members, some times over, with what the sanitizers add.
  EXPECT_LT(peak_kB() - before, 500'000);
}

}  // namespace elimination_plan_test
}  // namespace placegraph
