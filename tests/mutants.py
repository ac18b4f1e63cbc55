#!/usr/bin/env python3
# SPDX-License-Identifier: MIT. Copyright the sph authors.
"""Single changes of the kernel, one at a time: does a test see them?

A mutant is the kernel with one change in one place of sph/: an operator, a sign, a constant, an index, a bound, a
statement left out, two arguments swapped. It is built in a copy of the tree and given to the golden runs, then to those
test programs that run the changed line (known from a build with line counters), the quickest first, until one fails.

  killed    a hash differs, a test fails, or a program dies or hangs; `by` says which
  survived  no test saw it
  equal     the same object code in every build: not a change
  invalid   does not compile (another one is drawn in its place)

usage: tests/mutants.py [--count N] [--seed S] [--jobs J] [--out FILE] [--minutes M] [--only sph/FILE] [--show]

The table (name,value,unit,target,ok after rows of file,line,column,kind,from,to,verdict,by) goes on where it stopped:
rows that are there are not run again. Exit 1 when fewer than 95 % of those that are not equal are killed.
"""
import argparse, csv, glob, json, os, random, re, shutil, subprocess, sys, threading, time

BUILDS = ["2f", "1d", "3f", "2d", "1f", "3d"]
GOLDEN = ["2f", "1d", "3f"]
WORK = os.path.join(os.environ.get("BUILD", "build"), "mutants")
MAKE = ["make", "-s", "--no-print-directory", "CC=" + os.environ.get("GCC", "gcc"), "OPT=-O1", "WARN=-w"]
TARGET = 95.0


# ---- the changes ----

TOKEN = re.compile(r'"(?:\\.|[^"\\])*"|\'(?:\\.|[^\'\\])*\'|[A-Za-z_]\w*|0[xX][0-9a-fA-F.]+(?:[pP][-+]?\d+)?\w*|'
                   r'\d+\.?\d*(?:[eE][-+]?\d+)?\w*|->|\+\+|--|<<=?|>>=?|[-+*/%&|^<>=!]=|&&|\|\||\S')
SWAPS = {"+": ["-"], "-": ["+"], "*": ["/"], "/": ["*"], "<": ["<=", ">="], ">": [">=", "<="], "<=": ["<", ">"],
         ">=": [">", "<"], "==": ["!="], "!=": ["=="], "&&": ["||"], "||": ["&&"], "+=": ["-="], "-=": ["+="],
         "*=": ["/="], "<<": [">>"], ">>": ["<<"], "&": ["|"], "|": ["&"], "++": ["--"], "true": ["false"],
         "false": ["true"], "v_add": ["v_sub"], "v_min": ["v_max"], "v_max": ["v_min"], "sph_min": ["sph_max"],
         "sph_max": ["sph_min"]}


def code_lines(path):
    """(number, text) of the lines that hold code of a function: no comment, no preprocessor, nothing at file level."""
    text = open(path).read()
    blank = lambda m: re.sub(r"[^\n]", " ", m.group(0))
    text = re.sub(r"/\*.*?\*/|//[^\n]*", blank, text, flags=re.S)
    out, depth, directive = [], 0, False
    for n, line in enumerate(text.split("\n"), 1):
        skip = directive or line.lstrip().startswith("#")
        directive = skip and line.rstrip().endswith("\\")
        if skip:
            continue
        if depth > 0 and line.strip() not in ("", "{", "}"):
            out.append((n, line))
        depth += line.count("{") - line.count("}")
    return out


