#!/bin/sh
# SPDX-License-Identifier: MIT. Copyright the sph authors.
# targets.sh: the golden runs on every machine of port/targets.txt that this one has tools for: all six builds, every
# hash against tests/golden.csv. Installs nothing; says what is missing. Writes BUILD/targets.csv.
#   sh tests/targets.sh [NAME...]     these machines only (default: all)
#   sh tests/targets.sh --report [NAME...]   what the latest runs gave, without running anything
#   FULL=1      slow machines run all cases too          STRICT=1   a machine without tools counts as a failure
#   BUILDS="1f 2f"  these builds only                    JOBS=N     machines at once (default 2)
#   SHARE=3     two of the six builds on each machine, the next two on the next (for CI)
set -u
. tests/machines.sh
. tests/shares.sh
JOBS=${JOBS:-2} FULL=${FULL:-0} STRICT=${STRICT:-0}
golden=tests/golden.csv dir=$BUILD/targets
builds=${BUILDS:-1f 1d 2f 2d 3f 3d}
export FULL

# the lines of golden.csv that build $1 must give
expected() {
    awk -F, -v b="$1" -v every="$every" -v first="$first" '
        $1 == b {if (b ~ /^1/ || n == 0 || n % every == first) print; n++}' $golden
}

# build $2 on machine $1: a line of the table
one_build() {
    expected "$2" >"$d/$2.want"
    cases=$(wc -l <"$d/$2.want")
    if ! machine_link "$d" "$2" "$d/golden_$2" "tests/golden_one.c tests/golden.c" \
        "-DGOLDEN_EVERY=$every -DGOLDEN_FIRST=$first" >"$d/$2.log" 2>&1; then
        echo "$1|$version|$2|0|does not build, see $d/$2.log|-|0"
        return
    fi
    start=$(date +%s)
    machine_run "$d/golden_$2" >"$d/$2.got" 2>"$d/$2.log" </dev/null
    seconds=$(($(date +%s) - start))
    base=$(awk -F, 'NR == 1 {print $3}' "$d/$2.got")
    if cmp -s "$d/$2.want" "$d/$2.got"; then
        echo "$1|$version|$2|$cases|equal|$base|$seconds"
        return
    fi
    at=$(diff "$d/$2.want" "$d/$2.got" | grep -m1 '^[<>]' | cut -d, -f2)
    see="sh tests/firstdiff.sh $2 $at x86_64-gcc $1"
    echo "$1|$version|$2|$cases|first to differ: $at; see: $see|${base:--}|$seconds"
}

# everything for machine $1; lines of the table go to $d/table
one_machine() {
    read_machine "$1" || return
    d=$dir/$1 first=0
    [ "$FULL" = 1 ] && every=1
    [ "$every" -gt 1 ] && first=$(($(machine_names | grep -nxF "$1" | cut -d: -f1) % every))
    machine_directory "$d" "$cc|$flags"
    rm -f "$d/table"
    gone=$(machine_missing "$d")
    if [ -n "$gone" ]; then
        echo "$1|-|-|0|left out: $gone; apt-get install --no-install-recommends $packages|-|0" >"$d/table"
        return
    fi
    version=$(machine_version)
    # shellcheck disable=SC2086
    builds=$(share_of "$(machine_names | grep -nxF "$1" | cut -d: -f1)" $builds)
    for b in $builds; do
        one_build "$1" "$b" >>"$d/table"
    done
    echo "  $1 done" >&2
}

if [ "${1:-}" = --one ]; then
    one_machine "$2"
    exit
fi

only_report=0
[ "${1:-}" = --report ] && { only_report=1; shift; }
list=${*:-$(machine_names)}
# no machine goes out of the list unseen: those of the committed table must be in it
for n in $(sed -n 's/_1f_equal,.*//p' tests/results/targets.csv); do
    machine_names | grep -qxF "$n" ||
        { echo "targets.sh: $n of tests/results/targets.csv is not in $LIST" >&2; exit 1; }
done
for n in $list; do read_machine "$n" || exit 2; done
mkdir -p "$dir"
began=$(date +%s)
# shellcheck disable=SC2086
[ $only_report = 1 ] || printf '%s\n' $list | xargs -P "$JOBS" -n 1 sh "$0" --one
for n in $list; do cat "$dir/$n/table"; done >"$dir/table" || exit 1
awk -F'|' -v out="$BUILD/targets.csv" 'BEGIN {
    row = "  %-12s %-13s %-7s %-4s %-6s %-17s %5s  %s\n"
    printf row, "target", "compiler", "real", "dim", "scenes", "hash of the first", "s", "hashes"
    print "name,value,unit,target,ok" >out
} {
    printf row, $1, $2, $3 ~ /d$/ ? "double" : $3 ~ /f$/ ? "float" : "-", substr($3, 1, 1), $4, $6, $7, $5
    if ($5 ~ /^left out/) next
    ok = $5 == "equal" ? "yes" : "no"
    printf "%s_%s_equal,%d,scenes (%s),=%d,%s\n", $1, $3, ok == "yes" ? $4 : 0, $2, $4, ok >out
    printf "%s_%s_first_case,%s,hash,,\n%s_%s_time,%s,s,,\n", $1, $3, $6, $1, $3, $7 >out
}' "$dir/table"
ran=$(grep -vc '|left out: ' "$dir/table") left=$(grep -c '|left out: ' "$dir/table")
bad=$(grep -v '|left out: ' "$dir/table" | grep -vc '|equal|')
echo "targets: $(echo $list | wc -w) machines, $left left out; $ran builds run, $bad of them differ;" \
    "$(($(date +%s) - began)) s"
[ "$bad" -eq 0 ] && [ "$ran" -gt 0 ] && { [ "$STRICT" = 0 ] || [ "$left" -eq 0 ]; }
