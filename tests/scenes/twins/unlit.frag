#version 330 core
uniform vec3 plr0_emissiveColor;
out vec4 plugray_FragColor;

void main() {
    plugray_FragColor = vec4(plr0_emissiveColor, 1.0);
}
