# SPDX-License-Identifier: MIT. Copyright the sph authors.
"""tables.py: the lab's tables in memory, the Pareto front of a study, and what halving the error costs along it.

Shared by charts.py and page.py. Reads tests/lab/*.csv and nothing else, so that what is drawn is what the tables hold.
"""
import csv, glob, math, os

NUMBERS = ("n", "x", "error", "steps", "particle_steps", "pairs", "instructions", "ended")
COSTS = ("instructions", "pairs")
KEYS = ("study", "title", "scene", "norm", "quantity", "reference", "unit", "resolution", "command", "defaults",
        "atlas")


def number(text):
    """A finite number, or None: empty cells and words are no numbers."""
    try:
        v = float(text)
    except (TypeError, ValueError):
        return None
    return v if math.isfinite(v) else None


def read(path):
    """Header (`# key: text` for KEYS, other lines under "") and rows (dicts of text) of a table; None if there is no
    such file."""
    if not os.path.exists(path):
        return None
    head, body = {"": []}, []
    with open(path, newline="") as f:
        for line in f:
            if not line.startswith("#"):
                body.append(line)
                continue
            key, colon, text = line[1:].strip().partition(": ")
            if colon and key in KEYS:
                head[key] = text
            elif not key.startswith("SPDX"):
                head[""].append(line[1:].strip())
    rows = list(csv.DictReader(body))
    if not rows:
        raise SystemExit(f"charts: {path} has no rows")
    return head, rows


def need(path, rows, columns):
    missing = [c for c in columns if c not in rows[0]]
    if missing:
        raise SystemExit(f"charts: {path} has no column {', '.join(missing)}")


class Study:
    """A table of runs. A row is good if it reached its end and has an error, controlled if step control chose its
    steps."""

    def __init__(self, head, rows, path):
        self.name, self.title, self.scene = head["study"], head.get("title", head["study"]), head.get("scene",
            head["study"])
        self.norm, self.reference = head.get("norm", ""), head.get("reference", "")
        self.unit, self.command = head.get("unit", ""), head.get("command", "")
        self.resolution = head.get("resolution", "n")
        self.size = self.resolution.split(",")[0]
        self.defaults = dict(w.split("=", 1) for w in head.get("defaults", "").split() if "=" in w)
        self.path, self.rows = path, []
        for number_of_row, r in enumerate(rows):
            r = dict(r, row=number_of_row)
            for k in NUMBERS:
                r[k] = number(r[k])
            r["given"] = dict(w.split("=", 1) for w in r["options"].split() if "=" in w)
            r["good"] = r["error"] is not None and (r["ended"] or 0) >= 1 and not r["cause"]
            self.rows.append(r)

        for r in self.rows:
            r["lucky"] = any(self.lucky(r, q) for q in self.rows)

    @staticmethod
    def lucky(a, b):
        """Is a's error by luck, by what b says, the same method with other pairs? As studies_lucky in
        tools/studies.c."""
        if a["sweep"] not in ("method", "precision") or any(a[k] != b[k] for k in ("sweep", "label", "precision")):
            return False
        if a["error"] is None or b["error"] is None or b["cause"] or not a["pairs"] or not b["pairs"]:
            return False
        fall = (b["pairs"] / a["pairs"]) ** (4 / 3) if b["pairs"] < a["pairs"] else 1
        return b["error"] * fall > 2 * a["error"]

    def sweep(self, name):
        return [r for r in self.rows if r["sweep"] == name]

    def labels(self, name):
        return list(dict.fromkeys(r["label"] for r in self.sweep(name)))

    def finer(self, r):
        """Sorts from coarse to fine: spacings get smaller, counts larger."""
        return -r["n"] if self.size == "dp" else r["n"]

    def choices(self, cost):
        return [r for r in self.rows if r["good"] and not r["lucky"] and r["sweep"] != "courant" and r[cost]]

    def front(self, cost):
        """From cheap and poor to dear and good: no other run is as cheap and as good."""
        best = []
        for r in sorted(self.choices(cost), key=lambda r: (r[cost], r["error"], r["row"])):
            if not best or r["error"] < best[-1]["error"]:
                best.append(r)
        return best

    def name_of(self, r):
        """What distinguishes a run: its label, size, and what a sweep changed."""
        more = f", h {r['x']:g} dx" if r["sweep"] == "h" else ""
        more += ", double" if r["precision"] == "double" else ""
        return f"{r['label']}{more}, {self.size} {r['n']:g}"

    def run_line(self, r):
        double = " precision=double" if r["precision"] == "double" and "precision" not in r["given"] else ""
        return f"sph run {self.scene} {r['options']}{double}"


def studies(folder):
    found = []
    for path in sorted(glob.glob(os.path.join(folder, "*.csv"))):
        head, rows = read(path)
        if "study" in head and "scene" in head:
            need(path, rows, NUMBERS + ("sweep", "label", "precision", "cause", "options"))
            found.append(Study(head, rows, path))
    return found


def halving(front, cost):
    """Cost of half the error over cost of the error: 2^p of the straight line ln cost = a - p ln error through the
    front by least squares. None where the front has less than three members or spans less than one halving."""
    if len(front) < 3 or front[0]["error"] < 2 * front[-1]["error"] or front[-1]["error"] <= 0:
        return None
    x, y = [math.log(r["error"]) for r in front], [math.log(r[cost]) for r in front]
    mx, my = sum(x) / len(x), sum(y) / len(y)
    slope = sum((a - mx) * (b - my) for a, b in zip(x, y)) / sum((a - mx) ** 2 for a in x)
    return 2 ** -slope


def cheapest(front, error):
    """The first member of the front with at most that error; None if it is not reached."""
    return next((r for r in front if r["error"] <= error), None)
