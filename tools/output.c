/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* output.c: files that the tool writes (see output.h). */
#define _XOPEN_SOURCE 700 /* realpath */
#include "output.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "host.h"

enum { MOST_LINKS = 40, MOST_NAMES = 10000, PIECE = 1 << 20 };

static output *all; /* that are open */

/* ---- signals: a program that is ended leaves no files beside those that were asked for ---- */

static const int ends[] = {SIGINT, SIGTERM, SIGHUP, SIGPIPE};

static void remove_and_end(int number)
{
    for (const output *o = all; o; o = o->next)
        if (o->tmp)
            unlink(o->tmp);
    signal(number, SIG_DFL);
    raise(number);
}

/* once, where nobody else takes the signal */
static void catch_ends(void)
{
    static bool done;
    struct sigaction now, own;
    memset(&own, 0, sizeof own);
    own.sa_handler = remove_and_end;
    for (size_t k = 0; k < sizeof ends / sizeof *ends && !done; k++)
        if (!sigaction(ends[k], NULL, &now) && now.sa_handler == SIG_DFL)
            sigaction(ends[k], &own, NULL);
    done = true;
}

/* while the list and its names change, a signal waits */
static sigset_t hold(void)
{
    sigset_t some, before;
    sigemptyset(&some);
    for (size_t k = 0; k < sizeof ends / sizeof *ends; k++)
        sigaddset(&some, ends[k]);
    sigprocmask(SIG_BLOCK, &some, &before);
    return before;
}
static void release(const sigset_t *before)
{
    const int reason = errno;
    sigprocmask(SIG_SETMASK, before, NULL);
    errno = reason;
}

static bool say(const output *o, int reason)
{
    host_no("cannot write %s%s%s: %s", *o->option ? o->option : "", *o->option ? "=" : "", o->name, strerror(reason));
    return false;
}

/* the first failure stays and is said; what comes after it is not written */
static bool fail(output *o, int reason)
{
    if (!o->failed)
        say(o, reason);
    o->failed = true;
    return false;
}

/* ---- names ---- */

static char *copy(const char *text, size_t n)
{
    char *s = host_alloc(n + 1);
    memcpy(s, text, n);
    s[n] = '\0';
    return s;
}

/* folder and last part of a path */
static char *folder_of(const char *path)
{
    const char *slash = strrchr(path, '/');
    return !slash ? copy(".", 1) : copy(path, slash == path ? 1 : (size_t)(slash - path));
}
static const char *base_of(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}
static char *join(const char *folder, const char *base)
{
    const size_t room = strlen(folder) + strlen(base) + 2;
    char *s = host_alloc(room);
    snprintf(s, room, "%s%s%s", folder, strcmp(folder, "/") ? "/" : "", base);
    return s;
}

/* what a link points to, null if path is none */
static char *linked(const char *path)
{
    char to[4096];
    const ssize_t n = readlink(path, to, sizeof to - 1);
    if (n <= 0)
        return NULL;
    to[n] = '\0';
    if (*to == '/')
        return copy(to, (size_t)n);
    char *folder = folder_of(path), *s = join(folder, to);
    free(folder);
    return s;
}

/* the file behind links, in a folder of one name only; null and errno */
static char *resolve(const char *name)
{
    char *path = copy(name, strlen(name)), *to;
    for (int k = 0; (to = linked(path)); k++) {
        free(path);
        path = to;
        if (k == MOST_LINKS) {
            free(path);
            errno = ELOOP;
            return NULL;
        }
    }
    char *folder = folder_of(path), *real = realpath(folder, NULL), *whole = real ? join(real, base_of(path)) : NULL;
    const int reason = errno;
    free(folder);
    free(real);
    free(path);
    errno = reason;
    return whole;
}

/* ---- opening ---- */

/* a new file beside path; its descriptor */
static int open_beside(output *o, mode_t mode)
{
    static unsigned number;
    char *folder = folder_of(o->path), base[64];
    int fd = -1;
    const sigset_t before = hold();
    for (int k = 0; fd < 0 && k < MOST_NAMES; k++) {
        snprintf(base, sizeof base, ".sph-%ld-%u.tmp", (long)getpid(), number++);
        free(o->tmp);
        o->tmp = join(folder, base);
        fd = open(o->tmp, O_WRONLY | O_CREAT | O_EXCL, 0666);
        if (fd < 0 && errno != EEXIST)
            break;
    }
    const int reason = errno;
    if (fd < 0) { /* the last name is not ours */
        free(o->tmp);
        o->tmp = NULL;
    }
    errno = reason;
    release(&before);
    if (fd >= 0 && mode && fchmod(fd, mode))
        (void)errno; /* another one's file: it keeps the mode that new files have */
    free(folder);
    errno = reason;
    return fd;
}

/* A device or a pipe, or what is reached through /dev, as /dev/stdout is: another one may have it open and wait. */
static bool is_device(const char *name, const struct stat *s, bool there)
{
    char *path = copy(name, strlen(name)), *to;
    bool device = there && !S_ISREG(s->st_mode) && !S_ISDIR(s->st_mode);
    for (int k = 0; path && k < MOST_LINKS; k++, path = to) {
        device = device || !strncmp(path, "/dev/", 5);
        to = linked(path);
        free(path);
    }
    free(path);
    return device;
}

