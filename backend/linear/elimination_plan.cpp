#include <placegraph/backend/linear/elimination_plan.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <queue>

namespace placegraph {
namespace {

/// The order of elimination and, for every variable, those it still meets when its turn comes.
struct Elimination {
  std::vector<int> order;
  VariableSets met;  ///< set i belongs to order[i]; members not sorted
};

/// Approximate minimum degree on a growing list of sets: eliminating a variable replaces the sets
/// that hold it by their union.
class MinimumDegree {
 public:
  MinimumDegree(int variables, const VariableSets& sets, const std::vector<char>& late)
      : late_(late),
        first_(variables + 1, 0),
        count_(variables, 0),
        degree_(variables, 0),
        mark_(variables, -1),
        eliminated_(variables, 0) {
    spans_.reserve(sets.size() + variables);
    for (int s = 0; s < sets.size(); ++s)
      spans_.push_back({sets.members.data() + sets.begin[s], sets.begin[s + 1] - sets.begin[s]});
    stamp_.assign(sets.size() + variables, -1);
    outside_.assign(sets.size() + variables, 0);
    for (const int v : sets.members) ++first_[v + 1];
    for (int v = 0; v < variables; ++v) first_[v + 1] += first_[v];
    sets_of_.resize(sets.members.size());
    for (int s = 0; s < sets.size(); ++s)
      for (int i = 0; i < spans_[s].size; ++i) {
        const int v = spans_[s].members[i];
        sets_of_[first_[v] + count_[v]++] = s;
        degree_[v] += spans_[s].size - 1;
      }
    for (int v = 0; v < variables; ++v) push(v);
  }

  Elimination run() {
    const int variables = static_cast<int>(degree_.size());
    Elimination result;
    result.order.reserve(variables);
    unions_.reserve(variables);
    while (static_cast<int>(result.order.size()) < variables) {
      const Candidate candidate = queue_.top();
      queue_.pop();
      if (eliminated_[candidate.variable] || candidate.key != key(candidate.variable)) continue;
      eliminate(candidate.variable, static_cast<int>(result.order.size()));
      result.order.push_back(candidate.variable);
    }
    for (const std::vector<int>& met : unions_) {
      result.met.members.insert(result.met.members.end(), met.begin(), met.end());
      result.met.close();
    }
    return result;
  }

 private:
  struct Span {
    const int* members;
    int size;  ///< 0 once replaced
  };
  struct Candidate {
    std::int64_t key;
    int variable;
    bool operator>(const Candidate& other) const {
      return key != other.key ? key > other.key : variable > other.variable;
    }
  };

  std::int64_t key(int v) const { return degree_[v] + (late_[v] ? std::int64_t{1} << 40 : 0); }
  void push(int v) { queue_.push({key(v), v}); }

  void eliminate(int v, int step) {
    eliminated_[v] = true;
    std::vector<int> met;
    mark_[v] = step;
    for (int i = 0; i < count_[v]; ++i) {
      Span& span = spans_[sets_of_[first_[v] + i]];
      for (int j = 0; j < span.size; ++j) {
        const int u = span.members[j];
        if (mark_[u] == step) continue;
        mark_[u] = step;
        met.push_back(u);
      }
      span.size = 0;
    }
    const int united = static_cast<int>(spans_.size());
    const int size = static_cast<int>(met.size());
    unions_.push_back(std::move(met));
    spans_.push_back({unions_.back().data(), size});
    for (const int u : unions_.back()) count_outside(u, united, step);
    for (const int u : unions_.back()) update_degree(u, size);
  }

  /// Puts the new set in the place of those it replaced, and counts for every other set of `u` how
  /// many of its members the new one does not hold.
  void count_outside(int u, int united, int step) {
    int kept = 0;
    for (int i = 0; i < count_[u]; ++i) {
      const int s = sets_of_[first_[u] + i];
      if (spans_[s].size == 0) continue;
      if (stamp_[s] != step) {
        stamp_[s] = step;
        outside_[s] = spans_[s].size;
      }
      --outside_[s];
      sets_of_[first_[u] + kept++] = s;
    }
    sets_of_[first_[u] + kept++] = united;
    count_[u] = kept;
  }

  void update_degree(int u, int united_size) {
    std::int64_t degree = united_size - 1;
    int kept = 0;
    for (int i = 0; i + 1 < count_[u]; ++i) {
      const int s = sets_of_[first_[u] + i];
      if (outside_[s] == 0) continue;  // held by the new set: says nothing more
      degree += outside_[s];
      sets_of_[first_[u] + kept++] = s;
    }
    sets_of_[first_[u] + kept++] = sets_of_[first_[u] + count_[u] - 1];
    count_[u] = kept;
    degree_[u] = degree;
    push(u);
  }

  const std::vector<char>& late_;
  std::vector<Span> spans_;
  std::vector<int> stamp_, outside_;  ///< per set
  std::vector<int> first_, count_;    ///< per variable: where its sets stand in sets_of_
  std::vector<int> sets_of_;
  std::vector<std::int64_t> degree_;
  std::vector<int> mark_;
  std::vector<char> eliminated_;
  std::vector<std::vector<int>> unions_;
  std::priority_queue<Candidate, std::vector<Candidate>, std::greater<>> queue_;
};

/// Fronts while they grow, named by the step of their last variable.
struct Group {
  std::vector<int> frontal;  ///< steps
  std::int64_t zeros = 0;
  int separator_size = 0;
  int merged_into = -1;
};

std::int64_t entries(std::int64_t frontal, std::int64_t separator) {
  return frontal * (frontal + 1) / 2 + frontal * separator;
}

/// Takes children into `parent` as long as few zeros come with them.
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
  Elimination elimination = MinimumDegree(variables, sets, late).run();
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
