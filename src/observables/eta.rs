//! The factor `eta` of Eq. (41) `[est1]`, derived from the averaged motion of the spin axis in single precession.
//!
//! The symmetry axis stays within a nutation, of first order in `s`, of the direction `l` of the angular momentum. Averaged
//! over many turns of the star, the remaining motion is [`secular_axis_rate`]. An observer in the direction `n-hat` then
//! sees
//!
//! ```text
//! |d cos lambda / dt| = |n-hat . dl/dt|,      eta = C |2 s^ZZ - s^XX - s^YY| / (I^zz Omega^z |n-hat . dl/dt|)
//! ```
//!
//! which makes Eq. (41) an equality. `eta` depends on the direction, on the position of the axis and on the shape of the
//! tensor, through the asymmetry ratio `r = (s^XX - s^YY) / (2 s^ZZ - s^XX - s^YY)`: 0 for a tensor symmetric about Z, 1/3
//! in size where `s^XX` or `s^YY` is midway between the others, 1 in size for one symmetric about X or Y. Where `s^ZZ` is midway `r`
//! diverges, and the unit of the speeds here, `C |2 s^ZZ - s^XX - s^YY| / (I^zz Omega^z)`, vanishes. `eta` does not depend on the
//! size of `s`.
//!
//! ```
//! use nalgebra::Vector3;
//! use twofold::lorentz_violation::PrincipalCoefficients;
//! use twofold::observables::eta::{
//!     mean_squared_speed, root_mean_square_eta, secular_axis_rate, single_precession_start, squared_speed,
//!     squared_speed_along_motion,
//! };
//!
//! // About Z alone the axis goes round at constant inclination, and its speed is sin(beta) cos(beta).
//! let beta = 0.7_f64;
//! let speed = (beta.sin() * beta.cos()).powi(2);
//! assert!((squared_speed(0.0, 0.3, beta) - speed).abs() < 1e-15);
//! assert!((mean_squared_speed(0.0, beta) - speed).abs() < 1e-15);
//! assert!((squared_speed_along_motion(0.0, 0.3, beta) - speed).abs() < 1e-12);
//! assert!((root_mean_square_eta(0.0, beta)? - (3.0 / speed).sqrt()).abs() < 1e-14);
//! assert_eq!(single_precession_start(0.0, 0.3, beta), (0.3, beta));
//! let s = PrincipalCoefficients::new([0.0, 0.0, 0.02]).tensor();
//! assert!(secular_axis_rate(1.0, 1.0, &s, &Vector3::new(beta.sin(), 0.0, beta.cos())).z == 0.0);
//! # Ok::<(), twofold::Error>(())
//! ```

use nalgebra::{Matrix3, Vector3};

use crate::error::Error;
use crate::numerics::scalar::{Real, Scalar};
use crate::solutions::averaged::mean_of_cn2;

/// Mean rate of the spin axis `l` (unit vector) in single precession, `dl/dt = (2 C / (I^zz Omega^z)) (s l) x l`, from
/// `I^zz / C` and the spin `Omega^z`: the torque on a star that spins about its symmetry axis, divided by its angular momentum.
///
/// For `s^XX = s^YY` it is a rotation about Z at the rate `a^(1)` of Eq. (31) `[consdef]`, as in Eq. (32) `[precangvel]`. Error: of
/// second order in `s`, plus the nutation, which averages out.
pub fn secular_axis_rate<S: Scalar>(polar_inertia_over_c: S, spin: S, s: &Matrix3<S>, axis: &Vector3<S>) -> Vector3<S> {
    (s * axis).cross(axis) * (S::from_f64(2.0) / (polar_inertia_over_c * spin))
}

/// Squared mean speed of the spin axis at the azimuth `alpha` and inclination `beta` (rad) for the asymmetry ratio `r`:
///
/// ```text
/// v^2 = 4 r^2 lX^2 lY^2 + (1 - r)^2 lX^2 lZ^2 + (1 + r)^2 lY^2 lZ^2,     l = (sin a sin b, -cos a sin b, cos b)
/// ```
pub fn squared_speed<S: Scalar>(asymmetry_ratio: S, alpha: S, beta: S) -> S {
    let r = asymmetry_ratio;
    let ((sa, ca), (sb, cb)) = (alpha.sin_cos(), beta.sin_cos());
    let (x, y) = (sa * sb, ca * sb);
    let (x2, y2, z2) = (x * x, y * y, cb * cb);
    let (with_x, with_y) = (S::one() - r, S::one() + r);
    r * r * x2 * y2 * 4.0 + with_x * with_x * x2 * z2 + with_y * with_y * y2 * z2
}

/// Mean of [`squared_speed`] over the azimuth, `sin^2 b [(1 + r^2) cos^2 b + (r^2 / 2) sin^2 b]`.
pub fn mean_squared_speed<S: Scalar>(asymmetry_ratio: S, beta: S) -> S {
    let r2 = asymmetry_ratio * asymmetry_ratio;
    let (sb, cb) = beta.sin_cos();
    let (sin2, cos2) = (sb * sb, cb * cb);
    sin2 * ((S::one() + r2) * cos2 + r2 * sin2 / 2.0)
}

