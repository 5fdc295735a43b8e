#include "clearway/multi/team.hpp"

#include <doctest/doctest.h>

#include <tuple>

#include "teams.hpp"

using namespace clearway;
using namespace scenes;

namespace {

// Who is where and when, tile by tile, in an order of its own.
std::vector<std::tuple<double, double, int, Ticks, Ticks>> marks(const Traffic& traffic) {
  std::vector<std::tuple<double, double, int, Ticks, Ticks>> out;
  for (double x = 1.25; x < 20.0; x += 2.5) {
    for (double y = 1.25; y < 12.0; y += 2.5) {
      for (const Traffic::Presence& who : traffic.near(x, y)) {
        out.emplace_back(x, y, who.track, who.begin, who.end);
      }
    }
  }
  std::sort(out.begin(), out.end());
  return out;
}

Team made(const Setting& t) {
  return Team(t.models, t.agents, t.params.search, t.params.objective, t.params.margin);
}

TourResult straight(const Pose& start, double metres) {
  TourResult tour;
  const auto arrival = static_cast<Ticks>(1000.0 * metres);
  tour.pieces = {drive(0, arrival, start, {metres, 0, 0})};
  tour.arrival = arrival;
  return tour;
}

Setting row_of(int robots) {
  Setting t = team(hall(20, 12));
  for (int i = 0; i < robots; ++i) {
    const double y = 1.5 + 1.5 * i;
    t.add({2, y, 0}, {to({12, y, 0})});
  }
  return t;
}

}  // namespace

TEST_CASE("Who is taken out and put back has left no trace") {
  Setting t = row_of(5);
  Team planned = made(t);
  for (std::size_t i = 0; i < 5; ++i) {
    planned.insert(i, planned.place(i, straight(t.agents[i].start, 10.0)));
  }
  const auto before = marks(planned.traffic());
  const auto track = planned.track(2);
  CHECK(planned.num_planned() == 5);
  Team::Place third = planned.remove(2), fifth = planned.remove(4);
  CHECK(planned.num_planned() == 3);
  CHECK(!planned.planned(2));
  CHECK(!planned.traffic().has(2));
  CHECK(planned.tour(2).pieces.empty());
  CHECK(!planned.track(2));
  planned.insert(2, planned.place(2, straight(t.agents[2].start, 4.0)));
  CHECK(marks(planned.traffic()) != before);
  planned.remove(2);
  planned.insert(4, std::move(fifth));
  planned.insert(2, std::move(third));
  CHECK(marks(planned.traffic()) == before);
  CHECK(planned.num_planned() == 5);
  CHECK(planned.track(2) == track);
  CHECK(planned.tour(2).arrival == 10000);
}

TEST_CASE("A robot that is held is gone from where it stood once it is let go") {
  Setting t = row_of(3);
  t.agents[1].ready = 4000;
  Team planned = made(t);
  planned.insert(0, planned.place(0, straight(t.agents[0].start, 10.0)));
  const auto before = marks(planned.traffic());
  planned.hold(2, 0);  // ready at once, and asked to stand no longer
  CHECK(marks(planned.traffic()) == before);
  planned.hold(1, 9000);
  // Robot 1 of 3 stands as track 3 + 1 while it is asked to, and as 6 + 1 until it is ready.
  CHECK(planned.traffic().has(4));
  CHECK(planned.traffic().has(7));
  CHECK(!planned.traffic().has(1));
  for (const Traffic::Presence& who : planned.traffic().near(2, 3)) {
    if (who.track == 4) CHECK(who.end == 9000);
    if (who.track == 7) CHECK(who.end == 4000);
  }
  planned.release(1);
  planned.release(2);
  CHECK(marks(planned.traffic()) == before);
  CHECK(planned.num_planned() == 1);
}

TEST_CASE("A place begins with what is committed, and a question where that ends") {
  Setting t = row_of(1);
  t.agents[0].committed = {drive(0, 3000, {2, 1.5, 0}, {0, 0, kPi / 2}),
                           drive(3000, 5000, {2, 1.5, kPi / 2}, {2, 0, 0})};
  t.agents[0].ready = 4000;
  const Team planned = made(t);
  const TourQuery query = planned.query(0, nullptr);
  CHECK(query.start.x == doctest::Approx(2.0));
  CHECK(query.start.y == doctest::Approx(3.5));
  CHECK(query.start.theta == doctest::Approx(kPi / 2));
  CHECK(query.ready == 5000);  // not before the commitment ends
  TourResult tour;
  tour.pieces = {drive(5000, 6000, {2, 3.5, kPi / 2}, {1, 0, 0})};
  const Team::Place place = planned.place(0, tour);
  CHECK(place.track->settled() == 6000);
  CHECK(place.track->at(0).frame.y == doctest::Approx(1.5));
  CHECK(place.track->at(4000).frame.y == doctest::Approx(2.5));
  CHECK(place.track->at(6000).frame.y == doctest::Approx(4.5));
}

