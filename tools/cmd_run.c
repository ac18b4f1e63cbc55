/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* cmd_run.c: `sph run`, which steps a scene and writes its history, dumps and a report.

   Rows and dumps are taken after the first step that reaches their time, so that what is written, and how often, never
   changes the steps: the hash at the end depends on the scene, its parameters, the precision and the end only. */
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "calibrate.h"
#include "commands.h"
#include "host.h"
#include "run.h"

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
    "  gauge=X[/X...]          columns of the water above places of the bed (3-D: X,Y): its surface, the highest\n"
    "                          drop, its depth as a volume\n"
    "  probe=X,Y[/X,Y...]      columns of pressure and velocity at places\n"
    "  out=PREFIX              write PREFIX.csv and dumps PREFIX_0000.sph ...; without it the history goes to\n"
    "                          standard output and nothing is written\n"
    "  dump=full|picture|none  what dumps hold; picture (position, velocity, density, pressure) unless given\n"
    "  restore=FILE            go on from a full dump of the same scene and parameters; dt= and damping= may be\n"
    "                          others. Under the same out= the history goes on, and dumps get numbers above those\n"
    "                          that are there\n"
    "  cost=FILE               write a table of what the run cost: steps, pairs, seconds\n"
    "  stage_log=FILE          a hash after every pass of every step, to find where two machines part\n"
    "  hash                    print nothing but the hash of the last state to standard output\n"
    "\n"
    "^C ends the run after the step, with a full dump that restore= takes. A step that fails leaves the state before\n"
    "it, which goes into a full dump; exit code 1.\n";

static volatile sig_atomic_t interrupted;
static void interrupt(int signal)
{
    (void)signal;
    interrupted = 1;
}

/* ---- arguments ---- */

static const char *const option_names[] = {"precision", "threads", "end",     "steps",     "every", "frames",
                                           "out",       "dump",    "restore", "stage_log", "cost",  "gauge",
                                           "probe",     NULL};

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
    case 2: fine = host_number("end", value, 0, 1e30, &r->end); break;
    case 3: fine = host_count("steps", value, 0, UINT64_MAX, &r->steps); break;
    case 4: fine = host_number("every", value, 1e-30, 1e30, &r->every); break;
    case 5: fine = host_count("frames", value, 1, 1000000, &r->frames); break;
    case 6: r->out = r->prefix = value; break;
    case 7:
        kind = host_choice("dump", value, kinds);
        fine = kind >= 0;
        r->dump = fine ? (uint32_t)kind : DUMP_KIND_NONE;
        break;
    case 8: r->restore = value; break;
    case 9: r->stage_name = value; break;
    case 10: r->cost = value; break;
    default: fine = gauges_take(&r->extra, r->b, &r->scene, option_names[option], value); break;
    }
    if ((option == 6 || (option >= 8 && option <= 10)) && *value == '\0')
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
    r->given[param] = true;
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
    r->dump = DUMP_KIND_PICTURE;
    r->end = -1;
    for (int i = 2; i < argc; i++) {
        char name[64];
        const char *value;
        if (host_split(argv[i], name, sizeof name, &value) && host_given_before(argv, i, name))
            return HOST_USAGE;
        int code = take_argument(r, argv[i]);
        if (code)
            return code;
    }
    if (r->every > 0 && r->frames > 0)
        return host_usage("every= and frames= say the same thing; give one");
    return HOST_FINE;
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
    const char *s = build_unit(&r->scene, "s");
    fprintf(stderr, "%s%3.0f %%  t %.5g %s  step %llu  dt %.3g %s (%s)", terminal ? "\r" : "", 100 * share, info.time,
            s, (unsigned long long)info.step, info.dt, s, sph_limit_text(info.limit));
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

/* what is kept, in the scene's units */
static void report_books(const run *r, const build_totals *o, FILE *out)
{
    const char *const joule = build_unit(&r->scene, "J");
    fprintf(out, "energy         kinetic %.8g, potential %.8g, internal %.8g %s\n", o->kinetic, o->potential,
            o->internal, joule);
    if (o->solid)
        fprintf(out, "solids         elastic %.8g, plastic work %.8g %s\n", o->elastic, o->plastic_work, joule);
    if (o->books)
        fprintf(out, "books          wall work %.8g, dissipated %.8g, diffused %.8g %s\n", o->wall_work, o->dissipated,
                o->diffused, joule);
    if (o->books) {
        fprintf(out, "               in walls %.8g, in bonds %.8g, unbalanced %.8g, at once %.8g %s\n", o->in_walls,
                o->in_bonds, o->unbalanced, o->at_once, joule);
        fprintf(out, "balance        %.10g %s\n", o->balance, joule);
    } else
        fprintf(out, "books          of work and dissipation are not kept (books=yes keeps them)\n");
}

