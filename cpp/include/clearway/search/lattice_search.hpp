// One robot's best way over its lattices under rules: A* over (pose, mode, slot).
#pragma once

#include <cstdint>
#include <memory>
#include <unordered_map>
#include <vector>

#include "clearway/budget.hpp"
#include "clearway/search/goal_distance.hpp"
#include "clearway/search/lattice.hpp"

namespace clearway {

using Slot = std::int32_t;
constexpr Slot kEver = 1 << 24;  // later than any slot

// What one robot must not do.
struct Rule {
  enum class Kind {
    kMotion,  // begin to drive a stretch within ticks [from, to]
    kStand,   // stand at a node during any slot of [from, to]
    kRest,    // be at its final rest by `to`
    kAvoid,   // overlap the final rest of robot `other` at tick `from` or later
    kPoint,   // have its body come as near as `gap` to a point at tick `from`
  };
  Kind kind = Kind::kMotion;
  int leg = 0;
  std::int32_t node = 0;
  std::int32_t from = 0, to = 0;
  int other = 0;
  Slot slot = 0;  // kAvoid: in which the other is at rest
  Stretch stretch;
  Point point;
  double gap = 0.0;
  bool must = false;  // kRest, kPoint: the opposite
};

// How a search estimates what is left.
enum class Heuristic {
  kLookBack,  // exact on the lattice, but for rules: a search back from the goal
  kBound,     // never too much: way round obstacles of the largest disc in the body, and turns
  kPaper,     // eq. 22 of Zhang et al.: max(Reeds-Shepp, Manhattan, grid) + turn; may be too much
};

struct Guidance {
  Heuristic heuristic = Heuristic::kLookBack;
  // Ways that cost at most `focus` times the bound are worth looking at; those that meet the fewest
  // others go first. Proven only where the heuristic never says too much.
  double focus = 1.0;
  // Above 1: greedy instead, by cost + xi * estimate, dearer for each other robot met. Adaptive: xi
  // falls from this to 1 on the way to the goal.
  double xi = 1.0;
  bool adaptive = false;
  double meeting = 5.0;  // price of meeting another robot in greedy search (m or s)
};

// A motion driven, with the slots of departure and of leaving its end.
struct Move {
  int leg;
  std::int32_t node, motion;
  Slot depart, arrive;
};

struct Route {
  std::vector<Move> moves;
  std::vector<TimedPiece> pieces;
  std::vector<TourStop> stops;
  std::shared_ptr<const Track> track;
  double cost = 0.0, bound = 0.0;  // of the objective; no way under these rules costs less
  Slot rest = 0;                   // final rest begins
  Ticks arrival = 0;
};

// Where the others come to rest, as bodies.
struct Rest {
  const Body* body;
  Frame at;
};

class LatticeSearch {
 public:
  enum class Outcome { kFound, kNone, kStopped };

  // `rests`: of all robots, by number; `required`: gaps to keep to them.
  LatticeSearch(const Model& model, const std::vector<Leg>& legs, const Pose& start, int mode,
                int rest_body, const std::vector<Rest>& rests, const std::vector<double>& required,
                const Objective& objective, const LatticeParams& params);

  // Prepare a heuristic; false where the lattice is too large to look back over it.
  bool prepare(Heuristic heuristic);

  // `others`: tracks whose meeting is to be shunned where that costs nothing; may be null.
  Outcome operator()(const std::vector<Rule>& rules, const Traffic* others,
                     const Guidance& guidance, Budget& budget, Route& route);

  Lattice& lattice(int leg) { return lattices_[static_cast<std::size_t>(leg)]; }
  int num_legs() const { return static_cast<int>(lattices_.size()); }
  const Body& rest_body() const { return model_.bodies[static_cast<std::size_t>(rest_body_)]; }
  std::int64_t expansions() const { return expansions_; }

 private:
  struct Label {
    double g, f;
    std::int32_t parent, node, motion;
    Slot t, depart;
    Slot end;  // last slot in which it can set out from there
    std::int16_t leg, mode;
    std::int32_t num_hits;
    std::int32_t next;  // of the same state
    bool done, met;
  };
  struct Entry {
    double key;
    std::int32_t hits, label;
    bool operator<(const Entry& e) const {
      if (hits != e.hits) return hits > e.hits;
      if (key != e.key) return key > e.key;
      return label < e.label;  // the younger first
    }
  };
  struct Windows {
    std::vector<std::pair<Slot, Slot>> spans;
  };

  double estimate(const Label& label);
  double bound_of(int leg, std::int32_t node);
  double measure(int leg, std::int32_t node);
  double paper_of(int leg, std::int32_t node);
  // Rules made ready for looking up.
  void compile(const std::vector<Rule>& rules);
  Slot earliest(int leg, std::int32_t node, std::size_t motion, const Lattice::Way& way, Slot from);
  Slot stands_until(int leg, std::int32_t node, Slot from);
  bool covers(const Rule& rule, int leg, std::int32_t node, const Lattice::Way& way,
              Ticks since) const;
  Ticks last_overlap(int other, int leg, std::int32_t node, std::size_t motion,
                     const Lattice::Way& way);
  bool rests_on(int other, int leg, std::int32_t node);
  bool comes_in_time(const Label& label) const;
  void push(Label label);
  bool dominated(const Label& label, std::int32_t head) const;
  void expand(std::int32_t index);
  void later(const Label& label);
  void depart(Label& label, Slot when);
  std::size_t state(const Label& label) const;
  void meet(Label& label, Encounters& encounters);
  void extract(std::int32_t index, Route& route);
  double cost_of_waiting() const {
    return objective_.time ? params_.slot : objective_.waiting * params_.slot / kTicksPerSecond;
  }

  const Model& model_;
  const std::vector<Leg>& legs_;
  int mode_, rest_body_;
  const std::vector<Rest>& rests_;
  const std::vector<double>& required_;
  Objective objective_;
  LatticeParams params_;
  std::vector<Lattice> lattices_;
  std::vector<std::unique_ptr<GoalDistance>> distances_;
  std::vector<std::vector<double>> bounds_;  // by leg and node, as far as asked for
  std::unique_ptr<ConnectTable> curves_;
  double turn_rate_ = 0.0, turn_extra_ = 0.0;
  std::vector<std::unordered_map<std::uint64_t, Ticks>> overlaps_;  // with each other's rest

  // Of the search under way.
  Guidance guidance_;
  std::vector<std::vector<Rule>> motion_rules_;  // by leg
  std::unordered_map<std::uint64_t, Windows> stand_rules_;
  std::vector<Rule> avoid_, points_;
  std::vector<std::pair<Slot, Slot>> spans_;
  Slot least_rest_ = 0, last_rest_ = kEver;
  Slot last_change_ = 0;  // from here on the rules say the same for ever
  double estimate_at_start_ = 0.0;
  std::vector<double> tail_;
  std::vector<Label> labels_;
  std::vector<Entry> open_, live_, focal_;
  std::vector<std::vector<std::int32_t>> heads_;
  std::vector<std::pair<int, std::size_t>> touched_;
  std::int64_t expansions_ = 0;
};

}  // namespace clearway
