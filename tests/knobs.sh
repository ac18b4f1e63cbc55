#!/bin/sh
# SPDX-License-Identifier: MIT. Copyright the sph authors.
# knobs.sh: builds the kernel with every knob of sph/modules.h off alone, and with random sets of knobs off, warnings as
# errors, and runs the golden cases. A case that asks for what was left out must be refused; every other case must have
# its golden hash. One case that every build has (tests/knobs.c) must run in each and be the same in all. Prints what
# each knob saves in code; writes BUILD/knobs.csv.
#   sh tests/knobs.sh [random sets, default 12] [seed, default 1]     KNOBS="XSPH BOOKS"   of single knobs these only
#   SHARE=4   every fourth single knob only (for CI; the random sets leave each out in about half of them)
set -u
. tests/shares.sh
BUILD=${BUILD:-build} CC=${CC:-gcc} SIZE=${SIZE:-size} JOBS=${JOBS:-2} KNOB_BUILD=${KNOB_BUILD:-2f}
BITS=${BITS:--std=c11 -ffp-contract=off -fno-math-errno -fno-trapping-math}
sets=${1:-12} seed=${2:-1}
dir=$BUILD/knobs out=$BUILD/knobs.csv
strict="-Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wdouble-promotion -Werror"
dim=${KNOB_BUILD%?} double=0
[ "${KNOB_BUILD#?}" = d ] && double=1
case $sets$seed in
*[!0-9]*)
    echo "knobs.sh: '$sets' and '$seed' must be whole numbers: how many random sets, and their seed" >&2
    exit 2
    ;;
esac
rm -rf "$dir" && mkdir -p "$dir/cache"
grep "^$KNOB_BUILD," tests/golden.csv >"$dir/golden.csv"
[ -s "$dir/golden.csv" ] || { echo "knobs.sh: tests/golden.csv has no case of build $KNOB_BUILD" >&2; exit 1; }
{ echo "$KNOB_BUILD,least" && cut -d, -f1,2 "$dir/golden.csv"; } >"$dir/cases"

