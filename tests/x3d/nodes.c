#include "tests/tap.h"

#include <plugray/x3d.h>

#include "x3d/nodes.h"

/* Written by hand from ISO/IEC 19775-1: the table must say the same. */
static const struct {
    const char *node, *field;
    plr_type type;
    plr_access access;
    const char *initial;
    double minimum, maximum;
    bool open_minimum, open_maximum;
} spots[] = {
#define IO PLR_INPUT_OUTPUT
#define I PLR_INITIALIZE_ONLY
#define IN PLR_INPUT_ONLY
#define OUT PLR_OUTPUT_ONLY
#define ANY -INFINITY, INFINITY, false, false
#define UNIT 0, 1, false, false
#define POSITIVE 0, INFINITY, true, false
#define NOT_NEGATIVE 0, INFINITY, false, false
    {"Transform", "translation", PLR_SFVEC3F, IO, "0 0 0", ANY},
    {"Transform", "rotation", PLR_SFROTATION, IO, "0 0 1 0", ANY},
    {"Transform", "scale", PLR_SFVEC3F, IO, "1 1 1", ANY},
    {"Transform", "children", PLR_MFNODE, IO, "", ANY},
    {"Group", "bboxSize", PLR_SFVEC3F, I, "-1 -1 -1", -1, INFINITY, false, false},
    {"Group", "addChildren", PLR_MFNODE, IN, "", ANY},
    {"StaticGroup", "children", PLR_MFNODE, I, "", ANY},
    {"Switch", "whichChoice", PLR_SFINT32, IO, "-1", -1, INFINITY, false, false},
    {"LOD", "level_changed", PLR_SFINT32, OUT, "-1", ANY},
    {"Inline", "load", PLR_SFBOOL, IO, "TRUE", ANY},
    {"Anchor", "parameter", PLR_MFSTRING, IO, "", ANY},
    {"Material", "ambientIntensity", PLR_SFFLOAT, IO, "0.2", UNIT},
    {"Material", "diffuseColor", PLR_SFCOLOR, IO, "0.8 0.8 0.8", UNIT},
    {"Material", "emissiveColor", PLR_SFCOLOR, IO, "0 0 0", UNIT},
    {"Material", "shininess", PLR_SFFLOAT, IO, "0.2", UNIT},
    {"Material", "transparency", PLR_SFFLOAT, IO, "0", UNIT},
    {"UnlitMaterial", "emissiveColor", PLR_SFCOLOR, IO, "1 1 1", UNIT},
    {"PhysicalMaterial", "metallic", PLR_SFFLOAT, IO, "1", UNIT},
    {"Appearance", "alphaMode", PLR_SFSTRING, IO, "\"AUTO\"", ANY},
    {"LineProperties", "linetype", PLR_SFINT32, IO, "1", 1, INFINITY, false, false},
    {"Box", "size", PLR_SFVEC3F, I, "2 2 2", POSITIVE},
    {"Sphere", "radius", PLR_SFFLOAT, I, "1", POSITIVE},
    {"Cone", "bottomRadius", PLR_SFFLOAT, I, "1", POSITIVE},
    {"Cylinder", "height", PLR_SFFLOAT, I, "2", POSITIVE},
    {"ElevationGrid", "xDimension", PLR_SFINT32, I, "0", NOT_NEGATIVE},
    {"Extrusion", "crossSection", PLR_MFVEC2F, I, "[1 1 1 -1 -1 -1 -1 1 1 1]", ANY},
    {"Extrusion", "spine", PLR_MFVEC3F, I, "[0 0 0 0 1 0]", ANY},
    {"IndexedFaceSet", "creaseAngle", PLR_SFFLOAT, I, "0", NOT_NEGATIVE},
    {"IndexedFaceSet", "coordIndex", PLR_MFINT32, I, "", -1, INFINITY, false, false},
    {"IndexedFaceSet", "set_colorIndex", PLR_MFINT32, IN, "", ANY},
    {"IndexedFaceSet", "solid", PLR_SFBOOL, I, "TRUE", ANY},
    {"TriangleStripSet", "stripCount", PLR_MFINT32, IO, "", 3, INFINITY, false, false},
    {"ColorRGBA", "color", PLR_MFCOLORRGBA, IO, "", UNIT},
    {"ClipPlane", "plane", PLR_SFVEC4F, IO, "0 1 0 0", ANY},
    {"DirectionalLight", "direction", PLR_SFVEC3F, IO, "0 0 -1", ANY},
    {"DirectionalLight", "global", PLR_SFBOOL, IO, "FALSE", ANY},
    {"PointLight", "global", PLR_SFBOOL, IO, "TRUE", ANY},
    {"PointLight", "attenuation", PLR_SFVEC3F, IO, "1 0 0", NOT_NEGATIVE},
    {"SpotLight", "radius", PLR_SFFLOAT, IO, "100", NOT_NEGATIVE},
    {"SpotLight", "cutOffAngle", PLR_SFFLOAT, IO, "1.570796", 0, 1.5708, true, false},
    {"Viewpoint", "position", PLR_SFVEC3F, IO, "0 0 10", ANY},
    {"Viewpoint", "fieldOfView", PLR_SFFLOAT, IO, "0.785398", 0, 3.1416, true, true},
    {"OrthoViewpoint", "fieldOfView", PLR_MFFLOAT, IO, "[-1 -1 1 1]", ANY},
    {"NavigationInfo", "avatarSize", PLR_MFFLOAT, IO, "[0.25 1.6 0.75]", NOT_NEGATIVE},
    {"NavigationInfo", "type", PLR_MFSTRING, IO, "[\"EXAMINE\" \"ANY\"]", ANY},
    {"NavigationInfo", "headlight", PLR_SFBOOL, IO, "TRUE", ANY},
    {"Background", "skyColor", PLR_MFCOLOR, IO, "[0 0 0]", UNIT},
    {"Background", "transparency", PLR_SFFLOAT, IO, "0", UNIT},
    {"Fog", "visibilityRange", PLR_SFFLOAT, IO, "0", NOT_NEGATIVE},
    {"Fog", "fogType", PLR_SFSTRING, IO, "\"LINEAR\"", ANY},
    {"ImageTexture", "repeatS", PLR_SFBOOL, I, "TRUE", ANY},
    {"ImageTexture3D", "repeatR", PLR_SFBOOL, I, "FALSE", ANY},
    {"PixelTexture", "image", PLR_SFIMAGE, IO, "0 0 0", ANY},
    {"PixelTexture3D", "image", PLR_MFINT32, IO, "[0 0 0 0]", ANY},
    {"TextureProperties", "anisotropicDegree", PLR_SFFLOAT, IO, "1", 1, INFINITY, false, false},
    {"TextureProperties", "boundaryModeS", PLR_SFSTRING, IO, "\"REPEAT\"", ANY},
    {"TextureTransformMatrix3D", "matrix", PLR_SFMATRIX4F, IO, "1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1",
     ANY},
    {"ShaderPart", "type", PLR_SFSTRING, I, "\"VERTEX\"", ANY},
    {"FloatVertexAttribute", "numComponents", PLR_SFINT32, I, "4", 1, 4, false, false},
    {"VolumeData", "dimensions", PLR_SFVEC3F, IO, "1 1 1", POSITIVE},
    {"VolumeData", "voxels", PLR_SFNODE, IO, "", ANY},
    {"SegmentedVolumeData", "segmentEnabled", PLR_MFBOOL, IO, "", ANY},
    {"IsoSurfaceVolumeData", "surfaceTolerance", PLR_SFFLOAT, IO, "0", NOT_NEGATIVE},
    {"BlendedVolumeStyle", "weightConstant1", PLR_SFFLOAT, IO, "0.5", UNIT},
    {"BoundaryEnhancementVolumeStyle", "boundaryOpacity", PLR_SFFLOAT, IO, "0.9", NOT_NEGATIVE},
    {"CartoonVolumeStyle", "colorSteps", PLR_SFINT32, IO, "4", 1, 64, false, false},
    {"CartoonVolumeStyle", "orthogonalColor", PLR_SFCOLORRGBA, IO, "1 1 1 1", UNIT},
    {"EdgeEnhancementVolumeStyle", "gradientThreshold", PLR_SFFLOAT, IO, "0.4", 0, 1.5708, false,
     false},
    {"ProjectionVolumeStyle", "type", PLR_SFSTRING, IO, "\"MAX\"", ANY},
    {"ShadedVolumeStyle", "phaseFunction", PLR_SFSTRING, I, "\"Henyey-Greenstein\"", ANY},
    {"SilhouetteEnhancementVolumeStyle", "silhouetteSharpness", PLR_SFFLOAT, IO, "0.5",
     NOT_NEGATIVE},
    {"ToneMappedVolumeStyle", "warmColor", PLR_SFCOLORRGBA, IO, "1 1 0 0", UNIT},
    {"TimeSensor", "cycleInterval", PLR_SFTIME, IO, "1", POSITIVE},
    {"TimeSensor", "fraction_changed", PLR_SFFLOAT, OUT, "0", ANY},
    {"ProximitySensor", "size", PLR_SFVEC3F, IO, "0 0 0", NOT_NEGATIVE},
    {"PositionInterpolator", "value_changed", PLR_SFVEC3F, OUT, "0 0 0", ANY},
    {"GeoViewpoint", "position", PLR_SFVEC3D, IO, "0 0 100000", ANY},
    {"HAnimJoint", "stiffness", PLR_MFFLOAT, IO, "[0 0 0]", UNIT},
    {"NurbsCurve", "order", PLR_SFINT32, I, "3", 2, INFINITY, false, false},
    {"ScalarDamper", "tau", PLR_SFTIME, IO, "0.3", NOT_NEGATIVE},
    {"RigidBody", "mass", PLR_SFFLOAT, IO, "1", POSITIVE},
    {"FontStyle", "justify", PLR_MFSTRING, IO, "[\"BEGIN\"]", ANY},
};
#undef IO
#undef I
#undef IN
#undef OUT
#undef ANY
#undef UNIT
#undef POSITIVE
#undef NOT_NEGATIVE

