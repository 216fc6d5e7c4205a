// A part of the program of handles.cpp.
#define RIGID_CCD_EXPECTED
#include "rigid_ccd_cell.hpp"

#include <cstdio>

int failures_as_values();

int failures_as_values() {
    const auto ball = rigid_ccd::Body::sphere(0.5), refused = rigid_ccd::Body::sphere(-1);
    if (!ball || refused) return 7;
    const auto pieces = ball->piece_count();
    if (!pieces || *pieces != 1) return 8;
    std::printf("handles hold\n");
    return 0;
}
