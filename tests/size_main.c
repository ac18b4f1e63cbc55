/* SPDX-License-Identifier: MIT. Copyright the sph authors. */
/* size_main.c: the arenas of all scenes of the six builds. */
int sph1f_size_arena(void);
int sph1d_size_arena(void);
int sph2f_size_arena(void);
int sph2d_size_arena(void);
int sph3f_size_arena(void);
int sph3d_size_arena(void);

int main(void)
{
    return sph1f_size_arena() | sph1d_size_arena() | sph2f_size_arena() | sph2d_size_arena() | sph3f_size_arena() |
           sph3d_size_arena();
}
