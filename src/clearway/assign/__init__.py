"""Ways to share out work: what it costs, who does it, where robots rest."""

from clearway.assign.apsga import AdaptationParams, Apsga, ApsgaParams
from clearway.assign.automatic import AutomaticAssigner
from clearway.assign.breeding import ELITIST, LITERAL, BreedingParams
from clearway.assign.charging import Charging
from clearway.assign.costs import build
from clearway.assign.exact import ExactAssigner
from clearway.assign.flight import Coefficients, FlightParams
from clearway.assign.ga import Ga, GaParams
from clearway.assign.insertion import InsertionLocalSearch, InsertionParams
from clearway.assign.look_ahead import LookAhead, LookAheadParams
from clearway.assign.memetic import MemeticApsga, MemeticParams
from clearway.assign.native import native_costs, values
from clearway.assign.nearest_idle import NearestIdle
from clearway.assign.nearest_order import NearestOrder, NearestOrderParams
from clearway.assign.oldest_order import OldestOrder
from clearway.assign.parking import park
from clearway.assign.psga import Psga, PsgaParams
from clearway.assign.pso import Pso, PsoParams
from clearway.assign.random_assignment import RandomAssigner
from clearway.assign.ruin_recreate import RuinRecreate, RuinRecreateParams
from clearway.assign.shelf_cycle import ShelfParams
from clearway.assign.swarm import SwarmParams, SwarmTrace
from clearway.assign.tours import tours_of
from clearway.assign.yard_bound import makespan_bound

__all__ = [
    "ELITIST",
    "LITERAL",
    "AdaptationParams",
    "Apsga",
    "ApsgaParams",
    "AutomaticAssigner",
    "BreedingParams",
    "Charging",
    "Coefficients",
    "ExactAssigner",
    "FlightParams",
    "Ga",
    "GaParams",
    "InsertionLocalSearch",
    "InsertionParams",
    "LookAhead",
    "LookAheadParams",
    "MemeticApsga",
    "MemeticParams",
    "NearestIdle",
    "NearestOrder",
    "NearestOrderParams",
    "OldestOrder",
    "Psga",
    "PsgaParams",
    "Pso",
    "PsoParams",
    "RandomAssigner",
    "RuinRecreate",
    "RuinRecreateParams",
    "ShelfParams",
    "SwarmParams",
    "SwarmTrace",
    "build",
    "makespan_bound",
    "native_costs",
    "park",
    "tours_of",
    "values",
]