def changes(path):
    """every change of a file: (line, column, kind, from, to)"""
    for n, line in code_lines(path):
        body = line.strip()
        if body.startswith(("static ", "enum ", "struct ", "case ", "default:", "extern ")) and not "=" in body:
            continue
        tokens = [(m.start(), m.group(0)) for m in TOKEN.finditer(line)]
        for k, (at, tok) in enumerate(tokens):
            before = tokens[k - 1][1] if k else ""
            after = tokens[k + 1][1] if k + 1 < len(tokens) else ""
            binary = re.match(r"[\w)\]]", before[-1:] or " ") is not None
            for new in SWAPS.get(tok, []):
                if tok in "+-*&" and not binary:
                    continue  # a sign, a pointer, an address
                if tok == "*" and re.match(r"^(const|void|\w+_t|sph_\w+|struct|char|int|double|float|vreal)$", before):
                    continue
                yield n, at, "operator", tok, new
            if tok == "-" and not binary:
                yield n, at, "sign", tok, " "
            if re.match(r"^\d+\.\d*\w*|^\d+[eE]|^\.\d", tok):
                value = float(re.match(r"[\d.eE+-]+", tok).group(0))
                yield n, at, "constant", tok, repr(value * 1.01 if value else 0.01)
            elif re.match(r"^\d+[uU]?$", tok):
                value = int(tok.rstrip("uU"))
                kind = "index" if before == "[" and after == "]" else "constant"
                yield n, at, kind, tok, str(value + 1)
            if tok == "[" and re.match(r"^[A-Za-z_]\w*$", after) and k + 2 < len(tokens) and tokens[k + 2][1] == "]":
                yield n, tokens[k + 1][0], "index", after, "0"
        if re.match(r"^\s*[\w\[\]>.*()-]+\s*[-+*/|&]?=[^=].*;\s*$|^\s*\w+\(.*\);\s*$|^\s*(break|continue);\s*$", line) \
                and not re.match(r"^\s*(const|static|return|\w+ \*?\w+ *=)", line):
            yield n, len(line) - len(line.lstrip()), "dropped", body, ";"
        for m in re.finditer(r"(\w+)\(([\w>.\-\[\]]+), ([\w>.\-\[\]]+)\)", line):
            if m.group(1) not in ("if", "for", "while", "switch", "sizeof") and m.group(2) != m.group(3):
                yield n, m.start(2), "swapped", m.group(2) + ", " + m.group(3), m.group(3) + ", " + m.group(2)


def draw(count, seed, only):
    files = sorted(glob.glob("sph/*.c") + glob.glob("sph/*.h"))
    files = [f for f in files if not only or f == only]
    every = [(f,) + c for f in files if f not in ("sph/sph.h",) for c in changes(f)]
    random.Random(seed).shuffle(every)
    return every[: int(count * 1.6)]  # those that do not compile are left out


def mutated(path, change):
    n, at, kind, old, new = change
    lines = open(path).read().split("\n")
    line = lines[n - 1]
    assert line[at:at + len(old)] == old, (path, change, line)
    lines[n - 1] = line[:at] + new + line[at + len(old):]
    return "\n".join(lines)


# ---- what the tests run ----

def run(cmd, cwd, seconds, env=None):
    try:
        p = subprocess.run(cmd, cwd=cwd, timeout=seconds, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                           env={**os.environ, **(env or {})})
        return p.returncode, p.stdout.decode(errors="replace")
    except subprocess.TimeoutExpired:
        return 124, "hangs"


def copy_tree(to):
    shutil.rmtree(to, ignore_errors=True)
    os.makedirs(to)
    for d in ("sph", "port", "tests", "tools", "examples", "Makefile", "README.md"):
        (shutil.copytree if os.path.isdir(d) else shutil.copy)(d, os.path.join(to, d))


def programs(tree):
    """the test programs, as the Makefile names them"""
    text = subprocess.run(["make", "-pn", "tests"], cwd=tree, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL).stdout.decode()
    found = re.findall(r"^build/tests/(test_\w+_[123][fd]):", text, flags=re.M)
    if not found:
        sys.exit("mutants.py: the Makefile names no test program")
    return sorted(set(found))


