// Ruin and recreate: some tasks are taken out and put back where they cost least, again and again.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "clearway/assign/costs.hpp"
#include "clearway/assign/random.hpp"
#include "clearway/assign/route_set.hpp"
#include "clearway/assign/schedule.hpp"
#include "clearway/budget.hpp"

namespace clearway::assign {

struct RuinRecreateParams {
  std::optional<std::int64_t> rounds;  // none: by the number of tasks, see rounds_for
  int removed = 10;                    // tasks taken out at once, on average
  int longest_string = 10;             // tasks taken out of one route in a row, at most
  double blinks = 0.02;                // share of the places overlooked
  double regret = 0.02;                // share of recreations by regret
  double first_temperature = 1.0;      // in mean prices of a leg; more accepts worse routes
  double last_temperature = 0.01;

  void check() const;  // throws std::invalid_argument
};

// As many rounds as take about 2 s of a core at the most; some hundredths of that for few tasks.
std::int64_t rounds_for(const Costs& costs, int seats);

struct RuinRecreateResult {
  Routes routes;
  double value = 0.0;
};

// Sources: G. Schrimpf et al., J. Comput. Phys. 159 (2000); strings and blinks: J. Christiaens,
// G. Vanden Berghe, "Slack induction by string removals", Transportation Science 54 (2020).
// The longest route counts in the price of every place, and ruins often begin at it.
class RuinRecreate {
 public:
  // `seats`: most tasks that a robot may have.
  RuinRecreate(const Costs& costs, int seats, const RuinRecreateParams& params);

  // Goes on from legal routes. The budget is only asked to stop.
  RuinRecreateResult operator()(const Routes& start, std::uint64_t seed, Budget& budget);

 private:
  struct Place {
    double value;  // by how much the objective grows
    Leg added;
    int robot, position;
  };

  void rank_neighbours();
  int pick_seed();
  void ruin();
  void ruin_strings();
  void ruin_near();
  void ruin_anywhere();
  void take_out(int robot, int position, int number);
  void touch(int robot);
  void settle();
  bool recreate(double regret);
  bool recreate_in_turn();
  bool recreate_by_regret();
  void sort_removed();
  void look(int task, int robot, double longest, Place& best);
  void look_timed(int task, int robot, double longest, Place& best);
  void put(int task, const Place& place);
  int next_blink() { return gaps_[random_.next() >> 56]; }
  double worth();
  void time_again();
  const int* near(int task) const {
    return &near_[static_cast<std::size_t>(task) * static_cast<std::size_t>(costs_.tasks())];
  }

  const Costs& costs_;
  int seats_;
  RuinRecreateParams params_;
  Random random_{0};
  Schedule schedule_;
  RouteSet here_, kept_;   // the routes worked on, and as they were before the round
  std::vector<int> near_;  // all tasks by nearness to each
  std::vector<int> removed_;
  std::vector<int> touched_;  // robots whose routes changed in this round
  std::vector<std::uint8_t> is_touched_;
  std::vector<Place> places_;             // best per removed task and robot
  std::vector<double> far_;               // distance of each task from the nearest start
  std::vector<int> trial_;                // a route with one more task
  std::array<std::uint8_t, 256> gaps_{};  // draws of places until the next blink
  int until_blink_ = 0;
  double late_ = 0.0;            // delays of here_
  std::vector<double> late_by_;  // by robot, where no task waits for others
};

}  // namespace clearway::assign
