#!/usr/bin/env python3
# SPDX-License-Identifier: MIT. Copyright the sph authors.
"""validate_open.py: runs the scenes of open water with inflows, plates and gates, and holds them against what is exact,
against volume-of-fluid runs, and against Gray's thesis (2001).

usage: validate_open.py [--quick] [--jobs N] [--only WORD] [--keep] [--tool build/sph]
Writes build/validate_open.csv (name,value,unit,target,ok) and prints the same as a table; validation.py says more.
Exit code 1 if a row with a target misses it. A family of rows is a function in FAMILIES.
"""
import math
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
    # with an inflow 3 depths before a plate as high or higher the jet is up to 2 degrees too steep
    for w in (0.25, 0.5, 1, 1.5, 2, 3):
        for n in (20,) if quick else (20, 50):
            fine = {} if n == 20 else dict(shepard=20)  # spray of the first impact loses its density without a filter
            run = Run("weir", w=w, n=n, **fine)
            yield f"G8 w={w} n={n} angle", "degrees off exact", 2.0, [run], weir_off


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
    for n, d2, lift in ((n, d2, lift) for n in ((30,) if quick else (30, 60)) for d2 in vof for lift in (0, 2)):
        floor, middle = vof[d2]
        run = Run("caldera_wave", whole="yes", width=0.4, d2=d2, n=n, duration=0.4, every=0.004, lift=lift)
        how = "gate gone at once" if lift == 0 else f"gate lifted at {lift} m/s"
        yield f"G9 d2={d2} n={n} {how}: lands", f"s (vof {floor})", None, [run], lands
        yield f"G9 d2={d2} n={n} {how}: jets meet", f"s (vof {middle})", None, [run], meets_at
        yield f"G9 d2={d2} n={n} {how}: meeting's height", "m", None, [run], height_of_meeting
        yield (f"G9 d2={d2} n={n} {how}: asymmetry", "m", None, [run],
               lambda r: max(abs(x) for x in r.col("asymmetry")))


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
        run = Run("caldera_wave", width=w, d2=0.125, n=30, every=0.01, cfl=1.2)
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
    """time and surface (m over the floor) of the first and highest crest that passes place k"""
    t, y = run.col("time"), run.col(f"surface_{k + 1}")
    top = max(range(len(y)), key=lambda i: y[i])
    return t[top], y[top]


def train_speed(run):
    (t0, _), (t1, _) = first_crest(run, 0), first_crest(run, 3)
    return (AT[3] - AT[0]) / (t1 - t0)


def train_amplitude(run):
    """half of the rise from the trough before the first crest, which goes on water that is drawn down"""
    t, y = run.col("time"), run.col("surface_3")
    at, top = first_crest(run, 2)
    return 0.5 * (top - min(v for now, v in zip(t, y) if now < at))


def trains(quick):
    for n in (15,) if quick else (15, 30):
        run = Run("wave_train", n=n, every=0.02)
        yield f"G11 n={n} first wave: speed", "m/s (Gray 1.1, vof 1.2)", None, [run], train_speed
        yield f"G11 n={n} first wave: amplitude", "m (Gray 0.039, vof 0.03 to 0.05)", None, [run], train_amplitude


# ---- gas, patches, drops, a dam break ----

# what renormalised gradients stand at a surface, where they double the frequency of the shortest waves
RENORMALISED = dict(gradient="renormalised", scheme="weak", cfl=0.5)
TUBE = dict(precision="double", beta=2, gradient="bonet_lok")
L1 = {"density": "L1_density", "pressure": "L1_pressure", "velocity": "L1_velocity", "energy": "L1_energy"}


def last(run, name):
    return run.col(name)[-1]


def order(runs, name):
    """of the error in the spacing, over the runs, each of which has twice the particles along the tube"""
    return math.log2(last(runs[0], name) / last(runs[-1], name)) / (len(runs) - 1)


def add_widths(add, along):
    """plain gradients with one smoothing length and with one of each particle"""
    tube = dict(precision="double", beta=2, kernel="wendland_c4")
    for word, one in (("one h", "no"), ("variable h", "yes")):
        sod = [Run("sod", n=n, variable_h=one, **tube) for n in along]
        for q, name in L1.items():
            add(f"B5 sod plain {word} {q} error n={along[-1]}", "L1", None, [sod[-1]],
                lambda r, name=name: last(r, name))
            target = (">=", 0.9) if one == "yes" else None
            add(f"B5 sod plain {word} {q} order in dx", "-", target, sod, lambda *r, name=name: order(r, name))
        add(f"B5 sod plain {word} shock off", "supports", 1 if one == "yes" else None, [sod[-1]],
            lambda r: abs(last(r, "shock_m") - last(r, "shock_exact")) * along[-1] / 4)
        for n in (100, 200):
            wide = Run("shock_tube", precision="double", n=n, rho_left=8, rho_right=1, e_left=1, e_right=1, beta=2,
                       variable_h=one)
            for q, name in L1.items():
                add(f"W2 1:8 gamma 1.4 plain {word} n={n} {q}", "L1", None, [wide], lambda r, name=name: last(r, name))


