/* The raw bytes of an XML document, token by token: libxml2 says what is there, this says where. It
 * runs in step with the events of the parser, which has found the text well formed up to there. */
#ifndef PLR_X3D_XML_SCAN_H
#define PLR_X3D_XML_SCAN_H

#include "x3d/text.h"

typedef enum x3d_xml_kind {
    X3D_XML_EOF,
    X3D_XML_START,
    X3D_XML_END,
    X3D_XML_TEXT,
    X3D_XML_CDATA
} x3d_xml_kind;

typedef struct x3d_xml_token {
    x3d_xml_kind kind;
    size_t at;         /* of the '<' */
    size_t start, end; /* START: what stands between '<' and '>' or '/>'; TEXT, CDATA: the text */
    bool empty;        /* <name/> */
} x3d_xml_token;

typedef struct x3d_xml_attribute {
    const char *name; /* without prefix */
    size_t name_length, name_at;
    size_t start, end; /* of the value, inside the quotes */
    bool prefixed;     /* xsi:..., xmlns:... */
} x3d_xml_attribute;

typedef struct x3d_xml_scan {
    const char *text;
    size_t length, at;
} x3d_xml_scan;

/* The next tag, text or CDATA section; comments and the like are passed over. */
x3d_xml_token x3d_xml_next(x3d_xml_scan *scan);
/* The name in a start tag, without prefix. */
x3d_xml_attribute x3d_xml_name(const x3d_xml_scan *scan, const x3d_xml_token *token);
/* The next attribute of a start tag; `*at` begins as 0. */
bool x3d_xml_next_attribute(const x3d_xml_scan *scan, const x3d_xml_token *token, size_t *at,
                            x3d_xml_attribute *attribute);
/* Raw bytes [start, end) with entities and line ends decoded; `cdata`: line ends only. `*unknown`
 * is set to the offset of an entity that is not known, else to SIZE_MAX. */
x3d_view x3d_xml_decode(plr_arena *arena, x3d_file *file, size_t start, size_t end, bool cdata,
                        size_t *unknown);

#endif
