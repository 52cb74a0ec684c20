#include "engine/view.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

/* ---- Composing ---- */

static const plr_binding nothing = {.volume = PLR_NO_EFFECT};

static plr_binding bound(plr_node *node) {
    return (plr_binding){.node = node, .to_world = plr_matrix_identity(), .volume = PLR_NO_EFFECT};
}

static bool is_translucent(plr_view *view, const plr_node *appearance) {
    const plr_node *material = plr_node_child(appearance, "material");
    const plr_node *texture = plr_node_child(appearance, "texture");
    const plr_texture *image = texture ? plr_textures_get(&view->textures, texture) : NULL;
    return (material && plr_node_number(material, "transparency") > 0) ||
           (image && image->translucent);
}

/* The material as an effect. What has no normals is not lit: its Material counts by its emissive
 * colour (ISO/IEC 19775-1 V4 11.2.2.5). */
static void add_material(plr_view *view, plr_recipe *recipe, plr_node *appearance, bool lit,
                         plr_diags *diags) {
    plr_node *material = appearance ? plr_node_child(appearance, "material") : NULL;
    const char *type = material ? plr_node_type(material) : "UnlitMaterial";
    const char *path =
        lit ? plr_arena_format(&view->arena, "surface/%s", type) : "surface/UnlitMaterial";
    plr_binding binding = material ? bound(material) : nothing;
    if (plr_recipe_builtin(&view->kitchen, recipe, path, type, binding, 0, NULL, 0))
        return;
    plr_diags_add(diags, PLR_CODE_NOT_DRAWN, plr_node_place(material),
                  "%s is not drawn yet; the shape is white", type);
    plr_recipe_builtin(&view->kitchen, recipe, "surface/UnlitMaterial", "UnlitMaterial", nothing, 0,
                       NULL, 0);
}

/* Returns what attaches the texture's own effects to it. */
static size_t add_texture(plr_view *view, plr_recipe *recipe, plr_node *appearance,
                          plr_diags *diags) {
    plr_node *texture = appearance ? plr_node_child(appearance, "texture") : NULL;
    if (!texture)
        return 0;
    plr_texture *image = plr_textures_get(&view->textures, texture);
    if (!image || image->dimensions != 2) {
        plr_diags_add(diags, PLR_CODE_NOT_DRAWN, plr_node_place(texture),
                      "%s is not drawn on surfaces yet", plr_node_type(texture));
        return 0;
    }
    size_t attached = plr_recipe_builtin(&view->kitchen, recipe, "surface/Texture2D",
                                         plr_node_type(texture), bound(texture), 0, NULL, 0);
    plr_node *transform = plr_node_child(appearance, "textureTransform");
    if (transform)
        plr_recipe_builtin(&view->kitchen, recipe,
                           plr_arena_format(&view->arena, "surface/%s", plr_node_type(transform)),
                           plr_node_type(transform), bound(transform), attached, NULL, 0);
    return attached;
}

static void add_authors(plr_view *view, plr_recipe *recipe, const plr_leaf *leaf,
                        plr_node *appearance, size_t texture) {
    plr_kitchen *k = &view->kitchen;
    plr_pass_light_authors(view, recipe);
    if (texture)
        plr_recipe_author_list(k, recipe, plr_node_child(appearance, "texture"), texture,
                               PLR_NO_EFFECT);
    if (appearance)
        plr_recipe_author_list(k, recipe, appearance, 0, PLR_NO_EFFECT);
    plr_recipe_groups(k, recipe, leaf->scope, 0, PLR_NO_EFFECT);
}

static void define_surface(plr_view *view, plr_recipe *recipe, const plr_surface *surface) {
    const struct {
        const char *name;
        int value;
    } defines[] = {{"CASTLE_GLSL_VERSION_UPGRADE", 1},
                   {"HAS_COLORS", surface->mesh.colors != NULL},
                   {"HAS_NORMALS", surface->mesh.normals != NULL},
                   {"TWO_SIDED", surface->mesh.two_sided},
                   {"OPAQUE", !surface->blends}};
    for (size_t i = 0; i < sizeof defines / sizeof *defines; i++)
        plr_recipe_define(&view->kitchen, recipe, defines[i].name, defines[i].value);
}

static void compose_standard(plr_view *view, plr_surface *surface, const plr_leaf *leaf,
                             plr_node *appearance, plr_diags *diags) {
    plr_pass *pass = &surface->pass;
    pass->recipe =
        (plr_recipe){.base = *plr_catalog_units(view->kitchen.catalog, "surface/surface")};
    define_surface(view, &pass->recipe, surface);
    bool lit = surface->mesh.normals != NULL;
    add_material(view, &pass->recipe, appearance, lit, diags);
    size_t texture = add_texture(view, &pass->recipe, appearance, diags);
    if (lit)
        plr_pass_lights(view, &pass->recipe, leaf->scope, 0, PLR_NO_EFFECT);
    add_authors(view, &pass->recipe, leaf, appearance, texture);
    pass->built = plr_compose_program(&view->composer, &pass->recipe, "surface", &pass->program);
}