def survey(tree):
    """seconds of each test program, and the lines of sph/ that each runs; kept in WORK/survey.json"""
    at = os.path.join(WORK, "survey.json")
    stamp = subprocess.run("cat sph/*.[ch] tests/*.[ch] Makefile | cksum", shell=True, stdout=subprocess.PIPE).stdout.decode()
    if os.path.exists(at):
        kept = json.load(open(at))
        if kept["stamp"] == stamp:
            return kept
    print("mutants: which lines each test runs (once)", flush=True)
    counted = os.path.join(WORK, "counted")
    copy_tree(counted)
    make = MAKE + ["-j2", "CFLAGS=--coverage", "LDFLAGS=--coverage"]
    if run(make + ["tests"], counted, 7200)[0]:
        sys.exit("mutants.py: the tests do not build with line counters")
    seconds, lines = {}, {}
    for name in programs(counted):
        for f in glob.glob(os.path.join(counted, "build", "**", "*.gcda"), recursive=True):
            os.remove(f)
        began = time.time()
        run(["build/tests/" + name], counted, 900)
        seconds[name] = time.time() - began
        data = glob.glob(os.path.join(counted, "build", "**", "sph", "*.gcda"), recursive=True)
        for f in data:
            said = subprocess.run(["gcov", "--json-format", "--stdout", os.path.relpath(f, counted)], cwd=counted,
                                  stdout=subprocess.PIPE, stderr=subprocess.DEVNULL).stdout.decode()
            for part in said.splitlines():
                for unit in json.loads(part).get("files", []):
                    if unit["file"].startswith("sph/"):
                        for l in unit["lines"]:
                            if l["count"]:
                                lines.setdefault("%s:%d" % (unit["file"], l["line_number"]), set()).add(name)
        print("  %-28s %5.1f s" % (name, seconds[name]), flush=True)
    kept = {"stamp": stamp, "seconds": seconds, "lines": {k: sorted(v) for k, v in lines.items()}}
    json.dump(kept, open(at, "w"))
    shutil.rmtree(counted, ignore_errors=True)
    return kept


class Worker(threading.Thread):
    def __init__(self, k, jobs, kept, done, lock, out, until):
        super().__init__()
        self.tree = os.path.join(WORK, "tree%d" % k)
        self.jobs, self.kept, self.done, self.lock, self.out, self.until = jobs, kept, done, lock, out, until

    def run(self):
        copy_tree(self.tree)
        run(MAKE + ["build/golden_%s" % b for b in GOLDEN] + ["build/libsph%s.a" % b for b in BUILDS], self.tree, 3600)
        self.sound = {b: run(["build/golden_" + b], self.tree, 600)[1] for b in GOLDEN}
        self.objects = self.sums()
        while True:
            with self.lock:
                if not self.jobs or time.time() > self.until or self.done["count"] >= self.done["want"]:
                    return
                m = self.jobs.pop(0)
            verdict, by = self.judge(m)
            with self.lock:
                if verdict != "invalid":
                    self.done["count"] += 1
                with open(self.out, "a", newline="") as f:
                    csv.writer(f).writerow(list(m) + [verdict, by])
                print("  %4d %-9s %-22s %s:%d %s: %s -> %s" % (self.done["count"], verdict, by, m[0], m[1], m[3], m[4][:40], m[5][:40]), flush=True)

    def sums(self):
        out = {}
        for f in glob.glob(os.path.join(self.tree, "build/obj/*/sph/*.o")):
            out[f] = open(f, "rb").read()
        return out

    def judge(self, m):
        path = os.path.join(self.tree, m[0])
        whole = open(path).read()
        try:
            with open(path, "w") as f:
                f.write(mutated(m[0], m[1:]))
            rc, _ = run(MAKE + ["build/golden_2f"], self.tree, 600)
            if rc:
                return "invalid", ""
            for b in GOLDEN:
                if run(MAKE + ["build/golden_" + b], self.tree, 600)[0]:
                    return "killed", "compiler " + b
                if run(["build/golden_" + b], self.tree, 60)[1] != self.sound[b]:
                    return "killed", "golden_" + b
            if run(MAKE + ["build/libsph%s.a" % b for b in BUILDS], self.tree, 900)[0]:
                return "killed", "compiler"
            if self.sums() == self.objects:
                return "equal", ""
            names = self.kept["lines"].get("%s:%d" % (m[0], m[1]), [])
            # a line in a macro's call or a declaration may count elsewhere: the neighbours speak for it
            for d in (-1, 1):
                names = names or self.kept["lines"].get("%s:%d" % (m[0], m[1] + d), [])
            for name in sorted(names, key=lambda x: self.kept["seconds"][x]):
                if run(MAKE + ["build/tests/" + name], self.tree, 900)[0]:
                    return "killed", "compiler " + name
                rc, _ = run(["build/tests/" + name], self.tree, 20 + 10 * self.kept["seconds"][name])
                if rc:
                    return "killed", name
            return "survived", "%d programs ran it" % len(names)
        finally:
            with open(path, "w") as f:
                f.write(whole)


