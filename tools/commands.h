/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* commands.h: the sub-commands of the program `sph`, one file cmd_NAME.c each.

   argv[0] is the sub-command's name. Returns the exit code: 0 fine, 1 the answer is "no", "differs" or "failed",
   2 wrong usage. Every one answers --help. */
#ifndef COMMANDS_H
#define COMMANDS_H

int cmd_run(int argc, char **argv);
int cmd_list(int argc, char **argv);
int cmd_info(int argc, char **argv);
int cmd_verify(int argc, char **argv);
int cmd_hash(int argc, char **argv);
int cmd_diff(int argc, char **argv);
int cmd_export(int argc, char **argv);
int cmd_render(int argc, char **argv);
int cmd_history(int argc, char **argv);
int cmd_dispersion(int argc, char **argv);
int cmd_profile(int argc, char **argv);
int cmd_fragments(int argc, char **argv);
int cmd_gradykipp(int argc, char **argv);
int cmd_advise(int argc, char **argv);

#endif
