# SPDX-License-Identifier: MIT. Copyright the sph authors.
# tables.awk: CSV files with a line `# study:` -> a C file with their lines, for sph advise (studies.h: studies_built_in)
BEGIN { print "#include <stddef.h>" }
function close_file() { if (open) print "    NULL};"; open = 0 }
FNR == 1 { close_file(); held = ""; study = 0 }
{
    line = $0
    gsub(/\\/, "\\\\", line)
    gsub(/"/, "\\\"", line)
    text = "    \"" line "\",\n"
    if (study) printf "%s", text
    else if ($0 ~ /^# *study:/) {
        study = open = 1
        name[n++] = FILENAME
        printf "static const char *const file_%d[] = {\n%s%s", n, held, text
    } else if (FNR < 40) held = held text
}
END {
    close_file()
    print "#include \"tools/studies.h\"\nconst studies_file studies_built_in[] = {"
    for (i = 0; i < n; i++) printf "    {\"%s\", file_%d},\n", name[i], i + 1
    print "    {NULL, NULL}};"
}
