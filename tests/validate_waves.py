#!/usr/bin/env python3
# SPDX-License-Identifier: MIT. Copyright the sph authors.
"""validate_waves.py: runs the wave cases and holds them against potential flow.

usage: validate_waves.py [--quick] [--jobs N] [--only WORD] [--keep] [--tool build/sph]
Writes build/validate_waves.csv (name,value,unit,target,ok) and prints the same as a table; validation.py says more.
Exit code 1 if a row with a target misses it. Costs are steps times particles of the run, in millions: they do not
depend on the machine.
"""
import cmath
import functools
import sys

from validation import interpolate, main, read_table, Run, slope

DEPTH = 0.2  # m, of the scene
# the cheapest setting that keeps an exact wave as wanted; and a quarter of its cost
CHEAPEST = dict(gradient="bonet_lok", n=10, sound=7, alpha=0)
QUARTER = dict(CHEAPEST, n=6)


class Wave(Run):
    """a run of the scene, which says what it cost"""

    def __init__(self, scene="solitary", **options):
        super().__init__(scene, **options)

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


def known(table, **where):
    """the last row of a table with these values"""
    return [r for r in read_table(table) if all(abs(float(r[k]) - v) < 1e-6 for k, v in where.items())][-1]


def off(value, exact):
    return 100 * abs(value / exact - 1)


# ---- piston (G4) ----

def stopped(run, name):
    """of when the piston has just stopped"""
    piston = run.col("piston_m")
    return run.col(name)[next(i for i, x in enumerate(piston) if x >= piston[-1] - 1e-9)]


def at_middle(run, name, length):
    """of when the crest passes the middle of the tank"""
    x, y = run.col("crest_x_m"), run.col(name)
    for a, b, c, d in zip(x, x[1:], y, y[1:]):
        if a < length / 2 <= b:
            return c + (d - c) * (length / 2 - a) / (b - a)
    return None


def crest_speed(run, middle, reach=0.1):
    """m/s, from the crest's places for `reach` seconds before and behind its first passage of the middle"""
    t, x = run.col("time_s"), run.col("crest_x_m")
    passage = next(b for a, b, c, d in zip(t, t[1:], x, x[1:]) if c < middle <= d)
    points = [(a, b) for a, b in zip(t, x) if abs(a - passage) < reach]
    return slope([p[0] for p in points], [p[1] for p in points])


def piston_books(run):
    """% of the work of the piston that the balance has lost"""
    balance, work = run.col("balance"), run.col("wall_work")
    return 100 * abs(balance[-1] - balance[0]) / max(work)


def piston_rows(add, t_star, length, run):
    exact, name = known("wave_piston_summary.csv", t_star=t_star), f"G4 piston t*={t_star}"
    add(f"{name}: crest at mid-tank", "% of potential flow", 3.0, [run],
        lambda r: off(at_middle(r, "crest_m", length), float(exact["crest_mid_cm"]) / 100))
    add(f"{name}: speed there", "% of potential flow", 3.0, [run],
        lambda r: off(crest_speed(r, length / 2), float(exact["speed_mid"])))
    if exact["runup_R_over_D"] != "nan":
        add(f"{name}: run-up", "% of potential flow", 3.0, [run],
            lambda r: off(max(r.col("runup_m")) / 0.16, float(exact["runup_R_over_D"])))
    add(f"{name}: work on the water", "% of potential flow", 3.0, [run],
        lambda r: off(stopped(r, "work_J"), float(exact["wall_work_J"])))
    add(f"{name}: potential energy gained", "% of potential flow", 3.0, [run],
        lambda r: off(stopped(r, "gain_potential"), float(exact["dPE_end_J"])))
    add(f"{name}: work over Gray's printed", "-", None, [run],
        lambda r: stopped(r, "work_J") / float(exact["gray_work"]))
    add(f"{name}: cost", "M particle-steps", None, [run], lambda r: r.cost())


# ---- bores (G6, G7) ----

def bore_speed(run, first):
    points = between(run, "front", first, 1e9)
    return abs(slope([p[0] for p in points], [p[1] for p in points]))


def mean_from(run, name, first):
    values = [v for t, v in between(run, name, first, 1e9)]
    return sum(values) / len(values)


# ---- breaking (W7, W8, G7) ----

def spline(r):
    a = abs(r)
    return 0.0 if a >= 2 else ((2 - a) ** 3 - (4 * (1 - a) ** 3 if a < 1 else 0)) / 6


