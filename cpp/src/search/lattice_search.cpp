#include "clearway/search/lattice_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace clearway {

namespace {

constexpr std::int32_t kNone = -1;
constexpr double kUnknown = -1.0;  // in place of a bound
constexpr double kEven = 1e-9;     // costs that differ by less are equal
constexpr double kFar = std::numeric_limits<double>::infinity();
constexpr double kGridCell = 0.5;          // of the way round obstacles (m)
constexpr std::size_t kStanding = 0xffff;  // in place of a motion's number
constexpr double kGridExcess = 1.03;       // of 16 neighbours over the any-angle way

std::uint64_t key_of(int leg, std::int32_t node, std::size_t motion) {
  return static_cast<std::uint64_t>(leg) << 52U | static_cast<std::uint64_t>(node) << 16U |
         static_cast<std::uint64_t>(motion);
}

}  // namespace

LatticeSearch::LatticeSearch(const Model& model, const std::vector<Leg>& legs, const Pose& start,
                             int mode, int rest_body, const std::vector<Rest>& rests,
                             const std::vector<double>& required, const Objective& objective,
                             const LatticeParams& params)
    : model_(model),
      legs_(legs),
      mode_(mode),
      rest_body_(rest_body),
      rests_(rests),
      required_(required),
      objective_(objective),
      params_(params) {
  Pose from = start;
  lattices_.reserve(legs.size());
  // Visits where it rests anyway come after its last arrival: their services are no cost.
  std::size_t last = legs.size();
  while (last > 1 && legs[last - 2].goal.x == legs.back().goal.x &&
         legs[last - 2].goal.y == legs.back().goal.y &&
         legs[last - 2].goal.theta == legs.back().goal.theta) {
    --last;
  }
  for (std::size_t i = 0; i < legs.size(); ++i) {
    lattices_.emplace_back(model, legs[i], from, i + 1 >= last, objective, params);
    from = legs[i].goal;
  }
  heads_.resize(legs.size());
  distances_.resize(legs.size());
  bounds_.resize(legs.size());
  overlaps_.resize(rests.size());
  // Whatever turns the body by a radian lasts or costs at least so much.
  bool translates = false;
  turn_extra_ = objective.turning * model.table.turn_arm;
  for (const Connection& c : model.table.connections) {
    translates = translates || c.family == Family::kTranslate;
    turn_rate_ = std::max(turn_rate_, c.yaw_rate);
    if (c.family != Family::kReedsShepp) continue;
    const double arc = std::max(c.forward_arc_speed, c.reverse_arc_speed);
    turn_rate_ = std::max(turn_rate_, arc / c.radius);
    turn_extra_ = std::min(turn_extra_, (objective.turning - 1.0) * c.radius);
  }
  for (const Primitive& p : model.table.primitives) {
    if (p.twist.c == 0.0) continue;
    const double turn = std::abs(p.twist.c), length = p.twist.length();
    turn_rate_ = std::max(turn_rate_, turn / p.duration * kTicksPerSecond);
    if (length > 0.0) {
      turn_extra_ = std::min(turn_extra_, (objective.turning - 1.0) * length / turn);
    }
  }
  if (translates) turn_extra_ = 0.0;
}

bool LatticeSearch::prepare(Heuristic heuristic) {
  if (heuristic != Heuristic::kLookBack) return true;
  if (lattices_.front().knows_cost_to_go()) return true;
  std::vector<double> after(static_cast<std::size_t>(lattices_.back().num_modes()) + 1, 0.0);
  for (std::size_t i = lattices_.size(); i-- > 0;) {
    if (!lattices_[i].look_back(after)) return false;
    for (std::size_t m = 0; m < after.size(); ++m) {
      after[m] = lattices_[i].cost_to_go(0, static_cast<int>(m) - 1);
    }
  }
  return true;
}

// Least cost to the goal of a leg: way of the disc in the body round obstacles, and the turn.
double LatticeSearch::bound_of(int leg, std::int32_t node) {
  const auto l = static_cast<std::size_t>(leg), n = static_cast<std::size_t>(node);
  auto& known = bounds_[l];
  if (known.size() <= n) {
    known.resize(static_cast<std::size_t>(lattices_[l].num_nodes()), kUnknown);
  }
  if (known[n] < 0.0) known[n] = measure(leg, node);
  return known[n];
}

