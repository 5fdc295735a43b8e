// Conflict-based search on bodies: optimal, bounded or greedy on the robots' lattices.
#pragma once

#include <functional>
#include <vector>

#include "clearway/multi/conflict_tree.hpp"

namespace clearway {

struct ConflictParams {
  enum class Mode { kOptimal, kBounded, kGreedy };
  Mode mode = Mode::kGreedy;
  Objective objective;
  LatticeParams lattice;
  Heuristic heuristic = Heuristic::kBound;
  double factor = 1.05;  // bounded: proven on the lattices
  double xi = 2.0;       // greedy: on the estimate; see Guidance
  bool adaptive = true;
  double meeting = 5.0;                // likewise
  int attempts = 6;                    // greedier ones, where a small tree holds no plan
  double margin = 0.01;                // gap kept where clearances ask for less (m)
  std::int64_t first_limit = 500'000;  // expansions for a first plan of the modes that prove
  std::int64_t most_nodes = 100'000;   // of one tree, some 10 kB each
};

struct ConflictResult {
  enum class Status { kSolved, kStopped, kNone };
  Status status = Status::kStopped;  // kSolved: a complete plan
  bool proven = false;               // within the factor that was asked for
  std::vector<TourResult> tours;
  std::vector<int> concerned;  // robots without any way on their lattice, or with too large a one
  bool too_large = false;
  double cost = 0.0;   // of the objective (m or ticks)
  double bound = 0.0;  // no plan on the lattices costs less; 0: none known
  std::int64_t expansions = 0;
  int nodes = 0, searches = 0;  // of the trees; of single robots
  int largest_group = 0;        // robots that had to be searched together
};

// Conflicts at hand, expansions, and the bound so far.
using ConflictProgress =
    std::function<void(int conflicts, std::int64_t expansions, double cost, double bound)>;

// Robots that meet nobody are planned alone, those that meet together.
// Source: T. Standley, "Finding optimal solutions to cooperative pathfinding problems", AAAI 2010.
class ConflictSearch {
 public:
  ConflictSearch(const std::vector<Model>& models, std::vector<Agent> agents,
                 const ConflictParams& params, ConflictProgress progress);

  // To be called once.
  ConflictResult operator()(Budget& budget);

 private:
  struct Group {
    std::vector<int> members;
    double cost = 0.0, bound = 0.0;
  };

  bool prepare(Heuristic heuristic);
  Guidance greedy(int attempt) const;
  ConflictTree::Outcome solve(Group& group, Budget& budget);
  void plan_greedily(Budget& budget);
  void prove(Budget& budget);
  Meeting meeting_of_groups() const;
  double bound() const;
  void keep(const Routes& routes, double cost);
  double even() const { return params_.objective.time ? 1e-3 : 1e-6; }

  ConflictParams params_;
  Team team_;
  ConflictProgress progress_;
  Routing routing_;
  std::vector<Group> groups_;
  std::vector<std::size_t> group_of_;
  Routes routes_, kept_;
  ConflictResult result_;
};

}  // namespace clearway
