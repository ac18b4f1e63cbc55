# SPDX-License-Identifier: MIT. Copyright the sph authors.
# cortexm.sh: for scripts that build and run programs on an emulated Cortex-M; read with `.` from the root of the tree,
# with BUILD and MAKE set. A machine's compiler, flags and emulator are its line in port/targets.txt.
metal_bits="-std=c11 -ffp-contract=off -fexcess-precision=fast -fno-math-errno -fno-trapping-math"
metal_warn="-Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wdouble-promotion"

metal_column() { # machine, column
    cat port/targets.txt |
        awk -F'|' -v n="$1" -v k="$2" '
            {m = $1; gsub(/ /, "", m); if (m == n) {v = $k; gsub(/^ +| +$/, "", v); print v; exit}}'
}

# Chooses a machine: sets metal_cc, metal_link, metal_run. Fails, and says what is missing, if it cannot be used.
metal_machine() {
    metal=$1 metal_cc=$(metal_column "$1" 3) metal_link=$(metal_column "$1" 5) metal_run=$(metal_column "$1" 6)
    [ -n "$metal_cc" ] ||
        { echo "cortexm.sh: no machine '$1' in port/targets.txt; allowed: a name of its first column" >&2; return 2; }
    for tool in "${metal_cc%% *}" "${metal_run%% *}"; do
        command -v "$tool" >/dev/null 2>&1 ||
            { echo "no $tool; as root: apt-get install --no-install-recommends $(metal_column "$1" 2)" >&2; return 1; }
    done
    # the compiler alone is not enough: string.h comes with picolibc
    # shellcheck disable=SC2086
    echo '#include <string.h>' | $metal_cc -fsyntax-only -x c - >/dev/null 2>&1 ||
        { echo "$metal_cc finds no C library; as root: apt-get install $(metal_column "$1" 2)" >&2; return 1; }
}

# metal_build OUT LEVEL BUILD "link flags" SOURCE...: a program of the build (2f and so on) for the chosen machine, with
# the scenes and the kernel of that level; warnings are errors
metal_build() ( # a subshell: its variables are its own
    out=$1 level=$2 b=$3 more=$4
    shift 4
    # objects of other flags are others
    dim=${b%?} double=0 dir=$BUILD/metal/$metal$level$(printf %s "$METAL_CFLAGS" | tr -cs A-Za-z0-9 _)
    [ "${b#?}" = d ] && double=1
    objects=$dir/libsph$b.a
    for f in examples/scenes/*.c; do objects="$dir/obj/$b/${f%.c}.o $objects"; done
    # shellcheck disable=SC2086
    $MAKE --no-print-directory -s BUILD="$dir" CC="$metal_cc" AR=arm-none-eabi-ar OPT="$level" \
        CFLAGS="-ffunction-sections -fdata-sections $METAL_CFLAGS" $objects || return 1
    mkdir -p "$(dirname "$out")"
    # shellcheck disable=SC2086
    $metal_cc $metal_bits $metal_warn -Werror $level -ffunction-sections -fdata-sections -I. -Iexamples/scenes \
        -DSPH_DIM=$dim -DSPH_DOUBLE=$double $METAL_CFLAGS "$@" $objects $metal_link $more -o "$out"
)
METAL_CFLAGS=${METAL_CFLAGS:-}

# the same program on this machine: port/cortexm.h is answered by tests/cortexm_host.c
metal_build_host() ( # OUT BUILD SOURCE...
    out=$1 b=$2
    shift 2
    dim=${b%?} double=0 objects=$BUILD/libsph$b.a
    [ "${b#?}" = d ] && double=1
    for f in examples/scenes/*.c; do objects="$BUILD/obj/$b/${f%.c}.o $objects"; done
    # shellcheck disable=SC2086
    $MAKE --no-print-directory -s BUILD="$BUILD" CC="$CC" $objects || return 1
    mkdir -p "$(dirname "$out")"
    # shellcheck disable=SC2086
    $CC -std=c11 -ffp-contract=off -O2 -I. -Iexamples/scenes -DSPH_DIM=$dim -DSPH_DOUBLE=$double "$@" \
        tests/cortexm_host.c $objects -lm -o "$out"
)

# Runs a program on the chosen machine, every instruction taking 1 ns of its time; sleep costs nothing. METAL_SECONDS is
# the longest it may take.
metal_count() {
    # shellcheck disable=SC2059,SC2086
    timeout "${METAL_SECONDS:-600}" $(printf "$metal_run" "$1") -icount shift=0,sleep=off </dev/null
}
