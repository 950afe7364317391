//! Second time derivative of the moment-of-inertia tensor in the inertial frame, the source of the quadrupole wave.
//! Eqs. (60)-(65), (67), (68).
//!
//! `I^ij` is the moment of inertia, not the mass quadrupole; this is the reason for the minus sign of Eq. (59).
//!
//! ```
//! use nalgebra::{Matrix3, Vector3};
//! use twofold::dynamics::wave_source::{
//!     free_inertia_acceleration, rotation_rate, spheroid_inertia_acceleration, tensor_in_inertial_frame, wave_tensor,
//! };
//! use twofold::{BodyState, EulerAngles, EulerRates, RigidSpheroid, euler_angles::body_rates};
//!
//! // Free precession at constant inclination: from the state, from A^ij in the body, and by Eq. (68).
//! let (star, angles) = (RigidSpheroid::in_units_of_tc(1.1), EulerAngles { alpha: 0.3, beta: 0.7_f64, gamma: 0.1 });
//! let rates = EulerRates { alpha: 1.1 / angles.beta.cos(), beta: 0.0, gamma: -0.1 };
//! let state = BodyState::from_angles(&star, &angles, &rates);
//! let (rotation, omega) = (state.body_from_inertial(), body_rates(&angles, &rates));
//! let found = spheroid_inertia_acceleration(&star, &Matrix3::zeros(), &state.axis, &state.momentum);
//! let in_body = wave_tensor(&star.inertia(), &omega, &Vector3::zeros());
//! assert!((tensor_in_inertial_frame(&rotation, &in_body) - found).amax() < 1e-13);
//! assert!((free_inertia_acceleration(&star, angles.alpha, angles.beta, rates.alpha) - found).amax() < 1e-13);
//! // Rows of R are the body axes, and d e_z/dt has no component along e_z.
//! assert!(rotation_rate(&rotation, &rotation.tr_mul(&omega)).row(2).transpose().dot(&state.axis).abs() < 1e-15);
//! ```

use nalgebra::{Matrix3, Vector3};

use crate::dynamics::PrincipalInertia;
use crate::dynamics::RigidSpheroid;
use crate::dynamics::equations_of_motion::reduced_rates;
use crate::numerics::scalar::Scalar;

/// Inertial components `I^{IJ} = R^{iI} R^{jJ} I^{ij}` of a tensor given in the body frame, Eqs. (60) and (64).
pub fn tensor_in_inertial_frame<S: Scalar>(rotation: &Matrix3<S>, body: &Matrix3<S>) -> Matrix3<S> {
    rotation.transpose() * body * rotation
}

/// Rate `dR^{iI}/dt = epsilon^{IJK} Omega^J R^{iK}` of the rotation matrix, Eq. (62) `[1stdrmat]`, with `omega` in inertial
/// components: each row (body axis) turns by `d e_i/dt = Omega x e_i`, Eq. (61).
pub fn rotation_rate<S: Scalar>(rotation: &Matrix3<S>, omega: &Vector3<S>) -> Matrix3<S> {
    let row = |i: usize| omega.cross(&rotation.row(i).transpose()).transpose();
    Matrix3::from_rows(&[row(0), row(1), row(2)])
}

/// Body-frame tensor `A^{ij}` with `ddot I^{IJ} = R^{iI} R^{jJ} A^{ij}`, Eqs. (64), (65) `[gwa]`, for any three principal
/// moments of inertia and any torque.
///
/// With zero torque it is the free result of Zimmermann (1980).
pub fn wave_tensor<S: Scalar>(
    inertia: &PrincipalInertia<S>,
    omega_body: &Vector3<S>,
    torque_body: &Vector3<S>,
) -> Matrix3<S> {
    let [d1, d2, d3] = inertia.differences();
    let (o, g) = (omega_body, torque_body);
    let (xx, yy, zz) = (d1 * o.x * o.x, d2 * o.y * o.y, d3 * o.z * o.z);
    let xy = (d3 * d3 / inertia.zz + d1 - d2) * o.x * o.y + d3 / inertia.zz * g.z;
    let xz = (d2 * d2 / inertia.yy + d3 - d1) * o.x * o.z + d2 / inertia.yy * g.y;
    let yz = (d1 * d1 / inertia.xx + d2 - d3) * o.y * o.z + d1 / inertia.xx * g.x;
    Matrix3::new((yy - zz) * 2.0, xy, xz, xy, (zz - xx) * 2.0, yz, xz, yz, (xx - yy) * 2.0)
}

/// `ddot I^{IJ}` of a spheroid from its symmetry axis and angular momentum alone, inertial components:
///
/// ```text
/// ddot I = (I^zz - I^xx) (n'' n + 2 n' n' + n n''),    n' = L x n / I^xx,    n'' = (Gamma x n + L x n') / I^xx
/// ```
///
/// since `I^{IJ} = I^xx delta^{IJ} + (I^zz - I^xx) n^I n^J`. The angle of rotation about the symmetry axis does not enter.
pub fn spheroid_inertia_acceleration<S: Scalar>(
    spheroid: &RigidSpheroid<S>,
    s: &Matrix3<S>,
    axis: &Vector3<S>,
    momentum: &Vector3<S>,
) -> Matrix3<S> {
    let (rate, torque) = reduced_rates(spheroid, s, axis, momentum);
    let acceleration = (torque.cross(axis) + momentum.cross(&rate)) / spheroid.inertia_xx;
    let mixed = acceleration * axis.transpose();
    (mixed + mixed.transpose() + rate * rate.transpose() * S::from_f64(2.0))
        * (spheroid.inertia_zz - spheroid.inertia_xx)
}

/// `ddot I^{IJ}` of free precession about Z at constant `beta` and `alpha_rate`, Eq. (68) `[gwwf]`:
///
/// ```text
/// (1/2) Delta_2 a'^2 sin 2b  [ 2 cos 2a tan b   2 sin 2a tan b   -sin a ]
///                            [ 2 sin 2a tan b  -2 cos 2a tan b    cos a ]
///                            [    -sin a             cos a          0   ]
/// ```
///
/// written with `sin 2b tan b = 2 sin^2 b`, so that it is regular at `beta = pi/2`.
pub fn free_inertia_acceleration<S: Scalar>(
    spheroid: &RigidSpheroid<S>,
    alpha: S,
    beta: S,
    alpha_rate: S,
) -> Matrix3<S> {
    let (sa, ca) = alpha.sin_cos();
    let (sb, cb) = beta.sin_cos();
    let size = (spheroid.inertia_zz - spheroid.inertia_xx) * alpha_rate * alpha_rate;
    let (cos_2a, sin_2a) = (ca * ca - sa * sa, sa * ca * 2.0);
    let equatorial = size * sb * sb * 2.0;
    let polar = size * sb * cb;
    Matrix3::new(
        equatorial * cos_2a,
        equatorial * sin_2a,
        -(polar * sa),
        equatorial * sin_2a,
        -(equatorial * cos_2a),
        polar * ca,
        -(polar * sa),
        polar * ca,
        S::zero(),
    )
}
