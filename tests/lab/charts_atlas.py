# SPDX-License-Identifier: MIT. Copyright the sph authors.
"""charts_atlas.py: charts of the stability atlas (tests/lab/atlas_*.csv) and of the interpolation of fields
(interpolation.csv)."""
import os, re, sys

import tables
from plot import Axis, Chart, FONT, plain

GROWTH = (0.01, 0.03, 0.1, 0.3, 1.0)                            # classes of growth rates in the maps
SHADE = ("#ffffff", "#dcdcdc", "#b4b4b4", "#868686", "#505050", "#000000")


def one(rows, key):
    return list(dict.fromkeys(r[key] for r in rows))


def num(r, key):
    return tables.number(r.get(key))


def start(name, head, title):
    chart = Chart(name, head.get("title", title))
    return chart


def finish(chart, name, head):
    for line in head[""]:
        chart.note(line)
    chart.note(f"Table tests/lab/{name}.csv, made by: {head.get('command', 'make atlas')}.")
    return chart


def grid_of(chart, panels, draw, height=230, columns=2, **kw):
    """Small panels of the same axes, `columns` beside each other. draw(panel, key) fills one."""
    for i, (key, title) in enumerate(panels):
        p = chart.panel(height, kw["xlabel"], kw["ylabel"], kw["x"], kw["y"], title=title, beside=i % columns > 0,
                        left=82,
                        right=kw.get("right", 10))
        draw(p, key)


# ---- Courant numbers ----

def courant(name, head, rows):
    chart = start(name, head, "Largest stable Courant number: runs against linear theory")
    values = [v for r in rows for v in (num(r, "measured"), num(r, "theory")) if v]
    axis = Axis(values, True)
    integrators, media = one(rows, "integrator"), one(rows, "medium")
    for medium in media:
        p = chart.panel(400, "linear theory, c dt/h", "measured, c dt/h", axis, axis, title=medium, right=200)
        p.segment(axis.low, axis.low, axis.high, axis.high, "(3,3)", "#777777")
        for i, integrator in enumerate(integrators):
            mine = sorted((r for r in rows if (r["medium"], r["integrator"]) == (medium, integrator)
                           and num(r, "theory")),
                          key=lambda r: num(r, "theory"))
            p.line([num(r, "theory") for r in mine], [num(r, "measured") for r in mine], i,
                   integrator.replace("_", " "), lines=False)
    off = sorted((r for r in rows if num(r, "ratio")), key=lambda r: -abs(num(r, "ratio") - 1))
    share = sum(abs(num(r, "ratio") - 1) <= 0.05 for r in off)
    chart.note(f"{share} of {len(off)} cases within 5 % of the theory (dotted line: equal). Farthest off:")
    for r in off[:4]:
        case = f"{r['medium']} {r['scheme']}, {r['integrator']}, {r['kernel']}, h {r['h']} dx".replace("_", " ")
        chart.note(f"{case}: measured {r['measured']}, theory {r['theory']}", 12)
    for medium in media:
        for integrator in integrators:
            mine = [num(r, "measured") for r in rows if (r["medium"], r["integrator"]) == (medium, integrator)]
            mine = [v for v in mine if v is not None]
            if mine:
                chart.note(f"{medium}, {integrator.replace('_', ' ')}: {min(mine):.3g} to {max(mine):.3g}", 12)
    return finish(chart, name, head)


# ---- Swegle maps ----

