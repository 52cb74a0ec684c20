/* What the styles of a volume come to where they are transfer functions alone. */
#ifndef PLR_ENGINE_VOLUME_MAPS_H
#define PLR_ENGINE_VOLUME_MAPS_H

#include <stdbool.h>

#include <plugray/x3d.h>

typedef struct plr_style_map {
    const plr_node
        *map;      /* the opacity map that counts; NULL: the default one, or voxels as they are */
    double factor; /* of its opacity */
    bool bare;     /* styles are there, but no map: voxels stay as they are */
} plr_style_map;

/* Whether a style (NULL: none given), and what is inside, is opacity maps and constant factors
 * alone; `general`: what is switched off must be, too (engine/general.h). */
bool plr_style_find_map(const plr_node *style, bool general, plr_style_map *found);

#endif
