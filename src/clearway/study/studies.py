"""All studies, by the name that the command takes."""

from collections.abc import Mapping

from clearway.study.bidirectional import STUDY as BIDIRECTIONAL
from clearway.study.experiment import Study
from clearway.study.hierarchical_corridor import STUDY as CORRIDOR
from clearway.study.hierarchical_fig7 import STUDY as FIG7
from clearway.study.hierarchical_fig8 import STUDY as FIG8
from clearway.study.hierarchical_port import STUDY as PORT
from clearway.study.hierarchical_table2 import STUDY as TABLE2

STUDIES: Mapping[str, Study] = {
    study.name: study for study in (BIDIRECTIONAL, CORRIDOR, FIG7, FIG8, PORT, TABLE2)
}
