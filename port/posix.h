/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* posix.h: what a POSIX machine provides to the kernel: a pool of threads, a clock, files as sinks and sources of
   dumps.

   It knows nothing of sph.h, whose types differ by build: one object serves all six builds, and several simulations.

       port_posix pool;
       port_posix_open(&pool, 4);
       cfg.max_threads = pool.threads;
       cfg.port = (sph_port)PORT_POSIX(&pool);
       ... steps, all called from one thread at a time ...
       port_posix_close(&pool);

   The pool decides who computes a chunk, never what: chunks are taken from a counter in any order. */
#ifndef PORT_POSIX_H
#define PORT_POSIX_H

#include <pthread.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define PORT_POSIX_THREADS 256u

typedef void (*port_posix_fn)(void *arg, uint32_t chunk, uint32_t thread);

typedef struct port_posix port_posix;
typedef struct port_posix_worker {
    port_posix *pool;
    uint32_t thread;
    pthread_t id;
} port_posix_worker;

/* Members are the pool's own, but for `threads`. It must not be moved while it is open. */
struct port_posix {
    uint32_t threads;         /* that compute, the caller included */
    _Atomic(uint64_t) ticket; /* job number * 2^32 + next chunk; the chunk is past every end while a job is prepared */
    _Atomic(port_posix_fn) fn;
    _Atomic(void *) arg;
    _Atomic(uint32_t) chunks, done, sleepers;
    atomic_bool stop;
    pthread_mutex_t mutex;
    pthread_cond_t wake;
    port_posix_worker worker[PORT_POSIX_THREADS];
};

/* Starts threads - 1 threads (threads 0: as many as the machine has processors). False if the machine does not give so
   many; then the pool has those it gave (`threads`), and can be used all the same. */
bool port_posix_open(port_posix *p, uint32_t threads);
void port_posix_close(port_posix *p);

/* members of sph_port; ctx is the pool (the clock's may be null) */
void port_posix_parallel(void *ctx, port_posix_fn fn, void *arg, uint32_t chunks);
uint64_t port_posix_clock(void *ctx); /* ns, monotonic */
#define PORT_POSIX(pool) {(pool), (pool)->threads, port_posix_parallel, port_posix_clock, NULL}

/* sph_sink and sph_source; ctx is a FILE * */
bool port_posix_sink(void *file, const void *bytes, size_t n);
bool port_posix_source(void *file, void *bytes, size_t n);

#endif
