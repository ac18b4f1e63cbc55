#!/bin/sh
# SPDX-License-Identifier: MIT. Copyright the sph authors.
# size.sh: what a scene and the kernel cost: arena bytes; code, constant and writable bytes; the deepest stack of any
# public function (tests/stack.py), checked against a painted one; passes, candidate pairs and instructions of a step.
# For this machine and, if the tools are there, an emulated Cortex-M4F. Writes BUILD/size.csv, and BUILD/stack.csv with
# every function.
#   sh tests/size.sh
#   sh tests/size.sh --gate: what was measured against tests/results/size.csv, with 3 % to spare
#   sh tests/size.sh --code host|m4f|water BUILD: code, writable bytes and stack of that build alone
set -u
BUILD=${BUILD:-build} CC=${CC:-cc} SIZE=${SIZE:-size} MAKE=${MAKE:-make} PYTHON=${PYTHON:-python3}
ARM_SIZE=${ARM_SIZE:-arm-none-eabi-size} ARM_LD=${ARM_LD:-arm-none-eabi-ld}
BITS=${BITS:--std=c11 -ffp-contract=off -fno-math-errno -fno-trapping-math}
# knobs of a kernel with nothing but water and its walls in it (sph/modules.h), and the functions that its host calls;
# what they do not need is left out by the linker, as in an image
w=-DSPH_WITH_
water="${w}ALL=0 ${w}WENDLAND_C2=1 ${w}STANDARD=1 ${w}TAIT=1 ${w}ARTIFICIAL=1 ${w}PREDICTOR_CORRECTOR=1"
water="$water ${w}WALL_ADAMI=1"
WATER_ONLY=${WATER_ONLY:-$water}
WATER_CALLS="config_default arena_bytes init get_usage last add_fluid add_box wall_default add_wall_box ready step
    step_to step_slice step_cancel get_step time count get hash"
SELDOM="${w}SHIFTING=0 ${w}SHEAR=0 ${w}MLS=0 ${w}ENERGY=0 ${w}FLOW=0 ${w}EDGES=0"
SELDOM="$SELDOM ${w}ONE_SIDED=0 ${w}STABILISED=0 ${w}NORMALISED=0 ${w}HOURGLASS=0 ${w}DAMPER=0"
SELDOM="$SELDOM ${w}DAMPING_RATE=0 ${w}XSPH_VELOCITY=0 ${w}ANTUONO=0"
WATER_LIMIT=25600 STACK_LIMIT=2048 HOST_STACK_LIMIT=8192
out=$BUILD/size.csv dir=$BUILD/size stacks=$BUILD/stack.csv committed=tests/results/size.csv

gate() {
    [ -f "$out" ] || { echo "size.sh: no $out; make it with: make size" >&2; return 1; }
    awk -F, 'FNR == 1 {next}
        $1 !~ /^(arena_|code_m4f|stack_m4f|instructions_m4f)/ {next}
        FILENAME == ARGV[1] {was[$1] = $2; next}
        !($1 in was) {printf "  %-46s %12s new\n", $1, $2; next}
        {n++; seen[$1] = 1}
        $2 > was[$1] * 1.03 {bad++; printf "  %-46s %12s was %s: %+.1f %%\n", $1, $2, was[$1], 100 * $2 / was[$1] - 100}
        END {
            for (r in was) if (!(r in seen)) {bad++; printf "  %-46s was not measured\n", r}
            printf "size-gate: %d rows compared, %d grew by more than 3 %% or are missing\n", n, bad
            exit bad > 0 || n == 0
        }' $committed "$out"
}
[ "${1:-}" = --gate ] && { gate; exit $?; }
case ${1:-} in
'') ;;
--code)
    case ${2:-} in
    host | m4f | water) ;;
    *) echo "size.sh: --code '${2:-}'; allowed are host, m4f, water" >&2; exit 2 ;;
    esac
    ;;
*) echo "size.sh: '$1' is not known; allowed: nothing, --gate, --code" >&2; exit 2 ;;
esac

. port/cortexm.sh
mkdir -p "$dir"
echo "name,value,unit,target,ok" >"$out.tmp"
echo "name,value,unit,target,ok" >"$stacks"
[ -x "$BUILD/size_arena" ] && "$BUILD/size_arena" >>"$out.tmp"

