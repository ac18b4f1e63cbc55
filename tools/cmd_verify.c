/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* cmd_verify.c: sph verify. Are these files whole and sound dumps? */
#include "commands.h"
#include "dumpfile.h"
#include "host.h"

static const char help[] =
    "usage: sph verify DUMP...\n"
    "Checks dumps: magic, version, the checksum of every section and of the whole, sizes, ids once each, finite values,\n"
    "positions inside the domain. Prints a line for each file. Exit code 0: all are sound, 1: one is not, 2: wrong usage.\n";

int cmd_verify(int argc, char **argv)
{
    static const char *const known[] = {NULL};
    int result = HOST_FINE;
    host_command("verify");
    if (host_help(argc, argv, help))
        return HOST_FINE;
    int files = host_known_options(argc, argv, known);
    if (files < 0)
        return HOST_USAGE;
    if (files == 0)
        return host_usage("give at least one dump");
    for (int i = 1; i <= files; i++) {
        dump_file d;
        if (!dump_open(&d, argv[i])) {
            result = HOST_NO;
            continue;
        }
        if (dump_check(&d))
            printf("%s: fine, %s dump, %u-D %s, %u particles, step %llu, t = %.9g s\n", argv[i], d.full ? "full" : "reduced",
                   d.dim, d.real_bytes == 8 ? "double" : "float", d.n, (unsigned long long)d.step, d.time);
        else
            result = HOST_NO;
        dump_close(&d);
    }
    return result;
}