def main():
    p = argparse.ArgumentParser(description="single changes of the kernel against the tests")
    p.add_argument("--count", type=int, default=1000)
    p.add_argument("--seed", type=int, default=1)
    p.add_argument("--jobs", type=int, default=os.cpu_count() or 2)
    p.add_argument("--minutes", type=float, default=1e9)
    p.add_argument("--out", default=os.path.join(WORK, "mutants.csv"))
    p.add_argument("--only", default="")
    p.add_argument("--show", action="store_true", help="list the changes, run nothing")
    a = p.parse_args()
    if a.count < 1 or a.jobs < 1:
        sys.exit("mutants.py: --count %d, --jobs %d: allowed are whole numbers from 1" % (a.count, a.jobs))
    every = draw(a.count, a.seed, a.only)
    if not every:
        sys.exit("mutants.py: nothing to change in '%s'; allowed: a file of sph/" % a.only)
    if a.show:
        csv.writer(sys.stdout).writerows(every)
        return 0
    os.makedirs(WORK, exist_ok=True)
    head = ["file", "line", "column", "kind", "from", "to", "verdict", "by"]
    old = []
    if os.path.exists(a.out):
        old = [r for r in csv.reader(open(a.out)) if len(r) == 8 and r[0] != "file"]
    with open(a.out, "w", newline="") as f:
        csv.writer(f).writerows([head] + old)
    known = {tuple(r[:6]) for r in old}
    todo = [m for m in every if tuple(map(str, m)) not in known]
    done = {"count": sum(r[6] != "invalid" for r in old), "want": a.count}
    kept = survey(WORK)
    until, lock = time.time() + 60 * a.minutes, threading.Lock()
    workers = [Worker(k, todo, kept, done, lock, a.out, until) for k in range(a.jobs)]
    for w in workers:
        w.start()
    for w in workers:
        w.join()
    rows = [r for r in csv.reader(open(a.out)) if len(r) == 8 and r[0] != "file"]
    n = {v: sum(r[6] == v for r in rows) for v in ("killed", "survived", "equal", "invalid")}
    real = n["killed"] + n["survived"]
    rate = 100.0 * n["killed"] / real if real else 0
    with open(os.path.join(os.environ.get("BUILD", "build"), "mutants.csv"), "w", newline="") as f:
        w = csv.writer(f)
        w.writerow(["name", "value", "unit", "target", "ok"])
        w.writerow(["mutants", real + n["equal"], "changes", ">=%d" % a.count, "yes" if real + n["equal"] >= a.count else "no"])
        w.writerow(["killed", "%.1f" % rate, "% of those not equal", ">=%g" % TARGET, "yes" if rate >= TARGET else "no"])
        for v in ("killed", "survived", "equal", "invalid"):
            w.writerow([v + "_count", n[v], "changes", "", ""])
    for r in rows:
        if r[6] == "survived":
            print("  survived %s:%s %s: %s -> %s" % (r[0], r[1], r[3], r[4], r[5]))
    print("mutants: %d changes: %d killed, %d survived, %d equal; %.1f %% of those that are not equal killed" %
          (real + n["equal"], n["killed"], n["survived"], n["equal"], rate))
    return 0 if rate >= TARGET and real + n["equal"] >= a.count else 1


if __name__ == "__main__":
    sys.exit(main())