limit() { # name value unit target (empty: none); at most
    if [ -z "$4" ]; then ok=; t=; else t="<=$4"; [ "$2" -le "$4" ] && ok=yes || ok=no; fi
    echo "$1,$2,$3,$t,$ok" >>"$out.tmp"
}
bytes_of() { "$1" -A "$3"/*.o | awk -v p="$2" '$1 ~ p {t += $2} END {print t + 0}'; }

# label, compiler, size tool, flags, build, limits of code and stack, functions that the host calls (empty: all)
measure() {
    d=$dir/$1_$5
    rm -rf "$d" && mkdir -p "$d"
    dim=${5%?} double=0
    [ "${5#?}" = d ] && double=1
    for f in sph/*.c; do
        # shellcheck disable=SC2086
        $2 $BITS $4 -ffunction-sections -DSPH_DIM=$dim -DSPH_DOUBLE=$double -c "$f" -o "$d/$(basename "$f" .c).o" ||
            return 1
    done
    linked=$d
    if [ -n "${8:-}" ]; then
        linked=$d/linked roots=
        mkdir -p "$linked"
        for f in $8; do roots="$roots -u sph$5_$f"; done
        # shellcheck disable=SC2086
        $ARM_LD -r --gc-sections $roots "$d"/*.o -o "$linked/all.o" || return 1
    fi
    limit "code_$1_$5" "$(bytes_of "$3" '^[.]text' "$linked")" bytes "$6"
    limit "rodata_$1_$5" "$(bytes_of "$3" '^[.](rodata|data[.]rel[.]ro)' "$linked")" bytes ""
    limit "writable_$1_$5" "$(bytes_of "$3" '^[.](bss|data$|data[.][^r])' "$d")" bytes 0
    case $4 in *-fcallgraph-info*) ;; *) return 0 ;; esac
    "$PYTHON" tests/stack.py "$1_$5" sph "$d"/*.ci >"$d/stack.csv" || return 1
    cat "$d/stack.csv" >>"$stacks"
    limit "stack_$1_$5" "$(awk -F, '$2 > m {m = $2} END {print m}' "$d/stack.csv")" bytes "$7"
}

# passes and candidate pairs of the scenes of a build, and their hashes, on this machine
host_scenes() {
    metal_build_host "$dir/scenes_$1" "$1" tests/metal_scenes.c && "$dir/scenes_$1" >"$dir/scenes_$1.txt" ||
        { echo "size: the scenes of $1 fail on this machine" >&2; return 1; }
    awk -v b="$1" '{
        printf "passes_%s_%s,%s,passes/step,,\npairs_%s_%s,%s,pairs/step,,\n", b, $1, $7, b, $1, $9
        printf "pairs_%s_%s_particle,%.1f,pairs/particle-step,,\n", b, $1, $9 / $3
    }' "$dir/scenes_$1.txt" >>"$out.tmp"
}
hashes() { awk '{print $1, $NF}' "$1"; }

# instructions of the scenes of a build on the M4F at a level: twice the same, and the host's hashes
metal_scenes() { # build level label
    p=$dir/scenes_m4f$2_$1
    metal_build "$p" "$2" "$1" "" tests/metal_scenes.c && metal_count "$p" >"$p.txt" && metal_count "$p" >"$p.again" ||
        { echo "size: the scenes of $1 fail on $metal at $2" >&2; return 1; }
    cmp -s "$p.txt" "$p.again" || { echo "size: two runs of $p differ" >&2; return 1; }
    hashes "$p.txt" >"$p.hashes"
    hashes "$dir/scenes_$1.txt" | cmp -s - "$p.hashes" ||
        { echo "size: hashes of $1 on $metal are not the host's" >&2; return 1; }
    awk -v l="$3_$1" '{printf "instructions_%s_%s,%s,instructions/particle-step,,\n", l, $1, $5}' "$p.txt" >>"$out.tmp"
}
# build: the depth of the painted stack of the scenes, against what the call graph says
painted() {
    for f in init step; do
        deepest=$(awk -v n=$f '{for (i = 2; i < NF; i++) if ($i == n && $(i + 1) > m) m = $(i + 1)} END {print m}' \
            "$dir/scenes_m4f-Os_$1.txt")
        limit "painted_m4f_$1_$f" "$deepest" bytes "$(awk -F, -v n="stack_m4f_$1_$f" '$1 == n {print $2}' "$stacks")"
    done
}

bad=0
# traps: -fno-trapping-math makes two calls of one comparison where doubles are software; no bit depends on it
arm="-Os -ftrapping-math -fcallgraph-info=su -fexcess-precision=fast"
graph=
"$CC" -fcallgraph-info=su -E -x c /dev/null >/dev/null 2>&1 && graph=-fcallgraph-info=su ||
    echo "  $CC has no -fcallgraph-info=su (gcc 10 and later have): no stack rows of this machine" >&2
if [ "${1:-}" = --code ]; then
    if [ "$2" = host ]; then
        measure host "$CC" "$SIZE" "-O2 $graph" "${3:-2f}" "" $HOST_STACK_LIMIT || bad=1
    elif [ "$2" = water ]; then
        metal_machine cortex-m4f && measure m4f_water_only "$metal_cc" "$ARM_SIZE" "$arm $WATER_ONLY" 2f $WATER_LIMIT \
            $STACK_LIMIT "$WATER_CALLS" || bad=1
    else
        metal_machine cortex-m4f && measure m4f "$metal_cc" "$ARM_SIZE" "$arm" "${3:-2f}" "" $STACK_LIMIT || bad=1
    fi
    sh tests/table.sh "$out.tmp" || bad=1
    exit $bad
fi
for b in 1f 1d 2f 2d 3f 3d; do
    measure host "$CC" "$SIZE" "-O2 $graph" $b "" $HOST_STACK_LIMIT || bad=1
    host_scenes $b || bad=1
done
if metal_machine cortex-m4f; then
    measure m4f_fluids "$metal_cc" "$ARM_SIZE" "$arm ${w}SOLID=0" 2f "" $STACK_LIMIT || bad=1
    for b in 1f 2f 3f; do
        measure m4f "$metal_cc" "$ARM_SIZE" "$arm" $b "" $STACK_LIMIT || bad=1
    done
    # double, which this chip has in software, is held to the limit without modules that few hosts take
    measure m4f "$metal_cc" "$ARM_SIZE" "$arm" 2d "" "" || bad=1
    measure m4f_usual "$metal_cc" "$ARM_SIZE" "$arm $SELDOM" 2d "" $STACK_LIMIT || bad=1
    measure m4f_water_only "$metal_cc" "$ARM_SIZE" "$arm $WATER_ONLY" 2f $WATER_LIMIT $STACK_LIMIT "$WATER_CALLS" ||
        bad=1
    for b in 1f 2f 3f; do
        METAL_CFLAGS='' metal_scenes $b -O2 m4f_O2 || bad=1
        METAL_CFLAGS=-DSPH_WITH_FAST_PATHS=0 metal_scenes $b -Os m4f_Os && painted $b || bad=1
    done
else
    echo "  the Cortex-M4F rows are left out" >&2
fi
mv "$out.tmp" "$out"
sh tests/table.sh "$out" || bad=1
exit $bad
