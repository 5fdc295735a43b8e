"""What the rows of system B's experiments say: tables, curves, and the paper's claims."""

from collections.abc import Sequence
from itertools import pairwise
from statistics import fmean

from clearway.study import statistics
from clearway.study.experiment import Row
from clearway.study.findings import Chart, Finding, Panel, Series, Summary, Table
from clearway.study.statistics import Estimate, saving

EXPERIMENTS = {"E17": "orders", "E18": "robots", "E19": "orders"}
TITLES = {
    "E17": "10 robots, more and more orders (Fig. 17)",
    "E18": "50 orders, more and more robots (Fig. 18)",
    "E19": "10 robots, all orders in the lower left corner (Fig. 19)",
}
BI, ONE_WAYS = "bidirectional", ("compact", "one_way")
# The paper: "nearly a quarter"; what counts as that was set before any run.
QUARTER = (15.0, 30.0)
# What looking ahead is to save at least (per cent).
AHEAD = 10.0


def summarise(rows: Sequence[Row]) -> Summary:
    """Return a table for each experiment, its curves, and what holds."""
    tables, charts = [], []
    for name, along in EXPERIMENTS.items():
        found = [row for row in rows if row["experiment"] == name]
        if found:
            tables.append(_table(name, along, found))
            charts.append(_chart(name, along, found))
    sensitive = [row for row in rows if row["experiment"] == "sensitivity"]
    if sensitive:
        tables.append(_sensitivity(sensitive))
    return Summary(tuple(tables), tuple(charts), tuple(_findings(rows)))


def _pick(rows: Sequence[Row], **what: object) -> list[Row]:
    return [row for row in rows if all(row.get(key) == value for key, value in what.items())]


def _paired(ours: Sequence[Row], theirs: Sequence[Row]) -> tuple[list[float], list[float]]:
    """Return makespans of runs with the same orders."""
    by_seed = {row["seed"]: row["makespan"] for row in theirs}
    both = [(r["makespan"], by_seed[r["seed"]]) for r in ours if r["seed"] in by_seed]
    return [a for a, _ in both], [b for _, b in both]


def _places(rows: Sequence[Row], along: str) -> list[int]:
    return sorted({row[along] for row in rows})


def _table(name: str, along: str, rows: Sequence[Row]) -> Table:
    lines = []
    for place in _places(rows, along):
        here = _pick(rows, **{along: place})
        for layout in (BI, *ONE_WAYS):
            for method in ("paper", "search", "ahead"):
                found = _pick(here, layout=layout, method=method)
                if found:
                    lines.append(_line(place, layout, method, found, here))
    return Table(
        TITLES[name],
        (
            along,
            "layout",
            "method",
            "makespan (s)",
            "bi saves (%)",
            "saved over paper (%)",
            "above bound (%)",
            "driven an order (cells)",
            "of it empty (%)",
            "waiting (s)",
            "conflicts",
        ),
        tuple(lines),
        f"Means over seeds with 95 % intervals; savings are of the same orders. {_judged(rows)}",
    )


def _line(
    place: int, layout: str, method: str, found: Sequence[Row], here: Sequence[Row]
) -> tuple[str, ...]:
    bi, paper = "-", "-"
    if layout != BI:
        pairs = _paired(_pick(here, layout=BI, method=method), found)
        bi = str(saving(*pairs)) if pairs[0] else "-"
    if method != "paper":
        pairs = _paired(found, _pick(here, layout=layout, method="paper"))
        paper = str(saving(*pairs)) if pairs[0] else "-"
    above = statistics.mean([100.0 * (r["makespan"] / r["lower_bound"] - 1.0) for r in found])
    return (
        str(place),
        layout,
        method,
        str(statistics.mean([row["makespan"] for row in found])),
        bi,
        paper,
        f"{above.value:.1f}",
        f"{fmean(row['distance'] / row['orders'] for row in found):.1f}",
        f"{fmean(100.0 * row['empty'] / row['distance'] for row in found):.0f}",
        f"{fmean(row['waiting'] for row in found):.0f}",
        f"{fmean(sum(row['conflicts'].values()) for row in found):.0f}",
    )


