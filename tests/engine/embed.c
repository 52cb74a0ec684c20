/* A host draws a scene into its own framebuffer: pixels in closed form, and its state untouched. */
#include "tests/tap.h"

#include "engine/state.h"
#include "engine/view.h"

enum {
    SIDE = 32,
    LEFT = 8, /* of the viewport, and its size */
    WIDTH = 16
};

/* Opacity 0.5 for each voxel, two voxels along the ray: 3/4 in all, half of the way 1/2. */
static const char scene_text[] =
    "#X3D V4.0 utf8\nPROFILE Immersive\nNavigationInfo { headlight FALSE }\n"
    "VolumeData { dimensions 2 2 2 voxels PixelTexture3D { image [ 1 2 2 2 255 255 255 255 255 255 "
    "255 255 ] } renderStyle OpacityMapVolumeStyle { transferFunction PixelTexture { image 1 1 4 "
    "0xff000080 } } }\n";

/* A screen before all that the host drew; what it shows is drawn into a texture before, and a
 * square that is out of sight keeps the light, which falls on it at 45 degrees, from its left
 * quarter.
 */
static const char targets_text[] =
    "#X3D V4.0 utf8\nPROFILE Immersive\nNavigationInfo { headlight FALSE }\n"
    "DirectionalLight { direction 1 0 -1 intensity 0.5 shadows TRUE }\n"
    "Shape { geometry IndexedFaceSet { coordIndex [ 0 1 2 3 ] coord Coordinate { point [ -1 -1 "
    "0.5, "
    "1 -1 0.5, 1 1 0.5, -1 1 0.5 ] } } appearance Appearance { material Material { diffuseColor 1 "
    "1 1 "
    "ambientIntensity 0 } texture RenderedTexture { update \"ALWAYS\" dimensions [ 8 8 4 ] scene "
    "Group "
    "{ children Background { skyColor 0 1 0 } } } } }\n"
    "Shape { geometry IndexedFaceSet { coordIndex [ 0 1 2 3 ] coord Coordinate { point [ -5 -1 "
    "4.5, "
    "-4.5 -1 4.5, -4.5 1 4.5, -5 1 4.5 ] } } }\n";

/* The same volume with a translucent square inside, at z = 0.5; rays leave their depth. */
static const char divided_text[] =
    "#X3D V4.0 utf8\nPROFILE Immersive\nNavigationInfo { headlight FALSE }\n"
    "VolumeData { dimensions 2 2 2 writeDepth TRUE voxels PixelTexture3D { image [ 1 2 2 2 255 255 "
    "255 255 255 255 255 255 ] } renderStyle OpacityMapVolumeStyle { transferFunction PixelTexture "
    "{ image 1 1 4 0xff000080 } } }\n"
    "Shape { appearance Appearance { material UnlitMaterial { emissiveColor 0 1 0 transparency 0.5 "
    "} } geometry IndexedFaceSet { coordIndex [ 0 1 2 3 ] coord Coordinate { point [ -.7 -.7 0.5, "
    ".7 -.7 0.5, .7 .7 0.5, -.7 .7 0.5 ] } } }\n";

/* The camera stands at z = 2. */
static const double camera[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, -2, 1};
/* Parallel, distances -4 to 4 from the camera: z = 0, at distance 2, is 0.75 in the depth buffer.
 */
static const double projection[16] = {.5, 0, 0, 0, 0, .5, 0, 0, 0, 0, -.25, 0, 0, 0, 0, 1};

typedef struct host {
    plr_gl gl;
    GLuint framebuffer, color, depth, texture, cube;
} host;

static void make_framebuffer(host *h) {
    const plr_gl *gl = &h->gl;
    gl->GenFramebuffers(1, &h->framebuffer);
    gl->BindFramebuffer(GL_FRAMEBUFFER, h->framebuffer);
    gl->GenRenderbuffers(1, &h->color);
    gl->BindRenderbuffer(GL_RENDERBUFFER, h->color);
    gl->RenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, SIDE, SIDE);
    gl->FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, h->color);
    gl->GenRenderbuffers(1, &h->depth);
    gl->BindRenderbuffer(GL_RENDERBUFFER, h->depth);
    gl->RenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT24, SIDE, SIDE);
    gl->FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, h->depth);
}

/* Blue everywhere; in the left half something opaque at the depth of z = 0. */
static void draw_host(host *h) {
    const plr_gl *gl = &h->gl;
    gl->ClearColor(0, 0, 1, 1);
    gl->ClearDepth(1);
    gl->Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    gl->Enable(GL_SCISSOR_TEST);
    gl->Scissor(0, 0, SIDE / 2, SIDE);
    gl->ClearDepth(0.75);
    gl->Clear(GL_DEPTH_BUFFER_BIT);
}

