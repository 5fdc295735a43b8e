// Earliest way of a robot over a lane grid past what others hold: safe intervals in space and time.
//
// A robot waits at its start and in channel cells outside crossings only, so a step of the search
// leads from there through crossings, in one go, to the next such cell: a crossing is entered only
// if the cell behind it is free as well.
//
// Phillips, M., Likhachev, M. (2011). SIPP: Safe interval path planning for dynamic environments.
// ICRA. doi:10.1109/ICRA.2011.5980306
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "clearway/multi/cell_holds.hpp"

namespace clearway {

struct LaneQuery {
  int robot = 0;  // whose own holds are no matter
  int start = 0, goal = 0;
  Ticks now = 0;      // it may set out from here on
  Ticks granted = 0;  // nobody goes first where another begins to hold a cell before
  // Ticks of turning from the first heading to each direction, and from each to the last heading.
  std::array<Ticks, 4> first_turn{}, last_turn{};
};

struct LaneWay {
  bool found = false;
  std::vector<CellStay> stays;  // from the start to the goal, where it stays for good
  std::vector<int> behind;      // per stay: whom it waits for there before it departs; -1: nobody
  Ticks ready = 0;              // when it has turned to its last heading
  std::int64_t expansions = 0;
};

class LaneSearch {
 public:
  // `may_wait` says of each cell whether robots may wait there; `turn`: ticks for a quarter turn.
  LaneSearch(const CellHolds* holds, std::vector<std::uint8_t> may_wait, Ticks turn);

  // `moves`: bits of the legal directions out of each cell. The earliest arrival wins.
  LaneWay operator()(const std::uint8_t* moves, const LaneQuery& query, std::int64_t limit);

  const CellHolds& holds() const { return *holds_; }

 private:
  // One cell entered on the way; times count from the departure from the cell waited in.
  struct Entry {
    int cell = 0;
    Direction in = kNowhere;
    Ticks begin = 0;  // sets out hither
    Ticks turn = 0;   // turns in the cell before, just before setting out
  };
  struct Node {
    int cell = 0;
    Direction heading = kNowhere;
    int before = -1;  // hold of the cell that ends before it comes; -1: none
    Ticks arrive = 0;
    Ticks depart = 0;  // from the parent's cell
    int behind = -1;
    int parent = -1;
    int first_entry = 0, num_entries = 0;  // in `entries_`
    int next = -1;                         // of the same cell and heading
    bool closed = false;
  };
  struct Open {
    Ticks f, arrive;
    int node;
  };
  struct Turn {
    Ticks begin = 0, end = 0;
    int behind = -1;
  };
  struct Fit {
    Ticks begin;
    int before, behind;
  };

  void expand(int node);
  void extend(int node);
  void place(int node);
  Fit fit(const Entry& entry, Ticks begin, Ticks stay, Direction out) const;
  Ticks turn_free_from(int cell, Ticks begin, Ticks length, int* behind) const;
  Ticks latest_departure(const Node& node, Direction out) const;
  int successor(int hold) const;
  void reach(int parent, Ticks depart, int before, int behind);
  Turn last_turn(const Node& node) const;
  LaneWay way_to(int node) const;
  Ticks estimate(int cell) const;

  const CellHolds* holds_;
  std::vector<std::uint8_t> may_wait_;
  Ticks turn_;
  const std::uint8_t* moves_ = nullptr;
  LaneQuery query_;
  std::vector<Node> nodes_;
  std::vector<Entry> entries_;
  std::vector<Entry> passage_;
  std::vector<Open> open_;
  struct Slot {
    std::uint32_t epoch = 0;
    int node = -1;
  };
  std::vector<Slot> slots_;  // by cell and heading
  std::uint32_t epoch_ = 0;
};

}  // namespace clearway
