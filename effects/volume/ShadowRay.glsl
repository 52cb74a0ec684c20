/* What one volume has on the way of light to a place: its optical depth, the sum of -ln(1 - alpha) l / r of
 * steps of length l as the volume itself is drawn, with its own styles, crop box, planes and authors'
 * effects. Light does not change opacity, so that the styles here have none. What the volume does along
 * the ray is said by a second unit: shadow_steps.glsl or shadow_surfaces.glsl; its voxels are in grid.glsl. */

uniform float sampleDistance;  /* own coordinates */
uniform float referenceLength; /* an opacity means "after this length", own coordinates */
uniform vec3 cropMin = vec3(0.0);
uniform vec3 cropMax = vec3(1.0);

const float OPAQUE_DEPTH = 1.0e6;
const float DARK_DEPTH = 7.625; /* ln(8 * 255): an eighth of what 8 bits can tell from nothing is left */
const int MOST_STEPS = 2048;    /* of one ray: longer ones have longer steps */

/* Along the ray, t = 0 at the place: where it is in the box of texture coordinates [0,1], how fast it
 * moves there, and how fast in own coordinates. */
vec3 ray_origin;
vec3 ray_direction;
float ray_speed;
vec3 ray_origin_eye;
vec3 ray_direction_eye;

/* Twice as long as those of the viewer's rays: what is added up here is smoother than a picture. */
float shadow_step(const in float way) {
    return max(2.0 * sampleDistance / ray_speed, way / float(MOST_STEPS));
}

/* How far the ray goes in a voxel. */
float voxel_way() {
    return 1.0 / length(ray_direction * vec3(textureSize(voxels, 0)));
}

void sample_at(out VolumeSample s, const in float t, const in float span) {
    vec3 position = ray_origin + t * ray_direction;
    volume_sample_at(s, position, ray_origin_eye + t * ray_direction_eye, span * ray_speed);
    /* PLUG: volume_sample (s) */
}

/* Opacity per reference length, or of a surface. */
float sample_opacity(const in VolumeSample s) {
    vec4 color = voxel_color(s.value);
    /* PLUG: volume_classify (color, s) */
    color = clamped(color);
    /* PLUG: volume_shade (color, s) */
    return clamped(color).a;
}

void PLUG_volume_shadow(inout float depth, const in vec3 from_eye, const in vec3 direction_eye,
                        const in float reach) {
    if (depth > DARK_DEPTH)
        return;
    vec3 direction = mat3(eyeToLocal) * direction_eye;
    ray_speed = length(direction);
    ray_origin = (eyeToLocal * vec4(from_eye, 1.0)).xyz / dimensions + 0.5;
    ray_direction = direction / dimensions;
    ray_origin_eye = from_eye;
    ray_direction_eye = direction_eye;
    float enter = 0.0, leave = reach;
    cross_cropped_box(max(cropMin, 0.0), min(cropMax, 1.0), ray_origin, ray_direction, enter, leave);
#if PLUG_USED(volume_ray)
    float t_enter = enter, t_exit = leave;
    /* PLUG: volume_ray (t_enter, t_exit, from_eye, direction_eye) */
    enter = max(enter, t_enter);
    leave = min(leave, t_exit);
#endif
    if (enter < leave)
        add_depth(depth, enter, leave);
}
