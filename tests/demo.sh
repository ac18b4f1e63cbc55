#!/bin/sh
# SPDX-License-Identifier: MIT. Copyright the sph authors.
# demo.sh BUILD: the 2-D dam break in BUILD/demo: history, dumps, and a picture of one of them. Ends by naming the files.
set -eu
build=$1 dir=$1/demo n=12
mkdir -p "$dir"
rm -f "$dir"/dam_break*
echo "  a column of water breaks free (900 particles and its walls) ..."
"$build/sph" run dam_break frames=$n out="$dir/dam_break"
shot=$(ls "$dir"/dam_break_*.sph | sed -n "$((n / 2 + 1))p")
last=$(ls "$dir"/dam_break_*.sph | tail -n 1)
"$build/sph" render "$shot" out="$dir/dam_break.png" field=speed >/dev/null
for f in "$dir/dam_break.png" "$last" "$dir/dam_break.csv"; do
    [ -s "$f" ] || { echo "demo: $f was not written" >&2; exit 1; }
done
echo "picture  $dir/dam_break.png (of $shot)"
echo "dump     $last (the last of $(ls "$dir"/dam_break_*.sph | wc -l))"
echo "history  $dir/dam_break.csv"
