// Bullet comes in two precisions that share most of their symbol names. Everything of nilas that has a Bullet type in
// its interface lives in the inline namespace NILAS_BULLET, f64 or f32, so that a program and a library built for
// different ones do not link.
#pragma once

#include <LinearMath/btScalar.h>

#ifdef BT_USE_DOUBLE_PRECISION
#define NILAS_BULLET f64
#else
#define NILAS_BULLET f32
#endif
