"""The table of docs/figures.md: public and generated sets of one goal per robot.

    python benchmarks/kinodynamic.py --out OUT [--data FOLDER] [--budget S] [--jobs N] [SET ...]

``--data`` is the folder of the unpacked CL-CBS benchmark (with ``map50by50`` and so on in it);
without it only the generated sets are run. Generated sets have seeds 0 to 19; the command that
makes each is printed. All legal files of a set count. ``--budget`` seconds go to improving each
plan of the public sets; the first plan's figures stand beside.
"""

import argparse
from pathlib import Path

from clearway.formats.atomic import write_text
from clearway.formats.scenario_dump import dump_scenario
from clearway.protocols import Budget
from clearway.study.kinodynamic import bench_kinodynamic, summarise, table
from clearway.world.generate import generate

PUBLIC = {
    f"{side}x{side}-{robots}": f"map{side}by{side}/agents{robots}/obstacle"
    for side, all_robots in ((50, (5, 10, 15, 20)), (100, (20, 30, 40, 50)), (300, (50, 100)))
    for robots in all_robots
}
# kind, robots, side (m), density: discs of 0.8 m as many as in the public sets, or as sparse.
GENERATED = {
    "open-25": ("open", 25, 50.0, 25 * 2.0106 / 50.0**2),
    "open-70": ("open", 70, 100.0, 50 * 2.0106 / 100.0**2),
    "open-90": ("open", 90, 100.0, 50 * 2.0106 / 100.0**2),
    "open-100": ("open", 100, 100.0, 50 * 2.0106 / 100.0**2),
    "rooms-50": ("rooms", 50, 100.0, None),
    "open-500": ("open", 500, 300.0, 50 * 2.0106 / 100.0**2),
    "open-1000": ("open", 1000, 600.0, 50 * 2.0106 / 100.0**2),
}
SEEDS = range(20)


def made(name: str, folder: Path) -> list[Path]:
    """Write the instances of a generated set and return their files."""
    kind, robots, side, density = GENERATED[name]
    told = f"clearway generate {kind} --robots {robots} --size {side:g} {side:g} --count 20"
    print(told + (f" --density {density:.6g}" if density else ""), flush=True)
    folder.mkdir(parents=True, exist_ok=True)
    files = []
    for seed in SEEDS:
        scenario = generate(kind, robots=robots, size=(side, side), density=density, seed=seed)
        files.append(folder / f"{scenario.name}.toml")
        write_text(files[-1], dump_scenario(scenario))
    return files


def number(path: Path) -> int:
    """Return the number of a public instance."""
    return int(path.stem.rpartition("ex")[2])


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--out", type=Path, required=True)
    parser.add_argument("--data", type=Path)
    parser.add_argument("--budget", type=float)
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("sets", nargs="*", metavar="SET", help=", ".join((*PUBLIC, *GENERATED)))
    given = parser.parse_args()
    wanted = given.sets or [*(PUBLIC if given.data else ()), *GENERATED]
    rows = []
    for name in wanted:
        if name in PUBLIC:
            files = sorted((given.data / PUBLIC[name]).glob("*.yaml"), key=number)
        else:
            files = made(name, given.out / name / "instances")
        budget = Budget(given.budget) if name in PUBLIC else Budget()
        done = bench_kinodynamic(
            files, given.out / name, border="closed", budget=budget, seed=0, jobs=given.jobs
        )
        rows += done.rows
        print(table(summarise(done.rows)), flush=True)
    print("\n" + table(summarise(rows)))
    write_text(given.out / "table.md", table(summarise(rows)) + "\n")


if __name__ == "__main__":
    main()
