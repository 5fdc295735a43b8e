#include "clearway/search/tour_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "clearway/search/cells.hpp"
#include "clearway/search/encounters.hpp"

namespace clearway {

namespace {

constexpr double kCoarsestGoalCell = 0.5, kFinestGoalCell = 0.1;  // of goal distances (m)
constexpr int kMostDelays = 64;            // departures tried for one motion before it is given up
constexpr std::int64_t kFirstGreed = 256;  // expansions until a search grows greedier
constexpr double kCertain = 0.95;          // share of an estimate that is relied on
constexpr std::int32_t kNone = -1;
// Towards a visit that must wait for its time, one sets out so much earlier: that many times the
// least duration, and some ticks more.
constexpr double kHeadStart = 1.5;
constexpr Ticks kSpareTime = 5000;

struct Node {
  double x, y;
  double cost;      // objective so far
  double step;      // what the edge alone adds to it
  Ticks t, end;     // the safe interval is left at `end` (set when expanded)
  Ticks departure;  // from the parent
  std::int32_t parent;
  HitList hits;       // head of the list of tracks run into (soft search)
  std::int32_t edge;  // primitive, or num_primitives + shot
  std::int16_t leg, k, mode, goal;
  bool arrives;        // the edge ended at the visit of leg - 1
  bool driven;         // the edge is known to be clear; until then its cost is a lower bound
  std::int8_t delays;  // departures tried before
  Ticks after;  // the end of the edge is occupied then: depart once it is free again; or kNever
};

struct Open {
  double f;
  std::int32_t node;
  bool operator<(const Open& other) const { return f != other.f ? f > other.f : node < other.node; }
};

// Grid of the goal distance: fine enough for a lane that the body just fits.
double goal_cell(double inradius) {
  return std::clamp(0.5 * inradius, kFinestGoalCell, kCoarsestGoalCell);
}

// Expansions that cost as much as a goal distance.
std::int64_t worth_a_distance(const Statics& statics, double inradius) {
  const Box& box = statics.box();
  const double cell = goal_cell(inradius);
  return static_cast<std::int64_t>((box.x1 - box.x0) * (box.y1 - box.y0) / (cell * cell) / 32.0);
}

}  // namespace

// What a search fills; kept so that the next one need not allocate.
struct TourMemory {
  Cells cells;
  std::vector<Node> nodes;
  std::vector<Open> open;
  std::vector<Shot> shots, tried;
};

// One query's search.
class TourRun {
 public:
  TourRun(TourSearch& search, const TourQuery& query)
      : s_(search),
        q_(query),
        table_(query.fine ? query.model->fine : query.model->table),
        legs_(*query.legs),
        connect_table_(search.connect_table(*query.model, query.fine)),
        weight_(query.penalty ? search.params_.soft_weight : search.params_.weight),
        meet_(query.traffic, query.required),
        cells_(search.memory_->cells),
        nodes_(search.memory_->nodes),
        open_(search.memory_->open),
        shots_(search.memory_->shots),
        tried_(search.memory_->tried) {
    cells_.reset((query.fine ? 0.5 : 1.0) * search.params_.cell * table_.shortest_step(),
                 search.objective_.time ? 1.0 : search.objective_.waiting / kTicksPerSecond);
    nodes_.clear();
    open_.clear();
    shots_.clear();
  }

  TourResult run(std::int64_t limit, Budget& budget);

 private:
  void prepare();
  void look_ahead();
  void find_earliest();
  void learn_distance(int leg);
  void grow_greedy();
  void sort_anew();
  double estimate(int leg, double x, double y, double theta, double speed);
  double estimate(int leg, std::size_t goal, double x, double y, double theta, double speed);
  std::size_t aim(const Node& node);
  Ticks free_for_good(const Frame& at) const;
  double priority(const Node& node);
  void expand(std::int32_t index);
  void shoot(std::int32_t index);
  bool drive(std::int32_t index);
  bool passable(const Node& node) const;
  bool launch(Node& child) const;
  bool pay(Node& child);
  void retry(const Node& node, Ticks met);
  Ticks next_free(const Node& node);
  void depart(Node& child, Ticks departure) const;
  void push(const Node& child);
  bool is_useful(const Node& node);
  void arrive(std::int32_t index);
  Drive edge_of(std::int32_t edge) const;
  Ticks patience(const Node& node) const;
  Ticks dwell(const Node& node) const;
  Ticks set_out(const Node& node);
  double price(int track) const;

  const Body& body(int leg) const {
    return q_.model->bodies[static_cast<std::size_t>(legs_[static_cast<std::size_t>(leg)].body)];
  }
  const Statics& statics(int leg) const {
    return *q_.model->statics[static_cast<std::size_t>(legs_[static_cast<std::size_t>(leg)].body)];
  }
  const Body& resting() const { return q_.model->bodies[static_cast<std::size_t>(q_.rest_body)]; }
  int body_leg(int leg) const { return std::min(leg, static_cast<int>(legs_.size()) - 1); }
  double theta(const Node& n) const {
    return headings_[static_cast<std::size_t>(n.leg)]->theta(n.k);
  }
  Frame frame(const Node& n) const {
    if (n.leg == static_cast<int>(legs_.size())) {
      return goals_.back()[static_cast<std::size_t>(n.goal)].frame;
    }
    return headings_[static_cast<std::size_t>(n.leg)]->frame(n.x, n.y, n.k);
  }

