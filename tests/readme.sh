#!/bin/sh
# SPDX-License-Identifier: MIT. Copyright the sph authors.
# readme.sh: the first C block of README.md is the embedding example, to the letter; its tables of committed figures are
# what tests/results/ says.
set -u
BUILD=${BUILD:-build} PYTHON=${PYTHON:-python3} example=examples/embed.c
[ -s $example ] || { echo "readme: no $example" >&2; exit 1; }
mkdir -p "$BUILD"
awk '/^```/ && inside {exit} inside {print} /^```c$/ {inside = 1}' README.md >"$BUILD/readme.c" || exit 1
[ -s "$BUILD/readme.c" ] || { echo "readme: no C block in README.md" >&2; exit 1; }
diff "$BUILD/readme.c" $example && echo "readme: README.md shows $example" && "$PYTHON" tests/readme_tables.py
