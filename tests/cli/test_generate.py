"""Instances from the command line: whole files, the same each time, and told by name."""

from clearway.formats.scenario_file import read_scenario
from clearway.world.generate import generate


def test_generate_writes_what_the_function_returns(clearway, tmp_path):
    """One file a seed, named after what is in it."""
    asked = ("generate", "open", "--size", 50, 50, "--robots", 10, "--seed", 7, "--count", 2)
    told = clearway(*asked, "--out", "deep/set")
    names = [f"open-50x50-10cars-seed{seed}.toml" for seed in (7, 8)]
    assert (told.code, told.err) == (0, "")
    assert told.out.splitlines() == [f"deep/set/{name}" for name in names]
    for seed, name in zip((7, 8), names, strict=True):
        path = tmp_path / "deep" / "set" / name
        assert read_scenario(path) == generate("open", robots=10, size=(50, 50), seed=seed)
        assert f"--robots 10 --size 50 50 --fleet cars --seed {seed}\n" in path.read_text()


def test_same_seed_same_bytes(clearway, tmp_path):
    """A second run writes the same; JSON lists the files."""
    asked = ("generate", "yards", "--fleet", "mixed", "--robots", 6, "--size", 50.5, 60, "--json")
    first, second = (clearway(*asked, "--out", folder).json["files"] for folder in ("a", "b"))
    assert first == ["a/yards-50.5x60-6mixed-seed0.toml"]
    assert (tmp_path / first[0]).read_bytes() == (tmp_path / second[0]).read_bytes()


def test_bad_values_name_the_option_and_the_mend(clearway, tmp_path):
    """Exit code 2, one line, and no folder."""
    for option, *arguments in (
        ("kind", "opn"),
        ("size", "open", "--size", 0, 10),
        ("size", "open", "--size", "wide", 10),
        ("density", "shelves", "--density", -1),
        ("robots", "open", "--robots", 400, "--size", 40, 40, "--count", 3),
        ("count", "open", "--count", 0),
        ("fleet", "open", "--fleet", "trucks"),
    ):
        told = clearway("generate", *arguments, "--out", "none")
        assert told.code == 2
        assert told.out == ""
        assert option in told.err.splitlines()[-1]
        assert "Traceback" not in told.err
        assert not (tmp_path / "none").exists()
    told = clearway("generate", "open", "--size", 0, 10, "--out", "none", "--json")
    assert told.code == 2
    assert told.json["error"]["message"].startswith("size: both sides must be above 0")
