#version 330 core
in vec4 castle_TexCoord0;
uniform vec3 plr0_emissiveColor;
uniform sampler2D plr2_self;
out vec4 plugray_FragColor;

void main() {
    plugray_FragColor = vec4(plr0_emissiveColor * texture(plr2_self, castle_TexCoord0.st).rgb, 1.0);
}
