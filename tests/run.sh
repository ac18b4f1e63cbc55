#!/bin/sh
# SPDX-License-Identifier: MIT. Copyright the sph authors.
# run.sh BUILD PROGRAM...: runs test programs, one line each; the names of failed tests and what they said follow.
build=$1
shift
pass=0 fail=0
mkdir -p "$build/tests"
for t in "$@"; do
    name=${t##*/}
    log=$build/tests/$name.txt
    start=$(date +%s)
    ${EXEC:-} "$t" >"$log" 2>&1
    rc=$?
    p=$(grep -c '^\[       OK \]' "$log")
    f=$(grep '^\[  FAILED  \] [a-z_A-Z0-9]*$' "$log" | sort -u | wc -l)
    # a program that dies without saying so counts as one failure
    [ $rc -ne 0 ] && [ "$f" -eq 0 ] && f=1
    pass=$((pass + p)) fail=$((fail + f))
    printf '  %-24s %3d passed %3d failed %4d s\n' "$name" "$p" "$f" $(($(date +%s) - start))
    [ $rc -ne 0 ] && grep -vE '^\[ RUN|^\[       OK|^\[=====' "$log" | head -40 | sed 's/^/      /'
done
echo "tests: $pass passed, $fail failed"
[ $fail -eq 0 ]
