// SPDX-License-Identifier: BSD-3-Clause
#include <connectivity/boundary/rigid_map.hpp>

namespace connectivity {

RigidMap RigidMap::mirror(const Plane& plane) {
    const auto &n = plane.normal(), &p = plane.point();
    const double offset = n[0] * p[0] + n[1] * p[1] + n[2] * p[2];
    RigidMap map;
    for (int a = 0; a < 3; ++a) {
        for (int b = 0; b < 3; ++b) map.Q[3 * a + b] -= 2 * n[a] * n[b];
        map.t[a] = 2 * offset * n[a];
    }
    return map;
}

RigidMap RigidMap::then(const RigidMap& next) const {
    RigidMap both;
    for (int a = 0; a < 3; ++a)
        for (int b = 0; b < 3; ++b) {
            both.Q[3 * a + b] = 0;
            for (int c = 0; c < 3; ++c) both.Q[3 * a + b] += next.Q[3 * a + c] * Q[3 * c + b];
        }
    next.position<3>(t.data(), both.t.data());
    return both;
}

}  // namespace connectivity