def _judged(rows: Sequence[Row]) -> str:
    wrong = sum(bool(row["violations"]) for row in rows)
    undone = sum(row["status"] != "done" for row in rows)
    return (
        f"{len(rows)} runs, {undone} of them without an end, {wrong} with violations on true "
        "bodies."
    )


def _chart(name: str, along: str, rows: Sequence[Row]) -> Chart:
    def curve(layout: str, method: str, value: str = "makespan") -> list[tuple[float, Estimate]]:
        here = _pick(rows, layout=layout, method=method)
        return [
            (float(p), statistics.mean([row[value] for row in _pick(here, **{along: p})]))
            for p in _places(here, along)
        ]

    rules = [
        Series.of(f"{layout}, paper's rules", curve(layout, "paper"), colour=colour)
        for colour, layout in enumerate((BI, *ONE_WAYS))
    ]
    methods = [
        Series.of(label, curve(BI, method), colour=colour)
        for method, label, colour in (
            ("paper", f"{BI}, paper's rules", 0),
            ("search", "paper's dispatching, search", 3),
            ("ahead", "looking ahead, search", 4),
        )
    ]
    methods.append(Series.of("lower bound", curve(BI, "paper", "lower_bound"), colour=6))
    panels = (
        Panel(along, "makespan (s)", tuple(rules), title="The layouts", from_zero=True),
        Panel(
            along,
            "makespan (s)",
            tuple(methods),
            title="The methods, two ways in a channel",
            from_zero=True,
        ),
    )
    return Chart(name.lower(), TITLES[name], panels, "Means; bars are 95 % intervals.", columns=2)


def _sensitivity(rows: Sequence[Row]) -> Table:
    lines = []
    for variant in dict.fromkeys(row["variant"] for row in rows):
        for orders in _places(rows, "orders"):
            here = _pick(rows, variant=variant, orders=orders)
            bi = _pick(here, layout=BI)
            if not bi:
                continue
            pairs = _paired(bi, _pick(here, layout="compact"))
            base = _paired(bi, _pick(rows, variant="as chosen", orders=orders, layout=BI))
            lines.append(
                (
                    variant,
                    str(orders),
                    str(statistics.mean([row["makespan"] for row in bi])),
                    str(saving(*pairs)) if pairs[0] else "-",
                    "-" if variant == "as chosen" else f"{-saving(*base).value:+.1f}",
                )
            )
    return Table(
        "What the paper leaves open, turned one by one (10 robots, paper's rules)",
        ("variant", "orders", "makespan (s)", "bi saves over compact (%)", "longer by (%)"),
        tuple(lines),
        _judged(rows),
    )


def _findings(rows: Sequence[Row]) -> list[Finding]:
    found = [_clean(rows), _shorter(rows), _quarter(rows), _fleet(rows)]
    found += [_corner(rows), _steeper(rows), _ahead(rows)]
    return found


def _clean(rows: Sequence[Row]) -> Finding:
    claim = "Ours: every run ends, and no body ever touches another"
    if not rows:
        return Finding(claim, "no runs", None)
    wrong = sum(bool(row["violations"]) for row in rows)
    undone = sum(row["status"] != "done" for row in rows)
    return Finding(
        claim,
        f"{len(rows)} runs: {undone} did not end, {wrong} with violations",
        wrong == undone == 0,
    )


def _shorter(rows: Sequence[Row]) -> Finding:
    claim = "Paper, Figs. 17 to 19: two ways are faster than one at every point"
    found: list[tuple[Estimate, str]] = []
    for name, along in EXPERIMENTS.items():
        here = _pick(rows, experiment=name, method="paper")
        for place in _places(here, along):
            for layout in ONE_WAYS:
                at = {along: place}
                pairs = _paired(_pick(here, layout=BI, **at), _pick(here, layout=layout, **at))
                if len(pairs[0]) > 1:
                    found.append((saving(*pairs), f"{name}, {place} {along}, {layout}"))
    if not found:
        return Finding(claim, "no pairs", None)
    worst, where = min(found, key=lambda one: one[0].low)
    told = f"least saving of {len(found)} points: {where}: {worst} %"
    return Finding(claim, told, worst.low > 0.0 if worst.excludes_zero else None)


