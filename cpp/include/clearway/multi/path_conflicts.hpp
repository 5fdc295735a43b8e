// Where two committed motions need the same floor, whatever their times become.
#pragma once

#include <vector>

#include "clearway/space/traffic.hpp"

namespace clearway {

// A robot's whole motion, cut into cells in which no point of its body moves far.
class CommittedPath {
 public:
  // A stretch of ticks with one body, a constant twist, and a bound (m) on how far any point of
  // the body moves.
  struct Cell {
    Ticks begin, end;
    Frame start;
    Twist twist;
    const Body* body;
    double motion;
  };

  // `pieces` without a gap from tick 0 on, standing included; afterwards it rests for ever.
  // `cell`: longest motion (m) within one.
  CommittedPath(std::vector<Body> bodies, const Pose& start, const std::vector<TimedPiece>& pieces,
                double cell);
  // Cells point into the bodies.
  CommittedPath(const CommittedPath&) = delete;
  CommittedPath& operator=(const CommittedPath&) = delete;

  const std::vector<Cell>& cells() const { return cells_; }

  // Calls `visit(cell)` for cells that may come near a box and have some tick in (after, before),
  // from the last one to the first, until it returns true.
  template <typename Visit>
  void backwards(const Box& box, Ticks after, Ticks before, Visit&& visit) const {
    search(1, 0, width_, box, after, before, visit);
  }

 private:
  template <typename Visit>
  bool search(std::size_t node, std::size_t first, std::size_t count, const Box& box, Ticks after,
              Ticks before, Visit& visit) const;

  std::vector<Body> bodies_;
  std::vector<Cell> cells_;
  std::size_t width_ = 1;   // leaves of the tree, a power of two
  std::vector<Box> boxes_;  // of each node: 1 is the root, 2 i and 2 i + 1 are below i
};

// A robot may not go beyond tick `at` before the other has passed tick `passed`.
struct Passage {
  Ticks at, passed;
};

struct PathConflicts {
  std::vector<Passage> first, second;  // what each waits for, by rising `at` and `passed`
  Ticks meeting = -1;                  // tick at which they are in each other by plan
};

struct PathParams {
  double margin = 0.0;   // gap (m) that is kept
  double finest = 0.05;  // motion (m) below which a place of conflict is told no more exactly
};

// Every pair of ticks, one of each robot from `done` on, at which the gap of the bodies is less
// than the margin is forbidden by what is returned, unless both are within `hidden` (m) of motion
// of one planned tick. What the plan itself does at any tick is never forbidden.
PathConflicts path_conflicts(const CommittedPath& a, Ticks done_a, const CommittedPath& b,
                             Ticks done_b, const PathParams& params);

// Whether the bodies are more than kHidden in each other for some tick of `a` and some of `b`, each
// within the stretch given.
bool paths_overlap(const CommittedPath& a, Ticks from_a, Ticks to_a, const CommittedPath& b,
                   Ticks from_b, Ticks to_b);

// How far bodies may come closer than planned where that is too near to tell.
constexpr double kHidden = 0.001;

template <typename Visit>
bool CommittedPath::search(std::size_t node, std::size_t first, std::size_t count, const Box& box,
                           Ticks after, Ticks before, Visit& visit) const {
  if (first >= cells_.size() || cells_[first].begin >= before) return false;
  if (cells_[std::min(first + count, cells_.size()) - 1].end <= after) return false;
  const Box& own = boxes_[node];
  if (own.x0 > box.x1 || own.x1 < box.x0 || own.y0 > box.y1 || own.y1 < box.y0) return false;
  if (count == 1) return visit(cells_[first]);
  const std::size_t half = count / 2;
  return search(2 * node + 1, first + half, half, box, after, before, visit) ||
         search(2 * node, first, half, box, after, before, visit);
}

}  // namespace clearway
