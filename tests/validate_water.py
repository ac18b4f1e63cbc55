#!/usr/bin/env python3
# SPDX-License-Identifier: MIT. Copyright the sph authors.
"""validate_water.py: runs the water cases and holds them against experiments, volume-of-fluid and exact solutions.

usage: validate_water.py [--quick] [--jobs N] [--only WORD] [--keep] [--tool build/sph]
Writes build/validate_water.csv (name,value,unit,target,ok) and prints the same as a table; validation.py says more.
Exit code 1 if a row with a target misses it.
"""
import math, sys

from validation import (box_levels_off, box_peak, front_against_experiment, front_against_vof, impact_mean,
                        impact_noise, impact_peak, levels_off, main, read_table, Run, slope, zero_crossings)


def cases(quick):
    """Rows to be: (name, unit, target or None, runs, figure)."""
    rows = []

    def add(name, unit, target, runs, figure):
        rows.append((name, unit, target, runs, figure))

    # G1: hydrostatic column, every wall kind. The cubic spline's own quadrature error is 2.2 % at h 1.2 (README,
    # findings), so the target is held against the quintic at the same h; ghosts that hold p = 0 are listed without one.
    walls = ("adami", "ghost_compressible", "ghost", "lennard_jones", "kernel_force", "monaghan_kos")
    for n in (50,) if quick else (50, 500):
        for wall in walls:
            for kernel, diffusion in (("cubic", "none"), ("quintic", "none"), ("quintic", "hydrostatic")):
                if n == 500 and (kernel == "cubic" or wall in walls[2:]) or diffusion != "none" and wall in walls[2:]:
                    continue
                run = Run("hydrostatic", n=n, wall=wall, kernel=kernel, diffusion=diffusion)
                ours = kernel == "quintic" and (wall == "adami" or wall == "ghost_compressible" and diffusion != "none")
                add(f"G1 {wall} {kernel} diffusion {diffusion} n={n} largest pressure error", "% of P_bottom",
                    1.0 if ours else None, [run], lambda r: 100 * r.col("pressure_error_max")[-1])
    # G2: still tank
    peak = {}
    for wall in walls + ("adami_no_slip",):
        for diffusion in ("none", "hydrostatic"):
            if diffusion != "none" and wall not in ("adami", "ghost_compressible"):
                continue
            run = Run("still_tank", wall=wall, diffusion=diffusion)
            peak.setdefault(wall, run)
            ours = wall.startswith("adami") or wall == "ghost_compressible" and diffusion != "none"
            add(f"G2 {wall} diffusion {diffusion} surface", "% of depth", 0.5 if ours else None, [run],
                lambda r: 100 * abs(r.col("surface")[-1] / 0.15 - 1))
            add(f"G2 {wall} diffusion {diffusion} rms pressure error", "% of P_bottom", 1.0 if ours else None, [run],
                lambda r: 100 * r.col("pressure_error_rms")[-1])
    for wall in ("adami", "ghost_compressible", "ghost"):
        add(f"G2 peak kinetic energy, kernel_force over {wall}", "ratio", None, [peak["kernel_force"], peak[wall]],
            lambda f, g: max(f.col("kinetic")) / max(g.col("kinetic")))
    # G5: dam break
    exp1 = [(0.69, 1.33), (0.80, 1.44), (1.38, 2.25)]
    # a = 5.72 cm is their 2.25 inch column. The point at T 4.03 lies 6 % off the line through its neighbours.
    mm2 = [(float(r["T"]), float(r["Z"])) for r in read_table("martin_moyce_1952_n2_2.csv")
           if float(r["base_a_inch"]) > 2 and float(r["Z"]) < 8]
    match2 = (1.219, 1.474)
    for n in (30, 60) if quick else (30, 60, 120):
        for n2, table, z_last in ((1, "vof_dam_break_n2_1.csv", 5.0), (2, "vof_dam_break_n2_2.csv", 8.0)):
            for precision in ("float", "double"):
                if precision == "double" and n == 120:
                    continue
                run = Run("dam_break", n=n, n2=n2, precision=precision)
                tag = f"G5 n^2={n2} n={n} {precision}"
                add(f"{tag} front against volume-of-fluid", "%", 3.0, [run],
                    lambda r, t=table, z=z_last: front_against_vof(r, t, z))
                if n2 == 1:
                    add(f"{tag} front against experiment", "%", 5.0, [run],
                        lambda r: front_against_experiment(r, exp1, (0.80, 1.44))[0])
                    add(f"{tag} shift in T", "-", None, [run],
                        lambda r: front_against_experiment(r, exp1, (0.80, 1.44))[1])
                else:
                    add(f"{tag} front against experiment, all points", "%", None, [run],
                        lambda r: front_against_experiment(r, mm2, match2)[0])
                    add(f"{tag} front against experiment, but for T 4.03", "%", 5.0, [run],
                        lambda r: front_against_experiment(r, [p for p in mm2 if p[0] != 4.034], match2)[0])
                    add(f"{tag} shift in T", "-", None, [run],
                        lambda r: front_against_experiment(r, mm2, match2)[1])
    # B8: dam break against a wall, with shifting (the scene's default) and the best without; B9: in 3-D, a box
    for n in (30,) if quick else (30, 40, 60):
        for how, most, options in (("shifting", {40: 3.0, 60: 1.5}, {}),
                                   ("none", {40: 6.0, 60: 4.0}, dict(shifting=0, alpha=0.02, sound=14.142136))):
            run = Run("impact", n=n, every=1e-4, **options)
            tag = f"B8 shifting {how} n={n}" if how == "none" else f"B8 n={n}"
            add(f"{tag} noise of P1 about its 10 ms mean", "% of rho g H", most.get(n), [run],
                lambda r: 100 * impact_noise(r))
            add(f"{tag} largest 10 ms mean of P1 (measured 2.51)", "rho g H", 3.3 if n > 30 else None, [run],
                impact_peak)
            add(f"{tag} mean of P1 at t* 3.2 to 5.5 (De Courcy 0.97)", "rho g H", None, [run], impact_mean)
            add(f"{tag} levels off the measured", "H rms", None, [run], levels_off)
    box = Run("obstacle", every=0.004)
    for k in ("P1", "P2", "P3", "P4"):
        add(f"B9 n=11 20 ms peak of {k} over the measured", "ratio", None, [box], lambda r, k=k: box_peak(r, k))
    add("B9 n=11 levels off the measured", "% of the depth, rms", None, [box], lambda r: 100 * box_levels_off(r, 2.0))
    # sloshing: the guard of shifting
    for shifting in (0.5, 0):
        run = Run("sloshing", shifting=shifting, frames=800)
        add(f"sloshing shifting {shifting} mean level after 20 periods", "% off", 0.5 if shifting else None, [run],
            lambda r: 100 * abs(sum(r.col("level_")[-40:]) / 40 / r.col("level_")[0] - 1))
        add(f"sloshing shifting {shifting} rise of the energy, of the largest kinetic", "%", 5 if shifting else None,
            [run], lambda r: 100 * max(e - min(r.col("energy_")[:i + 1]) for i, e in enumerate(r.col("energy_"))) /
            max(r.col("kinetic_")))
    # float against double, near and 1000 tank lengths from the origin
    n = 30
    near, far = Run("dam_break", n=n, precision="float"), Run("dam_break", n=n, precision="float", away=1000)
    double = Run("dam_break", n=n, precision="double")
    for name, run in (("float", near), ("float, 1000 tank lengths away,", far)):
        add(f"G5 n={n} {name} front against double, largest difference", "%", 5.0, [run, double],
            lambda a, b: 100 * max(abs(x / y - 1) for x, y in zip(a.col("Z_"), b.col("Z_"))))
    for wall in ("ghost", "ghost_compressible", "adami_no_slip"):
        run = Run("dam_break", n=60, wall=wall)
        add(f"G5 n^2=1 n=60 {wall} front against volume-of-fluid", "%", None, [run],
            lambda r: front_against_vof(r, "vof_dam_break_n2_1.csv", 5.0))
    # B1: Taylor-Green
    tg = {n: Run("taylor_green", n=n, re=100) for n in ((25, 50) if quick else (25, 50, 100))}
    for n, run in tg.items():
        add(f"B1 Re 100 n={n} kinetic energy", "% of exact at the end", None, [run],
            lambda r: 100 * abs(r.col("kinetic_J")[-1] / r.col("kinetic_exact")[-1] - 1))
    ns = sorted(tg)
    add(f"B1 order of convergence n={ns[-2]}..{ns[-1]}", "-", None, [tg[ns[-2]], tg[ns[-1]]],
        lambda a, b: math.log2(abs(a.col("kinetic_J")[-1] / a.col("kinetic_exact")[-1] - 1) /
                               abs(b.col("kinetic_J")[-1] / b.col("kinetic_exact")[-1] - 1)))
    # B10: Poiseuille's and Couette's flow between no-slip walls
    for flow in ("poiseuille", "couette"):
        ch = {n: Run("channel", n=n, flow=flow, frames=4) for n in (20, 40)}
        for n, run in ch.items():
            add(f"B10 {flow} n={n} velocity, rms", "% of the speed", 0.2 if n == 40 else None, [run],
                lambda r: 100 * r.col("velocity_error_rms")[-1])
        add(f"B10 {flow} order n=20..40", "-", None, [ch[20], ch[40]],
            lambda a, b: math.log2(a.col("velocity_error_rms")[-1] / b.col("velocity_error_rms")[-1]))
    # B2: standing wave
    for n in (20, 40) if quick else (20, 40, 80):
        run = Run("standing_wave", n=n)
        add(f"B2 n={n} period", "% off linear theory", 1.0 if n >= 40 else None, [run], standing_period)
        add(f"B2 n={n} decay rate", "of Lamb's", None, [run], standing_decay)
    # B4: elliptical drop
    for n in (20, 40) if quick else (20, 40, 80):
        run = Run("elliptical_drop", n=n)
        add(f"B4 n={n} semi-axis a", "% off exact", 1.0 if n >= 40 else None, [run],
            lambda r: 100 * max(abs(x / y - 1) for x, y in zip(r.col("a_moment"), r.col("a_exact"))))
        add(f"B4 n={n} semi-axis b", "% off exact", 1.0 if n >= 40 else None, [run],
            lambda r: 100 * max(abs(x / y - 1) for x, y in zip(r.col("b_moment"), r.col("b_exact"))))
    return rows


def standing_period(run):
    """Percent by which the measured period (twice the mean spacing of zero crossings) is off linear theory."""
    z = zero_crossings(run.col("time"), run.col("mode_m"))
    e = zero_crossings(run.col("time"), run.col("mode_linear"))
    n = min(len(z), len(e))
    if n < 3:
        raise ValueError("fewer than three zero crossings")
    return 100 * abs((z[n - 1] - z[0]) / (e[n - 1] - e[0]) - 1)


def standing_decay(run):
    """Measured over Lamb's decay rate of the amplitude, from the peaks of the mode."""
    t, y, e = run.col("time"), run.col("mode_m"), run.col("mode_linear")

    def rate(v):
        peaks = [(t[i], math.log(abs(v[i]))) for i in range(1, len(v) - 1)
                 if abs(v[i]) >= abs(v[i - 1]) and abs(v[i]) > abs(v[i + 1])]
        return -slope([p[0] for p in peaks], [p[1] for p in peaks])
    return rate(y) / rate(e)


if __name__ == "__main__":
    sys.exit(main(cases, "validate_water", __doc__))
