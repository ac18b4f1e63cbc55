#!/bin/sh
# SPDX-License-Identifier: MIT. Copyright the sph authors.
# oracle.sh [SCENES]: random small scenes of each of the six builds against the oracle (tests/oracle); writes
# BUILD/oracle.csv. Scenes that differ are made small and printed, one for each quantity. Of the scenes drawn, few may
# be refused by the kernel, and few such that rounding decides them.
BUILD=${BUILD:-build}
scenes=${1:-3400} out=$BUILD/oracle.csv bad=0
echo "name,value,unit,target,ok" >"$out.tmp"
for b in ${BUILDS:-1f 1d 2f 2d 3f 3d}; do
    log=$BUILD/oracle_$b.txt
    timeout "${LIMIT:-900}" "$BUILD/oracle_$b" 1 "$scenes" >"$log"
    rc=$?
    grep -E '^seed|^  smallest' "$log"
    tail -n 1 "$log" | awk -F'[ ,:]+' -v b="$b" -v n="$scenes" -v rc="$rc" '
        function row(name, v, unit, target, ok) { printf "oracle_%s_%s,%s,%s,%s,%s\n", b, name, v, unit, target,
                                                          ok ? "yes" : "no" }
        $2 == "scenes" {
            row("scenes", $1, "scenes", "=" n, $1 == n)
            row("differ", $6, "scenes", "=0", $6 == 0 && rc == 0)
            row("undecided", $8, "scenes", "<=" int(n / 5), $8 <= n / 5)
            row("refused", $10, "scenes", "<=" int(n / 5), $10 <= n / 5)
            seen = 1
        }
        END { if (!seen) row("scenes", 0, "scenes", "=" n, 0) }' >>"$out.tmp"
done
mv "$out.tmp" "$out"
sh tests/table.sh "$out"
