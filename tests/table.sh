#!/bin/sh
# SPDX-License-Identifier: MIT. Copyright the sph authors.
# table.sh FILE.csv: shows a file of columns name,value,unit,target,ok as a readable table; fails if an `ok` is "no" or
# no row has a target.
[ -f "$1" ] || { echo "table.sh: no table ${1:-}" >&2; exit 1; }
awk -F, 'NR > 1 {
    printf "  %-46s %12s %-20s %-9s %s\n", $1, $2, $3, $4, $5
    if ($5 == "no") bad++
    if ($5 != "") n++
} END { printf "%s: %d rows with a target, %d missed\n", FILENAME, n, bad; exit bad > 0 || n == 0 }' "$1"
