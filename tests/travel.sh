#!/bin/sh
# SPDX-License-Identifier: MIT. Copyright the sph authors.
# travel.sh: dumps go from other machines to this one and back. Half of a case runs on one, the rest on the other; the
# hash must be that of tests/golden.csv, which no dump interrupted, and both must write the same bytes. Big-endian,
# 32-bit, all six builds; cases with books, walls that move, a gate and Runge-Kutta. Writes BUILD/travel.csv.
#   sh tests/travel.sh [NAME...]      machines of port/targets.txt (default: s390x ppc64 i686 armhf)
#   STRICT=1    a machine without tools counts as a failure           BUILDS="1f 2f"   these builds only
set -u
. tests/machines.sh
STRICT=${STRICT:-0} home=x86_64-gcc
cases="moving_wall moving_ghost runge_kutta_momentum gate"
list=${*:-s390x ppc64 i686 armhf}
dir=$BUILD/travel bad=0 left=0 trips=0
mkdir -p "$dir"
echo "name,value,unit,target,ok" >"$BUILD/travel.csv"

# the program of build $2 for machine $1
prepare() {
    read_machine "$1" || exit 2
    d=$BUILD/targets/$1
    machine_directory "$d" "$cc|$flags"
    gone=$(machine_missing "$d")
    if [ -n "$gone" ]; then
        echo "  $1: left out: $gone; apt-get install --no-install-recommends $packages"
        return 1
    fi
    machine_link "$d" "$2" "$d/travel_$2" tests/travel.c >"$d/travel.log" 2>&1 && return 0
    echo "  $1 $2: does not build, see $d/travel.log"
    return 1
}
# travel with the arguments behind it, on machine $1, build $2
on() {
    read_machine "$1" || exit 2
    program_=$BUILD/targets/$1/travel_$2
    shift 2
    machine_run "$program_" "$@"
}

# there and back for machine $1, build $2, case $3: the number of trips that went wrong
trips_of() {
    wrong=0 want=$(awk -F, -v b="$2" -v c="$3" '$1 == b && $2 == c {print $3}' tests/golden.csv)
    on $home "$2" write "$3" "$dir/home.dump" && on "$1" "$2" write "$3" "$dir/$1.dump" || return 9
    got=$(on $home "$2" resume "$3" "$dir/$1.dump")
    [ "$got" = "$want" ] || { wrong=1; echo "  $1 $2 $3: written there, gone on here: $got, not $want" >&2; }
    got=$(on "$1" "$2" resume "$3" "$dir/home.dump")
    [ "$got" = "$want" ] ||
        { wrong=$((wrong + 1)); echo "  $1 $2 $3: written here, gone on there: $got, not $want" >&2; }
    cmp "$dir/home.dump" "$dir/$1.dump" >&2 || wrong=$((wrong + 1))
    return $wrong
}

for m in $list; do
    for b in ${BUILDS:-1f 1d 2f 2d 3f 3d}; do
        if ! prepare $home $b || ! prepare "$m" $b; then
            left=$((left + 1))
            break
        fi
        fine=0
        for c in $cases; do
            trips=$((trips + 1))
            if trips_of "$m" $b "$c"; then fine=$((fine + 1)); else bad=$((bad + 1)); fi
        done
        n=$(echo $cases | wc -w)
        [ $fine -eq "$n" ] && ok=yes || ok=no
        echo "${m}_${b}_there_and_back,$fine,cases,=$n,$ok" >>"$BUILD/travel.csv"
    done
done
rm -f "$dir"/*.dump
sh tests/table.sh "$BUILD/travel.csv" || [ $trips -eq 0 ] || bad=$((bad + (bad == 0)))
echo "travel: $trips cases there and back, $bad went wrong, $left machines left out"
[ $bad -eq 0 ] && [ $trips -gt 0 ] && { [ "$STRICT" = 0 ] || [ $left -eq 0 ]; }
