#!/bin/sh
# SPDX-License-Identifier: MIT. Copyright the sph authors.
# slices.sh: a whole dam break in slices on an emulated Cortex-M4F that counts instructions. The longest slice may be no
# longer than its budget and the constant that sph.h gives at sph_step_slice; a step no longer than the formula there.
# Prints histograms and writes BUILD/slices.csv.
set -u
BUILD=${BUILD:-build} MAKE=${MAKE:-make} CC=${CC:-cc}
# a slice of u units takes at most UNIT (u + 100) instructions on an M4F at -O2: the dearest are candidates that are
# loaded for a single particle
UNIT=${UNIT:-1000}
. port/cortexm.sh
metal_machine cortex-m4f || exit 1
dir=$BUILD/metal out=$BUILD/slices.csv
mkdir -p "$dir"
metal_build "$dir/slices" -O2 2f "" tests/slices.c && metal_build_host "$dir/slices_host" 2f tests/slices.c ||
    { echo "slices: tests/slices.c does not build" >&2; exit 1; }
"$dir/slices_host" >"$dir/slices_host.txt" ||
    { echo "slices: fails on this machine: $(tail -n 1 "$dir/slices_host.txt")" >&2; exit 1; }
metal_count "$dir/slices" >"$dir/slices.txt" ||
    { echo "slices: fails on $metal: $(tail -n 1 "$dir/slices.txt")" >&2; exit 1; }

awk -v unit="$UNIT" -v host="$dir/slices_host.txt" '
function bar(n, all,   s, k) { s = ""; for (k = 0; k < 50 * n / all; k++) s = s "#"; return s }
function row(name, value, units, target, ok) { printf "%s,%s,%s,%s,%s\n", name, value, units, target, ok }
function most(name, value, units, limit) { row(name, value, units, "<=" limit, value + 0 <= limit + 0 ? "yes" : "no") }
BEGIN {
    while ((getline line < host) > 0)
        if (split(line, f, " ") == 3 && f[2] == "hash") hash[f[1]] = f[3]
    print "name,value,unit,target,ok"
}
$2 == "bin" { n = ++bins[$1]; at[$1, n] = $3; many[$1, n] = $4; ns_at[$1, n] = $5; ns_many[$1, n] = $6; next }
{ v[$1, $2] = $3; if ($2 == "slices") order[++budgets] = $1 }
END {
    for (i = 1; i <= budgets; i++) {
        b = order[i]; name = "slices_m4f_" b
        row(name "_slices", v[b, "slices"], "slices", "", "")
        row(name "_steps", v[b, "steps"], "steps", "", "")
        row(name "_mean", int(v[b, "kinstructions"] * 1000 / v[b, "units"]), "instructions/unit", "", "")
        most(name "_worst", v[b, "worst_units"], "units", b + v[b, "extra"])
        row(name "_worst_counted_by_the_kernel", v[b, "kernel_worst_units"], "units", "=" v[b, "worst_units"],
            v[b, "kernel_worst_units"] == v[b, "worst_units"] ? "yes" : "no")
        most(name "_worst_time", v[b, "worst_instructions"], "instructions", unit * (b + v[b, "extra"] + 100))
        most(name "_dearest_unit", v[b, "dearest_unit"], "instructions/unit", unit)
        most(name "_worst_step", v[b, "worst_step_units"], "units", v[b, "step_bound"])
        row(name "_hash", v[b, "hash"], "hash", hash[b], v[b, "hash"] == hash[b] ? "yes" : "no")
        for (n = 1; n <= bins[b]; n++)
            row(name "_units_from_" at[b, n], many[b, n], "slices", "", "")
        for (n = 1; n <= bins[b]; n++)
            row(name "_instructions_from_" ns_at[b, n], ns_many[b, n], "slices", "", "")
        printf "budget %d units: %d slices in %d steps of %d particles; ", b, v[b, "slices"], v[b, "steps"],
            v[b, "particles"] > "/dev/stderr"
        printf "longest %d units (at most %d + %d), %d instructions\n", v[b, "worst_units"], b, v[b, "extra"],
            v[b, "worst_instructions"] > "/dev/stderr"
        printf "  %10s %7s %-50s %12s %7s\n", "units from", "slices", "", "instr. from", "slices" > "/dev/stderr"
        for (n = 1; n <= bins[b]; n++)
            printf "  %10d %7d %-50s %12d %7d %s\n", at[b, n], many[b, n], bar(many[b, n], v[b, "slices"]), ns_at[b, n],
                ns_many[b, n], bar(ns_many[b, n], v[b, "slices"]) > "/dev/stderr"
    }
}' "$dir/slices.txt" >"$out.tmp" 2>"$dir/histogram.txt"
cat "$dir/histogram.txt"
mv "$out.tmp" "$out"
sh tests/table.sh "$out" >"$dir/slices_table.txt"
code=$?
grep -v '_from_' "$dir/slices_table.txt"
exit $code