/* The first of the author's complete shaders that works (ISO/IEC 19775-1 V4 31.2.2.3); its own
 * fields are bound as those of an effect are. */
static bool compose_shader(plr_view *view, plr_surface *surface, const plr_leaf *leaf,
                           plr_node *appearance) {
    const plr_field *shaders = appearance ? plr_node_field(appearance, "shaders") : NULL;
    for (size_t i = 0; shaders && i < shaders->count; i++) {
        plr_node *shader = shaders->value.nodes[i];
        plr_pass *pass = &surface->pass;
        *pass = (plr_pass){0};
        if (!shader || !plr_node_is(shader, "ComposedShader") ||
            !plr_recipe_shader_base(&view->kitchen, &pass->recipe, shader))
            continue;
        pass->recipe.base_node = shader;
        define_surface(view, &pass->recipe, surface);
        add_authors(view, &pass->recipe, leaf, appearance, 0);
        pass->built =
            plr_compose_program(&view->composer, &pass->recipe, "surface", &pass->program);
        if (pass->built)
            return true;
    }
    return false;
}

static void prepare_surface(plr_view *view, plr_surface *surface, const plr_leaf *leaf,
                            plr_diags *diags) {
    plr_node *appearance = plr_node_child(leaf->node, "appearance");
    surface->to_world = leaf->to_world;
    bool built = plr_mesh_build(plr_node_child(leaf->node, "geometry"), &surface->mesh, diags);
    if (!built && view->engine)
        return; /* else the effects on it are checked all the same */
    surface->blends = appearance && is_translucent(view, appearance);
    if (!compose_shader(view, surface, leaf, appearance))
        compose_standard(view, surface, leaf, appearance, diags);
}

void plr_surfaces_prepare(plr_view *view, plr_diags *diags) {
    view->surfaces = PLR_NEW_ARRAY(&view->arena, view->flat.shapes.count + 1, plr_surface);
    view->blending = PLR_NEW_ARRAY(&view->arena, view->flat.shapes.count + 1, plr_surface *);
    for (size_t i = 0; i < view->flat.shapes.count; i++) {
        view->surface_count = i + 1; /* before: so that its mesh is freed whatever happens */
        prepare_surface(view, &view->surfaces[i], &view->flat.shapes.items[i], diags);
        if (view->surfaces[i].blends)
            view->blending[view->blending_count++] = &view->surfaces[i];
    }
}

/* ---- Depths ---- */

static void corner_depths(const plr_surface *surface, const plr_matrix *world_to_eye,
                          double depths[2]) {
    plr_matrix to_eye = plr_matrix_multiply(world_to_eye, &surface->to_world);
    for (int corner = 0; corner < 8; corner++) {
        double point[3];
        for (int axis = 0; axis < 3; axis++)
            point[axis] = (double)surface->mesh.bounds[corner >> axis & 1][axis];
        plr_matrix_point(&to_eye, point, point);
        depths[0] = fmin(depths[0], -point[2]);
        depths[1] = fmax(depths[1], -point[2]);
    }
}

void plr_surfaces_depths(const plr_view *view, const plr_matrix *world_to_eye, double depths[2]) {
    depths[0] = INFINITY;
    depths[1] = -INFINITY;
    for (size_t i = 0; i < view->surface_count; i++) {
        plr_surface *surface = &view->surfaces[i];
        double own[2] = {INFINITY, -INFINITY};
        if (!surface->pass.built)
            continue;
        corner_depths(surface, world_to_eye, own);
        surface->depth = (own[0] + own[1]) / 2;
        depths[0] = fmin(depths[0], own[0]);
        depths[1] = fmax(depths[1], own[1]);
    }
}

/* ---- GL ---- */

static GLuint upload_buffer(plr_view *view, plr_surface *surface, GLenum target, const void *data,
                            size_t size) {
    const plr_gl *gl = &view->engine->gl;
    GLuint *name = &surface->buffers[surface->buffer_count++];
    gl->GenBuffers(1, name);
    gl->BindBuffer(target, *name);
    gl->BufferData(target, (GLsizeiptr)size, data, GL_STATIC_DRAW);
    return *name;
}

