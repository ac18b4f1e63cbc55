/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* report.c: the texts of statuses and of limits of the step, and reports outside a simulation. */
#include "report.h"
#include "arithmetic.h"

SPH_OBJECT(report)

static const char *const status_texts[SPH_STATUS_COUNT] = {
#define SPH_STATUS_TEXT(name, text) text,
    SPH_STATUS_LIST(SPH_STATUS_TEXT)
#undef SPH_STATUS_TEXT
};
const char *sph_status_text(sph_status s)
{
    return (unsigned)s < SPH_STATUS_COUNT ? status_texts[s] : "unknown status";
}

static const char *const limit_texts[SPH_LIMITS] = {
#define SPH_LIMIT_TEXT(name, text) text,
    SPH_LIMIT_LIST(SPH_LIMIT_TEXT)
#undef SPH_LIMIT_TEXT
};
const char *sph_limit_text(uint32_t limit) { return limit < SPH_LIMITS ? limit_texts[limit] : "unknown"; }

__attribute__((noinline)) sph_status sph_tell(sph_report *report, const char *what, const char *allowed, double value,
                                              sph_status status)
{
    if (report)
        *report = SPH_REPORT(status, what, allowed, "", value);
    return status;
}

sph_status sph_refuse(sph_report *report, const char *what, const char *allowed, double value)
{
    return sph_tell(report, what, allowed, value, SPH_BAD_CONFIG);
}
