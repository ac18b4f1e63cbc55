#!/bin/sh
# SPDX-License-Identifier: MIT. Copyright the sph authors.
# need_cmocka.sh: makes sure that the tests' framework is there: looks for it, gets it with apt-get where that is allowed
# (root on a Debian-like system), and otherwise prints the one line that does.
have() {
    printf '#include <setjmp.h>\n#include <stdarg.h>\n#include <stddef.h>\n#include <stdint.h>\n#include <cmocka.h>\nint main(void){return 0;}\n' |
        ${CC:-cc} -x c - -o /dev/null -lcmocka 2>/dev/null
}
line='apt-get install -y --no-install-recommends libcmocka-dev'
have && exit 0
if [ "$(id -u)" = 0 ] && command -v apt-get >/dev/null 2>&1; then
    echo "  getting cmocka"
    { DEBIAN_FRONTEND=noninteractive $line || { apt-get update && DEBIAN_FRONTEND=noninteractive $line; }; } >/dev/null 2>&1
    have && exit 0
fi
echo "make test needs cmocka; as root: $line" >&2
exit 1