def add_tubes(add, quick):
    """B5, W2: shock tubes beside the exact solution; the last time is before waves reach the ends"""
    along = [200, 400, 800] if quick else [400, 800, 1600]
    sod = [Run("sod", n=n, **TUBE) for n in along]
    for q, name in L1.items():
        add(f"B5 sod {q} error n={along[-1]}", "L1", None, [sod[-1]], lambda r, name=name: last(r, name))
        add(f"B5 sod {q} order in dx", "-", (">=", 0.9), sod, lambda *r, name=name: order(r, name))
    dx = 1 / along[-1]
    add("B5 sod contact off", "supports", 1, [sod[-1]],
        lambda r: abs(last(r, "contact_m") - last(r, "contact_exact")) / (4 * dx))
    add("B5 sod shock off", "supports", 1, [sod[-1]],
        lambda r: abs(last(r, "shock_m") - last(r, "shock_exact")) / (4 * dx))
    add("B5 sod mass", "share lost", 1e-14, [sod[-1]], lambda r: abs(last(r, "mass") / r.col("mass")[0] - 1))
    add("B5 sod momentum less the ends' push", "kg m/s", 1e-12, [sod[-1]], lambda r: abs(last(r, "momentum")))
    halves = [Run("sod", n=400, cfl=c, **TUBE) for c in (0.3, 0.15, 0.075)]
    for c, r in zip((0.3, 0.15, 0.075), halves):
        add(f"B5 sod energy cfl={c}", "share lost", None, [r],
            lambda r: abs(last(r, "energy_of_gas") / r.col("energy_of_gas")[0] - 1))
        add(f"B5 sod least rise of entropy cfl={c}", "c_v", (">=", -1e-5), [r], lambda r: last(r, "entropy_least"))
    add_widths(add, along)
    for ratio in (2, 8) if quick else (2, 4, 8):
        for gamma in ("1.4", "1.6666666666666667"):
            for gradient in ("plain", "bonet_lok", "renormalised"):
                run = Run("shock_tube", precision="double", n=100, rho_left=ratio, rho_right=1, e_left=1, e_right=1,
                          beta=2, gradient=gradient, gamma=gamma)
                for q, name in L1.items():
                    add(f"W2 1:{ratio} gamma {gamma[:4]} {gradient} {q}", "L1", None, [run],
                        lambda r, name=name: last(r, name))
                add(f"W2 1:{ratio} gamma {gamma[:4]} {gradient} contact off", "supports", 1, [run],
                    lambda r: abs(last(r, "contact_m") - last(r, "contact_exact")) / 0.04)
                add(f"W2 1:{ratio} gamma {gamma[:4]} {gradient} shock off", "supports", 1, [run],
                    lambda r: abs(last(r, "shock_m") - last(r, "shock_exact")) / 0.04)


def add_patches(add, quick):
    """B3: the rotating patch at t w = 2, with and without shifting"""
    for shifting, pairs, word in ((0, "no", "without"), (0.5, "no", "with"), (0.5, "yes", "with pairs in")):
        run = Run("rotating_patch", n=30 if quick else 60, shifting=shifting, shift_pairs=pairs)
        add(f"B3 {word} shifting nearest pair", "dx", (">=", 0.6) if pairs == "yes" else None, [run],
            lambda r: last(r, "nearest"))
        add(f"B3 {word} shifting longest arm", "sides", None, [run], lambda r: last(r, "arm"))
        add(f"B3 {word} shifting pressure in the middle at the start", "of exact", None, [run],
            lambda r: r.col("pressure_middle")[0] / r.col("pressure_start_exact")[0])
        add(f"B3 {word} shifting pressure in the middle", "rho w^2 side^2", None, [run],
            lambda r: last(r, "pressure_middle"))
        add(f"B3 {word} shifting angular momentum lost", "%", None, [run], lambda r: 100 * (1 - last(r, "angular")))


def add_drops(add, quick):
    """W9: detached particles against alpha and method; at a Courant number of 1 a viscosity of alpha 1 is unstable"""
    for alpha in (1, 0.0025):
        for method in ("plain", "renormalised", "delta"):
            options = dict(RENORMALISED if method == "renormalised" else dict(scheme="weak"),
                           diffusion="hydrostatic" if method == "delta" else "none", n=4 if quick else 8)
            options["cfl"] = 0.25 if alpha == 1 else 0.5
            run = Run("drop", alpha=alpha, **options)
            add(f"W9 alpha {alpha} {method} most detached", "particles", None, [run], lambda r: max(r.col("detached")))
            add(f"W9 alpha {alpha} {method} detached at the end", "particles", None, [run],
                lambda r: last(r, "detached"))


def add_dams(add, quick):
    """W3: fronts at 1.1 and 2.2 s beside volume of fluid (instant gate); printed 39.0, 62.5, measured 33.3, 56.2 m"""
    for wall in ("adami", "adami_no_slip"):
        for gradient in ("plain", "renormalised"):
            options = dict(RENORMALISED if gradient == "renormalised" else {}, **(dict(n=20) if quick else {}))
            run = Run("dam_break_wick", wall=wall, every=0.11, **options)
            for t in (1.1, 2.2):
                target = 3 if wall == "adami" and gradient == "plain" else None
                add(f"W3 {wall} {gradient} L at {t} s", "m", None, [run],
                    lambda r, t=t: interpolate(r.col("time"), r.col("front_m"), t - 1e-9))
                add(f"W3 {wall} {gradient} L at {t} s off volume of fluid", "%", target, [run],
                    lambda r, t=t: 100 * abs(interpolate(r.col("time"), r.col("front_m"), t - 1e-9) /
                                             interpolate(r.col("time"), r.col("front_fluid_volume"), t - 1e-9) - 1))


def rows_of(*functions):
    """families of rows from functions that add them one by one"""
    def family(quick, of):
        rows = []
        of(lambda *row: rows.append(row), quick)
        return rows
    return [lambda quick, of=of: family(quick, of) for of in functions]


FAMILIES = [weirs, jets, runups, trains] + rows_of(add_tubes, add_patches, add_drops, add_dams)


def cases(quick):
    return [row for family in FAMILIES for row in family(quick)]


if __name__ == "__main__":
    sys.exit(main(cases, "validate_open", __doc__))
