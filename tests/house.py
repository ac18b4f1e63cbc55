#!/usr/bin/env python3
# SPDX-License-Identifier: MIT. Copyright the sph authors.
"""house.py: the rules of the house, on the sources and on the objects of the kernel.

  floors    a file of sph/ calls, and takes data from, its own floor and those below (tests/floors.txt); no circle of
  files;
            physics never calls physics, nor an entry an entry
  lines     no line over 120 columns in C, headers, shell and python
  functions in sph/: none over 60 lines, the median at most 8, 90 % at most 30; no `#if` inside one
  words     files marked `nameless` in tests/floors.txt hold no word of a module
  objects   every file of sph/ says SPH_OBJECT(its name) and stands in SPH_OBJECTS (sph/arithmetic.h)
  ground    no heap, no stdio, no libm but sqrt in sph/

usage: house.py [--build build] [--nm nm] [--floors tests/floors.txt]    writes BUILD/house.csv, prints what is wrong
"""
import argparse
import os
import re
import statistics
import subprocess
import sys

FLOORS = ["base", "data", "motion", "physics", "composition", "running", "groundwork", "entries"]
APART = ("physics", "entries")  # files of these floors do not call each other
COLUMNS, LONGEST, MEDIAN, MOST = 120, 60, 8, 30
FOLDERS = ("sph/", "port/", "examples/", "tools/", "tests/", ".ci/")
GENERATED = ("tests/refdata/",)
MODULE_WORDS = ["stress", "damage", "adami", "shepard", "xsph", "viscos", "morris", "diffus", "molteni", "yield",
                "flaw",
                "strain", "lennard", "solid", "elastic", "plastic", "brittle", "artificial", "tait", "eos", "wendland",
                "quintic", "gauge", "summation", "leap", "runge", "predictor", "continuity", "dissipat"]
NAMES = re.compile(r"(?<![a-z])(?:" + "|".join(MODULE_WORDS) + r")[a-z]*")
LINKED = {"memcpy", "memset", "memmove", "sqrt", "sqrtf",
          "_GLOBAL_OFFSET_TABLE_"}  # the linker's own: of objects that need not be there (sph/arithmetic.h)
HEADERS = {"float.h", "stdbool.h", "stddef.h", "stdint.h", "string.h"}
CALLS = r"\b(malloc|calloc|realloc|free|aligned_alloc|alloca|f?printf|sn?printf|puts|putchar|fopen|fwrite|fread|" \
        r"exit|abort|powf?|expf?|logf?|sinf?|cosf?|tanf?|cbrtf?|floorf?|ceilf?|fabsf?|fmaf?|hypotf?)\s*\("
ROWS, WRONG = [], []


def row(name, value, unit, target=None):
    ok = "" if target is None else "yes" if value <= target else "no"
    ROWS.append(f"{name},{value:g},{unit},{'' if target is None else f'<={target}'},{ok}")


def wrong(text):
    WRONG.append(text)


def read(path):
    with open(path, encoding="utf-8") as f:
        return f.read()


def tracked():
    """Files of the tree: what git knows of and is there, or everything in the folders where there is no git."""
    done = subprocess.run(["git", "ls-files", "-co", "--exclude-standard"], capture_output=True, text=True)
    if os.path.exists(".git") and done.returncode == 0:
        names = done.stdout.split("\n")
    else:
        names = [os.path.normpath(os.path.join(d, f)) for top in FOLDERS for d, _, files in os.walk(top) for f in files]
    return sorted(n for n in set(names) if n.startswith(FOLDERS) and os.path.isfile(n))


# ---- floors ----

def read_floors(path):
    """{file: floor}, and the files marked nameless."""
    floors, nameless = {}, []
    for number, line in enumerate(read(path).split("\n"), 1):
        words = line.split("#")[0].split()
        if not words:
            continue
        if len(words) < 2 or words[1] not in FLOORS or words[2:] not in ([], ["nameless"]):
            wrong(f"{path}:{number}: '{line}'; a line is: file floor [nameless], the floor one of {' '.join(FLOORS)}")
            continue
        floors[words[0]] = words[1]
        if words[2:]:
            nameless.append(words[0])
    return floors, nameless


