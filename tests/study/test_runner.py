"""Every row once, whatever happens to those who make them."""

import multiprocessing
import time

import pytest
from tests.study import rows

from clearway.study.experiment import Cell
from clearway.study.runner import rows_of
from clearway.study.workers import cluster, local


def cells(count=5, **settings):
    """Cells of the squares."""
    return [Cell({"x": x, **settings}, 7) for x in range(count)]


def without_seconds(found):
    """Rows by cell, without what differs from run to run."""
    found = list(found)
    keys = [cell.key for cell, _ in found]
    assert len(keys) == len(set(keys)), "a row was made twice"
    return {
        cell.key: {name: value for name, value in row.items() if not name.endswith("_s")}
        for cell, row in found
    }


def expected(some):
    """The rows as the row function gives them here."""
    return without_seconds([(cell, rows.plain(cell)) for cell in some])


def test_keys_do_not_depend_on_the_order_of_settings():
    """Seed and settings, sorted; text apart from numbers."""
    assert Cell({"b": 1, "a": "x"}, 3).key == 'a="x" b=1 seed=3' == Cell({"a": "x", "b": 1}, 3).key
    assert Cell({"a": "1"}, 0).key != Cell({"a": 1}, 0).key


def test_processes_make_every_row():
    """The same as the function does here."""
    assert without_seconds(rows_of(rows.plain, cells(), local(2))) == expected(cells())


def test_rows_of_a_worker_that_dies_are_made_again(tmp_path):
    """None is missing, none twice."""
    some = cells(marker=str(tmp_path / "died"))
    found = without_seconds(rows_of(rows.dies_once, some, local(2)))
    assert (tmp_path / "died").exists()
    assert found == expected(some)


def test_the_cell_that_kills_its_worker_is_found():
    """It alone is told as failed; those beside it are not blamed."""
    found = without_seconds(rows_of(rows.deadly, cells(), local(2)))
    failed = {key for key, row in found.items() if "failed" in row}
    assert failed == {cells()[2].key}
    assert "died 3 times" in found[cells()[2].key]["failed"]
    assert {k: v for k, v in found.items() if k not in failed} == {
        k: v for k, v in expected(cells()).items() if k not in failed
    }


def test_an_error_of_the_row_function_is_told_at_once():
    """Slow rows at work are given up."""
    begin = time.monotonic()
    with pytest.raises(LookupError, match="no row for"):
        list(rows_of(rows.wrong, cells(), local(2)))
    assert time.monotonic() - begin < 30.0


def test_bad_input_of_a_row_is_told_with_its_cell():
    """The error has more than a message, which would not come through from another process."""
    told = r"cell seed=7 x=0: site.toml: seed: a number is expected; write one"
    with pytest.raises(ValueError, match=told):
        list(rows_of(rows.refusing, cells(1), local(1)))


def test_leaving_early_ends_the_workers():
    """Two sleep for ten minutes; closing takes less than a second."""
    running = rows_of(rows.slow, cells(4), local(2))
    cell, _ = next(running)
    assert cell.settings["x"] == 0
    begin = time.monotonic()
    running.close()
    assert time.monotonic() - begin < 1.0
    while multiprocessing.active_children() and time.monotonic() - begin < 5.0:
        time.sleep(0.02)
    assert not multiprocessing.active_children()


def test_no_process_at_all_is_refused():
    """By the option's name."""
    with pytest.raises(ValueError, match="jobs: must be 1 or more, got 0"):
        local(0)


@pytest.mark.parametrize("address", ["here", "tcp://here", "tcp://here:port", ""])
def test_an_address_without_a_port_is_refused(address):
    """Before anybody waits for an answer."""
    with pytest.raises(ValueError, match=r"workers: .* write tcp://HOST:8786"):
        cluster(address)


@pytest.fixture(scope="module")
def scheduler():
    """The address of a Dask cluster of two processes."""
    distributed = pytest.importorskip("distributed", reason="distributed is not installed")
    with distributed.LocalCluster(
        n_workers=2, threads_per_worker=1, dashboard_address=None
    ) as running:
        yield running.scheduler_address


def test_a_cluster_makes_the_same_rows(scheduler):
    """As processes of this machine do."""
    found = without_seconds(rows_of(rows.plain, cells(), cluster(scheduler)))
    assert found == expected(cells())


def test_a_worker_of_a_cluster_may_die(scheduler, tmp_path):
    """Its rows are made by another."""
    some = cells(marker=str(tmp_path / "died"))
    found = without_seconds(rows_of(rows.dies_once, some, cluster(scheduler)))
    assert (tmp_path / "died").exists()
    assert found == expected(some)
