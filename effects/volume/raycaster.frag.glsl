#version 330 core
/* The base raycaster. It sets up the ray, finds how far it may go, walks it in steps and hands each
 * step to the volumes (Volume.glsl) and to the compositing effect (Composite.glsl). All distances
 * along a ray are in eye space: 0 at the eye, or at the eye's plane where the projection is parallel. */

/* What is known of one sample. Members that nothing reads are not in the program. */
struct VolumeSample {
    vec4 value;         /* voxel in [0,1]; missing components 0, the fourth 1 */
#if READS(position)
    vec3 position;      /* texture coordinates of the volume, [0,1] */
#endif
#if READS(position_eye)
    vec3 position_eye;
#endif
#if READS(normal_eye)
    vec3 normal_eye;    /* unit, against the gradient; zero where that vanishes */
#endif
#if READS(gradient)
    float gradient;     /* magnitude, value per unit length in the volume's own coordinates */
#endif
#if READS(step_length)
    float step_length;  /* own coordinates of the volume; eye space in a mix */
#endif
#if READS(segment)
    int segment;
#endif
#if READS(surface)
    int surface;        /* of equal value, by its number; -1 where there is none */
#endif
#if READS(volume)
    int volume;         /* -1 in a mix of several */
#endif
};

uniform vec4 viewport; /* x, y, width, height in pixels */
#if HAS_OPAQUE
uniform sampler2D opaqueDepth;
uniform vec2 depthToClip;  /* scale and shift from the depth buffer to clip space */
uniform float emptyDepth;  /* of pixels where nothing opaque is */
#endif
#if HAS_CUT
uniform vec2 viewpointCut; /* near and far distance that the viewpoint asks for, as planes */
#endif
#if EARLY_END
uniform float transparencyLeft; /* rays end where less than this shines through */
#endif

out vec4 plugray_FragColor;

/* PLUG-DECLARATIONS */

const float NOWHERE = 3.0e38;
#if HAS_EVENTS
const int MOST_EVENTS = 4096; /* in one step */
#endif

/* How many steps a part of the ray takes; a remainder that is only rounding is no step. */
int step_count(float whole, float step_length) {
    return int(ceil(min(whole / step_length - 1.0e-4, 1.0e6)));
}

#if HAS_OPAQUE
/* Distance along the ray of what the depth buffer holds at this pixel. */
float opaque_distance(vec3 direction_eye) {
    float depth = texelFetch(opaqueDepth, ivec2(gl_FragCoord.xy - viewport.xy), 0).r;
    if (depth == emptyDepth)
        return NOWHERE;
    float ndc = depth * depthToClip.x + depthToClip.y;
    mat4 p = castle_ProjectionMatrix;
    float z = p[2][3] != 0.0 ? -p[3][2] / (ndc + p[2][2]) : (ndc - p[3][2]) / p[2][2];
    return z / direction_eye.z;
}
#endif

void main() {
    /* the ray through the pixel's centre, from the eye or, in parallel projection, from its plane */
    vec2 ndc = (gl_FragCoord.xy - viewport.xy) / viewport.zw * 2.0 - 1.0;
    mat4 p = castle_ProjectionMatrix;
    vec2 scale = vec2(p[0][0], p[1][1]);
    vec3 origin_eye = vec3(0.0), direction_eye = vec3(0.0, 0.0, -1.0);
    if (p[2][3] != 0.0)
        direction_eye = normalize(vec3((ndc + p[2].xy) / scale, -1.0));
    else
        origin_eye.xy = (ndc - p[3].xy) / scale;

    float start = 0.0;
    float limit = NOWHERE;
#if HAS_CUT
    start = viewpointCut.x / -direction_eye.z;
    limit = viewpointCut.y / -direction_eye.z;
#endif
#if HAS_OPAQUE
    limit = min(limit, opaque_distance(direction_eye));
#endif
    /* PLUG: volume_begin (origin_eye, direction_eye, start, limit) */

    vec4 accumulated = vec4(0.0);
#if PLUG_USED(volume_ray_end)
    float depth = NOWHERE;
#endif
    float t = NOWHERE;
#if MIXES
    bool ended = false;
    /* PLUG: volume_first (t) */
    /* Between two neighbouring entries and exits the set of volumes does not change: steps never
     * straddle one, and what does not overlap along this ray is met in order along this ray. */
    while (t < NOWHERE && !ended) { /* t grows from one entry or exit to the next */
#endif
        float t_next = NOWHERE;
        float step_length = NOWHERE;
        /* PLUG: volume_part (t, t_next, step_length) */
#if MIXES
        if (t_next >= NOWHERE)
            break;
        int steps = step_length < NOWHERE ? step_count(t_next - t, step_length) : 0;
#if HAS_EVENTS
        steps = max(steps, 1);
#endif
#else
        int steps = step_count(t_next - t, step_length);
#endif
        for (int i = 0; i < steps; i++) {
            float from = t + float(i) * step_length;
#if HAS_EVENTS
            float to = i == steps - 1 ? t_next : t + float(i + 1) * step_length;
            /* PLUG: volume_look (from, to, origin_eye, direction_eye) */
            /* a surface splits the step: what is before it, the surface itself, what is behind */
            for (int part = 0; part < MOST_EVENTS; part++) {
                float event = NOWHERE;
                /* PLUG: volume_event (event) */
                float span = min(event, to) - from;
#else
            /* the last step is shortened: lengths add up to the part */
            float span = i == steps - 1 ? t_next - from : step_length;
#endif
            float t_middle = from + 0.5 * span;
            VolumeSample s;
            vec4 color;
#if HAS_STEPS
#if MIXES
#if HAS_EVENTS
            if (span > 0.0) {
#endif
            VolumeMix mixed = VolumeMix(vec3(0.0), 0.0, vec3(0.0), 0.0);
            /* PLUG: volume_mix (mixed, t_middle, span, origin_eye, direction_eye) */
            color = volume_mix_color(mixed);
#if READS(position_eye)
            s.position_eye = origin_eye + t_middle * direction_eye;
#endif
#if READS(step_length)
            s.step_length = span;
#endif
#if READS(volume)
            s.volume = -1;
#endif
#else
            /* PLUG: volume_step (color, s, t_middle, span, origin_eye, direction_eye) */
#endif
            /* PLUG: volume_composite (accumulated, color, s) */
#if PLUG_USED(volume_ray_end)
            if (depth >= NOWHERE && accumulated.a > 0.0)
                depth = t_middle;
#endif
#if MIXES && HAS_EVENTS
            }
#endif
#endif
#if HAS_EVENTS
                if (event > to)
                    break;
                bool met = false;
                /* PLUG: volume_meet (met, color, s, event, origin_eye, direction_eye) */
                if (!met)
                    break;
                /* PLUG: volume_composite (accumulated, color, s) */
#if PLUG_USED(volume_ray_end)
                if (depth >= NOWHERE && accumulated.a > 0.0)
                    depth = event;
#endif
                from = max(from, event);
#if EARLY_END
                if (1.0 - accumulated.a < transparencyLeft)
                    break;
#endif
            }
#endif
#if EARLY_END
            if (1.0 - accumulated.a < transparencyLeft)
                break;
#endif
        }
#if MIXES
#if EARLY_END
        ended = 1.0 - accumulated.a < transparencyLeft;
#endif
        t = t_next;
    }
#endif
    /* PLUG: volume_ray_end (accumulated, depth) */
    plugray_FragColor = accumulated;
}
