/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* main.c: the program `sph`: hands its arguments to a sub-command. */
#include <signal.h>
#include <stdio.h>
#include <string.h>

#include "build.h"
#include "commands.h"
#include "host.h"

static const struct command {
    const char *name, *what;
    int (*run)(int argc, char **argv);
} commands[] = {
    {"run", "run a scene", cmd_run},
    {"list", "the scenes and their parameters", cmd_list},
    {"info", "what a dump holds", cmd_info},
    {"verify", "check a dump's checksums and structure", cmd_verify},
    {"hash", "the hash of a dump", cmd_hash},
    {"diff", "where two dumps differ", cmd_diff},
    {"export", "a dump as a table or for ParaView", cmd_export},
    {"render", "a dump as a picture", cmd_render},
    {"history", "tables and figures from histories", cmd_history},
    {"dispersion", "waves on a lattice of particles against exact ones", cmd_dispersion},
    {"profile", "fields of a dump along a line or an ellipse", cmd_profile},
    {"fragments", "the pieces into which solids have broken", cmd_fragments},
    {"gradykipp", "sizes of fragments by Grady and Kipp's statistics", cmd_gradykipp},
    {"advise", "the cheapest known way to a wanted error", cmd_advise},
};
#define COMMANDS (sizeof commands / sizeof *commands)

static int help(void)
{
    printf("sph: smoothed particle hydrodynamics in fixed memory, with the same bits everywhere\n\n"
           "usage: sph COMMAND [arguments]     sph COMMAND --help says more\n\n");
    for (size_t i = 0; i < COMMANDS; i++)
        printf("  %-10s %s\n", commands[i].name, commands[i].what);
    printf("  %-10s this text, or that of a command\n", "help");
    printf("\nexit code: 0 fine; 1 no, differs, or failed; 2 wrong usage\n");
    return HOST_FINE;
}

static const struct command *find(const char *name)
{
    for (size_t i = 0; i < COMMANDS; i++)
        if (!strcmp(commands[i].name, name))
            return &commands[i];
    return NULL;
}

static int unknown(const char *name)
{
    const char *nearest = commands[0].name;
    uint32_t least = UINT32_MAX;
    for (size_t i = 0; i < COMMANDS; i++) {
        uint32_t d = build_distance(name, commands[i].name);
        if (d < least) {
            least = d;
            nearest = commands[i].name;
        }
    }
    return host_usage("no command %s; did you mean %s?", name, nearest);
}

int main(int argc, char **argv)
{
    signal(SIGXFSZ, SIG_IGN); /* a file that grows too large is a failed write, whose reason is said */
    if (argc < 2) {
        help();
        return HOST_USAGE;
    }
    const char *name = argv[1];
    if (!strcmp(name, "--version")) {
        printf("sph %u\n", SPH_VERSION);
        return host_end(HOST_FINE);
    }
    bool asks = !strcmp(name, "help") || !strcmp(name, "--help") || !strcmp(name, "-h");
    if (asks && argc == 2)
        return host_end(help());
    const struct command *c = find(asks ? argv[2] : name);
    if (!c)
        return unknown(asks ? argv[2] : name);
    host_command(c->name);
    if (asks) {
        char text[] = "--help", *arguments[] = {argv[2], text, NULL};
        return host_end(c->run(2, arguments));
    }
    return host_end(c->run(argc - 1, argv + 1));
}
