/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* posix.c: a pool of threads for passes of some ten microseconds (see posix.h).

   A job is published as a ticket: its number and the next chunk, in one word. Whoever takes a chunk does so by compare
   and exchange on that word, so a thread that comes late can only miss a job, never take part in the wrong one, and the
   caller waits for chunks under way but for nobody who sleeps. Idle threads look for work a short while, then
   sleep on a condition variable. */
#define _POSIX_C_SOURCE 200809L
#include "posix.h"

#include <sched.h>
#include <stdio.h>
#include <time.h>
#include <unistd.h>

#define SPINS 4000u          /* looks at the ticket before sleeping: some ten microseconds */
#define LOOKS 64u            /* looks before giving the processor away once */
#define CLOSED 0xffffffffu   /* the chunk number of a ticket that nobody may take from */

static uint64_t make_ticket(uint32_t job, uint32_t chunk) { return (uint64_t)job << 32 | chunk; }
static uint32_t ticket_job(uint64_t t) { return (uint32_t)(t >> 32); }

/* takes chunks of the present job until there are none; returns the ticket seen last */
static uint64_t work(port_posix *p, uint32_t thread)
{
    uint32_t made = 0;
    uint64_t t = atomic_load(&p->ticket);
    for (;;) {
        /* what is read here belongs to the job if the exchange succeeds: a new job closes the ticket first */
        port_posix_fn fn = atomic_load(&p->fn);
        void *arg = atomic_load(&p->arg);
        uint32_t chunk = (uint32_t)t, chunks = atomic_load(&p->chunks);
        if (chunk >= chunks)
            break;
        if (!atomic_compare_exchange_weak(&p->ticket, &t, t + 1))
            continue;
        fn(arg, chunk, thread);
        made++;
        t = t + 1;
    }
    if (made) /* until now the caller waited for these, so the job was still the same */
        atomic_fetch_add(&p->done, made);
    return t;
}

static void wait_for_job(port_posix *p, uint64_t seen)
{
    const uint32_t job = ticket_job(seen);
    for (uint32_t i = 1; i <= SPINS; i++) {
        if (ticket_job(atomic_load(&p->ticket)) != job || atomic_load(&p->stop))
            return;
        if (i % LOOKS == 0)
            sched_yield();
    }
    pthread_mutex_lock(&p->mutex);
    atomic_fetch_add(&p->sleepers, 1);
    while (ticket_job(atomic_load(&p->ticket)) == job && !atomic_load(&p->stop))
        pthread_cond_wait(&p->wake, &p->mutex);
    atomic_fetch_sub(&p->sleepers, 1);
    pthread_mutex_unlock(&p->mutex);
}

static void *run_worker(void *ctx)
{
    const port_posix_worker *w = ctx;
    while (!atomic_load(&w->pool->stop))
        wait_for_job(w->pool, work(w->pool, w->thread));
    return NULL;
}

static void wake_all(port_posix *p)
{
    pthread_mutex_lock(&p->mutex);
    pthread_cond_broadcast(&p->wake);
    pthread_mutex_unlock(&p->mutex);
}

void port_posix_parallel(void *ctx, port_posix_fn fn, void *arg, uint32_t chunks)
{
    port_posix *p = ctx;
    const uint32_t job = ticket_job(atomic_load(&p->ticket)) + 1;
    atomic_store(&p->ticket, make_ticket(job, CLOSED));
    atomic_store(&p->fn, fn);
    atomic_store(&p->arg, arg);
    atomic_store(&p->chunks, chunks);
    atomic_store(&p->done, 0);
    atomic_store(&p->ticket, make_ticket(job + 1, 0));
    if (atomic_load(&p->sleepers) > 0)
        wake_all(p);
    work(p, 0);
    for (uint32_t i = 1; atomic_load(&p->done) < chunks; i++)
        if (i % LOOKS == 0)
            sched_yield();
}

bool port_posix_open(port_posix *p, uint32_t threads)
{
    long processors = sysconf(_SC_NPROCESSORS_ONLN);
    if (threads == 0)
        threads = processors < 1 ? 1 : (uint32_t)processors;
    const uint32_t want = threads < PORT_POSIX_THREADS ? threads : PORT_POSIX_THREADS;
    p->threads = 1;
    atomic_init(&p->ticket, make_ticket(0, CLOSED));
    atomic_init(&p->fn, NULL);
    atomic_init(&p->arg, NULL);
    atomic_init(&p->chunks, 0);
    atomic_init(&p->done, 0);
    atomic_init(&p->sleepers, 0);
    atomic_init(&p->stop, false);
    pthread_mutex_init(&p->mutex, NULL);
    pthread_cond_init(&p->wake, NULL);
    for (uint32_t i = 1; i < want; i++) {
        p->worker[i].pool = p;
        p->worker[i].thread = i;
        if (pthread_create(&p->worker[i].id, NULL, run_worker, &p->worker[i]) == 0)
            p->threads++;
        else
            break;
    }
    return p->threads == threads;
}

void port_posix_close(port_posix *p)
{
    atomic_store(&p->stop, true);
    wake_all(p);
    for (uint32_t i = 1; i < p->threads; i++)
        pthread_join(p->worker[i].id, NULL);
    pthread_cond_destroy(&p->wake);
    pthread_mutex_destroy(&p->mutex);
    p->threads = 1;
}

uint64_t port_posix_clock(void *ctx)
{
    struct timespec t;
    (void)ctx;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (uint64_t)t.tv_sec * 1000000000u + (uint64_t)t.tv_nsec;
}

bool port_posix_sink(void *file, const void *bytes, size_t n) { return fwrite(bytes, 1, n, file) == n; }
bool port_posix_source(void *file, void *bytes, size_t n) { return fread(bytes, 1, n, file) == n; }
