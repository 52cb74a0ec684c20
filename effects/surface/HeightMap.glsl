/* Depth behind the surface, from the alpha of Appearance.normalMap: 1 is the surface itself, 0 lies
 * heightMapScale (in texture coordinates) below. The view ray is followed down to where it meets the
 * heights, and textures are read there; from there each light's ray is followed up, and what it meets is
 * in shadow. McGuire and McGuire, "Steep Parallax Mapping", I3D 2005, with the last step
 * made linear as in Tatarchuk, "Practical Parallax Occlusion Mapping", 2006. */

uniform sampler2D normalMap;
uniform float heightMapScale = 0.01;

/* Found once for all textures. */
bool parallax_found = false;
mat3 parallax_frame;
vec2 parallax_start, parallax_end;
float parallax_height;

/* Steps from the top to the bottom; more where they are seen from the side. */
int parallax_steps(float upwards) {
    return int(mix(48.0, 12.0, clamp(upwards, 0.0, 1.0)));
}

void find_parallax(vec2 tex_coord) {
    parallax_found = true;
    parallax_frame = tangent_frame(surface_vertex_eye.xyz, tex_coord, surface_normal_eye);
    parallax_start = parallax_end = tex_coord;
    parallax_height = 1.0;
    vec3 view = direction_to_viewer(surface_vertex_eye) * parallax_frame;
    if (view.z <= 0.0)
        return;
    vec2 dx = dFdx(tex_coord), dy = dFdy(tex_coord);
    int steps = parallax_steps(view.z);
    vec2 whole = -heightMapScale * view.xy / view.z; /* from the top to the bottom */
    float above = 0.0;                               /* of the ray over the heights, one step before */
    for (int i = 0; i <= steps; i++) {
        float depth = float(i) / float(steps);
        float height = textureGrad(normalMap, tex_coord + depth * whole, dx, dy).a;
        float over = 1.0 - depth - height;
        if (over <= 0.0) {
            float back = i == 0 ? 0.0 : over / (over - above) / float(steps);
            parallax_end = tex_coord + (depth - back) * whole;
            parallax_height = 1.0 - depth + back;
            return;
        }
        above = over;
    }
    parallax_end = tex_coord + whole;
    parallax_height = 0.0;
}

void PLUG_texture_coord_shift(inout vec2 tex_coord) {
    if (!parallax_found)
        find_parallax(tex_coord);
    tex_coord += parallax_end - parallax_start;
}

void PLUG_light_scale(inout float scale, const in vec3 normal_eye, const in vec3 light_dir) {
    vec3 light = light_dir * parallax_frame;
    if (!parallax_found || light.z <= 0.0)
        return;
    int steps = parallax_steps(light.z);
    vec2 whole = heightMapScale * light.xy / light.z; /* from the bottom to the top */
    for (int i = 1; i < steps; i++) {
        float up = float(i) / float(steps);
        float height = parallax_height + up;
        if (height >= 1.0)
            return;
        if (textureLod(normalMap, parallax_end + up * whole, 0.0).a > height + 0.01) {
            scale = 0.0;
            return;
        }
    }
}
