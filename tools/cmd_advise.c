/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* cmd_advise.c: sph advise. The cheapest way known to run a scene with a wanted error, out of the runs that the tables
   of tests/lab hold. It chooses between runs that were made; it never extrapolates. */
#include <stdlib.h>
#include <string.h>

#include "commands.h"
#include "host.h"
#include "studies.h"

static const char help[] =
    "usage: sph advise SCENE error=2% [norm=front|pressure|...] [precision=float|double] [cost=instructions|pairs]\n"
    "                  [study=NAME] [step=controlled|any] [tables=FOLDER]\n"
    "The cheapest run known of a scene whose error is at most that, from the tables of measured runs (of tests/lab as\n"
    "they were when the program was built, or those in a folder): its\n"
    "command, error, cost, what it rests on, the next cheaper run, and the best one known.\n"
    "  error=      with the unit of the study's norm, as 2% or 0.1cm\n"
    "  precision=  only runs in it; both unless given\n"
    "  cost=       instructions of the whole run (counted, default build), or candidate pairs looked at\n"
    "  norm=       what the error is of, in a word of the studies: front, pressure, noise, energy ...\n"
    "  study=      one study; a scene may have several, with norms of their own: what is chosen meets all of that "
    "unit\n"
    "  step=       any: runs whose time step was set by hand too, some at the edge of what is stable\n"
    "Exit code 1 where nothing is known: no study of the scene, or no run that reaches the error. Runs that blew up "
    "or\n"
    "did not reach their end are left out, and those that were right by luck: finer runs of the same method are more "
    "than twice as\n"
    "wrong, or coarser ones so much that no method of the fourth order could have come from there.\n";

enum { MOST_STUDIES = 32 };

/* one configuration: in each study the run that was made with it */
typedef struct choice {
    char *words;         /* its options in order of their names */
    const char *options; /* as they were given first */
    bool is_double;
    const study_run *run[MOST_STUDIES];
    double cost;
} choice;

typedef struct advice {
    const char *scene, *study, *norm;
    double wanted;
    const char *unit;
    int precision, cost; /* precision: 0 float, 1 double, 2 both; cost: number of a run */
    studies tables;
    choice *choice;
    uint32_t choices, failed, uncounted, by_hand, lucky;
    bool any_step;
} advice;

/* ---- configurations ---- */

static int by_text(const void *a, const void *b) { return strcmp(*(char *const *)a, *(char *const *)b); }

/* options in order, blanks single; the precision is kept apart */
static char *sorted_words(const char *options)
{
    const size_t length = strlen(options);
    char *copy = host_alloc(length + 1), *out = host_alloc(length + 2), *to = out;
    char **word = host_alloc((length / 2 + 1) * sizeof *word);
    uint32_t n = 0;
    memcpy(copy, options, length + 1);
    for (char *p = strtok(copy, " "); p; p = strtok(NULL, " "))
        if (strncmp(p, "precision=", 10) != 0)
            word[n++] = p;
    qsort(word, n, sizeof *word, by_text);
    for (uint32_t i = 0; i < n; i++) {
        *to = ' ';
        memcpy(to + 1, word[i], strlen(word[i]));
        to += strlen(word[i]) + 1;
    }
    *to = '\0';
    free(word);
    free(copy);
    return out;
}

static choice *find_choice(advice *a, const study_run *r)
{
    char *words = sorted_words(r->options);
    for (uint32_t i = 0; i < a->choices; i++)
        if (a->choice[i].is_double == r->is_double && !strcmp(a->choice[i].words, words)) {
            free(words);
            return &a->choice[i];
        }
    a->choice = host_realloc(a->choice, (a->choices + 1) * sizeof *a->choice);
    choice *c = &a->choice[a->choices++];
    memset(c, 0, sizeof *c);
    c->words = words;
    c->options = r->options;
    c->is_double = r->is_double;
    return c;
}

