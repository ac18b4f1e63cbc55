#!/usr/bin/env python3
# SPDX-License-Identifier: MIT. Copyright the sph authors.
"""Single changes of the kernel, one at a time: does a test see them?

A mutant is the kernel with one change in one place of sph/: an operator, a sign, a constant, an index, a bound, a
statement left out, two arguments swapped. Only what depends on the changed file is compiled, in a copy of the tree;
then those golden cases run whose runs pass the changed line, then those test programs, the quickest first, until one
fails; where none does, the quick ones once more with traps for undefined behaviour, as `make asan` runs them. Which
lines each passes is known from a build with line counters, made once.

  killed    a hash differs, a test fails, or a program dies or hangs; `by` says which
  survived  no test saw it; `by` says how many programs ran the line
  equal     the same object code at -O2 in all six builds: not a change
  invalid   does not compile (another one is drawn in its place)

usage: tests/mutants.py [--count N] [--seed S] [--jobs J] [--out FILE] [--minutes M] [--only sph/FILE]
                        [--patience SECONDS] [--again] [--show]

Goes on where it stopped: a change that is in the table is not tried again unless its line of code is another now;
--again tries survivors once more. `note` is written by hand and kept: why nothing sees it, or what would.
BUILD/mutants.csv has the figures. Exit 1 when fewer than 95 % of those that are not equal are killed.
"""
import argparse, csv, glob, hashlib, json, os, random, re, resource, shutil, subprocess, sys, threading, time

BUILDS = ["2f", "1d", "3f", "2d", "1f", "3d"]
GOLDEN = ["2f", "1d", "3f"]
# commands of the tool, second builds of what costs most, and test_bits, which is the golden runs in many ways
LEFT_OUT = (r"test_(bits|dispersion|gradykipp|fragments|fields|profile|advise|atlas|scenes)_|"
            r"test_(lists_(1f|3d)|restarts_(1d|3d))$")
WORK = os.path.join(os.environ.get("BUILD", "build"), "mutants")
WARN = "-w -Werror=int-conversion -Werror=incompatible-pointer-types -Werror=implicit-function-declaration"
# the general loop compiles in a third of the time and has the same bits
MAKE = ["make", "-s", "--no-print-directory", "CC=" + os.environ.get("GCC", "gcc"), "OPT=-O1", "WARN=" + WARN,
        "CFLAGS=-DSPH_ASSERTS=1 -DSPH_WITH_FAST_PATHS=0"]
UNDEFINED = ["-fsanitize=undefined", "-fsanitize=bounds-strict", "-fsanitize-undefined-trap-on-error"]
TARGET = 95.0
QUICK = 5  # s of processor time, with line counters: programs that take longer are not asked
HEAD = ["file", "line", "column", "kind", "from", "to", "verdict", "by", "code", "note"]

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
        if re.match(r"(const |static |volatile )*(unsigned )?(\w+_t|double|float|vreal|vint|bool|int|char|sph_\w+) "
                    r"[\w, =*]*\w\[[^=]*;$", body):
            continue  # the size of an array: more room is not seen
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


def draw(seed, only):
    """all changes in an order of their own, which other lines of the tree do not alter: (file, line, column, kind,
    from, to), with the text of the line and its number among lines of that text"""
    every = []
    for f in sorted(glob.glob("sph/*.c") + glob.glob("sph/*.h")):
        if f == "sph/sph.h" or only and f != only:
            continue
        lines, seen, nth = open(f).read().split("\n"), {}, {}
        for n, line in enumerate(lines, 1):
            seen[line.strip()] = nth[n] = seen.get(line.strip(), -1) + 1
        for c in changes(f):
            line = lines[c[0] - 1]
            key = identity((f,) + c, line, nth[c[0]])
            every.append((hashlib.sha256(("%s|%s" % (seed, key)).encode()).hexdigest(), key, (f,) + c, line.strip()))
    return sorted(set(every))


def identity(m, line, nth):
    """what makes a change the same one when lines above it come or go"""
    return json.dumps([m[0], line.strip(), nth, m[2] - len(line) + len(line.lstrip()), m[3], m[4], m[5]])


