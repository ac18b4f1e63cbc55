# SPDX-License-Identifier: MIT. Copyright the sph authors.
# shares.sh: a check that goes through many ways takes a share of the builds in each where time is short (CI), so that
# all builds are met, if not in every way. Sourced, not run.

# of the builds (arguments from the second on) those of way number $1: all, or every SHARE-th
share_of() {
    printf '%s\n' "$@" | awk -v n="${SHARE:-1}" 'NR == 1 {k = $1; next} (NR + k) % n == 0 {printf "%s ", $1}'
}
