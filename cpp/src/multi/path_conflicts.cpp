#include "clearway/multi/path_conflicts.hpp"

#include <algorithm>
#include <cmath>

namespace clearway {

namespace {

using Cell = CommittedPath::Cell;

// A part of a cell, seen from its middle.
struct Part {
  const Cell* cell;
  Ticks begin, end;
  double motion;  // of any point of the body, all in all (m)
  Frame middle;

  Part(const Cell& c, Ticks from, Ticks to) : cell(&c), begin(from), end(to) {
    const double duration = c.end - c.begin;
    motion = c.motion > 0.0 ? c.motion * (to - from) / duration : 0.0;
    middle = c.motion > 0.0 ? moved(c.start, c.twist.part((0.5 * (from + to) - c.begin) / duration))
                            : c.start;
  }
  explicit Part(const Cell& c) : Part(c, c.begin, c.end) {}
  Part cut(Ticks from, Ticks to) const { return Part(*cell, from, to); }
  Ticks half() const { return begin + (end - begin) / 2; }
  // Ticks of driving: standing has no length.
  Ticks size() const { return motion > 0.0 ? end - begin : 0; }
  Box box(double margin) const {
    const Circle& bound = cell->body->bound();
    const Point p = middle.to_world({bound.x, bound.y});
    const double r = bound.r + 0.5 * motion + margin;
    return {p.x - r, p.y - r, p.x + r, p.y + r};
  }
};

double gap_between(const Part& a, const Part& b, double enough) {
  return gap(*a.cell->body, a.middle, *b.cell->body, b.middle, enough);
}

// What robot `a` waits for, of robot `b`.
class Waits {
 public:
  Waits(Ticks done_a, Ticks done_b, const PathParams& params, std::vector<Passage>& out,
        Ticks& meeting)
      : done_a_(done_a), done_b_(done_b), params_(params), out_(out), meeting_(meeting) {}

  void operator()(const CommittedPath& a, const CommittedPath& b) {
    Ticks met = done_b_;  // what has been passed when a comes to its next cell
    for (const Cell& cell : a.cells()) {
      if (cell.end <= done_a_) continue;
      const Part mine(cell);
      begin_ = out_.size();
      b.backwards(mine.box(params_.margin), met, cell.end, [&](const Cell& other) {
        const std::size_t before = out_.size();
        tell(mine, Part(other));
        // All that is earlier is passed by then, too.
        return out_.size() > before && out_.back().at <= cell.begin;
      });
      for (std::size_t i = begin_; i < out_.size(); ++i) met = std::max(met, out_[i].passed);
    }
  }

 private:
  bool clear(const Part& a, const Part& b) const {
    const double needed = params_.margin + 0.5 * (a.motion + b.motion);
    const Circle &ca = a.cell->body->bound(), &cb = b.cell->body->bound();
    const Point apart = b.middle.to_world({cb.x, cb.y}) - a.middle.to_world({ca.x, ca.y});
    const double reach = ca.r + cb.r + needed;
    return dot(apart, apart) > reach * reach || gap_between(a, b, needed) >= needed;
  }

  bool told(Ticks at, Ticks passed) const {
    for (std::size_t i = begin_; i < out_.size(); ++i) {
      if (out_[i].at <= at && out_[i].passed >= passed) return true;
    }
    return false;
  }

  void tell(const Part& a, const Part& b) {
    if (a.end <= b.begin || a.end <= done_a_ || b.end <= done_b_) return;
    if (b.end <= a.begin && told(a.begin, b.end)) return;
    if (clear(a, b)) return;
    if (b.end <= a.begin) {
      apart(a, b);
    } else if (a.begin == b.begin && a.end == b.end) {
      together(a, b);
    } else {
      const Ticks begin = std::max(a.begin, b.begin), end = std::min(a.end, b.end);
      if (b.begin < begin) tell(a, b.cut(b.begin, begin));
      if (a.end > end) tell(a.cut(end, a.end), b.cut(begin, end));
      tell(a.cut(begin, end), b.cut(begin, end));
    }
  }

  // All of b's part is before a's: told as it is when far from the planned times, else refined.
  void apart(const Part& a, const Part& b) {
    if (is_finest(a, b)) {
      out_.push_back({a.begin, b.end});
    } else if (a.begin - b.end >= std::max(a.size(), b.size())) {
      if (meets(a, b)) out_.push_back({a.begin, b.end});
    } else {
      halve(a, b, [this](const Part& p, const Part& q) {
        tell(p, q);
        return false;
      });
    }
  }

  bool is_finest(const Part& a, const Part& b) const {
    const Part& longer = a.motion >= b.motion ? a : b;
    return longer.motion <= params_.finest || longer.end - longer.begin <= 1;
  }

  // Whether some pair of ticks is in conflict; none is overlooked, as parts get ever smaller.
  bool meets(const Part& a, const Part& b) const {
    if (clear(a, b)) return false;
    if (is_finest(a, b) || gap_between(a, b, params_.margin) < params_.margin) return true;
    return halve(a, b, [this](const Part& p, const Part& q) { return meets(p, q); });
  }

