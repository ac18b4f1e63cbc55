#!/bin/sh
# SPDX-License-Identifier: MIT. Copyright the sph authors.
# need_cmocka.sh: makes sure that the tests' framework is there: looks for it, gets it with apt-get where that is
# allowed (root on a Debian-like system), and otherwise prints the one line that does.
have() {
    printf '#include <%s>\n' setjmp.h stdarg.h stddef.h stdint.h cmocka.h | sed '$s/$/\nint main(void){return 0;}/' |
        ${CC:-cc} -x c - -o /dev/null -lcmocka 2>/dev/null
}
line='apt-get install -y --no-install-recommends libcmocka-dev'
have && exit 0
if [ "$(id -u)" = 0 ] && command -v apt-get >/dev/null 2>&1; then
    echo "  getting cmocka"
    export DEBIAN_FRONTEND=noninteractive
    { $line || { apt-get update && $line; }; } >/dev/null 2>&1
    have && exit 0
fi
echo "make test needs cmocka; as root: $line" >&2
exit 1