static void take_runs(advice *a, uint32_t s)
{
    const study *t = &a->tables.study[s];
    for (uint32_t i = 0; i < t->runs; i++) {
        const study_run *r = &t->run[i];
        if (a->precision < 2 && r->is_double != (a->precision == 1))
            continue;
        if (!a->any_step && !strcmp(r->sweep, "courant")) {
            a->by_hand++;
            continue;
        }
        if (r->number[STUDY_ERROR] < 0 || r->number[STUDY_ENDED] < 1 || *r->cause) {
            a->failed++;
            continue;
        }
        if (r->number[a->cost] < 0) {
            a->uncounted++;
            continue;
        }
        if (r->lucky) {
            a->lucky++;
            continue;
        }
        choice *c = find_choice(a, r);
        if (!c->run[s])
            c->run[s] = r;
        if (r->number[a->cost] > c->cost)
            c->cost = r->number[a->cost];
    }
}

/* is `word` one of the words of a text, with blanks between? */
static bool has_word(const char *text, const char *word)
{
    const size_t n = strlen(word);
    for (; *text; text += strcspn(text, " "), text += strspn(text, " "))
        if (strcspn(text, " ") == n && !memcmp(text, word, n))
            return true;
    return false;
}

/* is study s one of those that count? Its unit may go on, as "% of the depth". */
static bool counts(const advice *a, uint32_t s)
{
    const study *t = &a->tables.study[s];
    const size_t n = strcspn(t->unit, " ");
    const bool asked = (!a->study || !strcmp(t->name, a->study)) && (!a->norm || has_word(t->quantity, a->norm));
    return asked && strlen(a->unit) == n && !memcmp(t->unit, a->unit, n);
}

/* the worst error of a choice in the studies of a mask, negative if one of them has no such run */
static double worst(const advice *a, const choice *c, uint32_t mask)
{
    double error = 0;
    for (uint32_t s = 0; s < a->tables.count; s++)
        if (mask >> s & 1) {
            if (!c->run[s])
                return -1;
            if (c->run[s]->number[STUDY_ERROR] > error)
                error = c->run[s]->number[STUDY_ERROR];
        }
    return error;
}

/* The cheapest whose error is at most `error`; of equals the one with the smaller error, then the first. */
static const choice *cheapest(const advice *a, uint32_t mask, double error)
{
    const choice *best = NULL;
    for (uint32_t i = 0; i < a->choices; i++) {
        const choice *c = &a->choice[i];
        const double e = worst(a, c, mask);
        if (e < 0 || e > error || (best && c->cost > best->cost))
            continue;
        if (!best || c->cost < best->cost || e < worst(a, best, mask))
            best = c;
    }
    return best;
}

/* The most accurate of those that cost less than `cost` (negative: of all); of equals the cheaper, then the first. */
static const choice *most_accurate(const advice *a, uint32_t mask, double cost)
{
    const choice *best = NULL;
    for (uint32_t i = 0; i < a->choices; i++) {
        const choice *c = &a->choice[i];
        const double e = worst(a, c, mask), least = best ? worst(a, best, mask) : 0;
        if (e >= 0 && (cost < 0 || c->cost < cost) && (!best || e < least || (!(e > least) && c->cost < best->cost)))
            best = c;
    }
    return best;
}

/* ---- what is printed ---- */

static void put_command(const advice *a, const choice *c)
{
    const bool more = c->is_double && !strstr(c->options, "precision=");
    printf("sph run %s%s%s%s\n", a->scene, *c->options ? " " : "", c->options, more ? " precision=double" : "");
}

static const char *cost_name(const advice *a) { return a->cost == STUDY_PAIRS ? "pairs" : "instructions"; }

/* what a choice was measured at, in each study of the mask */
static void put_basis(const advice *a, const choice *c, uint32_t mask)
{
    static const int number[] = {STUDY_INSTRUCTIONS, STUDY_PAIRS, STUDY_PARTICLE_STEPS};
    static const char *const name[] = {"instructions", "pairs", "particle-steps"};
    const char *before = "cost        ";
    for (uint32_t s = 0, first = 1; s < a->tables.count; s++) {
        const study *t = &a->tables.study[s];
        if (!(mask >> s & 1))
            continue;
        const study_run *r = c->run[s];
        for (int k = 0; first && k < 3; k++)
            if (r->number[number[k]] >= 0) {
                printf("%s%.4g %s", before, r->number[number[k]], name[k]);
                before = ", ";
            }
        printf("%serror       %.4g %s: %s; reference: %s\n", first ? "\n" : "", r->number[STUDY_ERROR], t->unit,
               *t->norm ? t->norm : "norm not said", *t->reference ? t->reference : "not said");
        printf("rests on    %s line %lu (sweep %s, %s)\n", t->file, r->line, r->sweep, r->label);
        if (!strcmp(r->sweep, "courant"))
            printf("note        its time step was set by hand: it holds for these options alone\n");
        first = 0;
    }
}