/// The factor `eta` of Eq. (41) `[est1]` for the root mean square of `d cos lambda / dt` over isotropic directions to the
/// observer and over the azimuth of the spin axis at the inclination `beta` (rad) to Z, for the asymmetry ratio `r`:
///
/// ```text
/// eta = sqrt(3) / (sin b sqrt((1 + r^2) cos^2 b + (r^2 / 2) sin^2 b))
/// ```
///
/// For `r = 0` it is `sqrt(3) / (sin b cos b)`: the estimate `1 / cos b` of Eq. (40) `[est]` with the factor
/// `sin b |n-hat . dl/dt| / |dl/dt|` that is in Eqs. (38), (39) but not in the estimate. At `b = pi/2` it is `sqrt(6) / |r|`. A
/// single star may see a smaller change: for quantiles see [`EtaDistribution`](super::eta_distribution::EtaDistribution).
///
/// # Errors
/// [`Error::Domain`] where the axis is at rest, to 2.2e-16: at the poles, and for `r = 0` on the equator.
pub fn root_mean_square_eta<S: Real>(asymmetry_ratio: S, beta: S) -> Result<S, Error> {
    let mean = mean_squared_speed(asymmetry_ratio, beta);
    let speed = mean.re().sqrt();
    let allowed = "above 2.2e-16 of C |2 s^ZZ - s^XX - s^YY| / (I^zz Omega^z); an axis at rest gives no bound";
    Error::ensure(speed > f64::EPSILON, "root mean square speed of the spin axis", speed, allowed)?;
    Ok((S::from_f64(3.0) / mean).sqrt())
}

/// Mean of the squared speed along the whole secular motion through the azimuth `alpha` and inclination `beta` (rad), which
/// is that of the rotation axis of a free asymmetric top:
///
/// ```text
/// <v^2> = 4 (h - s3) [(s1 - h) - (s1 - s2) <sn^2>],    h = l.(s l),    s1 >= s2 >= s3
/// <sn^2> = (1 - E / K) / m,    1 - m = (s1 - s3)(s2 - h) / ((s2 - s3)(s1 - h))
/// ```
///
/// for `h <= s2`, and with `s1` and `s3` interchanged for `h >= s2`. On the separatrix, `h = s2`, it is zero: the axis stays
/// near the middle principal axis forever. Error: a few ulp of the terms.
pub fn squared_speed_along_motion<S: Real>(asymmetry_ratio: S, alpha: S, beta: S) -> S {
    let half = asymmetry_ratio * 0.5;
    // With 2 s^ZZ - s^XX - s^YY = 1; adding a multiple of the unit tensor makes no difference.
    let values = [half, -half, S::from_f64(0.5)];
    let ((sa, ca), (sb, cb)) = (alpha.sin_cos(), beta.sin_cos());
    let (x, y) = (sa * sb, ca * sb);
    let squares = [x * x, y * y, cb * cb];
    let mut order = [0, 1, 2];
    order.sort_by(|&i, &j| values[j].re().total_cmp(&values[i].re()));
    let margin = |[i, j, k]: [usize; 3]| (values[j] - values[k]) * squares[k] - (values[i] - values[j]) * squares[i];
    if margin(order).re() < 0.0 {
        order.reverse();
    }
    // Only differences of `h` from an eigenvalue are formed, as sums of terms of one sign where possible.
    let ([first, middle, last], [x2, y2, z2]) = (order.map(|i| values[i]), order.map(|i| squares[i]));
    let from_first = (first - middle) * y2 + (first - last) * z2;
    let from_last = (first - last) * x2 + (middle - last) * y2;
    let from_middle = margin(order);
    let complement = (first - last) * from_middle / ((middle - last) * from_first);
    // Zero or negative on the separatrix; NaN where the axis rests because two eigenvalues are equal.
    let mean_cn2 = if complement.re() > 0.0 {
        let parameter = (first - middle) * from_last / ((middle - last) * from_first);
        mean_of_cn2(parameter, complement.sqrt())
    } else {
        S::zero()
    };
    from_last * (from_middle + (first - middle) * mean_cn2) * 4.0
}

/// Azimuth and inclination `(alpha, beta)` (rad) at the start of a single precession with the constants `alpha_0`, `beta_0`
/// of Eq. (34) `[integraltoinitial]` and `A = 0`, for the asymmetry ratio `r`:
///
/// ```text
/// alpha = alpha_0 + (r / 2) sin 2 alpha_0,     beta = beta_0 - (r / 2) tan b0 cos 2 alpha_0
/// ```
///
/// The constant `beta_0` is not the inclination at any time; near `pi/2`, where `tan b0` is large, it is not even close to
/// one.
pub fn single_precession_start<S: Scalar>(asymmetry_ratio: S, alpha_0: S, beta_0: S) -> (S, S) {
    let ((sa, ca), (sb, cb)) = (alpha_0.sin_cos(), beta_0.sin_cos());
    let half = asymmetry_ratio / 2.0;
    (alpha_0 + half * sa * ca * 2.0, beta_0 - half * (sb / cb) * (ca * ca - sa * sa))
}
