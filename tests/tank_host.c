/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* tank_host.c: the tank of examples/wasm on this machine: N steps upright, then M steps tilted, the hash after each
   (browser.sh compares a browser's).   usage: tank_host N DEGREES M */
#include <stdio.h>
#include <stdlib.h>

#include "examples/wasm/tank.h"

static int run(long steps)
{
    int st = 0;
    while (!st && steps-- > 0)
        st = tank_step();
    printf("%08x%08x\n", tank_hash(1), tank_hash(0));
    return st;
}

int main(int argc, char **argv)
{
    if (argc != 4) {
        fprintf(stderr, "usage: tank_host N DEGREES M\n");
        return 2;
    }
    int st = tank_start();
    if (!st)
        st = run(atol(argv[1]));
    if (!st)
        st = tank_tilt(atoi(argv[2]));
    if (!st)
        st = run(atol(argv[3]));
    if (st)
        fprintf(stderr, "tank_host: %s\n", tank_text(st));
    fprintf(stderr, "%.4f s, %u of %u particles are water\n", tank_time(), tank_draw(), tank_particles());
    return st != 0;
}
