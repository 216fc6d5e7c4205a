/* RCCD_SETTINGS_INIT is what rccd_settings_default fills in, in C and in C++. */

#include "rigid_ccd.h"

#include <stdio.h>

int main(void) {
    rccd_settings made = RCCD_SETTINGS_INIT;
    rccd_settings filled = RCCD_SETTINGS_INIT;
    filled.tolerance = 1.0;
    filled.margin = 1.0;
    filled.budget = 1;
    filled.deadline = 0.0;
    filled.start_policy = RCCD_START_POLICY_LEAVE;
    filled.contact_normals = RCCD_CONTACT_NORMALS_OF_PIECES;
    if (rccd_settings_default(&filled) != RCCD_STATUS_OK) return 1;
    if (made.size != filled.size || made.budget != filled.budget || made.stop != filled.stop) return 2;
    if (!(made.tolerance <= filled.tolerance && made.tolerance >= filled.tolerance)) return 3;
    if (!(made.margin <= filled.margin && made.margin >= filled.margin)) return 4;
    if (!(made.deadline <= filled.deadline && made.deadline >= filled.deadline)) return 5;
    if (made.start_policy != filled.start_policy || made.contact_normals != filled.contact_normals) return 6;
    printf("%s\n", rccd_version());
    return 0;
}