static const plr_field_info *find(const char *node, const char *field) {
    const plr_node_info *info = plr_node_info_find(node);
    for (size_t i = 0; info && i < info->field_count; i++)
        if (strcmp(info->fields[i].name, field) == 0)
            return &info->fields[i];
    return NULL;
}

static void test_spots(void) {
    for (size_t i = 0; i < sizeof spots / sizeof *spots; i++) {
        const plr_field_info *field = find(spots[i].node, spots[i].field);
        bool bounds =
            field && !(field->minimum < spots[i].minimum) && !(field->minimum > spots[i].minimum) &&
            !(field->maximum < spots[i].maximum) && !(field->maximum > spots[i].maximum) &&
            field->exclusive_minimum == spots[i].open_minimum &&
            field->exclusive_maximum == spots[i].open_maximum;
        TAP_RESULT(field && field->type == spots[i].type && field->access == spots[i].access &&
                       strcmp(field->initial, spots[i].initial) == 0 && !field->extension,
                   "%s.%s is of the type, access and default of the standard", spots[i].node,
                   spots[i].field);
        TAP_RESULT(bounds, "%s.%s has the range of the standard", spots[i].node, spots[i].field);
    }
}

/* One word of a blank-separated list is copied to `word`; returns what follows, NULL at the end. */
static const char *next_word(const char *list, char word[100]) {
    list += strspn(list, " ");
    size_t length = strcspn(list, " ");
    if (length == 0 || length >= 100)
        return NULL;
    memcpy(word, list, length);
    word[length] = 0;
    return list + length;
}

