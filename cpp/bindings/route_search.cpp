#include "clearway/search/route_search.hpp"

#include <nanobind/ndarray.h>
#include <nanobind/stl/vector.h>

#include "bind.hpp"

namespace nb = nanobind;
using namespace nb::literals;

namespace clearway::bindings {

using Bits = nb::ndarray<const std::uint8_t, nb::ndim<2>, nb::c_contig, nb::device::cpu>;

void bind_route_search(nb::module_& m) {
  nb::class_<RouteSearch>(m, "RouteSearch", "Best routes over square cells with legal moves.")
      .def(
          "__init__",
          [](RouteSearch* self, const Bits& lanes, Ticks step, Ticks turn) {
            new (self)
                RouteSearch(static_cast<int>(lanes.shape(1)), static_cast<int>(lanes.shape(0)),
                            {lanes.data(), lanes.data() + lanes.size()}, step, turn);
          },
          "lanes"_a, "step"_a, "turn"_a)
      .def(
          "__call__",
          [](RouteSearch& search, const Bits& moves, std::int32_t start, std::int32_t goal,
             int heading) {
            if (static_cast<int>(moves.shape(1)) != search.width()) {
              throw std::invalid_argument("moves must be of the lanes' shape");
            }
            return search({moves.data(), moves.size()}, start, goal, heading);
          },
          "moves"_a, "start"_a, "goal"_a, "heading"_a,
          "Cells (numbered row by row) from start to goal; none where there is no way.")
      .def_prop_ro("expansions", &RouteSearch::expansions, "Nodes expanded in the last search.");
}

}  // namespace clearway::bindings
