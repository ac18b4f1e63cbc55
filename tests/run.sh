#!/bin/sh
# SPDX-License-Identifier: MIT. Copyright the sph authors.
# run.sh BUILD PROGRAM...: runs test programs, JOBS at a time (default: as many as there are processors), one line each
# as they end; the names of failed tests and what they said follow the line.
build=$1
shift
mkdir -p "$build/tests"

# one program: its line, and its counts in NAME.sum
one() {
    name=${1##*/}
    log=$build/tests/$name.txt
    start=$(date +%s)
    ${EXEC:-} "$1" >"$log" 2>&1
    rc=$?
    p=$(grep -c '^\[       OK \]' "$log")
    f=$(grep '^\[  FAILED  \] [a-z_A-Z0-9]*$' "$log" | sort -u | wc -l)
    # a program that dies without saying so, or has no test, counts as one failure
    [ $rc -ne 0 ] && [ "$f" -eq 0 ] && f=1
    [ "$p" -eq 0 ] && [ "$f" -eq 0 ] && f=1 rc=1 && echo "no test ran" >>"$log"
    echo "$p $f" >"$build/tests/$name.sum"
    said=
    [ $rc -ne 0 ] && said=$(grep -vE '^\[ RUN|^\[       OK|^\[=====' "$log" | head -40 | sed 's/^/      /; 1s/^/\n/')
    # one write, so that lines of programs that end together do not mix
    printf '  %-24s %3d passed %3d failed %4d s%s\n' "$name" "$p" "$f" $(($(date +%s) - start)) "$said"
}
if [ "$1" = --one ]; then
    one "$2"
    exit 0
fi

[ $# -gt 0 ] || { echo "run.sh: no test program to run" >&2; exit 1; }
for t in "$@"; do rm -f "$build/tests/${t##*/}.sum"; done
printf '%s\n' "$@" | xargs -P "${JOBS:-$(nproc 2>/dev/null || echo 2)}" -n 1 sh "$0" "$build" --one
for t in "$@"; do cat "$build/tests/${t##*/}.sum" 2>/dev/null || echo "0 1"; done |
    awk '{p += $1; f += $2} END {printf "tests: %d passed, %d failed\n", p, f; exit f > 0}'
