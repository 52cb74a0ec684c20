/* Values of fields from text. */
#ifndef PLR_X3D_VALUES_H
#define PLR_X3D_VALUES_H

#include "x3d/scene.h"

/* How a value is to be read. */
typedef struct x3d_value_desc {
    plr_type type;
    const plr_field_info *info; /* its range, or NULL */
    const char *node, *field;   /* for messages */
    const plr_node *owner;      /* its fields may follow the value, in Classic VRML; or NULL */
    bool xml;                   /* the value is the whole text, strings may lack quotes */
    bool keep_newlines;         /* in XML strings */
    double angle_factor;        /* radians for one in the text; 0: 1 */
} x3d_value_desc;

/* Reads a value of any type but nodes into `field` (value and count). Errors are reported; then the
 * field keeps what it has, the lexer stands after what was understood, and the result is false. */
bool x3d_value_read(plr_scene *scene, x3d_lexer *lexer, const x3d_value_desc *desc,
                    plr_field *field);

#endif
