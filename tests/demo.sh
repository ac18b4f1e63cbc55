#!/bin/sh
# SPDX-License-Identifier: MIT. Copyright the sph authors.
# demo.sh BUILD: the 2-D dam break of Martin & Moyce in BUILD/demo: history, dumps, its front beside their measurements,
# and a picture. Ends by naming the files.
set -eu
build=$1 dir=$1/demo
mkdir -p "$dir"
rm -f "$dir"/dam_break*
echo "  a column of water twice as high as wide breaks free (1152 particles and their walls) ..."
"$build/sph" run dam_break n2=2 n=24 length=10 end=0.35 every=0.01 out="$dir/dam_break"
awk -f tests/front.awk tests/refdata/martin_moyce_1952_n2_2.csv tests/refdata/vof_dam_break_n2_2.csv \
    "$dir/dam_break.csv"
shot=$(ls "$dir"/dam_break_*.sph | sed -n 19p)
last=$(ls "$dir"/dam_break_*.sph | tail -n 1)
"$build/sph" render "$shot" out="$dir/dam_break.png" field=speed >/dev/null
for f in "$dir/dam_break.png" "$last" "$dir/dam_break.csv"; do
    [ -s "$f" ] || { echo "demo: $f was not written" >&2; exit 1; }
done
echo "picture  $dir/dam_break.png (of $shot)"
echo "dump     $last (the last of $(ls "$dir"/dam_break_*.sph | wc -l))"
echo "history  $dir/dam_break.csv"