double LatticeSearch::measure(int leg, std::int32_t node) {
  const auto l = static_cast<std::size_t>(leg);
  const Pose at = lattices_[l].pose(node);
  const Pose& goal = legs_[l].goal;
  const double inradius = lattices_[l].body().inradius();
  if (!distances_[l]) {
    const Statics& statics = *model_.statics[static_cast<std::size_t>(legs_[l].body)];
    const double cell = std::clamp(0.5 * inradius, 0.1, kGridCell);
    distances_[l] = std::make_unique<GoalDistance>(statics, inradius, goal.x, goal.y, cell);
  }
  const float way = (*distances_[l])(at.x, at.y);
  if (way >= GoalDistance::kUnreachable) return kFar;
  const double cell = std::clamp(0.5 * inradius, 0.1, kGridCell);
  const double metres = std::max(std::hypot(at.x - goal.x, at.y - goal.y),
                                 static_cast<double>(way) / kGridExcess - 1.5 * cell);
  const double turn = std::abs(wrap(goal.theta - at.theta));
  if (!objective_.time) return metres + turn_extra_ * turn;
  return std::max(metres / model_.table.top_speed, turn_rate_ > 0.0 ? turn / turn_rate_ : 0.0) *
         kTicksPerSecond;
}

double LatticeSearch::paper_of(int leg, std::int32_t node) {
  const auto l = static_cast<std::size_t>(leg);
  const Pose at = lattices_[l].pose(node);
  const Pose& goal = legs_[l].goal;
  const double bound = bound_of(leg, node);
  if (bound >= kFar) return kFar;
  if (!curves_) curves_ = std::make_unique<ConnectTable>(model_.table, objective_);
  const Point local = Frame(goal).to_local({at.x, at.y});
  const double turn = std::abs(wrap(goal.theta - at.theta));
  const double unit = objective_.time ? kTicksPerSecond / model_.table.top_speed : 1.0;
  const double curve = (*curves_)(local.x, local.y, wrap(at.theta - goal.theta));
  const double grid = static_cast<double>((*distances_[l])(at.x, at.y));
  const double manhattan = std::abs(at.x - goal.x) + std::abs(at.y - goal.y);
  return std::max(curve, std::max(manhattan, grid) * unit) + turn * unit;
}

double LatticeSearch::estimate(const Label& label) {
  if (label.leg >= num_legs()) return 0.0;
  const auto l = static_cast<std::size_t>(label.leg);
  switch (guidance_.heuristic) {
    case Heuristic::kLookBack:
      return lattices_[l].cost_to_go(label.node, label.mode);
    case Heuristic::kBound:
      return bound_of(label.leg, label.node) + tail_[l];
    default:
      return paper_of(label.leg, label.node) + tail_[l];
  }
}

void LatticeSearch::compile(const std::vector<Rule>& rules) {
  motion_rules_.assign(legs_.size(), {});
  stand_rules_.clear();
  avoid_.clear();
  points_.clear();
  least_rest_ = 0;
  last_rest_ = kEver;
  last_change_ = 0;
  for (const Rule& rule : rules) {
    const bool in_slots = rule.kind == Rule::Kind::kStand || rule.kind == Rule::Kind::kRest;
    const std::int32_t end = std::max(rule.from, rule.to);
    last_change_ = std::max(last_change_, in_slots ? end : end / params_.slot + 1);
    switch (rule.kind) {
      case Rule::Kind::kMotion:
        motion_rules_[static_cast<std::size_t>(rule.leg)].push_back(rule);
        break;
      case Rule::Kind::kStand:
        stand_rules_[key_of(rule.leg, rule.node, 0)].spans.emplace_back(rule.from, rule.to);
        break;
      case Rule::Kind::kRest:
        if (rule.must) {
          last_rest_ = std::min(last_rest_, rule.to);
        } else {
          least_rest_ = std::max(least_rest_, rule.to + 1);
        }
        break;
      case Rule::Kind::kAvoid:
        avoid_.push_back(rule);
        break;
      case Rule::Kind::kPoint: {
        points_.push_back(rule);
        const Body& body = rest_body();
        const Frame rest(legs_.back().goal);
        const bool near = gap(body, rest, Circle{rule.point.x, rule.point.y, 0.0}) <= rule.gap;
        if (near != rule.must) {
          least_rest_ = std::max(least_rest_, rule.from / params_.slot + 1);
        }
        break;
      }
    }
  }
  for (auto& entry : stand_rules_) std::sort(entry.second.spans.begin(), entry.second.spans.end());
}

