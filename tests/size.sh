#!/bin/sh
# SPDX-License-Identifier: MIT. Copyright the sph authors.
# size.sh: arena bytes of the scenes, code and constant bytes of the kernel and its largest stack frame, for this machine
# and, if the cross compiler is there, a Cortex-M4F. Writes BUILD/size.csv.
set -u
BUILD=${BUILD:-build} CC=${CC:-cc} SIZE=${SIZE:-size} ARM_CC=${ARM_CC:-arm-none-eabi-gcc} ARM_SIZE=${ARM_SIZE:-arm-none-eabi-size}
BITS=${BITS:--std=c11 -ffp-contract=off -fno-math-errno -fno-trapping-math}
out=$BUILD/size.csv dir=$BUILD/size
mkdir -p "$dir"
echo "name,value,unit,target,ok" >"$out.tmp"
[ -x "$BUILD/size_arena" ] && "$BUILD/size_arena" >>"$out.tmp"

limit() { # name value unit target (empty: none); at most
    if [ -z "$4" ]; then ok=; t=; else t="<=$4"; [ "$2" -le "$4" ] && ok=yes || ok=no; fi
    echo "$1,$2,$3,$t,$ok" >>"$out.tmp"
}

# label, compiler, size tool, flags, build, stack limit
measure() {
    d=$dir/$1_$5
    mkdir -p "$d"
    dim=${5%?} double=0
    [ "${5#?}" = d ] && double=1
    for f in sph/*.c; do
        o=$d/$(basename "$f" .c).o
        # shellcheck disable=SC2086
        $2 $BITS $4 -ffunction-sections -fstack-usage -DSPH_DIM=$dim -DSPH_DOUBLE=$double -c "$f" -o "$o" || return 1
    done
    set -- "$@" "$($3 -A "$d"/*.o | awk '$1 ~ /^\.text/ {t += $2} END {print t}')" \
        "$($3 -A "$d"/*.o | awk '$1 ~ /^\.rodata/ || $1 ~ /^\.data\.rel\.ro/ {t += $2} END {print t + 0}')" \
        "$($3 -A "$d"/*.o | awk '$1 ~ /^\.(data|bss)/ && $1 !~ /rel\.ro/ {t += $2} END {print t + 0}')"
    limit "code_$1_$5" "$7" bytes ""
    limit "rodata_$1_$5" "$8" bytes ""
    limit "writable_$1_$5" "$9" bytes 0
    stack=$(cat "$d"/*.su | awk -F'\t' '{if ($2 > m) {m = $2; n = $1}} END {sub(/.*:/, "", n); print m, n}')
    limit "stack_$1_$5_${stack#* }" "${stack% *}" bytes "$6"
    if grep -q 'dynamic$' "$d"/*.su; then
        echo "size: a stack frame of $1 $5 is not bounded" >&2
        return 1
    fi
}

bad=0
for b in 1f 1d 2f 2d 3f 3d; do
    measure host "$CC" "$SIZE" "-O2" $b 8192 || bad=1
done
arm="-Os -mcpu=cortex-m4 -mthumb -mfpu=fpv4-sp-d16 -mfloat-abi=hard --specs=picolibc.specs -DSPH_WITH_FAST_PATHS=0"
# the compiler alone is not enough: string.h comes with picolibc
# shellcheck disable=SC2086
if echo '#include <string.h>' | "$ARM_CC" $arm -fsyntax-only -x c - >/dev/null 2>&1; then
    for b in 1f 2f 2d 3f; do
        measure m4f "$ARM_CC" "$ARM_SIZE" "$arm" $b 8192 || bad=1
    done
else
    echo "  no $ARM_CC with picolibc: the Cortex-M4F rows are left out (apt-get install picolibc-arm-none-eabi)" >&2
fi
mv "$out.tmp" "$out"
sh tests/table.sh "$out" || bad=1
exit $bad