def lean_of_profile(name, n):
    """dX/dy that track_steepest (examples/scenes/track.c) reads off an exact profile, a table of x and eta, at n
    particles in the depth: it looks through splines of knots 1.5 dx and over two spacings, so that a vertical tangent
    of a small part of the face reads as less"""
    line = [(float(r["x"]), float(r["eta"])) for r in read_table(name)]
    dx, knot, fine = 1 / n, 1.5 / n, 1 / (6 * n)
    first, (crest, high) = min(x for x, _ in line), max(line, key=lambda q: q[1])
    tops = []
    for k in range(int((max(x for x, _ in line) - first) / fine)):
        x = first + (k + 0.5) * fine
        tops.append(max([e0 + (e1 - e0) * (x - x0) / (x1 - x0) for (x0, e0), (x1, e1) in zip(line, line[1:])
                         if min(x0, x1) <= x <= max(x0, x1) and x0 != x1], default=-1.0))
    below = [0.0]  # integral of the spline from -2 on, in steps of 1/100
    for k in range(400):
        below.append(below[-1] + 0.01 * spline(-2 + 0.01 * (k + 0.5)))

    def cover(x, y):
        a, b = int((x - 2 * knot - first) / fine), int((x + 2 * knot - first) / fine) + 1
        return sum(spline((first + (k + 0.5) * fine - x) / knot) / knot * fine *
                   below[max(0, min(400, int(((tops[k] - y) / knot + 2) * 100)))]
                   for k in range(max(a, 0), min(b, len(tops))))

    far, step = [], dx / 2
    for r in range(int(0.75 * high / step + 4)):
        y, k = 0.25 * high + r * step, 0
        now = cover(crest, y)
        if now < 0.5:
            break
        while k < 190 and (ahead := cover(crest + (k + 1) * step, y)) >= 0.5:
            now, k = ahead, k + 1
        far.append((k + (now - 0.5) / (now - ahead)) * step)
    return max((b - a) / (4 * step) for a, b in zip(far, far[4:]))


def vertical_tangent(run, clock, after, lean=0.0):
    """when the face of the leading crest first leans so far, and has done so in all of the next four rows"""
    t, ours = run.col(clock), run.col("lean")
    for i in range(1, len(t) - 4):
        if t[i] > after and ours[i - 1] < lean and all(v >= lean for v in ours[i:i + 4]):
            return t[i - 1] + (t[i] - t[i - 1]) * (lean - ours[i - 1]) / (ours[i] - ours[i - 1])
    raise ValueError("no vertical tangent")


def at_time(run, clock, name, t):
    return interpolate(run.col(clock), run.col(name), t)


# ---- flap ----

def flap_waves(run):
    """amplitudes (D) of the wave that comes and of the one that goes back, by least squares over three gauges (Mansard
    & Funke 1980) from period 7 to 10"""
    k, t = run.col("wave_number")[0], run.col("t_periods")
    rows = [i for i, v in enumerate(t) if 7 <= v < 10]
    s11 = s12 = b1 = b2 = 0
    for n in (1, 2, 3):
        x, eta = run.col(f"gauge{n}_x")[0], run.col(f"gauge{n}_D")
        mean = sum(eta[i] for i in rows) / len(rows)
        a = 2 / len(rows) * sum((eta[i] - mean) * cmath.exp(2j * cmath.pi * t[i]) for i in rows)
        f, g = cmath.exp(1j * k * x), cmath.exp(-1j * k * x)
        s11 += 1
        s12 += f.conjugate() * g
        b1 += f.conjugate() * a
        b2 += g.conjugate() * a
    det = s11 * s11 - abs(s12) ** 2
    return abs((s11 * b1 - s12 * b2) / det), abs((s11 * b2 - s12.conjugate() * b1) / det)


def flap_period(run):
    """periods of the flap between upward crossings at the second gauge, from period 6 on"""
    t, eta = run.col("t_periods"), run.col("gauge2_D")
    ups = [a + (b - a) * u / (u - v) for a, b, u, v in zip(t, t[1:], eta, eta[1:]) if a > 6 and u < 0 <= v]
    return (ups[-1] - ups[0]) / (len(ups) - 1)


