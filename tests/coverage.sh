#!/bin/sh
# SPDX-License-Identifier: MIT. Copyright the sph authors.
# coverage.sh: builds the tests with gcc's line counters, runs them, and adds up which lines of sph/ ran in any of the
# six builds. Writes OUT/coverage.csv; fails below 95 % of all lines.
set -u
BUILD=${BUILD:-build/coverage} OUT=${OUT:-build} GCC=${GCC:-gcc} GCOV=${GCOV:-gcov} MAKE=${MAKE:-make}
mkdir -p "$OUT"
find "$BUILD" -name '*.gcda' -delete 2>/dev/null
# -O1: at -O0 the tests of same bits take ten times as long, and lines keep their counts
$MAKE --no-print-directory -s tests BUILD="$BUILD" CC="$GCC" OPT="-O1 -g" CFLAGS="--coverage" LDFLAGS="--coverage" ||
    exit 1
echo "  running the tests (their failures are for make test to show)"
sh tests/run.sh "$BUILD" "$BUILD"/tests/test_*_[123][fd] >/dev/null
mkdir -p "$BUILD/gcov"
for b in 1f 1d 2f 2d 3f 3d; do
    "$GCOV" -t -r -o "$BUILD/obj/$b/sph" "$BUILD/obj/$b/sph/"*.gcda >"$BUILD/gcov/$b.gcov" 2>/dev/null
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
        for (k in seen) {
            f = k
            sub(/:.*/, "", f)
            n[f]++
            all++
            if (k in ran) { r[f]++; got++ } else print k > MISSED
        }
        for (f in n) printf "%s,%.1f,%% of %d lines,,\n", f, 100 * r[f] / n[f], n[f] | "sort"
        close("sort")
        ok = all && got >= 0.95 * all ? "yes" : "no"
        printf("all,%.2f,%% of %d lines,>=95,%s\n", all ? 100 * got / all : 0, all, ok)
    }' MISSED="$OUT/coverage_missed.txt" "$BUILD"/gcov/*.gcov >>"$out"
sh tests/table.sh "$out"
