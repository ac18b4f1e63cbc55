#!/bin/sh
# SPDX-License-Identifier: MIT. Copyright the sph authors.
# atlas.sh: the tables of the stability atlas, as many at a time as there are cores (JOBS). A table whose sources are
# those it was made from is left alone: their checksum is kept beside the program, which may be deleted at any time.
# usage: BUILD=build/fast sh tests/lab/atlas.sh [TABLE ...]
set -eu
out=tests/lab
sum=$(cat sph/*.[ch] tools/dispersion.[ch] $out/atlas*.[ch] $out/box.[ch] $out/theory.[ch] $out/precision_run.[ch] |
    cksum)
mkdir -p "$BUILD/atlas_made"
list=
# shellcheck disable=SC2046
[ $# -gt 0 ] || set -- $("$BUILD/atlas" list)
for t; do
    made=$(cat "$BUILD/atlas_made/$t" 2>/dev/null || true)
    if [ -f $out/atlas_"$t".csv ] && [ "$made" = "$sum $(cksum <$out/atlas_"$t".csv)" ]; then
        echo "atlas: $t is up to date"
    else
        list="$list $t"
    fi
done
[ -n "$list" ] || exit 0
export BUILD out sum
# shellcheck disable=SC2016,SC2086
printf '%s\n' $list | xargs -P "${JOBS:-$(getconf _NPROCESSORS_ONLN)}" -n 1 sh -c '
    start=$(date +%s)
    "$BUILD/atlas" "$1" "$out/atlas_$1.csv" || exit 1
    echo "$sum $(cksum <"$out/atlas_$1.csv")" >"$BUILD/atlas_made/$1"
    echo "atlas: $1: $(grep -vc "^#" "$out/atlas_$1.csv") lines in $(($(date +%s) - start)) s"' atlas
