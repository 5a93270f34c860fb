#include <placegraph/backend/elimination/elimination_plan.h>
#include <placegraph/backend/elimination/elimination_tree.h>
#include <placegraph/backend/elimination/front_assembly.h>
#include <placegraph/backend/elimination/front_covariance.h>
#include <placegraph/backend/elimination/front_kernels.h>
#include <placegraph/graph/core/parallel.h>

#include <algorithm>

namespace placegraph {
namespace {

/// Maximum share of zeros in a merged front.
constexpr double kZeroShare = 0.2;

}  // namespace

template <int D>
int EliminationTree<D>::add_variable() {
  forest_.variables.emplace_back();
  return static_cast<int>(forest_.variables.size()) - 1;
}

template <int D>
void EliminationTree<D>::set_active(int variable, bool active) {
  Variable& v = forest_.variables[variable];
  if (v.active == active) return;
  // Every neighbour of the variable has it in a separator on the path to the root, or will have it.
  for (const int t : v.terms) {
    touch(forest_.terms[t].a);
    if (forest_.terms[t].b >= 0) touch(forest_.terms[t].b);
  }
  touch(variable);
  v.active = active;
}

template <int D>
void EliminationTree<D>::touch(int variable) {
  touched_.push_back(variable);
}

template <int D>
int EliminationTree<D>::add_term(int a, int b) {
  int t = static_cast<int>(forest_.terms.size());
  if (free_terms_.empty()) {
    forest_.terms.emplace_back();
  } else {
    t = free_terms_.back();
    free_terms_.pop_back();
  }
  forest_.terms[t] = {a, b, Block::Zero(), Block::Zero(), Block::Zero(), true};
  forest_.variables[a].terms.push_back(t);
  if (b >= 0) forest_.variables[b].terms.push_back(t);
  if (!covered(forest_.terms[t])) {
    touch(a);
    touch(b);
  }
  return t;
}

/// Whether a front contains all active variables of the term.
template <int D>
bool EliminationTree<D>::covered(const Term& term) const {
  if (term.b < 0) return true;
  const Variable &a = forest_.variables[term.a], &b = forest_.variables[term.b];
  if (!a.active || !b.active) return true;
  if (a.front < 0 || b.front < 0) return false;
  if (a.front == b.front) return true;
  const bool a_first = a.order < b.order;
  const Front& front = forest_.fronts[a_first ? a.front : b.front];
  return std::find(front.separator.begin(), front.separator.end(), a_first ? term.b : term.a) !=
         front.separator.end();
}

template <int D>
void EliminationTree<D>::set_information(int term, const Block& H_aa, const Block& H_ab,
                                         const Block& H_bb) {
  Term& t = forest_.terms[term];
  t.H_aa = H_aa;
  t.H_ab = H_ab;
  t.H_bb = H_bb;
  t.zero = false;
  for (const int v : {t.a, t.b}) {
    if (v < 0) continue;
    forest_.variables[v].diagonal_stale = true;
    if (forest_.variables[v].front >= 0) mark_stale(forest_.variables[v].front, true);
  }
}

template <int D>
void EliminationTree<D>::remove_term(int term) {
  const Block zero = Block::Zero();
  set_information(term, zero, zero, zero);
  for (const int v : {forest_.terms[term].a, forest_.terms[term].b}) {
    if (v < 0) continue;
    std::erase(forest_.variables[v].terms, term);
    if (forest_.terms[term].b >= 0) touch(v);  // its fill is to be removed, too
  }
  free_terms_.push_back(term);
}

template <int D>
void EliminationTree<D>::set_gradient(int variable, const Vector& g) {
  Variable& v = forest_.variables[variable];
  v.gradient = g;
  if (v.front >= 0) mark_stale(v.front, false);
}

template <int D>
void EliminationTree<D>::set_damping(double damping) {
  if (damping == damping_) return;
  damping_ = damping;
  for (std::size_t v = 0; v < forest_.variables.size(); ++v)
    if (forest_.variables[v].front >= 0) mark_stale(forest_.variables[v].front, true);
}

template <int D>
void EliminationTree<D>::mark_stale(int front, bool matrix) {
  for (; front >= 0; front = forest_.fronts[front].parent) {
    Front& f = forest_.fronts[front];
    if (f.rhs_stale && (f.matrix_stale || !matrix)) return;  // all fronts above it are stale, too
    if (!f.rhs_stale) stale_rhs_.push_back(front);
    f.rhs_stale = true;
    if (!matrix || f.matrix_stale) continue;
    f.matrix_stale = true;
    stale_matrices_.push_back(front);
  }
}

template <int D>
int EliminationTree<D>::new_front() {
  if (free_fronts_.empty()) {
    forest_.fronts.emplace_back();
    return static_cast<int>(forest_.fronts.size()) - 1;
  }
  const int front = free_fronts_.back();
  free_fronts_.pop_back();
  return front;
}

/// Removes all fronts on the paths from the touched variables to their roots from the forest.
/// Returns their active variables and those that were in no front, and the fronts whose parents
/// were removed.
template <int D>
std::vector<int> EliminationTree<D>::collect_top(std::vector<int>& orphans) {
  std::vector<int> top, fronts;
  for (const int t : touched_) {
    if (forest_.variables[t].front < 0 && forest_.variables[t].active &&
        forest_.variables[t].local < 0) {
      forest_.variables[t].local = 0;
      top.push_back(t);
    }
    for (int f = forest_.variables[t].front; f >= 0 && !forest_.fronts[f].in_top;
         f = forest_.fronts[f].parent) {
      forest_.fronts[f].in_top = true;
      fronts.push_back(f);
    }
  }
  for (const int f : fronts) {
    for (const int child : forest_.fronts[f].children)
      if (!forest_.fronts[child].in_top) orphans.push_back(child);
    for (const int v : forest_.fronts[f].frontal) {
      forest_.variables[v].front = -1;
      if (forest_.variables[v].active) top.push_back(v);
    }
  }
  const auto in_top = [&](int f) { return forest_.fronts[f].in_top; };
  std::erase_if(forest_.roots, in_top);
  std::erase_if(stale_matrices_, in_top);
  std::erase_if(stale_rhs_, in_top);
  for (const int f : fronts) {
    Front& front = forest_.fronts[f];
    entries_ -= static_cast<std::int64_t>(front.frontal.size()) * front.blocks();
    pool_.release(front.matrix);
    front.children.clear();
    front.frontal.clear();
    front.separator.clear();
    front.parent = -1;
    front.in_top = false;
    free_fronts_.push_back(f);
  }
  // Older variables first, so that the order does not depend on the order of the search.
  std::sort(top.begin(), top.end());
  return top;
}

/// The sets of variables in `top` that are connected, by positions in `top`.
/// They are the pairs of the terms and the separators of the orphans.
template <int D>
VariableSets EliminationTree<D>::sets_of(const std::vector<int>& top,
                                         const std::vector<int>& orphans) const {
  VariableSets sets;
  for (const int v : top)
    for (const int t : forest_.variables[v].terms) {
      const Term& term = forest_.terms[t];
      if (term.a != v || term.b < 0 || forest_.variables[term.b].local < 0 ||
          !forest_.variables[term.b].active)
        continue;
      sets.members.insert(sets.members.end(),
                          {forest_.variables[v].local, forest_.variables[term.b].local});
      sets.close();
    }
  for (const int f : orphans) {
    for (const int v : forest_.fronts[f].separator)
      sets.members.push_back(forest_.variables[v].local);
    sets.close();
  }
  return sets;
}

template <int D>
void EliminationTree<D>::restructure() {
  if (reorder_all_)
    for (std::size_t v = 0; v < forest_.variables.size(); ++v) touch(static_cast<int>(v));
  if (touched_.empty()) return;
  std::vector<int> orphans;
  const std::vector<int> top = collect_top(orphans);
  for (std::size_t i = 0; i < top.size(); ++i)
    forest_.variables[top[i]].local = static_cast<int>(i);

  const VariableSets sets = sets_of(top, orphans);
  std::vector<char> late(top.size());
  if (!reorder_all_)
    for (const int v : touched_)
      if (forest_.variables[v].local >= 0) late[forest_.variables[v].local] = true;
  const EliminationPlan plan =
      plan_elimination(static_cast<int>(top.size()), sets, late, kZeroShare);

  std::vector<int> front_of_plan;
  for (const FrontPlan& planned : plan.fronts) {
    const int f = new_front();
    front_of_plan.push_back(f);
    Front& front = forest_.fronts[f];
    for (const int i : planned.frontal) {
      front.frontal.push_back(top[i]);
      forest_.variables[top[i]].front = f;
      forest_.variables[top[i]].order = next_order_++;
    }
    for (const int i : planned.separator) front.separator.push_back(top[i]);
    front.matrix_stale = front.rhs_stale = true;
    stale_matrices_.push_back(f);
    stale_rhs_.push_back(f);
    entries_ += static_cast<std::int64_t>(front.frontal.size()) * front.blocks();
  }
  const auto hang = [&](int f, int parent) {
    forest_.fronts[f].parent = parent;
    (parent < 0 ? forest_.roots : forest_.fronts[parent].children).push_back(f);
  };
  for (std::size_t i = 0; i < plan.fronts.size(); ++i) {
    const int parent = plan.fronts[i].parent;
    hang(front_of_plan[i], parent < 0 ? -1 : front_of_plan[parent]);
  }
  for (const int f : orphans) {
    int first = forest_.fronts[f].separator.front();
    for (const int v : forest_.fronts[f].separator)
      if (forest_.variables[v].order < forest_.variables[first].order) first = v;
    hang(f, forest_.variables[first].front);
  }
  for (const int v : top) forest_.variables[v].local = -1;
  if (reorder_all_) entries_when_ordered_ = entries_;
  reorder_all_ = false;
  touched_.clear();
}

template <int D>
bool EliminationTree<D>::factorize_stale() {
  std::sort(stale_matrices_.begin(), stale_matrices_.end(),
            [&](int a, int b) { return forest_.earlier(a, b); });
  for (const int f : stale_matrices_) {
    check_interruption();
    Front& front = forest_.fronts[f];
    assemble(forest_, front, damping_, pool_);
    const int frontal = static_cast<int>(front.frontal.size());
    if (!FrontKernels<D>::factorize(front.matrix.data(), front.blocks() * D, frontal * D))
      return false;
    variables_refactored_ += frontal;
  }
  for (const int f : stale_matrices_) forest_.fronts[f].matrix_stale = false;
  stale_matrices_.clear();
  return true;
}

template <int D>
bool EliminationTree<D>::factorize() {
  variables_refactored_ = 0;
  restructure();
  return factorize_stale();
}

template <int D>
double EliminationTree<D>::model_decrease() {
  std::sort(stale_rhs_.begin(), stale_rhs_.end(),
            [&](int a, int b) { return forest_.earlier(a, b); });
  for (const int f : stale_rhs_) {
    substitute_forward(forest_, forest_.fronts[f]);
    forest_.fronts[f].rhs_stale = false;
  }
  stale_rhs_.clear();
  double decrease = 0;
  for (const int f : forest_.roots) decrease += forest_.fronts[f].decrease;
  return decrease;
}

template <int D>
const std::vector<int>& EliminationTree<D>::solve(double threshold) {
  for (const int v : solved_) {
    forest_.variables[v].delta.setZero();
    forest_.variables[v].significant = false;
  }
  solved_.clear();
  std::vector<int> open(forest_.roots.rbegin(), forest_.roots.rend());
  std::vector<double> x;
  while (!open.empty()) {
    const Front& front = forest_.fronts[open.back()];
    open.pop_back();
    bool moved = front.decrease > threshold;
    for (const int v : front.separator) moved |= forest_.variables[v].significant;
    if (!moved) continue;
    const int frontal = static_cast<int>(front.frontal.size()), blocks = front.blocks();
    x.assign(front.rhs.begin(), front.rhs.end());
    double* separator = x.data() + static_cast<std::size_t>(frontal) * D;
    for (const int v : front.separator)
      separator = std::copy_n(forest_.variables[v].delta.data(), D, separator);
    FrontKernels<D>::backward(front.matrix.data(), blocks * D, frontal * D, x.data());
    bool significant = front.decrease > threshold;
    for (int i = 0; i < frontal; ++i) {
      Variable& v = forest_.variables[front.frontal[i]];
      v.delta = Eigen::Map<const Vector>(&x[i * D]);
      v.significant = v.delta.dot(forest_.diagonal(front.frontal[i]) * v.delta) > threshold;
      significant |= v.significant;
    }
    if (!significant) {
      for (const int v : front.frontal) forest_.variables[v].delta.setZero();
      continue;
    }
    solved_.insert(solved_.end(), front.frontal.begin(), front.frontal.end());
    open.insert(open.end(), front.children.rbegin(), front.children.rend());
  }
  return solved_;
}

template <int D>
Eigen::MatrixXd EliminationTree<D>::covariance(const std::vector<int>& variables) const {
  return placegraph::covariance(forest_, variables);
}

template class EliminationTree<3>;
template class EliminationTree<6>;
template class EliminationTree<7>;

}  // namespace placegraph
