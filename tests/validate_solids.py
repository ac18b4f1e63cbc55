#!/usr/bin/env python3
# SPDX-License-Identifier: MIT. Copyright the sph authors.
"""validate_solids.py: runs the cases of solids and holds them against Gray (2001), finite elements and exact solutions.

usage: validate_solids.py [--quick] [--jobs N] [--only WORD] [--keep] [--tool build/sph]
Writes build/validate_solids.csv and prints the same as a table; validation.py says more. Each group of cases is a
function in GROUPS that takes add(name, unit, target, runs, figure). Long studies: --only WORD --keep goes on where an
earlier call was ended. Times are in cm/c0 and lengths in cm unless a row says otherwise.
"""
import csv, io, math, os, subprocess, sys

from validation import Run, interpolate, main, read_table, slope, zero_crossings


def period(run):
    """Twice the mean time between crossings of the mid-line, from the second on (the first is half a period after the
    start)."""
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
    for clamp, kind in (("surfaces", "T_B"), ("on_surfaces", "T_B"), ("ideal", "T_A"), ("region", "T_A")):
        run = Run("plate", speed=0.001, n=n, clamp=clamp, cycles=0.6, every=10)
        add(f"G15 H 2 mu 0.22 n={n} clamp {clamp} period against finite elements", "%", None, [run],
            lambda r, k=kind: 100 * abs(period(r) / float(fe[2.0, 0.22][k]) - 1))
    off = lambda r: 100 * abs(period(r) / float(fe[2.0, 0.22]["T_A"]) - 1)
    sizes = (6, 10) if quick else (6, 10, 20)
    free = {size: Run("plate", speed=0.001, n=size, cycles=0.6, every=10) for size in sizes}
    for size, run in free.items():
        add(f"G15 H 2 mu 0.22 n={size} period against finite elements", "%", {10: 0.9, 20: 0.25}.get(size), [run], off)
    weighed = {size: Run("plate", speed=0.001, n=size, faces="quadrature", cycles=0.6, every=10) for size in sizes[1:]}
    for size, run in weighed.items():
        add(f"G15 H 2 mu 0.22 n={size} faces quadrature period against finite elements", "%", {10: 0.3, 20: 0.1}[size],
            [run], off)
    coarse, fine = sorted(free)[-2:]
    add(f"G15 H 2 mu 0.22 order of the period n={coarse}..{fine}", "-", (">=", 1.9), [free[coarse], free[fine]],
        lambda a, b: math.log(off(a) / off(b)) / math.log(fine / coarse))
    long = Run("plate", n=n, speed=0.01, cycles=1.2 if quick else 3.4, every=20)
    add(f"G15 H 2 mu 0.22 n={n} amplitude loss, {'two swings' if quick else 'three cycles'}", "%", 5.0, [long],
        lambda r: 100 * (1 - swings(r)[-2 if len(swings(r)) > 2 else -1] / swings(r)[0]))
    add(f"G15 H 2 mu 0.22 n={n} drift of the energy", "%", 0.1, [long],
        lambda r: 100 * max(abs(e - 1) for e in r.col("energy")))
    if not quick:
        ten = Run("plate", n=8, speed=0.001, cycles=10.5, every=50, precision="double")
        add("G15 n=8 double drift of the energy over ten periods, no viscosity", "%", 0.1, [ten],
            lambda r: 100 * max(abs(e - 1) for e in r.col("energy")))
    # Gray's own settings: without artificial stress the plate breaks at the clamp
    own = dict(form="updated", kernel="cubic", h=1.5, alpha=0.5, integrator="predictor_corrector", cfl=0.25, n=10,
               mu=0.6, speed=0.05,
               clamp="surfaces", cycles=0.8, every=10)
    for repulsion in ("none", "principal"):
        run = Run("plate", repulsion=repulsion, **own)
        add(f"G15 thesis's settings, artificial stress {repulsion}: closest pair", "dx", None, [run],
            lambda r: min(r.col("closest")))
        add(f"G15 thesis's settings, artificial stress {repulsion}: period", "cm/c0", None, [run],
            lambda r: period(r) if [x for x in zero_crossings(r.col("time"), r.col("tip")) if x > 1] else float("nan"))
    # G16: plastic plate
    elastic = Run("plate", n=10, mu=0.6, speed=0.05, cycles=1.3, every=10)
    plastic = Run("plate", n=10, mu=0.6, speed=0.05, **{"yield": 0.06}, cycles=1.3, every=10)
    printed = Run("plate", n=10, mu=0.6, speed=0.05, **{"yield": 0.06}, printed="yes", cycles=1.3, every=10)
    for name, run in (("plastic", plastic), ("plastic as printed (5.14, 5.15)", printed)):
        add(f"G16 first amplitude, {name} over elastic", "ratio", (">=", 1.0) if run is printed else None,
            [run, elastic],
            lambda a, b: swings(a)[0] / swings(b)[0])
        add(f"G16 time of the first return to the mid-line, {name} over elastic", "ratio", (">=", 1.0), [run, elastic],
            lambda a, b: first_return(a) / first_return(b))
    add("G16 permanent upward set, as printed: mean of the tip's extremes after the first", "cm", (">=", 0.01),
        [printed],
        lambda r: 0.5 * (max(late(r)) + min(late(r))))
    rough = dict(own, clamp="ideal", cycles=0.6, repulsion="principal", printed="yes")
    soft, stiff = Run("plate", **{"yield": 0.06}, **rough), Run("plate", **rough)
    add("G16 thesis's settings: first amplitude, plastic over elastic", "ratio", None, [soft, stiff],
        lambda a, b: swings(a)[0] / swings(b)[0])
    add("G16 permanent upward set: mean of the tip's extremes after the first", "cm", (">=", 0.01), [plastic],
        lambda r: 0.5 * (max(late(r)) + min(late(r))))
    add("G16 the same of the elastic plate", "cm", None, [elastic], lambda r: 0.5 * (max(late(r)) + min(late(r))))
    add("G16 plastic work over energy at the start", "%", None, [plastic],
        lambda r: 100 * r.col("plastic")[-1] / r.col("kinetic")[0])
    add("G16 energy left over: books", "%", 1.0, [plastic], lambda r: 100 * abs(r.col("energy")[-1] - 1))