  bool may_stay(const Body& serving, const Frame& at, Ticks arrival, Ticks service, bool last,
                HitList hits, Ticks* better) const;
  TourResult extract(std::int32_t goal);

  TourSearch& s_;
  const TourQuery& q_;
  const MotionTable& table_;
  const std::vector<Leg>& legs_;
  ConnectTable& connect_table_;
  double weight_;
  std::int64_t next_greed_ = kFirstGreed;
  Encounters meet_;
  Cells& cells_;
  std::vector<Node>& nodes_;
  std::vector<Open>& open_;
  std::vector<Shot>& shots_;
  std::vector<Shot>& tried_;

  std::vector<const HeadingTable*> headings_;  // per leg, and one more after the last
  struct Goal {
    Pose pose;
    Frame frame;
    const GoalDistance* distance;  // null until its leg proves to need it
    int number;                    // 0: the leg's own, then the others
    Ticks free = 0;                // for good; of the last leg's
  };
  std::vector<std::vector<Goal>> goals_;  // per leg
  std::vector<std::int64_t> spent_on_;    // expansions per leg
  std::vector<double> tail_;              // estimate of all that follows a leg
  std::vector<Ticks> earliest_;  // begin of each service before the last rest; 0: nothing known
  std::vector<double> floor_;    // priority that a leg's states cannot fall below (time only)
  std::vector<Step> primitive_steps_;
  std::int32_t found_ = kNone;
  std::int32_t best_ = kNone;  // cheapest complete way so far
  Ticks earliest_rest_ = 0;    // no final rest can begin before
  bool hopeless_ = false;
  double since_shot_ = std::numeric_limits<double>::infinity();
};

void TourRun::prepare() {
  const std::size_t n = legs_.size();
  double heading = q_.start.theta;
  for (std::size_t i = 0; i <= n; ++i) {
    headings_.push_back(&s_.heading_table(*q_.model, q_.fine, heading));
    if (i == n) break;
    heading = legs_[i].goal.theta;
    const int l = static_cast<int>(i);
    goals_.emplace_back();
    const auto add = [&](const Pose& pose, int number) {
      const GoalDistance* known = s_.goal_distance(statics(l), body(l).inradius(), pose, false);
      goals_.back().push_back({pose, Frame(pose), known, number});
    };
    add(legs_[i].goal, 0);
    if (i + 1 < n) continue;
    for (std::size_t j = 0; j < legs_[i].others.size(); ++j) {
      add(legs_[i].others[j], static_cast<int>(j) + 1);
    }
  }
  if (q_.traffic && !q_.penalty) {
    std::vector<Goal>& rests = goals_.back();
    for (Goal& goal : rests) goal.free = free_for_good(goal.frame);
    // Where somebody rests for ever nobody else can.
    std::erase_if(rests, [](const Goal& goal) { return goal.free >= kNever; });
    hopeless_ = rests.empty();
    if (hopeless_) return;
    earliest_rest_ = kNever;
    for (const Goal& goal : rests) earliest_rest_ = std::min(earliest_rest_, goal.free);
  }
  spent_on_.assign(n, 0);
  look_ahead();
  for (const Primitive& p : table_.primitives) {
    primitive_steps_.push_back({p.mode, p.twist, p.duration});
  }
}

// From when on the resting body may stand at a place for ever; kNever: somebody else does.
Ticks TourRun::free_for_good(const Frame& at) const {
  Ticks t = q_.ready;
  while (t < kNever) {
    Ticks met = t;
    if (meet_.safe_until(resting(), at, t, kNobody, &met) >= kNever) break;
    t = meet_.next_free(resting(), at, met, kNobody);
  }
  return t;
}

void TourRun::look_ahead() {
  tail_.assign(legs_.size(), 0.0);
  for (std::size_t i = legs_.size() - 1; i-- > 0;) {
    const Pose& p = legs_[i].goal;
    tail_[i] = tail_[i + 1] + estimate(static_cast<int>(i) + 1, p.x, p.y, p.theta, 0.0) +
               (s_.objective_.time ? legs_[i].service : 0);
  }
  // Whatever comes early waits: all ways there are worth as much, and the nearest goes first.
  if (earliest_.empty()) find_earliest();
  floor_.assign(legs_.size(), 0.0);
  for (std::size_t i = legs_.size() - 1; i-- > 0;) {
    const double begin = std::max(legs_[i].not_before, earliest_[i]) - q_.ready;
    const double after = std::max(weight_, s_.params_.tail_weight) * tail_[i];
    floor_[i] = std::max(floor_[i + 1], begin > 0.0 ? begin + after : 0.0);
  }
}

// From when on each service is possible: no sooner than the robot can come, and when nobody else is
// at its place.
void TourRun::find_earliest() {
  earliest_.assign(legs_.size(), 0);
  if (!q_.minds_places || !q_.traffic || q_.penalty || !s_.objective_.time) return;
  Pose from = q_.start;
  Ticks t = q_.ready;
  for (std::size_t i = 0; i + 1 < legs_.size(); ++i) {
    const Leg& leg = legs_[i];
    const int l = static_cast<int>(i);
    t += static_cast<Ticks>(kCertain * estimate(l, from.x, from.y, from.theta, 0.0));
    const Ticks soonest = t;
    const Frame at(leg.goal);
    while (true) {
      Ticks met = t;
      if (meet_.safe_until(body(l), at, t, kNobody, &met) >= t + leg.service) break;
      t = meet_.next_free(body(l), at, met, kNobody);
      if (t >= kNever) {
        hopeless_ = true;  // somebody stands there for ever
        return;
      }
    }
    if (t > soonest) earliest_[i] = t;
    t = std::max(t, leg.not_before) + leg.service;
    from = leg.goal;
  }
}

// The straight distance has led nowhere for as long as it takes to know the one round obstacles.
void TourRun::learn_distance(int leg) {
  const auto l = static_cast<std::size_t>(leg);
  for (Goal& goal : goals_[l]) {
    goal.distance = s_.goal_distance(statics(leg), body(leg).inradius(), goal.pose, true);
  }
  look_ahead();
  sort_anew();
}

// The longer a search lasts, the more it goes for the goal.
void TourRun::grow_greedy() {
  next_greed_ *= 2;
  const double greedier =
      std::min(weight_ + s_.params_.greed, std::max(weight_, s_.params_.most_weight));
  if (greedier == weight_) return;
  weight_ = greedier;
  look_ahead();
  sort_anew();
}

void TourRun::sort_anew() {
  for (Open& entry : open_) entry.f = priority(nodes_[static_cast<std::size_t>(entry.node)]);
  std::erase_if(open_, [](const Open& entry) { return !std::isfinite(entry.f); });
  std::make_heap(open_.begin(), open_.end());
}

// To the nearest of the leg's goals.
double TourRun::estimate(int leg, double x, double y, double theta, double speed) {
  const std::size_t count = goals_[static_cast<std::size_t>(leg)].size();
  double least = estimate(leg, 0, x, y, theta, speed);
  for (std::size_t i = 1; i < count; ++i) {
    least = std::min(least, estimate(leg, i, x, y, theta, speed));
  }
  return least;
}

double TourRun::estimate(int leg, std::size_t number, double x, double y, double theta,
                         double speed) {
  const Goal& goal = goals_[static_cast<std::size_t>(leg)][number];
  const Point local = goal.frame.to_local({x, y});
  double metres = length(local);
  if (goal.distance) {
    const float distance = (*goal.distance)(x, y);
    if (distance >= GoalDistance::kUnreachable) return std::numeric_limits<double>::infinity();
    metres =
        std::max(metres, static_cast<double>(distance) - 0.5 * goal_cell(body(leg).inradius()));
  }
  const double exact = connect_table_(local.x, local.y, theta - goal.pose.theta);
  if (!s_.objective_.time) return std::max(metres, exact);
  return std::max(table_.least_ticks(metres, speed), exact - table_.head_start(speed));
}

// Cost so far plus weighted estimates; later legs weigh more, so that a search held up on one
// leg does not try all variants of those before it.
double TourRun::priority(const Node& node) {
  if (node.leg >= static_cast<int>(legs_.size())) return node.cost;
  const double here = estimate(node.leg, node.x, node.y, theta(node), table_.speed(node.mode));
  const double tail = tail_[static_cast<std::size_t>(node.leg)];
  const double f = node.cost + weight_ * here + std::max(weight_, s_.params_.tail_weight) * tail;
  if (!s_.objective_.time) return f;
  // Before the final pose is free for good all ways are alike; the nearest goes first.
  const double least = std::max(floor_[static_cast<std::size_t>(node.leg)],
                                static_cast<double>(earliest_rest_ - q_.ready));
  return std::max(f, least) + 1e-3 * (here + tail);
}

Drive TourRun::edge_of(std::int32_t edge) const {
  const auto i = static_cast<std::size_t>(edge);
  if (i < primitive_steps_.size()) {
    const std::vector<Step>& steps = table_.primitives[i].steps;
    if (!steps.empty()) return {steps.data(), steps.size(), primitive_steps_[i].duration};
    return {&primitive_steps_[i], 1, primitive_steps_[i].duration};
  }
  const Shot& shot = shots_[i - primitive_steps_.size()];
  return {shot.steps.data(), shot.steps.size(), shot.duration};
}

// How long the robot waits at a visit until its service may begin.
Ticks TourRun::patience(const Node& node) const {
  if (!node.arrives) return 0;
  const Leg& leg = legs_[static_cast<std::size_t>(node.leg) - 1];
  return std::max(0, leg.not_before - (node.departure + edge_of(node.edge).duration));
}

// How long it stands at a visit.
Ticks TourRun::dwell(const Node& node) const {
  if (!node.arrives) return 0;
  return patience(node) + legs_[static_cast<std::size_t>(node.leg) - 1].service;
}

// When to leave a node. Who would be too early at the next visit stays where it is, as long as it
// can: at a start or a visit made it is less in the way than at one that others have to pass.
Ticks TourRun::set_out(const Node& node) {
  const Leg& leg = legs_[static_cast<std::size_t>(node.leg)];
  const bool begins = node.parent == kNone || node.arrives;
  if (!begins || leg.not_before <= node.t || node.leg + 1 == static_cast<int>(legs_.size())) {
    return node.t;
  }
  double ahead = estimate(node.leg, node.x, node.y, theta(node), table_.speed(node.mode));
  if (!s_.objective_.time) ahead *= kTicksPerSecond / table_.top_speed;
  const double latest = leg.not_before - kHeadStart * ahead - kSpareTime;
  if (latest <= node.t) return node.t;
  return std::max(node.t, std::min(static_cast<Ticks>(latest), node.end));
}

double TourRun::price(int track) const { return (*q_.penalty)[static_cast<std::size_t>(track)]; }

// Whether a visit's pose can be held from `arrival` through the service, and for ever at the last
// one, where the body may be another from then on; if not, the next arrival worth trying.
bool TourRun::may_stay(const Body& serving, const Frame& at, Ticks arrival, Ticks service,
                       bool last, HitList hits, Ticks* better) const {
  const Ticks leave = arrival + service;
  const bool same = !last || &resting() == &serving;
  Ticks met = 0;
  Ticks until = meet_.safe_until(serving, at, arrival, hits, &met);
  if (until < (last && same ? kNever : leave)) {
    *better = meet_.next_free(serving, at, met, hits);
    return false;
  }
  if (same) return true;
  until = meet_.safe_until(resting(), at, leave, hits, &met);
  if (until >= kNever) return true;
  const Ticks clear = meet_.next_free(resting(), at, met, hits);
  *better = clear >= kNever ? kNever : clear - service;
  return false;
}

// Try to drive the child's edge when it departs. True: it is driven. False: not then; if it may be
// tried again, its departure is a later one, else kNever.
bool TourRun::launch(Node& child) const {
  const Node& parent = nodes_[static_cast<std::size_t>(child.parent)];
  const Drive edge = edge_of(child.edge);
  const Body& moving = body(parent.leg);
  const Frame start = frame(parent);
  const Frame end = frame(child);
  const bool last = child.arrives && child.leg == static_cast<int>(legs_.size());
  const Ticks service = dwell(child);
  const Ticks departure = child.departure, arrival = departure + edge.duration;
  if (departure > parent.end) {  // somebody comes while it changes its mode
    child.departure = kNever;
    return false;
  }
  child.hits = parent.hits;
  Ticks later = kNever;
  if (const Interval* seen = cells_.covering(child.x, child.y, child.k, child.leg, child.mode,
                                             child.t, child.cost, 0)) {
    if (seen->end < kNever && q_.traffic) {
      child.after = seen->met;
      later = departure + patience(child) + std::max(1, seen->met - child.t);
    }
  } else {
    int track = 0;
    const bool meets =
        meet_.conflict(moving, start, edge, departure, parent.hits, &track, parent.end, &later);
    if (meets && q_.met) ++(*q_.met)[static_cast<std::size_t>(track)];
    if (!meets) {
      if (!child.arrives ||
          may_stay(moving, end, arrival, service, last, last ? kNone : parent.hits, &later)) {
        child.driven = true;
        return true;
      }
      if (later < kNever) later -= edge.duration;
    }
  }
  const bool can_wait = parent.mode < 0 || table_.rest[static_cast<std::size_t>(parent.mode)];
  later = later < kNever ? std::max(departure + 1, later) : kNever;
  if (!can_wait || later >= kNever || later > parent.end || child.delays >= kMostDelays) {
    child.departure = kNever;
  } else {
    ++child.delays;
    depart(child, later);
  }
  return false;
}

// Soft search: depart as planned and pay for whoever is in the way; false where somebody does
// not move away.
bool TourRun::pay(Node& child) {
  const Node& parent = nodes_[static_cast<std::size_t>(child.parent)];
  const Drive edge = edge_of(child.edge);
  const Body& moving = body(parent.leg);
  const Frame start = frame(parent), end = frame(child);
  const bool last = child.arrives && child.leg == static_cast<int>(legs_.size());
  const Ticks service = dwell(child);
  const Ticks arrival = child.departure + edge.duration;
  double penalties = 0.0;
  child.hits = meet_.collect(moving, start, edge, child.departure, parent.hits);
  if (child.departure > parent.end) {  // while it changes its mode
    child.hits = meet_.collect_standing(moving, start, parent.t, child.departure, child.hits);
  }
  if (child.arrives && !last) {
    child.hits = meet_.collect_standing(moving, end, arrival, arrival + service, child.hits);
  }
  for (HitList h = child.hits; h != parent.hits; h = meet_.next(h)) {
    if (price(meet_.track(h)) < 0.0) return false;
    penalties += price(meet_.track(h));
  }
  if (last) {
    // Who needs to pass a robot at its final rest can only pass before: that costs again.
    HitList met = meet_.collect_standing(moving, end, arrival, arrival + service, kNobody);
    met = meet_.collect_standing(resting(), end, arrival + service, kNever, met);
    for (HitList h = met; h != kNobody; h = meet_.next(h)) {
      const int track = meet_.track(h);
      if (price(track) < 0.0) return false;
      penalties += price(track);
      if (!meet_.is_hit(child.hits, track)) child.hits = meet_.add(track, child.hits);
    }
  }
  depart(child, child.departure);
  child.cost += penalties;
  child.driven = true;
  return true;
}

// Times and cost of a child that departs then.
void TourRun::depart(Node& child, Ticks departure) const {
  const Node& parent = nodes_[static_cast<std::size_t>(child.parent)];
  child.departure = departure;
  child.t = departure + edge_of(child.edge).duration + dwell(child);
  child.end = -1;
  // Once it has come to its final rest, waiting costs nothing.
  const bool last = child.leg == static_cast<int>(legs_.size());
  const Ticks waiting = departure - parent.t + (last ? 0 : patience(child));
  const Ticks service = child.arrives ? legs_[static_cast<std::size_t>(parent.leg)].service : 0;
  child.cost =
      parent.cost + child.step +
      (s_.objective_.time ? waiting + service : s_.objective_.waiting * waiting / kTicksPerSecond);
}

void TourRun::push(const Node& child) {
  const double f = priority(child);
  if (!std::isfinite(f) || !is_useful(child)) return;
  const auto index = static_cast<std::int32_t>(nodes_.size());
  nodes_.push_back(child);
  open_.push_back({f, index});
  std::push_heap(open_.begin(), open_.end());
  if (child.driven) arrive(index);
}

// Whether a node may still lead to a way that costs little enough. The estimate is that of its
// cell, so that a little is given back.
bool TourRun::is_useful(const Node& node) {
  if (node.cost >= q_.below) return false;
  if (q_.below == std::numeric_limits<double>::infinity()) return true;
  const auto leg = static_cast<std::size_t>(node.leg);
  if (leg >= legs_.size()) return true;
  const double here = estimate(node.leg, node.x, node.y, theta(node), table_.speed(node.mode));
  return node.cost + kCertain * (here + tail_[leg]) < q_.below;
}

// Remember the best complete way.
void TourRun::arrive(std::int32_t index) {
  const Node& node = nodes_[static_cast<std::size_t>(index)];
  if (!node.arrives || node.leg < static_cast<int>(legs_.size())) return;
  if (best_ == kNone || node.cost < nodes_[static_cast<std::size_t>(best_)].cost) best_ = index;
  // Nothing can come to rest before the pose is free for good: good enough, no longer a search.
  const Ticks arrival = node.t - dwell(node);
  if (s_.objective_.time && !q_.penalty && earliest_rest_ > q_.ready &&
      q_.below == std::numeric_limits<double>::infinity() &&
      arrival - earliest_rest_ <= 1000 + (earliest_rest_ - q_.ready) / 10) {
    found_ = best_;
  }
}

// Drive a node's own edge again, to arrive once whoever is met at its end has left. When that is,
// is found out if the node comes up.
void TourRun::retry(const Node& node, Ticks met) {
  if (node.parent == kNone || !q_.traffic) return;
  const Node& parent = nodes_[static_cast<std::size_t>(node.parent)];
  const bool can_wait = parent.mode < 0 || table_.rest[static_cast<std::size_t>(parent.mode)];
  if (!can_wait || (!s_.objective_.time && q_.penalty && node.hits != parent.hits)) return;
  Node child = node;
  const Ticks departure = node.departure + patience(node) + std::max(1, met - node.t);
  if (departure > parent.end) return;
  child.hits = parent.hits;
  child.driven = false;
  child.delays = 0;
  child.after = met;
  depart(child, departure);
  push(child);
}

// Whether nothing that stands is in the way of a node's edge.
bool TourRun::passable(const Node& node) const {
  const Node& parent = nodes_[static_cast<std::size_t>(node.parent)];
  const Leg& leg = legs_[static_cast<std::size_t>(parent.leg)];
  const Statics& around = statics(parent.leg);
  const HeadingTable& headings = *headings_[static_cast<std::size_t>(parent.leg)];
  if (static_cast<std::size_t>(node.edge) < primitive_steps_.size() &&
      headings.surely_clear(around, leg.body, parent.x, parent.y, parent.k,
                            static_cast<std::size_t>(node.edge), leg.required)) {
    return true;
  }
  const Drive edge = edge_of(node.edge);
  Frame at = frame(parent);
  for (std::size_t i = 0; i < edge.size; ++i) {
    const Step& step = edge.steps[i];
    if (step.mode < 0) continue;
    if (!around.clear(body(parent.leg), at, step.twist, leg.required, step_slack(leg.required))) {
      return false;
    }
    if (i + 1 < edge.size) at = moved(at, step.twist);
  }
  return true;
}

// When the place of a node is free again. All who come to its cell ask the same.
Ticks TourRun::next_free(const Node& node) {
  Interval* seen = node.hits == kNobody
                       ? cells_.meeting(node.x, node.y, node.k, node.leg, node.mode, node.after)
                       : nullptr;
  if (seen && seen->free >= 0) return seen->free;
  const Ticks free = meet_.next_free(body(body_leg(node.leg)), frame(node), node.after, node.hits);
  if (seen) seen->free = free;
  return free;
}

// Check a node's edge, now that it is the best there is. True: the node stands as it was pushed;
// false: it is gone, or pushed again for what it really costs.
bool TourRun::drive(std::int32_t index) {
  Node child = nodes_[static_cast<std::size_t>(index)];
  const bool first = child.delays == 0 && child.after == kNever;
  if (child.after != kNever) {
    const Node& parent = nodes_[static_cast<std::size_t>(child.parent)];
    const Ticks clear = next_free(child);
    const Ticks later = clear < kNever ? child.departure + clear - child.after : kNever;
    child.after = kNever;
    if (later >= kNever || later > parent.end) return false;
    if (later > child.departure) {
      child.delays = 1;
      depart(child, later);
      push(child);
      return false;
    }
  }
  if (first) {
    const Interval* seen =
        cells_.covering(child.x, child.y, child.k, child.leg, child.mode, child.t, child.cost, 0);
    if (seen && seen->end >= kNever) return false;
    if (!passable(child)) return false;
    if (q_.penalty) {
      const std::size_t before = meet_.size();
      Node paying = child;
      if (pay(paying)) {
        if (meet_.size() == before) {
          nodes_[static_cast<std::size_t>(index)] = paying;
          arrive(index);
          return true;
        }
        push(paying);
      }
    }
  }
  if (launch(child)) {
    nodes_[static_cast<std::size_t>(index)] = child;
    arrive(index);
    return true;
  }
  if (child.departure < kNever) push(child);
  return false;
}

void TourRun::expand(std::int32_t index) {
  const Node node = nodes_[static_cast<std::size_t>(index)];
  const HeadingTable& headings = *headings_[static_cast<std::size_t>(node.leg)];
  const Statics& around = statics(node.leg);
  const double loss = around.loss();
  const Ticks leaving = set_out(node);
  const double core =
      body(node.leg).inradius() + legs_[static_cast<std::size_t>(node.leg)].required;
  for (std::size_t i = 0; i < table_.primitives.size(); ++i) {
    const Primitive& p = table_.primitives[i];
    const bool switching = node.mode >= 0 && table_.moving(p.mode) != table_.moving(node.mode);
    if (!p.may_follow(node.mode)) continue;
    const HeadingTable::Landing& landing = headings.landing(node.k, i);
    Node child{};
    child.x = node.x + landing.dx;
    child.y = node.y + landing.dy;
    child.k = static_cast<std::int16_t>(landing.k);
    child.leg = node.leg;
    child.mode = static_cast<std::int16_t>(p.mode);
    child.parent = index;
    child.hits = node.hits;
    child.edge = static_cast<std::int32_t>(i);
    child.after = kNever;
    child.step = objective_of(table_, s_.objective_, primitive_steps_[i]);
    if (switching && !s_.objective_.time) child.step += table_.switch_cost(s_.objective_);
    depart(child, leaving + (switching ? table_.switch_duration : 0));
    const Interval* seen =
        cells_.covering(child.x, child.y, child.k, child.leg, child.mode, child.t, child.cost, 0);
    if (seen && seen->end >= kNever) continue;
    // Where not even the disc in the body has room, nothing need be driven.
    if (around.clearance(child.x, child.y) + loss < core) continue;
    push(child);
  }
}

// Which of the leg's goals to shoot for: where the robot can come to rest soonest.
std::size_t TourRun::aim(const Node& node) {
  const std::vector<Goal>& goals = goals_[static_cast<std::size_t>(node.leg)];
  if (goals.size() == 1) return 0;
  const double unit = s_.objective_.time ? 1.0 : kTicksPerSecond / table_.top_speed;
  std::size_t best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < goals.size(); ++i) {
    const double ticks =
        unit * estimate(node.leg, i, node.x, node.y, theta(node), table_.speed(node.mode));
    const double rest = std::max(ticks, static_cast<double>(goals[i].free - node.t));
    if (rest < least) {
      least = rest;
      best = i;
    }
  }
  return best;
}

