#!/usr/bin/env python3
# SPDX-License-Identifier: MIT. Copyright the sph authors.
"""validate.py: runs the water cases and holds them against experiments, volume-of-fluid and exact solutions.

usage: validate.py [--quick] [--jobs N] [--only WORD] [--keep] [--tool build/sph]
Each run is one command of the tool, printed with its figure, so that anybody can repeat it. Writes
build/validate.csv (name,value,unit,target,ok) and prints the same as a table. Runs go in parallel; a row says what it
rests on. References are in tests/refdata/, with their sources in the headers. Exit code 1 if a row with a target misses it.
Run, main and the small figures serve validate_solids.py too.
"""
import argparse, csv, glob, math, os, subprocess, sys, time
from concurrent.futures import ThreadPoolExecutor

HERE = os.path.dirname(os.path.abspath(__file__))


def read_table(name):
    with open(os.path.join(HERE, "refdata", name)) as f:
        return list(csv.DictReader(line for line in f if not line.startswith("#")))


def interpolate(xs, ys, x):
    """Value at x of the line through the points; None outside."""
    for (x0, y0), (x1, y1) in zip(zip(xs, ys), zip(xs[1:], ys[1:])):
        if x0 <= x <= x1 and x1 > x0:
            return y0 + (y1 - y0) * (x - x0) / (x1 - x0)
    return None


