#version 330 core
/* The base of what draws a shape into a shadow map: depths, no colour. Its vertex stage is that of the
 * shape, so that what moves the shape moves its shadow. */

/* PLUG-DECLARATIONS */

void main() {
}
