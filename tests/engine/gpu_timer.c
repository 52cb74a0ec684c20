/* Timestamps: taken, added up, and none where processors draw. */
#include <plugray/engine.h>

#include "engine/gpu_timer.h"
#include "tests/engine/triangle.h"
#include "tests/tap.h"

static void test_names(void) {
    CHECK(plr_renderer_is_software("llvmpipe (LLVM 15.0.6, 256 bits)"));
    CHECK(plr_renderer_is_software("zink (llvmpipe)"));
    CHECK(plr_renderer_is_software("softpipe"));
    CHECK(plr_renderer_is_software("SWR (LLVM 11.0, 256 bits)"));
    CHECK(plr_renderer_is_software("Software Rasterizer"));
    CHECK(plr_renderer_is_software("ANGLE (Google, Vulkan 1.3 (SwiftShader Device))"));
    CHECK(!plr_renderer_is_software("NVIDIA H200/PCIe/SSE2"));
    CHECK(!plr_renderer_is_software("AMD Radeon RX 6800 (navi21, LLVM 15.0.6, DRM 3.49)"));
    CHECK(!plr_renderer_is_software("Mesa Intel(R) UHD Graphics 630 (CFL GT2)"));
    CHECK(!plr_renderer_is_software(""));
}

/* Timestamps work on processors, too, where nothing asks for them. */
static void test_span(const plr_gl *gl) {
    static const float red[4] = {1, 0, 0, 1};
    plr_gpu_timer timer = {.queries = {0}};
    gl->GenQueries(2, timer.queries);
    plr_gpu_timer_start(&timer, gl);
    CHECK(triangle_works(gl, red));
    plr_gpu_timer_stop(&timer, gl);
    plr_gpu_timer_add(&timer, gl);
    double once = timer.ms;
    CHECK(once > 0 && once < 60000);
    plr_gpu_timer_add(&timer, gl);
    CHECK_NEAR(timer.ms, 2 * once, 1e-9);
    plr_gpu_timer_destroy(&timer, gl);
    CHECK_INT(gl->GetError(), GL_NO_ERROR);
}

int main(void) {
    test_names();
    plr_context *context = plr_context_create(PLR_BACKEND_AUTO, NULL);
    plr_gl gl;
    CHECK(context && plr_gl_load(&gl, plr_context_get_proc_address, context) == NULL);
    if (context) {
        plr_gpu_timer timer;
        bool software = plr_renderer_is_software((const char *)gl.GetString(GL_RENDERER));
        bool made = plr_gpu_timer_create(&timer, &gl);
        CHECK(made == !software);
        if (made)
            plr_gpu_timer_destroy(&timer, &gl);
        test_span(&gl);
    }
    plr_context_destroy(&context);
    return tap_done();
}
