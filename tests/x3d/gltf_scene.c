/* glTF: the tree of nodes, cameras, lights, materials, textures and names. */
#include "gltf_text.h"

#define TRIANGLE                                                                                   \
    "'meshes':[{'primitives':[{'attributes':{'POSITION':0,'TEXCOORD_0':1,'TEXCOORD_1':2},"         \
    "'material':0}]}],'bufferViews':[{'buffer':0,'byteLength':36},{'buffer':0,'byteOffset':36,"    \
    "'byteLength':24}],'accessors':[{'bufferView':0,'count':3,'componentType':5126,'type':'VEC3'}" \
    ",{'bufferView':1,'count':3,'componentType':5126,'type':'VEC2'},{'bufferView':0,'count':3,"    \
    "'componentType':5126,'type':'VEC2'}],"

static bytes triangle(void) {
    bytes b = {0};
    PUT_FLOATS(&b, 0, 0, 0, 1, 0, 0, 0, 1, 0);
    PUT_FLOATS(&b, 0, 0, 1, 0, 0.25F, 0.5F);
    return b;
}

static plr_scene *with_material(const char *what, const char *material, const char *faults) {
    char body[4096];
    bytes b = triangle();
    snprintf(body, sizeof body,
             TRIANGLE "'nodes':[{'mesh':0}],'scenes':[{'nodes':[0]}],"
                      "'materials':[%s],'textures':[{'source':0,'sampler':0},{'source':1,"
                      "'sampler':1},{'source':0}],'images':[{'uri':'a%%20b.png','name':'picture'},"
                      "{'bufferView':0,'mimeType':'image/png'}],"
                      "'samplers':[{'wrapS':33071,'wrapT':10497},{'wrapS':33648,'magFilter':9728,"
                      "'minFilter':9987}]",
             material);
    return check_body(what, &b, body, faults, NULL);
}

/* ---- Materials ---- */

static void test_factors(void) {
    plr_scene *scene =
        with_material("factors",
                      "{'name':'paint','pbrMetallicRoughness':{'baseColorFactor':[0.5,0.25,1,0.75],"
                      "'metallicFactor':0.5,'roughnessFactor':0.25},'emissiveFactor':[0.5,1,0],"
                      "'extensions':{'KHR_materials_emissive_strength':{'emissiveStrength':4}},"
                      "'alphaMode':'MASK','alphaCutoff':0.3,'doubleSided':true}",
                      "");
    const plr_node *material = first_of(scene, "PhysicalMaterial");
    CHECK_NUMBERS(material, "baseColor", 0.5, 0.25, 1);
    CHECK_NUMBERS(material, "transparency", 0.25);
    CHECK_NUMBERS(material, "metallic", 0.5);
    CHECK_NUMBERS(material, "roughness", 0.25);
    CHECK_NUMBERS(material, "emissiveColor", 2, 4, 0);
    CHECK_STR(plr_node_def(material), "paint");
    const plr_node *appearance = first_of(scene, "Appearance");
    CHECK_STR(plr_node_string(appearance, "alphaMode"), "MASK");
    CHECK_NUMBERS(appearance, "alphaCutoff", 0.3);
    CHECK(!plr_node_bool(first_of(scene, "TriangleSet"), "solid"));
    plr_scene_destroy(&scene);

    scene = with_material("defaults", "{}", "");
    material = first_of(scene, "PhysicalMaterial");
    CHECK_NUMBERS(material, "metallic", 1);
    CHECK_NUMBERS(material, "transparency", 0);
    CHECK_STR(plr_node_string(first_of(scene, "Appearance"), "alphaMode"), "OPAQUE");
    CHECK(plr_node_bool(first_of(scene, "TriangleSet"), "solid"));
    /* without a texture the first set stands ready for effects; v runs the other way */
    CHECK_NUMBERS(first_of(scene, "TextureCoordinate"), "point", 0, 1, 1, 1, 0.25, 0.5);
    plr_scene_destroy(&scene);
}

static void test_unlit(void) {
    plr_scene *scene = with_material(
        "an unlit material",
        "{'extensions':{'KHR_materials_unlit':{}},'pbrMetallicRoughness':{'baseColorFactor':"
        "[0.5,0.25,1,0.5],'baseColorTexture':{'index':0},'metallicFactor':0.5},"
        "'normalTexture':{'index':0},'emissiveFactor':[1,1,1],'alphaMode':'BLEND'}",
        "");
    const plr_node *material = first_of(scene, "UnlitMaterial");
    CHECK_NUMBERS(material, "emissiveColor", 0.5, 0.25, 1);
    CHECK_NUMBERS(material, "transparency", 0.5);
    CHECK(plr_node_is(plr_node_child(material, "emissiveTexture"), "ImageTexture"));
    CHECK(!plr_node_child(material, "normalTexture"));
    CHECK_STR(plr_node_string(first_of(scene, "Appearance"), "alphaMode"), "BLEND");
    plr_scene_destroy(&scene);
}

