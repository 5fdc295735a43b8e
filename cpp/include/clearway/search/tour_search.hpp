// One robot's way through all its visits: A* over (pose, mode, safe interval).
#pragma once

#include <limits>
#include <map>
#include <memory>
#include <tuple>
#include <vector>

#include "clearway/budget.hpp"
#include "clearway/motion/table.hpp"
#include "clearway/search/goal_distance.hpp"
#include "clearway/search/heading_table.hpp"
#include "clearway/space/statics.hpp"
#include "clearway/space/traffic.hpp"

namespace clearway {

// What all robots of one type share.
struct Model {
  std::vector<Body> bodies;                             // 0 empty, 1 loaded
  std::vector<std::shared_ptr<const Statics>> statics;  // what stands in each body's way
  MotionTable table;
  MotionTable fine;  // for the retry of a stuck robot
  double clearance = 0.0;
};

// Drive to `goal` with `body`, then stand there for `service`.
struct Leg {
  Pose goal;
  Ticks service = 0;
  int body = 0;
  double required = 0.0;          // gap to keep from obstacles on the way
  Ticks not_before = 0;           // the service begins no sooner: who comes before then waits
  std::vector<Pose> others = {};  // goals that will do as well; of the last leg only
};

struct SearchParams {
  double weight = 1.1;         // on the heuristic: larger is greedier
  double greed = 0.3;          // added to it whenever the effort so far has doubled
  double most_weight = 2.5;    // up to this much
  double tail_weight = 2.0;    // on the legs after the current one: larger goes deeper first
  double soft_weight = 2.0;    // likewise in soft search
  double cell = 0.85;          // poses in one cell compete; in shortest steps of the table
  std::size_t shot_words = 2;  // analytic connections tried at a time
  std::int64_t most_nodes = 2'000'000;   // kept by one search, 96 bytes each; then it stops
  std::int64_t most_cells = 16'000'000;  // of goal distances kept, 4 bytes each
};

// A state that a search expanded: a pose, and the safe interval in which it was reached.
struct Expanded {
  Pose pose;
  Ticks begin = 0, end = 0;
  int leg = 0;
};

struct TourQuery {
  const Model* model = nullptr;
  bool fine = false;
  Pose start;
  int mode = -1;
  Ticks ready = 0;
  const std::vector<Leg>* legs = nullptr;
  int rest_body = 0;                              // with which it stands after the last visit
  const Traffic* traffic = nullptr;               // null: alone on the site
  const std::vector<double>* required = nullptr;  // gap to each track
  const std::vector<double>* penalty = nullptr;   // soft search: cost of hitting each track;
                                                  // negative: it does not move away
  double below = std::numeric_limits<double>::infinity();  // ways that cost more are of no use
  bool minds_places = false;                 // ask beforehand when nobody is at the visits' places
  std::vector<Expanded>* trace = nullptr;    // filled in the order of expansion
  std::vector<std::int32_t>* met = nullptr;  // how often each track was in the way
};

struct TourStop {
  int leg = 0;
  Ticks arrive = 0, leave = 0;  // of the service
};

struct TourResult {
  enum class Outcome { kFound, kExhausted, kStopped };
  Outcome outcome = Outcome::kExhausted;
  std::vector<TimedPiece> pieces;
  std::vector<TourStop> stops;
  std::vector<int> hits;  // tracks that a soft path runs into
  Ticks arrival = 0;      // at the last pose, wherever it waits for its service
  int goal = 0;           // which of the last leg's goals that is; 0: not one of `others`
  double cost = 0.0;      // of the objective
  bool is_full = false;   // stopped since it would have kept more than `most_nodes`
};

struct TourMemory;

// Reusable search: keeps its memory and its tables from query to query.
class TourSearch {
 public:
  TourSearch(const SearchParams& params, const Objective& objective);
  ~TourSearch();

  // `limit`: expansions for this query alone.
  TourResult operator()(const TourQuery& query, std::int64_t limit, Budget& budget);

 private:
  friend class TourRun;

  // Null where it is not made yet and `make` is false.
  const GoalDistance* goal_distance(const Statics& statics, double radius, const Pose& goal,
                                    bool make);
  const HeadingTable& heading_table(const Model& model, bool fine, double theta);
  ConnectTable& connect_table(const Model& model, bool fine);

  SearchParams params_;
  Objective objective_;
  std::unique_ptr<TourMemory> memory_;
  // Forget goal distances where they take too much room; no query may be under way.
  void make_room();

  std::map<std::tuple<const Statics*, double, double, double>, GoalDistance> goal_distances_;
  std::int64_t num_cells_ = 0;  // of all goal distances
  std::map<std::tuple<const Model*, bool, long>, HeadingTable> heading_tables_;
  std::map<std::tuple<const Model*, bool>, ConnectTable> connect_tables_;
};

}  // namespace clearway
