#include <alea/alea.hpp>
#include <cstdio>

int main() {
  const alea::RigidTransform master_from_slave{alea::rotation_exp({0, 0, 0.1}), {1, 2, 3}};
  const alea::RigidTransform there_and_back = master_from_slave.inverse() * master_from_slave;
  std::printf("alea %s: %g\n", alea::version(), there_and_back.translation.norm());
  return alea::rotation_angle_rad(there_and_back.rotation) < 1e-12 ? 0 : 1;
}
