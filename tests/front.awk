# SPDX-License-Identifier: MIT. Copyright the sph authors.
# front.awk: a dam break's history beside measured and computed fronts, n^2 = 2.
# usage: awk -f front.awk martin_moyce_1952_n2_2.csv vof_dam_break_n2_2.csv history.csv
# Time of the run is matched to the experiment at one point, because the gate of the experiment is not instant; the
# volume-of-fluid run (slip floor, 40 cells a column) is compared without any shift.
BEGIN { FS = ","; match_t = 1.219; match_z = 1.474 }
/^#/ { next }
FILENAME != now { now = FILENAME; file++; for (i = 1; i <= NF; i++) head[file, $i] = i; next }
file == 1 && $1 == 2.25 { et[++ne] = $2; ez[ne] = $3 }
file == 2 { vt[++nv] = $1; vz[nv] = $head[2, "Zf_sl_40"] }
file == 3 { t[++n] = $head[3, "T_-"]; z[n] = $head[3, "Z_-"] }
function at(x, y, count, where,   i) {
    for (i = 1; i < count; i++)
        if (x[i] <= where && where <= x[i + 1] && x[i + 1] > x[i])
            return y[i] + (y[i + 1] - y[i]) * (where - x[i]) / (x[i + 1] - x[i])
    return -1
}
END {
    shift = match_t - at(z, t, n, match_z)
    printf "front Z = x/a against T = t sqrt(2 g/a); Martin & Moyce 1952, n^2 = 2, a = 5.7 cm, time matched at Z %.2f\n", match_z
    printf "%8s %10s %10s %8s   %10s %10s %8s\n", "T", "measured", "sph", "diff", "VOF", "sph", "diff"
    for (i = 1; i <= ne; i++) {
        a = at(t, z, n, et[i] - shift); v = at(vt, vz, nv, et[i]); b = at(t, z, n, et[i])
        if (a < 0 || b < 0 || v < 0) continue
        printf "%8.2f %10.2f %10.2f %7.1f%%   %10.2f %10.2f %7.1f%%\n", et[i], ez[i], a, 100 * (a / ez[i] - 1), v, b, 100 * (b / v - 1)
    }
    printf "the experiment runs %.2f later in T than water freed at once\n", shift
}
