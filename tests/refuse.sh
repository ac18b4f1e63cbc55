#!/bin/sh
# SPDX-License-Identifier: MIT. Copyright the sph authors.
# refuse.sh: builds and machines that would break bits are refused, and named. Then what the refusal guards against: a
# build with contraction, let through by SPH_NO_PROBE, differs from a sound one, and firstdiff.sh finds where.
# Writes BUILD/refuse.csv. Ways whose compiler is not here are left out and said so.
#   sh tests/refuse.sh [LABEL...]   ways with one of these labels only    STRICT=1   a way that is left out is a failure
set -u
. tests/machines.sh
dir=$BUILD/refuse bad=0 ran=0 STRICT=${STRICT:-0}
# the file with the probe
probe=$(grep -l SPH_NO_PROBE sph/*.c | head -n 1)
[ -n "$probe" ] || { echo "refuse: found no file of sph/ with the probe (SPH_NO_PROBE)" >&2; exit 1; }
mkdir -p "$dir"
echo "name,value,unit,target,ok" >"$BUILD/refuse.csv"

# label | machine | flags that break, for the file with the probe | flags of linking and of refuse.c | what must be said
ways() {
    cat <<'END'
sound|x86_64-gcc|||ok
sound clang|x86_64-clang|||ok
contraction gcc|x86_64-gcc|-ffp-contract=fast -mfma||contraction
contraction gcc -O3|x86_64-gcc|-O3 -march=haswell -ffp-contract=fast||contraction
contraction clang|x86_64-clang|-ffp-contract=fast -mfma||contraction
contraction clang -O3|x86_64-clang|-O3 -march=haswell -ffp-contract=fast||contraction
contraction aarch64|aarch64|-ffp-contract=fast||contraction
contraction riscv64|riscv64|-ffp-contract=fast||contraction
contraction s390x|s390x|-ffp-contract=fast||contraction
contraction ppc64|ppc64|-ffp-contract=fast||contraction
flush to zero by the linker|x86_64-gcc||-ffast-math|flush to zero
flush to zero at run time gcc|x86_64-gcc||-DREFUSE_FLUSH|flush to zero
flush to zero at run time clang|x86_64-clang||-DREFUSE_FLUSH|flush to zero
flush to zero aarch64|aarch64||-DREFUSE_FLUSH|flush to zero
rounding down|x86_64-gcc||-DREFUSE_ROUND=0x3f80|a rounding mode
rounding up|x86_64-gcc||-DREFUSE_ROUND=0x5f80|a rounding mode
rounding towards zero|x86_64-clang||-DREFUSE_ROUND=0x7f80|a rounding mode
x87 compiled|i686|-mfpmath=387||#error
fast-math compiled|x86_64-gcc|-ffast-math||#error
x87 run|i686|-mfpmath=387 -U__FLT_EVAL_METHOD__ -D__FLT_EVAL_METHOD__=0 -w||excess precision
END
}

# says what way $1 (flags $2, linking $3) of the machine read last answers for build $4
answer() {
    d=$BUILD/targets/$1
    machine_directory "$d" "$cc|$flags"
    double=0
    [ "${4#?}" = d ] && double=1
    bits="-std=c11 -ffp-contract=off -fno-math-errno -fno-trapping-math"
    case $cc in *clang*) ;; *) bits="$bits -fexcess-precision=fast" ;; esac
    defines="-I. -Itests -DSPH_DIM=${4%?} -DSPH_DOUBLE=$double"
    # shellcheck disable=SC2086
    if ! $cc $bits $flags $2 $defines -c "$probe" -o "$dir/probe.o" >"$dir/log" 2>&1; then
        grep -q 'error: .*sph ' "$dir/log" && echo "#error: $(grep -m1 'error: ' "$dir/log" | sed 's/.*sph /sph /')" ||
            cat "$dir/log"
        return
    fi
    # refuse.c is compiled apart: flags of linking such as -ffast-math are not meant for it
    define=
    case $3 in -D*) define=$3 ;; esac
    # shellcheck disable=SC2086
    { machine_link "$d" "$4" "$d/refuse_sound" tests/refuse.c &&
        $cc $bits $flags $define $defines -c tests/refuse.c -o "$dir/refuse.o" &&
        $cc $flags $3 "$dir/refuse.o" "$dir/probe.o" \
            $(echo "$objects" | tr ' ' '\n' | grep -v "/${probe%.c}.o$") $extra -o "$dir/refuse"; } \
        >"$dir/log" 2>&1 || { cat "$dir/log"; return; }
    machine_run "$dir/refuse"
}

# one object of the kernel built unlike the others: it and the reason are named
# object | machine | its flags | what must be said (of an error of the compiler: its beginning)
objects_that_differ() {
    cat <<'END'
move|x86_64-gcc|-mfma -ffp-contract=fast|contraction*in move.c
forces|x86_64-gcc|-O3 -mfma -ffp-contract=fast|contraction*in forces.c
dmath|x86_64-gcc|-mfma -ffp-contract=fast|contraction*in dmath.c
timestep|x86_64-clang|-mfma -ffp-contract=fast|contraction*in timestep.c
kernels|x86_64-clang|-ffast-math -fno-finite-math-only|sums in another order*in kernels.c
tiles|x86_64-clang|-freciprocal-math|reciprocals*in tiles.c
sweep|x86_64-clang|-fno-signed-zeros|zeros*in sweep.c
settle|x86_64-gcc|-DSPH_WITH_XSPH=0|SPH_WITH_XSPH*in settle.c
hash|x86_64-gcc|-ffinite-math-only|#error
carry|x86_64-gcc|-freciprocal-math|#error
grid|x86_64-gcc|-fsingle-precision-constant|#error
END
}

: >"$dir/ways"
for label in "$@"; do
    ways | grep "^$label|" >>"$dir/ways" || { echo "refuse: no way '$label'; look at ways() in $0" >&2; exit 2; }
done
[ $# -gt 0 ] || ways >"$dir/ways"
while IFS='|' read -r label machine break link want; do
    read_machine "$machine" || exit 2
    gone=$(machine_missing "$dir/try")
    if [ -n "$gone" ]; then
        echo "  $label: left out: $gone; apt-get install --no-install-recommends $packages"
        bad=$((bad + STRICT))
        continue
    fi
    for b in ${BUILDS:-2f 2d}; do
        ran=$((ran + 1)) said=$(answer "$machine" "$break" "$link" $b </dev/null) ok=yes
        case $said in "$want"*) ;; *) ok=no bad=$((bad + 1)) ;; esac
        printf '  %-32s %s  %-4s %s\n' "$label" $b $ok "$said"
        echo "$label $b,$(echo "$said" | cut -d' ' -f1-3 | tr -d ,),said,$want,$ok" >>"$BUILD/refuse.csv"
    done
done <"$dir/ways"

own=$probe
[ $# -gt 0 ] || objects_that_differ | while IFS='|' read -r object machine break want; do
    read_machine "$machine" || exit 2
    [ -z "$(machine_missing "$dir/try")" ] || { echo "  $object.c, $machine: left out"; continue; }
    for b in ${BUILDS:-2f 2d}; do
        probe=sph/$object.c said=$(answer "$machine" "$break" "" $b </dev/null) ok=yes
        # shellcheck disable=SC2254
        case $said in $want*) ;; *) ok=no ;; esac
        printf '  %-32s %s  %-4s %s\n' "$object.c $break" $b $ok "$said"
        echo "$object.c $break $b,$(echo "$said" | cut -d' ' -f1-3 | tr -d ,),said,$want,$ok" >>"$BUILD/refuse.csv"
    done
done
[ $# -gt 0 ] || { ran=$((ran + 1)); grep -q '[.]c .*,no$' "$BUILD/refuse.csv" && bad=$((bad + 1)); }
probe=$own

broken='x86_64-gcc:-mfma -ffp-contract=fast -DSPH_NO_PROBE'
if [ $# -gt 0 ]; then
    :
elif grep -qw fma /proc/cpuinfo 2>/dev/null; then
    for b in 2f 3d; do
        ran=$((ran + 1))
        sh tests/firstdiff.sh $b base x86_64-gcc "$broken" >"$dir/first"
        rc=$?
        sed 's/^/  /' "$dir/first"
        [ $rc = 1 ] && grep -qE 'step [0-9]+, pass [0-9]+ \([a-z -]+\), field [a-z]+, particle [0-9]+ ' "$dir/first" ||
            { bad=$((bad + 1)); echo "  the difference was not named"; }
        ran=$((ran + 1))
        sh tests/firstdiff.sh $b base x86_64-gcc x86_64-gcc:-O1 >"$dir/first"
        rc=$?
        sed 's/^/  /' "$dir/first"
        [ $rc = 0 ] || bad=$((bad + 1))
    done
else
    echo "  no FMA on this processor: firstdiff left out"
fi
echo "refuse: $ran checks, $bad failed"
[ $bad -eq 0 ] && [ $ran -gt 0 ]