static bool open_file(output *o, const struct stat *s, bool there)
{
    if (there && S_ISDIR(s->st_mode))
        return say(o, EISDIR);
    if (there && access(o->name, W_OK))
        return say(o, errno);
    if (!*base_of(o->name))
        return say(o, EISDIR);
    o->path = resolve(o->name);
    if (!o->path)
        return say(o, errno);
    for (const output *p = all; p; p = p->next)
        if (p != o && p->path && !strcmp(p->path, o->path)) {
            host_usage("%s=%s and %s=%s are the same file", p->option, p->name, o->option, o->name);
            return false;
        }
    o->fd = open_beside(o, there ? s->st_mode & 07777 : 0);
    return o->fd >= 0 || say(o, errno);
}

static void forget(output *o)
{
    const sigset_t before = hold();
    for (output **p = &all; *p; p = &(*p)->next)
        if (*p == o) {
            *p = o->next;
            break;
        }
    free(o->path);
    free(o->tmp);
    if (o->f)
        fclose(o->f);
    free(o->text);
    memset(o, 0, sizeof *o);
    o->fd = -1;
    release(&before);
}

static bool gather(output *o)
{
    o->f = open_memstream(&o->text, &o->size);
    return o->f || fail(o, errno);
}

/* into the list, so that its file can be removed whatever comes */
static void enlist(output *o)
{
    const sigset_t before = hold();
    catch_ends();
    o->next = all;
    all = o;
    release(&before);
}

/* Standard output by another name shares its place in the file, so that neither writes over the other. */
static int open_device(const char *name, const struct stat *s, bool there)
{
    struct stat out;
    if (there && !fstat(STDOUT_FILENO, &out) && out.st_dev == s->st_dev && out.st_ino == s->st_ino) {
        fflush(stdout);
        return dup(STDOUT_FILENO);
    }
    return open(name, O_WRONLY | O_NOCTTY);
}

bool output_open(output *o, const char *option, const char *name)
{
    struct stat s;
    memset(o, 0, sizeof *o);
    o->option = option;
    o->name = name;
    o->fd = -1;
    enlist(o);
    const bool there = stat(name, &s) == 0;
    bool fine;
    if (is_device(name, &s, there)) {
        o->fd = open_device(name, &s, there);
        fine = o->fd >= 0 || say(o, errno);
    } else
        fine = open_file(o, &s, there);
    if (fine && gather(o))
        return true;
    if (o->fd >= 0)
        close(o->fd);
    if (o->tmp)
        unlink(o->tmp);
    forget(o);
    return false;
}

void output_standard(output *o)
{
    memset(o, 0, sizeof *o);
    o->option = "";
    o->name = "standard output";
    o->fd = STDOUT_FILENO;
    enlist(o);
    fflush(stdout);
    gather(o);
}

bool output_is_file(const output *o) { return o->path != NULL; }

/* ---- writing ---- */

static bool write_all(output *o, const char *p, size_t n)
{
    while (n) {
        const ssize_t m = write(o->fd, p, n);
        if (m < 0 && errno == EINTR)
            continue;
        if (m <= 0)
            return false;
        p += m;
        n -= (size_t)m;
    }
    return true;
}

bool output_flush(output *o)
{
    if (o->failed)
        return false;
    errno = 0;
    if (!o->f || fflush(o->f) || ferror(o->f))
        return fail(o, errno ? errno : ENOMEM);
    if (!write_all(o, o->text, o->size)) {
        const int reason = errno;
        if (o->path && (ftruncate(o->fd, (off_t)o->good) || lseek(o->fd, (off_t)o->good, SEEK_SET) < 0))
            host_no("%s: its last piece is not whole: %s", o->name, strerror(errno));
        return fail(o, reason);
    }
    o->good += (long long)o->size;
    rewind(o->f);
    return true;
}

bool output_sink(void *ctx, const void *bytes, size_t n)
{
    output *o = ctx;
    if (fwrite(bytes, 1, n, o->f) != n)
        return fail(o, errno ? errno : ENOMEM);
    return ftell(o->f) < PIECE || output_flush(o);
}

static bool rename_now(output *o)
{
    const sigset_t before = hold();
    const bool fine = rename(o->tmp, o->path) == 0;
    if (fine) {
        free(o->tmp);
        o->tmp = NULL;
    }
    release(&before);
    return fine || fail(o, errno);
}

bool output_begin(output *o)
{
    if (!o->tmp || o->grows)
        return !o->failed;
    o->grows = true;
    return output_flush(o) && rename_now(o);
}

/* ---- the end ---- */

bool output_ready(output *o)
{
    if (o->ready || !o->f)
        return !o->failed;
    output_flush(o);
    fclose(o->f); /* of the memory only */
    o->f = NULL;
    free(o->text);
    o->text = NULL;
    if (o->fd > STDERR_FILENO && close(o->fd))
        fail(o, errno);
    o->fd = -1;
    o->ready = true;
    return !o->failed;
}

bool output_put(output *o)
{
    const bool fine = output_ready(o) && (!o->tmp || rename_now(o));
    if (o->tmp)
        unlink(o->tmp);
    forget(o);
    return fine;
}

bool output_close(output *o, bool keep)
{
    if (!o->f && !o->ready)
        return true;
    if (keep || o->grows || !o->path)
        return output_put(o) || !keep;
    o->failed = true; /* nothing is written any more */
    output_put(o);
    return true;
}

bool output_close_all(output *o, size_t n, bool keep)
{
    bool fine = true;
    for (size_t k = 0; k < n && keep; k++)
        if (o[k].f)
            fine = output_ready(&o[k]) && fine;
    for (size_t k = 0; k < n; k++)
        fine = output_close(&o[k], keep && fine) && fine;
    return fine;
}