def mutated(path, change):
    n, at, kind, old, new = change
    lines = open(path).read().split("\n")
    line = lines[n - 1]
    assert line[at:at + len(old)] == old, (path, change, line)
    lines[n - 1] = line[:at] + new + line[at + len(old):]
    return "\n".join(lines)


# ---- how programs are built: the Makefile's own commands, so that only what a change alters is made again ----

def limits(cpu):
    def set_them():
        resource.setrlimit(resource.RLIMIT_CPU, (cpu, cpu + 1))
        resource.setrlimit(resource.RLIMIT_AS, (6 << 30, 6 << 30))
        resource.setrlimit(resource.RLIMIT_FSIZE, (1 << 28, 1 << 28))
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    return set_them


def run(cmd, cwd, cpu):
    """the exit code, within so many seconds of processor time"""
    env = dict(os.environ, TMPDIR=os.path.abspath(WORK))
    try:
        return subprocess.run(cmd, cwd=cwd, timeout=20 + 20 * cpu, stdout=subprocess.DEVNULL, env=env,
                              stderr=subprocess.DEVNULL, preexec_fn=limits(max(1, int(cpu + 0.999)))).returncode
    except subprocess.TimeoutExpired:
        return 124


def copy_tree(to):
    os.makedirs(to, exist_ok=True)
    subprocess.check_call(["cp", "-rp", "sph", "port", "tests", "tools", "examples", "Makefile", to])


class Tree:
    """a copy of the tree, built; commands[object], inputs[program]"""

    def __init__(self, k):
        self.at = os.path.join(WORK, "tree%d" % k)
        copy_tree(self.at)
        golden = ["build/mutants_golden_" + b for b in GOLDEN]
        said = subprocess.run(MAKE + ["-n", "-B", "tests"] + golden, cwd=self.at, stdout=subprocess.PIPE)
        said = said.stdout.decode()
        self.commands, self.inputs, archives, links = {}, {}, {}, {}
        for words in (l.split() for l in said.splitlines()):
            if "-c" in words and "-o" in words:
                self.commands[words[words.index("-o") + 1]] = words
            elif "rcs" in words:
                at = words.index("rcs")
                archives[words[at + 1]] = words[at + 2:]
            elif "-o" in words:
                links[words[words.index("-o") + 1]] = words
        for name, words in links.items():
            if re.search(LEFT_OUT, name):
                continue
            if name.endswith("_2d") and name[:-1] + "f" in links:
                continue  # lines that only double passes are few
            built = [w for w in words if w.endswith((".o", ".a")) and "/" in w]
            self.inputs[name] = [o for w in built for o in archives.get(w, [w])]
        self.links = {n: self.link_words(links[n]) for n in self.inputs}
        print("mutants: the programs are built", flush=True)
        if subprocess.run(MAKE + ["-j2"] + sorted(self.inputs), cwd=self.at).returncode:
            sys.exit("mutants.py: the tests do not build")
        self.users = {}
        for o in self.commands:
            d = os.path.join(self.at, o[:-2] + ".d")
            if os.path.exists(d):
                for f in re.findall(r"(?:^|\s)(?:[\w/.]*/)?(sph/[\w.]+)", open(d).read().replace("tests/../", "")):
                    self.users.setdefault(f, set()).add(o)

    def link_words(self, words):
        """flags and libraries of a link, without its objects"""
        keep = [w for w in words if not (w.endswith((".o", ".a")) and "/" in w)]
        at = keep.index("-o")
        return keep[:at], keep[at + 2:]

    def link(self, name, objects, to):
        before, after = self.links[name]
        return run(before + objects + ["-o", to] + after, self.at, 60)


# ---- what the tests run ----