def swegle(name, head, rows):
    chart = start(name, head, "Swegle test: growth rate over volume and h/dx")
    volumes, hs = sorted({num(r, "volume") for r in rows}), sorted({num(r, "h") for r in rows})
    x, y = Axis([0, len(volumes)], low=0, high=len(volumes)), Axis([0, len(hs)], low=0, high=len(hs))
    some = range(0, len(volumes), max(1, len(volumes) // 5))
    xticks = [(i + 0.5, f"{volumes[i]:g}") for i in some]
    yticks = [(i + 0.5, f"{h:g}") for i, h in enumerate(hs)]
    for form in one(rows, "form"):
        for beside, what in enumerate(("measured", "theory")):
            p = chart.panel(106 + 18 * len(hs), "volume V/V0", "h/dx", x, y, title=f"{form.replace('_', ' ')}: {what}",
                            beside=beside > 0, left=66, right=10, xticks=xticks, yticks=yticks, grid=False)
            for r in rows:
                if r["form"] != form:
                    continue
                i, k, v = volumes.index(num(r, "volume")), hs.index(num(r, "h")), num(r, what)
                if v is None:
                    p.text(x.at(i + 0.5), y.at(k + 0.5), "?", anchor="center", size=FONT - 2)
                elif v >= GROWTH[0]:
                    p.rect(i, k, i + 1, k + 1, SHADE[sum(v >= g for g in GROWTH)], False)
    z, w = Axis([0, 6], low=0, high=6), Axis([0, 1], low=0, high=1)
    edges = ["below " + f"{GROWTH[0]:g}"] + [f"from {g:g}" for g in GROWTH]
    p = chart.panel(70, "growth rate, c/dx", "", z, w, left=30, right=24, yticks=[(2, "")], grid=False,
                    xticks=[(i + 0.5, t) for i, t in enumerate(edges)])
    for i, shade in enumerate(SHADE):
        p.rect(i, 0, i + 1, 1, shade)
    for form in one(rows, "form"):
        mine = [r for r in rows if r["form"] == form]
        both = [r for r in mine if (num(r, "measured") or 0) >= 0.05 and (num(r, "theory") or 0) >= 0.05]
        agree = sum(((num(r, "measured") or 0) >= GROWTH[0]) == ((num(r, "theory") or 0) >= GROWTH[0]) for r in mine)
        worst = max((abs(num(r, "measured") / num(r, "theory") - 1) for r in both), default=None)
        chart.note(f"{form}: stable or not as theory says in {agree} of {len(mine)}" +
                   (f"; growth off theory by at most {100 * worst:.2g} % where it is 0.05 or more" if worst is not None
                    else ""), 12)
    return finish(chart, name, head)


# ---- curves: theory as lines, measured as points ----

def tension(name, head, rows):
    chart = start(name, head, "Critical stretch against h")
    extra = [c for c in ("seen", "powell") if c in rows[0]]
    x = Axis([num(r, "h") for r in rows])
    y = Axis([num(r, c) for r in rows for c in ["cholesky", "running"] + extra], True)

    def draw(p, kernel):
        mine = [r for r in rows if r["kernel"] == kernel]
        h = [num(r, "h") for r in mine]
        p.line(h, [num(r, "cholesky") for r in mine], 0, points=False)
        for c, dash in zip(extra, ("(6,4)", "(2,4)")):
            p.line(h, [num(r, c) for r in mine], 0, points=False, dash=dash, width=1, grey="#666666")
        p.line(h, [num(r, "running") for r in mine], 0, lines=False, shape=6, size=1)

    grid_of(chart, [(k, k.replace("_", " ")) for k in one(rows, "kernel")], draw, xlabel="h/dx",
            ylabel="critical stretch", x=x, y=y)
    more = "".join(f"; {'dashed' if c == 'seen' else 'dotted'}: {c}" for c in extra)
    chart.note(f"Line: by Cholesky; circles: by running the code{more}. No point: stable at every stretch that was "
               f"tried.")
    return finish(chart, name, head)


def pairing(name, head, rows):
    chart = start(name, head, "Compression: growth of pairs, and how near particles come")
    x = Axis([num(r, "h") for r in rows])
    keys = list(dict.fromkeys((r.get("lattice", ""), r["rho"]) for r in rows))
    kernels = one(rows, "kernel")
    for lattice, rho in keys:
        for what, label, log in (("measured", "growth rate, c/dx", False), ("nearest", "nearest pair, dx", False)):
            y = Axis([num(r, what) for r in rows] + [0], log, low=0)
            p = chart.panel(260, "h/dx", label, x, y, title=f"{lattice.replace('_', ' ')} lattice, rho {rho}".strip(),
                            right=130)
            for i, kernel in enumerate(kernels):
                mine = [r for r in rows if (r.get("lattice", ""), r["rho"], r["kernel"]) == (lattice, rho, kernel)]
                h = [num(r, "h") for r in mine]
                if what == "measured":
                    p.line(h, [num(r, "theory") for r in mine], i, kernel.replace("_", " "), points=False)
                    p.line(h, [num(r, "measured") for r in mine], i, lines=False)
                else:
                    p.line(h, [num(r, "nearest") for r in mine], i, kernel.replace("_", " "))
    chart.note("Growth: lines are linear theory, points runs.")
    return finish(chart, name, head)


def repulsion(name, head, rows):
    chart = start(name, head, "Tension with artificial stress: growth rate against epsilon")
    x = Axis([num(r, "epsilon") for r in rows])
    y = Axis([num(r, c) for r in rows for c in ("measured", "theory")] + [0], low=0)
    keys = sorted({(num(r, "lambda"), num(r, "h")) for r in rows}, key=lambda k: (-k[0], k[1]))

    def draw(p, key):
        for i, n in enumerate(one(rows, "exponent")):
            mine = [r for r in rows if (num(r, "lambda"), num(r, "h")) == key and r["exponent"] == n]
            e = [num(r, "epsilon") for r in mine]
            p.line(e, [num(r, "theory") for r in mine], i, f"n {n}", points=False)
            p.line(e, [num(r, "measured") for r in mine], i, lines=False)

    grid_of(chart, [(k, f"lambda {k[0]:g}, h {k[1]:g} dx") for k in keys], draw, xlabel="epsilon",
            ylabel="growth rate, c/dx",
            x=x, y=y, right=52)
    chart.note("Lines are linear theory, points runs; n: exponent of the artificial stress.")
    return finish(chart, name, head)


# ---- tables of case, choice, x, figure, value, unit ----

def figures(name, head, rows):
    """curves over x where a figure has three or more of them, else bars; figures that are 0 in all rows are only
    said"""
    chart = start(name, head, name.replace("atlas_", "").replace("_", " "))
    said = re.search(r"\bx: ([^;]+)", "; ".join(head[""]))
    flat, bar = [], {}
    for r in rows:  # what theory says of a growth rate stands beside it
        if r["figure"] == "theory" and any(q["figure"] == "growth" and q["case"] == r["case"] for q in rows):
            r["figure"], r["choice"] = "growth", "theory"
    for case, figure in dict.fromkeys((r["case"], r["figure"]) for r in rows):
        mine = [r for r in rows if (r["case"], r["figure"]) == (case, figure)]
        if all(num(r, "value") == 0 for r in mine):
            flat.append(f"{case} {figure}".replace("_", " "))
        elif len({num(r, "x") for r in mine} - {None}) > 2:
            curves(chart, mine, case.replace("_", " "), said.group(1) if said else "x")
        else:
            bar.setdefault(figure, []).extend(mine)
    for mine in bar.values():
        bars(chart, mine, len(one(rows, "case")) > 1)
    if flat:
        chart.note("0 in all rows: " + ", ".join(flat) + ".")
    return finish(chart, name, head)


def label_of(rows):
    units = [u for u in one(rows, "unit") if u not in ("", "-", "1")]
    figure = rows[0]["figure"].replace("_", " ")
    return f"{figure}, {units[0]}" if len(units) == 1 and units[0] != figure else figure


def axis_of(rows):
    """logarithmic where all values are positive and span more than 30"""
    values = [num(r, "value") for r in rows if num(r, "value") is not None] or [0, 1]
    log = min(values) > 0 and max(values) > 30 * min(values)
    return Axis(values if log else values + [0], log, pad=0.1)


def curves(chart, rows, title, what):
    xs = [num(r, "x") for r in rows if num(r, "x") is not None]
    wide = min(xs) > 0 and max(xs) > 30 * min(xs)
    p = chart.panel(250, what, label_of(rows), Axis(xs, wide), axis_of(rows), title=title, right=150)
    for i, choice in enumerate(one(rows, "choice")):
        mine = sorted((r for r in rows if r["choice"] == choice and num(r, "x") is not None), key=lambda r: num(r, "x"))
        p.line([num(r, "x") for r in mine], [num(r, "value") for r in mine], i, choice.replace("_", " "), lines=True,
               size=0.8)


def bars(chart, rows, several):
    x, y = axis_of(rows), Axis([0, len(rows)], low=0, high=len(rows))
    names = [(f"{r['case']}, " if several else "") + r["choice"] + (f", {r['x']}" if r["x"] else "") for r in rows]
    p = chart.panel(24 * len(rows) + 76, label_of(rows), "", x, y, left=180, right=60,
                    yticks=[(len(rows) - i - 0.5, plain(n.replace("_", " "))) for i, n in enumerate(names)])
    for i, r in enumerate(rows):
        v, at = num(r, "value"), len(rows) - i - 0.8
        if v is not None:
            p.rect(x.low if x.log else 0, at, v, at + 0.6, "#aaaaaa")
        end = 0 if v is None else min(max(x.at(v), 0), 1)
        p.text(end, y.at(at + 0.3), r["value"] or "none", 5, 0, "left", FONT - 2)


def interpolation(name, head, rows):
    """a chart of every case"""
    for case in one(rows, "case"):
        yield interpolation_case(name, head, [r for r in rows if r["case"] == case])


def interpolation_case(name, head, rows):
    case = rows[0]["case"]
    chart = Chart(f"{name}_{case}", f"{head.get('title', 'Interpolation: error and cost against h/dx')}, {case}")
    x = Axis([num(r, "h") for r in rows])
    for figure in one(rows, "figure"):
        mine = [r for r in rows if r["figure"] == figure]
        values = [num(r, "value") for r in mine if num(r, "value") is not None]
        if not values:
            continue
        log = min(values) >= 0 and max(values) > 0
        p = chart.panel(280, "h/dx", figure.replace("_", " "), x, Axis(values, log), right=130)
        for i, kernel in enumerate(one(mine, "kernel")):
            rs = [r for r in mine if r["kernel"] == kernel]
            p.line([num(r, "h") for r in rs], [num(r, "value") for r in rs], i, kernel.replace("_", " "), size=0.6)
    return finish(chart, name, head)


# ---- forms of solids ----

def forms(name, head, rows):
    chart = start(name, head, "Swegle test of the forms of solids: growth rate over volume")
    x = Axis([num(r, "volume") for r in rows])
    for xsph in one(rows, "xsph"):
        mine = [r for r in rows if r["xsph"] == xsph]
        y = Axis([0] + [num(r, "measured") for r in rows])
        p = chart.panel(220, "volume V/V0", "growth rate, c0/dx", x, y, right=160, title=f"xsph {xsph}")
        for i, form in enumerate(one(mine, "form")):
            rs = [r for r in mine if r["form"] == form]
            p.line([num(r, "volume") for r in rs], [num(r, "measured") for r in rs], i, form.replace("_", " "),
                   size=0.6)
    return finish(chart, name, head)


FIGURES = "case choice x figure value unit"
TABLES = (("atlas_courant", courant, "medium scheme integrator kernel h measured theory ratio"),
          ("atlas_swegle", swegle, "form volume h measured theory"),
          ("atlas_forms", forms, "form xsph volume measured theory"),
          ("atlas_tension", tension, "kernel h cholesky running"),
          ("atlas_pairing", pairing, "kernel h rho measured theory nearest"),
          ("atlas_repulsion", repulsion, "epsilon exponent h lambda measured theory"),
          ("atlas_water", figures, FIGURES), ("atlas_tank", figures, FIGURES), ("atlas_leak", figures, FIGURES),
          ("atlas_precision", figures, FIGURES), ("interpolation", interpolation, "case kernel h figure value"))


def charts(folder):
    for name, draw, columns in TABLES:
        got = tables.read(os.path.join(folder, name + ".csv"))
        if got:
            tables.need(name + ".csv", got[1], columns.split())
            drawn = draw(name, *got)
            yield from drawn if draw is interpolation else [drawn]
        else:
            print(f"charts: {name} passed over: no {folder}/{name}.csv", file=sys.stderr)