static void report_speed(const run *r, const build_totals *o, uint64_t steps, FILE *out)
{
    const double s = seconds(r->stepping), rate = s > 0 ? (double)steps / s : 0;
    if (steps)
        fprintf(out, "speed          %.4g steps/s, %.4g particle-steps/s, %.2f s in %llu steps\n", rate,
                rate * (o->fluid + o->wall + o->solid), s, (unsigned long long)steps);
    fprintf(out, "pairs          %llu candidates looked at, %.4g a particle-step\n", (unsigned long long)r->pairs,
            r->particle_steps ? (double)r->pairs / (double)r->particle_steps : 0);
}

static void report(const run *r, FILE *out)
{
    const build_scene *scene = &r->scene;
    build_totals o;
    sph_step_info info;
    sph_usage u;
    r->b->totals(r->sim, &o);
    r->b->info(r->sim, &info);
    r->b->usage(r->sim, &u);
    fprintf(out, "scene          %s, %u-D, %s, %llu thread%s\n", scene->name, r->b->dimension,
            r->is_double ? "double" : "float", (unsigned long long)r->threads, r->threads == 1 ? "" : "s");
    fprintf(out, "particles      %u fluid, %u wall", o.fluid, o.wall);
    fprintf(out, o.solid ? ", %u solid\n" : "\n", o.solid);
    fprintf(out, "time           %.10g %s, %llu steps, last dt %.4g %s\n", info.time, build_unit(scene, "s"),
            (unsigned long long)info.step, info.dt, build_unit(scene, "s"));
    report_speed(r, &o, info.step - r->first_step, out);
    report_limits(r, out);
    fprintf(out, "arena          %zu bytes, %.1f a particle; at most %u in a cell\n", u.arena_used,
            (double)u.arena_used / u.max_particles, u.cell_particles);
    fprintf(out, "walls, faces   crossed %u, put back %u, left %u, reflected %u, mass removed %.6g %s\n", info.crossed,
            info.put_back, info.left, info.reflected, o.removed_mass, build_unit(scene, "kg"));
    report_books(r, &o, out);
    fprintf(out, "density        %.8g .. %.8g %s; mass %.10g %s; fastest %.6g %s\n", o.min_density, o.max_density,
            build_unit(scene, "kg/m^3"), o.mass, build_unit(scene, "kg"), o.max_speed, build_unit(scene, "m/s"));
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
            "name,value,unit\nparticles,%u,-\nsteps,%llu,-\nparticle_steps,%llu,-\npairs,%llu,-\ntime,%.10g,%s\n"
            "end,%.10g,%s\n",
            r->b->count(r->sim), (unsigned long long)(info.step - r->first_step), (unsigned long long)r->particle_steps,
            (unsigned long long)r->pairs, info.time, build_unit(&r->scene, "s"), r->end, build_unit(&r->scene, "s"));
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
        host.stage_log = run_log_stage;
        host.stage_ctx = &r->stage;
    }
    r->sim = r->b->open(r->index, r->p, &host, &why);
    if (!r->sim)
        host_no("%s: %s = %g, allowed: %s", sph_status_text(why.status), why.what, why.value,
                *why.allowed ? why.allowed : "-");
    return r->sim != NULL && gauges_fit(&r->extra, r->b, r->sim);
}

static const char *const role_names[SPH_ROLES] = {"fluid", "wall", "boundary wall", "solid"};

/* rho/rho0 of fluid that is nowhere in water that is well: weakly compressible water keeps within some hundredths */
#define THIN 0.9
#define DENSE 1.1

static void watch_density(run *r, const sph_step_info *info)
{
    if (info->thinnest < r->thinnest) {
        r->thinnest = info->thinnest;
        r->thin_time = info->time;
    }
    if (info->densest > r->densest) {
        r->densest = info->densest;
        r->dense_time = info->time;
    }
}

static void say_density(const run *r)
{
    const char *s = build_unit(&r->scene, "s");
    if (r->thinnest > 0 && r->thinnest < THIN)
        fprintf(stderr, "note: density of fluid fell to %.3g of that at rest, t %.5g %s (limit %g): spray or tension\n",
                r->thinnest, r->thin_time, s, THIN);
    if (r->densest > DENSE)
        fprintf(stderr, "note: density of fluid rose to %.3g of that at rest, t %.5g %s (limit %g): sound too slow, or "
                "squeezed by a wall\n", r->densest, r->dense_time, s, DENSE);
}