def survey(tree):
    """processor seconds of each program and of each golden case, and the lines of sph/ that each passes"""
    at = os.path.join(WORK, "survey.json")
    kept = json.load(open(at)) if os.path.exists(at) else {"seconds": {}, "lines": {}, "stamp": {}}
    counted = {o: "counted/" + o for o in tree.commands if "/sph/" in o}
    for name in sorted(tree.inputs, key=lambda n: (BUILDS.index(n[-2:]), n)):
        sources = sorted({f for o in tree.inputs[name] for f in tree.commands[o] if f.endswith(".c")})
        stamp = subprocess.run("cat sph/*.h tests/*.h %s | cksum" % " ".join(sources), shell=True, cwd=tree.at,
                               stdout=subprocess.PIPE).stdout.decode()
        if kept["stamp"].get(name) == stamp:
            continue
        objects = []
        for o in tree.inputs[name]:
            if o in counted:
                to, words = os.path.join(tree.at, counted[o]), list(tree.commands[o])
                newest = max(os.path.getmtime(os.path.join(tree.at, f)) for f in glob.glob("sph/*.h") + words
                             if f.startswith("sph/"))
                if not os.path.exists(to) or os.path.getmtime(to) < newest:
                    os.makedirs(os.path.dirname(to), exist_ok=True)
                    words[words.index("-o") + 1] = counted[o]
                    if run(words + ["--coverage"], tree.at, 300):
                        sys.exit("mutants.py: %s does not build with line counters" % o)
            objects.append(counted.get(o, o))
        if tree.link(name, objects + ["--coverage"], "counted/program"):
            sys.exit("mutants.py: %s does not link with line counters" % name)
        parts = [(name, ["counted/program"])]
        if "golden" in name:
            n = int(subprocess.check_output(["counted/program"], cwd=tree.at))
            parts = [("%s:%d" % (name, k), ["counted/program", "tests/golden.csv", str(k)]) for k in range(n)]
        for key, cmd in parts:
            lines_of(tree, key, cmd, objects, kept)
        kept["stamp"][name] = stamp
        json.dump(kept, open(at + ".tmp", "w"))
        os.replace(at + ".tmp", at)
    return kept


def lines_of(tree, key, cmd, objects, kept):
    for o in objects:
        data = os.path.join(tree.at, o[:-2] + ".gcda")
        if os.path.exists(data):
            os.remove(data)
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    rc = run(cmd, tree.at, QUICK)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    kept["seconds"][key] = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    files = [o[:-2] + ".gcda" for o in objects if os.path.exists(os.path.join(tree.at, o[:-2] + ".gcda"))]
    said = subprocess.run(["gcov", "--json-format", "--stdout"] + files, cwd=tree.at, stdout=subprocess.PIPE,
                          stderr=subprocess.DEVNULL).stdout.decode()
    ran, kept["code"] = {}, kept.get("code", {})
    for part in said.splitlines():
        for unit in json.loads(part).get("files", []):
            name = unit["file"][unit["file"].rfind("sph/"):]
            if not name.startswith("sph/"):
                continue
            every = kept["code"].setdefault(name, [])
            for l in unit["lines"]:
                if l["line_number"] not in every:
                    every.append(l["line_number"])
                if l["count"]:
                    ran.setdefault(name, set()).add(l["line_number"])
    kept["lines"][key] = {f: sorted(v) for f, v in ran.items()}
    if rc:
        kept["seconds"][key] = -1  # fails as it is: says nothing
    print("  %-32s %6.2f s%s" % (key, kept["seconds"][key], "  fails or takes long as it is: left out" if rc else ""),
          flush=True)


class Known:
    """the survey, asked by line"""

    def __init__(self, kept, programs):
        self.seconds = {k: v for k, v in kept["seconds"].items() if k.split(":")[0] in programs}
        self.code = {f: set(v) for f, v in kept["code"].items()}
        self.ran = {k: {f: set(v) for f, v in of.items()} for k, of in kept["lines"].items()
                    if k in self.seconds}

    def who(self, path, n):
        """those that pass line n: of a statement over several lines, the nearest line above that is counted"""
        at = n
        while at > n - 12 and at not in self.code.get(path, ()):
            at -= 1
        lines = [l for l in ((at,) if at == n else (at, n + 1)) if l in self.code.get(path, ())]
        sound = [k for k in self.ran if self.seconds[k] >= 0]
        if not lines:  # a table: whoever runs anything of the file, or a header of macros: everyone
            return [k for k in sound if path in self.ran[k] or path not in self.code]
        return [k for k in sound if any(l in self.ran[k].get(path, ()) for l in lines)]


