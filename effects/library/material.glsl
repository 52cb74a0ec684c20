/* What a light needs to know of the surface or the voxel that it falls on. */
struct MaterialInfo {
    vec3 ambient;    /* already ambientIntensity * diffuse colour */
    vec3 diffuse;
    vec3 specular;
    float shininess; /* the exponent itself: 128 times X3D's value */
};