# one NAME "flags": the lines for the table and for what went wrong land in $dir/NAME.row and NAME.bad
one() {
    d=$dir/$1
    mkdir -p "$d"
    for f in sph/*.c tests/golden.c tests/knobs.c; do
        # many knobs leave many files as they are: text that was compiled before is not compiled again
        # shellcheck disable=SC2086
        key=$($CC $BITS -I. -DSPH_DIM=$dim -DSPH_DOUBLE=$double $2 -E -P "$f" | cksum | tr ' ' _)
        if [ ! -f "$dir/cache/$key.o" ]; then
            # shellcheck disable=SC2086
            $CC $BITS -Os $strict -I. -DSPH_DIM=$dim -DSPH_DOUBLE=$double $2 -c "$f" -o "$d/new.o" 2>>"$d.log" || {
                echo "$f does not compile: $(grep -m1 -E 'error|warning' "$d.log")" >"$d.bad"
                return
            }
            mv "$d/new.o" "$dir/cache/$key.o"
        fi
        cp "$dir/cache/$key.o" "$d/$(basename "$f" .c).o"
    done
    if ! $CC "$d"/*.o -o "$d/golden" 2>>"$d.log"; then
        echo "does not link: $(grep -m1 undefined "$d.log")" >"$d.bad"
        return
    fi
    # 1 says that a case was refused; whatever else says that the program died. No case may be left out.
    "$d/golden" >"$d.csv" 2>>"$d.log"
    rc=$? refused=0
    grep -q ',failed: ' "$d.csv" && refused=1
    if [ $rc -ne $refused ] || ! cut -d, -f1,2 "$d.csv" | cmp -s - "$dir/cases"; then
        echo "the golden program exits with $rc after $(wc -l <"$d.csv") of $(wc -l <"$dir/cases") cases" >"$d.bad"
        return
    fi
    # what is left out is refused by name, never run; the rest is golden
    grep -v ',failed: ' "$d.csv" >"$d.ran"
    grep ',failed: ' "$d.csv" | grep -vE 'a field of the configuration|an argument' >"$d.bad"
    grep -vxF -f "$dir/golden.csv" "$d.ran" >>"$d.bad"
    rm -f "$d/golden.o" "$d/knobs.o"
    echo "$1,$(wc -l <"$d.ran"),$($SIZE -A "$d"/*.o | awk '$1 ~ /^\.text/ {t += $2} END {print t}')" >"$d.row"
    rm -rf "$d"
}

# knobs, and sets of them, one a line: name flags
all_knobs() { sed -n 's/^    X(\([A-Z0-9_]*\), .*/\1/p' sph/modules.h; }
always="WENDLAND_C2 STANDARD TAIT PREDICTOR_CORRECTOR" # a build needs one kernel, scheme, ...
minimum=-DSPH_WITH_ALL=0
for k in $always; do minimum="$minimum -DSPH_WITH_$k=1"; done
list() {
    echo "everything|"
    for k in ${KNOBS:-$(share_of 0 $(all_knobs))}; do echo "no_$k|-DSPH_WITH_$k=0"; done
    echo "minimum|$minimum"
    all_knobs | awk -v sets="$sets" -v seed="$seed" -v always="$always" '
        {k[NR] = $1}
        END {srand(seed)
             for (s = 1; s <= sets; s++) {
                 f = ""
                 for (i = 1; i <= NR; i++)
                     if (rand() < 0.5 && !index(" " always " ", " " k[i] " ")) f = f " -DSPH_WITH_" k[i] "=0"
                 print "random_" s "|" f}}'
}

[ -n "$(all_knobs)" ] || { echo "knobs.sh: found no knob in sph/modules.h" >&2; exit 1; }
for k in ${KNOBS:-}; do
    all_knobs | grep -qx "$k" || { echo "knobs.sh: KNOBS has '$k'; allowed are" $(all_knobs) >&2; exit 2; }
done
list >"$dir/list"
# what the least case gives in a build with everything is what it must give in all
one everything ""
head -n 1 "$dir/everything.csv" 2>/dev/null | grep -v failed >>"$dir/golden.csv"
running=0
while IFS='|' read -r name flags; do
    one "$name" "$flags" &
    running=$((running + 1))
    [ $((running % JOBS)) -eq 0 ] && wait
done <"$dir/list"
wait

echo "name,value,unit,target,ok" >"$out"
bad=0
all=$(cut -d, -f3 "$dir/everything.row" 2>/dev/null || echo 0)
while IFS='|' read -r name flags; do
    if [ -s "$dir/$name.bad" ] || [ ! -f "$dir/$name.row" ]; then
        sed "s/^/  $name: /" "$dir/$name.bad" | head -3 >&2
        bad=$((bad + 1)) ok=no
    else
        ok=yes
    fi
    [ -f "$dir/$name.row" ] || continue
    IFS=, read -r n ran bytes <"$dir/$name.row"
    saved=$((all - bytes))
    # everything runs every case; the rest the least, or something where that asks for what is off
    least=1
    [ "$name" = everything ] && least=$(wc -l <"$dir/cases")
    case " $always " in
    *" ${name#no_} "*) ;;
    *) grep -q '^..,least,' "$dir/$name.ran" || ran=0 ;;
    esac
    [ "$ran" -ge "$least" ] ||
        { echo "  $name: ran $ran of $(wc -l <"$dir/cases") cases" >&2; bad=$((bad + 1)) ok=no; }
    # leaving code out adds none, but for a jump or two that a compiler encodes longer
    [ $saved -lt -16 ] && { echo "  $name: $((-saved)) bytes more than with everything" >&2; bad=$((bad + 1)) ok=no; }
    echo "$name,$saved,bytes saved,>=-16,$ok"
    echo "${name}_cases,$ran,cases golden,,"
done <"$dir/list" >>"$out"
awk -F, 'NR > 1 && $3 == "bytes saved" {printf "  %-32s %7d bytes of code saved\n", $1, $2}' "$out"
echo "knobs: $(wc -l <"$dir/list") builds of $KNOB_BUILD, $bad wrong"
[ $bad -eq 0 ]
