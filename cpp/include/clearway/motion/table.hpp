// A robot's motions as a table: short primitives and analytic connections to exact goals.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "clearway/geometry/pose.hpp"

namespace clearway {

using Ticks = std::int32_t;
constexpr Ticks kNever = 1 << 30;  // later than any time
constexpr double kTicksPerSecond = 1000.0;

inline Ticks to_ticks(double seconds) {
  return static_cast<Ticks>(std::ceil(seconds * kTicksPerSecond - 1e-6));
}

struct Step {
  int mode = 0;
  Twist twist;
  Ticks duration = 0;
  double top = 0.0;  // speed that it may have (m/s), where acceleration is limited
};

// One short motion. `turn_steps` is the change of heading in steps of a full turn / headings.
struct Primitive {
  int mode = 0;  // in which it ends
  Twist twist;
  int turn_steps = 0;
  Ticks duration = 0;
  std::uint64_t from = ~0ULL;  // modes in which it may begin, as bits; the last bit: in none
  std::vector<Step> steps;     // how it is driven; empty: evenly

  bool may_follow(int before) const { return from >> (before & 63) & 1U; }
};

// A mode at a speed: what one moves in, the course within which modes change at speed (each mode
// on the spot has its own), and the speed (m/s); 0 at rest.
struct Pace {
  int moving = 0;
  int course = 0;
  double speed = 0.0;
};

enum class Family { kReedsShepp, kTurnDriveTurn, kSlide, kTranslate };

// How one family of analytic curves is driven: body direction, speeds (m/s, rad/s), modes.
struct Connection {
  Family family = Family::kReedsShepp;
  double direction = 0.0;  // body-frame angle of forward travel: 0, or pi/2 for transverse curves
  double radius = 0.0;     // Reeds-Shepp turning radius (m)
  double forward_speed = 0.0, reverse_speed = 0.0;          // straight; 0 forbids
  double forward_arc_speed = 0.0, reverse_arc_speed = 0.0;  // on arcs
  double yaw_rate = 0.0;                                    // turning on the spot
  int forward = -1, reverse = -1;                           // modes
  int forward_left = -1, forward_right = -1, reverse_left = -1, reverse_right = -1;
  int rotate_left = -1, rotate_right = -1;
  double sideways_speed = 0.0;  // slide: across the body
  int left = -1, right = -1;
  // Translate: in mode `forward` in any body direction, turning before, after or on the way;
  // `reverse_speed` bounds the part of the velocity that goes backwards, 0 forbids any.
};

// Weights of the objective: cost = time_weight * seconds moving + length * (1 or turning) + ...
struct Objective {
  bool time = true;          // minimise arrival; otherwise the weighted length below
  double turning = 2.0;      // factor on length while turning
  double mode_switch = 3.0;  // per change of moving mode (m)
  double waiting = 0.1;      // per second of standing that is not service
};

struct MotionTable {
  int headings = 16;
  double top_speed = 0.0;  // m/s, for heuristics
  std::vector<bool> rest;  // per mode: may the robot wait in it?
  std::vector<Primitive> primitives;
  std::vector<Connection> connections;
  double turn_arm = 0.0;      // turning on the spot costs as an arc of this radius (m)
  Ticks switch_duration = 0;  // standing time of a change of moving mode
  bool has_modes = true;      // whether such a change costs more than its time
  // Where acceleration is limited (m/s^2): what each mode is. Steps are of the modes at rest.
  std::vector<Pace> paces;
  double acceleration = 0.0, deceleration = 0.0;

  bool is_limited() const { return !paces.empty(); }
  double speed(int mode) const {
    return mode < 0 || paces.empty() ? 0.0 : paces[static_cast<std::size_t>(mode)].speed;
  }
  // The mode without its speed.
  int moving(int mode) const {
    return mode < 0 || paces.empty() ? mode : paces[static_cast<std::size_t>(mode)].moving;
  }
  // No way of that length that begins at that speed and ends at rest takes less.
  double least_ticks(double metres, double from_speed) const;
  // By how much it is ahead of who begins at rest.
  double head_start(double from_speed) const {
    return from_speed > 0.0 ? 0.5 * from_speed / acceleration * kTicksPerSecond : 0.0;
  }

  double switch_cost(const Objective& objective) const {
    return has_modes ? objective.mode_switch : 0.0;
  }

  double shortest_step() const;  // of the primitives that travel (m)

  // Longest straight distance between the ends of a step of a primitive or any point on it (m).
  double reach() const;
};

// One analytic way from a pose to another, in drive order.
struct Shot {
  std::vector<Step> steps;
  Ticks duration = 0;
  double cost = 0.0;  // objective value without waiting
};

double objective_of(const MotionTable& table, const Objective& objective, const Step& step);

// The best `count` ways from one pose, and the mode in which one comes there, to another, cheapest
// first. They end at rest.
void connect(const MotionTable& table, const Objective& objective, const Pose& from, const Pose& to,
             std::size_t count, std::vector<Shot>& out, int mode = -1);

}  // namespace clearway