static int step_failed(run *r, sph_status st)
{
    const sph_report *why = r->b->last(r->sim);
    sph_step_info info;
    r->b->info(r->sim, &info);
    progress(r, true);
    host_no("step %llu failed: %s", (unsigned long long)info.step + 1, sph_status_text(st));
    say_density(r);
    if (why->particle != SPH_NO_PARTICLE)
        fprintf(stderr, "  particle %u%s", why->particle, why->role < SPH_ROLES ? "" : "\n");
    if (why->role < SPH_ROLES)
        fprintf(stderr, " of set %u (%s)\n", why->set, role_names[why->role]);
    fprintf(stderr, "  quantity %s, value %g%s%s\n  pass     %s\n", *why->what ? why->what : "-", why->value,
            *why->allowed ? ", allowed: " : "", why->allowed, *why->pass ? why->pass : "-");
    run_write_state(r, "failed");
    return HOST_NO;
}

static bool finished(const run *r, const sph_step_info *info)
{
    return info->time >= r->end || (r->steps && info->step - r->first_step >= r->steps);
}

static int step_all(run *r, bool skip)
{
    sph_step_info info;
    r->b->info(r->sim, &info);
    r->thinnest = 1;
    bool fine = skip || run_write_frame(r);
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
        watch_density(r, &info);
        progress(r, false);
        fine = !r->stage.f || output_flush(&r->stage);
        if (fine && (finished(r, &info) || info.time >= (double)(r->frame + 1) * r->every)) {
            uint64_t reached = run_frame_of(r, info.time);
            r->frame = reached > r->frame ? reached : r->frame + 1;
            fine = run_write_frame(r);
        }
    }
    progress(r, true);
    say_density(r);
    if (interrupted) {
        fprintf(stderr, "interrupted at t = %g %s, step %llu\n", info.time, build_unit(&r->scene, "s"),
                (unsigned long long)info.step);
        run_write_state(r, "interrupted");
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

/* what looks wrong in the scene as it was built */
static void say_finding(void *ctx, const sph_finding *f)
{
    (void)ctx;
    if (f->kind == SPH_FINDING_SPARE) /* scenes leave room on purpose */
        return;
    fprintf(stderr, "note: %s: %u, worst %g (limit %g)", f->text, f->count, f->value, f->limit);
    if (f->particle != SPH_NO_PARTICLE)
        fprintf(stderr, ", particle %u", f->particle);
    if (f->other != SPH_NO_PARTICLE)
        fprintf(stderr, " and %u", f->other);
    if (f->set < SPH_MAX_SETS)
        fprintf(stderr, ", set %u", f->set);
    fputc('\n', stderr);
}

/* when rows are due; HOST_FINE, or HOST_USAGE after a message */
static int plan(run *r)
{
    sph_step_info info;
    r->b->info(r->sim, &info);
    r->first_time = info.time;
    r->first_step = info.step;
    r->end = r->end >= 0 ? r->end : r->b->end(r->sim);
    if (!(r->every > 0))
        r->every = r->end > 0 ? r->end / (double)(r->frames ? r->frames : FRAMES) : 1;
    const double last = r->end > r->first_time ? r->end : r->first_time;
    if (last / r->every > MOST_FRAMES)
        return host_usage("every=%g: would be %g rows up to t = %g, allowed: %g", r->every, last / r->every, last,
                          MOST_FRAMES);
    return HOST_FINE;
}

/* *begun: files are written from now on */
static int run_scene(run *r, bool *begun)
{
    bool skip;
    if (!run_open_files(r) || !open_sim(r) || (r->restore && !run_restore(r)))
        return HOST_NO;
    if (!r->restore)
        r->b->inspect(r->sim, say_finding, NULL);
    int code = plan(r);
    if (code)
        return code;
    if (!run_begin_files(r, &skip))
        return HOST_NO;
    *begun = true;
    r->began = r->last_line = port_posix_clock(NULL);
    catch_interrupt();
    code = step_all(r, skip);
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
    bool begun = false;
    if (host_help(argc, argv, help))
        return HOST_FINE;
    memset(&r, 0, sizeof r);
    int code = take_arguments(&r, argc, argv);
    if (code)
        return code;
    code = run_scene(&r, &begun);
    /* history and stage log are complete up to the last step, also of a run that ended early */
    if (!run_close_files(&r, begun))
        code = HOST_NO;
    if (r.sim)
        r.b->close(r.sim);
    if (r.has_pool)
        port_posix_close(&r.pool);
    return code;
}
