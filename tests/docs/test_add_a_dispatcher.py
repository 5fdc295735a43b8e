"""The page on adding a dispatcher."""

from tests.docs.run_page import run_page


def test_the_page_runs(monkeypatch):
    """Its dispatcher does orders for a quarter of an hour, and the judge finds nothing wrong."""
    monkeypatch.chdir(run_page.__globals__["DOCS"].parent)
    run = run_page("how-to/add-a-dispatcher.md")["run"]
    assert run.status == "ended"
    assert run.trace.events[-1]["orders_done"] > 50