def more_cases(add, quick):
    """waves that are made, meet and break"""
    corrected = dict(gradient="bonet_lok")
    piston_rows(add, 3, 1.8, Wave("piston", every=0.02, **corrected))
    if not quick:
        piston_rows(add, 1, 1.8, Wave("piston", t_star=1, every=0.02, end=1.8, **corrected))
        piston_rows(add, 5, 3.6, Wave("piston", t_star=5, length=3.6, every=0.02, end=2.2, **corrected))
    for bed, wall in (("wall", "adami"), ("wall", "ghost_compressible"), ("symmetry", "adami"),
                      ("symmetry", "ghost_compressible")):
        add(f"G4 piston t*=3, {wall} piston, {bed} bed: books", "% of the work", 1.0,
            [Wave("piston", bed=bed, wall=wall, n=10, end=1, every=0.05, **corrected)], piston_books)
    for wall in ("adami", "ghost_compressible"):
        run = Wave("piston", wall=wall, n=10, end=1, every=0.05, **corrected)
        add(f"G4 piston t*=3, {wall} piston, wall bed: work on the water", "% of potential flow", 3.0, [run],
            lambda r: off(r.col("work_J")[-1], r.col("work_known")[-1]))
        add(f"G4 piston t*=3, {wall} piston, wall bed: of it by the bed behind the piston's foot", "%", None, [run],
            lambda r: -100 * r.col("in_walls")[-1] / r.col("work_J")[-1])
    add("G4 piston t*=3 by a table: work on the water", "% of the programme's", 1.0,
        [Wave("piston", n=10, end=1, every=0.05, **corrected),
         Wave("piston", n=10, end=1, every=0.05, motion="table", **corrected)],
        lambda a, b: off(b.col("work_J")[-1], a.col("work_J")[-1]))
    for made, alpha in (("water", 0.01), ("wall", 0.1)):
        exact = known("wave_bore_jump.csv", V=8.5)
        run = Wave("bore", made=made, alpha=alpha, length=60, travel=24, n=8, every=0.2)
        frame = "tank" if made == "water" else "still_water"
        add(f"G6 bore 8.5 m/s made by {made}: speed from 12 s on", "% of the exact jump", 1.0, [run],
            lambda r, f=frame, e=exact: off(bore_speed(r, 12), float(e[f"bore_speed_{f}_frame"])))
        add(f"G6 bore 8.5 m/s made by {made}: depth behind", "% of the exact jump", 2.0, [run],
            lambda r, e=exact: off(mean_from(r, "behind_m", 15), float(e["H1"])))
        add(f"G6 bore 8.5 m/s made by {made}: cost", "M particle-steps", None, [run], lambda r: r.cost())
    for v in (2,) if quick else (1, 2, 3):
        exact = [r for r in read_table("wave_bore_trains.csv")
                 if float(r["V"]) == v and abs(float(r["t"]) - 24.73612) < 1e-3][-1]
        run = Wave("bore", made="wall", speed=v, rise=2.0, alpha=0.001, length=36 if v == 1 else 42, travel=24.6,
                   sound=10, every=0.2, **corrected)
        add(f"G7 undular bore {v} m/s: first crest at 24.7 s", "% of potential flow", 3.0, [run],
            lambda r, e=exact: off(at_time(r, "time", "crest_m", 24.736), float(e["eta1"])))
        add(f"G7 undular bore {v} m/s: first two crests apart", "% of potential flow", 3.0, [run],
            lambda r, e=exact: off(at_time(r, "time", "spacing_m", 24.736), float(e["spacing12"])))
        add(f"G7 undular bore {v} m/s: cost", "M particle-steps", None, [run], lambda r: r.cost())
    meet = Wave("collision", every=0.02, **corrected)
    two = read_table("wave_collision.csv")[-1]
    add("W6 collision: peak", "% of potential flow", 2.0, [meet],
        lambda r: off(max(h for t, h in zip(r.col("t_"), r.col("highest")) if 6 < t < 12), float(two["peak"])))
    for side, size in (("right", "large"), ("left", "small")):
        add(f"W6 collision: {size} wave after over before", "% (potential flow "
            f"{100 * float(two[f'change_{size}']):.2f})", None, [meet],
            lambda r, s=side: 100 * (at_time(r, "t_", f"{s}_height", 24) / at_time(r, "t_", f"{s}_height", 3) - 1))
        add(f"W6 collision: lag of the {size} wave", "% of potential flow", 20.0, [meet],
            lambda r, s=side, z=size: off(at_time(r, "t_", f"{s}_lag", 24), float(two[f"lag_{z}"])))
    add("W6 collision: cost", "M particle-steps", None, [meet], lambda r: r.cost())
    for name, options in (("plain", {}), ("corrected", corrected))[1 if quick else 0:]:
        run = Wave("breaking", every=0.02, end=2.1, **options)
        add(f"W7 breaking {name}: vertical tangent", "% of potential flow", 5.0, [run],
            lambda r: off(vertical_tangent(r, "time", 0.8), 1.863))
        for what, column, of in (("height", "crest_m", "eta_crest"), ("place", "crest_x_m", "x_crest")):
            add(f"W7 breaking {name}: {what} of the crest at 1.79 s", "% of potential flow", None, [run],
                lambda r, c=column, k=of: off(at_time(r, "time", c, 1.792995),
                                              float(known("wave_wick_w7_track.csv", t=1.792995)[k])))
        add(f"W7 breaking {name}: cost", "M particle-steps", None, [run], lambda r: r.cost())
    if not quick:
        exact = known("wave_shoaling_breaking.csv", slope_1_to=35, e=0.4)
        seen = functools.lru_cache(lambda: lean_of_profile("wave_shoaling_profile_e0.4.csv", 16))
        run, clock = Wave("shoaling", every=0.02, **corrected), "t_from_toe"
        for what, column, figure, target in (("place", "crest_x_D", "x_crest", 3.0), ("height", "crest_D", "H_b", 5.0),
                                             ("index", "index", "H_b_over_h_crest", 5.0)):
            add(f"W8 shoaling 1:35 e=0.4: {what} at the vertical tangent", "% of potential flow", target, [run],
                lambda r, c=column, f=figure: off(at_time(r, clock, c, vertical_tangent(r, clock, 5, seen())),
                                                  float(exact[f])))
        for what, column, figure in (("height", "crest_D", "H_b"), ("index", "index", "H_b_over_h_crest")):
            add(f"W8 shoaling 1:35 e=0.4: {what} where potential flow breaks", "% of potential flow", 5.0, [run],
                lambda r, c=column, f=figure: off(interpolate(r.col("crest_x_D"), r.col(c), float(exact["x_crest"])),
                                                  float(exact[f])))
        add("W8 shoaling 1:35 e=0.4: cost", "M particle-steps", None, [run], lambda r: r.cost())
    # corrected water, and plain with less viscosity, grow noisy beside the flap until a density is lost
    flap = Wave("flap", every=0.03)
    add("W6.9 flap: period of the waves", "% of the flap's", 1.0, [flap], lambda r: off(flap_period(r), 1))
    add("W6.9 flap: height of the waves", "% of linear theory", 5.0, [flap],
        lambda r: off(2 * flap_waves(r)[0], r.col("height_linear")[0]))
    add("W6.9 flap: what a beach of 1:6 gives back", "% of the height", None, [flap],
        lambda r: 100 * flap_waves(r)[1] / flap_waves(r)[0])
    add("W6.9 flap: cost", "M particle-steps", None, [flap], lambda r: r.cost())


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
               "large eddies corrected": dict(n=10, gradient="bonet_lok", alpha=0, shear="smagorinsky"),
               "plain, diffusion after Antuono": dict(n=10, diffusion="antuono"),
               "corrected, diffusion after Antuono": dict(CHEAPEST, diffusion="antuono"),
               "corrected with the guard": dict(CHEAPEST, guard="yes"),
               "corrected with the guard, diffusion after Antuono": dict(CHEAPEST, guard="yes", diffusion="antuono"),
               "corrected, lattice cut at the surface": dict(CHEAPEST, lattice="cut"),
               "corrected, columns pushed by 0.1 dx": dict(CHEAPEST, push=0.1)}
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
             "delta-SPH corrected": dict(gradient="bonet_lok"),
             "after Antuono": dict(diffusion="antuono"),
             "after Antuono corrected": dict(diffusion="antuono", gradient="bonet_lok"),
             "corrected with the guard": dict(diffusion="none", gradient="bonet_lok", guard="yes"),
             "delta-SPH corrected with the guard": dict(gradient="bonet_lok", guard="yes"),
             "after Antuono corrected with the guard": dict(diffusion="antuono", gradient="bonet_lok", guard="yes")}
    for name, options in still.items():
        for shepard in (0,) if "guard" in name or "Antuono" in name else (0, 40):
            run = Run("still_water", n=10, frames=20, **options, **(dict(shepard=shepard) if shepard else {}))
            tag = f"W10 still water {name}, {'filter' if shepard else 'no filter'}"
            best = name.startswith("delta") and not shepard or name in ("after Antuono", "corrected with the guard")
            add(f"{tag}: level", "% of depth in 10 s", 0.5 if best else None, [run],
                lambda r: 100 * abs(drift(r, "twice_centre_m")))
            add(f"{tag}: mean density", "% off", 1.0, [run], lambda r: 100 * abs(drift(r, "density_mean")))
            add(f"{tag}: fluctuation of density", "% of rho0", None, [run],
                lambda r: 100 * max(r.col("density_rms")[1:]) / 1000)
            add(f"{tag}: largest speed at the end", "% of sqrt(g H)", None, [run],
                lambda r: 100 * r.col("max_speed")[-1] / (9.81 * 0.15) ** 0.5)
    more_cases(add, quick)
    return rows


if __name__ == "__main__":
    sys.exit(main(cases, "validate_waves", __doc__))
