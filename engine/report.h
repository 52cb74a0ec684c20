/* Messages of GLSL compilers, told at the author's line. No GL. */
#ifndef PLR_ENGINE_REPORT_H
#define PLR_ENGINE_REPORT_H

#include "engine/glsl.h"
#include "engine/recipe.h"

typedef struct plr_report {
    const plr_program *program;
    const plr_recipe *recipe;
    plr_stage stage; /* PLR_STAGE_COUNT: of linking the stages */
    plr_code code;
} plr_report;

/* The effect that a message is about, or PLR_NO_EFFECT; `mapped` says where (place.line 0:
 * nowhere). */
size_t plr_report_locate(const plr_report *report, const plr_glsl_message *message,
                         plr_mapped *mapped);
/* Adds the message to the diagnostics, in the author's words and at the author's place. */
void plr_report_add(const plr_report *report, const plr_glsl_message *message, plr_diags *diags);

/* Warns of functions of authors at plugs of the base that have another name today. */
void plr_report_deprecated(const plr_recipe *recipe, const plr_program *program, plr_diags *diags);

#endif
