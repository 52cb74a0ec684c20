/* One channel of texture coordinates, castle_TexCoord<CHANNEL>, made only if a later stage reads it. UNIT:
 * which of the geometry's coordinates; BOX: its bounding box instead, from 0 to 1; PLANE: the two longest
 * sides of that; CENTER: the direction from the centre of the box, for cubes. EYE, NORMAL: what is attached
 * makes them from eye space, and from normals. */

#if CHANNEL == 0
#define TEX_COORD castle_TexCoord0
#if READS(castle_TexCoord0)
#define NEEDED
#endif
#elif CHANNEL == 1
#define TEX_COORD castle_TexCoord1
#if READS(castle_TexCoord1)
#define NEEDED
#endif
#elif CHANNEL == 2
#define TEX_COORD castle_TexCoord2
#if READS(castle_TexCoord2)
#define NEEDED
#endif
#elif CHANNEL == 3
#define TEX_COORD castle_TexCoord3
#if READS(castle_TexCoord3)
#define NEEDED
#endif
#elif CHANNEL == 4
#define TEX_COORD castle_TexCoord4
#if READS(castle_TexCoord4)
#define NEEDED
#endif
#elif CHANNEL == 5
#define TEX_COORD castle_TexCoord5
#if READS(castle_TexCoord5)
#define NEEDED
#endif
#elif CHANNEL == 6
#define TEX_COORD castle_TexCoord6
#if READS(castle_TexCoord6)
#define NEEDED
#endif
#elif CHANNEL == 7
#define TEX_COORD castle_TexCoord7
#if READS(castle_TexCoord7)
#define NEEDED
#endif
#endif

#ifdef BOX
#define GIVEN plugray_BoxCoord
#elif defined(PLANE)
#define GIVEN plugray_PlaneCoord
#elif defined(CENTER)
/* r of the box runs towards -z */
#define GIVEN vec4((2.0 * plugray_BoxCoord.stp - 1.0) * vec3(1.0, 1.0, -1.0), 1.0)
#elif UNIT == 0
#define GIVEN castle_MultiTexCoord0
#elif UNIT == 1
#define GIVEN castle_MultiTexCoord1
#elif UNIT == 2
#define GIVEN castle_MultiTexCoord2
#elif UNIT == 3
#define GIVEN castle_MultiTexCoord3
#elif UNIT == 4
#define GIVEN castle_MultiTexCoord4
#elif UNIT == 5
#define GIVEN castle_MultiTexCoord5
#elif UNIT == 6
#define GIVEN castle_MultiTexCoord6
#elif UNIT == 7
#define GIVEN castle_MultiTexCoord7
#endif

#ifdef NEEDED
#ifdef NORMAL
void PLUG_vertex_eye_space(const in vec4 vertex_eye, const in vec3 normal_eye) {
    vec4 tex_coord;
    /* PLUG: texture_coord_generate (tex_coord, vertex_eye, normal_eye) */
    /* PLUG: texture_coord_transform (tex_coord) */
    TEX_COORD = tex_coord;
}
#elif defined(EYE)
void PLUG_vertex_place(const in vec4 vertex_eye) {
    vec4 tex_coord;
    /* PLUG: texture_coord_generate (tex_coord, vertex_eye) */
    /* PLUG: texture_coord_transform (tex_coord) */
    TEX_COORD = tex_coord;
}
#else
void PLUG_vertex_attributes() {
    vec4 tex_coord = GIVEN;
    /* PLUG: texture_coord_generate (tex_coord) */
    /* PLUG: texture_coord_transform (tex_coord) */
    TEX_COORD = tex_coord;
}
#endif
#endif
