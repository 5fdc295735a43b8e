#include "clearway/multi/conflict_tree.hpp"

#include <algorithm>
#include <limits>

namespace clearway {

namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();

template <typename Entry>
void push_heap_entry(std::vector<Entry>& heap, const Entry& entry) {
  heap.push_back(entry);
  std::push_heap(heap.begin(), heap.end());
}

template <typename Entry>
Entry pop_heap_entry(std::vector<Entry>& heap) {
  std::pop_heap(heap.begin(), heap.end());
  const Entry entry = heap.back();
  heap.pop_back();
  return entry;
}

}  // namespace

ConflictTree::ConflictTree(Routing& routing, std::vector<int> members, Routes routes,
                           const Guidance& guidance, double factor, double even,
                           std::int64_t most_nodes)
    : routing_(routing),
      members_(std::move(members)),
      outside_(std::move(routes)),
      guidance_(guidance),
      factor_(factor),
      even_(even),
      most_nodes_(most_nodes),
      traffic_(routing.team->empty_traffic()) {
  for (const int i : members_) outside_[static_cast<std::size_t>(i)] = nullptr;
  routes_ = outside_;
  shown_.resize(outside_.size());
  take_routes(-1);
}

// Make the routes of a node, and their tracks, those at hand.
void ConflictTree::take_routes(std::int32_t i) {
  Routes routes = outside_;
  for (; i >= 0; i = node(i).parent) {
    auto& route = routes[static_cast<std::size_t>(node(i).robot)];
    if (!route) route = node(i).route;
  }
  routes_ = std::move(routes);
  for (std::size_t k = 0; k < routes_.size(); ++k) {
    const std::shared_ptr<const Track> track = routes_[k] ? routes_[k]->track : nullptr;
    if (track == shown_[k]) continue;
    if (shown_[k]) traffic_.remove(static_cast<int>(k));
    if (track) traffic_.insert(static_cast<int>(k), track);
    shown_[k] = track;
  }
}

void ConflictTree::find_rules(std::int32_t i, int robot, std::vector<Rule>& rules) const {
  for (; i >= 0; i = node(i).parent) {
    const Node& each = node(i);
    if (!each.has_rule) continue;
    if (each.bound_to >= 0) {
      rules.push_back(robot == each.bound_to ? opposite(each.rule) : each.rule);
      if (each.rule.kind == Rule::Kind::kPoint && robot != each.bound_to && robot != each.robot) {
        rules.back().gap = point_gap(routing_, robot, each.bound_to, each.rule.gap);
      }
    } else if (each.robot == robot) {
      rules.push_back(each.rule);
    }
  }
}

// The meetings of a node, the earliest first.
std::vector<Meeting> ConflictTree::meetings(const Node& node) const {
  std::vector<Meeting> all;
  for (const auto& [a, b] : node.conflicts) {
    const double tick = first_meeting(routing_, *routes_[static_cast<std::size_t>(a)], a,
                                      *routes_[static_cast<std::size_t>(b)], b);
    if (tick >= 0.0) all.push_back({a, b, tick});
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const Meeting& a, const Meeting& b) { return a.tick < b.tick; });
  return all;
}

// Plan a robot of the routes at hand anew, under one more rule. Nothing: there is no such way, or
// the search is over.
std::optional<ConflictTree::Node> ConflictTree::replan(std::int32_t parent, int robot,
                                                       const Rule* rule, int bound_to,
                                                       Budget& budget) {
  const auto i = static_cast<std::size_t>(robot);
  Node child;
  child.parent = parent;
  child.robot = robot;
  child.bound_to = bound_to;
  std::vector<Rule> rules = routing_.always;
  find_rules(parent, robot, rules);
  if (rule) {
    child.has_rule = true;
    child.rule = *rule;
    rules.push_back(*rule);
  }
  if (shown_[i]) traffic_.remove(robot);
  auto route = std::make_shared<Route>();
  ++num_searches_;
  const auto outcome = (*routing_.searches[i])(rules, &traffic_, guidance_, budget, *route);
  if (shown_[i]) traffic_.insert(robot, shown_[i]);
  over_ = outcome == LatticeSearch::Outcome::kStopped;
  if (outcome != LatticeSearch::Outcome::kFound) return std::nullopt;
  route->track = std::make_shared<const Track>(
      &routing_.team->model(i).bodies, routing_.team->agent(i).start, route->pieces, kNever);
  child.cost = route->cost;
  if (parent >= 0) {
    const Node& from = node(parent);
    child.cost += from.cost;
    child.bound = from.bound;
    if (const Route* before = routes_[i].get()) {
      child.cost -= before->cost;
      child.bound -= before->bound;
      route->bound = std::max(route->bound, before->bound);
    }
    for (const auto& pair : from.conflicts) {
      if (pair.first != robot && pair.second != robot) child.conflicts.push_back(pair);
    }
  }
  child.bound += route->bound;
  for (const int j : members_) {
    if (j == robot || !routes_[static_cast<std::size_t>(j)]) continue;
    const Route& other = *routes_[static_cast<std::size_t>(j)];
    if (first_meeting(routing_, *route, robot, other, j) < 0.0) continue;
    child.conflicts.emplace_back(static_cast<std::int16_t>(std::min(robot, j)),
                                 static_cast<std::int16_t>(std::max(robot, j)));
  }
  child.route = std::move(route);
  return child;
}

