// Large-neighbourhood search: plans a few robots of a complete plan anew, keeps what is better.
#pragma once

#include <random>
#include <vector>

#include "clearway/multi/prioritised.hpp"

namespace clearway {

// The plan in the team stays complete and free of conflict at every moment.
// Source: J. Li, Z. Chen, D. Harabor, P. J. Stuckey, S. Koenig, "Anytime multi-agent path finding
// via large neighborhood search", IJCAI 2021. Ours picks blockers by each robot's lone way.
class NeighbourhoodSearch {
 public:
  NeighbourhoodSearch(Team& team, const TeamParams& params, const Progress& progress);

  // Improve until the effort is used up or nobody can come any earlier; counts into `result`.
  void operator()(std::uint32_t seed, Budget& budget, TeamResult& result);

 private:
  struct Value {
    std::int64_t first, second;  // what the aim counts, then the other
    bool operator<(const Value& v) const {
      return first != v.first ? first < v.first : second < v.second;
    }
  };

  std::int64_t price(const TourResult& tour) const;
  std::int64_t bound(std::size_t i) const;
  Value value() const;
  void learn_lone_way(std::size_t i, Budget& budget);
  std::size_t pick_late();
  void add_blockers(std::size_t i, std::size_t most, std::vector<std::size_t>& chosen) const;
  void add_near(std::size_t i, std::size_t most, std::vector<std::size_t>& chosen);
  bool replan(const std::vector<std::size_t>& chosen, Budget& budget);

  Team& team_;
  const TeamParams& params_;
  const Progress& progress_;
  std::mt19937 random_;
  std::vector<std::size_t> plannable_;
  std::vector<std::int64_t> least_;  // what each costs alone, as far as is known
  std::vector<double> weight_;       // of each robot being picked: less after each failure
  std::vector<std::shared_ptr<const Track>> lone_;  // way with nobody else on the site
};

// A first complete plan, then better ones until the effort is used up. Without a limit to the
// effort the first one is the answer.
TeamResult plan_team(const std::vector<Model>& models, std::vector<Agent> agents,
                     const TeamParams& params, std::uint32_t seed, Budget& budget,
                     const Progress& progress);

std::int64_t sum_of_arrivals(const Team& team);

}  // namespace clearway