/* What the mesh has for an attribute of this name. */
static const float *attribute_data(const plr_mesh *mesh, const char *name, int *components) {
    const struct {
        const char *name;
        int components;
        const float *data;
    } standard[] = {{"castle_Vertex", 3, mesh->positions},
                    {"castle_Normal", 3, mesh->normals},
                    {"castle_ColorPerVertex", 4, mesh->colors}};
    for (size_t i = 0; i < sizeof standard / sizeof *standard; i++)
        if (strcmp(name, standard[i].name) == 0) {
            *components = standard[i].components;
            return standard[i].data;
        }
    unsigned unit;
    if (sscanf(name, "castle_MultiTexCoord%u", &unit) == 1) {
        *components = 4;
        return mesh->tex_coords;
    }
    for (size_t i = 0; i < mesh->attribute_count; i++)
        if (strcmp(name, mesh->attributes[i].name) == 0) {
            *components = mesh->attributes[i].components;
            return mesh->attributes[i].values;
        }
    return NULL;
}

static void set_pointer(const plr_gl *gl, GLuint location, int components) {
    /* matrices take one location a column */
    int columns = components == 16 ? 4 : components == 9 ? 3 : 1, rows = components / columns;
    for (int column = 0; column < columns; column++) {
        size_t offset = sizeof(float) * (size_t)(column * rows);
        gl->EnableVertexAttribArray(location + (GLuint)column);
        gl->VertexAttribPointer(location + (GLuint)column, rows, GL_FLOAT, GL_FALSE,
                                (GLsizei)sizeof(float) * components, (const void *)offset);
    }
}

static void upload_mesh(plr_view *view, plr_surface *surface) {
    const plr_gl *gl = &view->engine->gl;
    const plr_mesh *mesh = &surface->mesh;
    gl->GenVertexArrays(1, &surface->vertex_array);
    gl->BindVertexArray(surface->vertex_array);
    const int most = (int)(sizeof surface->buffers / sizeof *surface->buffers) - 1;
    for (size_t i = 0; i < plr_program_symbol_count(surface->pass.program); i++) {
        const plr_symbol *symbol = plr_program_symbol(surface->pass.program, i);
        int components;
        if (symbol->kind != PLR_ATTRIBUTE || surface->buffer_count >= most)
            continue;
        GLint location = gl->GetAttribLocation(surface->pass.built->name, symbol->program);
        const float *data = attribute_data(mesh, symbol->name, &components);
        if (location < 0 || !data)
            continue;
        upload_buffer(view, surface, GL_ARRAY_BUFFER, data,
                      sizeof(float) * (size_t)components * mesh->vertex_count);
        set_pointer(gl, (GLuint)location, components);
    }
    upload_buffer(view, surface, GL_ELEMENT_ARRAY_BUFFER, mesh->indices,
                  sizeof(uint32_t) * mesh->index_count);
    gl->BindVertexArray(0);
}

void plr_surface_draw(plr_view *view, plr_surface *surface, const plr_frame *frame) {
    static const GLenum kinds[] = {GL_TRIANGLES, GL_LINES, GL_POINTS};
    const plr_gl *gl = &view->engine->gl;
    if (!surface->pass.built || !surface->mesh.index_count)
        return;
    if (!surface->vertex_array)
        upload_mesh(view, surface);
    gl->Enable(GL_DEPTH_TEST);
    gl->DepthFunc(frame->reversed_depth ? GL_GEQUAL : GL_LEQUAL);
    gl->DepthMask(!surface->blends);
    if (surface->blends) {
        gl->Enable(GL_BLEND);
        gl->BlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    } else {
        gl->Disable(GL_BLEND);
    }
    bool culls = surface->mesh.kind == PLR_MESH_TRIANGLES && !surface->mesh.two_sided;
    (culls ? gl->Enable : gl->Disable)(GL_CULL_FACE);
    gl->CullFace(GL_BACK);
    bool mirrored = plr_matrix_determinant3(&surface->to_world) < 0;
    gl->FrontFace(surface->mesh.clockwise != mirrored ? GL_CW : GL_CCW);
    gl->UseProgram(surface->pass.built->name);
    plr_values values = {.frame = frame, .to_world = surface->to_world};
    plr_bind_set(gl, &view->textures, &surface->pass.slots, &values);
    gl->BindVertexArray(surface->vertex_array);
    gl->DrawElements(kinds[surface->mesh.kind], (GLsizei)surface->mesh.index_count, GL_UNSIGNED_INT,
                     NULL);
}

void plr_surface_finish(plr_view *view, plr_surface *surface) {
    if (view->engine && surface->vertex_array) {
        view->engine->gl.DeleteVertexArrays(1, &surface->vertex_array);
        view->engine->gl.DeleteBuffers(surface->buffer_count, surface->buffers);
    }
    plr_mesh_free(&surface->mesh);
}