void TourRun::shoot(std::int32_t index) {
  const Node node = nodes_[static_cast<std::size_t>(index)];
  const std::size_t aimed = aim(node);
  const Goal& goal = goals_[static_cast<std::size_t>(node.leg)][aimed];
  double distance = length(Point{node.x, node.y} - Point{goal.pose.x, goal.pose.y});
  if (goal.distance) {
    distance = std::max(distance, static_cast<double>((*goal.distance)(node.x, node.y)));
  }
  since_shot_ += 1.0;
  if (since_shot_ < 1.0 + distance && !node.arrives) return;  // a new leg tries at once
  since_shot_ = 0.0;
  const Pose from{node.x, node.y, theta(node)};
  const Ticks leaving = set_out(node);
  connect(table_, s_.objective_, from, goal.pose, s_.params_.shot_words, tried_, node.mode);
  for (Shot& shot : tried_) {
    Node child{};
    child.x = goal.pose.x;
    child.y = goal.pose.y;
    child.goal = static_cast<std::int16_t>(aimed);
    child.leg = static_cast<std::int16_t>(node.leg + 1);
    child.k = static_cast<std::int16_t>(
        headings_[static_cast<std::size_t>(child.leg)]->index(goal.pose.theta));
    child.parent = index;
    child.hits = node.hits;
    child.arrives = true;
    child.mode = static_cast<std::int16_t>(shot.steps.empty() ? node.mode : shot.steps.back().mode);
    Ticks pause = 0;
    child.step = shot.cost;
    if (!shot.steps.empty() && node.mode >= 0 &&
        shot.steps.front().mode != table_.moving(node.mode)) {
      pause = table_.switch_duration;
      if (!s_.objective_.time) child.step += table_.switch_cost(s_.objective_);
    }
    child.edge = static_cast<std::int32_t>(primitive_steps_.size() + shots_.size());
    child.after = kNever;
    shots_.push_back(std::move(shot));
    depart(child, leaving + pause);
    if (q_.penalty) {
      // What soft search has in hand when its effort ends counts.
      if (!passable(child)) continue;
      const std::size_t before = meet_.size();
      Node paying = child;
      if (pay(paying)) push(paying);
      if (meet_.size() == before) continue;
      child.delays = 1;
    } else if (earliest_rest_ > q_.ready && child.leg == static_cast<int>(legs_.size())) {
      // All else is worth as much until the final pose is free for good: try at once.
      if (!passable(child)) continue;
      while (!launch(child) && child.departure < kNever) continue;
      if (!child.driven) continue;
    }
    push(child);
  }
}

