#include <placegraph/backend/elimination/elimination_plan.h>

#include <suitesparse/camd.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <new>
#include <utility>

namespace placegraph {
namespace {

/// The order of elimination and, for every variable, its neighbours when it is eliminated.
struct Elimination {
  std::vector<int> order;
  VariableSets met;  ///< set i belongs to order[i]; members not sorted
};

/// The order by CAMD, those with `late` last.
/// An edge connects two variables. A larger set is a vertex of its own, connected to its members
/// and eliminated before all variables, which connects the members pairwise without listing their
/// pairs.
std::vector<int> order_late_last(int variables, const VariableSets& sets,
                                 const std::vector<char>& late) {
  const auto size = [&](int s) { return sets.begin[s + 1] - sets.begin[s]; };
  int vertices = variables;
  std::size_t joins = 0;
  for (int s = 0; s < sets.size(); ++s) {
    if (size(s) > 2) ++vertices;
    joins += size(s) == 2 ? 1 : size(s) > 2 ? static_cast<std::size_t>(size(s)) : 0;
  }
  if (joins > static_cast<std::size_t>(std::numeric_limits<int>::max()) / 2) throw std::bad_alloc();
  // Columns of one triangle, repeats where sets overlap: CAMD mirrors and sorts.
  std::vector<int> begin = {0}, joined;
  begin.reserve(static_cast<std::size_t>(vertices) + 1);
  joined.reserve(std::max<std::size_t>(joins, 1));
  std::vector<std::vector<int>> partners(variables);
  for (int s = 0; s < sets.size(); ++s)
    if (size(s) == 2) {
      const int* pair = sets.members.data() + sets.begin[s];
      partners[pair[0]].push_back(pair[1]);
    }
  for (int v = 0; v < variables; ++v) {
    joined.insert(joined.end(), partners[v].begin(), partners[v].end());
    begin.push_back(static_cast<int>(joined.size()));
  }
  for (int s = 0; s < sets.size(); ++s) {
    if (size(s) <= 2) continue;
    joined.insert(joined.end(), sets.members.begin() + sets.begin[s],
                  sets.members.begin() + sets.begin[s + 1]);
    begin.push_back(static_cast<int>(joined.size()));
  }
  std::vector<int> stage(vertices, 0);
  const int first_stage = vertices > variables ? 1 : 0;
  const bool all_late = std::find(late.begin(), late.end(), 0) == late.end();
  for (int v = 0; v < variables; ++v) stage[v] = first_stage + (late[v] && !all_late ? 1 : 0);
  double control[CAMD_CONTROL];
  camd_defaults(control);
  // No dense vertex is left out: that of a set has as many neighbours as the set has members.
  control[CAMD_DENSE] = -1;
  std::vector<int> order(vertices);
  if (vertices > 0 && camd_order(vertices, begin.data(), joined.data(), order.data(), control,
                                 nullptr, stage.data()) < 0)
    throw std::bad_alloc();  // all other errors are excluded by construction
  std::erase_if(order, [&](int v) { return v >= variables; });
  return order;
}

/// Eliminates in `order`: a variable replaces the sets that contain it by their union.
Elimination eliminate(int variables, const VariableSets& sets, std::vector<int> order) {
  Elimination result;
  VariableSets& met = result.met;
  std::vector<int> step(variables), mark(variables, -1);
  for (int i = 0; i < variables; ++i) step[order[i]] = i;
  // Sets, and then the unions, are in lists of the first step that eliminates one of their members.
  std::vector<int> sets_at(variables, -1), next(sets.size() + variables, -1);
  const auto add_set = [&](int s, const int* members, const int* end) {
    if (members == end) return;
    int first = variables;
    for (; members != end; ++members) first = std::min(first, step[*members]);
    next[s] = sets_at[first];
    sets_at[first] = s;
  };
  const auto span = [&](int s) {
    const VariableSets& of = s < sets.size() ? sets : met;
    const int k = s < sets.size() ? s : s - sets.size();
    return std::pair{of.begin[k], of.begin[k + 1]};
  };
  for (int s = 0; s < sets.size(); ++s)
    add_set(s, sets.members.data() + sets.begin[s], sets.members.data() + sets.begin[s + 1]);
  for (int i = 0; i < variables; ++i) {
    mark[order[i]] = i;
    for (int s = sets_at[i]; s >= 0; s = next[s]) {
      const auto [begin, end] = span(s);
      for (int j = begin; j < end; ++j) {
        const int u = s < sets.size() ? sets.members[j] : met.members[j];
        if (mark[u] == i) continue;
        mark[u] = i;
        met.members.push_back(u);
      }
    }
    met.close();
    add_set(sets.size() + i, met.members.data() + met.begin[i],
            met.members.data() + met.begin[i + 1]);
  }
  result.order = std::move(order);
  return result;
}

/// Fronts during their construction, identified by the step of their last variable.
struct Group {
  std::vector<int> frontal;  ///< steps
  std::int64_t zeros = 0;
  int separator_size = 0;
  int merged_into = -1;
};

std::int64_t entries(std::int64_t frontal, std::int64_t separator) {
  return frontal * (frontal + 1) / 2 + frontal * separator;
}

/// Merges children into `parent` as long as they add few zeros.
void absorb_children(std::vector<Group>& groups, std::vector<int>& children, int parent,
                     double zero_share) {
  Group& group = groups[parent];
  std::stable_sort(children.begin(), children.end(), [&](int a, int b) {
    return groups[a].separator_size > groups[b].separator_size;
  });
  for (const int c : children) {
    Group& child = groups[c];
    const std::int64_t own = static_cast<std::int64_t>(group.frontal.size());
    const std::int64_t more = static_cast<std::int64_t>(child.frontal.size());
    const std::int64_t zeros =
        group.zeros + child.zeros + more * (own + group.separator_size - child.separator_size);
    const std::int64_t total = entries(own + more, group.separator_size);
    if (static_cast<double>(zeros) > zero_share * static_cast<double>(total)) continue;
    group.zeros = zeros;
    group.frontal.insert(group.frontal.end(), child.frontal.begin(), child.frontal.end());
    child.frontal.clear();
    child.merged_into = parent;
  }
}

}  // namespace

EliminationPlan plan_elimination(int variables, const VariableSets& sets,
                                 const std::vector<char>& late, double zero_share) {
  Elimination elimination = eliminate(variables, sets, order_late_last(variables, sets, late));
  std::vector<int> step(variables);
  for (int i = 0; i < variables; ++i) step[elimination.order[i]] = i;
  VariableSets& met = elimination.met;
  for (int& v : met.members) v = step[v];
  std::vector<Group> groups(variables);
  std::vector<std::vector<int>> children(variables);
  for (int i = 0; i < variables; ++i) {
    std::sort(met.members.begin() + met.begin[i], met.members.begin() + met.begin[i + 1]);
    groups[i].frontal = {i};
    groups[i].separator_size = met.begin[i + 1] - met.begin[i];
    absorb_children(groups, children[i], i, zero_share);
    if (groups[i].separator_size > 0) children[met.members[met.begin[i]]].push_back(i);
  }
  EliminationPlan plan;
  std::vector<int> front_of(variables, -1);
  for (int i = 0; i < variables; ++i) {
    if (groups[i].merged_into >= 0) continue;
    front_of[i] = static_cast<int>(plan.fronts.size());
    FrontPlan& front = plan.fronts.emplace_back();
    std::sort(groups[i].frontal.begin(), groups[i].frontal.end());
    for (const int k : groups[i].frontal) front.frontal.push_back(elimination.order[k]);
    for (int j = met.begin[i]; j < met.begin[i + 1]; ++j)
      front.separator.push_back(elimination.order[met.members[j]]);
  }
  for (int i = 0; i < variables; ++i) {
    if (front_of[i] < 0 || groups[i].separator_size == 0) continue;
    int parent = met.members[met.begin[i]];
    while (groups[parent].merged_into >= 0) parent = groups[parent].merged_into;
    plan.fronts[front_of[i]].parent = front_of[parent];
  }
  return plan;
}

}  // namespace placegraph