// Last tick, counted from the departure, at which a motion overlaps another's final rest; -1: none.
Ticks LatticeSearch::last_overlap(int other, int leg, std::int32_t node, std::size_t motion,
                                  const Lattice::Way& way) {
  auto& overlaps = overlaps_[static_cast<std::size_t>(other)];
  const std::uint64_t key = key_of(leg, node, motion);
  if (const auto known = overlaps.find(key); known != overlaps.end()) return known->second;
  const Rest& rest = rests_[static_cast<std::size_t>(other)];
  const double required = required_[static_cast<std::size_t>(other)];
  const Body& body = lattices_[static_cast<std::size_t>(leg)].body();
  std::vector<TimedPiece> pieces;
  Pose at = lattices_[static_cast<std::size_t>(leg)].pose(node);
  Ticks t = 0;
  for (std::size_t i = 0; i < way.drive.size; ++i) {
    const Step& step = way.drive.steps[i];
    pieces.push_back({t, t + step.duration, at, step.twist, step.mode,
                      legs_[static_cast<std::size_t>(leg)].body});
    at = moved(at, step.twist);
    t += step.duration;
  }
  const Ticks end = way.slots * params_.slot;
  Ticks last = -1;
  const Circle bound = rest.body->bound();
  const Point centre = rest.at.to_world({bound.x, bound.y});
  const double far = bound.r + body.circumradius() + required;
  bool near = false;
  for (const TimedPiece& p : pieces) {
    const Pose middle = moved(p.start, p.twist.part(0.5));
    near = near ||
           std::hypot(middle.x - centre.x, middle.y - centre.y) <= far + 0.5 * p.twist.length();
  }
  near = near || (pieces.empty() && end > 0);
  if (near) {
    if (pieces.empty())
      pieces.push_back({0, 1, at, {}, -1, legs_[static_cast<std::size_t>(leg)].body});
    const Track track(&model_.bodies, pieces.front().start, pieces, end);
    Ticks from = 0;
    while (from <= end) {
      const Mover still{
          rest.body, rest.at, {}, static_cast<double>(from), static_cast<double>(end - from)};
      const double met = meeting<false>(track, 0, end, still, required);
      if (met < 0.0) break;
      const Ticks clear = clear_after(track, *rest.body, rest.at,
                                      static_cast<Ticks>(std::ceil(met)), required, end);
      last = std::max(static_cast<Ticks>(met), std::min(clear, end) - 1);
      from = std::max(clear, static_cast<Ticks>(met) + 1);
    }
  }
  overlaps.emplace(key, last);
  return last;
}

bool LatticeSearch::rests_on(int other, int leg, std::int32_t node) {
  auto& overlaps = overlaps_[static_cast<std::size_t>(other)];
  const std::uint64_t key = key_of(leg, node, kStanding);
  if (const auto known = overlaps.find(key); known != overlaps.end()) return known->second > 0;
  const Rest& rest = rests_[static_cast<std::size_t>(other)];
  const double required = required_[static_cast<std::size_t>(other)];
  const Lattice& lattice = lattices_[static_cast<std::size_t>(leg)];
  const bool on =
      gap(lattice.body(), lattice.frame(node), *rest.body, rest.at, required) < required - 1e-7;
  overlaps.emplace(key, on);
  return on;
}

