// Planning for ever: everybody has a complete motion to a rest, and one robot's tail is replaced.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "clearway/multi/team.hpp"

namespace clearway {

// A search begins nearly exact and soon grows greedy: most trips are easy, and those that are not
// had better wait near the goal than try all ways round.
struct TailParams {
  SearchParams search{.greed = 0.6, .most_weight = 4.0, .tail_weight = 1.2};
  Objective objective;
  double margin = 0.01;  // gap kept where the robots' clearance asks for less (m)
};

// A new tail that is asked for: where it begins, its legs, and where it may end.
struct TailQuery {
  int robot = 0;
  Ticks now = 0;                 // what is before is forgotten
  std::vector<TimedPiece> kept;  // what the robot does from `now` until it is ready
  Pose start;                    // where it is then
  int mode = -1;                 // and in which mode
  Ticks ready = 0;
  std::vector<Leg> legs;    // to its visits
  std::vector<Pose> rests;  // in one of which it rests in the end; none: at its last visit
  int rest_body = 0;        // with which it rests
  bool fine = false;        // on the finer lattice
  std::int64_t limit = 0;   // expansions
};

struct Tail {
  TourResult tour;  // its last stop is no service but the rest, where rests were given
  int rest = -1;    // which of them
  std::int64_t expansions = 0;
  std::vector<int> met;  // robots that stood against it, the most troublesome first
};

// A robot's place in a meeting: who is met, and where the one who asks is then.
struct TailMeeting {
  int robot = 0;
  Pose at;
};

// Holds everybody's committed motion. All together are free of conflicts for ever as long as only
// `plan` changes them: a motion is complete, ends in a rest, and is replaced in one step.
class TailPlanner {
 public:
  // `models`: of all types; `model_of`: each robot's.
  TailPlanner(std::vector<Model> models, std::vector<int> model_of, const TailParams& params);
  TailPlanner(const TailPlanner&) = delete;
  TailPlanner& operator=(const TailPlanner&) = delete;

  std::size_t size() const { return model_of_.size(); }

  // Say what a robot does from `now` on, unchecked.
  void place(int robot, Ticks now, const Pose& start, std::vector<TimedPiece> pieces, int body);

  // Search for a new tail; found, it is committed to.
  Tail plan(const TailQuery& query, Budget& budget);

  // Likewise with nobody else on the site; never committed to.
  Tail alone(const TailQuery& query, Budget& budget);

  // Whom a robot would meet first if it drove pieces so much earlier; empty if nobody.
  std::vector<TailMeeting> meetings(int robot, const std::vector<TimedPiece>& pieces,
                                    Ticks earlier) const;

  // Last tick from `now` on up to which a robot's motion is known to be clear of what stands, given
  // for each of its bodies; kNever if it is for ever.
  Ticks clear_until(int robot, Ticks now,
                    const std::vector<std::shared_ptr<const Statics>>& statics) const;

  // When a robot comes to its last rest.
  Ticks settled(int robot) const { return track(robot).settled(); }

  // Take over what stands, for each model and body, after obstacles have come.
  void rebuild(const std::vector<std::vector<std::shared_ptr<const Statics>>>& statics);

 private:
  struct Rest {
    Frame at;
    int body;
  };

  const Model& model(int robot) const {
    return models_[static_cast<std::size_t>(model_of_[static_cast<std::size_t>(robot)])];
  }
  const Track& track(int robot) const { return traffic_.track(robot); }
  const Body& body(int robot, int number) const {
    return model(robot).bodies[static_cast<std::size_t>(number)];
  }
  Tail search(const TailQuery& query, const Traffic* traffic, Budget& budget);
  std::vector<Leg> legs_of(const TailQuery& query) const;
  std::vector<Rest> rests_of(const TailQuery& query) const;
  std::vector<double> gaps(int robot, const std::vector<Rest>& rests, Ticks ready) const;

  std::vector<Model> models_;
  std::vector<int> model_of_;
  TailParams params_;
  std::unique_ptr<TourSearch> search_;  // anew when the site changes
  Traffic traffic_;
  std::vector<std::vector<Rest>> rests_;  // where each robot stands in its committed motion
};

}  // namespace clearway
