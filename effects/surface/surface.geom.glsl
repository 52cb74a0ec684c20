#version 330 core
/* The surface base, geometry stage: there only where an effect gives it a main(), which calls these
 * functions for each vertex that it emits. They carry everything that the vertex stage hands to the
 * fragment stage: `plugray_varyings_...` are made by the linker, for all varyings of the program;
 * the plugs are for effects that carry more. */

/* PLUG-DECLARATIONS */

void plugray_varyings_set(const int index);
void plugray_varyings_zero();
void plugray_varyings_add(const int index, const float scale);

/* The vertex to be emitted is the input vertex of this index. */
void geometryVertexSet(const int index) {
    gl_Position = gl_in[index].gl_Position;
    plugray_varyings_set(index);
    /* PLUG: geometry_vertex_set (index) */
}

/* The vertex to be emitted is a sum: nothing yet, ... */
void geometryVertexZero() {
    gl_Position = vec4(0.0);
    plugray_varyings_zero();
    /* PLUG: geometry_vertex_zero () */
}

/* ... and so much of an input vertex. */
void geometryVertexAdd(const int index, const float scale) {
    gl_Position += gl_in[index].gl_Position * scale;
    plugray_varyings_add(index, scale);
    /* PLUG: geometry_vertex_add (index, scale) */
}
