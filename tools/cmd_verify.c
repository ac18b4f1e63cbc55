/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* cmd_verify.c: sph verify. Are these files whole and sound dumps? */
#include "commands.h"
#include "dumpfile.h"
#include "host.h"

static const char help[] =
    "usage: sph verify DUMP...\n"
    "Checks dumps: magic, version, the checksum of every section and of the whole, sizes, ids once each, finite\n"
    "values, positions inside the domain. Prints a line for each file. Exit code 0: all are sound, 1: one is not,\n"
    "2: wrong usage.\n";

static bool verify_one(const dump_file *d, const char *name)
{
    if (!dump_check(d))
        return false;
    printf("%s: fine, %s dump, %u-D %s, %u particles, step %llu, t = %.9g %s\n", name, d->full ? "full" : "reduced",
           d->dim,
           d->real_bytes == 8 ? "double" : "float", d->n, (unsigned long long)d->step, d->time,
           dump_unit(d, "s"));
    return true;
}

int cmd_verify(int argc, char **argv) { return dump_each(argc, argv, "verify", help, verify_one); }
