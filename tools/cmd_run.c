/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* cmd_run.c: `sph run`, which steps a scene and writes its history, dumps and a report.

   Rows and dumps are taken after the first step that reaches their time, so that what is written, and how often, never
   changes the steps: the hash at the end depends on the scene, its parameters, the precision and the end only. */
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "../port/posix.h"
#include "build.h"
#include "calibrate.h"
#include "commands.h"
#include "host.h"

static const char help[] =
    "sph run SCENE [name=value ...]\n"
    "\n"
    "  any parameter of the scene (sph list SCENE), and\n"
    "  precision=float|double  float unless given\n"
    "  threads=N               1 unless given; 0: as many as there are processors; the bits do not change\n"
    "  end=SECONDS             the scene's own end unless given\n"
    "  steps=N                 stop after so many steps\n"
    "  every=SECONDS           a row of history (and a dump) so often, or\n"
    "  frames=N                so many in all; 20 unless given\n"
    "  out=PREFIX              write PREFIX.csv and dumps PREFIX_0000.sph ...; without it the history goes to\n"
    "                          standard output and nothing is written\n"
    "  dump=full|picture|none  what dumps hold; picture (position, velocity, density, pressure) unless given\n"
    "  restore=FILE            go on from a full dump of the same scene and parameters\n"
    "  cost=FILE               write a table of what the run cost: steps, pairs, seconds\n"
    "  stage_log=FILE          a hash after every pass of every step, to find where two machines part\n"
    "  hash                    print nothing but the hash of the last state to standard output\n"
    "\n"
    "^C ends the run after the step, with a full dump that restore= takes. A step that fails leaves the state before\n"
    "it, which goes into a full dump; exit code 1.\n";

enum { DUMP_FULL, DUMP_PICTURE, DUMP_NONE };
enum { MOST_PARAMS = 128, MOST_COLUMNS = 64, FRAMES = 20 };

typedef struct run {
    const build *b;
    build_scene scene;
    uint32_t index;
    double p[MOST_PARAMS];
    build_sim *sim;
    port_posix pool;
    bool has_pool;

    /* options; text is null where the option was not given */
    bool is_double, hash;
    uint64_t threads, steps, frames;
    double end, every;
    uint32_t dump;
    const char *prefix, *out, *restore, *stage_name, *cost;

    host_file history, stage, costs;
    FILE *rows; /* null: no history */
    uint64_t frame, first_step, limit_steps[SPH_LIMITS], particle_steps, pairs;
    double first_time;
    uint64_t began, stepping, last_line; /* ns */
} run;

static volatile sig_atomic_t interrupted;
static void interrupt(int signal)
{
    (void)signal;
    interrupted = 1;
}

/* ---- arguments ---- */

static const char *const option_names[] = {"precision", "threads", "end",     "steps",     "every", "frames",
                                           "out",       "dump",    "restore", "stage_log", "cost", NULL};

static int unknown_name(const run *r, const char *name)
{
    const char *nearest = option_names[0];
    uint32_t least = UINT32_MAX;
    for (uint32_t i = 0; i < r->scene.params; i++) {
        uint32_t d = build_distance(name, r->scene.param[i].name);
        if (d < least) {
            least = d;
            nearest = r->scene.param[i].name;
        }
    }
    for (uint32_t i = 0; option_names[i]; i++) {
        uint32_t d = build_distance(name, option_names[i]);
        if (d < least) {
            least = d;
            nearest = option_names[i];
        }
    }
    return host_usage("%s has no parameter %s; did you mean %s? (sph list %s)", r->scene.name, name, nearest,
                      r->scene.name);
}

