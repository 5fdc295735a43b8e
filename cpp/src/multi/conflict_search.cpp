#include "clearway/multi/conflict_search.hpp"

#include <algorithm>
#include <cmath>

namespace clearway {

namespace {

constexpr double kGreedier = 1.6, kLeastGreed = 0.1;  // from one attempt to the next

}  // namespace

ConflictSearch::ConflictSearch(const std::vector<Model>& models, std::vector<Agent> agents,
                               const ConflictParams& params, ConflictProgress progress)
    : params_(params),
      team_(models, std::move(agents), SearchParams{}, params.objective, params.margin),
      progress_(std::move(progress)) {
  const std::size_t n = team_.size();
  routing_.team = &team_;
  routing_.slot = params.lattice.slot;
  for (std::size_t i = 0; i < n; ++i) {
    const Agent& agent = team_.agent(i);
    const Pose& at = agent.legs.empty() ? agent.start : agent.legs.back().goal;
    routing_.rests.push_back(
        {&team_.model(i).bodies[static_cast<std::size_t>(agent.rest_body)], Frame(at)});
  }
  for (std::size_t i = 0; i < n; ++i) {
    const Agent& agent = team_.agent(i);
    routing_.searches.push_back(nullptr);
    if (agent.legs.empty()) {
      Rule rule;
      rule.kind = Rule::Kind::kAvoid;
      rule.other = static_cast<int>(i);
      routing_.always.push_back(rule);
      continue;
    }
    routing_.searches[i] = std::make_unique<LatticeSearch>(
        team_.model(i), agent.legs, agent.start, agent.mode, agent.rest_body, routing_.rests,
        team_.required(i), params.objective, params.lattice);
    group_of_.push_back(groups_.size());
    groups_.push_back({{static_cast<int>(i)}, 0.0, 0.0});
  }
  routes_.resize(n);
  result_.tours.resize(n);
}

bool ConflictSearch::prepare(Heuristic heuristic) {
  for (std::size_t i = 0; i < team_.size(); ++i) {
    if (!routing_.searches[i] || routing_.searches[i]->prepare(heuristic)) continue;
    result_.too_large = true;
    result_.concerned.push_back(static_cast<int>(i));
  }
  return !result_.too_large;
}

// Each attempt is greedier than the last.
Guidance ConflictSearch::greedy(int attempt) const {
  const double more = std::pow(kGreedier, attempt);
  Guidance guidance;
  guidance.heuristic = params_.heuristic;
  // At 1 all is as without greed, but for the meetings that are shunned.
  guidance.xi = attempt == 0 ? std::max(params_.xi, 1.0 + 1e-9)
                             : 1.0 + std::max(params_.xi - 1.0, kLeastGreed) * more;
  guidance.adaptive = params_.adaptive;
  guidance.meeting = params_.meeting * more;
  return guidance;
}

double ConflictSearch::bound() const {
  double sum = 0.0;
  for (const Group& group : groups_) sum += group.bound;
  return sum;
}

void ConflictSearch::keep(const Routes& routes, double cost) {
  if (result_.status == ConflictResult::Status::kSolved && result_.cost <= cost) return;
  result_.status = ConflictResult::Status::kSolved;
  result_.cost = cost;
  kept_ = routes;
}

void ConflictSearch::plan_greedily(Budget& budget) {
  std::vector<int> all;
  for (const Group& group : groups_) all.push_back(group.members.front());
  const auto size = static_cast<std::int64_t>(all.size());
  result_.largest_group = static_cast<int>(size);
  for (int attempt = 0;; ++attempt) {
    const bool last = attempt == params_.attempts;
    const std::int64_t most =
        last ? params_.most_nodes : std::min(params_.most_nodes, 40 + 12 * size);
    ConflictTree tree(routing_, all, routes_, greedy(attempt), 1.0, even(), most);
    const auto outcome = tree(budget, [&](std::size_t conflicts, double) {
      if (progress_) progress_(static_cast<int>(conflicts), budget.spent, 0.0, 0.0);
    });
    result_.nodes += tree.num_nodes();
    result_.searches += tree.num_searches();
    if (outcome == ConflictTree::Outcome::kSolved) keep(tree.routes(), tree.cost());
    if (outcome == ConflictTree::Outcome::kNone && tree.stuck() >= 0) {
      result_.status = ConflictResult::Status::kNone;
      result_.concerned = {tree.stuck()};
      return;
    }
    if (outcome == ConflictTree::Outcome::kSolved || last || budget.ended) return;
  }
}

// Plan a group as well as asked for, among the routes of all others.
ConflictTree::Outcome ConflictSearch::solve(Group& group, Budget& budget) {
  Guidance guidance;
  guidance.heuristic = params_.heuristic;
  guidance.focus = params_.mode == ConflictParams::Mode::kBounded ? params_.factor : 1.0;
  ConflictTree tree(routing_, group.members, routes_, guidance, guidance.focus, even(),
                    params_.most_nodes);
  const double others = bound() - group.bound, known = group.bound;
  const auto outcome = tree(budget, [&](std::size_t conflicts, double b) {
    if (!progress_) return;
    const bool has_plan = result_.status == ConflictResult::Status::kSolved;
    progress_(static_cast<int>(conflicts), budget.spent, has_plan ? result_.cost : 0.0,
              others + std::max(b, known));
  });
  result_.nodes += tree.num_nodes();
  result_.searches += tree.num_searches();
  group.bound = std::max(group.bound, tree.bound());
  if (outcome == ConflictTree::Outcome::kSolved) {
    group.cost = tree.cost();
    routes_ = tree.routes();
  } else if (outcome == ConflictTree::Outcome::kNone && tree.stuck() >= 0) {
    result_.concerned = {tree.stuck()};
  }
  return outcome;
}

// The first meeting of robots of different groups.
Meeting ConflictSearch::meeting_of_groups() const {
  Meeting first;
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    for (std::size_t h = 0; h < g; ++h) {
      for (const int i : groups_[g].members) {
        for (const int j : groups_[h].members) {
          const double tick = first_meeting(routing_, *routes_[static_cast<std::size_t>(i)], i,
                                            *routes_[static_cast<std::size_t>(j)], j);
          if (tick >= 0.0 && (first.a < 0 || tick < first.tick)) {
            first = {static_cast<int>(g), static_cast<int>(h), tick};
          }
        }
      }
    }
  }
  return first;
}

