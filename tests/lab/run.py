#!/usr/bin/env python3
# SPDX-License-Identifier: MIT. Copyright the sph authors.
"""run.py: makes the lab's runs and writes a table for each study.

usage: run.py [--jobs N] [--studies A,B] [--smoke] [--tool build/lab/sph] [--counter build/sph] [--valgrind valgrind]
[--list] [--most SECONDS]

Each row of tests/lab/STUDY.csv is one command of the tool. Runs are kept in build/lab and made again only if their
command, the golden hashes or the scene's source changed, so that an interrupted call goes on where it was. Tables hold
no seconds: those go into seconds.csv, as multiples of the calibration loop that ran in the same process. Instructions
are counted by callgrind in the default build over a few steps at the study's coarsest size, and taken times the
particle-steps of the run.
--smoke: a few coarse rows of each study, compared with the committed tables; nothing is written there.
--most: only the rows of --smoke and those whose run took less by seconds.csv, or is there; tables then hold no others
and say so.
"""
import argparse, csv, glob, hashlib, io, os, re, shutil, subprocess, sys, threading, time
from concurrent.futures import ThreadPoolExecutor

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
sys.path.insert(0, HERE)
from studies import STUDIES, plus  # noqa: E402
from validation import Run  # noqa: E402

COLUMNS = ["sweep", "label", "precision", "n", "x", "error", "steps", "particle_steps", "pairs", "instructions",
           "ended", "cause", "options"]
COUNTED_STEPS = 5
WORK = os.path.join("build", "lab", "runs")


def digest(*names):
    h = hashlib.sha256()
    for name in names:
        with open(os.path.join(ROOT, name), "rb") as f:
            h.update(f.read())
    return h.hexdigest()[:16]


def text(value):
    return value if isinstance(value, str) else f"{value:.6g}"


class LabRun(Run):
    """A run that also leaves what it cost, under a name made of its command and of what its bits depend on."""
    out = WORK

    def __init__(self, study, sweep, label, precision, n, x, options):
        Run.__init__(self, study.scene, **options, precision=precision, steps=study.most_steps)
        self.sweep, self.label, self.precision, self.n, self.x = sweep, label, precision, n, x
        self.given = " ".join(f"{k}={v}" for k, v in options.items())
        key = " ".join([study.scene, self.given, precision, str(study.most_steps)])
        self.stamp = " # " + STAMP[study.scene]
        self.name = hashlib.sha256((key + self.stamp).encode()).hexdigest()[:20]

    def command(self, tool):
        return Run.command(self, tool) + [f"cost={self.prefix()}.cost"]

    def cost(self, name):
        if not os.path.exists(self.prefix() + ".cost"):
            return 0.0  # it was refused before its first step
        with open(self.prefix() + ".cost") as f:
            return float(next(r["value"] for r in csv.DictReader(f) if r["name"] == name))


SHARED = ["examples/scenes/scenes.c", "examples/scenes/scene.h"]
STAMP = {s.scene: digest("tests/golden.csv", f"examples/scenes/{s.scene}.c", *SHARED) for s in STUDIES}


def rows_of(s):
    """The runs of a study, in the order of its table."""
    size = s.resolution.split(",")[0]

    def row(sweep, label, precision, n, options, x=""):
        return LabRun(s, sweep, label, precision, n, x,
                      {size: text(n), **{k: text(v) for k, v in plus(s.base, **options).items()}})

    rows = [row("method", label, "float", n, o) for label, o in s.methods.items()
            for n in s.sizes + s.more.get(label, [])]
    rows += [row("precision", label, "double", n, s.methods[label]) for label in s.doubles for n in s.sizes]
    rows += [row("h", label, "float", s.at, plus(o, h=x), x) for label, (o, xs) in s.h.items() for x in xs]
    for label, (o, xs) in s.courant.items():
        h = o.get("h", s.base.get("h", default_of(s.scene, "h")))
        rows += [row("courant", label, "float", s.at, plus(o, dt=x * s.step(s.at, h)), x) for x in xs]
    return rows


def default_of(scene, name):
    return float(choices_of(scene)[name])


def choices_of(scene):
    """Defaults of the scene's parameters, as `sph list` prints them."""
    if scene not in CHOICES:
        said = subprocess.run([TOOL, "list", scene], stdout=subprocess.PIPE, text=True, check=True).stdout
        CHOICES[scene] = dict(re.findall(r"^(\w+) +(\S+)", said, re.M))
    return CHOICES[scene]


