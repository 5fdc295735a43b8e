"""The page on orders of one's own: its files, its commands, its messages and its Python."""

import json
import re
import shutil

import pytest
from tests.docs.run_page import DOCS, run_page

from clearway.cli import main
from clearway.formats.order_file import OrderFileError, read_orders
from clearway.formats.scenario_file import parse_scenario, read_scenario

NAME = "tutorials/orders.md"
PAGE = (DOCS / NAME).read_text(encoding="utf-8")
FILES = dict(re.findall(r"^```\w+ (\S+)\n(.*?)^```$", PAGE, re.DOTALL | re.MULTILINE))
COMMANDS = [
    line.removeprefix("clearway ").split()
    for block in re.findall(r"^```sh\n(.*?)^```$", PAGE, re.DOTALL | re.MULTILINE)
    for line in block.splitlines()
]


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """A folder with the page's files and the scenarios, where its commands are run."""
    shutil.copytree(DOCS.parent / "scenarios", tmp_path / "scenarios")
    for name, text in FILES.items():
        (tmp_path / name).write_text(text)
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_the_page_has_files_and_commands():
    """What follows looks at something."""
    assert set(FILES) == {
        "my-orders.csv",
        "my-warehouse.toml",
        "broken.csv",
        "more.jsonl",
        "carry.csv",
    }
    assert [command[0] for command in COMMANDS] == [
        "simulate",
        "check",
        "simulate",
        "validate",
        "simulate",
    ]


@pytest.mark.parametrize("command", COMMANDS[1:], ids=" ".join)
def test_its_commands_end_well(folder, command, capsys):
    """The first is the README's and is run elsewhere; `validate` judges what was run before."""
    if command[0] == "validate":
        assert main([*COMMANDS[2], "--quiet"]) == 0
    assert main(command) == 0
    if command[0] == "simulate":
        out = folder / command[command.index("--out") + 1]
        events = [json.loads(line) for line in (out / "trace.jsonl").read_text().splitlines()]
        assert events[-1]["status"] == "done"
        done = {e["order"] for e in events if e["event"] == "order" and e["state"] == "done"}
        listed = read_scenario(command[1]).orders
        assert done == {order.task.id for order in listed}
        # The folder can be sent to somebody: the copy of the scenario needs no other file.
        (folder / "elsewhere").mkdir()
        shutil.copy(out / "scenario.toml", folder / "elsewhere")
        assert read_scenario(folder / "elsewhere" / "scenario.toml").orders == listed


def test_the_broken_file_is_refused_as_the_page_says(folder, capsys):
    """Every line of the message is on the page, up to the names that are known."""
    text = FILES["my-warehouse.toml"].replace("my-orders.csv", "broken.csv")
    (folder / "my-warehouse.toml").write_text(text)
    assert main(["check", "my-warehouse.toml"]) == 2
    told = [line.strip() for line in capsys.readouterr().err.splitlines()]
    (shown,) = re.findall(r"^```text\n(.*?)^```$", PAGE, re.DOTALL | re.MULTILINE)
    for line in shown.splitlines():
        assert any(line.strip() in one for one in told), line
    assert len(told) == len(shown.splitlines())


def test_its_other_files_are_read(folder):
    """Shelves by JSON lines, and visits by rows of a table, on the page's own site."""
    scenario = read_scenario(folder / "my-warehouse.toml")
    assert [order.task.fetches for order in scenario.orders] == ["g3", "g27", "g88", "g201"]
    assert [o.task.id for o in read_orders(folder / "more.jsonl", scenario)] == ["c1", "c2"]
    first, second = read_orders(folder / "carry.csv", scenario)
    assert [visit.load for visit in first.task.visits] == ["pick", "drop"]
    assert first.task.visits[1].pose == (20.5, 4.5, 0.0)
    assert (first.release, second.release) == (10.0, 40.0)


def test_its_stream_is_that_of_the_scenario(folder):
    """The lines that the page quotes stand in the file that it runs first."""
    (quoted,) = re.findall(r"^```toml\n(.*?)^```$", PAGE, re.DOTALL | re.MULTILINE)
    text = FILES["my-warehouse.toml"] + "[simulation]\nuntil = 9.0\n" + quoted
    alone = parse_scenario(text, str(folder / "x.toml")).simulation.streams
    assert alone == read_scenario(folder / "scenarios" / "bidirectional.toml").simulation.streams


def test_its_python_runs(folder):
    """What was read is written, and reads the same again; a late order is released at once."""
    page = run_page(NAME)
    assert read_orders("again.csv", page["scenario"]) == page["orders"]
    assert page["order"].release == 95.0
    with pytest.raises(OrderFileError, match=r"a1.*my-orders\.csv|my-orders\.csv.*a1"):
        page["parse_order"]({"id": "a1", "fetches": "g9"}, page["scenario"], page["known"])
