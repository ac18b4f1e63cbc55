#!/usr/bin/env python3
# SPDX-License-Identifier: MIT. Copyright the sph authors.
"""validate_open.py: runs the scenes of open water with inflows, plates and gates, and holds them against what is exact,
against volume-of-fluid runs, and against Gray's thesis (2001).

usage: validate_open.py [--quick] [--jobs N] [--only WORD] [--keep] [--tool build/sph]
Writes build/validate_open.csv (name,value,unit,target,ok) and prints the same as a table; validation.py says more.
Exit code 1 if a row with a target misses it. A family of rows is a function in FAMILIES.
"""
import sys

from validation import interpolate, main, Run

DEPTH = 0.3  # m, of the scenes of calderas


def mean_of(values):
    return sum(values) / len(values)


# ---- G8: the angle of a jet over a weir ----

def weir_off(run):
    """degrees that the jet's angle is off the exact one, mean of the last third of the run"""
    t, angle, exact = run.col("time"), run.col("angle_deg"), run.col("angle_exact")
    if run.error:
        raise ValueError(run.error)
    late = [a for a, now in zip(angle, t) if now >= 2 / 3 * t[-1]]
    return abs(mean_of(late) - exact[-1])


def weirs(quick):
    sizes = (20,) if quick else (20, 30)
    for w in (0.25, 0.5, 1, 1.5, 2, 3):
        for n in sizes if w in (0.25, 1, 3) else sizes[:1]:
            yield f"G8 w={w} n={n} angle", "degrees off exact", 2.0, [Run("weir", w=w, n=n)], weir_off


# ---- G9: the jets of a whole tank ----

def first_time(run, column, below):
    t, x = run.col("time"), run.col(column)
    for a, b, x0, x1 in zip(t, t[1:], x, x[1:]):
        if x0 > below >= x1:
            return a + (b - a) * (x0 - below) / (x0 - x1)
    raise ValueError("never")


def lands(run):
    """s: the lowest particle is half a spacing above where it would touch the floor"""
    return first_time(run, "lowest", 0.5 * DEPTH / run.options["n"])


def meets_at(run):
    return first_time(run, "tip_m", 0.5 * DEPTH / run.options["n"])


def height_of_meeting(run):
    """m above the floor, when the tips meet"""
    return interpolate(run.col("time"), run.col("tip_height"), meets_at(run))


def jets(quick):
    vof = {0.05: (0.104, 0.151), 0.12: (0.158, 0.187), 0.17: (0.191, 0.217)}
    n = 30 if quick else 60
    for d2, (floor, middle) in vof.items():
        for lift in (0, 2):
            run = Run("caldera_wave", whole="yes", width=0.4, d2=d2, n=n, duration=0.4, every=0.004, lift=lift)
            how = "gate gone at once" if lift == 0 else f"gate lifted at {lift} m/s"
            yield f"G9 d2={d2} {how}: lands", f"s (vof {floor})", None, [run], lands
            yield f"G9 d2={d2} {how}: jets meet", f"s (vof {middle})", None, [run], meets_at
            yield f"G9 d2={d2} {how}: meeting's height", "m", None, [run], height_of_meeting
        run = Run("caldera_wave", whole="yes", width=0.4, d2=d2, n=n, duration=0.4, every=0.004, lift=0)
        yield f"G9 d2={d2} asymmetry", "m", None, [run], lambda r: max(abs(x) for x in r.col("asymmetry"))


# ---- G10: run-up of half a tank ----

def runup(run):
    if run.error:
        raise ValueError(run.error)
    return max(run.col("R/D_-"))


PRINTED = dict(kernel="cubic", h=1.2, alpha=0.01, xsph=0.5, integrator="predictor_corrector", cfl=0.5, floor="no",
               diffusion="none", wall="ghost_compressible")


def runups(quick):
    printed = {0.05: 1.07, 0.15: 1.17, 0.25: 1.09, 0.40: 1.00}
    vof = {0.05: 1.12, 0.25: 1.18}
    for w, value in printed.items():
        run = Run("caldera_wave", width=w, d2=0.125, n=30, every=0.01)
        gray = Run("caldera_wave", width=w, d2=0.125, n=30, every=0.01, **PRINTED)
        beside = f"R/D (Gray {value}, vof {vof[w]})" if w in vof else f"R/D (Gray {value})"
        yield f"G10 W={w} n=30 run-up", beside, None, [run], runup
        if w in vof:
            yield (f"G10 W={w} n=30 off volume of fluid", "R/D", 0.05, [run],
                   lambda r, v=vof[w]: abs(runup(r) - v))
        if not quick:
            yield f"G10 W={w} printed settings", "R/D off Gray's", 0.05, [gray], lambda r, v=value: abs(runup(r) - v)


# ---- G11: a train of waves ----

AT = [3.8 * x for x in (0.5, 0.625, 0.75, 0.875)]


def first_crest(run, k):
    """time and height (m over the mean surface of the second before) of the first crest that passes place k"""
    t, y = run.col("time"), run.col(f"surface_{k + 1}")
    top = max(range(len(y)), key=lambda i: y[i])
    return t[top], y[top]


def train_speed(run):
    (t0, _), (t1, _) = first_crest(run, 0), first_crest(run, 3)
    return (AT[3] - AT[0]) / (t1 - t0)


def train_height(run):
    """crest over the surface that was there before the wave"""
    t, y = run.col("time"), run.col("surface_3")
    crest = first_crest(run, 2)
    before = [v for now, v in zip(t, y) if 0.1 < now < 0.4]
    return crest[1] - mean_of(before)


def trains(quick):
    run = Run("wave_train", n=20 if quick else 30, every=0.02)
    yield "G11 first wave: speed", "m/s (Gray 1.1, vof 1.2)", None, [run], train_speed
    yield "G11 first wave: height over still water", "m (Gray 0.039, vof 0.03 to 0.05)", None, [run], train_height


FAMILIES = [weirs, jets, runups, trains]


def cases(quick):
    return [row for family in FAMILIES for row in family(quick)]


if __name__ == "__main__":
    sys.exit(main(cases, "validate_open", __doc__))