/* one option other than precision; HOST_FINE, or HOST_USAGE after a message */
static int take_option(run *r, uint32_t option, const char *value)
{
    static const char *const kinds[] = {"full", "picture", "none", NULL};
    int kind;
    bool fine = true;
    switch (option) {
    case 0: break; /* was looked at first, because it chooses the build */
    case 1: fine = host_count("threads", value, 0, PORT_POSIX_THREADS, &r->threads); break;
    case 2: fine = host_number("end", value, 0, 1e300, &r->end); break;
    case 3: fine = host_count("steps", value, 0, UINT64_MAX, &r->steps); break;
    case 4: fine = host_number("every", value, 1e-300, 1e300, &r->every); break;
    case 5: fine = host_count("frames", value, 1, 1000000, &r->frames); break;
    case 6: r->out = r->prefix = value; break;
    case 7:
        kind = host_choice("dump", value, kinds);
        fine = kind >= 0;
        r->dump = fine ? (uint32_t)kind : DUMP_NONE;
        break;
    case 8: r->restore = value; break;
    case 9: r->stage_name = value; break;
    default: r->cost = value; break;
    }
    if ((option == 6 || option >= 8) && *value == '\0')
        return host_usage("%s= needs the name of a file", option_names[option]);
    return fine ? HOST_FINE : HOST_USAGE;
}

static int take_argument(run *r, const char *arg)
{
    char name[64];
    const char *value;
    uint32_t option = 0;
    if (!strcmp(arg, "hash")) {
        r->hash = true;
        return HOST_FINE;
    }
    if (!host_split(arg, name, sizeof name, &value))
        return host_usage("%s: arguments are written name=value", arg);
    while (option_names[option] && strcmp(option_names[option], name))
        option++;
    if (option_names[option])
        return take_option(r, option, value);
    int param = build_find_param(&r->scene, name);
    if (param < 0)
        return unknown_name(r, name);
    return build_parse_param(&r->scene.param[param], value, &r->p[param]) ? HOST_FINE : HOST_USAGE;
}

static int take_arguments(run *r, int argc, char **argv)
{
    static const char *const precisions[] = {"float", "double", NULL};
    if (argc < 2)
        return host_usage("which scene? (sph list shows them)");
    for (int i = 2; i < argc; i++)
        if (!strncmp(argv[i], "precision=", 10)) {
            int choice = host_choice("precision", argv[i] + 10, precisions);
            if (choice < 0)
                return HOST_USAGE;
            r->is_double = choice == 1;
        }
    if (!(r->b = build_find_scene(argv[1], r->is_double, &r->index, &r->scene)))
        return HOST_USAGE;
    if (r->scene.params > MOST_PARAMS || r->scene.columns > MOST_COLUMNS)
        return host_no("scene %s has more parameters or columns than the program holds", r->scene.name);
    for (uint32_t i = 0; i < r->scene.params; i++)
        r->p[i] = r->scene.param[i].value;
    r->prefix = r->scene.name;
    r->threads = 1;
    r->dump = DUMP_PICTURE;
    r->end = -1;
    for (int i = 2; i < argc; i++) {
        int code = take_argument(r, argv[i]);
        if (code)
            return code;
    }
    if (r->every > 0 && r->frames > 0)
        return host_usage("every= and frames= say the same thing; give one");
    return HOST_FINE;
}

/* ---- files ---- */

static bool write_dump(run *r, const char *name, uint32_t fields)
{
    host_file f;
    if (!host_create(&f, name))
        return false;
    sph_status st = r->b->dump(r->sim, fields, port_posix_sink, f.f);
    if (st)
        host_no("dump %s: %s", name, sph_status_text(st));
    return host_finish(&f, st == SPH_OK);
}

/* PREFIX_what.sph; prints its name */
static bool write_full_dump(run *r, const char *what)
{
    size_t size = strlen(r->prefix) + strlen(what) + 8;
    char *name = host_alloc(size);
    snprintf(name, size, "%s_%s.sph", r->prefix, what);
    bool fine = write_dump(r, name, SPH_DUMP_FULL);
    if (fine)
        fprintf(stderr, "the state is in %s; go on with restore=%s\n", name, name);
    free(name);
    return fine;
}

static bool write_frame(run *r)
{
    double row[MOST_COLUMNS];
    bool fine = true;
    if (r->rows) {
        r->b->history(r->sim, row);
        for (uint32_t i = 0; i < r->scene.columns; i++)
            fprintf(r->rows, "%s%.10g", i ? "," : "", row[i]);
        fputc('\n', r->rows);
    }
    if (r->out && r->dump != DUMP_NONE) {
        size_t size = strlen(r->out) + 32;
        char *name = host_alloc(size);
        snprintf(name, size, "%s_%04llu.sph", r->out, (unsigned long long)r->frame);
        fine = write_dump(r, name, r->dump == DUMP_FULL ? SPH_DUMP_FULL : SPH_DUMP_PICTURE);
        free(name);
    }
    return fine;
}

