#!/usr/bin/env python3
# SPDX-License-Identifier: MIT. Copyright the sph authors.
"""page.py: the lab as one static page, from the tables and the charts that are there.

usage: page.py [--tables tests/lab] [--charts tests/lab/charts] [--readme]

Writes TABLES/index.html; --readme prints its table "your scene -> choose this" as markdown instead. Every sentence with
a figure in it is worked out from the tables: what is chosen, what a halving of the error costs, and where it is not
known.
"""
import argparse, html, os, re, sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, HERE)
import tables  # noqa: E402

# study: the kind of scene it stands for
KINDS = {
    "hydrostatic": "Water at rest: the pressure in a column",
    "still_tank": "Water at rest between walls, in two dimensions",
    "dam_break": "Water that runs and splashes: fronts, violent flow",
    "impact": "Water that hits a wall: how quiet the pressure is",
    "impact_peak": "Water that hits a wall: the largest pressure",
    "impact_mean": "Water that hits a wall: the pressure after the impact",
    "impact_levels": "Water that hits a wall: levels",
    "dam_break_3d": "Water that runs, in three dimensions: fronts",
    "obstacle": "Water around a body, in three dimensions: levels",
    "obstacle_peaks": "Water around a body, in three dimensions: pressures on it",
    "taylor_green": "Viscous flow without a surface",
    "standing_wave": "Waves on water: periods and decay",
    "elliptical_drop": "Free water without walls: drops, jets",
    "pulse": "Waves in solids: their speed",
    "pulse_amplitude": "Waves in solids: what is lost of them",
    "rings": "Solids that collide and deform",
    "plate": "Bending and swinging of slender solids",
    "beam": "Slender solids clamped at both ends",
    "csm3": "Slender solids that swing far: how far",
    "csm3_frequency": "Slender solids that swing far: how fast",
    "hole": "Stress at holes and notches",
}
ATLAS = (
    ("atlas_courant", "How long a time step may be",
     "Largest stable Courant number of every integrator, scheme and smoothing kernel: runs against linear theory."),
    ("atlas_swegle", "Where pushes grow",
     "Growth of a tiny push over volume strain and h/dx, in runs and by linear theory. White is stable."),
    ("atlas_forms", "Where pushes grow, by form",
     "The same push in every form of solids at h 1.3 dx, with and without smoothed velocities."),
    ("atlas_tension", "How far a chain can be stretched",
     "Critical stretch of thirty particles, by Cholesky and by running the code."),
    ("atlas_pairing", "Pairing in compression",
     "Particles that come together in pairs where there are many neighbours."),
    ("atlas_repulsion", "What artificial stress does to tension",
     "Growth against its size epsilon, its exponent n and h."),
    ("atlas_water", "Water under negative pressure",
     "Voids and clumps, and what a floor, diffusion or a filter does about them."),
    ("atlas_tank", "A still tank for a long time", "Disorder by kind of wall."),
    ("atlas_leak", "Walls that leak", "Water thrown at a wall: what gets through, by kind of wall."),
    ("atlas_precision", "Float and double part",
     "When runs of the same scene in float and in double are no longer the same."),
    ("interpolation", "Interpolation of fields",
     "Error of a constant and of a gradient, and pairs, against h/dx for every smoothing kernel."),
)
STYLE = """
body { font: 1rem/1.5 system-ui, sans-serif; color: #111; background: #fff; }
body { margin: 0 auto; padding: 0 1rem 4rem; max-width: 46rem; }
h1 { font-size: 1.6rem; line-height: 1.2; }
h2 { font-size: 1.25rem; margin-top: 3rem; border-top: 2px solid #111; padding-top: .8rem; }
h3 { font-size: 1rem; margin-top: 1.6rem; }
img { display: block; width: 100%; max-width: 640px; height: auto; margin: 1rem 0; }
code { font: .85em ui-monospace, monospace; overflow-wrap: anywhere; }
.wide { overflow-x: auto; } table { border-collapse: collapse; font-size: .88rem; width: 100%; }
th, td { text-align: left; vertical-align: top; padding: .35rem .6rem .35rem 0; border-bottom: 1px solid #bbb; }
a { color: #003a8c; } .small { color: #444; font-size: .88rem; }
@media (max-width: 600px) {
  img { width: calc(100% + 2rem); max-width: none; margin-left: -1rem; }
  table.stack thead { display: none; } table.stack tr { display: block; border-bottom: 2px solid #777; padding: .5rem 0;
  } table.stack td { display: block; border: 0; padding: .1rem 0; }
  table.stack td::before { content: attr(data-name) ": "; color: #444; }
  table.stack td:empty { display: none; }
  table.stack td:first-child { font-weight: bold; } table.stack td:first-child::before { content: ""; }
}
@media print { body { max-width: none; } h2 { break-before: page; } }
"""


