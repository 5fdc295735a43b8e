"""Ways to share out work: what it costs, who does it, where robots rest."""

from clearway.assign.apsga import AdaptationParams, Apsga, ApsgaParams
from clearway.assign.automatic import AutomaticAssigner
from clearway.assign.breeding import ELITIST, LITERAL, BreedingParams
from clearway.assign.costs import build
from clearway.assign.exact import ExactAssigner
from clearway.assign.flight import Coefficients, FlightParams
from clearway.assign.ga import Ga, GaParams
from clearway.assign.insertion import InsertionLocalSearch, InsertionParams
from clearway.assign.memetic import MemeticApsga, MemeticParams
from clearway.assign.native import native_costs, values
from clearway.assign.parking import park
from clearway.assign.psga import Psga, PsgaParams
from clearway.assign.pso import Pso, PsoParams
from clearway.assign.random_assignment import RandomAssigner
from clearway.assign.ruin_recreate import RuinRecreate, RuinRecreateParams
from clearway.assign.swarm import SwarmParams, SwarmTrace
from clearway.assign.tours import tours_of

__all__ = [
    "ELITIST",
    "LITERAL",
    "AdaptationParams",
    "Apsga",
    "ApsgaParams",
    "AutomaticAssigner",
    "BreedingParams",
    "Coefficients",
    "ExactAssigner",
    "FlightParams",
    "Ga",
    "GaParams",
    "InsertionLocalSearch",
    "InsertionParams",
    "MemeticApsga",
    "MemeticParams",
    "Psga",
    "PsgaParams",
    "Pso",
    "PsoParams",
    "RandomAssigner",
    "RuinRecreate",
    "RuinRecreateParams",
    "SwarmParams",
    "SwarmTrace",
    "build",
    "native_costs",
    "park",
    "tours_of",
    "values",
]