# ---- one change ----

class Worker(threading.Thread):
    def __init__(self, k, tree, jobs, known, done, lock, out, until):
        super().__init__()
        self.k, self.tree, self.jobs, self.known = k, tree, jobs, known
        self.done, self.lock, self.out, self.until = done, lock, out, until

    def run(self):
        if self.tree is None:
            self.tree = Tree(self.k)
        while True:
            with self.lock:
                if not self.jobs or time.time() > self.until or self.done["count"] >= self.done["want"]:
                    return
                row = self.jobs.pop(0)
            m = row["m"]
            began = time.time()
            verdict, by = self.judge(m)
            with self.lock:
                self.done["count"] += verdict != "invalid"
                self.done["rows"][row["key"]] = list(m) + [verdict, by, row["code"], row["note"]]
                write_rows(self.out, self.done["rows"])
                print("  %4d %-9s %-28s %4.1f s %s:%d %s: %s -> %s" %
                      (self.done["count"], verdict, by, time.time() - began, m[0], m[1], m[3], m[4][:40], m[5][:40]),
                      flush=True)

    def compiled(self, o):
        """the changed object of the program's object o (the sound one where nothing came of it), or None"""
        if o not in self.users:
            return o
        if o not in self.fresh:
            words, to = list(self.tree.commands[o]), "fresh/" + o
            os.makedirs(os.path.dirname(os.path.join(self.tree.at, to)), exist_ok=True)
            words[words.index("-o") + 1] = to
            if run(words + self.extra, self.tree.at, 120):
                self.fresh[o] = None
            else:
                same = open(os.path.join(self.tree.at, o), "rb").read() == \
                    open(os.path.join(self.tree.at, to), "rb").read()
                self.fresh[o] = o if same and not self.extra else to
        return self.fresh[o]

    def tried(self, name, args, cpu, whole=False):
        """does the program fail? None where it is the same as without the change"""
        objects = [self.compiled(o) for o in self.tree.inputs[name]]
        if None in objects:
            return True
        if objects == self.tree.inputs[name]:
            return None
        program = "fresh/program"
        if self.linked != name:
            if self.tree.link(name, objects, program):
                return True
            self.linked = name
        return run([program] + args, self.tree.at, cpu) != 0

    def judge(self, m):
        path = os.path.join(self.tree.at, m[0])
        whole = open(path).read()
        self.users, self.fresh, self.linked, self.extra = self.tree.users.get(m[0], set()), {}, None, []
        try:
            with open(path, "w") as f:
                f.write(mutated(m[0], m[1:]))
            first = "build/mutants_golden_2f"
            if any(self.compiled(o) is None for o in self.tree.inputs[first]):
                return "invalid", ""
            verdict, by = self.by_tests(m)
            return self.undefined(m, path, whole) or (verdict, by) if verdict == "survived" else (verdict, by)
        finally:
            with open(path, "w") as f:
                f.write(whole)

    def by_tests(self, m):
        seconds, who = self.known.seconds, self.known.who(m[0], m[1])
        for b in GOLDEN:
            name = "build/mutants_golden_" + b
            keys = sorted((k for k in who if k.startswith(name + ":")), key=lambda k: seconds[k])
            cases = [k.split(":")[1] for k in keys]
            if cases and self.tried(name, ["tests/golden.csv"] + cases, 2 + 4 * sum(seconds[k] for k in keys)):
                return "killed", "golden_" + b
        names = self.in_order(who)
        for name in names:
            if self.tried(name, [], 2 + 4 * seconds[name]):
                return "killed", os.path.basename(name)
        # lines that the compiler moved elsewhere, and the loops that are compiled apart
        if self.fast_differs():
            return "killed", "golden_2f, fast paths"
        if self.equal(m):
            return "equal", ""
        return "survived", "%d programs ran it" % len(names) if names else "no program runs it"

    def undefined(self, m, path, whole):
        """does undefined behaviour trap (make asan has the same checks), where it does not without the change?"""
        seconds, who, self.extra = self.known.seconds, self.known.who(m[0], m[1]), UNDEFINED
        self.fresh, self.linked = {}, None
        tries = [("build/mutants_golden_" + b, ["tests/golden.csv"] +
                  [k.split(":")[1] for k in who if k.startswith("build/mutants_golden_%s:" % b)]) for b in GOLDEN[:2]]
        tries = [t for t in tries if len(t[1]) > 1] + [(k, []) for k in self.in_order(who) if seconds[k] < 0.5]
        for name, args in tries:
            self.linked = None
            if not self.tried(name, args, 30):
                continue
            changed = open(path).read()
            with open(path, "w") as f:
                f.write(whole)
            self.fresh, self.linked = {}, None
            sound = not self.tried(name, args, 30)
            with open(path, "w") as f:
                f.write(changed)
            self.fresh, self.linked = {}, None
            if sound:
                return "killed", "undefined behaviour in " + os.path.basename(name)
        return None

    def in_order(self, who):
        """programs, the quickest first, of each test its quickest build first; as many as patience allows"""
        seconds, seen, order, spent = self.known.seconds, set(), [], 0
        for k in sorted((k for k in who if ":" not in k), key=lambda k: seconds[k]):
            order.append((k[:-3] in seen and seconds[k] > 0.1, seconds[k], k))
            seen.add(k[:-3])
        names = []
        for _, s, k in sorted(order):
            spent += s
            if spent > self.known.patience:
                break
            names.append(k)
        return names

    def fast_differs(self):
        """golden runs of 2f with the loops that the Makefile's own build has"""
        at, name = self.tree.at, "build/mutants_golden_2f"
        changed = [o for o in self.tree.inputs[name] if o in self.users and re.search(r"/(forces|tiles)\.o$", o)]
        if not changed:
            return False
        objects = [self.compiled(o) for o in self.tree.inputs[name]]
        for k, o in enumerate(self.tree.inputs[name]):
            if re.search(r"/(forces|tiles)\.o$", o):
                words = [w for w in self.tree.commands[o] if w != "-DSPH_WITH_FAST_PATHS=0"]
                objects[k] = words[words.index("-o") + 1] = "fresh/fast_" + os.path.basename(o)
                if run(words, at, 300):
                    return True
        n = sum(k.startswith(name + ":") for k in self.known.seconds)
        return self.tree.link(name, objects, "fresh/fast") != 0 or \
            run(["fresh/fast", "tests/golden.csv"] + [str(k) for k in range(n)], at, 60) != 0

    def equal(self, m):
        """the same object code at -O2, asserts off, in all six builds"""
        sound = os.path.abspath(os.path.join(self.tree.at, "sound"))
        for b in BUILDS:
            for o in sorted(o for o in self.users if re.match(r"build/obj/2f/sph/", o)):
                words = [w for w in self.tree.commands[o] if not w.startswith(("-DSPH_ASSERTS", "-DSPH_WITH_FAST"))]
                words = [{"-O1": "-O2", "-DSPH_DIM=2": "-DSPH_DIM=" + b[0],
                          "-DSPH_DOUBLE=0": "-DSPH_DOUBLE=%d" % (b[1] == "d")}.get(w, w) for w in words]
                at, bytes_of = words.index("-o") + 1, {}
                for where, cwd in (("sound", "."), ("changed", self.tree.at)):
                    # the tree that mutants.py was called in has the sound text
                    words[at] = os.path.join(sound, "%s_%s.o" % (where, b))
                    os.makedirs(sound, exist_ok=True)
                    if run(words, cwd, 300):
                        return False
                    bytes_of[where] = open(words[at], "rb").read()
                if bytes_of["sound"] != bytes_of["changed"]:
                    return False
        return True


