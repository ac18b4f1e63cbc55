#!/bin/sh
# SPDX-License-Identifier: MIT. Copyright the sph authors.
# browser.sh: the page of examples/wasm in headless Chromium: the hash after 300 steps upright, and after 1500 more
# tilted by 25 degrees, equals that of the same scene compiled for this machine and the committed one; controls work;
# pictures of the page land in BUILD/browser. `--mint "reason"` rewrites tests/golden_tank.txt. Needs BUILD/wasm and
# BUILD/tank_host (make browser).
set -u
BUILD=${BUILD:-build} CHROMIUM=${CHROMIUM:-chromium} golden=tests/golden_tank.txt
n=300 degrees=25 m=1500
for tool in "$CHROMIUM chromium" "node nodejs"; do
    command -v "${tool% *}" >/dev/null 2>&1 ||
        { echo "browser: no ${tool% *}; apt-get install --no-install-recommends ${tool#* }" >&2; exit 1; }
done
mkdir -p "$BUILD/browser"
host=$("$BUILD/tank_host" $n $degrees $m 2>/dev/null | tr '\n' ' ') host=${host% }
if [ "${1:-}" = --mint ]; then
    [ -n "${2:-}" ] ||
        { echo "browser.sh: --mint needs a reason, in quotes: it goes into the header of $golden" >&2; exit 2; }
    {
        echo "# SPDX-License-Identifier: MIT. Copyright the sph authors."
        echo "# State hashes of examples/wasm/tank.c: after $n steps upright, after $m more at $degrees degrees."
        printf '# Reason of the latest change: %s\n%s\n' "$2" "$host"
    } >$golden
fi
want=$(sed '/^#/d' $golden)
page=$(node tests/browser.mjs "$CHROMIUM" "$BUILD/wasm/index.html" $n $degrees $m "$BUILD/browser") || exit 1
printf 'browser:   %s\nmachine:   %s\ncommitted: %s\n' "$page" "$host" "$want"
if [ "$page" != "$host" ] || [ "$page" != "$want" ]; then
    echo "browser: hashes differ"
    exit 1
fi
echo "browser: hashes equal"
