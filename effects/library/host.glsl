/* What the host gives to every program that asks for it. None of these is ever renamed; an effect
 * may declare any of them again, with the same type. */

/* Of the geometry. */
#ifdef PLUGRAY_VERTEX
in vec4 castle_Vertex;
in vec3 castle_Normal;
in vec4 castle_Tangent;
in vec4 castle_ColorPerVertex;
in vec4 castle_MultiTexCoord0;
in vec4 castle_MultiTexCoord1;
in vec4 castle_MultiTexCoord2;
in vec4 castle_MultiTexCoord3;
in vec4 castle_MultiTexCoord4;
in vec4 castle_MultiTexCoord5;
in vec4 castle_MultiTexCoord6;
in vec4 castle_MultiTexCoord7;
/* Made from the bounding box, whatever the geometry has: all of it, and its two longest sides. */
in vec4 plugray_BoxCoord;
in vec4 plugray_PlaneCoord;
in float castle_FogCoord;
in float plugray_LineDistance;
#endif

/* Texture coordinates, generated and transformed: those of the textures of the Appearance in their order. */
varying vec4 castle_TexCoord0;
varying vec4 castle_TexCoord1;
varying vec4 castle_TexCoord2;
varying vec4 castle_TexCoord3;
varying vec4 castle_TexCoord4;
varying vec4 castle_TexCoord5;
varying vec4 castle_TexCoord6;
varying vec4 castle_TexCoord7;

/* Of the shape: object space to eye space, normals too, and eye space to clip space. */
uniform mat4 castle_ModelViewMatrix;
uniform mat4 castle_ProjectionMatrix;
uniform mat3 castle_NormalMatrix;

/* Of the picture. Model: object to world; view: world to eye; projection: eye to clip space. */
uniform mat4 plugray_ModelMatrix;
uniform mat4 plugray_ViewMatrix;
uniform mat4 plugray_ModelViewMatrix;
uniform mat4 plugray_ProjectionMatrix;
uniform mat3 plugray_NormalMatrix;
uniform mat4 plugray_InverseModelMatrix;
uniform mat4 plugray_InverseViewMatrix;
uniform mat4 plugray_InverseModelViewMatrix;
uniform mat4 plugray_InverseProjectionMatrix;
uniform float plugray_Time;        /* seconds */
uniform vec2 plugray_ViewportSize; /* pixels */
