#!/bin/sh
# SPDX-License-Identifier: MIT. Copyright the sph authors.
# targets.sh: the golden runs on every machine of port/targets.txt that this one has tools for: all six builds, every hash
# against tests/golden.csv. Installs nothing; says what is missing. Writes BUILD/targets.csv.
#   sh tests/targets.sh [NAME...]     these machines only (default: all)
#   FULL=1      slow machines run all cases too          STRICT=1   a machine without tools counts as a failure
#   JOBS=N      machines at once (default 2)             BUILD=DIR  where things are made (default build)
set -u
BUILD=${BUILD:-build} MAKE=${MAKE:-make} JOBS=${JOBS:-2} FULL=${FULL:-0} STRICT=${STRICT:-0} LIST=${LIST:-port/targets.txt}
golden=tests/golden.csv dir=$BUILD/targets
builds="1f 1d 2f 2d 3f 3d"
export BUILD MAKE FULL LIST

rows() { sed '/^#/d; /^ *$/d' "$LIST"; }
names() { rows | awk -F'|' '{gsub(/ /, "", $1); print $1}'; }
# column $2 of machine $1, without blanks around it
column() { rows | awk -F'|' -v n="$1" -v k="$2" '{m = $1; gsub(/ /, "", m); if (m == n) {v = $k; gsub(/^ +| +$/, "", v); print v}}'; }

# sets the columns of machine $1, and which cases it runs
read_target() {
    packages=$(column "$1" 2) cc=$(column "$1" 3) flags=$(column "$1" 4) extra=$(column "$1" 5) run=$(column "$1" 6)
    every=$(column "$1" 7) d=$dir/$1 first=0
    case $every in '' | *[!0-9]* | 0) echo "targets.sh: $1 in $LIST: '$every' in column 7; allowed: a number from 1" >&2; return 2 ;; esac
    [ "$FULL" = 1 ] && every=1
    [ "$every" -gt 1 ] && first=$(($(names | grep -nxF "$1" | cut -d: -f1) % every))
    return 0
}

# what keeps machine $1 from running here; empty if nothing does
missing() {
    for tool in "${cc%% *}" "${run%% *}"; do
        [ "$tool" = %s ] || command -v "$tool" >/dev/null 2>&1 || { echo "no $tool"; return; }
    done
    printf '#include <string.h>\nint main(void) { return 0; }\n' >"$d/try.c"
    # shellcheck disable=SC2086
    $cc $flags "$d/try.c" $extra -o "$d/try" >"$d/try.log" 2>&1 ||
        echo "${cc%% *} does not link a program: $(grep -m1 -iE 'error|cannot|not found' "$d/try.log" | cut -c1-120)"
}

# the lines of golden.csv that build $1 must give
expected() {
    awk -F, -v b="$1" -v every="$every" -v first="$first" '$1 == b {if (b ~ /^1/ || n == 0 || n % every == first) print; n++}' $golden
}

