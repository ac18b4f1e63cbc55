#!/usr/bin/env python3
# SPDX-License-Identifier: MIT. Copyright the sph authors.
"""charts.py: draws the lab's tables (needs gnuplot) and writes the page of them.

usage: charts.py [--tables tests/lab] [--out tests/lab/charts] [--only PATTERN] [--no-page]

A chart is a figure as SVG and PNG. A table that is not there is passed over with a line that says so. From the same
tables come
the same files, byte for byte.
    STUDY_front      error against cost, each method a line; the Pareto front with its members named
    STUDY_precision  float beside double
    STUDY_h          error and cost against h/dx
    STUDY_courant    error against the Courant number, where it blew up, and the linear theory's limit
    stages           instructions of a particle-step by stage
    trade_off        the front of a dam break and the noise of a wall's pressure against cost, three choices
    atlas_*, interpolation_*: charts_atlas.py
"""
import argparse, fnmatch, os, string, sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, HERE)
import charts_atlas, page, tables  # noqa: E402
from plot import Axis, Chart, FONT, LINE, POINT, WIDTH, need_gnuplot, plain  # noqa: E402


def caption(chart, study, what):
    chart.note(what)
    chart.note(f"Error: {study.norm}; in {study.unit}. Reference: {study.reference}.")
    chart.note(f"Table tests/lab/{study.name}.csv, made by: {study.command}; options of each run are in it.")


def error_label(study, short=False):
    return f"error, {study.unit.split(' ')[0] if short else study.unit}"


def good(rows, cost=None):
    return [r for r in rows if r["good"] and r["error"] > 0 and (not cost or r[cost])]


# ---- error against cost ----

def letters():
    return list(string.ascii_lowercase) + [a + b for a in "ab" for b in string.ascii_lowercase]


def front_chart(study):
    costs = [c for c in tables.COSTS if study.front(c)]
    if not costs:
        return None
    chart = Chart(f"{study.name}_front", f"{study.title}: error against cost")
    letter = dict(zip(study.labels("method"), letters()))
    members = sorted({r["row"]: r for c in costs for r in study.front(c)}.values(), key=lambda r: -r["error"])
    place = {r["row"]: i + 1 for i, r in enumerate(members)}
    for cost in costs:
        front_panel(chart, study, cost, letter, place)
    keys = "; ".join(f"{k} {name}" for name, k in letter.items())
    chart.note(f"Lines, from coarse to fine: {keys}. Triangles: double. Small crosses: other h/dx.")
    chart.note("Thick line: Pareto front, no known run is as cheap and as good. Its members:")
    for r in members:
        where = "" if len(costs) == 1 else " (pairs only)" if r not in study.front(costs[0]) else ""
        chart.note(f"{place[r['row']]}  {study.name_of(r)}: {r['error']:.3g} {study.unit.split(' ')[0]}{where}", 12)
    falls = [tables.halving(study.front(c), c) for c in costs]
    said = "; ".join(f"{f:.2g} times the {c}" for f, c in zip(falls, costs) if f)
    chart.note(f"Half the error costs {said} (straight line through the front in logarithms)." if said else
               "The front spans less than one halving of the error in three runs: what a halving costs is not known.")
    caption(chart, study, f"Whole runs. Instructions: counted, default build. Resolution: {study.resolution}.")
    return chart


