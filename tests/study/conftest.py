"""A study of squares, small enough to be run in a test."""

import pytest
from tests.study import rows

from clearway.study.experiment import Cell, Study
from clearway.study.findings import Chart, Finding, Panel, Series, Summary, Table
from clearway.study.statistics import mean


def summarise(found):
    """The mean of the squares, in every form that a summary has."""
    squares = [row["square"] for row in found]
    if not squares:
        return Summary((), (), ())
    series = Series.of("mean", [(0.0, mean(squares))], "points")
    return Summary(
        (Table("Squares", ("x", "square"), tuple((str(r["x"]), str(r["square"])) for r in found)),),
        (Chart("squares", "Squares", (Panel("x", "square (m)", (series,)),)),),
        (Finding("Squares are 0 or more", f"least: {min(squares)}", min(squares) >= 0),),
    )


@pytest.fixture
def squares():
    """Return a study of so many squares with a row function of ``tests.study.rows``."""

    def make(count=4, row=rows.plain, version=1, part="multiplied", **settings):
        cells = [Cell({"x": x, **settings}, seed=7) for x in range(count)]
        return Study(
            name="squares",
            title="Squares < cubes & more",
            version=version,
            setting=("Numbers are squared.",),
            parts={"square": part},
            cells=lambda scale: cells,
            row=row,
            summarise=summarise,
        )

    return make
