#!/usr/bin/env python3
# SPDX-License-Identifier: MIT. Copyright the sph authors.
"""validate_solids.py: runs the cases of solids and holds them against Gray (2001), finite elements and exact solutions.

usage: validate_solids.py [--quick] [--jobs N] [--only WORD] [--keep] [--tool build/sph]
As validate.py, whose runs and table it shares; writes build/validate_solids.csv. Each group of cases is a function in GROUPS
that takes add(name, unit, target, runs, figure): the figure is called with the finished runs and returns a number; a target is
None, a number that the figure may not exceed, or a pair such as (">=", 3). Long studies: --only WORD --keep goes on where an
earlier call was ended. Times are in cm/c0 and lengths in cm unless a row says otherwise.
"""
import sys

from validate import Run, interpolate, main, read_table, slope, zero_crossings


def period(run):
    """Twice the mean time between crossings of the mid-line, from the second on (the first is half a period after the start)."""
    t = zero_crossings(run.col("time"), run.col("tip"))
    t = [x for x in t if x > 1]
    return 2 * (t[-1] - t[0]) / (len(t) - 1) if len(t) > 1 else 2 * t[0]


def swings(run):
    """Largest deflection between crossings of the mid-line."""
    best, sign = [], 0
    for y in run.col("tip"):
        if sign * y <= 0 and abs(y) > 1e-6:
            best.append(0.0)
            sign = 1 if y > 0 else -1
        if best:
            best[-1] = max(best[-1], abs(y))
    return best


