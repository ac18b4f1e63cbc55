#!/bin/sh
# SPDX-License-Identifier: MIT. Copyright the sph authors.
# coverage.sh: builds the tests with gcc's line counters, runs them, and adds up which lines of sph/ ran in any of the six
# builds. Writes OUT/coverage.csv; fails below 95 % of all lines.
set -u
BUILD=${BUILD:-build/coverage} OUT=${OUT:-build} GCC=${GCC:-gcc} GCOV=${GCOV:-gcov} MAKE=${MAKE:-make}
mkdir -p "$OUT"
find "$BUILD" -name '*.gcda' -delete 2>/dev/null
# -O0 so that a line is a line; scalar lanes, so that both forms of lanes.h count as what was compiled
$MAKE --no-print-directory -s tests BUILD="$BUILD" CC="$GCC" OPT="-O0 -g" CFLAGS="--coverage" LDFLAGS="--coverage" || exit 1
echo "  running the tests (their failures are for make test to show)"
for t in "$BUILD"/tests/test_*_[123][fd]; do "$t" >/dev/null 2>&1; done
for b in 1f 1d 2f 2d 3f 3d; do
    mkdir -p "$BUILD/gcov/$b"
    (cd "$BUILD/gcov/$b" && "$GCOV" -r -s "$OLDPWD" -o "$OLDPWD/$BUILD/obj/$b/sph" "$OLDPWD/$BUILD/obj/$b/sph/"*.gcda >/dev/null 2>&1)
done
out=$OUT/coverage.csv
echo "name,value,unit,target,ok" >"$out"
# a line counts as run if it ran in any build
awk -F: '
    { gsub(/ /, "", $1); gsub(/ /, "", $2) }
    $2 == 0 { if ($3 == "Source") file = $4; next }
    $1 == "-" || file !~ /(^|\/)sph\// { next }
    { sub(/.*sph\//, "sph/", file); key = file ":" $2; seen[key] = 1; if ($1 !~ /^(#####|=====)$/) ran[key] = 1 }
    END {
        for (k in seen) { f = k; sub(/:.*/, "", f); n[f]++; all++; if (k in ran) { r[f]++; got++ } else print k > MISSED }
        for (f in n) printf "%s,%.1f,%% of %d lines,,\n", f, 100 * r[f] / n[f], n[f] | "sort"
        close("sort")
        printf "all,%.2f,%% of %d lines,>=95,%s\n", all ? 100 * got / all : 0, all, all && got >= 0.95 * all ? "yes" : "no"
    }' MISSED="$OUT/coverage_missed.txt" "$BUILD"/gcov/*/*.gcov >>"$out"
sh tests/table.sh "$out"
