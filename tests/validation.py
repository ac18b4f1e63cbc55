#!/usr/bin/env python3
# SPDX-License-Identifier: MIT. Copyright the sph authors.
"""validation.py: what the validations share: runs of the tool, small figures of their histories, and the table.

Each run is one command of the tool, printed with its figure, so that anybody can repeat it. Runs go in parallel, with
progress and the time left; a row says what it rests on. A row is (name, unit, target or None, runs, figure): the figure
is called with the finished runs and returns a number; a target is a number that it may not exceed, or a pair such as
(">=", 3). References are in tests/refdata/, with their sources in the headers.
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
    stamp = ""  # what else than its command a run depends on

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
        line, note = " ".join(self.command(tool)) + self.stamp, self.prefix() + ".done"
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


def over_10_ms(t, p):
    """The mean of p over 10 ms about each row."""
    means, lo, hi, total = [], 0, 0, 0.0
    for now in t:
        while hi < len(t) and t[hi] <= now + 0.005:
            total += p[hi]
            hi += 1
        while t[lo] < now - 0.005:
            total -= p[lo]
            lo += 1
        means.append(total / (hi - lo))
    return means


def impact_window(run, column):
    """Pressure of a sensor of the scene impact and its 10 ms means, t* 3.2 .. 5.5; ValueError where it ended early."""
    t, ts, p = run.col("time_s"), run.col("t_"), run.col(column)
    if run.error or ts[-1] < 5.5:
        raise ValueError(run.error or "ended early")
    rows = [(a, b) for x, a, b in zip(ts, p, over_10_ms(t, p)) if 3.2 <= x <= 5.5]
    return [a for a, b in rows], [b for a, b in rows]


def impact_noise(run, column="P1_"):
    p, slow = impact_window(run, column)
    return math.sqrt(sum((a - b) ** 2 for a, b in zip(p, slow)) / len(p))


def impact_mean(run, column="P1_"):
    p = impact_window(run, column)[0]
    return sum(p) / len(p)


def impact_peak(run, column="P1_"):
    """Largest mean over 10 ms."""
    return max(over_10_ms(run.col("time_s"), run.col(column)))


def levels_off(run, table="lobovsky_levels.csv", last=4.0):
    """rms of the levels H1 .. H4 less the measured ones until t* = last."""
    off = []
    for r in read_table(table):
        for k in ("H1", "H2", "H3", "H4"):
            ours = interpolate(run.col("t_"), run.col(k), float(r["t"]))
            if float(r["t"]) <= last and ours is not None and r[k] != "nan":
                off.append(ours - float(r[k]))
    return math.sqrt(sum(x * x for x in off) / len(off))


def box_levels_off(run, last):
    """Of SPHERIC's test 2: rms of the levels less the measured ones until `last` seconds, over the depth."""
    off = []
    for r in read_table("spheric_test2.csv"):
        for k in ("H1", "H2", "H3", "H4"):
            ours = interpolate(run.col("time_s"), run.col(k), float(r["time"]))
            if float(r["time"]) <= last and ours is not None:
                off.append((ours - float(r[k])) / 0.55)
    return math.sqrt(sum(x * x for x in off) / len(off))


def box_peak(run, sensor):
    """Largest mean over 20 ms of a sensor on the box, over the measured one."""
    t, p = run.col("time_s"), run.col(sensor + "_")
    means = [sum(q) / len(q) for q in ([b for a, b in zip(t, p) if abs(a - now) <= 0.01] for now in t[::4])]
    return max(means) / max(float(r[sensor]) for r in read_table("spheric_test2.csv"))


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
    if not rows:
        sys.exit(f"{name}: --only {a.only}: no row has that in its name")
    runs = {r.name: r for row in rows for r in row[3]}
    for row in rows:  # equal runs are made once
        row[3][:] = [runs[r.name] for r in row[3]]
    todo, start, done = list(runs.values()), time.time(), 0
    with ThreadPoolExecutor(a.jobs) as pool:
        for run in pool.map(lambda r: (r.go(a.tool, a.keep), r)[1], todo):
            done += 1
            left = (time.time() - start) / done * (len(todo) - done)
            print(f"[{done}/{len(todo)}] {run.name}: {run.error or 'done'} in {run.seconds:.0f} s, about {left:.0f} s "
                  f"left",
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
