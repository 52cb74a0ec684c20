/* Files that the urls of a node lead to. */
#ifndef PLR_ENGINE_NODE_FILE_H
#define PLR_ENGINE_NODE_FILE_H

#include <plugray/engine.h>

/* Makes something of the bytes of a file; `place` is that of its url. False with an error. */
typedef bool (*plr_file_decoder)(void *user, plr_scene *scene, const plr_bytes *bytes,
                                 plr_place place, plr_diags *diags);

typedef enum plr_url_outcome {
    PLR_URL_FINE,
    PLR_URL_NOT_LOADED,
    PLR_URL_NOT_UNDERSTOOD
} plr_url_outcome;

/* Makes something of one url, which need not be that of one file; `place` is the url's. */
typedef plr_url_outcome (*plr_url_reader)(void *user, plr_scene *scene, const plr_string *url,
                                          plr_place place, plr_diags *diags);

/* Goes through the field `url` until one is fine, with the messages that plr_node_file gives. */
bool plr_node_urls(plr_scene *scene, const plr_node *node, plr_url_reader read, void *user,
                   plr_diags *diags);

/* Goes through the field `url` until a file loads and is understood. Those before it that loaded
 * and were not understood are warnings. Where none is left, says why: all files that are there but
 * not understood, else the first url. Gzipped files are unpacked. */
bool plr_node_file(plr_scene *scene, const plr_node *node, plr_file_decoder decode, void *user,
                   plr_diags *diags);

#endif
