#!/usr/bin/env python3
# SPDX-License-Identifier: MIT. Copyright the sph authors.
"""Worst stack of every public entry point, from the call graphs that gcc -fcallgraph-info=su writes (*.ci).

    stack.py LABEL SOURCE_DIR CI_FILE...    prints rows stack_LABEL_FUNCTION,bytes,bytes,, and on stderr the worst path

A call through a pointer is found in the source line that the graph names and resolved by CALLS below; one that is not
there, a frame without a bound and a recursion are errors. What the host lends (HOST) counts as 0 bytes: its own stack
comes on top. What comes from the compiler's library counts as LIBRARY bytes a call."""
import os
import re
import sys

# bytes: memcpy, sqrt, __aeabi_dmul and the like; the deepest, __aeabi_uldivmod, takes 52 with what it calls
LIBRARY = 64
HOST = "host"

# what a call through a pointer may reach: pattern of the call in its source line, then where the pointers come from:
# ("pass", field) or ("sweep", field) of the tables in the source, ("load", 0), ("fast", 0) of the lists of column
# sets and fast paths, names of functions, or HOST
CALLS = [
    (r"->run\(", [("pass", 2)]),
    (r"->probe\(", [HOST]),  # asks for some bytes; at init only
    (r"->chunks\(", [("pass", 1)]),
    (r"->end\(", [("pass", 3)]),
    (r"->wanted\(", [("pass", 4)]),
    (r"->home\(", [("sweep", 0)]),
    (r"->tile\(", [("sweep", 5)]),
    (r"->finish\(", [("sweep", 6)]),
    (r"\.load\(", [("load", 0)]),
    (r"\.run\(sim, t, homes\)", [("fast", 0)]),
    (r"\.parallel\(", ["run_job"]),  # the host's own frames are its own
    (r"\.motion\(", ["motion_table", "motion_programme", "motion_spline"]),
    (r"->(sink|source)\(|\.stage_log\(|->stage_log\(|body_force\(|[.>]fault\(|\bfn\(", [HOST]),
    (r"\binside\(|->inside\(", ["in_shape", "in_polygon"]),
]


def fail(text):
    sys.exit("stack.py: " + text)


def fields(text):
    """the members of an initialiser, split at commas outside brackets"""
    out, depth, part = [], 0, ""
    for c in text:
        depth += (c in "({[") - (c in ")}]")
        if c == "," and depth == 0:
            out.append(part)
            part = ""
        else:
            part += c
    return out + [part]


def tables(source):
    """functions that stand in the passes and sweeps of the source, by (table, field)"""
    found = {}
    for text in source.values():
        text = re.sub(r'"[^"]*"', '""', text)
        for kind, body in re.findall(r"\bsph_(pass|sweep)\s+\w+\s*=\s*\{(.*?)\};", text, re.S):
            for i, member in enumerate(fields(body)):
                found.setdefault((kind, i), set()).update(re.findall(r"\b[a-z_]\w*", member))
        for name, lines in re.findall(r"#define (SPH_FAST_\w+|SPH_COLUMN_SETS)\(X\)((?:.*\\\n)*.*)", text):
            kind, of = ("load", "sph_load_") if name == "SPH_COLUMN_SETS" else ("fast", "force_")
            found.setdefault((kind, 0), set()).update(of + n for n in re.findall(r"\bX\((\w+),", lines))
    return found


class Graph:
    def __init__(self, files, source):
        self.frame, self.calls, self.indirect, self.source, self.memo = {}, {}, [], source, {}
        for name in files:
            with open(name, encoding="utf-8") as f:
                self.read(f.read())
        self.by_name = {}
        for node in self.frame:
            self.by_name.setdefault(short(node), []).append(node)
            # in the source a function that several files share is sph_NAME, in objects sph2f_NAME_
            if short(node).endswith("_"):
                self.by_name.setdefault("sph_" + short(node)[:-1], []).append(node)
        self.resolve()

    def read(self, text):
        for title, label in re.findall(r'node: \{ title: "([^"]+)" label: "([^"]*)"', text):
            m = re.search(r"(\d+) bytes \((\w[\w,]*)\)", label)
            if m:
                if m.group(2) not in ("static", "dynamic,bounded"):
                    fail(f"the frame of {title} is not bounded ({m.group(2)})")
                self.frame[title] = int(m.group(1))
        for a, b, rest in re.findall(r'edge: \{ sourcename: "([^"]+)" targetname: "([^"]+)"([^}]*)\}', text):
            if b == "__indirect_call":
                self.indirect.append((a, re.search(r'label: "([^"]+)"', rest).group(1)))
            else:
                self.calls.setdefault(a, set()).add(b)

    def resolve(self):
        table, all_text = tables(self.source), "\n".join(self.source.values())
        for caller, place in self.indirect:
            path, line = place.split(":")[:2]
            text = self.source[path.split("/")[-1]].split("\n")[int(line) - 1]
            targets = [t for pattern, t in CALLS if re.search(pattern, text)]
            if not targets:
                fail(f"{place}: a call through a pointer that CALLS does not know: {text.strip()}")
            for t in targets[0]:
                names = table.get(t, set()) if isinstance(t, tuple) else {t}
                names = names | {n[4:] for n in names if n.startswith("sph_")}  # sph_x is the macro of sphNP_x_
                reached = [n for name in names for n in self.by_name.get(name, [])]
                if isinstance(t, tuple) and not names:  # names that reach nothing were compiled out
                    fail(f"{place}: no function stands in field {t[1]} of a {t[0]}")
                if isinstance(t, str) and t != HOST and not reached and not re.search(rf"\b{t}\b", all_text):
                    fail(f"{place}: the source has no {t}, which CALLS names")
                self.calls.setdefault(caller, set()).update(reached)

    def worst(self, node, path=()):
        """bytes below and with node, and the path"""
        if node in path:
            fail("recursion: " + " -> ".join(short(n) for n in path + (node,)))
        if node in self.memo:
            return self.memo[node]
        if node not in self.frame:
            return LIBRARY, (node,)
        best = (0, ())
        for callee in sorted(self.calls.get(node, ())):
            best = max(best, self.worst(callee, path + (node,)), key=lambda x: x[0])
        self.memo[node] = (self.frame[node] + best[0], (node,) + best[1])
        return self.memo[node]


def short(node):
    """step.c:run_job.constprop.0 and sph2f_run_job_ alike: run_job"""
    name = node.split(":")[-1].split(".")[0]
    return re.sub(r"^sph[123][fd]_", "", name)


def sources(folder):
    out = {}
    for name in os.listdir(folder):
        if name.endswith((".c", ".h")):
            with open(os.path.join(folder, name), encoding="utf-8") as f:
                out[name] = f.read()
    return out


def main():
    if len(sys.argv) < 4:
        fail("usage: stack.py LABEL SOURCE_DIR CI_FILE...")
    label, folder, files = sys.argv[1], sys.argv[2], sys.argv[3:]
    g = Graph(files, sources(folder))
    entries = [n for n in g.frame if ":" not in n and re.match(r"sph[123][fd]_.*[^_]$", n)]
    if not entries:
        fail("no public function in " + " ".join(files))
    rows = sorted(((*g.worst(n), n) for n in entries), key=lambda r: (-r[0], r[2]))
    for bytes_, _, name in rows:
        print(f"stack_{label}_{short(name)},{bytes_},bytes,,")
    bytes_, path, _ = rows[0]
    print(f"  {label}: {bytes_} bytes: " + " -> ".join(f"{short(n)} {g.frame.get(n, LIBRARY)}" for n in path),
          file=sys.stderr)


if __name__ == "__main__":
    main()
