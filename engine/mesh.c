#include "engine/font.h"
#include "engine/mesh_internal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

void *plr_mesh_array(plr_arena *arena, size_t count, size_t size) {
    void *array = count <= SIZE_MAX / size ? calloc(count ? count : 1, size) : NULL;
    if (!array)
        longjmp(*arena->out_of_memory, 1);
    return array;
}

/* Whether the node has the SFBool field and it is FALSE. */
static bool is_false(const plr_node *node, const char *name) {
    const plr_field *field = plr_node_field(node, name);
    return field && field->type == PLR_SFBOOL && !field->value.bools[0];
}

static const struct {
    const char *type;
    bool (*make)(plr_maker *maker);
} makers[] = {
    {"Box", plr_make_box},
    {"Sphere", plr_make_sphere},
    {"Cone", plr_make_cone},
    {"Cylinder", plr_make_cylinder},
    {"Extrusion", plr_make_extrusion},
    {"Text", plr_make_text},
    {"Text3D", plr_make_text},
    {"Teapot", plr_make_teapot},
    {"Plane", plr_make_rectangle},
    {"Rectangle2D", plr_make_rectangle},
    {"Arc2D", plr_make_arc},
    {"ArcClose2D", plr_make_arc_close},
    {"Circle2D", plr_make_circle},
    {"Disk2D", plr_make_disk},
    {"Polyline2D", plr_make_polyline},
    {"Polypoint2D", plr_make_polypoint},
    {"TriangleSet2D", plr_make_triangles2d},
};

static bool make(plr_maker *maker) {
    if (plr_mesh_is_polygons(maker->node)) {
        plr_polygons polygons = {.arena = maker->arena, .node = maker->node, .diags = maker->diags};
        return plr_polygons_read(&polygons) && plr_polygons_emit(&polygons, maker->mesh);
    }
    for (size_t i = 0; i < sizeof makers / sizeof *makers; i++)
        if (strcmp(plr_node_type(maker->node), makers[i].type) == 0)
            return makers[i].make(maker);
    plr_diags_add(maker->diags, PLR_CODE_NOT_DRAWN, plr_node_place(maker->node),
                  "plugray does not draw %s yet", plr_node_type(maker->node));
    return false;
}

static bool build(plr_maker *maker) {
    const plr_node *geometry = maker->node;
    plr_mesh *mesh = maker->mesh;
    mesh->two_sided = is_false(geometry, "solid");
    mesh->clockwise = is_false(geometry, "ccw");
    if (!make(maker))
        return false;
    if (!mesh->vertex_count)
        return false;
    plr_mesh_find_bounds(mesh);
    for (int i = 0; i < 6; i++)
        if (!isfinite(mesh->bounds[i / 3][i % 3])) {
            plr_diags_add(maker->diags, PLR_CODE_BAD_GEOMETRY, plr_node_place(geometry),
                          "the size of the %s is not finite", plr_node_type(geometry));
            return false;
        }
    return true;
}

/* The maker is the caller's, so that what it holds is known after a jump. */
static bool build_guarded(plr_maker *maker) {
    jmp_buf out_of_memory;
    plr_arena_init(maker->arena, NULL, &out_of_memory);
    if (setjmp(out_of_memory)) {
        plr_diags_add(maker->diags, PLR_CODE_NO_MEMORY, plr_node_place(maker->node),
                      "no memory for the %s", plr_node_type(maker->node));
        return false;
    }
    return build(maker);
}

bool plr_mesh_build_with(const plr_node *geometry, const char *const *font_folders, plr_mesh *mesh,
                         plr_diags *diags) {
    memset(mesh, 0, sizeof *mesh);
    plr_arena arena;
    plr_maker maker = {.arena = &arena,
                       .node = geometry,
                       .mesh = mesh,
                       .diags = diags,
                       .font_folders = font_folders};
    bool built = build_guarded(&maker);
    plr_font_close(maker.font);
    plr_arena_finish(&arena);
    if (!built)
        plr_mesh_free(mesh);
    return built;
}

bool plr_mesh_build(const plr_node *geometry, plr_mesh *mesh, plr_diags *diags) {
    return plr_mesh_build_with(geometry, NULL, mesh, diags);
}

void plr_mesh_free(plr_mesh *mesh) {
    free(mesh->positions);
    free(mesh->normals);
    for (int unit = 0; unit < PLR_MESH_TEX_UNITS; unit++)
        free(mesh->tex_coords[unit]);
    free(mesh->plane_coords);
    free(mesh->box_coords);
    free(mesh->tangents);
    free(mesh->colors);
    free(mesh->fog_coords);
    free(mesh->line_distances);
    for (size_t i = 0; i < mesh->attribute_count; i++) {
        free(mesh->attributes[i].name);
        free(mesh->attributes[i].values);
    }
    free(mesh->attributes);
    free(mesh->indices);
    memset(mesh, 0, sizeof *mesh);
}
