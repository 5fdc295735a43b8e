#include "clearway/assign/spanning_bound.hpp"

#include <algorithm>
#include <limits>
#include <vector>

namespace clearway::assign {

double spanning_bound(const Costs& costs) {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  constexpr int kSteps = 60;
  const auto n = static_cast<std::size_t>(costs.tasks());
  if (n == 0) return 0.0;
  // Ways within tasks are driven whatever the order: they count apart, which leaves the legs alike
  // in both directions.
  std::vector<double> within(n, kNever), root(n, kNever), edge(n * n, kNever), penalty(n, 0.0);
  double apart = 0.0;
  for (std::size_t j = 0; j < n; ++j) {
    for (int k = 0; k < costs.robots(); ++k) {
      const int task = static_cast<int>(j);
      if (!costs.allowed(k, task)) continue;
      within[j] = std::min(within[j], costs.weights().total * costs.inner(k, task));
      root[j] = std::min(root[j], costs.start(k, task).price);
    }
    root[j] -= within[j];
    apart += within[j];
  }
  for (int kind = 0; kind < costs.kinds(); ++kind) {
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j) {
        if (i == j) continue;
        const double price = costs.out_of(kind, static_cast<int>(i))[j].price - within[j];
        edge[i * n + j] = std::min(edge[i * n + j], price);
        edge[j * n + i] = std::min(edge[j * n + i], price);
      }
    }
  }
  std::vector<double> least(n);
  std::vector<std::size_t> parent(n);
  std::vector<int> degree(n);
  std::vector<bool> in(n);
  double best = 0.0, step = 0.0;
  for (int round = 0; round < kSteps; ++round) {
    double tree = 0.0;
    std::fill(in.begin(), in.end(), false);
    std::fill(degree.begin(), degree.end(), 0);
    for (std::size_t j = 0; j < n; ++j) {
      least[j] = root[j] + penalty[j];
      parent[j] = n;
      tree -= 2.0 * penalty[j];
    }
    for (std::size_t added = 0; added < n; ++added) {
      std::size_t next = n;
      for (std::size_t j = 0; j < n; ++j) {
        if (!in[j] && (next == n || least[j] < least[next])) next = j;
      }
      in[next] = true;
      tree += least[next];
      ++degree[next];
      if (parent[next] < n) ++degree[parent[next]];
      for (std::size_t j = 0; j < n; ++j) {
        const double price = edge[next * n + j] + penalty[next] + penalty[j];
        if (in[j] || price >= least[j]) continue;
        least[j] = price;
        parent[j] = next;
      }
    }
    best = std::max(best, tree + apart);
    if (round == 0) step = 0.5 * (tree + 1.0) / static_cast<double>(n);
    for (std::size_t j = 0; j < n; ++j) {
      penalty[j] = std::max(0.0, penalty[j] + step * (degree[j] - 2));
    }
    step *= 0.93;
  }
  return best;
}

}  // namespace clearway::assign