// Whether a robot that set out on a motion so many ticks ago is too near to a rule's point.
bool LatticeSearch::covers(const Rule& rule, int leg, std::int32_t node, const Lattice::Way& way,
                           Ticks since) const {
  const Lattice& lattice = lattices_[static_cast<std::size_t>(leg)];
  const Body& body = lattice.body();
  Frame at = lattice.frame(node);
  const Circle place{rule.point.x, rule.point.y, 0.0};
  const auto near = [&](const Frame& f) {
    const Point middle = f.to_world({body.bound().x, body.bound().y});
    const double mx = middle.x - place.x, my = middle.y - place.y;
    const double reach = body.bound().r + std::max(rule.gap, 0.0);
    return mx * mx + my * my <= reach * reach && gap(body, f, place) <= rule.gap;
  };
  // As far as it can have come.
  const double dx = rule.point.x - at.x, dy = rule.point.y - at.y;
  const double far = body.circumradius() + std::max(rule.gap, 0.0) +
                     model_.table.top_speed * since / kTicksPerSecond;
  if (dx * dx + dy * dy > far * far) return false;
  Ticks t = 0;
  for (std::size_t i = 0; i < way.drive.size; ++i) {
    const Step& step = way.drive.steps[i];
    if (since < t + step.duration) {
      const double share = static_cast<double>(since - t) / step.duration;
      return near(moved(at, step.twist.part(share)));
    }
    at = moved(at, step.twist);
    t += step.duration;
  }
  return near(at);
}

// First slot from `from` on in which a motion may be set out on; kEver if none.
Slot LatticeSearch::earliest(int leg, std::int32_t node, std::size_t motion,
                             const Lattice::Way& way, Slot from) {
  const bool arrives = motion >= lattices_[static_cast<std::size_t>(leg)].num_primitives();
  if (arrives) {
    // It comes no sooner than the visit may begin, but where it may stay for good.
    const Leg& visit = legs_[static_cast<std::size_t>(leg)];
    const bool stays = leg + 1 == num_legs() && visit.body == rest_body_;
    const Ticks begin = stays ? 0 : visit.not_before;
    from = std::max(from, (begin - way.drive.duration + params_.slot - 1) / params_.slot);
    if (leg + 1 == num_legs()) from = std::max(from, least_rest_ - way.slots);
  }
  const auto& rules = motion_rules_[static_cast<std::size_t>(leg)];
  if (!rules.empty()) {
    const Lattice& lattice = lattices_[static_cast<std::size_t>(leg)];
    spans_.clear();
    for (const Rule& rule : rules) {
      const Ticks offset = lattice.drives(node, way, arrives, rule.stretch);
      if (offset < 0) continue;
      const Ticks begin = rule.from - offset, end = rule.to - offset;
      if (end < from * params_.slot) continue;
      spans_.emplace_back((std::max(begin, 0) + params_.slot - 1) / params_.slot,
                          end / params_.slot);
    }
  } else {
    spans_.clear();
  }
  for (bool again = !spans_.empty() || !points_.empty(); again;) {
    again = false;
    for (const auto& [begin, end] : spans_) {
      if (from < begin || from > end) continue;
      from = end + 1;
      again = true;
    }
    for (const Rule& rule : points_) {
      const Ticks since = rule.from - from * params_.slot;
      if (since < 0 || since >= way.slots * params_.slot) continue;
      if (covers(rule, leg, node, way, since) == rule.must) continue;
      ++from;
      again = true;
    }
  }
  if (from >= kEver) return kEver;
  if (arrives && leg + 1 == num_legs() && from + way.slots > last_rest_) return kEver;
  for (const Rule& rule : avoid_) {
    if ((from + way.slots) * params_.slot < rule.from) continue;
    const Ticks last = last_overlap(rule.other, leg, node, motion, way);
    if (last >= 0 && from * params_.slot + last >= rule.from) return kEver;
  }
  return from;
}

// Last slot at which a robot that stands at a node from `from` on can set out; kEver if any.
Slot LatticeSearch::stands_until(int leg, std::int32_t node, Slot from) {
  Slot until = kEver;
  if (!stand_rules_.empty()) {
    const auto rules = stand_rules_.find(key_of(leg, node, 0));
    if (rules != stand_rules_.end()) {
      for (const auto& [begin, end] : rules->second.spans) {
        if (end >= from) until = std::min(until, std::max(begin, from));
      }
    }
  }
  for (const Rule& rule : avoid_) {
    if (rests_on(rule.other, leg, node)) {
      until = std::min(until, std::max(from, rule.from / params_.slot));
    }
  }
  for (const Rule& rule : points_) {
    const Slot slot = rule.from / params_.slot;
    if (slot >= from && slot < until && covers(rule, leg, node, {}, 0) != rule.must) until = slot;
  }
  return until;
}

std::size_t LatticeSearch::state(const Label& label) const {
  const Lattice& lattice = lattices_[static_cast<std::size_t>(label.leg)];
  const auto wide = static_cast<std::size_t>(lattice.num_modes()) + 1;
  return static_cast<std::size_t>(label.node) * wide +
         (lattice.tells_modes() ? static_cast<std::size_t>(label.mode + 1) : 0);
}