static void put_cheaper(const advice *a, const choice *c, uint32_t mask)
{
    const choice *next = most_accurate(a, mask, c->cost);
    if (!next) {
        printf("cheaper     none is known\n");
        return;
    }
    const double e = worst(a, next, mask);
    printf("cheaper     error %.4g %s at %.3g of the %s: ", e, a->unit, next->cost / c->cost, cost_name(a));
    put_command(a, next);
}

static void put_best(const advice *a, const choice *c, const choice *best, uint32_t mask)
{
    if (best == c) {
        printf("best known  this one\n");
        return;
    }
    const double e = worst(a, best, mask);
    printf("best known  error %.4g %s", e, a->unit);
    if (e > 0)
        printf(" (wanted: %.3g times that)", a->wanted / e);
    printf(" at %.3g times the %s: ", best->cost / c->cost, cost_name(a));
    put_command(a, best);
}

static int not_reached(const advice *a, const choice *best, uint32_t mask)
{
    const double e = worst(a, best, mask);
    printf("not known   no run in the tables reaches %g %s\nbest known  ", a->wanted, a->unit);
    put_command(a, best);
    put_basis(a, best, mask);
    printf("missing     a factor of %.3g; beyond this run nothing is known, and nothing is extrapolated\n",
           e / a->wanted);
    return HOST_NO;
}

/* the answer for all studies of the mask together */
static int answer(const advice *a, uint32_t mask)
{
    const choice *best = most_accurate(a, mask, -1), *c = cheapest(a, mask, a->wanted);
    if (!best) {
        printf("not known   no run was measured %s\n",
               mask & (mask - 1) ? "in every one of these studies" : "to its end");
        return HOST_NO;
    }
    if (!c)
        return not_reached(a, best, mask);
    printf("run         ");
    put_command(a, c);
    put_basis(a, c, mask);
    put_cheaper(a, c, mask);
    put_best(a, c, best, mask);
    return HOST_FINE;
}

/* where there are several studies: what each would take on its own */
static void put_alone(const advice *a, uint32_t mask)
{
    for (uint32_t s = 0; s < a->tables.count; s++) {
        if (!(mask >> s & 1))
            continue;
        const choice *c = cheapest(a, UINT32_C(1) << s, a->wanted), *best = most_accurate(a, UINT32_C(1) << s, -1);
        printf("alone       %s: ", a->tables.study[s].name);
        if (c) {
            printf("%.4g %s, %.4g %s: ", worst(a, c, UINT32_C(1) << s), a->unit, c->cost, cost_name(a));
            put_command(a, c);
        } else if (best)
            printf("not reached; best known %.4g %s\n", worst(a, best, UINT32_C(1) << s), a->unit);
        else
            printf("no run was measured to its end\n");
    }
}

static void put_rest(const advice *a)
{
    for (uint32_t s = 0; s < a->tables.count; s++)
        if (!counts(a, s) && !a->study && !a->norm) {
            const study *t = &a->tables.study[s];
            printf("not asked   study %s, in %s: %s\n", t->name, t->unit, t->norm);
        }
    if (a->failed)
        printf("left out    %u runs that blew up, ended early or gave no figure\n", a->failed);
    if (a->by_hand)
        printf("left out    %u runs whose time step was set by hand (step=any takes them in)\n", a->by_hand);
    if (a->lucky)
        printf("left out    %u runs whose error the same method's other sizes do not bear out\n", a->lucky);
    if (a->uncounted)
        printf("left out    %u runs without a count of %s\n", a->uncounted, cost_name(a));
}

/* ---- the command ---- */

static int no_study(const advice *a, const char *folder)
{
    host_no("no study of %s in %s: what it costs is not known", a->scene, folder ? folder : "the tables built in");
    if (a->tables.scenes)
        fputs("studied:", stderr);
    for (uint32_t i = 0; i < a->tables.scenes; i++)
        fprintf(stderr, " %s%s", a->tables.scene[i], i + 1 == a->tables.scenes ? "\n" : "");
    return HOST_NO;
}

