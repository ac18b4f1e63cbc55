#!/bin/sh
# SPDX-License-Identifier: MIT. Copyright the sph authors.
# entries.sh: every function of sph/sph.h must have a row in tests/test_entry.c, and every row a function.
set -u
header=sph/sph.h table=tests/test_entry.c
for f in $header $table; do
    [ -f "$f" ] || { echo "entries.sh: no $f; run it where the Makefile is" >&2; exit 2; }
done
bad=0 n=0
in_header=$(sed -n 's/^#define sph_[a-z_0-9]* SPH_NAME(\([a-z_0-9]*\))$/\1/p' $header | sort)
in_table=$(grep -o 'ROW([a-z_0-9]*)' $table | sed 's/ROW(\(.*\))/\1/' | grep -v '^name$' | sort)
for f in $in_header; do
    n=$((n + 1))
    echo "$in_table" | grep -qx "$f" || { echo "entries.sh: sph_$f of $header has no row in $table" >&2; bad=1; }
done
for f in $in_table; do
    echo "$in_header" | grep -qx "$f" ||
        { echo "entries.sh: the row $f of $table has no function in $header" >&2; bad=1; }
done
[ $n -gt 0 ] || { echo "entries.sh: found no function in $header" >&2; bad=1; }
[ $bad = 0 ] && echo "entries: all $n functions of $header are driven by $table"
exit $bad
