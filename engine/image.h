/* Images in memory: reading (PNG of 8 and 16 bits, JPEG, Radiance HDR, OpenEXR, DDS, BMP, TGA, GIF;
 * NRRD of one slice by the volume reader), pixel fields, single samples. docs/images.md says what
 * is read. */
#ifndef PLR_ENGINE_IMAGE_H
#define PLR_ENGINE_IMAGE_H

#include <plugray/engine.h>

typedef enum plr_sample_type {
    PLR_UNORM8,  /* uint8_t, 255 is 1 */
    PLR_UNORM16, /* uint16_t, 65535 is 1 */
    PLR_FLOAT32,
    PLR_UINT8, /* whole numbers, which stand for themselves: labels */
    PLR_UINT16,
    PLR_UINT32
} plr_sample_type;

/* Rows from the bottom, as textures want them; depth 1 for two dimensions. Owned by the struct. */
typedef struct plr_image {
    uint32_t width, height, depth;
    uint32_t components; /* 1 L, 2 LA, 3 RGB, 4 RGBA */
    plr_sample_type type;
    void *samples;
    uint32_t mipmaps; /* levels that follow, each half as large (rounded down) as the one before */
    bool cube;        /* depth is 6: the faces +X -X +Y -Y +Z -Z of GL, rows from t = 0 */
} plr_image;

/* Samples of one level, all slices or faces; the size of one sample in bytes. */
size_t plr_image_level_samples(const plr_image *image, uint32_t level);
size_t plr_image_sample_size(plr_sample_type type);

/* Decodes a file in memory; DDS files give volumes, cubes and mipmaps too. Limits: 32768 a side,
 * 1 GiB. Faults: bad-image at `place`. */
bool plr_image_decode(const char *data, size_t length, plr_place place, plr_image *image,
                      plr_diags *diags);
/* From an SFImage (width, height, components, pixels; bottom row first) or a PixelTexture3D's image
 * (components, width, height, depth, pixels) as the scene holds it. */
bool plr_image_from_sfimage(const plr_field *field, plr_image *image, plr_diags *diags);
bool plr_image_from_image3d(const plr_field *field, plr_image *image, plr_diags *diags);
/* From a texture node of two dimensions: ImageTexture (the first url that loads and is understood),
 * PixelTexture, MovieTexture (the first frame), TransferFunction. The image has one slice. Needs
 * the scene reader. */
bool plr_image_from_texture(plr_scene *scene, const plr_node *texture, plr_image *image,
                            plr_diags *diags);
/* From a node of a cube map: ComposedCubeMapTexture, ImageCubeMapTexture. Needs the scene reader.
 */
bool plr_image_from_cube_node(plr_scene *scene, const plr_node *texture, plr_image *image,
                              plr_diags *diags);
/* The sample (x, y, z, component) as a number, 0..1 for UNORM types, whole for UINT types. */
double plr_image_sample(const plr_image *image, uint32_t x, uint32_t y, uint32_t z, uint32_t c);
void plr_image_free(plr_image *image);

#endif
