/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* report.h: reports of failures outside a simulation; of one: state.c. */
#ifndef SPH_REPORT_H
#define SPH_REPORT_H

#include "sph.h"

/* a report without a failure in it */
#define SPH_REPORT(status, what, allowed, pass, value) \
    ((sph_report){status, what, allowed, pass, value, SPH_NO_PARTICLE, SPH_MAX_SETS, SPH_ROLES})
#define SPH_NO_REPORT SPH_REPORT(SPH_OK, "", "", "", 0)

/* A refusal of a configuration; the report may be null. Returns SPH_BAD_CONFIG. */
#define sph_refuse SPH_NAME(refuse_)
sph_status sph_refuse(sph_report *report, const char *what, const char *allowed, double value);
/* Writes a failure outside any simulation into a report, which may be null; returns its status. */
#define sph_tell SPH_NAME(tell_)
sph_status sph_tell(sph_report *report, const char *what, const char *allowed, double value, sph_status status);

#endif
