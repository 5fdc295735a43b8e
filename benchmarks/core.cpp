// Nanoseconds of processor time per operation of the core, one table row each.
//
//   core_benchmarks               all rows
//   core_benchmarks --list        their names
//   core_benchmarks --once NAME   does one row's operations once and prints how many they are

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <ctime>
#include <functional>
#include <string>
#include <vector>

#include "clearway/motion/reeds_shepp.hpp"
#include "clearway/search/encounters.hpp"
#include "clearway/search/geodesic.hpp"
#include "clearway/search/tour_search.hpp"
#include "scenes.hpp"

namespace {

using namespace scenes;

constexpr int kRepeats = 9;
constexpr double kRepeatSeconds = 0.04;
constexpr std::size_t kCases = 1024;

volatile double result;  // so that nothing is optimised away

// Does its operations once; returns how many they are.
using Work = std::function<std::int64_t()>;

struct Row {
  const char* name;
  std::function<Work()> prepare;
};

// Calls `operation(case)` for each case.
template <typename Case, typename Operation>
Work over(std::vector<Case> cases, Operation operation) {
  return [cases = std::move(cases), operation = std::move(operation)]() mutable {
    double sum = 0.0;
    for (const Case& each : cases) sum += static_cast<double>(operation(each));
    result = sum;
    return static_cast<std::int64_t>(cases.size());
  };
}

Obstacles among_discs() {
  Obstacles site = hall(100.0, 100.0);
  Dice dice(1);
  for (int i = 0; i < 50; ++i) {
    site.discs.push_back(
        {dice.between(5.0, 95.0), dice.between(5.0, 95.0), dice.between(0.5, 2.0)});
  }
  return site;
}

// Two columns of shelves between aisles of 4.5 m.
Obstacles among_shelves() {
  Obstacles site = hall(100.0, 60.0);
  for (const double x : {10.0, 55.0}) {
    for (int row = 1; row <= 9; ++row) {
      add_solid(site, box_points(x, 6.0 * row - 0.75, x + 35.0, 6.0 * row + 0.75));
    }
  }
  return site;
}

Body car_body() { return Body({box_points(-1.0, -1.0, 2.0, 1.0)}, 0.0); }

MotionTable car_table_of(int headings = 16) { return car_table(headings, 3.0); }

// The robot with 11 modes, radius 3 m, 2.5 m/s, 0.57 rad/s; mode 0 is standing.
MotionTable four_wheel_table(int headings = 16) {
  MotionTable t;
  t.headings = headings;
  t.top_speed = 2.5;
  t.rest.assign(11, true);
  t.turn_arm = 1.5;
  const double yaw = 0.57, arc = yaw * 3.0, step = kTau / headings, way = 3.0 * step;
  const auto add = [&](int mode, Twist twist, int steps, double seconds) {
    t.primitives.push_back({mode, twist, steps, to_ticks(seconds)});
  };
  add(1, {way, 0.0, 0.0}, 0, way / 2.5);
  add(2, {-way, 0.0, 0.0}, 0, way / 2.5);
  add(3, {way, 0.0, step}, 1, way / arc);
  add(4, {way, 0.0, -step}, -1, way / arc);
  add(5, {-way, 0.0, -step}, -1, way / arc);
  add(6, {-way, 0.0, step}, 1, way / arc);
  add(7, {0.0, way, 0.0}, 0, way / 2.5);
  add(8, {0.0, -way, 0.0}, 0, way / 2.5);
  add(9, {0.0, 0.0, step}, 1, step / yaw);
  add(10, {0.0, 0.0, -step}, -1, step / yaw);
  Connection c;
  c.radius = 3.0;
  c.yaw_rate = yaw;
  c.forward_speed = c.reverse_speed = 2.5;
  c.forward_arc_speed = c.reverse_arc_speed = arc;
  c.forward = 1, c.reverse = 2, c.forward_left = 3, c.forward_right = 4;
  c.reverse_left = 5, c.reverse_right = 6, c.rotate_left = 9, c.rotate_right = 10;
  Connection across = c;
  across.direction = kPi / 2.0;
  across.forward = across.forward_left = across.forward_right = 7;
  across.reverse = across.reverse_left = across.reverse_right = 8;
  for (const Family family : {Family::kReedsShepp, Family::kTurnDriveTurn}) {
    c.family = across.family = family;
    t.connections.push_back(c);
    t.connections.push_back(across);
  }
  c.family = Family::kSlide;
  c.sideways_speed = 2.5;
  c.left = 7, c.right = 8;
  t.connections.push_back(c);
  return t;
}

// Poses at which a body is free, but near enough to something for exact tests.
std::vector<Frame> near_obstacles(const Statics& statics, const Body& body, std::size_t count) {
  Dice dice(2);
  std::vector<Frame> out;
  while (out.size() < count) {
    const Frame at(dice.pose(100.0));
    if (statics.cover_gap(body, at) < 0.2 && statics.gap(body, at) > 0.0) out.push_back(at);
  }
  return out;
}

struct Pair {
  Frame a, b;
};

Work body_gaps(const Body& one, const Body& other) {
  Dice dice(3);
  std::vector<Pair> pairs;
  while (pairs.size() < kCases) {
    pairs.push_back({Frame(dice.pose(4.0)), Frame(dice.pose(4.0))});
  }
  return over(pairs, [=](const Pair& p) { return gap(one, p.a, other, p.b, 2.0); });
}

// Robots that drive about a hall for two minutes, never mind each other.
struct Traffic50 {
  static constexpr double kSize = 60.0;
  static constexpr Ticks kEnd = 120'000;

