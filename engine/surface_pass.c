#include "engine/view.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

/* ---- Depths ---- */

static void corner_depths(const plr_surface *surface, const plr_matrix *world_to_eye,
                          double depths[2]) {
    plr_matrix to_eye = plr_matrix_multiply(world_to_eye, &surface->to_world);
    for (int corner = 0; corner < 8; corner++) {
        double point[3];
        for (int axis = 0; axis < 3; axis++)
            point[axis] = (double)surface->model->mesh.bounds[corner >> axis & 1][axis];
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
        if (!surface->model->pass.built)
            continue;
        corner_depths(surface, world_to_eye, own);
        surface->depth = (own[0] + own[1]) / 2;
        surface->reach = (own[1] - own[0]) / 2;
        depths[0] = fmin(depths[0], own[0]);
        depths[1] = fmax(depths[1], own[1]);
    }
}

/* ---- GL ---- */

static GLuint upload_buffer(plr_view *view, plr_model *model, GLenum target, const void *data,
                            size_t size) {
    const plr_gl *gl = &view->engine->gl;
    GLuint *name = &model->buffers[model->buffer_count++];
    gl->GenBuffers(1, name);
    gl->BindBuffer(target, *name);
    gl->BufferData(target, (GLsizeiptr)size, data, GL_STATIC_DRAW);
    return *name;
}

/* What the mesh has for an attribute of this name. */
static const float *attribute_data(plr_mesh *mesh, const char *name, int *components) {
    const struct {
        const char *name;
        int components;
        const float *data;
    } standard[] = {{"castle_Vertex", 3, mesh->positions},
                    {"castle_Normal", 3, mesh->normals},
                    {"castle_ColorPerVertex", 4, mesh->colors},
                    {"castle_FogCoord", 1, mesh->fog_coords},
                    {"plugray_LineDistance", 1, mesh->line_distances}};
    for (size_t i = 0; i < sizeof standard / sizeof *standard; i++)
        if (strcmp(name, standard[i].name) == 0) {
            *components = standard[i].components;
            return standard[i].data;
        }
    unsigned unit;
    *components = 4;
    if (sscanf(name, "castle_MultiTexCoord%u", &unit) == 1)
        return plr_mesh_tex_coords(mesh, unit);
    if (strcmp(name, "castle_Tangent") == 0)
        return plr_mesh_tangents(mesh);
    if (strcmp(name, "plugray_BoxCoord") == 0)
        return plr_mesh_box_coords(mesh);
    if (strcmp(name, "plugray_PlaneCoord") == 0)
        return plr_mesh_plane_coords(mesh);
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

static void upload_mesh(plr_view *view, plr_model *model) {
    const plr_gl *gl = &view->engine->gl;
    plr_mesh *mesh = &model->mesh;
    gl->GenVertexArrays(1, &model->vertex_array);
    gl->BindVertexArray(model->vertex_array);
    const int most = (int)(sizeof model->buffers / sizeof *model->buffers) - 1;
    for (size_t i = 0; i < plr_program_symbol_count(model->pass.program); i++) {
        const plr_symbol *symbol = plr_program_symbol(model->pass.program, i);
        int components;
        if (symbol->kind != PLR_ATTRIBUTE || model->buffer_count >= most)
            continue;
        GLint location = gl->GetAttribLocation(model->pass.built->name, symbol->program);
        const float *data = attribute_data(mesh, symbol->name, &components);
        if (location < 0 || !data)
            continue;
        upload_buffer(view, model, GL_ARRAY_BUFFER, data,
                      sizeof(float) * (size_t)components * mesh->vertex_count);
        set_pointer(gl, (GLuint)location, components);
    }
    upload_buffer(view, model, GL_ELEMENT_ARRAY_BUFFER, mesh->indices,
                  sizeof(uint32_t) * mesh->index_count);
    gl->BindVertexArray(0);
}

void plr_surface_draw_faces(plr_view *view, plr_surface *surface, const plr_frame *frame,
                            plr_faces faces, bool depths) {
    static const GLenum kinds[] = {GL_TRIANGLES, GL_LINES, GL_POINTS};
    const plr_gl *gl = &view->engine->gl;
    plr_model *model = surface->model;
    if (!model->pass.built || !model->mesh.index_count)
        return;
    if (!model->vertex_array)
        upload_mesh(view, model);
    gl->Enable(GL_DEPTH_TEST);
    gl->DepthFunc(frame->reversed_depth ? GL_GEQUAL : GL_LEQUAL);
    gl->DepthMask(depths || !model->blends);
    plr_surface_state_enter(gl, &model->state, model->blends && !depths);
    bool culls = model->mesh.kind == PLR_MESH_TRIANGLES && !model->mesh.two_sided;
    (culls || faces != PLR_FACES_ALL ? gl->Enable : gl->Disable)(GL_CULL_FACE);
    gl->CullFace(faces == PLR_FACES_BACK ? GL_FRONT : GL_BACK);
    bool mirrored = plr_matrix_determinant3(&surface->to_world) < 0;
    gl->FrontFace(model->mesh.clockwise != mirrored ? GL_CW : GL_CCW);
    gl->UseProgram(model->pass.built->name);
    plr_values values = {.frame = frame,
                         .view = view,
                         .to_world = surface->to_world,
                         .volumes = view->volumes.volumes,
                         .volume_count = view->volumes.count,
                         .functions = view->volumes.functions.texture};
    plr_bind_set(gl, &view->textures, &model->pass.slots, &values);
    gl->BindVertexArray(model->vertex_array);
    gl->DrawElements(kinds[model->mesh.kind], (GLsizei)model->mesh.index_count, GL_UNSIGNED_INT,
                     NULL);
    plr_surface_state_leave(gl, &model->state);
}

void plr_surface_draw(plr_view *view, plr_surface *surface, const plr_frame *frame) {
    plr_surface_draw_faces(view, surface, frame, PLR_FACES_ALL, false);
}

void plr_model_finish(plr_view *view, plr_model *model) {
    if (view->engine && model->vertex_array) {
        view->engine->gl.DeleteVertexArrays(1, &model->vertex_array);
        view->engine->gl.DeleteBuffers(model->buffer_count, model->buffers);
    }
    plr_mesh_free(&model->mesh);
}