static bool is_known_type(const char *name) {
    if (plr_node_info_find(name))
        return true;
    for (size_t i = 0; i < plr_node_info_count(); i++)
        if (plr_node_info_is(plr_node_info_at(i), name))
            return true;
    return false;
}

static int unknown_types(const plr_node_info *info, const plr_field_info *field) {
    int unknown = 0;
    char word[100];
    for (const char *rest = field->nodes; (rest = next_word(rest, word));)
        if (!is_known_type(word)) {
            printf("# %s.%s: no node is a %s\n", info->name, field->name, word);
            unknown++;
        }
    return unknown;
}

static bool is_in_range(const plr_field_info *field, double number) {
    return (field->exclusive_minimum ? number > field->minimum : number >= field->minimum) &&
           (field->exclusive_maximum ? number < field->maximum : number <= field->maximum);
}

/* Reads one item of a default: a number in range, TRUE, FALSE or a string; NULL if it is none. */
static const char *skip_item(const plr_field_info *field, const char *text) {
    plr_kind kind = plr_type_kind(field->type);
    if (kind == PLR_STRING) {
        const char *end = *text == '"' ? strchr(text + 1, '"') : NULL;
        return end ? end + 1 : NULL;
    }
    if (kind == PLR_BOOL)
        return strncmp(text, "TRUE", 4) == 0    ? text + 4
               : strncmp(text, "FALSE", 5) == 0 ? text + 5
                                                : NULL;
    char *end;
    double number = strtod(text, &end);
    bool read = kind != PLR_NODE && end != text;
    bool generated = field->access == PLR_OUTPUT_ONLY || field->access == PLR_INPUT_ONLY;
    if (read && kind == PLR_INT)
        read = number >= -2147483648.0 && number <= 2147483647.0 &&
               !memchr(text, '.', (size_t)(end - text));
    return read && (generated || is_in_range(field, number)) ? end : NULL;
}