def symbols_of(nm, path):
    """({symbols defined}, {symbols asked for}) of an object, functions and data alike."""
    done = subprocess.run([nm, "-g", path], capture_output=True, text=True)
    if done.returncode:
        sys.exit(f"house: {nm} {path}: {done.stderr.strip()}")
    pairs = [line.split()[-2:] for line in done.stdout.split("\n") if len(line.split()) >= 2]
    return {s for k, s in pairs if k != "U"}, {s for k, s in pairs if k == "U"}


def circles(calls):
    """Strongly connected parts of a graph {node: {node: ...}} with more than one node."""
    reach = {}
    for start in calls:
        seen, todo = set(), [start]
        while todo:
            for to in calls[todo.pop()]:
                if to not in seen:
                    seen.add(to)
                    todo.append(to)
        reach[start] = seen
    parts = {frozenset([a] + [b for b in reach[a] if a in reach[b]]) for a in calls if a in reach[a]}
    return [sorted(p) for p in parts if len(p) > 1]


def check_floors(objects, nm, table):
    floors, nameless = read_floors(table)
    sources = sorted(f for f in os.listdir("sph") if f.endswith(".c"))
    missing = [f for f in sources if f not in floors]
    gone = [f for f in floors if f not in sources]
    if missing:
        wrong(f"{table} has no floor for: {' '.join(missing)}")
    if gone:
        wrong(f"{table} names files that are not in sph/: {' '.join(gone)}")
    defined, asked, home = {}, {}, {}
    for f in sources:
        defined[f], asked[f] = symbols_of(nm, os.path.join(objects, f[:-2] + ".o"))
        home.update({s: f for s in defined[f]})
    calls = {f: {} for f in sources}
    foreign = set()
    for f in sources:
        for s in sorted(asked[f]):
            if s in home:
                calls[f].setdefault(home[s], []).append(s)
            elif s not in LINKED:
                foreign.add(f"{f} asks the linker for {s}")
    up = 0
    for f in sources:
        for to, names in sorted(calls[f].items()):
            a, b = floors.get(f), floors.get(to)
            higher = a and b and (FLOORS.index(b) > FLOORS.index(a) or (a == b and a in APART))
            up += bool(higher)
            if higher:
                wrong(f"{f} ({a}) calls {to} ({b}): {' '.join(names)}")
    parts = circles(calls)
    for p in parts:
        links = [f"{a} -> {b}: {' '.join(calls[a][b])}" for a in p for b in p if b in calls[a]]
        wrong(f"a circle of files: {' '.join(p)}\n    " + "\n    ".join(links))
    row("files_without_floor", len(missing) + len(gone), "files", 0)
    row("calls_upwards", up, "pairs of files", 0)
    row("files_in_circles", sum(map(len, parts)), "files", 0)
    row("calls_between_files", sum(map(len, calls.values())), "pairs of files")
    return [f for f in nameless if f in sources], foreign


# ---- text ----

def check_lines(files):
    kinds = [f for f in files if f.endswith((".c", ".h", ".sh", ".py")) or f.startswith(".ci/")]
    long_lines = 0
    for f in kinds:
        if not f.startswith(GENERATED):
            at = [n for n, line in enumerate(read(f).split("\n"), 1) if len(line) > COLUMNS]
            long_lines += len(at)
            if at:
                wrong(f"{f}: over {COLUMNS} columns: line {', '.join(map(str, at))}")
    row("files_read", len(kinds), "files")
    row("lines_over_120", long_lines, "lines", 0)
    return len(kinds)


def functions(path):
    """(name, first line, last line, lines) of every function; those that macros make count too."""
    lines = [line.rstrip("\\").rstrip() for line in read(path).split("\n")]
    start = None
    for n, line in enumerate(lines):
        head = re.match(r"(?!typedef|struct|enum|union|#)[A-Za-z_].*?(\w+)\(.*\)\s*\{.*\}$", line)
        if head:
            yield head.group(1), n, n, lines[n:n + 1]
        elif line == "{":
            start = n
            while start > 0 and lines[start - 1] and not re.search(r"(^[}#]|[;}]$|\*/$)", lines[start - 1]):
                start -= 1
        elif line == "}" and start is not None:
            name = re.search(r"(\w+)\(", " ".join(lines[start:n]))
            yield name.group(1) if name else "?", start, n, lines[start:n + 1]
            start = None