def write_rows(out, rows):
    order = lambda r: (r[0], int(r[1]), int(r[2]), r[3:6])
    with open(out + ".tmp", "w", newline="") as f:
        csv.writer(f, lineterminator="\n").writerows([HEAD] + sorted(rows.values(), key=order))
    os.replace(out + ".tmp", out)


def kept_rows(out, every):
    """rows of the table by identity, with today's lines; those whose code is another now are left out"""
    rows, todays = {}, {}
    for _, key, m, code in every:
        todays.setdefault((m[0], code) + tuple(map(str, m[2:])), []).append((key, m))
    if os.path.exists(out):
        for r in csv.reader(open(out)):
            if len(r) != len(HEAD) or r[0] == "file":
                continue
            same = todays.get((r[0], r[8], r[2], r[3], r[4], r[5]), [])
            free = [s for s in same if s[0] not in rows]
            if free:
                key, m = min(free, key=lambda s: abs(s[1][1] - int(r[1])))
                rows[key] = list(m) + r[6:]
    return rows


def figures(rows, count):
    n = {v: sum(r[6] == v for r in rows) for v in ("killed", "survived", "equal", "invalid")}
    real = n["killed"] + n["survived"]
    rate = 100.0 * n["killed"] / real if real else 0
    enough, killed = real >= count, rate >= TARGET
    with open(os.path.join(os.environ.get("BUILD", "build"), "mutants.csv"), "w", newline="") as f:
        w = csv.writer(f)
        w.writerow(["name", "value", "unit", "target", "ok"])
        w.writerow(["mutants", real, "changes that are not equal", ">=%d" % count, "yes" if enough else "no"])
        w.writerow(["killed", "%.1f" % rate, "% of those not equal", ">=%g" % TARGET, "yes" if killed else "no"])
        for v in n:
            w.writerow([v + "_count", n[v], "changes", "", ""])
    for r in rows:
        if r[6] == "survived":
            print("  survived %s:%s:%s %s: %s -> %s (%s)" % tuple(r[:6] + [r[7]]))
    print("mutants: %d killed, %d survived, %d equal; %.1f %% of those that are not equal killed" %
          (n["killed"], n["survived"], n["equal"], rate))
    return enough and killed