  std::vector<Body> bodies{car_body(), car_body()};
  MotionTable table = car_table_of();
  Traffic traffic{{0.0, 0.0, kSize, kSize}, bodies[0].circumradius(), table.reach(), 0.1};
  std::vector<double> required = std::vector<double>(50, 0.1);
  std::vector<Pose> poses;
  std::vector<Ticks> times;
  Encounters meet{&traffic, &required};

  Traffic50() {
    Dice dice(4);
    for (int id = 0; id < 50; ++id) {
      const Pose start = dice.pose(kSize);
      Pose at = start;
      std::vector<TimedPiece> pieces;
      for (Ticks t = 0; t < kEnd;) {
        const auto pick = static_cast<std::size_t>(dice.below(3));
        const Primitive& p = table.primitives[pick];
        const Pose next = moved(at, p.twist);
        if (std::min(next.x, next.y) < 0.0 || std::max(next.x, next.y) > kSize) {
          pieces.push_back(wait(t, t + 2000, at));
          t += 2000;
          at.theta = wrap(at.theta + 0.7);  // turns in no time: only the pace matters here
          continue;
        }
        pieces.push_back(drive(t, t + p.duration, at, p.twist));
        t += p.duration;
        at = next;
      }
      traffic.insert(id, std::make_shared<const Track>(&bodies, start, std::move(pieces)));
    }
    for (std::size_t i = 0; i < kCases; ++i) {
      poses.push_back(dice.pose(kSize));
      times.push_back(dice.below(kEnd));
    }
  }
};

std::vector<std::size_t> numbers() {
  std::vector<std::size_t> out(kCases);
  for (std::size_t i = 0; i < kCases; ++i) out[i] = i;
  return out;
}

// Searches with plain A* weights, up to 10 000 expansions each; an operation is an expansion.
Work searches(const Body& body, const Obstacles& site, const MotionTable& table, bool busy) {
  struct State {
    SearchParams params;
    std::shared_ptr<Model> model;
    std::shared_ptr<Traffic50> others;
    std::shared_ptr<TourSearch> search;
    std::vector<std::pair<Pose, std::vector<Leg>>> cases;
  };
  State s;
  s.params.weight = s.params.tail_weight = 1.0;
  s.params.greed = 0.0;
  s.model = std::make_shared<Model>(model_of(body, site, table, table, 0.1));
  s.search = std::make_shared<TourSearch>(s.params, Objective{});
  if (busy) s.others = std::make_shared<Traffic50>();
  Dice dice(5);
  const auto place = [&] {
    while (true) {
      const Pose p{dice.between(2.0, 58.0), dice.between(2.0, 58.0), dice.between(-kPi, kPi)};
      if (s.model->statics[0]->gap(body, Frame(p)) > 0.1) return p;
    }
  };
  while (s.cases.size() < 32) {
    const Pose start = place(), goal = place();
    if (std::hypot(start.x - goal.x, start.y - goal.y) < 30.0) continue;
    Leg leg{goal};
    leg.required = 0.1;
    s.cases.push_back({start, {leg}});
  }
  return [s = std::move(s)] {
    Budget budget;
    for (const auto& [start, legs] : s.cases) {
      TourQuery query;
      query.model = s.model.get();
      query.start = start;
      query.legs = &legs;
      if (s.others) {
        query.traffic = &s.others->traffic;
        query.required = &s.others->required;
      }
      result = (*s.search)(query, 10'000, budget).cost;
    }
    return budget.spent;
  };
}

std::vector<Row> rows() {
  const auto poses = [](double size) {
    Dice dice(6);
    std::vector<Pose> out;
    for (std::size_t i = 0; i < kCases; ++i) out.push_back(dice.pose(size));
    return out;
  };
  const auto on_discs = [] {
    return std::make_shared<Statics>(among_discs(), car_body().circumradius());
  };
  std::vector<Row> all;
  all.push_back({"gap of two rectangles", [] { return body_gaps(car_body(), rectangle(2, 1.2)); }});
  all.push_back(
      {"gap of rectangle and triangle", [] { return body_gaps(car_body(), kite(3, 1.2, 0.2)); }});
  all.push_back(
      {"gap of rectangle and hexagon", [] { return body_gaps(car_body(), kite(6, 1.2, 0.2)); }});
  all.push_back(
      {"gap of disc and hexagon", [] { return body_gaps(disc(0.8), kite(6, 1.2, 0.2)); }});
  all.push_back({"gap of a car near obstacles", [=] {
                   const auto statics = on_discs();
                   const Body car = car_body();
                   return over(near_obstacles(*statics, car, kCases),
                               [=](const Frame& f) { return statics->gap(car, f); });
                 }});
  all.push_back({"drive past obstacles, exact", [=] {
                   const auto statics = on_discs();
                   const Body car = car_body();
                   const Twist arc = car_table_of().primitives[1].twist;
                   return over(near_obstacles(*statics, car, kCases), [=](const Frame& f) {
                     return statics->clear(car, f, arc, 0.0, 0.0008);
                   });
                 }});
  all.push_back({"distance field, made (100 m x 100 m, 50 discs)", [] {
                   return over(std::vector{among_discs()}, [](const Obstacles& site) {
                     return Statics(site, 2.3).clearance(50.0, 50.0);
                   });
                 }});
  all.push_back({"distance field, look-up", [=] {
                   const auto statics = on_discs();
                   return over(poses(100.0),
                               [=](const Pose& p) { return statics->clearance(p.x, p.y); });
                 }});
  all.push_back({"Reeds-Shepp, shortest length", [=] {
                   return over(poses(8.0), [](const Pose& p) {
                     return reeds_shepp_length(p.x - 4.0, p.y - 4.0, p.theta);
                   });
                 }});
  all.push_back({"connection table, look-up", [=] {
                   static const MotionTable table = car_table_of();
                   const auto costs = std::make_shared<ConnectTable>(table, Objective{});
                   return over(poses(20.0), [=](const Pose& p) {
                     return (*costs)(p.x - 10.0, p.y - 10.0, p.theta);
                   });
                 }});
  for (const bool eleven : {false, true}) {
    all.push_back(
        {eleven ? "successor table, made (11 modes)" : "successor table, made (car)", [=] {
           const Body body = eleven ? rectangle(3.0, 2.0) : car_body();
           return over(std::vector{eleven ? four_wheel_table() : car_table_of()},
                       [=](const MotionTable& table) {
                         return HeadingTable(table, {body, body}, 0.3).theta(0);
                       });
         }});
  }
  all.push_back({"successor, landing and covering discs", [=] {
                   const auto statics = on_discs();
                   const MotionTable table = four_wheel_table();
                   const Body body = rectangle(3.0, 2.0);
                   const HeadingTable headings(table, {body}, 0.3);
                   return over(poses(100.0), [=](const Pose& p) {
                     const int k = headings.index(p.theta);
                     const auto primitive = static_cast<std::size_t>(k) % table.primitives.size();
                     const HeadingTable::Landing& to = headings.landing(k, primitive);
                     return to.dx + headings.surely_clear(*statics, 0, p.x, p.y, k, primitive, 0.1);
                   });
                 }});
  all.push_back({"drive among 50 tracks", [] {
                   const auto world = std::make_shared<Traffic50>();
                   const Primitive& p = world->table.primitives[1];
                   const Step step{p.mode, p.twist, p.duration};
                   return over(numbers(), [=](std::size_t i) {
                     int track = 0;
                     return world->meet.conflict(world->bodies[0], Frame(world->poses[i]),
                                                 {&step, 1, step.duration}, world->times[i],
                                                 kNobody, &track);
                   });
                 }});
  all.push_back({"stand among 50 tracks, safe until", [] {
                   const auto world = std::make_shared<Traffic50>();
                   return over(numbers(), [=](std::size_t i) {
                     Ticks met = 0;
                     return world->meet.safe_until(world->bodies[0], Frame(world->poses[i]),
                                                   world->times[i], kNobody, &met);
                   });
                 }});
  all.push_back({"goal distance (100 m x 100 m, cells of 0.5 m)", [=] {
                   const auto statics = on_discs();
                   return over(std::vector{Pose{50.0, 50.0, 0.0}}, [=](const Pose& goal) {
                     return GoalDistance(*statics, 1.0, goal.x, goal.y, 0.5)(3.0, 3.0);
                   });
                 }});
  all.push_back({"geodesic bound, made, with its first query", [] {
                   return over(std::vector{among_shelves()}, [](const Obstacles& site) {
                     return Geodesic(site, 1.0)({3.0, 3.0}, {97.0, 57.0});
                   });
                 }});
  all.push_back({"geodesic bound, query", [=] {
                   const auto way = std::make_shared<Geodesic>(among_shelves(), 1.0);
                   std::vector<Pair> ends;
                   Dice dice(7);
                   for (int i = 0; i < 64; ++i) {
                     const int from = dice.below(10), to = dice.below(10);
                     ends.push_back({Frame({dice.between(5.0, 95.0), 6.0 * from + 3.0, 0.0}),
                                     Frame({dice.between(5.0, 95.0), 6.0 * to + 3.0, 0.0})});
                   }
                   return over(
                       ends, [=](const Pair& p) { return (*way)({p.a.x, p.a.y}, {p.b.x, p.b.y}); });
                 }});
  all.push_back({"expansion, car among discs",
                 [] { return searches(car_body(), among_discs(), car_table_of(), false); }});
  all.push_back({"expansion, car among discs and 50 tracks",
                 [] { return searches(car_body(), among_discs(), car_table_of(), true); }});
  all.push_back({"expansion, 11 modes among shelves", [] {
                   return searches(rectangle(3.0, 2.0), among_shelves(), four_wheel_table(), false);
                 }});
  all.push_back({"expansion, 11 modes among shelves and 50 tracks", [] {
                   return searches(rectangle(3.0, 2.0), among_shelves(), four_wheel_table(), true);
                 }});
  return all;
}

double seconds(const std::function<void()>& work) {
  const std::clock_t begin = std::clock();
  work();
  return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
}

double nanoseconds(const Work& work) {
  work();
  int times = 1;
  const auto repeat = [&] {
    std::int64_t operations = 0;
    const double spent = seconds([&] {
      for (int i = 0; i < times; ++i) operations += work();
    });
    return 1e9 * spent / static_cast<double>(operations);
  };
  while (seconds(repeat) < kRepeatSeconds) times *= 2;
  std::vector<double> measured;
  for (int i = 0; i < kRepeats; ++i) measured.push_back(repeat());
  std::nth_element(measured.begin(), measured.begin() + kRepeats / 2, measured.end());
  return measured[kRepeats / 2];
}

}  // namespace

// The only part whose instructions are counted, found by its name.
extern "C" __attribute__((noinline)) std::int64_t core_benchmarks_once(const Work& work) {
  return work();
}

int main(int argc, char** argv) {
  const std::string what = argc > 1 ? argv[1] : "", name = argc > 2 ? argv[2] : "";
  for (const Row& row : rows()) {
    if (what == "--list") {
      std::printf("%s\n", row.name);
    } else if (what == "--once") {
      if (name != row.name) continue;
      const Work work = row.prepare();
      work();  // tables that are filled on first use are warm
      std::printf("%lld\n", static_cast<long long>(core_benchmarks_once(work)));
    } else {
      const double ns = nanoseconds(row.prepare());
      std::printf("| %s | %.1f | %.0f |\n", row.name, ns, 1e9 / ns);
      std::fflush(stdout);
    }
  }
  return 0;
}
