#!/bin/sh
# SPDX-License-Identifier: MIT. Copyright the sph authors.
# bench.sh: compiles bench.c with the kernel in several ways, runs them one after the other (an idle machine, please)
# and writes BUILD/bench.csv. Targets are for the machine of the committed tests/results/bench.csv.
set -u
BUILD=${BUILD:-build} GCC=${GCC:-gcc} CLANG=${CLANG:-clang}
BITS=${BITS:--std=c11 -ffp-contract=off -fno-math-errno -fno-trapping-math}
dir=$BUILD/bench out=$BUILD/bench.csv
mkdir -p "$dir"
echo "name,value,unit,target,ok" >"$out.tmp"

# label, compiler, flags, double, target rate, more, dimensions (2)
run() {
    command -v "$2" >/dev/null 2>&1 || { echo "  no $2: left out" >&2; return 0; }
    echo "  $1 ($([ "$4" = 1 ] && echo double || echo float))" >&2
    case $($2 --version) in *clang*) more= ;; *) more=-fexcess-precision=fast ;; esac
    # shellcheck disable=SC2086
    $2 $BITS $more $3 -D_POSIX_C_SOURCE=200809L -DSPH_DIM=${7:-2} -DSPH_DOUBLE=$4 -I. -Iexamples/scenes \
        sph/*.c port/posix.c examples/scenes/*.c tests/bench.c -pthread -o "$dir/$1_${7:-2}_$4" -lm || return 1
    # shellcheck disable=SC2086
    "$dir/$1_${7:-2}_$4" "$1_" $5 ${6:-} >>"$out.tmp"
}

bad=0
run gcc_native "$GCC" "-O3 -march=native" 0 12 full || bad=1
run gcc_native "$GCC" "-O3 -march=native" 1 7 full || bad=1
run clang_native "$CLANG" "-O3 -march=native" 0 13 full || bad=1
run clang_native "$CLANG" "-O3 -march=native" 1 8 full || bad=1
run gcc_native "$GCC" "-O3 -march=native" 0 0 full 3 || bad=1
run gcc_native "$GCC" "-O3 -march=native" 1 0 full 3 || bad=1
run gcc_portable "$GCC" "-O2" 0 5 || bad=1
run gcc_portable "$GCC" "-O2" 1 0 || bad=1
run clang_portable "$CLANG" "-O2" 0 5 || bad=1
run clang_portable "$CLANG" "-O2" 1 0 || bad=1
mv "$out.tmp" "$out"
sh tests/table.sh "$out" || bad=1
exit $bad