static void test_textures(void) {
    plr_scene *scene = with_material(
        "textures",
        "{'pbrMetallicRoughness':{'baseColorTexture':{'index':0},"
        "'metallicRoughnessTexture':{'index':1}},'normalTexture':{'index':0,'scale':0.5},"
        "'occlusionTexture':{'index':1,'strength':0.25},'emissiveTexture':{'index':2}}",
        "");
    const plr_node *material = first_of(scene, "PhysicalMaterial");
    const plr_node *base = plr_node_child(material, "baseTexture");
    CHECK(base && base == plr_node_child(material, "normalTexture"));
    CHECK_STR(plr_node_def(base), "picture");
    CHECK_STR(plr_node_string(base, "url"), "a b.png");
    CHECK(!plr_node_bool(base, "repeatS") && plr_node_bool(base, "repeatT"));
    CHECK(!plr_node_child(base, "textureProperties"));
    CHECK_NUMBERS(material, "normalScale", 0.5);
    const plr_node *data = plr_node_child(material, "metallicRoughnessTexture");
    CHECK(data && data == plr_node_child(material, "occlusionTexture"));
    CHECK_STR(plr_node_string(data, "url"), "data:image/png;base64,"
                                            "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA");
    const plr_node *properties = plr_node_child(data, "textureProperties");
    CHECK_STR(plr_node_string(properties, "boundaryModeS"), "MIRRORED_REPEAT");
    CHECK_STR(plr_node_string(properties, "boundaryModeT"), "REPEAT");
    CHECK_STR(plr_node_string(properties, "magnificationFilter"), "NEAREST_PIXEL");
    CHECK_STR(plr_node_string(properties, "minificationFilter"), "AVG_PIXEL_AVG_MIPMAP");
    CHECK(plr_node_bool(properties, "generateMipMaps"));
    CHECK_NUMBERS(material, "occlusionStrength", 0.25);
    const plr_node *glow = plr_node_child(material, "emissiveTexture");
    CHECK(glow && glow != base && plr_node_bool(glow, "repeatS"));
    CHECK_STR(plr_node_string(material, "baseTextureMapping"), "");
    plr_scene_destroy(&scene);
}

/* Base colour by set 0, emission by set 1, occlusion by set 0 moved: three lists of coordinates,
 * which the material finds by name. */
static void test_sets(void) {
    plr_scene *scene = with_material(
        "sets of coordinates",
        "{'pbrMetallicRoughness':{'baseColorTexture':{'index':0}},'emissiveTexture':{'index':0,"
        "'texCoord':1},'occlusionTexture':{'index':0,'texCoord':1,'extensions':{"
        "'KHR_texture_transform':{'texCoord':0,'offset':[0,1],'rotation':1.57079632679489662,"
        "'scale':[0.5,0.5]}}}}",
        "");
    const plr_node *material = first_of(scene, "PhysicalMaterial");
    CHECK_STR(plr_node_string(material, "baseTextureMapping"), "set0");
    CHECK_STR(plr_node_string(material, "occlusionTextureMapping"), "set1");
    CHECK_STR(plr_node_string(material, "emissiveTextureMapping"), "set2");
    const plr_field *sets = plr_node_field(first_of(scene, "MultiTextureCoordinate"), "texCoord");
    CHECK_INT(sets->count, 3);
    CHECK_STR(plr_node_string(sets->value.nodes[1], "mapping"), "set1");
    CHECK_NUMBERS(sets->value.nodes[0], "point", 0, 1, 1, 1, 0.25, 0.5);
    /* the extension's own example: u' = v / 2, v' = 1 - u / 2, the lower left quadrant */
    CHECK_NUMBERS(sets->value.nodes[1], "point", 0, 0, 0, 0.5, 0.25, 0.125);
    CHECK_NUMBERS(sets->value.nodes[2], "point", 0, 1, 0, 0, 0, 1);
    plr_scene_destroy(&scene);
}

/* ---- Nodes ---- */

static void test_transforms(void) {
    plr_scene *scene = check_body(
        "transforms", NULL,
        "'scene':1,'scenes':[{'nodes':[3]},{'nodes':[0,2]}],'nodes':[{'name':'turned','children':"
        "[1],'translation':[1,2,3],'rotation':[0,0.6,0,0.8],'scale':[1,2,4]},"
        "{'name':'inner','rotation':[0,0,0,0]},"
        "{'matrix':[1,2,3,0,4,5,6,0,7,8,9,0,10,11,12,1]},{'name':'not in the scene'}]",
        "", NULL);
    CHECK_INT(plr_scene_root_count(scene), 2);
    const plr_node *turned = plr_scene_find(scene, "turned");
    CHECK_NUMBERS(turned, "translation", 1, 2, 3);
    CHECK_NUMBERS(turned, "rotation", 0, 1, 0, 1.287002217586);
    CHECK_NUMBERS(turned, "scale", 1, 2, 4);
    CHECK(plr_node_child(turned, "children") == plr_scene_find(scene, "inner"));
    CHECK_NUMBERS(plr_scene_find(scene, "inner"), "rotation", 0, 0, 1, 0);
    CHECK_NUMBERS(first_of(scene, "MatrixTransform"), "matrix", 1, 4, 7, 10, 2, 5, 8, 11, 3, 6, 9,
                  12, 0, 0, 0, 1);
    CHECK(!plr_scene_find(scene, "not in the scene"));
    plr_scene_destroy(&scene);
    scene = check_body("a document without scenes", NULL,
                       "'nodes':[{'name':'a'},{'name':'b','children':[0]},{'name':'c'}]", "", NULL);
    CHECK_INT(plr_scene_root_count(scene), 2);
    CHECK_STR(plr_node_def(plr_scene_root(scene, 0)), "b");
    plr_scene_destroy(&scene);
}