def beams(quick, add):
    """G15 beside it: a beam clamped at both ends, against plane-strain finite elements; B11: CSM3 of Turek and Hron."""
    fe = {(float(r["H"]), float(r["mu"])): float(r["T"]) for r in read_table("fe_beam_periods.csv")
          if r["ends"] == "both"}
    for faces, targets in (("equal", {10: 0.9, 20: 0.25}), ("quadrature", {10: 0.3, 20: 0.1})):
        runs = {n: Run("beam", n=n, faces=faces, cycles=0.75, frames=100) for n in ((10,) if quick else (10, 20))}
        for n, run in runs.items():
            add(f"G15 beam clamped at both ends, H 2 mu 0.22 n={n} faces {faces} period against finite elements", "%",
                targets[n], [run], lambda r: beam_error(r, fe[2.0, 0.22]))
    run = Run("beam", n=10, clamp="region", cycles=0.75, frames=100)
    add("G15 beam clamped at both ends, n=10 clamp region period against finite elements", "%", None, [run],
        lambda r: beam_error(r, fe[2.0, 0.22]))
    for n in (5,) if quick else (5, 10):
        run = Run("csm3", n=n, frames=400)
        add(f"B11 CSM3 n={n} amplitude of A against 65.160 mm", "%", 2.0 if n == 10 else None, [run],
            lambda r: 100 * abs(csm3_amplitude(r) / CSM3[0] - 1))
        add(f"B11 CSM3 n={n} frequency against 1.0995 Hz", "%", 1.0 if n == 10 else None, [run],
            lambda r: 100 * abs(csm3_frequency(r) / CSM3[1] - 1))
        add(f"B11 CSM3 n={n} largest distance of A from the authors' series, over the amplitude", "%", None, [run],
            csm3_distance)


CSM3 = 6.5160, 1.0995  # amplitude of A (cm) and frequency (Hz) that Turek and Hron print


def beam_error(run, exact):
    t = [x for x in zero_crossings(run.col("time"), run.col("mode")) if x > 1]
    return 100 * abs(2 * t[0] / exact - 1)


def csm3_amplitude(run):
    return 0.5 * (max(run.col("uy")) - min(run.col("uy")))


def csm3_frequency(run):
    """From the first and the second time that A falls through the middle of its way."""
    middle = 0.5 * (max(run.col("uy")) + min(run.col("uy")))
    t = zero_crossings(run.col("seconds"), [y - middle for y in run.col("uy")])
    return 1 / (t[2] - t[0])


def csm3_distance(run):
    table = read_table("turek_hron_csm3.csv")
    t, y = [float(r["time"]) for r in table], [100 * float(r["uy"]) for r in table]
    way = [(x, v) for x, v in zip(run.col("seconds"), run.col("uy")) if x < 2]
    return 100 * max(abs(interpolate(t, y, x) - v) for x, v in way) / CSM3[0]


def first_return(run):
    """When the tip first comes back to where it began; the run's end where it does not."""
    t = [x for x in zero_crossings(run.col("time"), run.col("tip")) if x > 1]
    return t[0] if t else run.col("time")[-1]