def front_panel(chart, study, cost, letter, place):
    rows = good(study.choices(cost))
    front = good(study.front(cost))
    x, y = Axis([r[cost] for r in rows], True, pad=0.07), Axis([r["error"] for r in rows], True, pad=0.07)
    names = {"pairs": "pairs of particles looked at", "instructions": "instructions"}
    p = chart.panel(420, names[cost] + ", whole run", error_label(study), x, y, right=50)
    swept = [r for r in rows if r["sweep"] == "h"]
    p.line([r[cost] for r in swept], [r["error"] for r in swept], lines=False, shape=1, size=0.45, width=0.7,
           grey="#999999")
    for i, (label, k) in enumerate(letter.items()):
        mine = sorted((r for r in rows if r["sweep"] == "method" and r["label"] == label), key=study.finer)
        p.line([r[cost] for r in mine], [r["error"] for r in mine], i, k, width=1, size=0.6, grey="#666666")
    double = [r for r in rows if r["precision"] == "double"]
    p.line([r[cost] for r in double], [r["error"] for r in double], lines=False, shape=POINT[5], size=1, width=1)
    p.line([r[cost] for r in front], [r["error"] for r in front], 0, width=3, shape=7, size=0.9)
    taken = []
    for r in front:
        gx, gy = p.where(r[cost], r["error"])
        px, py = gx * (WIDTH - 130), gy * 366
        # of five places the first that is clear of the numbers before
        dx, dy = next((d for d in ((-11, -11), (11, 11), (-20, -20), (20, 20), (-11, -27))
                       if all(abs(px + d[0] - a) > 16 or abs(py + d[1] - b) > 12 for a, b in taken)), (-11, -11))
        taken.append((px + dx, py + dy))
        p.text(gx, gy, place[r["row"]], dx, dy, "center", FONT, True)


# ---- float beside double ----

def precision_chart(study):
    labels = study.labels("precision")
    pairs = {}
    for label in labels:
        double, single = (sorted((r for r in good(study.sweep(sweep)) if r["label"] == label), key=study.finer)
                          for sweep in ("precision", "method"))
        both = {r["n"] for r in double} & {r["n"] for r in single}
        double, single = ([r for r in rows if r["n"] in both] for rows in (double, single))
        if double and single:
            pairs[label] = (single, double)
    if not pairs:
        return None
    chart = Chart(f"{study.name}_precision", f"{study.title}: float beside double")
    letter = [k + " " for k in letters()] if len(pairs) > 1 else [""]
    every = [r for two in pairs.values() for rows in two for r in rows]
    x = Axis([r["n"] for r in every], True, pad=0.08)
    ticks = [(n, f"{n:g}") for n in sorted({r["n"] for r in every})]
    for what, key, height in ((error_label(study, True), "error", 260), ("instructions a particle-step", "each", 220)):
        for r in every:
            r["each"] = r["instructions"] / r["particle_steps"] if r["instructions"] and r["particle_steps"] else None
        values = [r[key] for r in every if r[key]]
        if not values:
            continue
        y = Axis(values, key == "error", low=0 if key == "each" else None)
        p = chart.panel(height, study.resolution, what, x, y, right=122, xticks=ticks)
        for i, (two, k) in enumerate(zip(pairs.values(), letter)):
            for rows, name, shape, dash in ((two[0], "float", POINT[2 * i % 10], "solid"),
                                            (two[1], "double", POINT[2 * i % 10 + 1], "(10,5)")):
                p.line([r["n"] for r in rows], [r[key] for r in rows], i, k + name, shape=shape, dash=dash,
                       size=1.2 if name == "double" else 0.8)
    keys = "; ".join(k + label for label, k in zip(pairs, letter))
    worst = max(abs(d["error"] / s["error"] - 1) for two in pairs.values() for s, d in zip(*two))
    caption(chart, study, f"Method: {keys}. Largest difference of the two errors: {100 * worst:.2g} % of the error.")
    return chart


# ---- error and cost against h/dx ----

