// Conflict-based search for a group of robots: a tree of rules, each node with its best routes.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "clearway/multi/branching.hpp"

namespace clearway {

using Routes = std::vector<std::shared_ptr<const Route>>;  // by robot; null: none yet

// Source: G. Sharon, R. Stern, A. Felner, N. R. Sturtevant, "Conflict-based search for optimal
// multi-agent pathfinding", AIJ 219 (2015); E. Boyarski et al., "ICBS", IJCAI 2015 (which meeting,
// bypasses); M. Barer, G. Sharon, R. Stern, A. Felner, "Suboptimal variants of the conflict-based
// search algorithm", SoCS 2014 (focal lists). Ours branches on points that both bodies cover.
class ConflictTree {
 public:
  enum class Outcome { kSolved, kNone, kStopped };
  // Conflicts of the node at hand, and what no plan of the group can cost less than.
  using Progress = std::function<void(std::size_t conflicts, double bound)>;

  // `routes`: of everybody; those outside the group are shunned where that costs nothing.
  // `factor`: of the bound, within which nodes with fewer conflicts go first; greedy where
  // `guidance.xi` is above 1, and then whatever they cost.
  ConflictTree(Routing& routing, std::vector<int> members, Routes routes, const Guidance& guidance,
               double factor, double even, std::int64_t most_nodes);

  Outcome operator()(Budget& budget, const Progress& progress);

  const Routes& routes() const { return routes_; }  // once solved
  double cost() const { return cost_; }
  double bound() const { return bound_; }
  std::int32_t num_nodes() const { return static_cast<std::int32_t>(nodes_.size()); }
  int num_searches() const { return num_searches_; }
  int stuck() const { return stuck_; }  // a robot without any way; -1: none

 private:
  // One more rule, and the way of one robot under all of them.
  struct Node {
    std::int32_t parent = -1;
    int robot = -1;
    bool has_rule = false;
    Rule rule;
    int bound_to = -1;  // robot that must do what the rule forbids all others
    std::shared_ptr<const Route> route;
    double cost = 0.0, bound = 0.0;
    std::vector<std::pair<std::int16_t, std::int16_t>> conflicts;
    bool done = false;
  };
  struct Open {
    double key;
    std::int32_t node;
    bool operator<(const Open& o) const { return key != o.key ? key > o.key : node < o.node; }
  };

  const Node& node(std::int32_t i) const { return nodes_[static_cast<std::size_t>(i)]; }
  bool greedy() const { return guidance_.xi > 1.0; }
  bool grow_root(Budget& budget);
  void take_routes(std::int32_t i);
  void find_rules(std::int32_t i, int robot, std::vector<Rule>& rules) const;
  std::vector<Meeting> meetings(const Node& node) const;
  std::optional<Node> replan(std::int32_t parent, int robot, const Rule* rule, int bound_to,
                             Budget& budget);
  bool split(std::int32_t i, Budget& budget);
  void offer(Node child);
  std::int32_t next();

  Routing& routing_;
  std::vector<int> members_;
  Routes outside_, routes_;
  Guidance guidance_;
  double factor_, even_;
  std::int64_t most_nodes_;
  std::vector<Node> nodes_;
  Traffic traffic_;  // of the routes at hand
  std::vector<std::shared_ptr<const Track>> shown_;
  std::vector<Open> open_, live_, focal_;
  double cost_ = 0.0, bound_ = 0.0;
  bool over_ = false;
  int num_searches_ = 0, stuck_ = -1;
};

}  // namespace clearway
