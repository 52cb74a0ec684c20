/* More opaque where the surface is seen edge-on. ISO/IEC 19775-1 V4 41.4.11:
 *
 *     Og = Ov (ksc + kss (1 - |n.V|)^kse)
 *
 * with silhouetteRetainedOpacity, silhouetteBoundaryOpacity and silhouetteSharpness. The proposal of 2005
 * (4.9) is the same with 0, 1 and its silhouetteFactor. Where there is no normal nothing changes. */

uniform float silhouetteRetainedOpacity = 1.0;
uniform float silhouetteBoundaryOpacity = 0.0;
uniform float silhouetteSharpness = 0.5;

void PLUG_volume_shade(inout vec4 color, const in VolumeSample s) {
    vec3 normal = style_normal(s);
    if (normal == vec3(0.0))
        return;
    float edge = style_power(1.0 - abs(style_facing(s, normal)), silhouetteSharpness);
    float factor = silhouetteRetainedOpacity + silhouetteBoundaryOpacity * edge;
    color.a = min(color.a * factor, 1.0);
}
