// Vectors and matrices of the rigid body. SI units; world frame unless a name says otherwise.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>

namespace nilas {

using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;

namespace rigid {
// Not aligned: how it lies in memory does not depend on the instruction set that a host is compiled for.
using Quat = Eigen::Quaternion<double, Eigen::DontAlign>;
}  // namespace rigid

}  // namespace nilas