static void test_cameras(void) {
    plr_scene *scene = check_body(
        "cameras", NULL,
        "'scenes':[{'nodes':[0,1]}],'nodes':[{'camera':0,'translation':[0,0,5]},{'camera':1,"
        "'name':'from above'}],'cameras':[{'name':'eye','type':'perspective','perspective':{"
        "'yfov':0.5,'znear':0.25,'zfar':50}},{'type':'orthographic','orthographic':{'xmag':3,"
        "'ymag':2,'znear':0,'zfar':10}}]",
        "", NULL);
    const plr_node *eye = first_of(scene, "Viewpoint");
    CHECK_STR(plr_node_def(eye), "eye");
    CHECK_STR(plr_node_string(eye, "description"), "eye");
    CHECK_NUMBERS(eye, "position", 0, 0, 0);
    CHECK_NUMBERS(eye, "fieldOfView", 0.5);
    CHECK(plr_node_bool(eye, "fieldOfViewForceVertical"));
    CHECK_NUMBERS(eye, "nearDistance", 0.25);
    CHECK_NUMBERS(eye, "farDistance", 50);
    const plr_node *flat = first_of(scene, "OrthoViewpoint");
    CHECK_STR(plr_node_string(flat, "description"), "from above");
    CHECK_NUMBERS(flat, "fieldOfView", -3, -2, 3, 2);
    CHECK_NUMBERS(flat, "nearDistance", -1);
    CHECK_INT(plr_scene_root_count(scene), 2); /* no viewpoint is added */
    plr_scene_destroy(&scene);
}

static void test_lights(void) {
    plr_scene *scene = check_body(
        "lights", NULL,
        "'extensions':{'KHR_lights_punctual':{'lights':[{'type':'directional','color':[1,0.5,0],"
        "'intensity':3,'name':'sun'},{'type':'point','range':7},{'type':'spot','intensity':2,"
        "'spot':{'innerConeAngle':0.25,'outerConeAngle':0.5}}]}},'extensionsUsed':["
        "'KHR_lights_punctual'],'scenes':[{'nodes':[0,1,2]}],'nodes':[{'extensions':{"
        "'KHR_lights_punctual':{'light':0}}},{'extensions':{'KHR_lights_punctual':{'light':1}}},"
        "{'extensions':{'KHR_lights_punctual':{'light':2}}}]",
        "", NULL);
    const plr_node *sun = first_of(scene, "DirectionalLight");
    CHECK_STR(plr_node_def(sun), "sun");
    CHECK_NUMBERS(sun, "color", 1, 0.5, 0);
    CHECK_NUMBERS(sun, "intensity", 3);
    CHECK(plr_node_bool(sun, "global"));
    const plr_node *point = first_of(scene, "PointLight"), *spot = first_of(scene, "SpotLight");
    CHECK_NUMBERS(point, "radius", 7);
    CHECK_NUMBERS(point, "intensity", 1);
    CHECK_NUMBERS(point, "attenuation", 0, 0, 1);
    CHECK_NUMBERS(spot, "beamWidth", 0.25);
    CHECK_NUMBERS(spot, "cutOffAngle", 0.5);
    CHECK(plr_node_number(spot, "radius") > 1e15);
    plr_scene_destroy(&scene);
}

/* Nodes have their names before everything else has. */
static void test_names(void) {
    bytes b = triangle();
    plr_scene *scene = check_body(
        "names", &b,
        "'nodes':[{'mesh':0,'name':'x'},{'name':'Cube'},{'name':'x'}],'scenes':[{'nodes':[0,1,2]}],"
        "'meshes':[{'name':'Cube','primitives':[{'attributes':{'POSITION':0},'material':0}]}],"
        "'materials':[{'name':'steel'}],'bufferViews':[{'buffer':0,'byteLength':36}],"
        "'accessors':[{'bufferView':0,'count':3,'componentType':5126,'type':'VEC3'}]",
        "", NULL);
    CHECK_STR(plr_node_type(plr_scene_find(scene, "Cube")), "Transform");
    CHECK(plr_scene_find(scene, "x") == plr_scene_root(scene, 0));
    CHECK(!plr_node_def(first_of(scene, "Shape")));
    CHECK_STR(plr_node_type(plr_scene_find(scene, "steel")), "PhysicalMaterial");
    plr_scene_destroy(&scene);
}

int main(void) {
    test_factors();
    test_unlit();
    test_textures();
    test_sets();
    test_transforms();
    test_cameras();
    test_lights();
    test_names();
    return tap_done();
}