// Whether waiting in a label of the same state is as good.
bool LatticeSearch::dominated(const Label& label, std::int32_t head) const {
  for (std::int32_t i = head; i != kNone; i = labels_[static_cast<std::size_t>(i)].next) {
    const Label& other = labels_[static_cast<std::size_t>(i)];
    if (other.t > label.t) continue;
    const double there = other.g + cost_of_waiting() * (label.t - other.t);
    if (there > label.g + kEven) continue;
    if (other.t == label.t || other.end >= label.t) return true;
  }
  return false;
}

// Whether a robot can still be where rules say that it must be.
bool LatticeSearch::comes_in_time(const Label& label) const {
  const Lattice& lattice = lattices_[static_cast<std::size_t>(label.leg)];
  for (const Rule& rule : points_) {
    const Ticks left = rule.from - label.t * params_.slot;
    if (!rule.must || left < 0) continue;
    const Frame at = lattice.frame(label.node);
    const double dx = rule.point.x - at.x, dy = rule.point.y - at.y;
    const double far = lattice.body().circumradius() + std::max(rule.gap, 0.0) +
                       model_.table.top_speed * left / kTicksPerSecond;
    if (dx * dx + dy * dy > far * far) return false;
  }
  return true;
}

void LatticeSearch::push(Label label) {
  const double h = estimate(label);
  if (!(h < kFar)) return;
  if (label.leg < num_legs()) {
    const Lattice& lattice = lattices_[static_cast<std::size_t>(label.leg)];
    label.end = stands_until(label.leg, label.node, label.t);
    if (label.mode >= 0 && !model_.table.rest[static_cast<std::size_t>(label.mode)]) {
      label.end = label.t;
    }
    auto& heads = heads_[static_cast<std::size_t>(label.leg)];
    const std::size_t s = state(label);
    const auto wide = static_cast<std::size_t>(lattice.num_modes()) + 1;
    if (heads.size() < static_cast<std::size_t>(lattice.num_nodes()) * wide) {
      heads.resize(static_cast<std::size_t>(lattice.num_nodes()) * wide, kNone);
    }
    // What comes too late for a rule that bids may still come after it.
    if (!comes_in_time(label) || dominated(label, heads[s])) {
      later(label);
      return;
    }
    if (heads[s] == kNone) touched_.emplace_back(label.leg, s);
    label.next = heads[s];
    heads[s] = static_cast<std::int32_t>(labels_.size());
  }
  const double xi =
      guidance_.adaptive && estimate_at_start_ > 0.0
          ? std::clamp(1.0 + (guidance_.xi - 1.0) * h / estimate_at_start_, 1.0, guidance_.xi)
          : guidance_.xi;
  label.f = label.g + xi * h;
  label.done = label.met = false;
  const auto index = static_cast<std::int32_t>(labels_.size());
  labels_.push_back(label);
  open_.push_back({label.f, 0, index});
  std::push_heap(open_.begin(), open_.end());
  if (guidance_.xi > 1.0) return;  // greedy search proves nothing
  live_.push_back({label.f, 0, index});
  std::push_heap(live_.begin(), live_.end());
}

void LatticeSearch::depart(Label& child, Slot when) {
  const Label& parent = labels_[static_cast<std::size_t>(child.parent)];
  Lattice& lattice = lattices_[static_cast<std::size_t>(parent.leg)];
  const auto way = lattice.way(parent.node, static_cast<std::size_t>(child.motion));
  const bool switching = parent.mode >= 0 && way.first >= 0 && way.first != parent.mode;
  const Slot pause = switching ? lattice.switch_slots() : 0;
  child.depart = when;
  child.t = when + way.slots;
  child.g = parent.g + way.cost + (switching ? lattice.switch_cost() : 0.0) +
            cost_of_waiting() * (when - pause - parent.t);
}