# builds the golden runner of build $2 for machine $1
compile() {
    objects=$d/obj/$2/tests/golden.o
    for f in sph/*.c; do objects="$objects $d/obj/$2/${f%.c}.o"; done
    double=0
    [ "${2#?}" = d ] && double=1
    # shellcheck disable=SC2086
    $MAKE --no-print-directory -s BUILD="$d" CC="$cc" OPT= CFLAGS="$flags -DGOLDEN_EVERY=$every -DGOLDEN_FIRST=$first" $objects &&
        $cc -std=c11 -ffp-contract=off $flags -I. -DSPH_DIM="${2%?}" -DSPH_DOUBLE=$double tests/golden_one.c $objects $extra \
            -o "$d/golden_$2"
}

# one build on one machine: a line of the table
one_build() {
    expected "$2" >"$d/$2.want"
    if ! compile "$1" "$2" >"$d/$2.log" 2>&1; then
        echo "$1|$version|$2|0|does not build, see $d/$2.log|-|0"
        return
    fi
    start=$(date +%s)
    # shellcheck disable=SC2059,SC2086
    $(printf "$run" "$d/golden_$2") >"$d/$2.got" 2>"$d/$2.log" </dev/null
    seconds=$(($(date +%s) - start))
    cases=$(wc -l <"$d/$2.want")
    base=$(awk -F, 'NR == 1 {print $3}' "$d/$2.got")
    if cmp -s "$d/$2.want" "$d/$2.got"; then
        echo "$1|$version|$2|$cases|equal|$base|$seconds"
    else
        where=$(diff "$d/$2.want" "$d/$2.got" | grep -m1 '^[<>]' | cut -d, -f2)
        echo "$1|$version|$2|$cases|differs from $where on; see $d/$2.got|${base:--}|$seconds"
    fi
}

# everything for machine $1; lines of the table go to $d/table
one_target() {
    read_target "$1" || return
    stamp="$cc|$flags|$every|$first"
    [ "$(cat "$d/stamp" 2>/dev/null)" = "$stamp" ] || rm -rf "${d:?}"
    mkdir -p "$d"
    rm -f "$d/table"
    echo "$stamp" >"$d/stamp"
    gone=$(missing "$1")
    if [ -n "$gone" ]; then
        echo "$1|-|-|0|left out: $gone; apt-get install --no-install-recommends $packages|-|0" >"$d/table"
        return
    fi
    version=$(basename "${cc%% *}" | sed 's/.*\(gcc\|clang\).*/\1/') version="$version $($cc -dumpfullversion 2>/dev/null || $cc -dumpversion)"
    for b in $builds; do
        one_build "$1" "$b" >>"$d/table"
    done
    echo "  $1 done" >&2
}

if [ "${1:-}" = --one ]; then
    one_target "$2"
    exit 0
fi

[ -f "$LIST" ] || { echo "targets.sh: no $LIST" >&2; exit 2; }
for n in "$@"; do
    names | grep -qxF "$n" || { echo "targets.sh: no machine '$n' in $LIST; there are:" $(names) >&2; exit 2; }
done
mkdir -p "$dir"
list=${*:-$(names)}
for n in $list; do read_target "$n" || exit 2; done
began=$(date +%s)
# shellcheck disable=SC2086
printf '%s\n' $list | xargs -P "$JOBS" -n 1 sh "$0" --one
for n in $list; do cat "$dir/$n/table"; done >"$dir/table"
awk -F'|' -v out="$BUILD/targets.csv" 'BEGIN {
    printf "  %-13s %-12s %-7s %-4s %-6s %-17s %5s  %s\n", "target", "compiler", "real", "dim", "scenes", "first case", "s", "hashes"
    print "name,value,unit,target,ok" >out
} {
    real = $3 ~ /d$/ ? "double" : $3 ~ /f$/ ? "float" : "-"
    printf "  %-13s %-12s %-7s %-4s %-6s %-17s %5s  %s\n", $1, $2, real, substr($3, 1, 1), $4, $6, $7, $5
    if ($5 ~ /^left out/) next
    ok = $5 == "equal" ? "yes" : "no"
    printf "%s_%s_equal,%d,%s,=%d,%s\n", $1, $3, ok == "yes" ? $4 : 0, "scenes (" $2 ")", $4, ok >out
    printf "%s_%s_first_case,%s,hash,,\n%s_%s_time,%s,s,,\n", $1, $3, $6, $1, $3, $7 >out
}' "$dir/table"
ran=$(grep -vc '|left out: ' "$dir/table") left=$(grep -c '|left out: ' "$dir/table")
bad=$(grep -v '|left out: ' "$dir/table" | grep -vc '|equal|')
echo "targets: $(echo $list | wc -w) machines, $left left out, $ran builds run, $bad differ, $(($(date +%s) - began)) s"
[ "$bad" -eq 0 ] && [ "$ran" -gt 0 ] && { [ "$STRICT" = 0 ] || [ "$left" -eq 0 ]; }