def check_functions(files):
    lengths, ifs = [], 0
    for f in files:
        for name, first, last, body in functions(f):
            lengths.append((last - first + 1, f, name))
            if last - first + 1 > LONGEST:
                wrong(f"{f}:{first + 1}: {name}() has {last - first + 1} lines, over {LONGEST}")
            at = [first + n for n, line in enumerate(body, 1) if re.match(r"\s*#\s*(el)?if", line)]
            if f.endswith(".c") and at:
                ifs += len(at)
                wrong(f"{f}: #if inside {name}(): line {', '.join(map(str, at))}")
    if not lengths:
        return 0
    only = sorted(n for n, _, _ in lengths)
    # median and 90 % are of the body, without signature and braces: 7 and 27 at commit 8ecd997
    body = [max(n - 3, 1) for n in only]
    row("functions", len(only), "functions")
    row("longest_function", only[-1], "lines", LONGEST)
    row("median_function", statistics.median(body), "lines", MEDIAN)
    row("90_percent_of_functions", body[(9 * len(body) - 1) // 10], "lines", MOST)
    row("ifs_inside_functions", ifs, "lines", 0)
    return len(lengths)


def check_words(nameless):
    found = 0
    for f in nameless:
        for n, line in enumerate(read(os.path.join("sph", f)).split("\n"), 1):
            words = re.findall(NAMES, line.lower())
            found += len(words)
            if words:
                wrong(f"sph/{f}:{n}: names a module: {' '.join(words)}")
    row("words_of_modules", found, "words", 0)


def without_comments(text):
    return re.sub(r"/\*.*?\*/|//[^\n]*", lambda m: "\n" * m.group(0).count("\n"), text, flags=re.S)


def check_ground(files, foreign):
    bad = len(foreign)
    for text in sorted(foreign):
        wrong(text)
    for f in files:
        for n, line in enumerate(without_comments(read(f)).split("\n"), 1):
            header = re.match(r'\s*#\s*include\s*<(.*)>', line)
            call = re.search(CALLS, line)
            if (header and header.group(1) not in HEADERS and not header.group(1).endswith("intrin.h")) or call:
                bad += 1
                wrong(f"{f}:{n}: no heap, stdio or libm here: {line.strip()}")
    row("heap_stdio_libm", bad, "places", 0)


def check_objects(files):
    """Every file of sph/ leaves its record of arithmetic and knobs, and is asked for it."""
    listed = set(re.findall(r"X\((\w+)\)", read("sph/arithmetic.h").split("#define SPH_OBJECTS(X)")[1].split("*/")[0]))
    names = {os.path.basename(f)[:-2] for f in files if f.endswith(".c")}
    said = {n for n in names if f"\nSPH_OBJECT({n})\n" in read(f"sph/{n}.c")}
    for n in sorted(names - said):
        wrong(f"sph/{n}.c: does not say SPH_OBJECT({n})")
    for n in sorted(names ^ listed):
        wrong(f"sph/{n}.c: SPH_OBJECTS in sph/arithmetic.h has it {'only' if n in listed else 'not'}")
    row("objects_without_probe", len(names - said) + len(names ^ listed), "files", 0)


def main():
    p = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    p.add_argument("--build", default="build", help="where house.csv goes and the objects are, in obj/2f/sph")
    p.add_argument("--nm", default="nm")
    p.add_argument("--floors", default="tests/floors.txt")
    args = p.parse_args()
    files = tracked()
    kernel = [f for f in files if re.match(r"sph/[^/]*\.[ch]$", f)]
    if not kernel:
        sys.exit("house: found no source in sph/; run it where the Makefile is")
    nameless, foreign = check_floors(os.path.join(args.build, "obj", "2f", "sph"), args.nm, args.floors)
    if not check_lines(files) or not check_functions(kernel):
        sys.exit("house: found no line or no function to look at")
    if not nameless:
        wrong(f"{args.floors} marks no file of sph/ as nameless, so there is none to look for words in")
    check_words(nameless)
    check_ground(kernel, foreign)
    check_objects(kernel)
    with open(os.path.join(args.build, "house.csv"), "w", encoding="utf-8") as f:
        f.write("name,value,unit,target,ok\n" + "\n".join(ROWS) + "\n")
    for text in WRONG:
        print("  " + text)
    done = subprocess.run(["sh", "tests/table.sh", os.path.join(args.build, "house.csv")])
    print(f"house: {len(WRONG)} things are wrong" if WRONG else "house: in order")
    return 1 if WRONG or done.returncode else 0


if __name__ == "__main__":
    sys.exit(main())