void LatticeSearch::expand(std::int32_t index) {
  const Label label = labels_[static_cast<std::size_t>(index)];
  Lattice& lattice = lattices_[static_cast<std::size_t>(label.leg)];
  const std::size_t count = lattice.num_motions(label.node);
  later(label);
  for (std::size_t motion = 0; motion < count; ++motion) {
    if (!lattice.may_follow(label.mode, motion)) continue;
    const std::int32_t to = lattice.target(label.node, motion);
    if (to == Lattice::kBlocked) continue;
    const Lattice::Way way = lattice.way(label.node, motion);
    const bool switching = label.mode >= 0 && way.first >= 0 && way.first != label.mode;
    const Slot pause = switching ? lattice.switch_slots() : 0;
    const Slot when = earliest(label.leg, label.node, motion, way, label.t + pause);
    if (when >= kEver || when > label.end) continue;
    Label child{};
    child.parent = index;
    child.motion = static_cast<std::int32_t>(motion);
    child.leg = static_cast<std::int16_t>(to == Lattice::kGoal ? label.leg + 1 : label.leg);
    child.node = to == Lattice::kGoal ? 0 : to;
    child.mode = static_cast<std::int16_t>(way.last >= 0 ? way.last : label.mode);
    depart(child, when);
    push(child);
  }
}

// The same motion again, to arrive when this label's stand must be over. Every way to a place is
// asked for every window in which it may be, also where it comes to the first one too late.
void LatticeSearch::later(const Label& label) {
  if (label.parent == kNone || label.end > last_change_) return;
  const Label& parent = labels_[static_cast<std::size_t>(label.parent)];
  const Lattice::Way way =
      lattice(parent.leg).way(parent.node, static_cast<std::size_t>(label.motion));
  const Slot when = earliest(parent.leg, parent.node, static_cast<std::size_t>(label.motion), way,
                             label.depart + label.end + 1 - label.t);
  if (when >= kEver || when > parent.end) return;  // later labels of the parent see to it
  Label child = label;
  depart(child, when);
  push(child);
}

// Count the meetings of a label's motion, and of the wait before it, and those before them.
void LatticeSearch::meet(Label& label, Encounters& encounters) {
  label.num_hits = 0;
  if (label.parent == kNone) return;
  const Label& parent = labels_[static_cast<std::size_t>(label.parent)];
  Lattice& lattice = lattices_[static_cast<std::size_t>(parent.leg)];
  const Lattice::Way way = lattice.way(parent.node, static_cast<std::size_t>(label.motion));
  const Frame from = lattice.frame(parent.node);
  const Ticks depart = label.depart * params_.slot;
  HitList hits = encounters.collect(lattice.body(), from, way.drive, depart, kNobody);
  if (label.depart > parent.t) {
    hits = encounters.collect_standing(lattice.body(), from, parent.t * params_.slot, depart, hits);
  }
  if (label.leg > parent.leg) {
    const Frame at(legs_[static_cast<std::size_t>(parent.leg)].goal);
    const Ticks arrive = depart + way.drive.duration, leave = label.t * params_.slot;
    hits = encounters.collect_standing(lattice.body(), at, arrive, leave, hits);
    if (label.leg == num_legs()) {
      hits = encounters.collect_standing(rest_body(), at, leave, kNever, hits);
    }
  }
  label.num_hits = parent.num_hits;
  for (HitList h = hits; h != kNobody; h = encounters.next(h)) ++label.num_hits;
}

