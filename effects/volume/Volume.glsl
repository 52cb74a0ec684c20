/* One volume: where the ray runs in it, its samples, its styles. Effects on the volume speak here. What
 * it does along the ray is said by a second unit of the same effect: steps.glsl, surfaces.glsl or
 * projection.glsl; its voxels are in a third, grid.glsl. */

uniform vec3 localStart;         /* where the view's axis meets the plane at which rays begin, own coordinates */
uniform float sampleDistance;   /* own coordinates */
uniform float referenceLength;  /* an opacity means "after this length", own coordinates */
#if defined(GIVEN_cropMin) || defined(GIVEN_cropMax)
uniform vec3 cropMin = vec3(0.0); /* of the box of texture coordinates */
uniform vec3 cropMax = vec3(1.0);
#endif
#if defined(BRICKED) && BRICKED
uniform vec3 brickLow; /* what is cast now */
uniform vec3 brickHigh;
#endif

/* Along the ray, t = 0 where it begins: where it is in the box of texture coordinates [0,1], how fast it
 * moves there, and how fast in own coordinates. */
vec3 ray_origin;
vec3 ray_direction;
float ray_speed;
float enter;
float leave;
#if HAS_PARTS
float whole_enter;
#endif

#if PLUG_USED(volume_fog)
vec4 sample_place; /* where fog looks, in eye space */
#endif

void PLUG_volume_begin(const in vec3 origin_eye, const in vec3 direction_eye, const in float start,
                       const in float limit) {
    vec3 direction = mat3(eyeToLocal) * direction_eye;
    ray_speed = length(direction);
    ray_origin = (mat3(eyeToLocal) * vec3(origin_eye.xy, 0.0) + localStart) / dimensions + 0.5;
    ray_direction = direction / dimensions;
    enter = start;
    leave = limit;
#if defined(GIVEN_cropMin) || defined(GIVEN_cropMax)
    cross_cropped_box(max(cropMin, 0.0), min(cropMax, 1.0), ray_origin, ray_direction, enter, leave);
#else
    cross_box(vec3(0.0), vec3(1.0), ray_origin, ray_direction, enter, leave);
#endif
#if PLUG_USED(volume_ray)
    float from = enter + eye_distance, to = leave + eye_distance;
    float t_enter = from, t_exit = to;
    /* PLUG: volume_ray (t_enter, t_exit, eye_origin, direction_eye) */
    enter = mix(enter, max(enter, t_enter - eye_distance), t_enter > from);
    leave = mix(leave, min(leave, t_exit - eye_distance), t_exit < to);
#endif
#if defined(BRICKED) && BRICKED
    float whole_leave = leave;
    cross_box(brickLow, brickHigh, ray_origin, ray_direction, enter, leave);
#endif
    ray_begins(origin_eye, direction_eye);
#if WRITES_DEPTH && writeDepth
    if (enter < leave)
#if defined(BRICKED) && BRICKED
        written_end = max(written_end, whole_leave);
#else
        written_end = max(written_end, leave);
#endif
#endif
#if HAS_PARTS
    whole_enter = enter;
    enter = max(enter, part_start);
    leave = min(leave, part_end);
#endif
#if MIXES
    if (!(enter < leave))
        enter = leave = 0.0;
#endif
}

#if MIXES
void PLUG_volume_first(inout float t) {
    if (enter < leave)
        t = min(t, enter);
}
#endif

void PLUG_volume_part(inout float t, inout float t_next, inout float step_length) {
#if MIXES
    if (enter <= t && t < leave) {
#if !PROJECTS
        step_length = min(step_length, sampleDistance / ray_speed);
#endif
        t_next = min(t_next, leave);
    } else if (t < enter) {
        t_next = min(t_next, enter);
    }
#else
    t_next = leave;
    step_length = sampleDistance / ray_speed;
#if HAS_PARTS
    t = leave;
    if (enter < leave)
        t = whole_enter + floor((enter - whole_enter) / step_length) * step_length;
#else
    t = enter;
#endif
#endif
}

/* What is at t; `span` is the length of the step around it, 0 at a surface. */
void sample_at(out VolumeSample s, const in float t, const in float span, const in vec3 origin_eye,
               const in vec3 direction_eye) {
    vec3 position = ray_origin + t * ray_direction;
    volume_sample_at(s, position, origin_eye + t * direction_eye, span * ray_speed);
    /* PLUG: volume_sample (s) */
}

/* Colour and opacity per reference length of a sample, from the voxel's own on: straight. */
void style_sample(inout vec4 color, const in VolumeSample s) {
#if PLUG_USED(volume_classify)
    /* PLUG: volume_classify (color, s) */
    color = clamped(color);
#endif
#if PLUG_USED(volume_shade)
    /* PLUG: volume_shade (color, s) */
    color = clamped(color);
#endif
#if PLUG_USED(volume_fog)
    sample_place = vec4(s.position_eye, 1.0);
    /* PLUG: volume_fog (color) */
    color = clamped(color);
#endif
}
