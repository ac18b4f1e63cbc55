/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* flow.h: what inflows and outflows (flow.c, openings.c) bring to the lists: their option (options.h), their passes,
   and the hold on their particles. */
#ifndef SPH_FLOW_H
#define SPH_FLOW_H

#define SPH_MAX_FLOWS 16u /* inflows and outflows together */

/* the option; how a line is made: options.h */
#define SPH_FLOW_OPTIONS(O, P, A)                                                                                     \
    O(A, max_flows, WHOLE, 0, 0, SPH_MAX_FLOWS, SPH_WITH_FLOW, "0 .. SPH_MAX_FLOWS", FIXED, "-",                      \
      "inflows and outflows together")

#ifdef SPH_H /* the tool reads the list of options without the kernel */
struct sph_config;
struct sph_pass;
#define sph_pass_births SPH_NAME(pass_births_)
#define sph_pass_newcomers SPH_NAME(pass_newcomers_)
#define sph_pass_flow SPH_NAME(pass_flow_)
extern const struct sph_pass sph_pass_births, sph_pass_newcomers, sph_pass_flow;

/* what inflows and outflows ask of a configuration */
#define sph_check_flows SPH_NAME(check_flows_)
sph_status sph_check_flows(const struct sph_config *c, sph_report *r);
#endif

#endif
