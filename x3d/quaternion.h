/* Rotations of unit length: x, y, z, w. */
#ifndef PLR_X3D_QUATERNION_H
#define PLR_X3D_QUATERNION_H

/* From and to an SFRotation: axis and angle. An axis of length 0 is no turn. */
void x3d_quaternion_from(const float rotation[4], double q[4]);
void x3d_quaternion_to(const double q[4], float rotation[4]);
/* Part of the way, along the shorter arc. */
void x3d_quaternion_slerp(const double a[4], const double b[4], double weight, double q[4]);
/* The same without a look at which arc is shorter (for squad). */
void x3d_quaternion_slerp_as_is(const double a[4], const double b[4], double weight, double q[4]);
void x3d_quaternion_multiply(const double a[4], const double b[4], double q[4]);
/* Half the rotation vector of a rotation, and back. */
void x3d_quaternion_log(const double q[4], double v[3]);
void x3d_quaternion_exp(const double v[3], double q[4]);
/* The rotation of the axes of a matrix (column-major, its columns of length 1 and at right angles).
 */
void x3d_quaternion_from_matrix(const double m[16], double q[4]);

#endif
