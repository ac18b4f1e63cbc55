/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* config.h: the one check of a configuration, for sph_config_check, sph_arena_bytes and sph_init alike. */
#ifndef SPH_CONFIG_H
#define SPH_CONFIG_H

#include "factors.h"

/* Checks everything that a configuration may be refused for; its grid and the bytes of its arena. c and r may be
   null. */
#define sph_check_config SPH_NAME(check_config_)
sph_status sph_check_config(const sph_config *c, sph_grid *grid, size_t *bytes, sph_report *r);

#endif