static bool open_history(run *r)
{
    if (r->out) {
        size_t size = strlen(r->out) + 8;
        char *name = host_alloc(size);
        snprintf(name, size, "%s.csv", r->out);
        bool fine = host_create(&r->history, name);
        free(name);
        if (!fine)
            return false;
        r->rows = r->history.f;
    } else if (!r->hash) {
        r->rows = stdout;
    }
    if (!r->rows)
        return true;
    fprintf(r->rows, "# scene %s, %u-D, %s", r->scene.name, r->b->dimension, r->is_double ? "double" : "float");
    for (uint32_t i = 0; i < r->scene.params; i++)
        if (r->p[i] != r->scene.param[i].value) {
            char text[64];
            build_param_text(&r->scene.param[i], r->p[i], text, sizeof text);
            fprintf(r->rows, ", %s=%s", r->scene.param[i].name, text);
        }
    fputc('\n', r->rows);
    for (uint32_t i = 0; i < r->scene.columns; i++)
        fprintf(r->rows, "%s%s", i ? "," : "", r->scene.column[i]);
    fputc('\n', r->rows);
    return true;
}

static void log_stage(void *ctx, uint64_t step, const char *pass, uint64_t hash)
{
    fprintf(ctx, "%llu %016llx %s\n", (unsigned long long)step, (unsigned long long)hash, pass);
}

static bool restore(run *r)
{
    FILE *f = fopen(r->restore, "rb");
    if (!f) {
        host_no("cannot read %s", r->restore);
        return false;
    }
    sph_status st = r->b->restore(r->sim, port_posix_source, f);
    fclose(f);
    if (st)
        host_no("%s: %s", r->restore, sph_status_text(st));
    return st == SPH_OK;
}

/* ---- progress and report ---- */

static double seconds(uint64_t ns) { return (double)ns * 1e-9; }

/* share of the run that is done */
static double done(const run *r, const sph_step_info *now)
{
    double by_time = r->end > r->first_time ? (now->time - r->first_time) / (r->end - r->first_time) : 1;
    double by_steps = r->steps ? (double)(now->step - r->first_step) / (double)r->steps : 0;
    return by_time > by_steps ? by_time : by_steps;
}

/* on a terminal one line that is written over five times a second; else a line every half minute */
static void progress(run *r, bool last)
{
    bool terminal = isatty(2);
    uint64_t now = port_posix_clock(NULL);
    if (now - r->last_line < (terminal ? 200000000u : 30000000000u) && !(last && terminal))
        return;
    r->last_line = now;
    sph_step_info info;
    r->b->info(r->sim, &info);
    double share = done(r, &info), spent = seconds(now - r->began);
    fprintf(stderr, "%s%3.0f %%  t %.5g s  step %llu  dt %.3g s (%s)", terminal ? "\r" : "", 100 * share, info.time,
            (unsigned long long)info.step, info.dt, sph_limit_text(info.limit));
    if (share > 0 && !last)
        fprintf(stderr, "  left %.0f s", spent * (1 / share - 1));
    fprintf(stderr, terminal && !last ? "\033[K" : terminal ? "\033[K\n" : "\n");
}

static void report_limits(const run *r, FILE *out)
{
    fprintf(out, "step set by    ");
    for (uint32_t i = 0; i < SPH_LIMITS; i++)
        if (r->limit_steps[i])
            fprintf(out, "%s %llu  ", sph_limit_text(i), (unsigned long long)r->limit_steps[i]);
    fputc('\n', out);
}

