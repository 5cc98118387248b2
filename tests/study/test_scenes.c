/* The studies among the scenes are read without a mistake: every condition of each as a scenario, as before a study
 * runs. */
#include "study/study_file.h"
#include "testing.h"

#include <glob.h>

START_TEST(every_study_of_the_scenes_is_read)
{
    context ctx;
    context_init(&ctx);
    glob_t found;
    ck_assert_int_eq(glob("scenes/studies/*.yaml", 0, NULL, &found), 0);
    ck_assert_uint_ge(found.gl_pathc, 4);
    for (size_t i = 0; i < found.gl_pathc; i++) {
        study s;
        fram_error error = {0};
        fram_status status = study_read(&ctx, found.gl_pathv[i], &s, &error);
        ck_assert_msg(status == FRAM_OK, "%s: %s:%d: %s: %s", found.gl_pathv[i], error.file, error.line, error.key,
                      error.message);
        ck_assert_msg(s.conditions > 1 && s.seeds.least > 1, "%s compares nothing", found.gl_pathv[i]);
        study_free(&ctx, &s);
    }
    globfree(&found);
}
END_TEST

TEST_MAIN("studies of the scenes", every_study_of_the_scenes_is_read)
