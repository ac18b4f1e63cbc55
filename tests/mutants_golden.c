/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* mutants_golden.c: mutants_golden_BUILD [FILE CASE...]: golden runs one by one, by their numbers; exits 1 at the first
   whose line is not in FILE (tests/golden.csv). Without arguments: the number of cases. */
#include "golden.c"

#include <stdlib.h>
#include <string.h>

static bool as_wanted(const char *file, uint32_t k)
{
    char want[96], line[96];
    uint64_t h = 0;
    bool found = false;
    if (k >= BITS_CASES || run(&bits_cases[k], &h))
        return false;
    snprintf(want, sizeof want, "%d%c,%s,%08lx%08lx\n", SPH_DIM, SPH_DOUBLE ? 'd' : 'f', bits_cases[k].name,
             (unsigned long)(h >> 32), (unsigned long)(h & 0xffffffffu));
    FILE *f = fopen(file, "r");
    while (f && !found && fgets(line, sizeof line, f))
        found = strcmp(line, want) == 0;
    if (f)
        fclose(f);
    return found;
}

int main(int argc, char **argv)
{
    if (argc < 3)
        printf("%d\n", (int)BITS_CASES);
    for (int i = 2; i < argc; i++)
        if (!as_wanted(argv[1], (uint32_t)atoi(argv[i]))) {
            printf("%s\n", argv[i]);
            return 1;
        }
    return 0;
}
