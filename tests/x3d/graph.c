/* The same scene in XML and in Classic VRML gives the same graph. */
#include "checks.h"

static void check_same(const char *what, const char *xml, const char *classic) {
    plr_diags *xml_diags, *classic_diags;
    plr_scene *a = parse_text(xml, "a.x3d", &xml_diags);
    plr_scene *b = parse_text(classic, "b.x3dv", &classic_diags);
    char *xml_faults = dump_diags(xml_diags), *classic_faults = dump_diags(classic_diags);
    char *xml_dump = dump_scene(a), *classic_dump = dump_scene(b);
    TAP_RESULT(!*xml_faults, "%s: XML without fault", what);
    if (*xml_faults)
        printf("# %s\n", xml_faults);
    TAP_RESULT(!*classic_faults, "%s: Classic without fault", what);
    if (*classic_faults)
        printf("# %s\n", classic_faults);
    TAP_RESULT(strcmp(xml_dump, classic_dump) == 0 && *xml_dump, "%s: same graph", what);
    if (strcmp(xml_dump, classic_dump) != 0)
        printf("# --- XML\n%s\n# --- Classic\n%s\n", xml_dump, classic_dump);
    free(xml_dump), free(classic_dump), free(xml_faults), free(classic_faults);
    plr_scene_destroy(&a);
    plr_scene_destroy(&b);
    plr_diags_destroy(&xml_diags);
    plr_diags_destroy(&classic_diags);
}

static void test_nodes(void) {
    check_same("nested nodes",
               XML("<Transform DEF='T' translation='1 2 3'><Shape><Box size='1 2 4'/>"
                   "<Appearance><Material diffuseColor='1 0 0.5' transparency='.25'/></Appearance>"
                   "</Shape></Transform>"),
               CLASSIC("DEF T Transform { translation 1 2 3 children [ Shape { geometry Box { size "
                       "1, 2, 4 } appearance Appearance { material Material { diffuseColor 1 0 "
                       "0.5 transparency .25 } } } ] }"));
    check_same("DEF and USE",
               XML("<Group><Shape DEF='S'><Sphere/></Shape><Transform><Shape USE='S'/></Transform>"
                   "</Group>"),
               CLASSIC("Group { children [ DEF S Shape { geometry Sphere {} } Transform { children "
                       "USE S } ] }"));
}

static void test_volume(void) {
    check_same(
        "a volume",
        XML("<VolumeData dimensions='1 1 2'><OpacityMapVolumeStyle containerField='renderStyle'>"
            "<PixelTexture containerField='transferFunction' image='2 1 4 0x000000ff 0xffffffff'/>"
            "</OpacityMapVolumeStyle><PixelTexture3D containerField='voxels' image='1 2 1 1 0 "
            "255'/>"
            "<Effect><field name='amount' type='SFFloat' accessType='inputOutput' value='0.5'/>"
            "<EffectPart type='FRAGMENT' url='\"a.glsl\"'/></Effect></VolumeData>"),
        CLASSIC(
            "VolumeData { dimensions 1 1 2 renderStyle OpacityMapVolumeStyle { transferFunction "
            "PixelTexture { image 2 1 4 0xFF 0xFFFFFFFF } } voxels PixelTexture3D { image [ 1 2 "
            "1 1 0 255 ] } effects Effect { inputOutput SFFloat amount 0.5 parts EffectPart { "
            "type \"FRAGMENT\" url \"a.glsl\" } } }"));
}

int main(void) {
    test_nodes();
    test_volume();
    return tap_done();
}
