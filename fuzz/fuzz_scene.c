/* scene_text_parse on any bytes.
   Promises: a refusal says where and why and leaves nothing behind; what is taken holds finite numbers and convex
   outlines. */
#include "fuzzing.h"
#include "io/scene_file.h"
#include <string.h>

static void check_scene(const scene_text *s)
{
    PROMISE(s->floes.count > 0 && s->floes.count <= SCENE_MOST_FLOES);
    for (int32_t i = 0; i < s->floes.count; i++) {
        polygon outline = scene_floe_outline(s, i);
        PROMISE(outline.count >= 3 && outline.count <= SCENE_MOST_SIDES);
        PROMISE(polygon_area(outline) > 0 && polygon_is_convex(outline));
        PROMISE(s->floes.data[i].thickness > 0 && s->floes.data[i].density > 0);
    }
    PROMISE(s->domain.lo.x < s->domain.hi.x && s->domain.lo.y < s->domain.hi.y);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    context ctx;
    context_init(&ctx);
    char *copy = malloc(size + 1);
    if (!copy)
        return 0;
    if (size > 0)
        memcpy(copy, data, size);
    copy[size] = '\0';
    scene_text scene;
    fram_error error = {0};
    fram_status status = scene_text_parse(&ctx, "fuzz.scene", copy, size, &scene, &error);
    if (status == FRAM_OK) {
        check_scene(&scene);
    } else {
        PROMISE(status == FRAM_ERROR_INPUT && error.status == status);
        PROMISE(strcmp(error.file, "fuzz.scene") == 0 && error.message[0] != '\0');
        PROMISE(!scene.floes.data && !scene.vertices.data);
    }
    scene_text_free(&ctx, &scene);
    free(copy);
    return 0;
}
