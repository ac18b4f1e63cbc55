#!/usr/bin/env python3
# SPDX-License-Identifier: MIT. Copyright the sph authors.
"""validate_open.py: runs cases of open water and gas and holds them against exact solutions and other methods.

usage: validate_open.py [--quick] [--jobs N] [--only WORD] [--keep] [--tool build/sph]
Writes build/validate_open.csv (name,value,unit,target,ok) and prints the same as a table; validation.py says more. Exit
code 1 if a row with a target misses it. To add cases: a function that takes `add` and `quick`, and its name in CASES.
"""
import math
import sys

from validation import interpolate, main, Run

# what renormalised gradients stand at a surface, where they double the frequency of the shortest waves
RENORMALISED = dict(gradient="renormalised", scheme="weak", cfl=0.5)
TUBE = dict(precision="double", beta=2, gradient="bonet_lok")
L1 = {"density": "L1_density", "pressure": "L1_pressure", "velocity": "L1_velocity", "energy": "L1_energy"}


def last(run, name):
    return run.col(name)[-1]


def order(runs, name):
    """of the error in the spacing, over the runs, each of which has twice the particles along the tube"""
    return math.log2(last(runs[0], name) / last(runs[-1], name)) / (len(runs) - 1)


def tubes(add, quick):
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


def patch(add, quick):
    """B3: the rotating patch at t w = 2, with and without shifting"""
    for shifting in (0, 0.5):
        run = Run("rotating_patch", n=30 if quick else 60, shifting=shifting)
        word = "with" if shifting else "without"
        add(f"B3 {word} shifting nearest pair", "dx", (">=", 0.6) if shifting else None, [run],
            lambda r: last(r, "nearest"))
        add(f"B3 {word} shifting longest arm", "sides", None, [run], lambda r: last(r, "arm"))
        add(f"B3 {word} shifting pressure in the middle at the start", "of exact", None, [run],
            lambda r: r.col("pressure_middle")[0] / r.col("pressure_start_exact")[0])
        add(f"B3 {word} shifting pressure in the middle", "rho w^2 side^2", None, [run],
            lambda r: last(r, "pressure_middle"))
        add(f"B3 {word} shifting angular momentum lost", "%", None, [run], lambda r: 100 * (1 - last(r, "angular")))


def drop(add, quick):
    """W9: detached particles against alpha and method; at a Courant number of 1 a viscosity of alpha 1 is unstable"""
    for alpha in (1, 0.0025):
        for method in ("plain", "renormalised", "delta"):
            options = dict(RENORMALISED if method == "renormalised" else dict(scheme="weak"),
                           diffusion="hydrostatic" if method == "delta" else "none", n=4 if quick else 8)
            options["cfl"] = 0.25 if alpha == 1 else 0.5
            run = Run("drop", alpha=alpha, **options)
            add(f"W9 alpha {alpha} {method} detached, most", "particles", None, [run], lambda r: max(r.col("detached")))
            add(f"W9 alpha {alpha} {method} detached at the end", "particles", None, [run],
                lambda r: last(r, "detached"))


def dam(add, quick):
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


CASES = [tubes, patch, drop, dam]


def cases(quick):
    rows = []

    def add(name, unit, target, runs, figure):
        rows.append((name, unit, target, runs, figure))

    for of in CASES:
        of(add, quick)
    return rows


if __name__ == "__main__":
    sys.exit(main(cases, "validate_open", __doc__))