  // Visits both halves of the longer part, what leads to later passages first, until true.
  template <typename Visit>
  static bool halve(const Part& a, const Part& b, Visit&& visit) {
    const bool is_a = a.motion >= b.motion;
    const Part& longer = is_a ? a : b;
    const Part early = longer.cut(longer.begin, longer.half());
    const Part late = longer.cut(longer.half(), longer.end);
    return is_a ? visit(early, b) || visit(late, b) : visit(a, late) || visit(a, early);
  }

  // Both are at the same ticks: only what the plan does not do is told.
  void together(const Part& a, const Part& b) {
    const Ticks middle = a.half();
    if (middle == a.begin || std::max(a.motion, b.motion) <= kHidden) {
      const bool is_first = meeting_ < 0 || a.begin < meeting_;
      if (is_first && gap_between(a, b, 0.0) < -kHidden) meeting_ = a.begin;
      return;
    }
    tell(a.cut(a.begin, middle), b.cut(b.begin, middle));
    tell(a.cut(middle, a.end), b.cut(b.begin, middle));
    tell(a.cut(middle, a.end), b.cut(middle, b.end));
  }

  const Ticks done_a_, done_b_;
  const PathParams& params_;
  std::vector<Passage>& out_;
  Ticks& meeting_;
  std::size_t begin_ = 0;  // where what is told of a's present cell begins
};

bool overlap(const Part& a, const Part& b) {
  const double half = 0.5 * (a.motion + b.motion), found = gap_between(a, b, half);
  if (found < -kHidden) return true;
  if (found - half >= -kHidden || half < 0.1 * kHidden) return false;
  const bool is_a = a.motion >= b.motion;
  const Part& longer = is_a ? a : b;
  const Ticks middle = longer.half();
  if (middle == longer.begin) return false;
  const Part early = longer.cut(longer.begin, middle), late = longer.cut(middle, longer.end);
  return is_a ? overlap(early, b) || overlap(late, b) : overlap(a, early) || overlap(a, late);
}

void prune(std::vector<Passage>& passages) {
  std::sort(passages.begin(), passages.end(), [](const Passage& p, const Passage& q) {
    return p.at < q.at || (p.at == q.at && p.passed > q.passed);
  });
  Ticks passed = -1;
  std::erase_if(passages, [&](const Passage& p) {
    if (p.passed <= passed) return true;
    passed = p.passed;
    return false;
  });
}

}  // namespace

CommittedPath::CommittedPath(std::vector<Body> bodies, const Pose& start,
                             const std::vector<TimedPiece>& pieces, double cell)
    : bodies_(std::move(bodies)) {
  Ticks tick = 0;
  Pose at = start;
  const Body* body = &bodies_.front();
  for (const TimedPiece& piece : pieces) {
    body = &bodies_[static_cast<std::size_t>(piece.body)];
    const double motion = piece.twist.length() + std::abs(piece.twist.c) * body->circumradius();
    const Ticks duration = piece.end - piece.begin;
    const Ticks count =
        std::clamp(static_cast<Ticks>(std::ceil(motion / cell)), 1, std::max(1, duration));
    for (Ticks i = 0; i < count; ++i) {
      const auto share = [&](Ticks k) { return static_cast<double>(duration) * k / count; };
      const Ticks from = static_cast<Ticks>(share(i)), to = static_cast<Ticks>(share(i + 1));
      if (to == from) continue;
      const double before = static_cast<double>(from) / duration;
      const double part = static_cast<double>(to - from) / duration;
      cells_.push_back({piece.begin + from, piece.begin + to,
                        moved(Frame(piece.start), piece.twist.part(before)), piece.twist.part(part),
                        body, motion * part});
    }
    tick = piece.end;
    at = moved(piece.start, piece.twist);
  }
  cells_.push_back({tick, kNever, Frame(at), {}, body, 0.0});
  while (width_ < cells_.size()) width_ *= 2;
  const Box nowhere{1e300, 1e300, -1e300, -1e300};
  boxes_.assign(2 * width_, nowhere);
  for (std::size_t i = 0; i < cells_.size(); ++i) boxes_[width_ + i] = Part(cells_[i]).box(0.0);
  for (std::size_t i = width_ - 1; i > 0; --i) {
    const Box &p = boxes_[2 * i], &q = boxes_[2 * i + 1];
    boxes_[i] = {std::min(p.x0, q.x0), std::min(p.y0, q.y0), std::max(p.x1, q.x1),
                 std::max(p.y1, q.y1)};
  }
}

PathConflicts path_conflicts(const CommittedPath& a, Ticks done_a, const CommittedPath& b,
                             Ticks done_b, const PathParams& params) {
  PathConflicts found;
  Waits(done_a, done_b, params, found.first, found.meeting)(a, b);
  Waits(done_b, done_a, params, found.second, found.meeting)(b, a);
  prune(found.first);
  prune(found.second);
  return found;
}

bool paths_overlap(const CommittedPath& a, Ticks from_a, Ticks to_a, const CommittedPath& b,
                   Ticks from_b, Ticks to_b) {
  bool found = false;
  for (const Cell& cell : a.cells()) {
    if (found || cell.end <= from_a || cell.begin > to_a) continue;
    const Part mine(cell, std::max(from_a, cell.begin), std::min(to_a, cell.end));
    b.backwards(mine.box(0.0), from_b, to_b + 1, [&](const Cell& other) {
      const Part its(other, std::max(from_b, other.begin), std::min(to_b, other.end));
      return found = overlap(mine, its);
    });
  }
  return found;
}

}  // namespace clearway
