// Who holds which cell of a lane grid when.
//
// A robot holds a cell from its departure from the cell before until its arrival in the cell
// behind; who follows straight on may enter as the one ahead leaves (Yu, Liao, Zu, Systems 12(1),
// 9, 2024, eqs. (5)-(11) in one).
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "clearway/motion/table.hpp"

namespace clearway {

// Directions of a step, counter-clockwise from east; nowhere for the ends of a route.
using Direction = std::int8_t;
constexpr Direction kNowhere = 4;

// One cell of a timed route. Within [arrive, depart] the robot stands there, and turns on the spot
// within [turn_begin, turn_end] (equal: it does not).
struct CellStay {
  int cell = 0;
  Ticks arrive = 0, depart = 0;  // `depart` of the last one is kNever
  Ticks turn_begin = 0, turn_end = 0;
};

// A cell held by a robot, of the list of the cell's holds by their begin.
struct Hold {
  Ticks begin = 0, leave = 0, end = 0;
  Ticks turn_begin = 0, turn_end = 0;
  int robot = -1;
  int index = 0;  // in its robot's route
  Direction in = kNowhere, out = kNowhere;
  int next = -1;

  // From when on a robot that comes in a direction, and needs `step` for it, may set out hither.
  Ticks free_from(Direction to, Ticks step) const {
    return to == out && to != kNowhere ? std::max(leave, end - step) : end;
  }
};

// Two robots that hold a cell at once, or turn side by side.
struct Clash {
  int cell = 0;
  int index = 0;  // in the route asked about
  int other = 0;
  int other_index = 0;
  Ticks at = 0;  // when both begin to hold it
};

// A route whose robot goes on from the middle of a cell later, and turns there later.
std::vector<CellStay> delayed(std::vector<CellStay> route, std::size_t index, Ticks by);

class CellHolds {
 public:
  // `step`: ticks from a cell to the next; `wide`: bodies that cannot turn side by side.
  CellHolds(int width, int height, int num_robots, Ticks step, bool wide);

  int width() const { return width_; }
  int height() const { return height_; }
  Ticks step() const { return step_; }
  bool is_wide() const { return wide_; }

  // Replace what a robot holds by a timed route. Throws std::invalid_argument where cells are not
  // neighbours or times fall.
  void put(int robot, const std::vector<CellStay>& route);
  void remove(int robot);
  const std::vector<CellStay>& route(int robot) const { return routes_[checked(robot)]; }

  // Conflicts of a timed route with what all others hold, by their moments. Nobody goes before
  // another into a cell that this one begins to hold before `granted`.
  std::vector<Clash> clashes(int robot, const std::vector<CellStay>& route,
                             Ticks granted = 0) const;

  // By how much a robot must go on later from the cell at `index` of its route so that it meets
  // nothing of another's from there on; -1: it cannot by waiting there.
  Ticks least_delay(int robot, const std::vector<CellStay>& route, std::size_t index, int other,
                    Ticks granted = 0) const;

  // First of the holds of a cell; -1: nobody ever.
  int first(int cell) const { return heads_[static_cast<std::size_t>(cell)]; }
  const Hold& hold(int id) const { return holds_[static_cast<std::size_t>(id)]; }
  // Cells beside a cell; -1 beyond the border.
  std::array<int, 4> beside(int cell) const;

  // Robots that hold something of a cell at or after a moment.
  std::vector<int> holders(int cell, Ticks from) const;

 private:
  std::size_t checked(int robot) const;
  void check(const std::vector<CellStay>& route) const;
  bool meet(const Hold& mine, const Hold& theirs, Ticks granted) const;
  Hold hold_of(const std::vector<CellStay>& route, std::size_t i) const;

  int width_, height_;
  Ticks step_;
  bool wide_;
  std::vector<int> heads_;  // by cell
  std::vector<Hold> holds_;
  std::vector<int> spare_;  // places in `holds_` that are free again
  std::vector<std::vector<CellStay>> routes_;
};

}  // namespace clearway