static void report(const run *r, FILE *out)
{
    build_totals o;
    sph_step_info info;
    sph_usage u;
    r->b->totals(r->sim, &o);
    r->b->info(r->sim, &info);
    r->b->usage(r->sim, &u);
    uint64_t steps = info.step - r->first_step;
    double s = seconds(r->stepping), rate = s > 0 ? (double)steps / s : 0;
    fprintf(out, "scene          %s, %u-D, %s, %llu thread%s\n", r->scene.name, r->b->dimension,
            r->is_double ? "double" : "float", (unsigned long long)r->threads, r->threads == 1 ? "" : "s");
    fprintf(out, "particles      %u fluid, %u wall", o.fluid, o.wall);
    fprintf(out, o.solid ? ", %u solid\n" : "\n", o.solid);
    fprintf(out, "time           %.10g s, %llu steps, last dt %.4g s\n", info.time,
            (unsigned long long)info.step, info.dt);
    if (steps)
        fprintf(out, "speed          %.4g steps/s, %.4g particle-steps/s, %.2f s in %llu steps\n", rate,
                rate * (o.fluid + o.wall + o.solid), s, (unsigned long long)steps);
    fprintf(out, "pairs          %llu candidates looked at, %.4g a particle-step\n", (unsigned long long)r->pairs,
            r->particle_steps ? (double)r->pairs / (double)r->particle_steps : 0);
    report_limits(r, out);
    fprintf(out, "arena          %zu bytes, %.1f a particle; at most %u in a cell\n", u.arena_used,
            (double)u.arena_used / u.max_particles, u.cell_particles);
    fprintf(out, "walls, faces   crossed %u, put back %u, left %u, reflected %u, mass removed %.6g kg\n", info.crossed,
            info.put_back, info.left, info.reflected, o.removed_mass);
    fprintf(out, "energy         kinetic %.8g, potential %.8g, internal %.8g J\n", o.kinetic, o.potential, o.internal);
    if (o.solid)
        fprintf(out, "solids         elastic %.8g, plastic work %.8g J\n", o.elastic, o.plastic_work);
    fprintf(out, "books          wall work %.8g, dissipated %.8g, diffused %.8g J\n", o.wall_work, o.dissipated,
            o.diffused);
    fprintf(out, "               in walls %.8g, in bonds %.8g, unbalanced %.8g, at once %.8g J\n", o.in_walls,
            o.in_bonds, o.unbalanced, o.at_once);
    fprintf(out, "balance        %.10g J\n", o.balance);
    fprintf(out, "density        %.8g .. %.8g kg/m^3; mass %.10g kg; fastest %.6g m/s\n", o.min_density, o.max_density,
            o.mass, o.max_speed);
    fprintf(out, "hash           %016llx\n", (unsigned long long)r->b->hash(r->sim));
}

/* what the run cost up to its last good step, for charts (tests/lab); seconds are the only figures that change from run
   to run */
static void write_cost(run *r)
{
    FILE *f = r->costs.f;
    sph_step_info info;
    r->b->info(r->sim, &info);
    const double s = seconds(r->stepping), unit = calibrate();
    fprintf(f,
            "name,value,unit\nparticles,%u,-\nsteps,%llu,-\nparticle_steps,%llu,-\npairs,%llu,-\ntime,%.10g,s\n"
            "end,%.10g,s\n",
            r->b->count(r->sim), (unsigned long long)(info.step - r->first_step), (unsigned long long)r->particle_steps,
            (unsigned long long)r->pairs, info.time, r->end);
    fprintf(f, "seconds,%.6g,s\ncalibration,%.6g,s\ncalibrations,%.6g,-\n", s, unit, s / unit);
}

/* ---- the run ---- */

static bool open_sim(run *r)
{
    build_host host;
    sph_report why;
    memset(&host, 0, sizeof host);
    if (r->threads != 1) {
        if (!port_posix_open(&r->pool, (uint32_t)r->threads))
            fprintf(stderr, "sph run: the machine gave %u threads\n", r->pool.threads);
        r->has_pool = true;
        r->threads = r->pool.threads;
        host.port = (sph_port)PORT_POSIX(&r->pool);
    }
    if (r->stage_name) {
        if (!host_create(&r->stage, r->stage_name))
            return false;
        host.stage_log = log_stage;
        host.stage_ctx = r->stage.f;
    }
    r->sim = r->b->open(r->index, r->p, &host, &why);
    if (!r->sim)
        host_no("%s: %s = %g, allowed: %s", sph_status_text(why.status), why.what, why.value,
                *why.allowed ? why.allowed : "-");
    return r->sim != NULL;
}

