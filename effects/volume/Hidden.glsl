/* In general programs, a volume that a switch of the scene turns off: no ray meets it. */

void PLUG_volume_ray(inout float t_enter, inout float t_exit, const in vec3 origin_eye,
                     const in vec3 direction_eye) {
    t_exit = -NOWHERE;
}
