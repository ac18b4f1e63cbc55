/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* report.c: the texts of statuses and of limits of the step, and how a failure is reported. Knows no simulation. */
#include "report.h"

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

sph_status sph_raise(sph_report *report, const sph_port *port, const sph_report *failure)
{
    *report = *failure;
    if (port->fault)
        port->fault(port->ctx, report);
    return report->status;
}

sph_status sph_refuse(sph_report *report, const char *what, const char *allowed, double value)
{
    if (report)
        *report = (sph_report){SPH_BAD_CONFIG, what, allowed, "", value, SPH_NO_PARTICLE};
    return SPH_BAD_CONFIG;
}