LatticeSearch::Outcome LatticeSearch::operator()(const std::vector<Rule>& rules,
                                                 const Traffic* others, const Guidance& guidance,
                                                 Budget& budget, Route& route) {
  guidance_ = guidance;
  compile(rules);
  for (const auto& [leg, s] : touched_) heads_[static_cast<std::size_t>(leg)][s] = kNone;
  touched_.clear();
  labels_.clear();
  open_.clear();
  live_.clear();
  focal_.clear();
  tail_.assign(legs_.size(), 0.0);
  if (guidance.heuristic != Heuristic::kLookBack) {
    for (std::size_t l = legs_.size() - 1; l-- > 0;) {
      const int next = static_cast<int>(l) + 1;
      tail_[l] = tail_[l + 1] +
                 (guidance.heuristic == Heuristic::kBound ? bound_of(next, 0) : paper_of(next, 0));
    }
  }
  Encounters encounters(others, &required_);
  Label start{};
  start.parent = kNone;
  start.motion = kNone;
  start.mode = static_cast<std::int16_t>(mode_);
  estimate_at_start_ = 0.0;
  estimate_at_start_ = estimate(start);
  push(start);
  const bool greedy = guidance.xi > 1.0;
  const double unit = objective_.time ? kTicksPerSecond : 1.0;
  const double price = guidance.meeting * unit;
  double bound = 0.0;
  while (true) {
    while (!live_.empty() && labels_[static_cast<std::size_t>(live_.front().label)].done) {
      std::pop_heap(live_.begin(), live_.end());
      live_.pop_back();
    }
    if (greedy ? open_.empty() && focal_.empty() : live_.empty()) return Outcome::kNone;
    if (!greedy) bound = std::max(bound, live_.front().key);
    const double limit = greedy ? kFar : guidance.focus * bound + 1e-7 * unit;
    while (!open_.empty() && open_.front().key <= limit) {
      std::pop_heap(open_.begin(), open_.end());
      const std::int32_t index = open_.back().label;
      open_.pop_back();
      Label& label = labels_[static_cast<std::size_t>(index)];
      if (greedy) {
        // Whom it meets is looked at if it comes up; until then those that its parent met count.
        if (label.parent != kNone) {
          label.num_hits = labels_[static_cast<std::size_t>(label.parent)].num_hits;
        }
        focal_.push_back({label.f + price * label.num_hits, 0, index});
      } else {
        if (others) meet(label, encounters);
        focal_.push_back({label.f, label.num_hits, index});
      }
      std::push_heap(focal_.begin(), focal_.end());
    }
    std::pop_heap(focal_.begin(), focal_.end());
    const std::int32_t index = focal_.back().label;
    focal_.pop_back();
    Label& label = labels_[static_cast<std::size_t>(index)];
    if (greedy && others && !label.met) {
      label.met = true;
      const std::int32_t before = label.num_hits;
      meet(label, encounters);
      if (label.num_hits > before) {
        focal_.push_back({label.f + price * label.num_hits, 0, index});
        std::push_heap(focal_.begin(), focal_.end());
        continue;
      }
    }
    label.done = true;
    if (label.leg == num_legs()) {
      extract(index, route);
      route.bound = greedy ? 0.0 : bound;
      return Outcome::kFound;
    }
    if (!budget.spend()) return Outcome::kStopped;
    ++expansions_;
    expand(index);
  }
}

void LatticeSearch::extract(std::int32_t index, Route& route) {
  route = Route{};
  route.cost = labels_[static_cast<std::size_t>(index)].g;
  route.rest = labels_[static_cast<std::size_t>(index)].t;
  std::vector<std::int32_t> chain;
  for (std::int32_t i = index; labels_[static_cast<std::size_t>(i)].parent != kNone;
       i = labels_[static_cast<std::size_t>(i)].parent) {
    chain.push_back(i);
  }
  std::reverse(chain.begin(), chain.end());
  Ticks t = 0;
  for (const std::int32_t i : chain) {
    const Label& label = labels_[static_cast<std::size_t>(i)];
    const Label& parent = labels_[static_cast<std::size_t>(label.parent)];
    Lattice& lattice = lattices_[static_cast<std::size_t>(parent.leg)];
    const Lattice::Way way = lattice.way(parent.node, static_cast<std::size_t>(label.motion));
    const int body = lattice.leg().body;
    route.moves.push_back({parent.leg, parent.node, label.motion, label.depart, label.t});
    Pose at = lattice.pose(parent.node);
    const auto stand = [&](Ticks until) {
      if (until > t) route.pieces.push_back({t, until, at, {}, -1, body});
      t = std::max(t, until);
    };
    stand(label.depart * params_.slot);
    for (std::size_t k = 0; k < way.drive.size; ++k) {
      const Step& step = way.drive.steps[k];
      join(route.pieces, {t, t + step.duration, at, step.twist, step.mode, body});
      at = moved(at, step.twist);
      at.theta = wrap(at.theta);
      t += step.duration;
    }
    if (label.leg == parent.leg) continue;
    at = lattice.leg().goal;
    const Ticks wait = std::max(0, lattice.leg().not_before - t);
    route.stops.push_back({parent.leg, t + wait, label.t * params_.slot + wait});
    route.arrival = t;
    stand(label.t * params_.slot);
    if (label.leg == num_legs()) route.pieces.push_back({t, t + 1, at, {}, -1, rest_body_});
  }
}

}  // namespace clearway