TourResult TourRun::run(std::int64_t limit, Budget& budget) {
  TourResult result;
  prepare();
  if (hopeless_) return result;
  Node start{};
  start.x = q_.start.x;
  start.y = q_.start.y;
  start.t = q_.ready;
  start.parent = kNone;
  start.hits = kNone;
  start.edge = kNone;
  start.driven = true;
  start.mode = static_cast<std::int16_t>(q_.mode);
  start.k = static_cast<std::int16_t>(headings_[0]->index(q_.start.theta));
  nodes_.push_back(start);
  open_.push_back({0.0, 0});
  bool by_mode = table_.switch_duration > 0 || !s_.objective_.time;
  for (const Primitive& p : table_.primitives) by_mode = by_mode || p.from != ~0ULL;
  for (const bool may_wait : table_.rest) by_mode = by_mode || !may_wait;
  cells_.distinguish_modes(by_mode);
  if (legs_.size() >= Cells::kMostLegs || table_.headings > Cells::kMostHeadings ||
      (by_mode && table_.rest.size() >= Cells::kMostModes)) {
    throw std::invalid_argument("a search takes fewer than 16384 legs, 63 modes and 257 headings");
  }
  const int num_legs = static_cast<int>(legs_.size());
  std::int64_t spent = 0;
  while (!open_.empty() && found_ == kNone) {
    std::pop_heap(open_.begin(), open_.end());
    const std::int32_t index = open_.back().node;
    open_.pop_back();
    if (!nodes_[static_cast<std::size_t>(index)].driven && !drive(index)) continue;
    const Node node = nodes_[static_cast<std::size_t>(index)];
    if (node.leg == num_legs) {
      found_ = index;
      break;
    }
    const Body& standing = body(node.leg);
    const Frame at = frame(node);
    if (const Interval* seen =
            cells_.covering(node.x, node.y, node.k, node.leg, node.mode, node.t, node.cost, 0)) {
      if (seen->end < kNever) retry(node, seen->met);
      continue;
    }
    result.is_full = static_cast<std::int64_t>(nodes_.size()) >= s_.params_.most_nodes;
    if (result.is_full || !budget.spend() || ++spent > limit) {
      result.outcome = TourResult::Outcome::kStopped;
      if (best_ == kNone || !q_.penalty) return result;
      TourResult best = extract(best_);
      best.is_full = result.is_full;
      return best;
    }
    const bool can_wait = node.mode < 0 || table_.rest[static_cast<std::size_t>(node.mode)];
    Ticks met = node.t + 1;
    const Ticks end = meet_.safe_until(standing, at, node.t, node.hits, &met);
    nodes_[static_cast<std::size_t>(index)].end = can_wait ? end : node.t;
    // At speed the first to come counts as well: who has to wait does so in a state at rest.
    cells_.add(node.x, node.y, node.k, node.leg, node.mode, {node.t, end, node.cost, met});
    if (q_.trace) q_.trace->push_back({{node.x, node.y, theta(node)}, node.t, end, node.leg});
    shoot(index);
    expand(index);
    if (spent >= next_greed_) grow_greedy();
    const auto leg = static_cast<std::size_t>(node.leg);
    if (!goals_[leg].front().distance &&
        ++spent_on_[leg] > worth_a_distance(statics(node.leg), standing.inradius())) {
      learn_distance(node.leg);
    }
    if (end < kNever) retry(node, met);
  }
  return found_ == kNone ? result : extract(found_);
}

