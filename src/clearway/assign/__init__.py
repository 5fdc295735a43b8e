"""Ways to share out work: what it costs, who does it, where robots rest."""

from clearway.assign.costs import build
from clearway.assign.insertion import InsertionLocalSearch, InsertionParams
from clearway.assign.parking import park
from clearway.assign.random_assignment import RandomAssigner
from clearway.assign.tours import tours_of

__all__ = [
    "InsertionLocalSearch",
    "InsertionParams",
    "RandomAssigner",
    "build",
    "park",
    "tours_of",
]
