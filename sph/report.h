/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* report.h: the texts of statuses, and how a failure is reported. Knows no simulation. */
#ifndef SPH_REPORT_H
#define SPH_REPORT_H

#include "sph.h"

/* a report without a failure in it */
#define SPH_NO_REPORT ((sph_report){SPH_OK, "", "", "", 0, SPH_NO_PARTICLE})

/* Writes what failed into a report and tells the host's fault hook; returns its status. */
#define sph_raise SPH_NAME(raise_)
sph_status sph_raise(sph_report *report, const sph_port *port, const sph_report *failure);
/* A refusal of a configuration; the report may be null. Returns SPH_BAD_CONFIG. */
#define sph_refuse SPH_NAME(refuse_)
sph_status sph_refuse(sph_report *report, const char *what, const char *allowed, double value);

#endif