/* no study has both the name and the unit that were asked for */
static int no_such_norm(const advice *a)
{
    const char *const called = a->study ? " called " : "", *const name = a->study ? a->study : "";
    const char *const of = a->norm ? " with norm=" : "", *const norm = a->norm ? a->norm : "";
    host_usage("no study of %s%s%s%s%s has its error in \"%s\"", a->scene, called, name, of, norm, a->unit);
    fputs("allowed:", stderr);
    for (uint32_t s = 0; s < a->tables.count; s++)
        fprintf(stderr, "%s study=%s norm=%.*s error=NUMBER%.*s", s ? "," : "", a->tables.study[s].name,
                (int)strcspn(a->tables.study[s].quantity, " "), a->tables.study[s].quantity,
                (int)strcspn(a->tables.study[s].unit, " "), a->tables.study[s].unit);
    fputc('\n', stderr);
    return HOST_USAGE;
}

static int advise(advice *a, const char *folder)
{
    uint32_t mask = 0;
    if (!a->tables.count)
        return no_study(a, folder);
    if (a->tables.count > MOST_STUDIES)
        return host_no("%s: more than %d studies of %s", folder ? folder : "tables", MOST_STUDIES, a->scene);
    for (uint32_t s = 0; s < a->tables.count; s++)
        if (counts(a, s)) {
            mask |= UINT32_C(1) << s;
            take_runs(a, s);
        }
    if (!mask)
        return no_such_norm(a);
    const int code = answer(a, mask);
    if (mask & (mask - 1))
        put_alone(a, mask);
    put_rest(a);
    return code;
}

/* a number and its unit */
static bool parse_error(advice *a, const char *text)
{
    char *end;
    a->wanted = strtod(text, &end);
    a->unit = end + strspn(end, " ");
    if (end != text && *text != ' ' && a->wanted > 0 && a->wanted <= 1e300)
        return true;
    host_usage("error=%s: must be a number above zero and a unit, as 2%%", text);
    return false;
}

static bool take_options(advice *a, int argc, char **argv)
{
    static const char *const precisions[] = {"float", "double", NULL}, *const costs[] = {"instructions", "pairs", NULL};
    static const char *const steps[] = {"controlled", "any", NULL};
    const char *text = host_option(argc, argv, "error");
    if (!text) {
        host_usage("error= is missing: the largest error that is wanted, as error=2%%");
        return false;
    }
    if (!parse_error(a, text))
        return false;
    a->precision = 2;
    if ((text = host_option(argc, argv, "precision")) &&
        (a->precision = host_choice("precision", text, precisions)) < 0)
        return false;
    a->cost = STUDY_INSTRUCTIONS;
    if ((text = host_option(argc, argv, "cost"))) {
        const int kind = host_choice("cost", text, costs);
        if (kind < 0)
            return false;
        a->cost = kind ? STUDY_PAIRS : STUDY_INSTRUCTIONS;
    }
    if ((text = host_option(argc, argv, "step"))) {
        const int kind = host_choice("step", text, steps);
        if (kind < 0)
            return false;
        a->any_step = kind == 1;
    }
    a->study = host_option(argc, argv, "study");
    a->norm = host_option(argc, argv, "norm");
    return true;
}

int cmd_advise(int argc, char **argv)
{
    static const char *const known[] = {"error", "norm", "precision", "cost", "study", "step", "tables", NULL};
    advice a;
    memset(&a, 0, sizeof a);
    host_command("advise");
    if (host_help(argc, argv, help))
        return HOST_FINE;
    const int words = host_known_options(argc, argv, known);
    if (words < 0)
        return HOST_USAGE;
    if (words != 1)
        return host_usage("%s", words ? "one scene at a time" : "which scene?");
    const char *const folder = host_option(argc, argv, "tables");
    a.scene = argv[1];
    if (!take_options(&a, argc, argv))
        return HOST_USAGE;
    if (!studies_open(&a.tables, folder, a.scene))
        return HOST_NO;
    const int code = advise(&a, folder);
    for (uint32_t i = 0; i < a.choices; i++)
        free(a.choice[i].words);
    free(a.choice);
    studies_close(&a.tables);
    return code;
}
