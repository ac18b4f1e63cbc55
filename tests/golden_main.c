/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* golden_main.c: the golden runs of all six builds, one after the other; exits 0 if every case ran. */
int sph1f_golden(void);
int sph1d_golden(void);
int sph2f_golden(void);
int sph2d_golden(void);
int sph3f_golden(void);
int sph3d_golden(void);

int main(void)
{
    return sph1f_golden() + sph1d_golden() + sph2f_golden() + sph2d_golden() + sph3f_golden() + sph3d_golden() ? 1 : 0;
}