def late(run):
    """The tip's way after half of the run."""
    y = run.col("tip")
    return y[len(y) // 2:]


GROUPS = [plates, beams]


# ---- G12: a longitudinal pulse (Gray 2001, 5.6.1) ----

PULSE_SPEED = math.sqrt(1 + 4 * 0.22 / 3)  # of small waves; a round of the sheet takes 200/PULSE_SPEED


def pulse_speed(run, side):
    """Slope of a crest's way between 0.15 and 0.4 of a round: apart, and not yet at the seam."""
    t, x = run.col("time"), run.col(f"{side}_x")
    part = [i for i in range(len(t)) if 0.15 <= t[i] * PULSE_SPEED / 200 <= 0.4]
    return abs(slope([t[i] for i in part], [x[i] for i in part]))


def pulse_mean_speed(run):
    """Of both pulses: what a finite amplitude adds to one it takes from the other, to first order."""
    return 0.5 * (pulse_speed(run, "right") + pulse_speed(run, "left"))


def pulse_off_exact(run):
    """Largest error in percent of the two crests' speeds against those of simple waves of that amplitude."""
    t = run.col("time")
    exact = {side: abs(slope(t, run.col(f"{side}_exact"))) for side in ("right", "left")}
    return 100 * max(abs(pulse_speed(run, side) / exact[side] - 1) for side in exact)


def pulse_loss(run):
    """Percent of its amplitude that the weaker pulse has lost after 0.88 of a round; they start with half of 0.05."""
    t = run.col("time")
    i = min(range(len(t)), key=lambda i: abs(t[i] * PULSE_SPEED / 200 - 0.88))
    half = 0.5 * max(run.col("right_v")[0], run.col("left_v")[0])
    return 100 * (1 - min(run.col("right_v")[i], run.col("left_v")[i]) / half)


def g12(quick, add):
    printed = {1.0: 1.164, 1.3: 1.148, 1.5: 1.131}
    for h in (1.0, 1.3, 1.5):
        # all rows are alike; a periodic axis takes at least three supports, and those of the total form are longer
        common = {"height": 10 if h < 1.5 else 14, "duration": 0.9, "frames": 90}
        run = Run("pulse", form="total", h=h, alpha=0.02, **common)
        name = f"G12 total alpha 0.02 h {h}"
        add(f"{name} mean speed", "% off 1.137", 1.0, [run], lambda r: 100 * abs(pulse_mean_speed(r) / PULSE_SPEED - 1))
        add(f"{name} crests", "% off simple waves", 1.0, [run], pulse_off_exact)
        add(f"{name} amplitude lost", "%", 10.0, [run], pulse_loss)
        run = Run("pulse", form="updated", h=h, alpha=0.5, **common)
        name = f"G12 updated alpha 0.5 h {h}"
        add(f"{name} mean speed (Gray {printed[h]})", "c0", None, [run], pulse_mean_speed)
        add(f"{name} speed to the right", "c0", None, [run], lambda r: pulse_speed(r, "right"))
        add(f"{name} amplitude lost (Gray 40)", "%", None, [run], pulse_loss)
        if quick:
            continue
        for form, repulsion in (("updated", "none"), ("updated", "principal"), ("corrected", "none")):
            run = Run("pulse", form=form, h=h, alpha=0.1, repulsion=repulsion, **common)
            name = f"G12 {form} alpha 0.1{' epsilon 0.3' if repulsion != 'none' else ''} h {h}"
            add(f"{name} crests", "% off simple waves", None, [run], pulse_off_exact)
            add(f"{name} amplitude lost", "%", None, [run], pulse_loss)


GROUPS.append(g12)


# ---- G13: a periodic box of particles in compression and tension (Gray 2001, 5.6.5, 5.6.6) ----
# What the dispersion relation says of waves in every direction (sph dispersion curve), which G23 shows to be right:
# - tension, h 1.0: epsilon above 0.21 stops the waves that clump the square lattice, and any above 0.07 lets columns
#   slip past each other (Gray's 5.75, of which he says that it does not clump), towards the face-centred lattice; that
#   one still clumps at epsilon 0.3. At lambda 0.9 and h 1.3 or 1.5 it is stable from epsilon 0.2 on.
# - compression: at h 1.0 the square lattice slips and the face-centred one is stable; at h 1.5 both break up, into
#   pairs.

def in_fours(run):
    """Share of the particles that stand in clumps of just four, by links shorter than the spacing of the lattice they
    began on: the sides of clumps are shorter, the gaps between clumps longer."""
    name = run.prefix() + ".particles.csv"
    subprocess.run([run.tool, "export", run.dumps()[-1], f"out={name}"], check=True, stdout=subprocess.DEVNULL)
    with open(name) as f:
        place = [(float(r["x_m"]), float(r["y_m"])) for r in csv.DictReader(line for line in f
            if not line.startswith("#"))]
    side, dx2, clump = 1.0, 1 / len(place), list(range(len(place)))

    def root(i):
        while clump[i] != i:
            clump[i] = i = clump[clump[i]]
        return i

    def apart(a, b):
        d = abs(a - b)
        return min(d, side - d)

    for i, (x, y) in enumerate(place):
        for j in range(i):
            if apart(x, place[j][0]) ** 2 + apart(y, place[j][1]) ** 2 < dx2:
                clump[root(i)] = root(j)
    size = {}
    for i in range(len(place)):
        size[root(i)] = size.get(root(i), 0) + 1
    return 4 * sum(n == 4 for n in size.values()) / len(place)


def g13(quick, add):
    common = {"steps": 1000 if quick else 10000, "end": 1000, "every": 5}

    def last(column):
        return lambda r: r.col(column)[-1]

    def tension(factor, lattice, h, **more):
        return Run("lattice_box", **{"lambda": factor}, lattice=lattice, h=h, **more, **common)

    # compression; "nearest": the smallest distance of two particles, "hole": the largest of a place from a particle
    # (square lattice 0.707, face centred 0.55 at the places looked at)
    for h in (1.0, 1.5):
        run = Run("lattice_box", rho=1.1, h=h, **common)
        target = (">=", 0.9) if h == 1 else None
        add(f"G13 rho 1.1 h {h} face centred", "of the particles", target, [run], last("face_centred"))
        add(f"G13 rho 1.1 h {h} nearest", "dx", (">=", 0.7), [run], last("nearest_min"))
    # tension: clumps without artificial stress
    for factor in (0.99, 0.95, 0.9):
        run = tension(factor, "square", 1.0, dump="picture")
        add(f"G13 lambda {factor} h 1.0 epsilon 0 nearest", "dx", None, [run], last("nearest_min"))
        target = (">=", 0.5) if factor == 0.95 else None
        add(f"G13 lambda {factor} h 1.0 epsilon 0 in fours", "of the particles", target, [run], in_fours)
        add(f"G13 lambda {factor} h 1.0 epsilon 0 hole", "dx", (">=", 1.2) if factor == 0.9 else None, [run],
            last("hole"))
        for lattice, h in (("square", 1.0), ("square", 1.5), ("shifted_x", 1.5)):
            if factor == 0.99 and h == 1.5:
                continue
            run = tension(factor, lattice, h, repulsion="principal")
            name = f"G13 lambda {factor} {lattice} h {h} epsilon 0.3"
            add(f"{name} nearest", "dx", (">=", 0.9), [run], last("nearest_min"))
            add(f"{name} hole", "dx", ("<=", 0.9), [run], last("hole"))
            add(f"{name} stress kept", "of 1 - lambda", None, [run],
                lambda r, f=factor: r.col("stress_mean")[-1] / (1 - f))
    for name, more in (("components epsilon 0.3", {"repulsion": "components"}),
                       ("corrected epsilon 0", {"form": "corrected"}), ("total epsilon 0", {"form": "total"})):
        run = tension(0.9, "square", 1.0, **more)
        ours = (">=", 0.9) if "total" in name else None
        add(f"G13 lambda 0.9 square h 1.0 {name} nearest", "dx", ours, [run], last("nearest_min"))
        add(f"G13 lambda 0.9 square h 1.0 {name} hole", "dx", None, [run], last("hole"))


GROUPS.append(g13)


# ---- G23: frequencies and growth rates of single waves against the dispersion relation (Gray 2001, 5.6.2, appendix B)
# ----

SIDE, SPAN = 12, 4  # spacings of the box; rows of history between the amplitudes that are compared


def wave_run(lattice, h, state, waves, direction):
    """state: rho, lambda, epsilon. The artificial stress changes with the wave, as it does in the relation."""
    rho, factor, epsilon = state
    return Run("lattice_box", lattice=lattice, h=h, rho=rho, **{"lambda": factor}, epsilon=epsilon,
               repulsion="principal",
               waves_x=waves[0], waves_y=waves[1], direction=direction, n=SIDE, side=SIDE, noise=0, wave=1e-6,
               viscosity="inviscid", precision="double", dt=0.0078125, every=0.125, end=8)


def measured_waves(along, over):
    """omega^2 of the two waves of one wave vector, from a run that begins longitudinal and one that begins transverse:
    the amplitudes obey u(t + d) + u(t - d) = 2 C u(t), where C has eigenvalues cos(omega d)."""
    bu, uu = [[0, 0], [0, 0]], [[0, 0], [0, 0]]
    for run in (along, over):
        u = list(zip(run.col("along"), run.col("across")))
        for k in range(SPAN, len(u) - SPAN):
            for i in range(2):
                for j in range(2):
                    bu[i][j] += 0.5 * (u[k + SPAN][i] + u[k - SPAN][i]) * u[k][j]
                    uu[i][j] += u[k][i] * u[k][j]
    det = uu[0][0] * uu[1][1] - uu[0][1] * uu[1][0]
    inverse = [[uu[1][1] / det, -uu[0][1] / det], [-uu[1][0] / det, uu[0][0] / det]]
    c = [[sum(bu[i][k] * inverse[k][j] for k in range(2)) for j in range(2)] for i in range(2)]
    mean, half = 0.5 * (c[0][0] + c[1][1]), 0.5 * (c[0][0] - c[1][1])
    root = math.sqrt(half * half + c[0][1] * c[1][0])
    d = SPAN * (along.col("time")[-1] - along.col("time")[0]) / (len(along.col("time")) - 1)
    return sorted((math.acos(x) / d) ** 2 if abs(x) <= 1 else -(math.acosh(x) / d) ** 2
                  for x in (mean - root, mean + root))


def theory_of_waves(tool, lattice, h, state, waves):
    rho, factor, epsilon = state
    kx, ky = 2 * waves[0] / SIDE, 2 * waves[1] / SIDE
    options = {"lattice": lattice, "h": h, "rho": rho, "c": math.sqrt(factor), "pressure": factor * rho - 1, "mu": 0.22,
               "epsilon": epsilon, "angle": math.degrees(math.atan2(ky, kx)), "kmax": math.hypot(kx, ky), "points": 2}
    text = subprocess.run([tool, "dispersion", "curve"] + [f"{k}={v}" for k, v in options.items()],
                          stdout=subprocess.PIPE,
                          text=True, check=True).stdout
    rows = list(csv.DictReader(line for line in io.StringIO(text) if not line.startswith("#")))
    return sorted((float(rows[-1]["omega2_long"]), float(rows[-1]["omega2_trans"])))


def g23(quick, add):
    for lattice in ("square",) if quick else ("square", "shifted_x", "shifted_y"):
        for h in (1.0, 1.5):
            for state in ((1.1, 1.0, 0.0), (1.0, 0.9, 0.0), (1.0, 0.9, 0.3)):
                for waves in ((6, 0), (3, 0), (3, 3)):
                    def figure(along, over, lattice=lattice, h=h, state=state, waves=waves):
                        theory = theory_of_waves(along.tool, lattice, h, state, waves)
                        pairs = list(zip(measured_waves(along, over), theory))
                        if any((m < 0) != (w < 0) for m, w in pairs):
                            raise ValueError(f"one is stable, the other is not: {pairs}")
                        return 100 * max(abs(math.sqrt(m / w) - 1) for m, w in pairs)
                    runs = [wave_run(lattice, h, state, waves, d) for d in ("longitudinal", "transverse")]
                    stress = "rho {} lambda {} epsilon {}".format(*state)
                    name = f"G23 {lattice} h {h} {stress} k {waves[0] / 6:g}, {waves[1] / 6:g} pi/dx"
                    add(name, "% off the relation", 1.0, runs, figure)


GROUPS.append(g23)


# ---- G14: colliding rings (Gray 2001, 6.1) ----

MICROSECONDS = 11.74  # of a time of 1: 50 m/s are 0.0587 c0 (examples/scenes/rings.c)
CASE_OF_GRAY = {"form": "updated", "kernel": "cubic", "h": 1.5, "integrator": "predictor_corrector", "cfl": 0.25}


def ring(run, column, microseconds):
    value = interpolate([t * MICROSECONDS for t in run.col("time_cm")], run.col(column), microseconds)
    if value is None:
        raise ValueError(f"the run ended before {microseconds} us")
    return max(value, 0.0) if column == "separation" else value


def pieces(run, dump=-1, link=1.5, least=1):
    """Pieces of a dump, by default the last."""
    text = subprocess.run([run.tool, "fragments", run.dumps()[dump], f"link={link}", f"least={least}"],
                          stdout=subprocess.PIPE,
                          text=True, check=True).stdout
    return int(text.split("pieces: ")[1].split(",")[0])


def g14(quick, add):
    table = read_table("gray_rings.csv")
    gray = [r for r in table if r["method"] == "SPH"]
    toody = [r for r in table if r["method"] == "TOODY"]
    common = {"every": 1.70358, "dump": "picture"}  # 20 us
    # ours; alpha 0.1 is the least that keeps dp 0.1 in order (alpha 0 tears at 1050 us). The finest that is run is held
    # to the targets: below the thesis's distance, or to what is printed where that is 0
    sizes = (0.2,) if quick else (0.2, 0.1, 0.05)
    for dp in sizes:
        run = Run("rings", dp=dp, cfl=0.4 if dp < 0.1 else 0.25, **common)
        for t, g in zip(toody[1:], gray[1:]):
            for column in ("width", "height", "separation"):
                own = abs(float(g[column]) - float(t[column]))
                target = ("<", round(own, 2)) if own > 0 else 0.05
                us = float(t["time_us"])
                add(f"G14 dp {dp} {column} at {us:g} us against TOODY's {t[column]}", "cm", target if dp == sizes[-1]
                    else None,
                    [run], lambda r, c=column, us=us, ref=float(t[column]): abs(ring(r, c, us) - ref))
        add(f"G14 dp {dp} pieces at the end", "-", 2, [run], lambda r: pieces(r, link=2))
        add(f"G14 dp {dp} smallest distance", "dp", None, [run], lambda r: min(r.col("closest")))
        add(f"G14 dp {dp} share of the kinetic energy in the rebound", "of the start", None, [run],
            lambda r: r.col("kinetic")[-1] / r.col("kinetic")[0])
        add(f"G14 dp {dp} speed of the rebound", "of the start", None, [run],
            lambda r: -r.col("speed_left")[-1] / r.col("speed_left")[0])
    dp = 0.2 if quick else 0.1
    for repulsion, alpha in (("none", 0.5), ("principal", 0.5), ("principal", 0)):
        run = Run("rings", dp=dp, alpha=alpha, repulsion=repulsion, **CASE_OF_GRAY, **common)
        tag = f"G14 thesis's settings, epsilon {0.3 if repulsion == 'principal' else 0} alpha {alpha} dp {dp}"
        add(f"{tag} pieces at the end", "-", None, [run], lambda r: pieces(r, link=2))
        add(f"{tag} smallest distance", "dp", None, [run], lambda r: min(r.col("closest")))
        add(f"{tag} speed of the rebound", "of the start", None, [run],
            lambda r: -r.col("speed_left")[-1] / r.col("speed_left")[0])
        for g in gray[1:] if repulsion != "none" and alpha > 0 else []:
            for column in ("width", "height", "separation"):
                us = float(g["time_us"])
                add(f"{tag} {column} at {us:g} us; thesis {g[column]}", "cm", None, [run],
                    lambda r, c=column, us=us: ring(r, c, us))


# ---- G17: a plate pulled apart (Gray 2001, 6.4.1) ----

def first_time(run, test):
    """The first time of the history at which test(i) holds; the end where it never does."""
    t = run.col("time")
    return next((t[i] for i in range(len(t)) if test(i)), t[-1])


def at_strain(run, column, strain):
    return interpolate(run.col("strain"), run.col(column), strain)


def g17(quick, add):
    for n in (20,) if quick else (20, 30):  # the thesis's is 60: an hour of one processor for a run
        g17_of_size(n, quick, add)


def g17_of_size(n, quick, add):
    common = {"n": n, "frames": 80}
    bare = Run("tension", alpha=0.5, repulsion="none", **CASE_OF_GRAY, **common)
    kept = Run("tension", alpha=0.5, repulsion="principal", dump="picture", **CASE_OF_GRAY, **common)
    add(f"G17 n={n} epsilon 0 nearest pair falls below dp/2; thesis: fractures from 110 to 120", "cm/c0", 120, [bare],
        lambda r: first_time(r, lambda i: r.col("closest")[i] < 0.5))
    add(f"G17 n={n} epsilon 0 pull falls below half of epsilon 0.3's", "cm/c0", 120, [bare, kept],
        lambda a, b: first_time(a, lambda i: a.col("pull")[i] < 0.5 * interpolate(b.col("time"), b.col("pull"),
            a.col("time")[i])))
    add(f"G17 n={n} epsilon 0 smallest distance at 5 % strain", "dp", None, [bare],
        lambda r: at_strain(r, "closest", 0.05))
    add(f"G17 n={n} epsilon 0.3 smallest distance at 14.5 % strain", "dp", (">=", 0.5), [kept],
        lambda r: at_strain(r, "closest", 0.145))
    add(f"G17 n={n} epsilon 0.3 pieces at 14.5 % strain", "-", 1, [kept],
        lambda r: pieces(r, dump=next(i for i, e in enumerate(r.col("strain")) if e >= 0.145), link=2))
    runs = [("thesis's settings, epsilon 0.3", kept)]
    if not quick and n == 20:
        runs.append(("corrected KDK alpha 0.1 epsilon 0.3", Run("tension", **common)))
    for name, run in runs:
        tag = f"G17 n={n} {name}"
        add(f"{tag} largest pull over yield stress", "ratio", None, [run], lambda r: max(r.col("pull")) / 0.03)
        for share in (0.9, 0.7):
            add(f"{tag} neck below {share} of the widest; thesis: necks from 295", "cm/c0", None, [run],
                lambda r, s=share: first_time(r, lambda i: r.col("neck_cm")[i] < s * r.col("widest")[i]))
        add(f"{tag} smallest distance at 14.5 % strain", "dp", None, [run], lambda r: at_strain(r, "closest", 0.145))
        add(f"{tag} place of the neck at the end", "cm", None, [run], lambda r: r.col("neck_at")[-1])


# ---- G18: a brittle plate (Gray 2001, 6.4.2) ----

TIPS = {}  # what tip_speeds found, by the run's name


def tip_speeds(run):
    """Speeds of the two tips of the crack that is first broken (D > 0.99) through: least squares through where either
    tip is whenever it has moved on. A tip is the end along y of the broken particles that hang together, by reference
    places."""
    if run.name in TIPS:
        return TIPS[run.name]
    history, dumps = run.col("time"), run.dumps()
    first = max(next((i for i, b in enumerate(run.col("broken")) if b > 0), len(dumps)) - 1, 0)
    born, place = {}, {}
    table = run.prefix() + "_dump.csv"
    for k in [0] + list(range(first, len(dumps))):
        subprocess.run([run.tool, "export", dumps[k], f"out={table}"], stdout=subprocess.DEVNULL,
                       stderr=subprocess.DEVNULL, check=True)
        with open(table) as f:
            for r in csv.DictReader(line for line in f if not line.startswith("#")):
                if k == 0:
                    place[r["id"]] = (float(r["x_m"]), float(r["y_m"]))
                if float(r["damage"]) > 0.99:
                    born.setdefault(r["id"], history[k])
    os.remove(table)
    if not born:
        raise ValueError("nothing broke")
    near = 1.6 / float(run.options["n"])
    beside = {i: [j for j in born if j != i and math.dist(place[i], place[j]) < near] for i in born}

    def grown(seed):
        """[time, lowest, highest] of the crack from a seed, at each time at which something broke"""
        rows, inside, rim = [], {seed}, {seed}
        for t in sorted({born[i] for i in born if born[i] >= born[seed]}):
            rim = set(inside)
            while rim:
                rim = {j for i in rim for j in beside[i] if j not in inside and born[j] <= t}
                inside |= rim
            ys = [place[i][1] for i in inside]
            rows.append((t, min(ys), max(ys)))
        return rows

    tries = sorted(born, key=lambda i: (born[i], i))[:12]
    best = max((grown(i) for i in tries), key=lambda g: g[-1][2] - g[-1][1] - 0.01 * (g[-1][0] - g[0][0]))
    speeds = []
    for side in (1, 2):
        points = [best[0]] + [b for a, b in zip(best, best[1:]) if a[side] != b[side]]
        if len(points) >= 4 and abs(points[-1][side] - points[0][side]) >= 0.2:
            speeds.append(abs(slope([p[0] for p in points], [p[side] for p in points])))
    TIPS[run.name] = speeds
    return speeds


def mean(values):
    values = list(values)
    return sum(values) / len(values)


def g18(quick, add):
    seeds = range(1, 4 if quick else 11)
    n = 20
    for speed, end, thesis, theory in ((0.0005, 30, 1.5, 2.87), (0.001, 18, 1.5, 1.63), (0.005, 8, 0.7, 0.44)):
        runs = [Run("brittle", n=n, seed=s, speed=speed, duration=end, dump="picture", frames=6) for s in seeds]
        count = lambda r: pieces(r, least=r.options["n"] ** 2 // 33)  # of at least a hundredth of the plate
        tag = f"G18 n={n} V_f {speed:g}, {len(runs)} seeds"
        add(f"{tag} mean fragment, 3 cm over their number; thesis {thesis}, Grady and Kipp {theory}", "cm", None, runs,
            lambda *rr, c=count: mean(3 / c(r) for r in rr))
        add(f"{tag} fewest fragments", "-", None, runs, lambda *rr, c=count: min(c(r) for r in rr))
        add(f"{tag} most fragments", "-", None, runs, lambda *rr, c=count: max(c(r) for r in rr))
        add(f"{tag} mean of the largest pull", "K", None, runs, lambda *rr: mean(max(r.col("pull")) for r in rr))
    for n in (20,) if quick else (20, 40):
        runs = [Run("brittle", n=n, seed=s, form="updated", kernel="cubic", duration=30, end=28, dump="picture",
                    every=0.1)
                for s in (seeds if n == 20 else (1, 2))]
        tag = f"G18 n={n} speed of the tips, {len(runs)} seeds"
        speeds = lambda rr: [v for r in rr for v in tip_speeds(r)]
        add(f"{tag} mean, off c_g 0.4; thesis 0.381", "%", 3.0, runs,
            lambda *rr, f=speeds: 100 * abs(mean(f(rr)) / 0.4 - 1))
        add(f"{tag} mean", "c0", None, runs, lambda *rr, f=speeds: mean(f(rr)))
        add(f"{tag} number of tips", "-", None, runs, lambda *rr, f=speeds: len(f(rr)))
        add(f"{tag} standard deviation of a tip", "c0", None, runs,
            lambda *rr, f=speeds: math.sqrt(mean((v - mean(f(rr))) ** 2 for v in f(rr))))


GROUPS += [g14, g17, g18]


# ---- G19: a hole in a stretched block (Gray 2001 section 6.5). The elastic forms are chosen by convergence: total and
# corrected agree to three digits, updated is weak at free surfaces. Gray's hole has steps; its re-entrant corners are
# what he calls noise.

def rim(run):
    """Measured and exact (sxx + syy)/p1 on the rim, every 5 degrees."""
    return [(run.col(f"rim_{int(r['theta_deg'])}")[-1], float(r["sum"])) for r in read_table("fe_hole.csv")]


def holes(quick, add):
    top = max(float(r["sum"]) for r in read_table("fe_hole.csv"))

    def rows(tag, target, run):
        add(f"G19 {tag} peak on the rim", "% off the exact 3.0546", target, [run],
            lambda r: 100 * abs(r.col("peak_rim")[-1] / top - 1))
        add(f"G19 {tag} curve over the angle, rms", "p1", None, [run],
            lambda r: math.sqrt(sum((a - b) ** 2 for a, b in rim(r)) / len(rim(r))))
        add(f"G19 {tag} largest of a particle (Gray: 3.8)", "p1", None, [run], lambda r: r.col("peak_particle")[-1])

    for n in (70,) if quick else (70, 140, 280):
        rows(f"corrected n={n}", 5.0 if n >= 140 else None, Run("hole", n=n, frames=2))
    if not quick:
        for form in ("total", "updated"):
            rows(f"{form} n=140", 5.0 if form == "total" else None, Run("hole", form=form, frames=2))
        for skip, fit in ((0, 3), (2, 3), (1, 2), (1, 4)):
            rows(f"corrected n=140, fit from {skip} dx to {fit} a", None, Run("hole", skip=skip, fit=fit, frames=2))
        rows("corrected n=140 hole with steps", None, Run("hole", lattice="square", frames=2))
        rows("Gray's settings (updated, cubic, alpha 0.5, epsilon 0.3, steps)", None,
             Run("hole", form="updated", lattice="square", kernel="cubic", alpha=0.5, repulsion="principal", damping=1,
                 integrator="predictor_corrector", cfl=0.25, frames=2))


GROUPS.append(holes)

# ---- G21: surface above an elliptical chamber (section 7.3)


def chambers(quick, add):
    table = read_table("fe_ellipse_surface.csv")
    for depth, gray in ((1.9, 2.19), (3.1, 1.24), (4.4, 1.02)):
        best = next(r for r in table if float(r["depth"]) == depth and r["mark"])
        curve = [(float(r["x"]), float(r["stress"])) for r in table if float(r["depth"]) == depth and not r["mark"]]
        peak, at = float(best["stress"]), float(best["x"])

        def rows(tag, target, run):
            add(f"G21 depth {depth} {tag} maximum (Gray: {gray})", f"% off the exact {peak:.3f}", target, [run],
                lambda r, peak=peak: 100 * abs(r.col("peak")[-1] / peak - 1))
            add(f"G21 depth {depth} {tag} place of the maximum", f"% off the exact {at:.3f} a", target, [run],
                lambda r, at=at: 100 * abs(r.col("peak_x")[-1] / at - 1))
            add(f"G21 depth {depth} {tag} curve to 10 a, rms", "p1", None, [run],
                lambda r, curve=curve: math.sqrt(sum((r.col(f"s_{x:g}")[-1] - s) ** 2 for x, s in curve) / len(curve)))

        for n in (6,) if quick else (6, 10):
            rows(f"corrected n={n}", 5.0 if n >= 10 else None, Run("chamber", depth=depth, n=n, frames=2))
        if depth == 1.9 and not quick:
            for form in ("total", "updated"):
                rows(f"{form} n=6", None, Run("chamber", depth=depth, n=6, form=form, frames=2))


GROUPS.append(chambers)


# ---- G20: a block with flaws is drawn until it breaks (section 7.2). Times are displacement of an end over V_f, so
# that how the ends come to speed does not count. Half of Gray's particles across: ten seeds are about ten minutes of a
# core.

def first(run, count=1):
    """Row of the history in which so many particles are fully damaged first; the last row if none is."""
    return next((i for i, n in enumerate(run.col("full_particles")) if n >= count), -1)


def broken_at(run):
    return run.col("strain")[first(run)] * 3.5 / 1e-4


def median(values):
    v = sorted(values)
    return 0.5 * (v[(len(v) - 1) // 2] + v[len(v) // 2])


def blocks(quick, add):
    seeds = range(1, 3 if quick else 11)
    kinds = (("whole", 320, 250), ("hole", 160, 105), ("gas", 160, 80), ("load", 160, 80))
    runs = {k: [Run("block", kind=k, n=70, seed=s, damage="benz_asphaug_gray", end=end, every=1) for s in seeds]
            for k, end, _ in kinds}
    for k, _, gray in kinds:
        for name, pick in (("median", median), ("least", min), ("most", max)):
            add(f"G20 {k}: first full damage, {name} of {len(seeds)} seeds (Gray: {gray})", "cm/c0", None, runs[k],
                lambda *r, f=pick: f([broken_at(x) for x in r]))
    n = len(seeds)
    add("G20 seeds in which the hole breaks before the whole block", f"of {n}", (">=", n), runs["whole"] + runs["hole"],
        lambda *r: sum(broken_at(h) < broken_at(w) for w, h in zip(r[:n], r[n:])))
    for k in ("gas", "load"):
        add(f"G20 seeds in which pressure ({k}) breaks the hole earlier", f"of {n}", None, runs["hole"] + runs[k],
            lambda *r: sum(broken_at(g) < broken_at(h) for h, g in zip(r[:n], r[n:])))
    for k in ("hole", "gas", "load"):
        add(f"G20 {k}: seeds broken first within three particles of the rim", f"of {n}", (">=", n) if k == "hole"
            else None, runs[k],
            lambda *r: sum(x.col("full_from_rim")[first(x)] < 0.3 for x in r))
        add(f"G20 {k}: seeds broken first within 30 degrees of top or bottom", f"of {n}", (">=", n) if k == "hole"
            else None, runs[k],
            lambda *r: sum(abs(x.col("full_x")[first(x)]) < 0.3 for x in r))
    if not quick:
        for k, end, gray in kinds[:2]:
            add(f"G20 {k}: first full damage with the printed yield stress 0.01 (none before {end})", "cm/c0", None,
                [Run("block", kind=k, n=70, damage="benz_asphaug_gray", end=end, every=1, **{"yield": 0.01})],
                lambda r: broken_at(r) if max(r.col("full_particles")) > 0 else 0)
            add(f"G20 {k}: first full damage, 140 particles across, seed 1 (Gray: {gray})", "cm/c0", None,
                [Run("block", kind=k, n=140, damage="benz_asphaug_gray", end=end, every=1)], broken_at)


GROUPS.append(blocks)


# ---- G22: faults over a magma chamber (section 7.4, figures 7.6 to 7.9). Listed: how many particles are fully damaged,
# and where. A run whose roof is blown out ends early; its last row counts. Maps: sph render PREFIX_0030.sph
# field=damage out=map.png

def calderas(quick, add):
    gray = dict(form="updated", kernel="cubic", alpha=0.5, repulsion="principal", damping=1, cfl=0.3, printed="yes")
    cases = (("7.6, no stretching", dict(speed=0)), ("7.6, Gray's form", dict(gray, speed=0)),
             ("7.7, strain 1.3e-4", dict(speed=5e-6)), ("7.7, Gray's form", dict(gray, speed=5e-6)),
             ("7.8, strain 1.3e-3", dict(speed=5e-5)), ("7.9, higher chamber", dict(speed=5e-6, high=1.12)))
    for name, options in cases:
        run = Run("caldera", spacing=0.1 if quick else 0.07, frames=40, **options)
        for column, what in (("full_surface", "at the surface over the middle"),
                             ("full_left", "in the roof on the left"),
                             ("full_right", "in the roof on the right"), ("full_below", "below the chamber's middle")):
            add(f"G22 {name}: fully damaged {what}", "particles", None, [run], lambda r, c=column: r.col(c)[-1])
        add(f"G22 {name}: mean damage when the pressure rises", "-", None, [run],
            lambda r: interpolate(r.col("time"), r.col("damage_mean"), 100))
        add(f"G22 {name}: mean damage at the end", "-", None, [run], lambda r: r.col("damage_mean")[-1])
    slow = [Run("caldera", spacing=0.1, frames=40, slow=s, speed=5e-5) for s in (1, 2)]
    add("G22 7.8: strain at the first full damage, half as fast over as fast", "ratio", None, slow,
        lambda a, b: b.col("strain")[first(b)] / a.col("strain")[first(a)])


GROUPS.append(calderas)


def cases(quick):
    rows = []
    for group in GROUPS:
        group(quick, lambda name, unit, target, runs, figure: rows.append((name, unit, target, runs, figure)))
    return rows


if __name__ == "__main__":
    sys.exit(main(cases, "validate_solids", __doc__))