CHOICES = {}


def defaults(study):
    """The choices that a study's methods leave alone."""
    own = choices_of(study.scene)
    return " ".join(f"{k}={study.base.get(k, own[k])}"
                    for k in ("form", "kernel", "h", "scheme", "integrator", "cfl", "alpha", "diffusion", "wall")
                    if k in own and not (k in ("scheme", "diffusion", "wall") and "form" in own))


# ---- instructions ----

def count(args, run, coarsest):
    """Instructions of a particle-step and its stages, in the default build; None without valgrind."""
    if not shutil.which(args.valgrind):
        return None
    options = dict(o.split("=", 1) for o in run.given.split())
    options.update({coarsest[0]: coarsest[1], "precision": run.precision, "steps": str(COUNTED_STEPS), "dump": "none"})
    command = [args.counter, "run", run.scene] + [f"{k}={v}" for k, v in options.items()]
    key = hashlib.sha256((" ".join(command) + digest_of_code()).encode()).hexdigest()[:20]
    base = os.path.join(WORK, "count_" + key)
    with COUNTING:  # rows of several studies share a count
        lock = COUNTS.setdefault(key, threading.Lock())
    with lock:
        return counted(args, command, base)


COUNTING, COUNTS = threading.Lock(), {}


def counted(args, command, base):
    if not os.path.exists(base + ".out"):
        done = subprocess.run([args.valgrind, "--tool=callgrind", f"--callgrind-out-file={base}.tmp",
                               "--toggle-collect=sph*_step_to"] +
                              command + [f"out={base}", f"cost={base}.cost"], stdout=subprocess.DEVNULL,
                              stderr=subprocess.DEVNULL)
        if not os.path.exists(base + ".cost") or done.returncode not in (0, 1):
            return None
        os.replace(base + ".tmp", base + ".out")
    with open(base + ".cost") as f:
        particle_steps = float(next(r["value"] for r in csv.DictReader(f) if r["name"] == "particle_steps"))
    if not particle_steps:
        return None
    total, stages = read_callgrind(base + ".out")
    return total / particle_steps, {k: v / particle_steps for k, v in stages.items()}


def digest_of_code():
    global CODE
    if not CODE:
        CODE = digest(*sorted(os.path.relpath(f, ROOT) for f in glob.glob(os.path.join(ROOT, "sph", "*.[ch]"))))
    return CODE


CODE = ""


def read_callgrind(path):
    """Instructions in all, and of each pass: what the functions that run programs and jobs call."""
    names, total, stages, inside, callee, pending = {}, 0, {}, "", "", False

    def name_of(spec):
        m = re.match(r"\((\d+)\)(?: (.*))?", spec)
        if m.group(2):
            names[m.group(1)] = m.group(2)
        return re.sub(r"^sph\d[fd]_", "", names[m.group(1)])

    with open(path) as f:
        for line in f:
            if line.startswith("fn="):
                inside = name_of(line[3:].strip())
            elif line.startswith("cfn="):
                callee = name_of(line[4:].strip())
            elif line.startswith("calls="):
                pending = True
            elif line.startswith("totals:") or line.startswith("summary:"):
                total = int(line.split(":")[1].split()[0])
            elif pending:
                pending = False
                if inside.split("'")[0] in ("run_program", "run_job") and callee.split("'")[0] not in ("run_program",
                    "run_job"):
                    stages[callee] = stages.get(callee, 0) + int(line.split()[1])
    return total, stages


# ---- tables ----

LEFT_OUT = {}


def seconds_of_rows():
    """What runs took when they were last made."""
    with open(os.path.join(HERE, "seconds.csv")) as f:
        rows = [r for r in csv.reader(line for line in f if not line.startswith("#"))][1:]
    return {(r[0], r[1], r[2]): float(r[3]) for r in rows}


def made_already(r):
    """Seconds of a row that no table knows: none where its run is there, else more than anybody has."""
    return 0 if os.path.exists(r.prefix() + ".cost") else float("inf")


