#version 330 core
in vec2 place;
out vec4 picture;

/* PLUG-DECLARATIONS */

void main() {
    vec4 color = vec4(place, 0.5, 1.0);
    /* PLUG: picture_color (color, place) */
    picture = color;
}
