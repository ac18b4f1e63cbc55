#!/usr/bin/env python3
# SPDX-License-Identifier: MIT. Copyright the sph authors.
"""validate_waves.py: runs the wave cases and holds them against potential flow.

usage: validate_waves.py [--quick] [--jobs N] [--only WORD] [--keep] [--tool build/sph]
Writes build/validate_waves.csv (name,value,unit,target,ok) and prints the same as a table; validation.py says more.
Exit code 1 if a row with a target misses it. Costs are steps times particles of the run, in millions: they do not
depend on the machine.
"""
import sys

from validation import interpolate, main, read_table, Run, slope

DEPTH = 0.2  # m, of the scene
# the cheapest setting that keeps an exact wave as wanted; and a quarter of its cost
CHEAPEST = dict(gradient="bonet_lok", n=10, sound=7, alpha=0)
QUARTER = dict(CHEAPEST, n=6)


class Wave(Run):
    """a run of the scene, which says what it cost"""

    def __init__(self, **options):
        super().__init__("solitary", **options)

    def command(self, tool):
        return super().command(tool) + [f"cost={self.prefix()}.cost"]

    def cost(self):
        with open(self.prefix() + ".cost") as f:
            rows = dict(line.split(",")[:2] for line in f)
        return float(rows["particle_steps"]) / 1e6


def height_loss(run):
    """% of the amplitude, by column mass, over the run"""
    return 100 * abs(run.col("crest_m")[-1] / (0.3 * DEPTH) - 1)


def surface_loss(run):
    return 100 * abs(run.col("crest_surface_m")[-1] / (0.3 * DEPTH) - 1)


def mean_speed(run):
    """% off the exact wave's, from where it is at the end"""
    t, x = run.col("time"), run.col("crest_x_m")
    return 100 * abs((x[-1] - x[0]) / t[-1] / run.col("speed_exact")[-1] - 1)


def runup(run, e):
    """% off potential flow; the highest surface at the wall"""
    exact = interpolate(*[[float(r[k]) for r in read_table("wave_runup_summary.csv")] for k in ("e", "R")], e)
    return 100 * abs(max(run.col("right_wall")) / DEPTH / exact - 1)


def between(run, name, low, high):
    return [(t, v) for t, v in zip(run.col("time"), run.col(name)) if low <= t <= high]


def mound_speed(run, exact):
    points = between(run, "crest_x_m", 3, 7)
    return 100 * abs(slope([p[0] for p in points], [p[1] for p in points]) / exact - 1)


def mound_height(run, exact, t=5):
    return 100 * abs(interpolate(run.col("time"), run.col("crest_m"), t) / exact - 1)


def drift(run, name):
    return run.col(name)[-1] / run.col(name)[0] - 1


def cases(quick):
    rows = []

    def add(name, unit, target, runs, figure):
        rows.append((name, unit, target, runs, figure))

    # G3: run-up of exact waves on a vertical wall
    for e in (0.1, 0.3) if quick else (0.1, 0.2, 0.3, 0.4, 0.5):
        run = Wave(height=e, length=16, travel=10, every=0.01, gradient="bonet_lok", n=16)
        add(f"G3 e={e} run-up corrected n=16", "% of potential flow", 2.0, [run], lambda r, e=e: runup(r, e))
    # W4: an exact wave goes 20 depths: methods beside each other, then the cheapest setting
    methods = {"corrected cheapest": CHEAPEST, "corrected quarter cost": QUARTER,
               "corrected c 10 alpha 0.001": dict(gradient="bonet_lok", n=10),
               "plain": dict(n=10), "weak": dict(n=10, scheme="weak"),
               "renormalised": dict(n=10, gradient="renormalised"),
               "large eddies corrected": dict(n=10, gradient="bonet_lok", alpha=0, shear="smagorinsky")}
    for name, options in methods.items():
        run, ours = Wave(**options), options is CHEAPEST
        add(f"W4 exact wave e=0.3 20 depths {name}: height", "% of amplitude", 1.0 if ours else None, [run],
            height_loss)
        add(f"W4 exact wave e=0.3 20 depths {name}: surface", "% of amplitude", 1.0 if ours else None, [run],
            surface_loss)
        add(f"W4 exact wave e=0.3 20 depths {name}: speed", "%", 0.5 if ours else None, [run], mean_speed)
        add(f"W4 exact wave e=0.3 20 depths {name}: cost", "M particle-steps", None, [run], lambda r: r.cost())
    # W4: Wickramarachchi's mounds (wave_wick_mounds.csv; k and B in depths), between symmetry ends: beside an end of
    # Adami's kind corrected water grows noisy behind some 35 sqrt(D/g)
    for depth, k, b, speed, height in ((0.15, 2.5, 0.07, 1.333, 0.02717), (0.20, 2.5, 0.07, 1.477, 0.02323),
                                       (0.20, 1.5, 0.25, 1.831, 0.1361))[:1 if quick else 3]:
        length = 16 / depth if k < 2 else 12 / depth
        run = Wave(start="mound", depth=depth, length=length, mound_b=b / depth, mound_k=k * depth, every=0.05, end=7,
                   sides="symmetry", **dict(CHEAPEST, alpha=0.001))
        name = f"W4 mound H={depth} k={k}"
        add(f"{name}: speed over 3 to 7 s", "% of potential flow", 3.0, [run],
            lambda r, v=speed: mound_speed(r, v))
        add(f"{name}: height at 5 s", "% of potential flow", 3.0, [run], lambda r, h=height: mound_height(r, h))
    # W10: water at rest for 10 s (Wickramarachchi 6.5): his methods, with his filter and without
    still = {"SPH": dict(diffusion="none"), "weak": dict(diffusion="none", scheme="weak"),
             "R-SPH": dict(diffusion="none", gradient="renormalised"),
             "LES": dict(diffusion="none", alpha=0, shear="smagorinsky"), "delta-SPH": {},
             "delta-SPH corrected": dict(gradient="bonet_lok")}
    for name, options in still.items():
        for shepard in (0, 40):
            run = Run("still_water", n=10, frames=20, **options, **(dict(shepard=shepard) if shepard else {}))
            tag = f"W10 still water {name}, {'filter' if shepard else 'no filter'}"
            best = name.startswith("delta") and not shepard
            add(f"{tag}: level", "% of depth in 10 s", 0.5 if best else None, [run],
                lambda r: 100 * abs(drift(r, "twice_centre_m")))
            add(f"{tag}: mean density", "% off", 1.0, [run], lambda r: 100 * abs(drift(r, "density_mean")))
            add(f"{tag}: fluctuation of density", "% of rho0", None, [run],
                lambda r: 100 * max(r.col("density_rms")[1:]) / 1000)
            add(f"{tag}: largest speed at the end", "% of sqrt(g H)", None, [run],
                lambda r: 100 * r.col("max_speed")[-1] / (9.81 * 0.15) ** 0.5)
    return rows


if __name__ == "__main__":
    sys.exit(main(cases, "validate_waves", __doc__))