void ConflictSearch::prove(Budget& budget) {
  const double factor = params_.mode == ConflictParams::Mode::kBounded ? params_.factor : 1.0;
  const auto proven = [&] {
    result_.bound = bound();
    return result_.status == ConflictResult::Status::kSolved &&
           result_.cost <= factor * result_.bound + even();
  };
  const auto plan = [&](Group& group) {
    const auto outcome = solve(group, budget);
    if (outcome == ConflictTree::Outcome::kNone) result_.status = ConflictResult::Status::kNone;
    return outcome == ConflictTree::Outcome::kSolved;
  };
  for (Group& group : groups_) {
    if (!plan(group)) {
      result_.bound = bound();
      return;
    }
  }
  result_.largest_group = 1;
  while (!(result_.proven = proven())) {
    const Meeting met = meeting_of_groups();
    if (met.a < 0) {
      double cost = 0.0;
      for (const Group& group : groups_) cost += group.cost;
      keep(routes_, cost);
      result_.proven = proven();
      return;
    }
    const auto g = static_cast<std::size_t>(met.a), h = static_cast<std::size_t>(met.b);
    Group& joined = groups_[h];
    joined.members.insert(joined.members.end(), groups_[g].members.begin(),
                          groups_[g].members.end());
    joined.bound += groups_[g].bound;
    groups_.erase(groups_.begin() + static_cast<std::ptrdiff_t>(g));
    result_.largest_group =
        std::max(result_.largest_group, static_cast<int>(groups_[h].members.size()));
    if (!plan(groups_[h])) {
      result_.proven = proven();
      return;
    }
  }
}

ConflictResult ConflictSearch::operator()(Budget& budget) {
  const bool proves = params_.mode != ConflictParams::Mode::kGreedy;
  if (groups_.empty()) {
    keep(routes_, 0.0);
    result_.proven = proves;
  } else if (prepare(params_.heuristic)) {
    if (proves) {
      // A first plan, which is the answer where nothing better is proven in time.
      Budget first = budget;
      if (first.expansions < 0 || first.expansions > first.spent + params_.first_limit) {
        first.expansions = first.spent + params_.first_limit;
      }
      plan_greedily(first);
      const bool full = first.expansions == first.spent;
      budget.spent = first.spent;
      budget.ended = first.ended && !full;
      if (result_.status != ConflictResult::Status::kNone && !budget.ended) prove(budget);
    } else {
      plan_greedily(budget);
    }
  }
  for (std::size_t i = 0; i < kept_.size(); ++i) {
    if (!kept_[i]) continue;
    TourResult& tour = result_.tours[i];
    tour.outcome = TourResult::Outcome::kFound;
    tour.pieces = kept_[i]->pieces;
    tour.stops = kept_[i]->stops;
    tour.arrival = kept_[i]->arrival;
    tour.cost = kept_[i]->cost;
  }
  result_.expansions = budget.spent;
  return result_;
}

}  // namespace clearway