// Everybody's best way alone.
bool ConflictTree::grow_root(Budget& budget) {
  for (const int i : members_) {
    const auto root = static_cast<std::int32_t>(nodes_.size()) - 1;
    std::optional<Node> child = replan(root, i, nullptr, -1, budget);
    if (!child) {
      if (!over_) stuck_ = i;
      return false;
    }
    nodes_.push_back(std::move(*child));
    take_routes(root + 1);
  }
  Node root = std::move(nodes_.back());
  nodes_.pop_back();
  offer(std::move(root));
  return true;
}

void ConflictTree::offer(Node child) {
  const auto i = static_cast<std::int32_t>(nodes_.size());
  push_heap_entry(open_, {child.cost, i});
  push_heap_entry(live_, {child.bound, i});
  nodes_.push_back(std::move(child));
}

// The node to look at next: within the factor of the bound, the one with the fewest conflicts.
std::int32_t ConflictTree::next() {
  while (!live_.empty() && node(live_.front().node).done) pop_heap_entry(live_);
  if (live_.empty()) return -1;
  if (!greedy()) bound_ = std::max(bound_, live_.front().key);
  const double limit = greedy() ? kFar : factor_ * bound_ + even_;
  while (!open_.empty() && open_.front().key <= limit) {
    const std::int32_t i = pop_heap_entry(open_).node;
    const double conflicts = static_cast<double>(node(i).conflicts.size());
    push_heap_entry(focal_, {1e9 * conflicts + node(i).cost, i});
  }
  const std::int32_t i = pop_heap_entry(focal_).node;
  nodes_[static_cast<std::size_t>(i)].done = true;
  return i;
}

// Branch on the meeting that makes both sides dearest. A way that costs no more and meets fewer
// others simply takes the place of the old one. False: the search is over.
bool ConflictTree::split(std::int32_t i, Budget& budget) {
  const double cost = node(i).cost;
  const std::size_t conflicts = node(i).conflicts.size();
  std::vector<Node> best;
  int best_dearer = -1;
  for (const Meeting& met : meetings(node(i))) {
    const Branching sides = branch(routing_, met, *routes_[static_cast<std::size_t>(met.a)],
                                   *routes_[static_cast<std::size_t>(met.b)]);
    const int robots[2] = {met.a, met.b};
    std::vector<Node> children;
    int dearer = 2;
    for (int side = 0; side < 2; ++side) {
      // Greedy search wants a plan, not every plan once; a robot bound to something may be stuck.
      const int bound_to = sides.bound[side] && !greedy() ? robots[1 - side] : -1;
      std::optional<Node> child = replan(i, robots[side], &sides.rule[side], bound_to, budget);
      if (over_) return false;
      if (!child) continue;
      if (child->cost <= cost + even_) {
        --dearer;
        if (child->conflicts.size() < conflicts) {
          child->has_rule = false;
          child->bound_to = -1;
          // What is proven under the rule is not without it.
          auto route = std::make_shared<Route>(*child->route);
          route->bound = routes_[static_cast<std::size_t>(robots[side])]->bound;
          child->route = std::move(route);
          child->bound = node(i).bound;
          offer(std::move(*child));
          return true;
        }
      }
      children.push_back(std::move(*child));
    }
    if (dearer > best_dearer) {
      best_dearer = dearer;
      best = std::move(children);
    }
    if (dearer == 2 || greedy()) break;
  }
  for (Node& child : best) offer(std::move(child));
  return true;
}

ConflictTree::Outcome ConflictTree::operator()(Budget& budget, const Progress& progress) {
  if (!grow_root(budget)) return over_ ? Outcome::kStopped : Outcome::kNone;
  while (true) {
    const std::int32_t i = next();
    if (i < 0) return Outcome::kNone;
    take_routes(i);
    if (progress) progress(node(i).conflicts.size(), bound_);
    if (node(i).conflicts.empty()) {
      cost_ = node(i).cost;
      return Outcome::kSolved;
    }
    if (num_nodes() >= most_nodes_ || !split(i, budget)) return Outcome::kStopped;
  }
}

}  // namespace clearway