def plates(quick, add):
    """G15: periods of the clamped plate against plane-strain finite elements; G16: with plasticity."""
    fe = {(float(r["H"]), float(r["mu"])): r for r in read_table("fe_plate_periods.csv")}
    gray = {(float(r["H"]), float(r["Vf"]), float(r["mu"])): r for r in read_table("gray_plate_periods.csv")}
    for (thick, speed, mu), row in gray.items():
        if quick and not (thick == 2 and speed in (0.001, 0.05) and mu == 0.22):
            continue
        n = 10 if quick or thick == 1 else 20
        run = Run("plate", thick=thick, mu=mu, speed=speed, n=n, cycles=0.6, every=10)
        ref = float(fe[thick, mu]["T_A"])
        tag = f"G15 H {thick:g} mu {mu:g} Vf {speed:g} n={n} period"
        add(f"{tag} against finite elements", "%", 2.0 if n == 20 or thick == 1 else None, [run],
            lambda r, ref=ref: 100 * abs(period(r) / ref - 1))
        add(f"{tag}; thesis {row['T_sph']}, finite elements {ref:g}", "cm/c0", None, [run], period)
    n = 10
    for clamp, kind in (("surfaces", "T_B"), ("ideal", "T_A")):
        run = Run("plate", speed=0.001, n=n, clamp=clamp, cycles=0.6, every=10)
        add(f"G15 H 2 mu 0.22 n={n} clamp {clamp} period against finite elements", "%", None, [run],
            lambda r, k=kind: 100 * abs(period(r) / float(fe[2.0, 0.22][k]) - 1))
    for size in (10,) if quick else (10, 20, 40):
        run = Run("plate", speed=0.001, n=size, cycles=0.6, every=10)
        add(f"G15 H 2 mu 0.22 n={size} period against finite elements", "%", None, [run],
            lambda r: 100 * abs(period(r) / float(fe[2.0, 0.22]["T_A"]) - 1))
    long = Run("plate", n=n, speed=0.01, cycles=1.2 if quick else 3.4, every=20)
    add(f"G15 H 2 mu 0.22 n={n} amplitude loss, {'two swings' if quick else 'three cycles'}", "%", 5.0, [long],
        lambda r: 100 * (1 - swings(r)[-2 if len(swings(r)) > 2 else -1] / swings(r)[0]))
    add(f"G15 H 2 mu 0.22 n={n} drift of the energy", "%", 0.1, [long], lambda r: 100 * max(abs(e - 1) for e in r.col("energy")))
    if not quick:
        ten = Run("plate", n=8, speed=0.001, cycles=10.5, every=50, precision="double")
        add("G15 n=8 double drift of the energy over ten periods, no viscosity", "%", 0.1, [ten],
            lambda r: 100 * max(abs(e - 1) for e in r.col("energy")))
    # Gray's own settings: without artificial stress the plate breaks at the clamp
    own = dict(form="updated", kernel="cubic", h=1.5, alpha=0.5, integrator="predictor_corrector", cfl=0.25, n=10, mu=0.6, speed=0.05,
               clamp="surfaces", cycles=0.8, every=10)
    for repulsion in ("none", "principal"):
        run = Run("plate", repulsion=repulsion, **own)
        add(f"G15 thesis's settings, artificial stress {repulsion}: closest pair", "dx", None, [run], lambda r: min(r.col("closest")))
        add(f"G15 thesis's settings, artificial stress {repulsion}: period", "cm/c0", None, [run],
            lambda r: period(r) if [x for x in zero_crossings(r.col("time"), r.col("tip")) if x > 1] else float("nan"))
    # G16: plastic plate
    elastic = Run("plate", n=10, mu=0.6, speed=0.05, cycles=1.3, every=10)
    plastic = Run("plate", n=10, mu=0.6, speed=0.05, **{"yield": 0.06}, cycles=1.3, every=10)
    printed = Run("plate", n=10, mu=0.6, speed=0.05, **{"yield": 0.06}, printed="yes", cycles=1.3, every=10)
    for name, run in (("plastic", plastic), ("plastic as printed (5.14, 5.15)", printed)):
        add(f"G16 first amplitude, {name} over elastic", "ratio", (">=", 1.0) if run is printed else None, [run, elastic],
            lambda a, b: swings(a)[0] / swings(b)[0])
        add(f"G16 time of the first return to the mid-line, {name} over elastic", "ratio", (">=", 1.0), [run, elastic],
            lambda a, b: first_return(a) / first_return(b))
    add("G16 permanent upward set, as printed: mean of the tip's extremes after the first", "cm", (">=", 0.01), [printed],
        lambda r: 0.5 * (max(late(r)) + min(late(r))))
    rough = dict(own, clamp="ideal", cycles=0.6, repulsion="principal", printed="yes")
    soft, stiff = Run("plate", **{"yield": 0.06}, **rough), Run("plate", **rough)
    add("G16 thesis's settings: first amplitude, plastic over elastic", "ratio", None, [soft, stiff], lambda a, b: swings(a)[0] / swings(b)[0])
    add("G16 permanent upward set: mean of the tip's extremes after the first", "cm", (">=", 0.01), [plastic],
        lambda r: 0.5 * (max(late(r)) + min(late(r))))
    add("G16 the same of the elastic plate", "cm", None, [elastic], lambda r: 0.5 * (max(late(r)) + min(late(r))))
    add("G16 plastic work over energy at the start", "%", None, [plastic], lambda r: 100 * r.col("plastic")[-1] / r.col("kinetic")[0])
    add("G16 energy left over: books", "%", 1.0, [plastic], lambda r: 100 * abs(r.col("energy")[-1] - 1))


def first_return(run):
    """When the tip first comes back to where it began; the run's end where it does not."""
    t = [x for x in zero_crossings(run.col("time"), run.col("tip")) if x > 1]
    return t[0] if t else run.col("time")[-1]


def late(run):
    """The tip's way after half of the run."""
    y = run.col("tip")
    return y[len(y) // 2:]


GROUPS = [plates]


def cases(quick):
    rows = []
    for group in GROUPS:
        group(quick, lambda name, unit, target, runs, figure: rows.append((name, unit, target, runs, figure)))
    return rows


if __name__ == "__main__":
    sys.exit(main(cases, "validate_solids", __doc__))
