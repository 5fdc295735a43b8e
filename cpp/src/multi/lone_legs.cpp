#include "clearway/multi/lone_legs.hpp"

#include "clearway/multi/team.hpp"

namespace clearway {

std::vector<Ticks> lone_durations(const Model& model, const SearchParams& params,
                                  const Objective& objective, double margin,
                                  const std::vector<LoneLeg>& legs, std::int64_t limit,
                                  Budget& budget) {
  TourSearch search(params, objective);
  std::vector<Ticks> durations;
  std::vector<Leg> tour(1);
  TourQuery query;
  query.model = &model;
  query.legs = &tour;
  for (const LoneLeg& leg : legs) {
    query.start = leg.from;
    query.rest_body = leg.body;
    tour[0] = {leg.to, 0, leg.body, leg_gap(model, leg.body, leg.from, leg.to, margin)};
    const TourResult found = search(query, limit, budget);
    if (budget.ended) break;
    durations.push_back(found.outcome == TourResult::Outcome::kFound ? found.arrival : -1);
  }
  return durations;
}

}  // namespace clearway
