// The finite graph on which conflict-based search is exact: one leg of one robot.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "clearway/search/encounters.hpp"
#include "clearway/search/heading_table.hpp"
#include "clearway/search/tour_search.hpp"

namespace clearway {

struct LatticeParams {
  Ticks slot = 100;                   // motions last a whole number of these, stretched if need be
  std::size_t shot_words = 2;         // analytic connections to the goal kept from a pose
  double shot_reach = 12.0;           // that is so near to it (m)
  std::int64_t most_nodes = 200'000;  // larger ones are not looked back over
};

// A stretch of steady motion at its place; mode -1: the service at the goal.
struct Stretch {
  int mode = 0;
  Pose start;
  Twist twist;
  Ticks duration = 0;
};

// Poses that primitives reach from the leg's start, told apart exactly; from each of them every
// primitive and the best shots to the goal that nothing standing blocks. Made as it is asked for.
class Lattice {
 public:
  static constexpr std::int32_t kBlocked = -1, kGoal = -2;

  // `last`: whether the service at the goal is no part of the cost.
  Lattice(const Model& model, const Leg& leg, const Pose& start, bool last,
          const Objective& objective, const LatticeParams& params);

  // A primitive, or a shot together with the service at the goal.
  struct Way {
    Drive drive;
    std::int32_t slots = 0;     // of driving and service
    int first = -1, last = -1;  // modes; -1: it does not move
    double cost = 0.0;          // of the objective, without a switch into `first`
  };

  std::int32_t num_nodes() const { return static_cast<std::int32_t>(nodes_.size()); }
  std::int32_t num_modes() const { return num_modes_; }
  // Whether the mode in which a pose is reached matters.
  bool tells_modes() const { return by_mode_; }
  std::size_t num_primitives() const { return primitives_.size(); }
  std::size_t num_motions(std::int32_t node) { return primitives_.size() + shots(node).size(); }
  // Where a motion leads: a node, the goal, or nowhere.
  std::int32_t target(std::int32_t node, std::size_t motion);
  Way way(std::int32_t node, std::size_t motion);
  // How many ticks after the departure a motion begins to drive a stretch; negative if it does not.
  Ticks drives(std::int32_t node, const Way& way, bool arrives, const Stretch& stretch) const;
  bool may_follow(int mode, std::size_t motion) const;
  Pose pose(std::int32_t node) const;
  Frame frame(std::int32_t node) const;
  const Leg& leg() const { return leg_; }
  const Body& body() const { return model_.bodies[static_cast<std::size_t>(leg_.body)]; }

  // Cost and standing slots of going on in another mode.
  double switch_cost() const { return switch_cost_; }
  std::int32_t switch_slots() const { return switch_slots_; }

  // Learn the least cost from every pose and mode to the end, where `after` tells what follows
  // the goal, by the mode in which it is reached (the first entry: standing). False: too large.
  bool look_back(const std::vector<double>& after);
  bool knows_cost_to_go() const { return !cost_to_go_.empty(); }
  double cost_to_go(std::int32_t node, int mode) const {
    return cost_to_go_[static_cast<std::size_t>(node) * stride() +
                       static_cast<std::size_t>(by_mode_ ? mode + 1 : 0)];
  }

 private:
  struct Node {
    double x, y;
    int k;
    std::int32_t first_shot = -1, num_shots = 0;
  };
  struct Shooting {
    std::vector<Step> steps;
    Ticks duration;
    double cost;
  };
  struct Span {
    const Shooting* first;
    std::size_t count;
    std::size_t size() const { return count; }
  };

  std::size_t stride() const { return static_cast<std::size_t>(by_mode_ ? num_modes_ + 1 : 1); }
  std::int32_t node_at(double x, double y, int k);
  void aim(std::int32_t node);
  bool is_primitive(const Shot& shot) const;
  Span shots(std::int32_t node);
  bool is_clear(const Frame& from, const std::vector<Step>& steps) const;
  Ticks whole_slots(Ticks duration) const {
    return (duration + params_.slot - 1) / params_.slot * params_.slot;
  }

  const Model& model_;
  Leg leg_;
  Pose start_;
  bool last_;
  Objective objective_;
  LatticeParams params_;
  HeadingTable headings_;
  int num_modes_;
  bool by_mode_;
  double switch_cost_;
  std::int32_t switch_slots_, service_slots_;
  std::vector<Step> primitives_;  // with stretched durations
  std::vector<double> costs_;
  std::vector<Node> nodes_;
  std::unordered_map<std::uint64_t, std::int32_t> index_;
  std::vector<std::int32_t> targets_;
  std::vector<Shooting> shots_;
  std::vector<Shot> tried_;
  std::vector<float> cost_to_go_;
};

}  // namespace clearway