/* Whether the default is a value of the type: "" only for NULL and empty lists, brackets for lists.
 */
static bool is_good_default(const plr_field_info *field) {
    const char *text = field->initial;
    bool list = plr_type_is_multiple(field->type);
    if (!*text)
        return list || field->type == PLR_SFNODE;
    if (list && *text++ != '[')
        return false;
    int items = 0;
    while (*text && *text != ']') {
        text = skip_item(field, text);
        if (!text)
            return false;
        text += strspn(text, " ");
        items++;
    }
    if (list)
        return strcmp(text, "]") == 0 && items % plr_type_components(field->type) == 0;
    return !*text && items == (field->type == PLR_SFIMAGE ? 3 : plr_type_components(field->type));
}

static int faults_of_field(const plr_node_info *info, size_t index) {
    const plr_field_info *field = &info->fields[index];
    int faults = unknown_types(info, field);
    for (size_t i = 0; i < index; i++)
        if (strcmp(info->fields[i].name, field->name) == 0) {
            printf("# %s.%s is there twice\n", info->name, field->name);
            faults++;
        }
    if ((plr_type_kind(field->type) == PLR_NODE) != (*field->nodes != 0)) {
        printf("# %s.%s: types of nodes are for fields of nodes\n", info->name, field->name);
        faults++;
    }
    if (!(field->minimum < field->maximum)) {
        printf("# %s.%s: no value is in its range\n", info->name, field->name);
        faults++;
    }
    if (!is_good_default(field)) {
        printf("# %s.%s: %s is no value of it\n", info->name, field->name, field->initial);
        faults++;
    }
    if (field->dialect_2005 && !field->extension) {
        printf("# %s.%s: what is of 2005 alone is no standard\n", info->name, field->name);
        faults++;
    }
    return faults;
}

static int faults_of_bases(const plr_node_info *info) {
    char word[100];
    int faults = !plr_node_info_is(info, "X3DNode");
    for (const char *rest = info->bases; (rest = next_word(rest, word));)
        if (strncmp(word, "X3D", 3) != 0) {
            printf("# %s: %s is no abstract type\n", info->name, word);
            faults++;
        }
    return faults;
}

/* Whether any node has a field of that name that takes nodes. */
static bool is_container(const char *name) {
    for (size_t i = 0; i < plr_node_info_count(); i++) {
        const plr_field_info *field = find(plr_node_info_at(i)->name, name);
        if (field && plr_type_kind(field->type) == PLR_NODE)
            return true;
    }
    return false;
}

static void test_table(void) {
    int names = 0, fields = 0, bases = 0, containers = 0;
    for (size_t i = 0; i < plr_node_info_count(); i++) {
        const plr_node_info *info = plr_node_info_at(i);
        for (size_t k = 0; k < i; k++)
            names += strcmp(plr_node_info_at(k)->name, info->name) == 0;
        names += plr_node_info_find(info->name) != info;
        for (size_t k = 0; k < info->field_count; k++)
            fields += faults_of_field(info, k);
        bases += faults_of_bases(info);
        if (!is_container(info->container_field)) {
            printf("# %s: no field %s takes nodes\n", info->name, info->container_field);
            containers++;
        }
    }
    CHECK(plr_node_info_count() > 250);
    CHECK_INT(names, 0);
    CHECK_INT(fields, 0);
    CHECK_INT(bases, 0);
    CHECK_INT(containers, 0);
    CHECK(plr_node_info_at(plr_node_info_count()) == NULL);
    CHECK(plr_node_info_find("NoSuchNode") == NULL);
    CHECK(plr_node_info_find("transform") == NULL);
}

