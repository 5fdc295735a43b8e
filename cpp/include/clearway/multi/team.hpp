// A team in the making: who is planned so far, and what the others must avoid.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "clearway/search/tour_search.hpp"

namespace clearway {

// A robot of the team. One with `fixed` pieces, or without legs, is not planned but avoided.
struct Agent {
  int model = 0;
  Pose start;
  int mode = -1;
  Ticks ready = 0;  // pieces up to here are committed
  std::vector<TimedPiece> committed;
  std::vector<Leg> legs;
  int rest_body = 0;  // with which it stands after the last leg
  bool fixed = false;
  Ticks bound = 0;  // no motion whatever arrives at the last leg before
};

constexpr double kLegalOverlap = 0.001;  // two poses may touch by this much (m)

// Gap to keep from obstacles on a leg: the clearance, or what its ends leave where that is less.
double leg_gap(const Model& model, int body, const Pose& from, const Pose& to, double margin);

// No traffic yet, where robots of these models drive; `margin`: gap kept at least (m).
Traffic empty_traffic(const std::vector<Model>& models, double margin);

class Team {
 public:
  // `margin`: gap kept where the robots' clearance asks for less (m).
  Team(const std::vector<Model>& models, std::vector<Agent> agents, const SearchParams& search,
       const Objective& objective, double margin);

  // A planned robot: its way and the track that others see.
  struct Place {
    TourResult tour;
    std::shared_ptr<const Track> track;
  };

  std::size_t size() const { return agents_.size(); }
  const Agent& agent(std::size_t i) const { return agents_[i]; }
  const std::vector<Agent>& agents() const { return agents_; }
  const Model& model(std::size_t i) const {
    return models_[static_cast<std::size_t>(agents_[i].model)];
  }
  // With which body it starts, before anything that it is committed to.
  int first_body_number(std::size_t i) const {
    const Agent& agent = agents_[i];
    return agent.legs.empty() ? agent.rest_body : agent.legs.front().body;
  }
  const Body& first_body(std::size_t i) const {
    return model(i).bodies[static_cast<std::size_t>(first_body_number(i))];
  }
  bool plannable(std::size_t i) const { return !agents_[i].fixed && !agents_[i].legs.empty(); }
  bool planned(std::size_t i) const { return planned_[i]; }
  const TourResult& tour(std::size_t i) const { return places_[i].tour; }
  const std::shared_ptr<const Track>& track(std::size_t i) const { return places_[i].track; }
  std::size_t num_planned() const { return num_planned_; }
  // Gap that robot i keeps to each track.
  const std::vector<double>& required(std::size_t i) const { return required_[i]; }
  const Traffic& traffic() const { return traffic_; }
  // No traffic yet, on the same site.
  Traffic empty_traffic() const { return clearway::empty_traffic(models_, margin_); }

  // A finer table is used for this robot from now on, or no longer.
  void refine(std::size_t i, bool fine) { fine_[i] = fine; }
  TourQuery query(std::size_t i, const Traffic* traffic) const;
  TourResult search(const TourQuery& query, std::int64_t limit, Budget& budget) {
    return search_(query, limit, budget);
  }

  Place place(std::size_t i, TourResult tour) const;
  void insert(std::size_t i, Place place);
  Place remove(std::size_t i);

  // Let an unplanned robot do what it is committed to and wait until it is ready; and perhaps
  // stand at its start until `until`, in the eyes of the others.
  void hold(std::size_t i, Ticks until);
  void release(std::size_t i);

 private:
  void require_gaps();
  std::shared_ptr<const Track> make_track(std::size_t i, std::vector<TimedPiece> pieces,
                                          Ticks gone) const;

  const std::vector<Model>& models_;
  std::vector<Agent> agents_;
  double margin_;
  TourSearch search_;
  Traffic traffic_;
  std::vector<std::vector<double>> required_;
  std::vector<Place> places_;
  std::vector<bool> planned_, fine_;
  std::size_t num_planned_ = 0;
};

}  // namespace clearway
