/* Keys by their paths, elements of lists by number and by name, and their units. */
#include "study/key_names.h"
#include "testing.h"

START_TEST(keys_have_their_units)
{
    static const struct {
        const char *path, *text;
    } cases[] = {{"vessel.speed", "vessel.speed [m/s]"},
                 {"ice.thickness", "ice.thickness [m]"},
                 {"ice.concentration", "ice.concentration"},
                 {"vessel.mode", "vessel.mode"},
                 {"vessels[1].hull.length", "vessels[1].hull.length [m]"},
                 {"vessels.tanker.hull.length", "vessels.tanker.hull.length [m]"},
                 {"vessels.tanker.present", "vessels.tanker.present"},
                 {"ice.tanker.thickness", "ice.tanker.thickness"},
                 {"vessels.tanker.tug.speed", "vessels.tanker.tug.speed"},
                 {"ice.thicknes", "ice.thicknes"},
                 {"ice.thickness.more", "ice.thickness.more"},
                 {"", ""}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[KEY_TEXT_SIZE];
        key_with_unit(cases[i].path, text);
        ck_assert_str_eq(text, cases[i].text);
    }
    ck_assert_ptr_eq(key_of_path("vessels.tanker.hull.length"), key_of_path("vessels[3].hull.length"));
    ck_assert_ptr_nonnull(key_of_path("vessels.tanker.hull.length"));
    ck_assert_ptr_null(key_of_path("vessels.tanker.hul.length"));
}
END_TEST

TEST_MAIN("key names", keys_have_their_units)