# ---- figures in words ----

def unit(study):
    return study.unit.split(" ")[0]


def figure(v, study):
    return f"{v:.3g} {unit(study)}"


def count(v):
    """1.23 million, 4.5 thousand million: read aloud, not counted in digits"""
    for size, name in ((1e12, "T"), (1e9, "G"), (1e6, "M"), (1e3, "k")):
        if v >= size:
            return f"{v / size:.3g} {name}"
    return f"{v:.3g}"


def cost_of(study):
    return next((c for c in tables.COSTS if study.front(c)), None)


def chosen(study):
    """The cheapest run whose error is at most twice the smallest known one, and that one."""
    front = study.front(cost_of(study))
    return tables.cheapest(front, 2 * front[-1]["error"]), front[-1]


def halving_words(study):
    cost = cost_of(study)
    front = study.front(cost)
    factor = tables.halving(front, cost)
    if factor:
        return f"{factor:.2g} times the {cost}, down to {figure(front[-1]['error'], study)}; beyond is not known"
    if front[0]["error"] < 2 * front[-1]["error"]:
        return "not known: no halving was reached"
    return "not known: fewer than three runs on the front"


def ladder(study):
    """The front by halvings of the error: wanted error and the cheapest run that reaches it, from the cheapest run of
    all on."""
    front = study.front(cost_of(study))
    wanted, rungs = front[0]["error"], [(front[0]["error"], front[0])]
    while front[-1]["error"] > 0 and wanted / 2 >= front[-1]["error"]:
        wanted /= 2
        rungs.append((wanted, tables.cheapest(front, wanted)))
    return rungs, wanted / 2


def take_words(study):
    """Which choice to take down to which error: the front's labels in turn."""
    groups = []
    for r in study.front(cost_of(study)):
        name = study.name_of(r).rsplit(",", 1)[0]
        if groups and groups[-1][0] == name:
            groups[-1][1] = r
        else:
            groups.append([name, r])
    return "; ".join(f"<b>{html.escape(name)}</b> down to {figure(r['error'], study)}" for name, r in groups[-6:])


def spans(some, every):
    """1 to 1.3, 1.6: neighbours in `every` run together"""
    groups = []
    for x in sorted(every):
        if x in some and groups and groups[-1][-1] is not None:
            groups[-1].append(x)
        elif x in some:
            groups.append([x])
        else:
            groups.append([None])
    return ", ".join(f"{g[0]:g} to {g[-1]:g}" if len(g) > 1 else f"{g[0]:g}" for g in groups if g[0] is not None)


def h_words(study):
    said = []
    for label in study.labels("h"):
        rows = [r for r in study.sweep("h") if r["label"] == label and r["good"]]
        if rows:
            best = min(rows, key=lambda r: r["error"])
            near = [r["x"] for r in rows if r["error"] <= 2 * best["error"]]
            more = f", within twice that at {spans(near, [r['x'] for r in rows])}" if len(near) > 1 else ""
            said.append(f"{html.escape(label.replace('_', ' '))} is best at h/dx {best['x']:g} "
                        f"({figure(best['error'], study)}{more})")
    return "; ".join(said)


def courant_words(study):
    said = []
    for label in study.labels("courant"):
        rows = sorted((r for r in study.sweep("courant") if r["label"] == label), key=lambda r: r["x"])
        broken = next((r for r in rows if not r["good"]), None)
        fine = [r for r in rows if r["good"] and (not broken or r["x"] < broken["x"])]
        if not fine:
            said.append(f"{html.escape(label)} stood none")
            continue
        kept = fine[0]
        for r in fine:
            if r["error"] > 1.1 * fine[0]["error"]:
                break
            kept = r
        end = f"blows up at {broken['x']:g}" if broken else f"stood all up to {rows[-1]['x']:g}"
        said.append(f"{html.escape(label)} keeps its error up to {kept['x']:g}, {end}")
    return "; ".join(said)


