#!/usr/bin/env python3
# SPDX-License-Identifier: MIT. Copyright the sph authors.
"""readme_tables.py: the tables of README.md that are nothing but committed figures, made from tests/results/.

A table stands between the lines `<!-- table: NAME -->` and `<!-- end -->`. Without an option: are they what the figures
say? Exit 1 and a difference where not.   --write: writes them.
"""
import csv, difflib, re, sys

RESULTS = "tests/results/"


def figures(name):
    with open(RESULTS + name) as f:
        return {r["name"]: r for r in csv.DictReader(f)}


def table(head, rows):
    return ["| %s |" % " | ".join(head), "|" + "---|" * len(head)] + ["| %s |" % " | ".join(r) for r in rows]


def number(text):
    return "{:,}".format(int(text)) if re.fullmatch(r"\d+", text) else text


def speed():
    """rows of bench.csv, a column a compiler and its options"""
    bench = figures("bench.csv")
    ways = [("gcc -O3 native", "gcc_native"), ("clang -O3 native", "clang_native"), ("gcc -O2", "gcc_portable"),
            ("clang -O2", "clang_portable")]

    def row(what, *names):
        cells, target = [], ""
        for _, way in ways:
            got = [bench[k] for k in ("%s_%s" % (way, n) for n in names) if k in bench]
            cells.append(" / ".join(r["value"] for r in got))
            target = target or (got[0]["target"] if got and way == ways[0][1] else "")
        return [what] + cells + [target]

    rows = [row("2-D, float / double, M particle-steps/s", "step_2d_f32_100k", "step_2d_f64_100k"),
            row("3-D, the same", "step_3d_f32_100k", "step_3d_f64_100k"),
            row("defaults of `dam_break`, the same", "scene_dam_break_2d_f32", "scene_dam_break_2d_f64"),
            row("defaults of `dam_break_3d`, the same", "scene_dam_break_3d_f32", "scene_dam_break_3d_f64"),
            row("two threads over one, 2-D", "two_threads_2d_f32", "two_threads_2d_f64"),
            row("two threads over one, 3-D", "two_threads_3d_f32", "two_threads_3d_f64"),
            row("a bare loop on two processors over one", "calibration_on_two"),
            row("whole step over its force sweep, 2-D", "step_over_force_2d_f32", "step_over_force_2d_f64"),
            row("the same, 3-D", "step_over_force_3d_f32", "step_over_force_3d_f64"),
            row("force sweep over the same sums from exact lists, 2-D", "force_over_limit_2d_f32"),
            row("time a particle-step, 1,000,000 over 10,000", "growth_10k_to_1M_f32", "growth_10k_to_1M_f64"),
            row("few particles in a large domain over a tight one", "empty_room_2d_f32", "empty_room_2d_f64"),
            row("an elastic step over one of water, Gray's form", "elastic_over_water_2d_f32",
                "elastic_over_water_2d_f64"),
            row("the same with artificial stress", "elastic_repelling_over_water_2d_f32",
                "elastic_repelling_over_water_2d_f64"),
            row("corrected", "corrected_over_water_2d_f32", "corrected_over_water_2d_f64"),
            row("total-Lagrangian", "total_over_water_2d_f32", "total_over_water_2d_f64"),
            row("bytes a particle, 2-D water", "memory_2d_f32_100k", "memory_2d_f64_100k"),
            row("the same, elastic: Gray's form", "memory_elastic_2d_f32", "memory_elastic_2d_f64"),
            row("the same, total-Lagrangian", "memory_total_2d_f32", "memory_total_2d_f64"),
            row("more with yield and damage", "memory_plastic_brittle_2d_f32", "memory_plastic_brittle_2d_f64")]
    return table(["float / double"] + [w for w, _ in ways] + ["target (gcc, float)"], rows)


def arena():
    size, scenes = figures("size.csv"), {}
    for name, r in size.items():
        m = re.fullmatch(r"arena_(\d)([fd])_(\w+)_particle", name)
        if m:
            scenes.setdefault((m[1], m[3]), {})[m[2]] = (r["value"], size[name[:-len("_particle")]]["value"])
    rows = [["`%s`" % s, " / ".join(of[p][0] for p in "fd" if p in of), number(of["f"][1])]
            for (_, s), of in scenes.items() if "f" in of]
    half = (len(rows) + 1) // 2
    rows += [["", "", ""]] * (2 * half - len(rows))
    head = ["scene, defaults", "bytes a particle, float / double", "arena, float"]
    return table(head * 2, [rows[k] + rows[k + half] for k in range(half)])