/* State that nobody would choose: what is set back carelessly is seen. */
static void make_odd_state(host *h) {
    const plr_gl *gl = &h->gl;
    gl->GenTextures(1, &h->texture);
    gl->GenTextures(1, &h->cube);
    gl->ActiveTexture(GL_TEXTURE0 + 3);
    gl->BindTexture(GL_TEXTURE_2D, h->texture);
    gl->Enable(GL_BLEND);
    gl->Enable(GL_CULL_FACE);
    gl->BlendFuncSeparate(GL_DST_COLOR, GL_ZERO, GL_ONE, GL_SRC_ALPHA);
    gl->CullFace(GL_FRONT);
    gl->FrontFace(GL_CW);
    gl->DepthFunc(GL_ALWAYS);
    gl->PolygonOffset(3, 5);
    gl->BindTexture(GL_TEXTURE_CUBE_MAP, h->cube);
    gl->ClearColor(0.25f, 0.5f, 0.75f, 1);
    gl->Viewport(LEFT, LEFT, WIDTH, WIDTH);
}

static plr_view *make_view(const char *text, plr_engine **engine, plr_scene **scene,
                           plr_context *context, plr_diags *diags) {
    plr_engine_desc desc = {.get_proc_address = plr_context_get_proc_address, .user = context};
    plr_view_desc view = {.host_depths = true, .step = 0.1};
    *engine = plr_engine_create(&desc, diags);
    *scene = plr_scene_parse(text, strlen(text), "embed.x3dv", NULL, diags);
    return plr_view_create(*engine, *scene, &view, diags);
}

static void check_pixel(const plr_gl *gl, int x, int y, const double expected[4]) {
    GLubyte pixel[4];
    gl->ReadPixels(x, y, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, pixel);
    for (int i = 0; i < 4; i++)
        CHECK_NEAR(pixel[i], expected[i] * 255, 1.5);
}

/* The volume, and what is beside it; rays end at what the host drew. */
static void check_volume(const plr_gl *gl) {
    const double alpha = 128.0 / 255, far = 1 - pow(1 - alpha, 2), half = alpha;
    check_pixel(gl, 18, 16, (double[]){far, 0, 1 - far, 1});
    check_pixel(gl, 14, 16, (double[]){half, 0, 1 - half, 1});
}

static void check_depth(const plr_gl *gl, int x, int y, double expected) {
    GLfloat depth = -1;
    gl->ReadPixels(x, y, 1, 1, GL_DEPTH_COMPONENT, GL_FLOAT, &depth);
    CHECK_NEAR(depth, expected, 1e-6);
}

/* Half a voxel before the square; behind it one and a half, or half a one up to the host's wall. */
static void check_divided(const plr_gl *gl) {
    const double left = 1 - 128.0 / 255, near = sqrt(left);
    for (int x = 14; x <= 18; x += 4) {
        double behind = x < 16 ? near : near * left, through = near * 0.5 * behind;
        double red = (1 - near) + near * 0.5 * (1 - behind), green = near * 0.5;
        check_pixel(gl, x, 16, (double[]){red, green, through, 1});
    }
    check_depth(gl, 14, 16, 0.75);  /* the host's */
    check_depth(gl, 18, 16, 0.875); /* z = -1, where rays leave the volume */
    check_depth(gl, 19, 19, 0.875);
    check_depth(gl, 22, 22, 1);
    check_depth(gl, 2, 16, 0.75);
}

static void check_targets(const plr_gl *gl) {
    check_pixel(gl, 15, 16, (double[]){0, 0.5 * sqrt(0.5), 0, 1});
    check_pixel(gl, 12, 16, (double[]){0, 0, 0, 1});
}

static void run(plr_context *context, const char *text, void (*check)(const plr_gl *)) {
    host h = {.texture = 0};
    CHECK(plr_gl_load(&h.gl, plr_context_get_proc_address, context) == NULL);
    plr_diags *diags = plr_diags_create(NULL);
    plr_engine *engine;
    plr_scene *scene;
    plr_view *view = make_view(text, &engine, &scene, context, diags);
    CHECK(view != NULL);
    make_framebuffer(&h);
    draw_host(&h);
    make_odd_state(&h);
    plr_gl_state before, after;
    plr_gl_state_save(&h.gl, &before);
    CHECK(plr_view_draw_here(view, projection, camera, diags));
    plr_gl_state_save(&h.gl, &after);
    CHECK(memcmp(&before, &after, sizeof before) == 0);
    CHECK_INT(h.gl.GetError(), GL_NO_ERROR);
    check_pixel(&h.gl, 2, 2, (double[]){0, 0, 1, 1});  /* beside the viewport */
    check_pixel(&h.gl, 9, 16, (double[]){0, 0, 1, 1}); /* beside what is drawn */
    check(&h.gl);
    CHECK_INT(plr_diags_count(diags), 0);
    plr_view_destroy(&view);
    plr_scene_destroy(&scene);
    plr_engine_destroy(&engine);
    plr_diags_destroy(&diags);
}

int main(void) {
    plr_context *context = plr_context_create(PLR_BACKEND_AUTO, NULL);
    if (!context)
        TAP_SKIP("a host draws", "there is no GL");
    else
        run(context, scene_text, check_volume);
    plr_context_destroy(&context);
    context = plr_context_create(PLR_BACKEND_AUTO, NULL);
    if (context)
        run(context, divided_text, check_divided);
    plr_context_destroy(&context);
    context = plr_context_create(PLR_BACKEND_AUTO, NULL); /* a host without that one's odd state */
    if (context)
        run(context, targets_text, check_targets);
    plr_context_destroy(&context);
    return tap_done();
}