def h_chart(study):
    rows = study.sweep("h")
    if not good(rows):
        return None
    chart = Chart(f"{study.name}_h", f"{study.title}: error and cost against h/dx")
    x = Axis([r["x"] for r in rows])
    y = Axis([r["error"] for r in good(rows)], True, pad=0.08)
    p = chart.panel(360, "h/dx", error_label(study), x, y, right=122)
    broken = {}
    for i, label in enumerate(study.labels("h")):
        mine = [r for r in rows if r["label"] == label]
        fine = good(mine)
        p.line([r["x"] for r in fine], [r["error"] for r in fine], i, label.replace("_", " "))
        for r in mine:
            if not r["good"]:
                broken.setdefault(r["x"], []).append(label)
    for at, labels in broken.items():
        p.text(x.at(at), 1, "x", 0, -6, "center", FONT, True)
    cost = "instructions" if good(rows, "instructions") else "pairs"
    q = chart.panel(260, "h/dx", f"{cost}, whole run", x,
                    Axis([r[cost] for r in good(rows, cost)], True, pad=0.08), right=122)
    for i, label in enumerate(study.labels("h")):
        fine = [r for r in good(rows, cost) if r["label"] == label]
        q.line([r["x"] for r in fine], [r[cost] for r in fine], i, label.replace("_", " "))
    if broken:
        where = "; ".join(f"h/dx {k:g} {', '.join(v)}" for k, v in broken.items())
        chart.note(f"x at the top: no figure, as the run blew up: {where}.")
    least = min(good(rows), key=lambda r: r["error"])
    caption(chart, study, f"All at {study.size} {least['n']:g}. Smallest error: {least['error']:.3g}, "
                          f"{least['label']}, h/dx {least['x']:g}.")
    return chart


# ---- error against the Courant number ----

# scenes of solids
SOLIDS = ("pulse", "rings", "plate", "beam", "csm3", "hole", "block",
          "stretch", "tension", "brittle", "chamber", "caldera")


def theory_of(study, rows, atlas):
    """Lowest and highest limit of the linear theory for a sweep: of its kernel and scheme where they are known, else of
    all."""
    if not atlas:
        return None
    given = {**study.defaults, **rows[0]["given"]}
    solid = study.scene in SOLIDS
    medium, integrator = "elastic" if solid else "water", given.get("integrator", "")
    found = [r for r in atlas if r["medium"] == medium and r["integrator"] == integrator]
    scheme = given.get("form") if solid else given.get("scheme")
    for key, want in (("scheme", scheme), ("kernel", given.get("kernel"))):
        if want and any(r[key] == want for r in found):
            found = [r for r in found if r[key] == want]
    limits = [tables.number(r["theory"]) for r in found if tables.number(r["theory"]) is not None]
    return (min(limits), max(limits)) if limits else None


def courant_chart(study, atlas):
    rows = study.sweep("courant")
    if not good(rows):
        return None
    chart = Chart(f"{study.name}_courant", f"{study.title}: error against the Courant number")
    xs = [r["x"] for r in rows]
    bounds = {label: theory_of(study, [r for r in rows if r["label"] == label], atlas)
              for label in study.labels("courant")}
    x = Axis(xs + [b for two in bounds.values() if two for b in two if b > 0.5 * min(xs)], True)
    ok = [r["error"] for r in good(rows)]
    least = min(ok)
    p = None
    for i, label in enumerate(study.labels("courant")):
        mine = sorted((r for r in rows if r["label"] == label), key=lambda r: r["x"])
        fine = good(mine)
        shown = [r for r in fine if r["error"] < 300 * least]
        p = chart.panel(190, "" if i + 1 < len(bounds) else "Courant number c dt/h", error_label(study, True), x,
                        Axis([min(v, 300 * least) for v in ok], True, pad=0.3), title=label, right=16)
        p.line([r["x"] for r in shown], [r["error"] for r in shown], i)
        broken = next((r for r in mine if not r["good"]), None)
        two = bounds[label]
        if two:
            p.band(two[0], max(two[1], two[0] * 1.01), "#d5d5d5")
            p.upright(two[0], "(2,4)")
            said = f"theory {two[0]:.3g}" if two[1] < 1.02 * two[0] else f"theory {two[0]:.3g} to {two[1]:.3g}"
            chart_text(p, x, two[0], 0.1, said)
        if broken:
            p.upright(broken["x"], "solid", width=2)
            chart_text(p, x, broken["x"], 0.9, f"blows up at {broken['x']:g}")
        elif shown:
            chart_text(p, x, shown[-1]["x"], 0.9, f"stands all, to {mine[-1]['x']:g}")
        if len(shown) < len(fine):
            chart_text(p, x, shown[-1]["x"] if shown else xs[0], 0.6,
                       f"beyond: errors to {max(r['error'] for r in fine):.4g}", 0.3)
    chart.note("Time step fixed by hand. Thick upright: the first step that blew up. Dotted, grey band: largest stable "
               "step by linear theory "
               "(tests/lab/atlas_courant.csv: square lattice at no pressure, periodic, alpha 0.1; of the study's "
               "kernel and scheme where its "
               "options name them, else from the smallest to the largest)." if any(bounds.values()) else
               "Time step fixed by hand. Thick upright: the first step that blew up. The linear theory's limits were "
               "not there "
               "(tests/lab/atlas_courant.csv).")
    caption(chart, study, f"All at {study.size} {rows[0]['n']:g}.")
    return chart


