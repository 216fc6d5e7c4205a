/* A ball falls onto a box: when does it touch? */
#include "rigid_ccd.h"
#include <stdio.h>

int main(void) {
    rccd_body *ball = NULL, *box = NULL;
    rccd_solver *solver = NULL;
    if (rccd_body_sphere(0.5, &ball) || rccd_body_box(1, 1, 0.5, &box) || rccd_solver_new(NULL, &solver)) {
        fprintf(stderr, "%s\n", rccd_last_error());
        return 1;
    }
    rccd_motion falls = rccd_motion_at_rest();
    falls.start.position[2] = 3;
    falls.velocity[2] = -2;
    rccd_moving_body a = {ball, &falls, NULL}, b = {box, NULL, NULL};
    rccd_answer answer = {.size = sizeof answer};
    if (rccd_first_contact(solver, &a, &b, 2, &answer)) {
        fprintf(stderr, "%s\n", rccd_last_error());
        return 1;
    }
    if (answer.outcome == RCCD_OUTCOME_CONTACT)
        printf("contact at %.9f in z = %.6f\n", answer.time, answer.witness_b[2]);
    else
        printf("free until %g\n", answer.safe_until);
    rccd_solver_free(solver);
    rccd_body_free(box);
    rccd_body_free(ball);
    return 0;
}
