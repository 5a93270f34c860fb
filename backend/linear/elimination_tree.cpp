#include <placegraph/backend/linear/elimination_plan.h>
#include <placegraph/backend/linear/elimination_tree.h>

#include <algorithm>

namespace placegraph {
namespace {

/// Zeros a front may hold for being larger.
constexpr double kZeroShare = 0.2;

}  // namespace

template <int D>
int EliminationTree<D>::add_variable() {
  variables_.emplace_back();
  return static_cast<int>(variables_.size()) - 1;
}

template <int D>
void EliminationTree<D>::set_active(int variable, bool active) {
  Variable& v = variables_[variable];
  if (v.active == active) return;
  // Whatever the variable is joined to has it in a separator on the way to the root, or will have.
  for (const int t : v.terms) {
    touch(terms_[t].a);
    if (terms_[t].b >= 0) touch(terms_[t].b);
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
  int t = static_cast<int>(terms_.size());
  if (free_terms_.empty()) {
    terms_.emplace_back();
  } else {
    t = free_terms_.back();
    free_terms_.pop_back();
  }
  terms_[t] = {a, b, Block::Zero(), Block::Zero(), Block::Zero(), true};
  variables_[a].terms.push_back(t);
  if (b >= 0) variables_[b].terms.push_back(t);
  if (!covered(terms_[t])) {
    touch(a);
    touch(b);
  }
  return t;
}

/// Whether some front holds all active variables of the term.
template <int D>
bool EliminationTree<D>::covered(const Term& term) const {
  if (term.b < 0) return true;
  const Variable &a = variables_[term.a], &b = variables_[term.b];
  if (!a.active || !b.active) return true;
  if (a.front < 0 || b.front < 0) return false;
  if (a.front == b.front) return true;
  const bool a_first = a.order < b.order;
  const Front& front = fronts_[a_first ? a.front : b.front];
  return std::find(front.separator.begin(), front.separator.end(), a_first ? term.b : term.a) !=
         front.separator.end();
}

template <int D>
void EliminationTree<D>::set_information(int term, const Block& H_aa, const Block& H_ab,
                                         const Block& H_bb) {
  Term& t = terms_[term];
  t.H_aa = H_aa;
  t.H_ab = H_ab;
  t.H_bb = H_bb;
  t.zero = false;
  for (const int v : {t.a, t.b}) {
    if (v < 0) continue;
    variables_[v].diagonal_stale = true;
    if (variables_[v].front >= 0) mark_stale(variables_[v].front, true);
  }
}

template <int D>
void EliminationTree<D>::remove_term(int term) {
  const Block zero = Block::Zero();
  set_information(term, zero, zero, zero);
  for (const int v : {terms_[term].a, terms_[term].b}) {
    if (v < 0) continue;
    std::erase(variables_[v].terms, term);
    if (terms_[term].b >= 0) touch(v);  // what it filled in is to go, too
  }
  free_terms_.push_back(term);
}

template <int D>
void EliminationTree<D>::set_gradient(int variable, const Vector& g) {
  Variable& v = variables_[variable];
  v.gradient = g;
  if (v.front >= 0) mark_stale(v.front, false);
}

template <int D>
void EliminationTree<D>::set_damping(double damping) {
  if (damping == damping_) return;
  damping_ = damping;
  for (std::size_t v = 0; v < variables_.size(); ++v)
    if (variables_[v].front >= 0) mark_stale(variables_[v].front, true);
}

template <int D>
void EliminationTree<D>::mark_stale(int front, bool matrix) {
  for (; front >= 0; front = fronts_[front].parent) {
    Front& f = fronts_[front];
    if (f.rhs_stale && (f.matrix_stale || !matrix)) return;  // and so are all above it
    if (!f.rhs_stale) stale_rhs_.push_back(front);
    f.rhs_stale = true;
    if (!matrix || f.matrix_stale) continue;
    f.matrix_stale = true;
    stale_matrices_.push_back(front);
  }
}

template <int D>
const typename EliminationTree<D>::Block& EliminationTree<D>::diagonal(int variable) {
  Variable& v = variables_[variable];
  if (!v.diagonal_stale) return v.diagonal;
  v.diagonal.setZero();
  for (const int t : v.terms)
    v.diagonal += terms_[t].a == variable ? terms_[t].H_aa : terms_[t].H_bb;
  v.diagonal_stale = false;
  return v.diagonal;
}

template <int D>
int EliminationTree<D>::new_front() {
  if (free_fronts_.empty()) {
    fronts_.emplace_back();
    return static_cast<int>(fronts_.size()) - 1;
  }
  const int front = free_fronts_.back();
  free_fronts_.pop_back();
  return front;
}

/// Whether one front is eliminated before another: children come before their parents.
template <int D>
bool EliminationTree<D>::earlier(int a, int b) const {
  return variables_[fronts_[a].frontal.front()].order <
         variables_[fronts_[b].frontal.front()].order;
}

/// Takes all fronts on the way from the touched variables to their roots out of the forest; returns
/// their active variables and those that were in no front, and the fronts that hung below.
template <int D>
std::vector<int> EliminationTree<D>::collect_top(std::vector<int>& orphans) {
  std::vector<int> top, fronts;
  for (const int t : touched_) {
    if (variables_[t].front < 0 && variables_[t].active && variables_[t].local < 0) {
      variables_[t].local = 0;
      top.push_back(t);
    }
    for (int f = variables_[t].front; f >= 0 && !fronts_[f].in_top; f = fronts_[f].parent) {
      fronts_[f].in_top = true;
      fronts.push_back(f);
    }
  }
  for (const int f : fronts) {
    for (const int child : fronts_[f].children)
      if (!fronts_[child].in_top) orphans.push_back(child);
    for (const int v : fronts_[f].frontal) {
      variables_[v].front = -1;
      if (variables_[v].active) top.push_back(v);
    }
  }
  const auto in_top = [&](int f) { return fronts_[f].in_top; };
  std::erase_if(roots_, in_top);
  std::erase_if(stale_matrices_, in_top);
  std::erase_if(stale_rhs_, in_top);
  for (const int f : fronts) {
    Front& front = fronts_[f];
    entries_ -= static_cast<std::int64_t>(front.frontal.size()) * front.blocks();
    pool_.release(front.matrix);
    front.children.clear();
    front.frontal.clear();
    front.separator.clear();
    front.parent = -1;
    front.in_top = false;
    free_fronts_.push_back(f);
  }
  // Older ones first, so that the order does not depend on the way they were found.
  std::sort(top.begin(), top.end());
  return top;
}

/// What is eliminated together or fills in together, by places in `top`: the pairs of its terms and
/// the separators of the orphans.
template <int D>
VariableSets EliminationTree<D>::sets_of(const std::vector<int>& top,
                                         const std::vector<int>& orphans) const {
  VariableSets sets;
  for (const int v : top)
    for (const int t : variables_[v].terms) {
      const Term& term = terms_[t];
      if (term.a != v || term.b < 0 || variables_[term.b].local < 0 || !variables_[term.b].active)
        continue;
      sets.members.insert(sets.members.end(), {variables_[v].local, variables_[term.b].local});
      sets.close();
    }
  for (const int f : orphans) {
    for (const int v : fronts_[f].separator) sets.members.push_back(variables_[v].local);
    sets.close();
  }
  return sets;
}

template <int D>
void EliminationTree<D>::restructure() {
  if (reorder_all_)
    for (std::size_t v = 0; v < variables_.size(); ++v) touch(static_cast<int>(v));
  if (touched_.empty()) return;
  std::vector<int> orphans;
  const std::vector<int> top = collect_top(orphans);
  for (std::size_t i = 0; i < top.size(); ++i) variables_[top[i]].local = static_cast<int>(i);

  const VariableSets sets = sets_of(top, orphans);
  std::vector<char> late(top.size());
  if (!reorder_all_)
    for (const int v : touched_)
      if (variables_[v].local >= 0) late[variables_[v].local] = true;
  const EliminationPlan plan =
      plan_elimination(static_cast<int>(top.size()), sets, late, kZeroShare);

  std::vector<int> front_of_plan;
  for (const FrontPlan& planned : plan.fronts) {
    const int f = new_front();
    front_of_plan.push_back(f);
    Front& front = fronts_[f];
    for (const int i : planned.frontal) {
      front.frontal.push_back(top[i]);
      variables_[top[i]].front = f;
      variables_[top[i]].order = next_order_++;
    }
    for (const int i : planned.separator) front.separator.push_back(top[i]);
    front.matrix_stale = front.rhs_stale = true;
    stale_matrices_.push_back(f);
    stale_rhs_.push_back(f);
    entries_ += static_cast<std::int64_t>(front.frontal.size()) * front.blocks();
  }
  const auto hang = [&](int f, int parent) {
    fronts_[f].parent = parent;
    (parent < 0 ? roots_ : fronts_[parent].children).push_back(f);
  };
  for (std::size_t i = 0; i < plan.fronts.size(); ++i) {
    const int parent = plan.fronts[i].parent;
    hang(front_of_plan[i], parent < 0 ? -1 : front_of_plan[parent]);
  }
  for (const int f : orphans) {
    int first = fronts_[f].separator.front();
    for (const int v : fronts_[f].separator)
      if (variables_[v].order < variables_[first].order) first = v;
    hang(f, variables_[first].front);
  }
  for (const int v : top) variables_[v].local = -1;
  if (reorder_all_) entries_when_ordered_ = entries_;
  reorder_all_ = false;
  touched_.clear();
}

template class EliminationTree<3>;
template class EliminationTree<6>;
template class EliminationTree<7>;

}  // namespace placegraph