def _quarter(rows: Sequence[Row]) -> Finding:
    claim = "Paper, Fig. 17: two ways save nearly a quarter (read as 15 to 30 % against compact)"
    here = _pick(rows, experiment="E17", method="paper")
    values = []
    for place in _places(here, "orders"):
        at = {"orders": place}
        pairs = _paired(_pick(here, layout=BI, **at), _pick(here, layout="compact", **at))
        if pairs[0]:
            values.append((place, saving(*pairs)))
    if not values:
        return Finding(claim, "no pairs", None)
    told = ", ".join(f"{place}: {value}" for place, value in values)
    low, high = QUARTER
    return Finding(claim, f"{told} %", all(low <= value.value <= high for _, value in values))


def _fleet(rows: Sequence[Row]) -> Finding:
    claim = "Paper, Fig. 18: more robots take less time, by less and less"
    here = _pick(rows, experiment="E18", method="paper", layout=BI)
    places = _places(here, "robots")
    if len(places) < 3:
        return Finding(claim, "fewer than three points", None)
    means = [fmean(row["makespan"] for row in _pick(here, robots=place)) for place in places]
    drops = [a - b for a, b in pairwise(means)]
    falls = all(drop > 0.0 for drop in drops)
    flattens = all(a > b for a, b in pairwise(drops))
    told = ", ".join(f"{p}: {m:.0f} s" for p, m in zip(places, means, strict=True))
    return Finding(claim, told, falls and flattens)


def _corner(rows: Sequence[Row]) -> Finding:
    claim = "Not required: two ways save more where all orders lie in one corner (E19 against E17)"
    savings = []
    for name in ("E17", "E19"):
        here = _pick(rows, experiment=name, method="paper")
        values = []
        for place in _places(here, "orders"):
            at = {"orders": place}
            ours, theirs = _paired(
                _pick(here, layout=BI, **at), _pick(here, layout="compact", **at)
            )
            values += [100.0 * (1.0 - a / b) for a, b in zip(ours, theirs, strict=True)]
        savings.append(values)
    if min(len(values) for values in savings) < 2:
        return Finding(claim, "too few pairs", None)
    more = statistics.unpaired(savings[1], savings[0])
    return Finding(
        claim, f"{more} percentage points more", more.low > 0.0 if more.excludes_zero else None
    )


def _steeper(rows: Sequence[Row]) -> Finding:
    claim = "Not required: the one-way curve of E19 grows ever faster (congestion)"
    here = _pick(rows, experiment="E19", method="paper", layout="compact")
    places = _places(here, "orders")
    if len(places) < 3:
        return Finding(claim, "fewer than three points", None)
    means = [fmean(row["makespan"] for row in _pick(here, orders=place)) for place in places]
    slopes = [
        (b - a) / (q - p) for a, b, p, q in zip(means, means[1:], places, places[1:], strict=False)
    ]
    told = ", ".join(f"{slope:.1f}" for slope in slopes)
    holds = all(a < b for a, b in pairwise(slopes))
    return Finding(claim, f"seconds for each further order: {told}", holds)


def _ahead(rows: Sequence[Row]) -> Finding:
    claim = f"Ours: looking ahead saves {AHEAD:.0f} % of the makespan or more, all over E17"
    here = _pick(rows, experiment="E17", layout=BI)
    values = []
    for place in _places(here, "orders"):
        at = {"orders": place}
        pairs = _paired(_pick(here, method="ahead", **at), _pick(here, method="paper", **at))
        if len(pairs[0]) > 1:
            values.append((place, saving(*pairs)))
    if not values:
        return Finding(claim, "no pairs", None)
    told = ", ".join(f"{place}: {value}" for place, value in values)
    holds = all(value.value >= AHEAD and value.low > 0.0 for _, value in values)
    return Finding(claim, f"{told} %", holds)