TEST_CASE("Robots keep the larger clearance, or the margin where there is none") {
  Setting t = row_of(3);
  t.models.push_back(rover(rectangle(1.0, 0.6), hall(20, 12), 0.25));
  t.agents[2].model = 1;
  const Team planned = made(t);
  CHECK(planned.required(0)[1] == doctest::Approx(0.01));
  CHECK(planned.required(0)[2] == doctest::Approx(0.25));
  CHECK(planned.required(2)[1] == doctest::Approx(0.25));
  // Those that are only held are kept off as much: tracks 3 to 5 and 6 to 8 of three robots.
  for (std::size_t i = 0; i < 3; ++i) {
    REQUIRE(planned.required(i).size() == 9);
    for (std::size_t j = 0; j < 9; ++j) CHECK(planned.required(i)[j] == planned.required(i)[j % 3]);
  }
}

TEST_CASE("Poses that are nearer than the clearance make robots content with less") {
  const auto required = [](const Pose& other_start, const Pose& other_goal) {
    Setting t;
    t.models.push_back(rover(rectangle(1.0, 0.6), hall(20, 12), 0.25));
    t.add({2, 3, 0}, {to({12, 3, 0})});
    t.add(other_start, {to(other_goal)});
    return made(t).required(0)[1];
  };
  CHECK(required({2, 9, 0}, {12, 9, 0}) == doctest::Approx(0.25));
  // Bodies are 0.6 m wide and 1 m long: centres 0.7 m apart leave 0.1, 0.6 m nothing.
  CHECK(required({2, 3.7, 0}, {12, 9, 0}) == doctest::Approx(0.1));
  CHECK(required({2, 9, 0}, {12, 3.7, 0}) == doctest::Approx(0.1));
  CHECK(required({2, 9, 0}, {12, 2.4, 0}) == doctest::Approx(0.0));
  // One's goal in front of the other's start: 1.05 m leave 0.05.
  CHECK(required({2, 9, 0}, {3.05, 3, 0}) == doctest::Approx(0.05));
  CHECK(required({2, 3.7, 0}, {12, 3.62, 0}) == doctest::Approx(0.02));
  // Half a millimetre of overlap is legal; where one shall go once the other has left, nothing can
  // be learnt from.
  CHECK(required({2, 3.5995, 0}, {12, 9, 0}) == doctest::Approx(-0.0005));
  CHECK(required({2, 9, 0}, {2.5, 3, 0}) == doctest::Approx(0.25));
}

TEST_CASE("A leg keeps from walls what its ends leave") {
  Setting t;
  t.models.push_back(rover(rectangle(1.0, 0.6), hall(20, 12), 0.25));
  t.add({2, 3, 0}, {to({12, 3, 0}), to({12, 0.4, 0}), to({12, 6, 0}), to({3, 6, 0})});
  const Team planned = made(t);
  const auto& legs = planned.agent(0).legs;
  // The second goal is 0.1 m from the lower wall.
  CHECK(legs[0].required == doctest::Approx(0.25));
  CHECK(legs[1].required == doctest::Approx(0.1));
  CHECK(legs[2].required == doctest::Approx(0.1));
  CHECK(legs[3].required == doctest::Approx(0.25));
}

TEST_CASE("An idle robot that carries a load is passed with its load on") {
  // Its body reaches 0.3 m, with the load 1 m; the way straight past it leads 0.9 m beside.
  Setting t;
  t.models.push_back(rover(disc(0.3), hall(20, 12)));
  t.models.back().bodies.at(1) = disc(1.0);
  t.add({10, 6, 0}, {});
  t.agents.back().rest_body = 1;
  t.add({3, 6.9, 0}, {to({17, 6.9, 0})});
  const TeamResult result = t.run();
  REQUIRE(result.status == TeamResult::Status::kSolved);
  double nearest = 1e300;
  for (const TimedPiece& p : result.tours[1].pieces) {
    for (double share = 0.0; share <= 1.0; share += 0.02) {
      const Pose at = moved(p.start, p.twist.part(share));
      nearest = std::min(nearest, std::hypot(at.x - 10.0, at.y - 6.0));
    }
  }
  CHECK(nearest >= 1.3 - 0.001);
}