def precision_words(study):
    said = []
    for label in study.labels("precision"):
        double = sorted((r for r in study.sweep("precision") if r["label"] == label and r["good"]), key=study.finer)
        single = {r["n"]: r for r in study.sweep("method") if r["label"] == label and r["good"]}
        both = [(single[d["n"]], d) for d in double if d["n"] in single]
        if not both:
            continue
        worst = max(abs(d["error"] / s["error"] - 1) for s, d in both if s["error"])
        ratios = [d["instructions"] / s["instructions"] for s, d in both if s["instructions"] and d["instructions"]]
        said.append(f"{html.escape(label)}: errors differ by at most {100 * worst:.2g} % of themselves" +
                    (f", double costs {min(ratios):.2g} to {max(ratios):.2g} times the instructions" if ratios else ""))
    return "; ".join(said)


# ---- the page ----

def picture(charts, name, alt, up):
    path = os.path.join(charts, name + ".svg")
    if not os.path.exists(path):
        return ""
    with open(path) as f:
        size = re.search(r'width="(\d+)" height="(\d+)"', f.read(2000))
    w, h = size.groups() if size else ("640", "480")
    place, alt = f"{up}/{name}.svg", html.escape(alt, True)
    return f'<a href="{place}"><img src="{place}" width="{w}" height="{h}" loading="lazy" alt="{alt}"></a>\n'


def row_of(cells, names):
    return "<tr>" + "".join(f'<td data-name="{html.escape(n, True)}">{c}</td>'
                            for n, c in zip(names, cells)) + "</tr>\n"


def table_of(names, rows):
    head = "".join(f"<th>{html.escape(n)}</th>" for n in names)
    body = "".join(row_of(r, names) for r in rows)
    return (f'<div class="wide"><table class="stack"><thead><tr>{head}</tr></thead><tbody>\n'
            f'{body}</tbody></table></div>\n')


def kind(study):
    return KINDS.get(study.name, study.title)


def run_words(study, r):
    return f"{html.escape(study.name_of(r))}<br><code>{html.escape(study.run_line(r))}</code>"


CHOICES = ("your scene", "choose this", "error", "cost", "best known", "half the error costs")


def choice_words(study):
    """What is chosen and the last four columns of CHOICES."""
    take, best = chosen(study)
    cost = cost_of(study)
    times = best[cost] / take[cost]
    same = "this one" if take is best else f"{figure(best['error'], study)} at {times:.2g} times the cost"
    return take, (figure(take["error"], study), f"{count(take[cost])} {cost}", same, halving_words(study))


def choices_table(found):
    rows = []
    for s in found:
        take, words = choice_words(s)
        rows.append((f'<a href="#{s.name}">{html.escape(kind(s))}</a>', run_words(s, take)) + words)
    return table_of(CHOICES, rows)


def section(s, charts, up):
    cost = cost_of(s)
    front = s.front(cost)
    rungs, beyond = ladder(s)
    about = f"{s.title}. Error: {s.norm}, in {s.unit}. Reference: {s.reference}. Resolution: {s.resolution}."
    out = [f'<h2 id="{s.name}">{html.escape(kind(s))}</h2>\n<p class="small">{html.escape(about)}</p>\n',
           f"<p>From cheap to accurate, take {take_words(s)}. Half the error costs {halving_words(s)}.</p>\n"]
    rows, last = [], None
    for wanted, r in rungs:
        times = f"{r[cost] / last[cost]:.2g}" if last else ""
        rows.append((figure(wanted, s), figure(r["error"], s), run_words(s, r), f"{count(r[cost])} {cost}", times))
        last = r
    best = f"best known: {figure(front[-1]['error'], s)}, {html.escape(s.name_of(front[-1]))}"
    rows.append((figure(beyond, s), "not reached", best, f"{count(front[-1][cost])} {cost}", ""))
    out.append(table_of(("at most", "measured", "cheapest run", "cost", "times the cost before"), rows))
    alt = (f"{s.title}: error against cost of {len(s.labels('method'))} methods; the Pareto front goes from "
           f"{figure(front[0]['error'], s)} to {figure(front[-1]['error'], s)}")
    out.append(picture(charts, s.name + "_front", alt, up))
    for name, title, words in (("h", "Neighbours", h_words(s)), ("courant", "Time step", courant_words(s)),
                               ("precision", "Float and double", precision_words(s))):
        if words:
            text = re.sub(r"<[^>]*>", "", html.unescape(words))
            out.append(f"<h3>{title}</h3>\n<p>{words}.</p>\n" + picture(charts, f"{s.name}_{name}",
                f"{s.title}: {text}", up))
    return "".join(out)