TourResult TourRun::extract(std::int32_t goal) {
  TourResult result;
  result.outcome = TourResult::Outcome::kFound;
  for (std::int32_t h = nodes_[static_cast<std::size_t>(goal)].hits; h != kNone;
       h = meet_.next(h)) {
    result.hits.push_back(meet_.track(h));
  }
  std::vector<std::int32_t> chain;
  for (std::int32_t i = goal; i != kNone; i = nodes_[static_cast<std::size_t>(i)].parent) {
    chain.push_back(i);
  }
  std::reverse(chain.begin(), chain.end());
  Pose at = q_.start;
  Ticks t = q_.ready;
  int carried = legs_.front().body;
  const auto stand = [&](Ticks until) {
    if (until > t) result.pieces.push_back({t, until, at, {}, -1, carried});
    t = std::max(t, until);
  };
  for (std::size_t i = 1; i < chain.size(); ++i) {
    const Node& node = nodes_[static_cast<std::size_t>(chain[i])];
    const Drive edge = edge_of(node.edge);
    const int leg = node.arrives ? node.leg - 1 : node.leg;
    carried = legs_[static_cast<std::size_t>(leg)].body;
    stand(node.departure);
    for (std::size_t k = 0; k < edge.size; ++k) {
      const Step& step = edge.steps[k];
      join(result.pieces, {t, t + step.duration, at, step.twist, step.mode, carried});
      at = moved(at, step.twist);
      at.theta = wrap(at.theta);
      t += step.duration;
    }
    if (node.arrives) {
      const Goal& reached =
          goals_[static_cast<std::size_t>(leg)][static_cast<std::size_t>(node.goal)];
      at = reached.pose;
      result.goal = reached.number;
      result.arrival = t;
      stand(t + patience(node));
      result.stops.push_back({leg, t, t + legs_[static_cast<std::size_t>(leg)].service});
      stand(result.stops.back().leave);
    }
  }
  // From now on it stands with this body.
  result.pieces.push_back({t, t + 1, at, {}, -1, q_.rest_body});
  result.cost = nodes_[static_cast<std::size_t>(goal)].cost;
  return result;
}

