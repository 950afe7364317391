//! The mean Hamiltonian: the energy averaged over the fast rotation of `n` about `L`.
//!
//! With `l = L / G`, `c = n.l`, traceless `s`, `h = l.(s l)`, `m = |s l|^2`, `t = tr s^2`, `P2 = (3 c^2 - 1) / 2`:
//!
//! ```text
//! <H> = G^2 / (2 I^xx) + C P2 h + (C^2 I^xx / G^2) (a_1 h^2 + a_2 m + a_3 t) + O(s^3)
//!
//! a_1 = (5 - 126 c^2 + 153 c^4) / 16,    a_2 = -2 P2^2,    a_3 = (1 + 2 c^2 - 3 c^4) / 8
//! ```
//!
//! The first line's second term is the average of the potential `V`; the next is `<{V + <V>, W}> / 2` with the generator `W`
//! ([`generator`](super::generator())) and the bracket `{f, g} = L.(f_L x g_L) + n.(f_L x g_n + f_n x g_L)`.
//!
//! A centrifugal bulge ([`bulge`](crate::dynamics::bulge)) adds `b G^2 h` and nothing else: `b L.(s L)` has a vanishing bracket with `L.L`, so that
//! it is its own average, and its bracket with `W` has zero average, because `W` has zero average.

use nalgebra::Vector3;

use crate::dynamics::RigidSpheroid;
use crate::numerics::scalar::Real;

/// Order of averaging, in powers of `s`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum AveragingOrder {
    /// Rates to first order.
    First,
    /// Rates to second order.
    Second,
}

/// The mean potential of a rigid spheroid to the given order: the mean Hamiltonian without `G^2 / (2 I^xx)`, for traceless principal values `s`, the
/// size `G` of the angular momentum, `c = n.l` and the direction `l` of the angular momentum in the principal frame.
pub fn mean_potential<S: Real>(
    spheroid: &RigidSpheroid<S>,
    s: &Vector3<S>,
    size: S,
    c: S,
    direction: &Vector3<S>,
    order: AveragingOrder,
) -> S {
    slopes_along(spheroid, s, size, c, direction, order).value
}

/// The angular velocity `w = <H>_L` with which the averaged motion rotates every axis of the body, apart from the spin about `n`. It depends on the
/// components of `l` in the principal frame of `s`. The function returns the component `Lambda` of `w` along `l`, the principal values of the tensor
/// `k` that is applied to `l`, and the component `nu` along `n`, all in rad per unit of time:
///
/// ```text
/// w = Lambda l + k l + nu n,    k = (2 / G) (v_h s + v_m s^2),    nu = v_c / G,    Lambda = G / I^xx + v_G - c v_c / G - l.(k l)
/// ```
///
/// with `v` the [`mean_potential`] and `v_G` its slope with respect to `G` at fixed `l` and `c`. Hence `dl/dt = (k l) x l`.
pub fn mean_angular_velocity<S: Real>(
    spheroid: &RigidSpheroid<S>,
    s: &Vector3<S>,
    size: S,
    c: S,
    direction: &Vector3<S>,
    order: AveragingOrder,
) -> (S, Vector3<S>, S) {
    let slopes = slopes_along(spheroid, s, size, c, direction, order);
    let tensor = slopes.tensor(s, size);
    let carried = tensor.dot(&direction.component_mul(direction));
    (size / spheroid.inertia_xx + slopes.about_momentum(size, c) - carried, tensor, slopes.about_axis(size))
}

fn slopes_along<S: Real>(
    spheroid: &RigidSpheroid<S>,
    s: &Vector3<S>,
    size: S,
    c: S,
    direction: &Vector3<S>,
    order: AveragingOrder,
) -> MeanSlopes<S> {
    let pulled = s.component_mul(direction);
    let potential = MeanPotential {
        order,
        constant_c: spheroid.constant_c,
        inertia: spheroid.inertia_xx,
        bulge: S::zero(),
        square: s.dot(s),
    };
    potential.at(size, c, direction.dot(&pulled), pulled.dot(&pulled))
}

/// The quantities on which the mean potential depends besides `l`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct MeanPotential<S> {
    pub(super) order: AveragingOrder,
    /// `C`.
    pub(super) constant_c: S,
    /// `I^xx`.
    pub(super) inertia: S,
    /// `b`.
    pub(super) bulge: S,
    /// `tr s^2`.
    pub(super) square: S,
}

/// The mean potential and its slopes at one point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct MeanSlopes<S> {
    pub(super) value: S,
    /// With respect to `h` and `m`.
    pub(super) by_h: S,
    pub(super) by_m: S,
    /// With respect to `c`, and its slopes with respect to `h` and `m`.
    pub(super) by_c: S,
    pub(super) by_c_h: S,
    pub(super) by_c_m: S,
    /// With respect to `G` at fixed `l` and `c`, and its slopes with respect to `h` and `m`.
    pub(super) by_size: S,
    pub(super) by_size_h: S,
    pub(super) by_size_m: S,
}

impl<S: Real> MeanPotential<S> {
    pub(super) fn at(&self, size: S, c: S, h: S, m: S) -> MeanSlopes<S> {
        let c2 = c * c;
        let constant = self.constant_c;
        let p2 = (c2 * 3.0 - S::one()) * 0.5;
        let of_bulge = self.bulge * size;
        let first_by_h = constant * p2 + of_bulge * size;
        let first = MeanSlopes {
            value: first_by_h * h,
            by_h: first_by_h,
            by_m: S::zero(),
            by_c: constant * c * h * 3.0,
            by_c_h: constant * c * 3.0,
            by_c_m: S::zero(),
            by_size: of_bulge * h * 2.0,
            by_size_h: of_bulge * 2.0,
            by_size_m: S::zero(),
        };
        if self.order == AveragingOrder::First {
            return first;
        }
        let number = S::from_f64;
        let a1 = (number(5.0) + c2 * (c2 * 153.0 - number(126.0))) / 16.0;
        let a2 = -(p2 * p2) * 2.0;
        let a3 = (S::one() + c2 * (number(2.0) - c2 * 3.0)) / 8.0;
        let slope_1 = c * (c2 * 153.0 - number(63.0)) / 4.0;
        let slope_2 = -(p2 * c) * 12.0;
        let slope_3 = c * (S::one() - c2 * 3.0) / 2.0;
        let strength = constant * constant * self.inertia / (size * size);
        let second = strength * (a1 * h * h + a2 * m + a3 * self.square);
        MeanSlopes {
            value: first.value + second,
            by_h: first.by_h + strength * a1 * h * 2.0,
            by_m: strength * a2,
            by_c: first.by_c + strength * (slope_1 * h * h + slope_2 * m + slope_3 * self.square),
            by_c_h: first.by_c_h,
            by_c_m: strength * slope_2,
            by_size: first.by_size - second * 2.0 / size,
            by_size_h: first.by_size_h,
            by_size_m: -(strength * a2 * 2.0 / size),
        }
    }
}

impl<S: Real> MeanSlopes<S> {
    /// `(2 / G) (v_h s + v_m s^2)`.
    pub(super) fn tensor(&self, s: &Vector3<S>, size: S) -> Vector3<S> {
        s.map(|value| (self.by_h * value + self.by_m * value * value) * 2.0 / size)
    }

    /// `v_G - c v_c / G`.
    pub(super) fn about_momentum(&self, size: S, c: S) -> S {
        self.by_size - self.by_c * c / size
    }

    /// `v_c / G`.
    pub(super) fn about_axis(&self, size: S) -> S {
        self.by_c / size
    }
}