def table(study, rows, counts):
    out = io.StringIO()
    out.write("# SPDX-License-Identifier: MIT. Copyright the sph authors.\n")
    for name, value in (("study", study.name), ("title", study.title), ("scene", study.scene), ("norm", study.norm),
                        ("quantity", study.quantity), ("reference", study.reference),
                        ("unit", study.unit), ("resolution", study.resolution), ("defaults", defaults(study)),
                        ("command", f"make lab STUDIES={study.name}"), ("left out", LEFT_OUT.get(study.name, ""))):
        if name == "left out" and not value:
            continue
        out.write(f"# {name}: {value}\n")
    w = csv.writer(out, lineterminator="\n")
    w.writerow(COLUMNS)
    for r in rows:
        w.writerow(line_of(study, r, counts))
    return out.getvalue()


def line_of(study, r, counts):
    try:
        error, cause = f"{study.error(r):.4g}", ""
    except (KeyError, ValueError, IndexError, TypeError, ZeroDivisionError) as e:
        error, cause = "", re.sub(r"^sph run: ", "", str(r.error or f"no figure: {e}"))
    steps, done = r.cost("steps"), r.cost("particle_steps")
    ended = r.cost("time") / r.cost("end") if r.cost("end") else 0
    if ended < 1 - 1e-9 and not r.error:
        error, cause = "", f"not at the end after {steps:.0f} steps"
    ir = counts.get(r.name)
    return [r.sweep, r.label, r.precision, text(r.n), text(r.x), error, f"{steps:.0f}", f"{done:.0f}",
            f"{r.cost('pairs'):.0f}",
            f"{ir[0] * done:.4g}" if ir else "", f"{ended:.4g}", cause, r.given]


def write(name, content):
    path = os.path.join(HERE, name)
    with open(path + ".tmp", "w") as f:
        f.write(content)
    os.replace(path + ".tmp", path)


# ---- the call ----

def smoke_rows(study, rows):
    """The coarsest rows of every label, and the ends of the sweeps: quick, and among them runs that blow up."""
    few = [r for r in rows if r.sweep == "method" and r.n == study.sizes[0]]
    few += [r for r in rows if r.sweep == "precision" and r.n == study.sizes[0]][:1]
    few += [r for r in rows if r.sweep == "courant" and r.x == max(q.x for q in rows if q.sweep == "courant")][:2]
    return few


def compare(study, rows):
    """Rows that differ from the committed table; instructions are of one compiler and left out."""
    k = COLUMNS.index("instructions")
    with open(os.path.join(HERE, study.name + ".csv")) as f:
        held = {(r[0], r[1], r[2], r[3], r[4]): r for r in csv.reader(line for line in f if not line.startswith("#"))}
    bad = 0
    for r in rows:
        line = line_of(study, r, {})
        there = held.get(tuple(line[:5]))
        if not there or there[:k] + there[k + 1:] != line[:k] + line[k + 1:]:
            bad += 1
            print(f"{study.name}: {line[:5]}: is {line[5:k] + line[k + 1:]}, committed "
                  f"{there and there[5:k] + there[k + 1:]}")
    return bad


