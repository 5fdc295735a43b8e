#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "bind.hpp"
#include "clearway/motion/ramp.hpp"
#include "clearway/motion/reeds_shepp.hpp"
#include "clearway/motion/table.hpp"

namespace nb = nanobind;
using namespace nb::literals;

namespace clearway::bindings {

void bind_motion(nb::module_& m) {
  m.attr("NEVER") = kNever;
  m.def("reeds_shepp_length", &reeds_shepp_length, "x"_a, "y"_a, "phi"_a,
        "Length of the shortest Reeds-Shepp curve from the origin, turning radius 1.");
  m.def(
      "reeds_shepp_word",
      [](double x, double y, double phi) {
        const Word word = reeds_shepp_shortest(x, y, phi);
        std::vector<std::pair<int, double>> out;
        for (std::size_t i = 0; i < static_cast<std::size_t>(word.size); ++i) {
          out.emplace_back(static_cast<int>(word.turn[i]), word.length[i]);
        }
        return out;
      },
      "x"_a, "y"_a, "phi"_a,
      "Segments of that curve: (1 left, 0 straight, -1 right; signed length).");

  nb::enum_<Family>(m, "Family", "Families of analytic connections.")
      .value("REEDS_SHEPP", Family::kReedsShepp)
      .value("TURN_DRIVE_TURN", Family::kTurnDriveTurn)
      .value("SLIDE", Family::kSlide)
      .value("TRANSLATE", Family::kTranslate);
  nb::class_<Step>(m, "Step", "One part of a connection or of a primitive.")
      .def(
          "__init__",
          [](Step* self, int mode, const Twist& twist, Ticks duration) {
            new (self) Step{mode, twist, duration};
          },
          "mode"_a, "twist"_a, "duration"_a)
      .def_ro("mode", &Step::mode)
      .def_ro("twist", &Step::twist)
      .def_ro("duration", &Step::duration);
  nb::class_<Primitive>(m, "Primitive", "One short motion of a table.")
      .def(
          "__init__",
          [](Primitive* self, int mode, const Twist& twist, int turn_steps, Ticks duration) {
            new (self) Primitive{mode, twist, turn_steps, duration, ~0ULL, {}};
          },
          "mode"_a, "twist"_a, "turn_steps"_a, "duration"_a)
      .def_ro("mode", &Primitive::mode)
      .def_ro("twist", &Primitive::twist)
      .def_ro("turn_steps", &Primitive::turn_steps)
      .def_ro("duration", &Primitive::duration)
      .def_rw("allowed_from", &Primitive::from,
              "Modes in which it may begin, as bits; the last of 64: in none.")
      .def_rw("steps", &Primitive::steps, "How it is driven; empty: evenly.");
  nb::class_<Pace>(m, "Pace", "A mode at a speed.")
      .def(
          "__init__",
          [](Pace* self, int moving, int course, double speed) {
            new (self) Pace{moving, course, speed};
          },
          "moving"_a, "course"_a, "speed"_a)
      .def_ro("moving", &Pace::moving)
      .def_ro("course", &Pace::course)
      .def_ro("speed", &Pace::speed);
  nb::class_<Connection>(m, "Connection", "How one family of analytic curves is driven.")
      .def(nb::init<>())
      .def_rw("family", &Connection::family)
      .def_rw("direction", &Connection::direction)
      .def_rw("radius", &Connection::radius)
      .def_rw("forward_speed", &Connection::forward_speed)
      .def_rw("reverse_speed", &Connection::reverse_speed)
      .def_rw("forward_arc_speed", &Connection::forward_arc_speed)
      .def_rw("reverse_arc_speed", &Connection::reverse_arc_speed)
      .def_rw("yaw_rate", &Connection::yaw_rate)
      .def_rw("forward", &Connection::forward)
      .def_rw("reverse", &Connection::reverse)
      .def_rw("forward_left", &Connection::forward_left)
      .def_rw("forward_right", &Connection::forward_right)
      .def_rw("reverse_left", &Connection::reverse_left)
      .def_rw("reverse_right", &Connection::reverse_right)
      .def_rw("sideways_speed", &Connection::sideways_speed)
      .def_rw("left", &Connection::left)
      .def_rw("right", &Connection::right)
      .def_rw("rotate_left", &Connection::rotate_left)
      .def_rw("rotate_right", &Connection::rotate_right);
  nb::class_<Objective>(m, "Objective", "What a search minimises.")
      .def(nb::init<>())
      .def_rw("time", &Objective::time)
      .def_rw("turning", &Objective::turning)
      .def_rw("mode_switch", &Objective::mode_switch)
      .def_rw("waiting", &Objective::waiting);
  nb::class_<MotionTable>(m, "MotionTable", "A robot's motions as a table.")
      .def(nb::init<>())
      .def_rw("headings", &MotionTable::headings)
      .def_rw("top_speed", &MotionTable::top_speed)
      .def_rw("rest", &MotionTable::rest)
      .def_rw("primitives", &MotionTable::primitives)
      .def_rw("connections", &MotionTable::connections)
      .def_rw("turn_arm", &MotionTable::turn_arm)
      .def_rw("switch_duration", &MotionTable::switch_duration)
      .def_rw("has_modes", &MotionTable::has_modes)
      .def_rw("paces", &MotionTable::paces, "What each mode is, where acceleration is limited.")
      .def_rw("acceleration", &MotionTable::acceleration)
      .def_rw("deceleration", &MotionTable::deceleration);
  m.def(
      "ramp",
      [](double length, double enter, double leave, double top, double up, double down) {
        std::vector<std::pair<double, Ticks>> out;
        if (const auto ramp = Ramp::make(length, enter, leave, top, up, down)) {
          std::vector<Step> steps;
          ramp->cut({0, {length, 0.0, 0.0}, 0}, steps);
          for (const Step& step : steps) out.emplace_back(step.twist.a, step.duration);
        }
        return out;
      },
      "length"_a, "enter"_a, "leave"_a, "top"_a, "acceleration"_a, "deceleration"_a,
      "Steps of even speed (m, ticks) from one speed to another; none where it is too short.");
  m.def(
      "connect",
      [](const MotionTable& table, const Objective& objective, const Pose& from, const Pose& to,
         int mode) {
        std::vector<Shot> shots;
        connect(table, objective, from, to, 1, shots, mode);
        return shots.empty() ? std::vector<Step>{} : shots.front().steps;
      },
      "table"_a, "objective"_a, "start"_a, "goal"_a, "mode"_a = -1,
      "Steps of the best obstacle-free connection between two poses.");
  m.def(
      "connections",
      [](const MotionTable& table, const Objective& objective, const Pose& from, const Pose& to,
         std::size_t count) {
        std::vector<Shot> shots;
        connect(table, objective, from, to, count, shots);
        std::vector<std::vector<Step>> ways;
        for (Shot& shot : shots) ways.push_back(std::move(shot.steps));
        return ways;
      },
      "table"_a, "objective"_a, "start"_a, "goal"_a, "count"_a,
      "Steps of the best obstacle-free connections, at most `count`; mode -1 stands between "
      "modes.");
}

}  // namespace clearway::bindings
