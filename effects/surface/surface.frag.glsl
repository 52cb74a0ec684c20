#version 330 core
/* The surface base, fragment stage: the colour of the surface, its textures, light, fog. It knows no
 * material and no light: these are effects, and so is everything else that can be seen. */

/* PLUG-DECLARATIONS */

in vec4 castle_vertex_eye;
in vec3 castle_normal_eye;

out vec4 plugray_FragColor;

/* Where the fragment is and which way it faces; set where any effect asks for it. */
vec4 surface_vertex_eye;
vec3 surface_normal_eye;

void main() {
#if PLUG_USED(fragment_eye_space) || PLUG_USED(add_light) || PLUG_USED(lighting_apply) ||           \
    PLUG_USED(fog_apply) || PLUG_USED(surface_clip) || PLUG_USED(texture_coord_reflect)
    surface_vertex_eye = castle_vertex_eye;
#endif
#if PLUG_USED(fragment_eye_space) || PLUG_USED(main_texture_apply) || PLUG_USED(texture_apply) ||   \
    PLUG_USED(add_light) || PLUG_USED(lighting_apply) || PLUG_USED(fog_apply) ||                    \
    PLUG_USED(texture_coord_reflect)
    surface_normal_eye = unit_or_zero(castle_normal_eye);
#if TWO_SIDED
    if (!gl_FrontFacing)
        surface_normal_eye = -surface_normal_eye;
#endif
#endif
    /* PLUG: fragment_eye_space (surface_vertex_eye, surface_normal_eye) */

    /* the colour before light: diffuse, base or emissive colour, and 1 - transparency */
    vec4 fragment_color = vec4(1.0);
    /* PLUG: surface_color (fragment_color) */
    /* PLUG: surface_texture (fragment_color) */
    /* PLUG: main_texture_apply (fragment_color, surface_normal_eye) */
    /* PLUG: texture_apply (fragment_color, surface_normal_eye) */
    /* PLUG: surface_light (fragment_color) */
    /* PLUG: lighting_apply (fragment_color, surface_vertex_eye, surface_normal_eye) */
    /* PLUG: steep_parallax_shadow_apply (fragment_color) */
    /* PLUG: fragment_modify (fragment_color) */
    /* PLUG: surface_output (fragment_color) */
    /* PLUG: fog_apply (fragment_color, surface_normal_eye) */

    /* late: what is cut away must not spoil the derivatives of what is beside it */
    /* PLUG: surface_clip (surface_vertex_eye) */
#if OPAQUE && !PLUG_USED(fragment_end)
    /* a surface that does not blend covers its pixels, whatever an effect writes */
    plugray_FragColor = vec4(rgb_of(fragment_color), 1.0);
#else
    plugray_FragColor = fragment_color;
    /* PLUG: fragment_end (plugray_FragColor) */
#if OPAQUE
    plugray_FragColor.a = 1.0;
#endif
#endif
}