def main():
    global TOOL
    p = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    p.add_argument("--jobs", type=int, default=2)
    p.add_argument("--studies", default="")
    p.add_argument("--smoke", action="store_true")
    p.add_argument("--tool", default=os.path.join("build", "lab", "sph"), help="runs are made with this one")
    p.add_argument("--counter", default=os.path.join("build", "sph"), help="instructions are counted in this one")
    p.add_argument("--valgrind", default="valgrind")
    p.add_argument("--list", action="store_true", help="print the commands and end")
    p.add_argument("--most", type=float, default=0, help="seconds; dearer rows are left out of the tables")
    args = p.parse_args()
    wanted = [w for w in args.studies.replace(",", " ").split() if w]
    known = [s.name for s in STUDIES]
    for w in wanted:
        if w not in known:
            sys.exit(f"lab: no study {w}; allowed: {' '.join(known)}")
    if not os.path.exists(args.tool):
        sys.exit(f"lab: {args.tool} is not there; run make lab, which builds it")
    TOOL = args.tool
    os.makedirs(WORK, exist_ok=True)
    studies = [s for s in STUDIES if not wanted or s.name in wanted]
    rows = {s.name: rows_of(s) for s in studies}
    if args.smoke:
        rows = {s.name: smoke_rows(s, rows[s.name]) for s in studies}
    if args.most > 0:
        known_seconds = seconds_of_rows()
        for s in studies:
            few = {r.name for r in smoke_rows(s, rows[s.name])}
            every = len(rows[s.name])
            rows[s.name] = [r for r in rows[s.name] if r.name in few or
                            known_seconds.get((r.scene, r.precision, r.given), made_already(r)) < args.most]
            LEFT_OUT[s.name] = f"{every - len(rows[s.name])} dearer rows, of --most {args.most:g}; make lab makes all"
    if args.list:
        for s in studies:
            for r in rows[s.name]:
                print(" ".join(r.command(args.tool)[:-2]))
        return 0
    runs = {r.name: r for s in studies for r in rows[s.name]}
    todo, start, done = list(runs.values()), time.time(), 0
    with ThreadPoolExecutor(args.jobs) as pool:
        for r in pool.map(lambda r: (r.go(args.tool, True), r)[1], todo):
            done += 1
            if r.seconds > 1 or done == len(todo):
                left = (time.time() - start) / done * (len(todo) - done)
                print(f"[{done}/{len(todo)}] {r.scene} {r.given}: {r.error or 'done'} in {r.seconds:.0f} s, about "
                      f"{left:.0f} s left", file=sys.stderr, flush=True)
    for s in studies:
        rows[s.name] = [with_position(runs[r.name], r) for r in rows[s.name]]
    if args.smoke:
        bad = sum(compare(s, rows[s.name]) for s in studies)
        print(f"lab-smoke: {sum(map(len, rows.values()))} rows of {len(studies)} studies, {bad} differ from the "
              f"committed tables")
        return bad > 0 or not any(rows.values())
    if not shutil.which(args.valgrind):
        print("lab: no valgrind, so instructions are left out; apt-get install --no-install-recommends valgrind",
              file=sys.stderr)
    counts, stages = {}, []
    for s in studies:
        coarsest = (s.resolution.split(",")[0], text(s.sizes[0]))
        with ThreadPoolExecutor(args.jobs) as pool:
            found = pool.map(lambda r: (r.name, count(args, r, coarsest)), rows[s.name])
        mine = {name: c for name, c in found if c}
        counts.update(mine)
        write(s.name + ".csv", table(s, rows[s.name], mine))
        first = next(r for r in rows[s.name] if r.sweep == "method")
        if mine.get(first.name) and s.scene not in [row[0] for row in stages]:
            whole, passes = mine[first.name]
            shown = {k: v for k, v in passes.items() if v > 0.01 * whole}
            for stage, v in sorted(shown.items(), key=lambda kv: -kv[1]) + [("rest", whole - sum(shown.values()))]:
                stages.append([s.scene, first.precision, first.given, stage, f"{v:.4g}"])
        print(f"lab: tests/lab/{s.name}.csv, {len(rows[s.name])} rows", file=sys.stderr)
    merge("stages.csv", ["scene", "precision", "options", "stage", "instructions"], stages, 1,
          "instructions a particle-step by pass of the step, first method of each study; of the gcc that made "
          "build/sph")
    merge("seconds.csv", ["scene", "precision", "options", "seconds", "calibrations"],
          [[r.scene, r.precision, r.given, f"{r.cost('seconds'):.4g}", f"{r.cost('calibrations'):.4g}"] for r in todo],
          3,
          "seconds of stepping of each run, and as multiples of tools/calibrate.c in the same process; the only table "
          "with seconds")
    return 0


def with_position(run, row):
    """The finished run in the place of one that has the same command."""
    for k in ("columns", "error", "seconds", "tool"):
        setattr(row, k, getattr(run, k))
    return row


def merge(name, columns, rows, keys, what):
    """Rows into a table that may hold those of other studies: those of the same key are replaced."""
    path, old = os.path.join(HERE, name), []
    fresh = {tuple(r[:keys]) for r in rows}
    if os.path.exists(path):
        with open(path) as f:
            old = [r for r in csv.reader(line for line in f if not line.startswith("#"))][1:]
    out = io.StringIO()
    out.write(f"# SPDX-License-Identifier: MIT. Copyright the sph authors.\n# {what}\n# command: make lab\n")
    w = csv.writer(out, lineterminator="\n")
    w.writerow(columns)
    kept = [r for r in old if tuple(r[:keys]) not in fresh] + rows
    order = {s.scene: i for i, s in reversed(list(enumerate(STUDIES)))}
    w.writerows(sorted(kept, key=lambda r: order.get(r[0], 99)))
    write(name, out.getvalue())


if __name__ == "__main__":
    sys.exit(main())