TourResult TourSearch::operator()(const TourQuery& query, std::int64_t limit, Budget& budget) {
  make_room();
  TourRun run(*this, query);
  return run.run(limit, budget);
}

TourSearch::TourSearch(const SearchParams& params, const Objective& objective)
    : params_(params), objective_(objective), memory_(std::make_unique<TourMemory>()) {}

TourSearch::~TourSearch() = default;

const GoalDistance* TourSearch::goal_distance(const Statics& statics, double radius,
                                              const Pose& goal, bool make) {
  const auto key = std::make_tuple(&statics, radius, goal.x, goal.y);
  const auto found = goal_distances_.find(key);
  if (found != goal_distances_.end()) return &found->second;
  if (!make) return nullptr;
  const GoalDistance& made =
      goal_distances_.emplace(key, GoalDistance(statics, radius, goal.x, goal.y, goal_cell(radius)))
          .first->second;
  num_cells_ += made.num_cells();
  return &made;
}

void TourSearch::make_room() {
  if (num_cells_ <= params_.most_cells) return;
  goal_distances_.clear();
  num_cells_ = 0;
}

const HeadingTable& TourSearch::heading_table(const Model& model, bool fine, double theta) {
  const MotionTable& table = fine ? model.fine : model.table;
  const double step = kTau / table.headings;
  const double base = theta - step * std::floor(theta / step + 1e-9);
  const auto key = std::make_tuple(&model, fine, std::lround(base * 1e9));
  const auto found = heading_tables_.find(key);
  if (found != heading_tables_.end()) return found->second;
  return heading_tables_.emplace(key, HeadingTable(table, model.bodies, base)).first->second;
}

ConnectTable& TourSearch::connect_table(const Model& model, bool fine) {
  const auto key = std::make_tuple(&model, fine);
  const auto found = connect_tables_.find(key);
  if (found != connect_tables_.end()) return found->second;
  return connect_tables_.emplace(key, ConnectTable(fine ? model.fine : model.table, objective_))
      .first->second;
}

}  // namespace clearway