def main():
    p = argparse.ArgumentParser(description="single changes of the kernel against the tests")
    p.add_argument("--count", type=int, default=1000, help="changes that are not equal")
    p.add_argument("--seed", type=int, default=1)
    p.add_argument("--jobs", type=int, default=1)
    p.add_argument("--minutes", type=float, default=1e9)
    p.add_argument("--out", default=os.path.join(WORK, "mutants.csv"))
    p.add_argument("--only", default="")
    p.add_argument("--patience", type=float, default=10, help="processor seconds of tests for one change")
    p.add_argument("--again", action="store_true", help="try survivors of the table once more")
    p.add_argument("--show", action="store_true", help="list the changes, run nothing")
    a = p.parse_args()
    if a.count < 1 or a.jobs < 1:
        sys.exit("mutants.py: --count %d, --jobs %d: allowed are whole numbers from 1" % (a.count, a.jobs))
    every = draw(a.seed, a.only)
    if not every:
        sys.exit("mutants.py: nothing to change in '%s'; allowed: a file of sph/" % a.only)
    if a.show:
        csv.writer(sys.stdout).writerows(e[2] for e in every[:a.count])
        return 0
    os.makedirs(WORK, exist_ok=True)
    rows = kept_rows(a.out, draw(a.seed, ""))
    todo = [{"key": key, "m": m, "code": code, "note": rows[key][9] if key in rows else ""} for _, key, m, code in every
            if key not in rows or a.again and rows[key][6] == "survived"]
    if a.again:
        todo = [t for t in todo if t["key"] in rows]
        for t in todo:
            del rows[t["key"]]
    done = {"count": sum(r[6] in ("killed", "survived") for r in rows.values()), "want": a.count, "rows": rows}
    tree = Tree(0)
    known = Known(survey(tree), tree.inputs)
    known.patience = a.patience
    until, lock = time.time() + 60 * a.minutes, threading.Lock()
    workers = [Worker(k, None if k else tree, todo, known, done, lock, a.out, until) for k in range(a.jobs)]
    for w in workers:
        w.start()
    for w in workers:
        w.join()
    write_rows(a.out, rows)
    return 0 if figures(list(rows.values()), a.count) else 1


if __name__ == "__main__":
    sys.exit(main())
