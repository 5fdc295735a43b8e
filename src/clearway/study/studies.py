"""All studies, by the name that the command takes."""

from collections.abc import Mapping

from clearway.study.experiment import Study
from clearway.study.hierarchical_table2 import STUDY as TABLE2

STUDIES: Mapping[str, Study] = {study.name: study for study in (TABLE2,)}