def chart_text(p, x, value, gy, text, turn=0.6):
    """beside a value, on the side where there is room: left of it from a share `turn` of the panel on"""
    gx = x.at(value)
    room = gx < turn
    p.text(min(max(gx, 0), 1), gy, text, 5 if room else -5, 0, "left" if room else "right", FONT - 1)


# ---- stages ----

STAGES = {"force": "forces", "scatter": "sort", "count": "sort", "adami": "walls", "ghost": "walls", "wall": "walls",
          "correct": "motion", "carry": "motion", "begin": "motion", "kick": "motion", "drift": "motion",
          "predict": "motion", "clear": "sort", "smooth": "filters", "filter": "filters",
          "shepard": "filters", "gradient": "correction", "moment": "correction", "solid": "solids", "stress": "solids",
          "damage": "damage"}
SHARE = 0.03  # stages below it in every scene are "rest"


def stage_name(name):
    word = name.split("_")[0]
    return STAGES.get(word, name.replace("_chunk", "").replace("_range", "").replace("_", " ").strip())


def stages_chart(folder):
    got = tables.read(os.path.join(folder, "stages.csv"))
    if not got:
        return None
    head, rows = got
    bars = {}
    for r in rows:
        bar = bars.setdefault((r["scene"], r["precision"], r["options"]), {})
        bar[stage_name(r["stage"])] = bar.get(stage_name(r["stage"]), 0) + (tables.number(r["instructions"]) or 0)
    large = {s for bar in bars.values() for s, v in bar.items() if v > SHARE * sum(bar.values())}
    order = sorted(large, key=lambda s: -max(bar.get(s, 0) for bar in bars.values())) + ["rest"]
    for bar in bars.values():
        rest = sum(v for s, v in bar.items() if s not in large)
        for s in [s for s in bar if s not in large]:
            del bar[s]
        bar["rest"] = rest
    chart = Chart("stages", "What a particle-step costs, by stage of the step")
    x = Axis([0, 1.02 * max(sum(b.values()) for b in bars.values())], low=0)
    y = Axis([0, len(bars)], low=0, high=len(bars))
    p = chart.panel(40 * len(bars) + 60, "instructions a particle-step", "", x, y, left=130, right=16,
                    yticks=[(len(bars) - i - 0.5, plain(scene)) for i, (scene, _, _) in enumerate(bars)])
    greys = ["#ffffff", "#bbbbbb", "#e6e6e6", "#999999", "#d0d0d0", "#f2f2f2", "#aaaaaa", "#c6c6c6"]
    for i, bar in enumerate(bars.values()):
        at, low = 0.0, len(bars) - i - 0.85
        for k, s in enumerate(order):
            v = bar.get(s, 0)
            if v <= 0:
                continue
            p.rect(at, low, at + v, low + 0.7, greys[k % len(greys)])
            if x.at(v) - x.at(0) > 0.011 * (len(s) + 2) * 1.2:
                p.text(x.at(at + v / 2), y.at(low + 0.35), s, 0, 0, "center", FONT - 2)
            elif x.at(v) > 0.02:
                p.text(x.at(at + v / 2), y.at(low + 0.35), k + 1, 0, 0, "center", FONT - 4)
            at += v
    chart.note("In the order of the bars: " + ", ".join(f"{k + 1} {s}" for k, s in enumerate(order)) + ".")
    for (scene, precision, options) in bars:
        chart.note(f"{scene}: {precision}, {options}", 12)
    chart.note(f"Counted by callgrind. Table tests/lab/stages.csv, made by: {head.get('command', 'make lab')}.")
    return chart


