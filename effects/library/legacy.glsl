/* What the built-in names of old GLSL stand for, in terms of the host's. The linker writes these
 * names in their place: plugs/words.def says which. */

/* A complete shader gets texture coordinates as they are in the geometry. */
const mat4 plugray_TextureMatrix[8] = mat4[8](mat4(1.0), mat4(1.0), mat4(1.0), mat4(1.0),
                                              mat4(1.0), mat4(1.0), mat4(1.0), mat4(1.0));

#define plugray_ModelViewProjectionMatrix (castle_ProjectionMatrix * castle_ModelViewMatrix)
#define plugray_ModelViewMatrixInverse inverse(castle_ModelViewMatrix)
#define plugray_ModelViewMatrixTranspose transpose(castle_ModelViewMatrix)
#define plugray_ModelViewMatrixInverseTranspose transpose(inverse(castle_ModelViewMatrix))
#define plugray_ProjectionMatrixInverse inverse(castle_ProjectionMatrix)
#define plugray_ModelViewProjectionMatrixInverse                                                   \
    inverse(castle_ProjectionMatrix * castle_ModelViewMatrix)

varying vec4 plugray_TexCoord[8];
varying vec4 plugray_FrontColor;
varying float plugray_FogFragCoord;

#ifdef PLUGRAY_VERTEX
#define plugray_Color castle_ColorPerVertex

vec4 plugray_ftransform() {
    return castle_ProjectionMatrix * (castle_ModelViewMatrix * castle_Vertex);
}
#else
#define plugray_Color plugray_FrontColor
#endif
