#!/bin/sh
# SPDX-License-Identifier: MIT. Copyright the sph authors.
# demo.sh BUILD: the 2-D dam break for about a second of its time: dump, history and picture in BUILD/demo.
set -eu
build=$1 dir=$1/demo
mkdir -p "$dir"
"$build/sph" help >/dev/null
"$build/sph" run dam_break --out "$dir/dam_break" 
echo "picture  $dir/dam_break.png"
