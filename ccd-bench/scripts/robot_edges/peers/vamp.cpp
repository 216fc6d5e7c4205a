// VAMP's check of an edge of its Panda, as its planners call it, for vamp.py: a library of four functions. Set VAMP to
// the unpacked sources of vamp-planner, and PDQSORT to a folder with the header pdqsort.h:
//
//     c++ -std=c++17 -O3 -march=native -shared -fPIC -I$VAMP/src/impl -I$PDQSORT -I/usr/include/eigen3 \
//         ccd-bench/scripts/robot_edges/peers/vamp.cpp -o vamp_edges.so
//     export VAMP_EDGES=$PWD/vamp_edges.so VAMP_VERSION=0.6.4
#include <cstddef>
#include <vamp/collision/factory.hh>
#include <vamp/planning/validate.hh>
#include <vamp/robots/panda.hh>

namespace factory = vamp::collision::factory;
using Panda = vamp::robots::Panda;
constexpr std::size_t lanes = vamp::FloatVectorWidth;
static vamp::collision::Environment<float> cell;

extern "C" void clear() { cell = {}; }

extern "C" void add_shape(char kind, const float *sizes, const float *pose) {  // pose: by columns, 4 by 4
    const Eigen::Map<const Eigen::Matrix4f> at(pose);
    const Eigen::Vector3f x = at.col(0).head(3), y = at.col(1).head(3), z = at.col(2).head(3), p = at.col(3).head(3);
    if (kind == 'b') {
        cell.cuboids.emplace_back(p[0], p[1], p[2], x[0], x[1], x[2], y[0], y[1], y[2], z[0], z[1], z[2], sizes[0],
                                  sizes[1], sizes[2]);
    } else if (kind == 's') {
        cell.spheres.emplace_back(factory::sphere::flat(p[0], p[1], p[2], sizes[0]));
    } else {
        const Eigen::Vector3f a = p + sizes[1] * z, b = p - sizes[1] * z;
        cell.capsules.emplace_back(factory::capsule::endpoints::flat(a[0], a[1], a[2], b[0], b[1], b[2], sizes[0]));
    }
}

extern "C" int resolution() { return Panda::resolution; }  // configurations a radian

extern "C" void check(const float *edges, std::size_t count, bool *free) {
    cell.sort();
    const vamp::collision::Environment<vamp::FloatVector<lanes>> wide(cell);
    for (std::size_t k = 0; k < count; ++k) {
        Panda::ConfigurationBuffer start{}, end{};
        for (std::size_t j = 0; j < Panda::dimension; ++j) {
            start[j] = edges[2 * Panda::dimension * k + j];
            end[j] = edges[2 * Panda::dimension * k + Panda::dimension + j];
        }
        free[k] = vamp::planning::validate_motion<Panda, lanes, Panda::resolution>(
            Panda::Configuration(start.data()), Panda::Configuration(end.data()), wide);
    }
}
