/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* host.h: what every sub-command needs from the machine: messages, arguments name=value, files that are read. Those
   that are written: output.h. */
#ifndef HOST_H
#define HOST_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#if defined(__GNUC__)
#define HOST_PRINTF(a, b) __attribute__((format(printf, a, b)))
#else
#define HOST_PRINTF(a, b)
#endif

enum { HOST_FINE = 0, HOST_NO = 1, HOST_USAGE = 2 }; /* exit codes */

/* Prints "sph COMMAND: message" and a newline to stderr. The first returns HOST_NO, the second HOST_USAGE (and says
   where help is). host_command sets the name that messages carry. */
void host_command(const char *name);
int host_no(const char *format, ...) HOST_PRINTF(1, 2);
/* the exit code of a command that ends with `code`: HOST_NO after a message if standard output could not be written */
int host_end(int code);
int host_usage(const char *format, ...) HOST_PRINTF(1, 2);

/* true if an argument is --help or -h; then `text` was printed to stdout */
bool host_help(int argc, char **argv, const char *text);

/* Numbers: the whole text must be one, finite, and inside the range; else a message and false. `name` is for the
 * message. */
bool host_number(const char *name, const char *text, double min, double max, double *out);
bool host_count(const char *name, const char *text, uint64_t min, uint64_t max, uint64_t *out);
/* n numbers separated by commas */
bool host_numbers(const char *name, const char *text, uint32_t n, double *out);

/* Arguments NAME=VALUE. An option is found in argv[1..]; unknown names are refused by host_known_options, which also
   gathers what is not NAME=VALUE (files) into argv[1..] in order and returns how many there are, or -1 after a message.
   known: null-terminated list of names. Options stay behind the files, and host_option finds them there. An argument
   whose text before '=' has a '/' or '.' is a file. A name that is given twice is refused. */
int host_known_options(int argc, char **argv, const char *const *known);
/* True after a message if an argument before argv[i] is NAME=... too: which of the two was meant is not guessed. */
bool host_given_before(char **argv, int i, const char *name);
const char *host_option(int argc, char **argv, const char *name); /* the value, or null */
/* splits "name=value" in place of its '='; false if there is none. name is copied (at most size - 1 bytes) */
bool host_split(const char *arg, char *name, size_t size, const char **value);
/* index of text in a null-terminated list of names; a message that lists them and -1 if it is not there */
int host_choice(const char *name, const char *text, const char *const *choices);

/* a name, or another text from outside, inside a line of a file: control characters as ? */
void host_put_name(FILE *f, const char *name);

/* the whole of a file ("-": stdin) in memory from malloc, with a zero byte behind it; null after a message */
unsigned char *host_read(const char *name, size_t *size);
/* malloc and realloc that end the program with a message when there is no memory */
void *host_alloc(size_t bytes);
void *host_realloc(void *p, size_t bytes);

#endif