static void test_aliases(void) {
    int faults = 0;
    for (const x3d_alias *alias = x3d_node_aliases(); alias->alias; alias++)
        faults += strcmp(plr_node_info_find(alias->alias)->name, alias->name) != 0;
    CHECK_INT(faults, 0);
    for (const x3d_alias *alias = x3d_field_aliases(); alias->alias; alias++) {
        bool good = find(alias->node, alias->name) && !find(alias->node, alias->alias);
        TAP_RESULT(good, "%s.%s is another name of %s", alias->node, alias->alias, alias->name);
    }
    CHECK_STR(plr_node_info_find("CompositeVolumeStyle")->name, "ComposedVolumeStyle");
    CHECK_STR(plr_node_info_find("KambiAppearance")->name, "Appearance");
    CHECK_STR(plr_node_info_find("ISOVolumeStyle")->name, "ISOSurfaceVolumeStyle");
}

static void test_types(void) {
    CHECK(plr_node_info_is(plr_node_info_find("Box"), "X3DGeometryNode"));
    CHECK(!plr_node_info_is(plr_node_info_find("Box"), "X3DChildNode"));
    CHECK(!plr_node_info_is(plr_node_info_find("Box"), "X3DGeometry"));
    CHECK(plr_node_info_is(plr_node_info_find("Effect"), "X3DChildNode"));
    CHECK(plr_node_info_is(plr_node_info_find("Fog"), "X3DBindableNode"));
    CHECK(plr_node_info_is(plr_node_info_find("ImageTextureAtlas"), "X3DTexture3DNode"));
    /* a projection cannot be a member of a composed style */
    const plr_field_info *member = find("ComposedVolumeStyle", "renderStyle");
    CHECK(!x3d_allows(member, plr_node_info_find("ProjectionVolumeStyle")));
    CHECK(x3d_allows(member, plr_node_info_find("CartoonVolumeStyle")));
    CHECK(x3d_allows(find("Transform", "children"), plr_node_info_find("Effect")));
}

/* Every light, texture, volume and appearance takes effects, and no group does. */
static void test_effects(void) {
    static const char *const owners[] = {"X3DLightNode", "X3DTextureNode", "X3DVolumeDataNode",
                                         "X3DAppearanceNode"};
    int faults = 0;
    for (size_t i = 0; i < plr_node_info_count(); i++) {
        const plr_node_info *info = plr_node_info_at(i);
        const plr_field_info *effects = find(info->name, "effects");
        for (size_t k = 0; k < sizeof owners / sizeof *owners; k++)
            faults += plr_node_info_is(info, owners[k]) && !effects;
        faults += plr_node_info_is(info, "X3DGroupingNode") && effects;
        if (effects)
            faults += effects->type != PLR_MFNODE || strcmp(effects->nodes, "Effect") != 0;
    }
    CHECK_INT(faults, 0);
    CHECK(plr_node_info_find("Effect")->author_fields);
    CHECK(plr_node_info_find("ComposedShader")->author_fields);
    CHECK(plr_node_info_find("Script")->author_fields);
    CHECK(!plr_node_info_find("EffectPart")->author_fields);
    CHECK_STR(find("Effect", "placement")->initial, "\"ADD_AFTER\"");
    CHECK_STR(find("Effect", "target")->initial, "\"\"");
    CHECK_STR(find("Effect", "onlyIfActive")->initial, "FALSE");
}

static void test_dialect(void) {
    CHECK(find("SegmentedVolumeData", "segmentedVoxels")->dialect_2005);
    CHECK(find("SilhouetteEnhancementVolumeStyle", "silhouetteFactor")->dialect_2005);
    CHECK(find("BoundaryEnhancementVolumeStyle", "gradientColor")->dialect_2005);
    CHECK(plr_node_info_find("StippleVolumeStyle")->dialect_2005);
    CHECK(plr_node_info_find("OctTree")->dialect_2005);
    CHECK(!plr_node_info_find("VolumeData")->dialect_2005);
    CHECK(!find("ComposedVolumeStyle", "ordered")->dialect_2005);
    bool composite = false;
    for (const x3d_alias *alias = x3d_node_aliases(); alias->alias; alias++)
        composite |= strcmp(alias->alias, "CompositeVolumeStyle") == 0 && alias->dialect_2005;
    CHECK(composite);
}

int main(void) {
    test_spots();
    test_table();
    test_aliases();
    test_types();
    test_effects();
    test_dialect();
    return tap_done();
}
