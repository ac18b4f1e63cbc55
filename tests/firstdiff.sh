#!/bin/sh
# SPDX-License-Identifier: MIT. Copyright the sph authors.
# firstdiff.sh: names the first step, pass, field and particle in which two ways to build and run a golden case differ.
#   sh tests/firstdiff.sh BUILD CASE WAY WAY      for example: 2f base x86_64-gcc s390x
# BUILD is 1f 1d 2f 2d 3f or 3d, CASE a name of tests/cases.h, a WAY a machine of port/targets.txt, after a colon with
# more flags:
#   sh tests/firstdiff.sh 2f base aarch64 'aarch64:-ffp-contract=fast -DSPH_NO_PROBE'
# Exit: 0 no difference, 1 a difference was found and named, 2 something is wrong.
set -u
. tests/machines.sh
if [ $# -ne 4 ]; then
    sed -n 's/^# //; 4,8p' "$0" >&2
    exit 2
fi
build=$1 case=$2
case $build in [123][fd]) ;; *) echo "firstdiff.sh: build '$build'; allowed: 1f 1d 2f 2d 3f 3d" >&2; exit 2 ;; esac
if ! grep -q "^1f,$case," tests/golden.csv; then
    echo "firstdiff.sh: case '$case'; allowed: the names in tests/golden.csv" >&2
    exit 2
fi

# output of the stage log compiled by way $2 with defines $3 into $dir/$1.$4
stage() {
    read_machine "${2%%:*}" || exit 2
    more=
    case $2 in *:*) more=${2#*:} ;; esac
    d=$dir/$1
    machine_directory "$d" "$cc|$flags|$more"
    gone=$(machine_missing "$d")
    [ -z "$gone" ] ||
        { echo "firstdiff.sh: ${2%%:*}: $gone; apt-get install --no-install-recommends $packages" >&2; exit 2; }
    if ! machine_link "$d" "$build" "$d/stagelog" tests/stagelog.c "$3" "$more" >"$d/log" 2>&1; then
        cat "$d/log" >&2
        exit 2
    fi
    machine_run "$d/stagelog" >"$dir/$1.$4" || { echo "firstdiff.sh: $2: $(tail -n 1 "$dir/$1.$4")" >&2; exit 2; }
}

dir=$BUILD/firstdiff
mkdir -p "$dir"
name="-DSTAGELOG_CASE='\"$case\"'"
stage a "$3" "$name" log
stage b "$4" "$name" log
first=$(diff "$dir/a.log" "$dir/b.log" | grep -m1 '^[<>]' | cut -c3-)
if [ -z "$first" ]; then
    echo "$build $case: no difference in $(wc -l <"$dir/a.log") hashes of fields"
    exit 0
fi
IFS=, read -r step pass stage field hash <<END
$first
END
values="$name -DSTAGELOG_STEP=$step -DSTAGELOG_PASS=$pass -DSTAGELOG_FIELD='\"$field\"'"
stage a "$3" "$values" values
stage b "$4" "$values" values
paste -d, "$dir/a.values" "$dir/b.values" |
    awk -F, -v at="$build $case: first difference in step $step, pass $pass ($stage), field $field" '
    $4 != $8 && (!n++ || $2 + 0 < id) {id = $2; index_ = $1; comp = $3; a = $4; b = $8}
    END {
        printf "%s, particle %s (component %d, index %d): %s and %s; %d of %d values differ\n", at, id, comp, index_,
            a, b, n, NR
        exit n == 0
    }' || { echo "firstdiff.sh: hashes of $field differ but no value does" >&2; exit 2; }
exit 1