# ---- front against pressure ----

# what is chosen for; its label in the study dam_break, in the study impact
TRADES = (
    ("front, cheap: h 1.2, alpha 0.01, delta 0.1, sound 14", "default",
     "as dam_break: h 1.2, alpha 0.01, delta 0.1, sound 14"),
    ("pressure: h 2, alpha 0.02, delta 0.2, sound 14", "for pressure: h 2, alpha 0.02, delta 0.2, sound 14",
     "no shifting, alpha 0.02, sound 14"),
    ("both: shifting 0.5, h 2, alpha 0.005, delta 0.2, sound 10",
     "as impact: shifting 0.5, h 2, alpha 0.005, delta 0.2, sound 10", "default"),
)


def trade_chart(found):
    study = {s.name: s for s in found}
    if not all(name in study for name in ("dam_break", "impact")):
        return None
    chart = Chart("trade_off", "Water: a front, or the pressure on a wall, for the same cost")
    for k, name in ((1, "dam_break"), (2, "impact")):
        s = study[name]
        runs = good(s.sweep("method"), "pairs")
        lines = [sorted((r for r in runs if r["label"] == choice[k]), key=s.finer) for choice in TRADES]
        every = [r for rows in lines for r in rows]
        if not every:
            return None
        x, y = Axis([r["pairs"] for r in every], True, pad=0.07), Axis([r["error"] for r in every], True, pad=0.1)
        p = chart.panel(260, "pairs of particles looked at, whole run", error_label(s), x, y, right=50)
        for i, rows in enumerate(lines):
            p.line([r["pairs"] for r in rows], [r["error"] for r in rows], i, "abc"[i], width=2, size=0.8)
        chart.note(f"{'Above' if k == 1 else 'Below'}: {s.title}; {s.norm}; table tests/lab/{s.name}.csv.")
    chart.note("; ".join(f"{'abc'[i]} {choice[0]}" for i, choice in enumerate(TRADES)) + ".")
    return chart


# ---- the call ----

def study_charts(folder):
    found = tables.studies(folder)
    if not found:
        print(f"charts: no study in {folder}; make lab makes them", file=sys.stderr)
    atlas = tables.read(os.path.join(folder, "atlas_courant.csv"))
    for s in found:
        for name, chart in (("front", front_chart(s)), ("precision", precision_chart(s)), ("h", h_chart(s)),
                            ("courant", courant_chart(s, atlas[1] if atlas else None))):
            if chart:
                yield chart
            else:
                print(f"charts: {s.name}_{name} passed over: no such runs in {s.path}", file=sys.stderr)
    chart = trade_chart(found)
    if chart:
        yield chart
    else:
        print(f"charts: trade_off passed over: no such runs in {folder}", file=sys.stderr)
    chart = stages_chart(folder)
    if chart:
        yield chart
    else:
        print(f"charts: stages passed over: no {folder}/stages.csv", file=sys.stderr)


def main():
    p = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    p.add_argument("--tables", default=os.path.relpath(HERE), help="the folder of the tables")
    p.add_argument("--out", default="", help="the folder of the charts; TABLES/charts unless given")
    p.add_argument("--only", default="*", help="charts whose names match")
    p.add_argument("--no-page", action="store_true")
    args = p.parse_args()
    if not os.path.isdir(args.tables):
        sys.exit(f"charts: --tables {args.tables}: no such folder")
    need_gnuplot()
    out = args.out or os.path.join(args.tables, "charts")
    os.makedirs(out, exist_ok=True)
    drawn = []
    for make in (study_charts, charts_atlas.charts):
        for chart in make(args.tables):
            if fnmatch.fnmatch(chart.name, args.only):
                chart.write(out)
                drawn.append(chart.name)
    print(f"charts: {len(drawn)} as SVG and PNG in {out}", file=sys.stderr)
    if not args.no_page:
        page.write(args.tables, out)
    return 0


if __name__ == "__main__":
    sys.exit(main())
