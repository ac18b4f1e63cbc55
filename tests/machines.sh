# SPDX-License-Identifier: MIT. Copyright the sph authors.
# machines.sh: what the scripts share that build for the machines of port/targets.txt. Sourced, not run.
BUILD=${BUILD:-build} MAKE=${MAKE:-make} LIST=${LIST:-port/targets.txt}
export BUILD MAKE LIST

machine_rows() { sed '/^#/d; /^ *$/d' "$LIST"; }
machine_names() { machine_rows | awk -F'|' '{gsub(/ /, "", $1); print $1}'; }
# column $2 of machine $1, without blanks around it
machine_column() {
    machine_rows | awk -F'|' -v n="$1" -v k="$2" '
        {m = $1; gsub(/ /, "", m); if (m == n) {v = $k; gsub(/^ +| +$/, "", v); print v}}'
}

# sets packages, cc, flags, extra, run, every to the columns of machine $1
read_machine() {
    [ -f "$LIST" ] || { echo "$0: no $LIST" >&2; return 2; }
    machine_names | grep -qxF "$1" || { echo "$0: no machine '$1' in $LIST; allowed:" $(machine_names) >&2; return 2; }
    packages=$(machine_column "$1" 2) cc=$(machine_column "$1" 3) flags=$(machine_column "$1" 4)
    extra=$(machine_column "$1" 5) run=$(machine_column "$1" 6) every=$(machine_column "$1" 7)
    case $every in
    '' | *[!0-9]* | 0) echo "$0: $1 in $LIST: '$every' in column 7; allowed: a whole number from 1" >&2; return 2 ;;
    esac
    case $run in
    *%s*) ;;
    *) echo "$0: $1 in $LIST: '$run' in column 6; allowed: a command with %s for the program" >&2; return 2 ;;
    esac
}

# says what keeps the machine read last from running here, nothing if nothing does; $1 is a directory for a trial
machine_missing() {
    for tool in "${cc%% *}" "${run%% *}"; do
        [ "$tool" = %s ] || command -v "$tool" >/dev/null 2>&1 || { echo "no $tool"; return; }
    done
    mkdir -p "$1"
    printf '#include <string.h>\nint main(void) { return 0; }\n' >"$1/try.c"
    # shellcheck disable=SC2086
    $cc $flags "$1/try.c" $extra -o "$1/try" >"$1/try.log" 2>&1 ||
        echo "${cc%% *} does not link a program: $(grep -m1 -iE 'error|cannot|not found' "$1/try.log" | cut -c1-120)"
}

machine_version() {
    case $cc in *clang*) printf 'clang ' ;; *gcc*) printf 'gcc ' ;; esac
    $cc -dumpfullversion 2>/dev/null || $cc -dumpversion
}

# $1 directory, what was asked for: empties it if something else is in it than $2 says
machine_directory() {
    [ "$(cat "$1/stamp" 2>/dev/null)" = "$2" ] || rm -rf "${1:?}"
    mkdir -p "$1"
    echo "$2" >"$1/stamp"
}

# program $3 out of the kernel and the sources $4 (compiled with the defines $5) for build $2, made in directory $1;
# $6 are more flags for everything
machine_link() {
    objects= double=0 bits="-std=c11 -ffp-contract=off -fno-math-errno -fno-trapping-math"
    [ "${2#?}" = d ] && double=1
    case $cc in *clang*) ;; *) bits="$bits -fexcess-precision=fast" ;; esac
    for f in sph/*.c; do objects="$objects $1/obj/$2/${f%.c}.o"; done
    # shellcheck disable=SC2086
    $MAKE --no-print-directory -s BUILD="$1" CC="$cc" OPT= CFLAGS="$flags ${6:-}" $objects || return 1
    eval "$cc $bits $flags ${6:-} -I. -Itests -DSPH_DIM=${2%?} -DSPH_DOUBLE=$double ${5:-} $4 $objects $extra" -o '"$3"'
}

# runs program $1 with the arguments behind it, as the machine read last does
machine_run() {
    program=$1
    shift
    # shellcheck disable=SC2059,SC2046
    $(printf "$run" "$program") "$@"
}