def chip():
    size, ram, slices = figures("size.csv"), figures("baremetal.csv"), figures("slices.csv")

    def row(what, r, unit="bytes", limit=None):
        return [what, number(r["value"]) + " " + unit, number(limit or re.sub(r"^[<>]?=", "", r["target"])) or "listed"]

    budgets = (500, 2000, 8000)
    over = [int(slices["slices_m4f_%d_worst" % b]["value"]) - b for b in budgets]
    return table(["2-D float kernel", "measured", "target"], [
        row("code, all of water and gas", size["code_m4f_fluids_2f"]),
        row("code, every module", size["code_m4f_2f"]),
        row("code of water alone, as an image links it: Wendland C2, standard scheme, Tait, artificial viscosity, "
            "predictor-corrector, Adami walls", size["code_m4f_water_only_2f"]),
        row("writable data", size["writable_m4f_2f"]),
        row("deepest stack of any function, from the call graph", size["stack_m4f_2f"]),
        row("the same, water alone", size["stack_m4f_water_only_2f"]),
        row("the same, painted on the emulated chip", size["painted_m4f_2f_init"], limit="2048"),
        row("a dam break of %s particles (%s of water), all its RAM: arena, data, stack" % (
            number(str(sum(int(ram["ram_m4f_" + k]["value"]) for k in ("water", "walls")))),
            number(ram["ram_m4f_water"]["value"])), ram["ram_m4f_all"]),
        row("instructions a particle-step, dam break, -O2 (counted by the emulator, repeats exactly)",
            size["instructions_m4f_O2_2f_dam_break"], unit=""),
        ["longest slice over its budget, whole dam break, budgets %s (`make slices`)" % " / ".join(
            number(str(b)) for b in budgets), " / ".join(str(max(0, o)) for o in over) + " units", "730"]])


def targets():
    """how many cases have the hashes of this machine, of each machine and build"""
    rows, of = [], {}
    for name, r in figures("targets.csv").items():
        m = re.fullmatch(r"(.+)_(\d[fd])_(equal|first_case)", name)
        if m:
            of.setdefault(m[1], {})[m[2] + m[3]] = r
    for machine, got in of.items():
        equal = {b: got[b + "equal"]["value"] for b in ("1f", "1d", "2f", "2d", "3f", "3d") if b + "equal" in got}
        compiler = re.search(r"\((.*)\)", next(v["unit"] for k, v in got.items() if k.endswith("equal")))[1]
        rows.append([machine, compiler] + [equal.get(b, "") for b in ("1f", "1d", "2f", "2d", "3f", "3d")])
    return table(["machine", "compiler", "1-D float", "double", "2-D float", "double", "3-D float", "double"], rows)


def main():
    words = sys.argv[1:]
    if words not in ([], ["--write"]):
        sys.exit("readme_tables.py: %s; allowed: nothing, --write" % " ".join(words))
    makers = {"speed": speed, "arena": arena, "chip": chip, "targets": targets}
    was = open("README.md").read().split("\n")
    now, skipping, seen = [], False, []
    for line in was:
        m = re.fullmatch(r"<!-- table: (\w+) -->", line)
        skipping = skipping and line != "<!-- end -->"
        if not skipping:
            now.append(line)
        if m:
            if m[1] not in makers:
                sys.exit("readme_tables.py: README.md wants a table `%s`; there are %s" % (m[1], " ".join(makers)))
            now += ["", *makers[m[1]](), ""]
            skipping = True
            seen.append(m[1])
    if skipping or sorted(seen) != sorted(makers):
        sys.exit("readme_tables.py: README.md has the tables %s; wanted are %s, each with its end" %
                 (seen, list(makers)))
    if words:
        open("README.md", "w").write("\n".join(now))
    elif now != was:
        print("\n".join(list(difflib.unified_diff(was, now, "README.md", RESULTS, lineterm="", n=0))[:40]))
        sys.exit("readme_tables.py: README.md is not what tests/results says; python3 tests/readme_tables.py --write")
    print("readme: %d tables are what tests/results says" % len(seen))


main()
