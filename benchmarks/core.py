"""Builds and runs the core's micro-benchmarks, and compares them with those of another commit.

    python benchmarks/core.py [--baseline FILE] [--out FILE] [--instructions]

``--out`` saves the figures as JSON, ``--baseline`` adds the ratio to figures saved before, and
``--instructions`` counts instructions (valgrind's callgrind) instead of nanoseconds: they hardly
differ from run to run, whatever else the machine does.
"""

import argparse
import json
import re
import subprocess
import tempfile
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
FOLDER = ROOT / "build" / "benchmarks"
PROGRAM = FOLDER / "core_benchmarks"
ROW = re.compile(r"\| (.+) \| ([\d.]+) \| \d+ \|")
COUNTED = re.compile(r"Collected : (\d+)")


def build() -> None:
    options = ("-DCLEARWAY_PYTHON=OFF", "-DCLEARWAY_BENCHMARKS=ON", "-DCMAKE_BUILD_TYPE=Release")
    for command in (
        ("cmake", "-S", str(ROOT), "-B", str(FOLDER), *options),
        ("cmake", "--build", str(FOLDER), "--target", "core_benchmarks"),
    ):
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)


def output(*command: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(command, check=True, capture_output=True, text=True)


def nanoseconds() -> Iterator[tuple[str, float]]:
    with subprocess.Popen([PROGRAM], stdout=subprocess.PIPE, text=True) as run:
        for line in run.stdout:
            name, value = ROW.fullmatch(line.strip()).groups()
            yield name, float(value)
    if run.returncode:
        raise SystemExit(f"{PROGRAM.name} ended with {run.returncode}")


def instructions() -> Iterator[tuple[str, float]]:
    for name in output(str(PROGRAM), "--list").stdout.splitlines():
        with tempfile.TemporaryDirectory() as folder:
            run = output(
                "valgrind",
                "--tool=callgrind",
                "--collect-atstart=no",
                "--toggle-collect=core_benchmarks_once",
                f"--callgrind-out-file={folder}/out",
                str(PROGRAM),
                "--once",
                name,
            )
        yield name, int(COUNTED.search(run.stderr).group(1)) / int(run.stdout)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--baseline", type=Path, help="JSON of an earlier run")
    parser.add_argument("--out", type=Path, help="JSON to write")
    parser.add_argument("--instructions", action="store_true", help="count instructions")
    arguments = parser.parse_args()
    unit = "instructions" if arguments.instructions else "ns"
    before = {}
    if arguments.baseline:
        saved = json.loads(arguments.baseline.read_text(encoding="utf-8"))
        if saved["unit"] != unit:
            parser.error(f"{arguments.baseline} holds {saved['unit']}, this run {unit}")
        before = saved["rows"]
    build()
    print(f"| operation | {unit} |" + (" ratio |" if before else ""))
    print("|---|---|" + ("---|" if before else ""), flush=True)
    rows = {}
    for name, value in instructions() if arguments.instructions else nanoseconds():
        rows[name] = value
        ratio = f" {value / before[name]:.2f} |" if name in before else " new |" if before else ""
        print(f"| {name} | {value:,.1f} |{ratio}", flush=True)
    if arguments.out:
        text = json.dumps({"unit": unit, "rows": rows}, indent=2)
        arguments.out.write_text(text + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