static int step_failed(run *r, sph_status st)
{
    const sph_report *why = r->b->last(r->sim);
    sph_step_info info;
    r->b->info(r->sim, &info);
    progress(r, true);
    host_no("step %llu failed: %s", (unsigned long long)info.step + 1, sph_status_text(st));
    if (why->particle != SPH_NO_PARTICLE)
        fprintf(stderr, "  particle %u\n", why->particle);
    fprintf(stderr, "  quantity %s, value %g%s%s\n  pass     %s\n", *why->what ? why->what : "-", why->value,
            *why->allowed ? ", allowed: " : "", why->allowed, *why->pass ? why->pass : "-");
    write_full_dump(r, "failed");
    return HOST_NO;
}

static bool finished(const run *r, const sph_step_info *info)
{
    return info->time >= r->end || (r->steps && info->step - r->first_step >= r->steps);
}

static int step_all(run *r)
{
    sph_step_info info;
    r->b->info(r->sim, &info);
    bool fine = write_frame(r);
    while (fine && !interrupted && !finished(r, &info)) {
        uint64_t before = port_posix_clock(NULL);
        sph_status st = r->b->step(r->sim, r->end);
        if (st)
            return step_failed(r, st);
        r->stepping += port_posix_clock(NULL) - before;
        r->b->info(r->sim, &info);
        r->limit_steps[info.limit]++;
        r->particle_steps += r->b->count(r->sim);
        r->pairs += info.pairs;
        progress(r, false);
        if (finished(r, &info) || info.time >= (double)(r->frame + 1) * r->every) {
            uint64_t reached = (uint64_t)floor(info.time / r->every * (1 + 1e-12));
            r->frame = reached > r->frame ? reached : r->frame + 1;
            fine = write_frame(r);
        }
    }
    progress(r, true);
    if (interrupted) {
        fprintf(stderr, "interrupted at t = %g s, step %llu\n", info.time, (unsigned long long)info.step);
        write_full_dump(r, "interrupted");
    }
    return fine && !interrupted ? HOST_FINE : HOST_NO;
}

static void catch_interrupt(void)
{
    struct sigaction a;
    memset(&a, 0, sizeof a);
    a.sa_handler = interrupt;
    a.sa_flags = (int)SA_RESETHAND; /* a second ^C ends the program at once */
    sigaction(SIGINT, &a, NULL);
    sigaction(SIGTERM, &a, NULL);
}

static int run_scene(run *r)
{
    if (!open_sim(r) || (r->restore && !restore(r)) || !open_history(r) ||
        (r->cost && !host_create(&r->costs, r->cost)))
        return HOST_NO;
    sph_step_info info;
    r->b->info(r->sim, &info);
    r->first_time = info.time;
    r->first_step = info.step;
    r->end = r->end >= 0 ? r->end : r->b->end(r->sim);
    if (!(r->every > 0))
        r->every = r->end > 0 ? r->end / (double)(r->frames ? r->frames : FRAMES) : 1;
    r->frame = (uint64_t)floor(info.time / r->every * (1 + 1e-12));
    r->began = r->last_line = port_posix_clock(NULL);
    catch_interrupt();
    int code = step_all(r);
    report(r, r->out && !r->hash ? stdout : stderr);
    if (r->costs.f)
        write_cost(r);
    if (r->hash)
        printf("%016llx\n", (unsigned long long)r->b->hash(r->sim));
    return code;
}

int cmd_run(int argc, char **argv)
{
    static run r; /* the pool is large */
    if (host_help(argc, argv, help))
        return HOST_FINE;
    memset(&r, 0, sizeof r);
    int code = take_arguments(&r, argc, argv);
    if (code)
        return code;
    code = run_scene(&r);
    /* history and stage log are complete up to the last step, also of a run that ended early */
    if (r.history.f && !host_finish(&r.history, true))
        code = HOST_NO;
    if (r.stage.f && !host_finish(&r.stage, true))
        code = HOST_NO;
    if (r.costs.f && !host_finish(&r.costs, true))
        code = HOST_NO;
    if (r.sim)
        r.b->close(r.sim);
    if (r.has_pool)
        port_posix_close(&r.pool);
    return code;
}