class Run:
    """One command of the tool, and its history as columns. With dump=picture its dumps are there too."""
    out = os.path.join("build", "validate")

    def __init__(self, scene, **options):
        self.scene, self.options = scene, options
        self.name = "_".join([scene] + [f"{k}-{v}" for k, v in options.items()]).replace("/", "_").replace(".", "p")
        self.columns, self.error, self.seconds, self.tool = {}, None, 0.0, None

    def prefix(self):
        return os.path.join(self.out, self.name)

    def command(self, tool):
        options = dict(self.options)
        options.setdefault("dump", "none")
        return [tool, "run", self.scene] + [f"{k}={v}" for k, v in options.items()] + [f"out={self.prefix()}"]

    def dumps(self):
        return sorted(glob.glob(glob.escape(self.prefix()) + "_[0-9]*.sph"))

    def go(self, tool, keep=False):
        """keep: a run that was finished before by the same command is not made again"""
        start, self.tool = time.time(), tool
        line, note = " ".join(self.command(tool)), self.prefix() + ".done"
        kept = keep and os.path.exists(note) and open(note).read().splitlines()
        if kept and kept[0] == line:
            self.error = kept[1] if len(kept) > 1 else None
        else:
            for old in self.dumps():
                os.remove(old)
            done = subprocess.run(self.command(tool), stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
            if done.returncode:
                said = done.stdout.strip().splitlines() or ["no output"]
                self.error = next((s for s in said if s.startswith("sph run: step")), said[-1])
            with open(note, "w") as f:
                f.write("\n".join([line] + ([self.error] if self.error else [])) + "\n")
        self.seconds = time.time() - start
        path = self.prefix() + ".csv"
        if os.path.exists(path):
            with open(path) as f:
                rows = list(csv.reader(line for line in f if not line.startswith("#")))
            self.columns = {h: [float(r[i]) for r in rows[1:]] for i, h in enumerate(rows[0])}

    def col(self, start):
        """The column whose name begins so."""
        for name, values in self.columns.items():
            if name.startswith(start):
                return values
        raise KeyError(f"{self.name}: no column {start} among {list(self.columns)}")


# ---- figures: each takes finished runs and returns a number ----

def front_against_vof(run, table, z_last):
    """Largest |Z/Z_vof - 1| in unshifted time, in percent, for Z_vof in 1.2 .. z_last."""
    ref = read_table(table)
    t, z = run.col("T_"), run.col("Z_")
    worst = 0.0
    for r in ref:
        zv = float(r["Zf_sl_40"])
        if 1.2 <= zv <= z_last:
            zi = interpolate(t, z, float(r["T"]))
            if zi is not None:
                worst = max(worst, abs(zi / zv - 1))
    return 100 * worst


def front_against_experiment(run, points, match):
    """Largest |Z/Z_exp - 1| in percent with time matched at one point, and the shift in T."""
    t, z = run.col("T_"), run.col("Z_")
    shift = match[0] - interpolate(z, t, match[1])
    worst = 0.0
    for te, ze in points:
        zi = interpolate([x + shift for x in t], z, te)
        if zi is not None and ze >= 1.2:
            worst = max(worst, abs(zi / ze - 1))
    return 100 * worst, shift


def zero_crossings(t, y):
    return [t0 + (t1 - t0) * y0 / (y0 - y1) for t0, t1, y0, y1 in zip(t, t[1:], y, y[1:]) if (y0 < 0) != (y1 < 0)]


def slope(xs, ys):
    n, mx, my = len(xs), sum(xs) / len(xs), sum(ys) / len(ys)
    return sum((x - mx) * (y - my) for x, y in zip(xs, ys)) / sum((x - mx) ** 2 for x in xs)


# ---- cases ----

def cases(quick):
    """Rows to be: (name, unit, target or None, runs, figure)."""
    rows = []

    def add(name, unit, target, runs, figure):
        rows.append((name, unit, target, runs, figure))

    # G1: hydrostatic column, every wall kind. The cubic spline's own quadrature error is 2.2 % at h 1.2 (README, findings),
    # so the target is held against the quintic at the same h; ghosts that hold p = 0 are listed without one.
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


def bound(target):
    """A target as an operator and a number: 3 is (<=, 3); others are given as such pairs."""
    return target if isinstance(target, tuple) else ("<=", target)


def meets(value, target):
    sign, limit = bound(target)
    return {"<=": value <= limit, "<": value < limit, ">=": value >= limit}[sign]


def main(cases, name, doc):
    """Makes the runs that the rows ask for, in parallel, and writes build/NAME.csv."""
    p = argparse.ArgumentParser(description=doc.split("\n")[0])
    p.add_argument("--quick", action="store_true", help="the small sizes only")
    p.add_argument("--jobs", type=int, default=2)
    p.add_argument("--only", default="", help="rows whose name contains this word")
    p.add_argument("--keep", action="store_true", help="take runs that an earlier call finished")
    p.add_argument("--tool", default=os.path.join("build", "sph"))
    a = p.parse_args()
    if not os.path.exists(a.tool):
        sys.exit(f"{name}: {a.tool} is not there; run make first")
    Run.out = os.path.join("build", name)
    os.makedirs(Run.out, exist_ok=True)
    rows = [r for r in cases(a.quick) if a.only in r[0]]
    runs = {r.name: r for row in rows for r in row[3]}
    for row in rows:  # equal runs are made once
        row[3][:] = [runs[r.name] for r in row[3]]
    todo, start, done = list(runs.values()), time.time(), 0
    with ThreadPoolExecutor(a.jobs) as pool:
        for run in pool.map(lambda r: (r.go(a.tool, a.keep), r)[1], todo):
            done += 1
            left = (time.time() - start) / done * (len(todo) - done)
            print(f"[{done}/{len(todo)}] {run.name}: {run.error or 'done'} in {run.seconds:.0f} s, about {left:.0f} s left",
                  file=sys.stderr, flush=True)
    missed, lines = 0, []
    for row, unit, target, rr, figure in rows:
        try:
            value = figure(*rr)
            ok = "" if target is None else "yes" if meets(value, target) else "no"
            text = f"{value:.4g}"
        except (KeyError, ValueError, IndexError, TypeError, ZeroDivisionError) as e:
            text, ok = "failed", "no"
            print(f"{name}: {row}: {'; '.join(str(r.error) for r in rr if r.error) or e}", file=sys.stderr)
        missed += ok == "no"
        lines.append((row, text, unit, "" if target is None else "{} {:g}".format(*bound(target)), ok))
    path = os.path.join("build", name + ".csv")
    with open(path + ".tmp", "w") as f:
        w = csv.writer(f, lineterminator="\n")
        w.writerow(["name", "value", "unit", "target", "ok"])
        w.writerows(lines)
    os.replace(path + ".tmp", path)
    for line in lines:
        print(f"{line[0]:58} {line[1]:>10} {line[2]:24} {line[3]:8} {line[4]}")
    print(f"{name}: {len(lines)} rows, {missed} missed; {path}")
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main(cases, "validate", __doc__))
