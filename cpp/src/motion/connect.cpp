#include <algorithm>

#include "clearway/motion/ramp.hpp"
#include "clearway/motion/reeds_shepp.hpp"
#include "clearway/motion/table.hpp"

namespace clearway {

namespace {

constexpr double kNothing = 1e-7;  // shorter segments (m, rad) are left out

// A word or turn with its cost, before its steps are spelled out.
struct Candidate {
  double cost;
  const Connection* connection;
  Word word;                           // Reeds-Shepp; else:
  double turn0, along, across, turn1;  // turn on the spot, drive, slide, turn on the spot
  bool across_first;
  double spread = 0.0;  // turn made evenly while translating
};

void add_turn(const Connection& how, double angle, std::vector<Step>& steps) {
  if (std::abs(angle) < kNothing) return;
  steps.push_back({angle > 0.0 ? how.rotate_left : how.rotate_right,
                   {0.0, 0.0, angle},
                   std::max<Ticks>(1, to_ticks(std::abs(angle) / how.yaw_rate))});
}

void add_drive(const Connection& how, double length, double turn, std::vector<Step>& steps) {
  if (std::abs(length) < kNothing) return;
  const bool ahead = length > 0.0;
  const bool left = (turn > 0.0) == ahead;  // the turn's centre lies on the left
  double speed = ahead ? how.forward_speed : how.reverse_speed;
  int mode = ahead ? how.forward : how.reverse;
  if (turn != 0.0) {
    speed = ahead ? how.forward_arc_speed : how.reverse_arc_speed;
    mode = ahead ? (left ? how.forward_left : how.forward_right)
                 : (left ? how.reverse_left : how.reverse_right);
  }
  steps.push_back({mode,
                   {length * std::cos(how.direction), length * std::sin(how.direction), turn},
                   std::max<Ticks>(1, to_ticks(std::abs(length) / speed)),
                   speed});
}

void add_slide(const Connection& how, double length, std::vector<Step>& steps) {
  if (std::abs(length) < kNothing) return;
  steps.push_back({length > 0.0 ? how.left : how.right,
                   {0.0, length, 0.0},
                   std::max<Ticks>(1, to_ticks(std::abs(length) / how.sideways_speed)),
                   how.sideways_speed});
}

double drive_cost(const Objective& objective, const Connection& how, double length, bool turning) {
  if (std::abs(length) < kNothing) return 0.0;
  const bool ahead = length > 0.0;
  const double speed = turning ? (ahead ? how.forward_arc_speed : how.reverse_arc_speed)
                               : (ahead ? how.forward_speed : how.reverse_speed);
  if (speed <= 0.0) return 1e18;
  if (objective.time) return std::abs(length) / speed * kTicksPerSecond;
  return std::abs(length) * (turning ? objective.turning : 1.0);
}

double turn_cost(const MotionTable& table, const Objective& objective, const Connection& how,
                 double angle) {
  if (objective.time) return std::abs(angle) / how.yaw_rate * kTicksPerSecond;
  return std::abs(angle) * table.turn_arm * objective.turning;
}

double slide_cost(const Objective& objective, const Connection& how, double length) {
  if (!objective.time) return std::abs(length);
  return std::abs(length) / how.sideways_speed * kTicksPerSecond;
}

// Speed in a body direction; 0 where it may not go there.
double translate_speed(const Connection& how, double along, double across) {
  const double backwards = -along / std::hypot(along, across);
  if (backwards < 1e-9) return how.forward_speed;
  return std::min(how.forward_speed, how.reverse_speed / backwards);
}

// Seconds of a translation that turns by `spread` on its way.
double translate_seconds(const Connection& how, double along, double across, double spread) {
  const double speed = translate_speed(how, along, across);
  return std::max(std::hypot(along, across) / speed, std::abs(spread) / how.yaw_rate);
}

void add_translate(const Connection& how, double along, double across, double spread,
                   std::vector<Step>& steps) {
  if (std::hypot(along, across) < kNothing) return;
  const double seconds = translate_seconds(how, along, across, spread);
  steps.push_back({how.forward, {along, across, spread}, std::max<Ticks>(1, to_ticks(seconds))});
}

double translate_cost(const Objective& objective, const Connection& how, double along,
                      double across, double spread) {
  const double length = std::hypot(along, across);
  if (length < kNothing) return 0.0;
  if (translate_speed(how, along, across) <= 0.0) return 1e18;
  if (!objective.time) return length * (spread != 0.0 ? objective.turning : 1.0);
  return translate_seconds(how, along, across, spread) * kTicksPerSecond;
}

// The steps of a candidate, each at its top speed.
void spell(const Candidate& pick, std::vector<Step>& steps) {
  const Connection& how = *pick.connection;
  if (how.family == Family::kReedsShepp) {
    for (std::size_t k = 0; k < static_cast<std::size_t>(pick.word.size); ++k) {
      const double length = pick.word.length[k] * how.radius;
      add_drive(how, length, pick.word.length[k] * static_cast<int>(pick.word.turn[k]), steps);
    }
  } else if (how.family == Family::kTranslate) {
    add_turn(how, pick.turn0, steps);
    add_translate(how, pick.along, pick.across, pick.spread, steps);
    add_turn(how, pick.turn1, steps);
  } else {
    add_turn(how, pick.turn0, steps);
    if (pick.across_first) add_slide(how, pick.across, steps);
    add_drive(how, pick.along, 0.0, steps);
    if (!pick.across_first) add_slide(how, pick.across, steps);
    add_turn(how, pick.turn1, steps);
  }
}

// Put the standing time between unlike modes in, and add everything up.
void add_switches(const MotionTable& table, const Objective& objective, Shot& shot) {
  std::vector<Step> steps;
  for (const Step& step : shot.steps) {
    if (!steps.empty() && step.mode != steps.back().mode) {
      if (!objective.time) {
        shot.cost += table.switch_cost(objective) +
                     objective.waiting * table.switch_duration / kTicksPerSecond;
      }
      if (table.switch_duration > 0) steps.push_back({-1, {}, table.switch_duration});
    }
    shot.cost += objective_of(table, objective, step);
    steps.push_back(step);
  }
  for (const Step& step : steps) shot.duration += step.duration;
  if (objective.time) shot.cost = shot.duration;
  shot.steps = std::move(steps);
}

}  // namespace

double MotionTable::reach() const {
  double most = 0.0;
  for (const Primitive& p : primitives) {
    if (p.steps.empty()) most = std::max(most, p.twist.length());
    for (const Step& step : p.steps) most = std::max(most, step.twist.length());
  }
  return most;
}

double MotionTable::shortest_step() const {
  double least = 0.0;
  for (const Primitive& p : primitives) {
    const double length = p.twist.length();
    if (length > 0.0 && (least == 0.0 || length < least)) least = length;
  }
  return least;
}

double objective_of(const MotionTable& table, const Objective& objective, const Step& step) {
  if (objective.time) return step.duration;
  const double length = step.twist.length();
  if (length == 0.0) return std::abs(step.twist.c) * table.turn_arm * objective.turning;
  return length * (step.twist.c != 0.0 ? objective.turning : 1.0);
}

void connect(const MotionTable& table, const Objective& objective, const Pose& from, const Pose& to,
             std::size_t count, std::vector<Shot>& out, int mode) {
  out.clear();
  constexpr std::size_t kMost = 6;
  Candidate best[kMost];
  std::size_t num_best = 0;
  count = std::min(count, kMost);
  std::vector<Step> steps;
  std::vector<double> speeds;
  const auto offer = [&](const Candidate& c) {
    double cost = c.cost;
    if (cost >= 1e17) return;
    if (num_best == count && cost >= best[num_best - 1].cost) return;
    if (table.is_limited()) {
      steps.clear();
      spell(c, steps);
      if (!speeds_between(table, mode, steps, speeds)) return;
      if (objective.time) cost = seconds_between(table, steps, speeds) * kTicksPerSecond;
      if (num_best == count && cost >= best[num_best - 1].cost) return;
    }
    std::size_t at = num_best < count ? num_best++ : num_best - 1;
    while (at > 0 && best[at - 1].cost > cost) {
      best[at] = best[at - 1];
      --at;
    }
    best[at] = c;
    best[at].cost = cost;
  };
  const Frame start(from);
  const Point local = start.to_local({to.x, to.y});
  const double turn = wrap(to.theta - from.theta);
  const double ct = std::cos(turn), st = std::sin(turn);
  for (const Connection& how : table.connections) {
    if (how.family != Family::kReedsShepp && how.yaw_rate <= 0.0) continue;
    if (how.family == Family::kSlide && how.sideways_speed <= 0.0) continue;
    const double c = std::cos(how.direction), s = std::sin(how.direction);
    // Seen from a frame whose x axis is the direction of travel.
    const double x = c * local.x + s * local.y, y = -s * local.x + c * local.y;
    const double distance = std::hypot(x, y);
    if (how.family == Family::kReedsShepp) {
      reeds_shepp_words(x / how.radius, y / how.radius, turn, [&](const Word& word) {
        double cost = 0.0;
        for (std::size_t i = 0; i < static_cast<std::size_t>(word.size); ++i) {
          cost += drive_cost(objective, how, word.length[i] * how.radius,
                             word.turn[i] != Turn::kStraight);
        }
        offer({cost, &how, word, 0.0, 0.0, 0.0, 0.0, false});
      });
    } else if (how.family == Family::kTranslate) {
      // The same way on the floor, seen before the turn and after it.
      const double turning = turn_cost(table, objective, how, turn);
      const double before = translate_cost(objective, how, local.x, local.y, 0.0);
      offer({before + turning, &how, {}, 0.0, local.x, local.y, turn, false});
      double along = ct * local.x + st * local.y, across = -st * local.x + ct * local.y;
      const double after = translate_cost(objective, how, along, across, 0.0);
      offer({turning + after, &how, {}, turn, along, across, 0.0, false});
      if (distance > kNothing && std::abs(turn) > kNothing) {
        // The constant twist that ends there: the logarithm of the pose.
        const double half = 0.5 * turn, stretch = half * std::cos(half) / std::sin(half);
        along = stretch * local.x + half * local.y;
        across = -half * local.x + stretch * local.y;
        const double both = translate_cost(objective, how, along, across, turn);
        offer({both, &how, {}, 0.0, along, across, 0.0, false, turn});
      }
    } else if (how.family == Family::kSlide) {
      const double along = ct * x + st * y, across = -st * x + ct * y;
      const double cost = turn_cost(table, objective, how, turn) +
                          drive_cost(objective, how, along, false) +
                          slide_cost(objective, how, across);
      for (const bool across_first : {false, true}) {
        offer({cost, &how, {}, turn, along, across, 0.0, across_first});
      }
    } else {
      const double bearing = distance > kNothing ? std::atan2(y, x) : 0.0;
      for (const double way : {1.0, -1.0}) {
        const double turn0 = wrap(way > 0.0 ? bearing : bearing + std::numbers::pi);
        const double turn1 = wrap(turn - turn0);
        const double cost = turn_cost(table, objective, how, turn0) +
                            drive_cost(objective, how, way * distance, false) +
                            turn_cost(table, objective, how, turn1);
        offer({cost, &how, {}, turn0, way * distance, 0.0, turn1, false});
      }
    }
  }
  for (std::size_t i = 0; i < num_best; ++i) {
    Shot shot;
    spell(best[i], shot.steps);
    if (table.is_limited()) {
      speeds_between(table, mode, shot.steps, speeds);
      shot.steps = cut_between(table, shot.steps, speeds);
    }
    add_switches(table, objective, shot);
    out.push_back(std::move(shot));
  }
}

}  // namespace clearway