def atlas_sections(charts, up):
    out = []
    names = sorted(n[:-4] for n in os.listdir(charts) if n.endswith(".svg")) if os.path.isdir(charts) else []
    for name, title, text in ATLAS:
        mine = [n for n in names if n == name or n.startswith(name + "_")]
        if mine:
            out.append(f'<h3 id="{name}">{title}</h3>\n<p>{text}</p>\n')
            out += [picture(charts, n, f"{title}. {text}", up) for n in mine]
    return "".join(out)


INTRO = """<p>Which smoothing kernel, wall, integrator, resolution? Here every choice was run against a reference, its
error measured and its cost counted. A choice is worth taking if no other known run is as cheap and as good: those are
the Pareto front of a scene. Costs are instructions of the whole run, counted in the default build, and pairs of
particles looked at: both repeat exactly.</p>
<p><code>sph advise SCENE error=2%</code> answers from the same tables on the command line.</p>
"""


def in_order(folder):
    order = list(KINDS)
    return sorted((s for s in tables.studies(folder) if cost_of(s)),
                  key=lambda s: (order.index(s.name) if s.name in order else len(order), s.name))


def make(folder, charts):
    found = in_order(folder)
    up = os.path.relpath(charts, folder).replace(os.sep, "/")
    atlas = atlas_sections(charts, up)
    stages = picture(charts, "stages", "Instructions of a particle-step by stage of the step, a bar each scene", up)
    body = ["<h1>sph: what accuracy costs</h1>\n", INTRO]
    if found:
        body += ["<h2>Your scene: choose this</h2>\n<p>The cheapest run whose error is at most twice the smallest "
                 "known one; what was right by luck, by the other sizes of the same method, is left out. What half the "
                 "error costs is a straight line through the Pareto front in logarithms.</p>\n",
                 choices_table(found)]
    trade = picture(charts, "trade_off", "Error of a front, noise of a pressure, against cost: three choices", up)
    if trade:
        body.append(f'<h2 id="trade">A front, or the pressure on a wall</h2>\n{trade}')
    body += [section(s, charts, up) for s in found]
    if stages:
        body.append(f'<h2 id="stages">Where a step goes</h2>\n{stages}')
    if atlas:
        body.append(f'<h2 id="atlas">Where methods fail</h2>\n{atlas}')
    body.append("<h2>How it is made</h2>\n<p>The tables are in <code>tests/lab</code>, made by <code>make lab</code> "
                "and "
                "<code>make atlas</code>; each row holds the options of its run, each table the command that makes it. "
                "Charts and "
                "this page: <code>make charts</code>.</p>\n")
    return ('<!DOCTYPE html>\n<html lang="en">\n<!-- SPDX-License-Identifier: MIT. Copyright the sph authors. '
            'Made by make charts. -->\n<head>\n<meta charset="utf-8">\n'
            '<meta name="viewport" content="width=device-width, initial-scale=1">\n<title>sph: what accuracy '
            'costs</title>\n'
            f"<style>{STYLE}</style>\n</head>\n<body>\n{''.join(body)}</body>\n</html>\n")


def write(folder, charts):
    path = os.path.join(folder, "index.html")
    with open(path + ".tmp", "w") as f:
        f.write(make(folder, charts))
    os.replace(path + ".tmp", path)
    print(f"page: {path}", file=sys.stderr)


def readme(folder):
    out = ["| " + " | ".join(CHOICES).replace("this", "this (`build/sph run ...`)") + " |", "|---|---|---|---|---|---|"]
    for s in in_order(folder):
        take, words = choice_words(s)
        out.append(f"| {kind(s)} | `{s.run_line(take)[8:]}` | " + " | ".join(words) + " |")
    return "\n".join(out) + "\n"


def main():
    p = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    p.add_argument("--tables", default=os.path.relpath(HERE))
    p.add_argument("--charts", default="", help="the folder of the charts; TABLES/charts unless given")
    p.add_argument("--readme", action="store_true", help="print the table of choices as markdown")
    args = p.parse_args()
    if not os.path.isdir(args.tables):
        sys.exit(f"page: --tables {args.tables}: no such folder")
    if args.readme:
        sys.stdout.write(readme(args.tables))
    else:
        write(args.tables, args.charts or os.path.join(args.tables, "charts"))
    return 0


if __name__ == "__main__":
    sys.exit(main())
