#!/bin/sh
# SPDX-License-Identifier: MIT. Copyright the sph authors.
# lint.sh: cppcheck (suppressions: tests/cppcheck.txt) and clang-tidy (.clang-tidy) over every source of kernel, port,
# scenes and tools, and the rules of the house (tests/house.py).
set -u
BUILD=${BUILD:-build} CPPCHECK=${CPPCHECK:-cppcheck} CLANG_TIDY=${CLANG_TIDY:-clang-tidy}
JOBS=${JOBS:-$(nproc 2>/dev/null || echo 2)}
mkdir -p "$BUILD"
inc="-I. -Isph -Iport -Iexamples -Iexamples/scenes -Itools -Itests"
files=$(ls sph/*.c port/*.c examples/scenes/*.c tools/*.c 2>/dev/null)
every=$(ls sph/*.c examples/scenes/*.c tools/build.c 2>/dev/null) # compiled for each build
plane=$(ls examples/*.c examples/baremetal/*.c 2>/dev/null) # programs of the 2-D build
metal=port/cortexm.c # for another processor
bad=0
[ -n "$files" ] || { echo "lint: no source here; run it where the Makefile is" >&2; exit 1; }
for tool in "$CPPCHECK" "$CLANG_TIDY"; do
    command -v "$tool" >/dev/null 2>&1 ||
        { echo "lint: no ${tool}; as root: apt-get install -y --no-install-recommends $tool" >&2; exit 1; }
done
for b in "1 0" "2 0" "3 1"; do
    # shellcheck disable=SC2086
    "$CPPCHECK" --quiet --std=c11 --enable=warning,performance,portability --inline-suppr --error-exitcode=1 \
        --suppressions-list=tests/cppcheck.txt -D__SSE2__ -DSPH_VECTOR_BYTES=0 -DFLT_EVAL_METHOD=0 -j "$JOBS" \
        -DSPH_DIM=${b% *} -DSPH_DOUBLE=${b#* } $inc $files $([ "${b% *}" = 2 ] && echo "$plane") || bad=1
done
# a program a file, as many at once as there are processors; each speaks only if it found something
for b in "2 0" "3 1"; do
    for f in $([ "${b% *}" = 2 ] && echo "$files $plane" || echo "$every"); do
        [ "$f" = $metal ] || echo "$f ${b% *} ${b#* }"
    done
done | TIDY="$CLANG_TIDY" INC="$inc" xargs -P "$JOBS" -L 1 sh -c '
    said=$("$TIDY" --quiet "$0" -- -std=c11 -ffp-contract=off -D_POSIX_C_SOURCE=200809L $INC \
        -DSPH_DIM="$1" -DSPH_DOUBLE="$2" 2>&1) || { printf "%s\n" "$said"; exit 1; }' || bad=1
headers=$(arm-none-eabi-gcc --specs=picolibc.specs -E -v -x c /dev/null 2>&1 | grep -m1 '^ /[^ ]*picolibc[^ ]*$')
if [ -n "$headers" ]; then
    "$CLANG_TIDY" --quiet $metal -- --target=arm-none-eabi -mcpu=cortex-m4 -mthumb -std=c11 -isystem "${headers# }" \
        2>"$BUILD/tidy.err" || { cat "$BUILD/tidy.err"; bad=1; }
else
    echo "lint: no headers for $metal; as root: apt-get install gcc-arm-none-eabi picolibc-arm-none-eabi" >&2
    bad=1
fi
"${PYTHON:-python3}" tests/house.py --build "$BUILD" --nm "${NM:-nm}" || bad=1
[ $bad = 0 ] && echo "lint: clean"
exit $bad
