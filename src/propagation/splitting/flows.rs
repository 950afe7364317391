//! The two exact flows of the reduced motion, in the principal frame of `s^IJ`, by ring operations alone.
//!
//! With `w = L / I^xx` (a rate) and `d_x = 2 C (s^YY - s^ZZ) / I^xx` and its cyclic partners the reduced motion is
//!
//! ```text
//! dn/dt = w x n,    dw_x/dt = d_x n_y n_z    (cyclic)
//! ```
//!
//! and its Hamiltonian `H = T(L) + V(n)`, `T = L.L / (2 I^xx)`, `V = C n.(s n)`, has two parts that are each solved exactly:
//! `T` turns `n` about the constant `w`, `V` changes `w` at constant `n`. The double bracket of both is a function of `n` alone,
//!
//! ```text
//! {V, {T, V}} = Gamma.Gamma / I^xx,    Gamma = -2 C n x (s n)
//! ```
//!
//! so that it, too, only kicks `w` (Chin 1997 for particles; here the metric is that of the sphere). On the unit sphere and
//! with traceless `s` the kick by `b V - c tau^2 Gamma.Gamma / I^xx` over a time `tau` is
//!
//! ```text
//! w_x += tau d_x n_y n_z [ b + 2 c tau^2 (2 C / I^xx) (s^XX + 2 n.(s n)) ]    (cyclic)
//! ```
//!
//! which costs eight products more than the plain one.

use crate::propagation::splitting::ring::Ring;
use crate::rounding::two_sum;

/// `n` and `w = L / I^xx` in the principal frame, with what their last additions lost.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Pair<S> {
    pub(super) axis: [S; 3],
    pub(super) rate: [S; 3],
    pub(super) axis_low: [S; 3],
    pub(super) rate_low: [S; 3],
}

/// The kick of one stage: `w_x += n_y n_z (plain_x + gradient_x n.(s n))`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Kick<S> {
    plain: [S; 3],
    gradient: Option<[S; 3]>,
}

/// Largest angle (rad) at which the series below are full: their first omitted terms are `x^8 / 17!`, 1e-17 at `x = 0.49`.
const LARGEST_ANGLE: f64 = 0.7;

/// Inverse factorials `1 / (2k+1)!` with alternating signs: `sin(theta) / theta` in powers of `theta^2`.
const SINE: [f64; 8] = [
    1.0,
    -1.0 / 6.0,
    1.0 / 120.0,
    -1.0 / 5_040.0,
    1.0 / 362_880.0,
    -1.0 / 39_916_800.0,
    1.0 / 6_227_020_800.0,
    -1.0 / 1_307_674_368_000.0,
];

/// Inverse factorials `1 / (2k+2)!` with alternating signs: `(1 - cos(theta)) / theta^2` in powers of `theta^2`.
const VERSINE: [f64; 8] = [
    0.5,
    -1.0 / 24.0,
    1.0 / 720.0,
    -1.0 / 40_320.0,
    1.0 / 3_628_800.0,
    -1.0 / 479_001_600.0,
    1.0 / 87_178_291_200.0,
    -1.0 / 20_922_789_888_000.0,
];

/// How rotations find sine and cosine: alike for all motions side by side.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Angles {
    /// Halvings of the angle before the series, and doublings after them.
    halvings: u32,
    /// Terms of the series: 5, 6 or 8.
    terms: u32,
}

impl Angles {
    /// For angles up to `longest` (rad). Five and six terms are taken where what they omit is below 1e-19.
    pub(super) fn up_to(longest: f64) -> Self {
        let halvings = (longest / LARGEST_ANGLE).log2().ceil().max(0.0) as u32;
        let terms = match longest {
            ..0.09 => 5,
            0.09..0.19 => 6,
            _ => 8,
        };
        Self { halvings, terms }
    }
}

/// A polynomial in `x`, in pairs of its powers (Estrin): a chain of operations half as long as Horner's.
#[inline(always)]
fn polynomial<S: Ring>(c: &[f64; 8], terms: u32, x: S, x2: S, x4: S) -> S {
    let low = x2.mul_add(x.mul_add(x.like(c[3]), x.like(c[2])), x.mul_add(x.like(c[1]), x.like(c[0])));
    let high = match terms {
        5 => x.like(c[4]),
        6 => x.mul_add(x.like(c[5]), x.like(c[4])),
        _ => x2.mul_add(x.mul_add(x.like(c[7]), x.like(c[6])), x.mul_add(x.like(c[5]), x.like(c[4]))),
    };
    x4.mul_add(high, low)
}

#[inline(always)]
fn cross<S: Ring>(a: &[S; 3], b: &[S; 3]) -> [S; 3] {
    [a[1].mul_sub(b[2], a[2] * b[1]), a[2].mul_sub(b[0], a[0] * b[2]), a[0].mul_sub(b[1], a[1] * b[0])]
}

#[inline(always)]
pub(super) fn dot<S: Ring>(a: &[S; 3], b: &[S; 3]) -> S {
    a[2].mul_add(b[2], a[1].mul_add(b[1], a[0] * b[0]))
}

impl<S: Ring> Pair<S> {
    pub(super) fn new(axis: [S; 3], rate: [S; 3]) -> Self {
        let zero = [axis[0].like(0.0); 3];
        Self { axis, rate, axis_low: zero, rate_low: zero }
    }

    /// Turns `n` about `w` by the angle `|w| tau`, which must be among the `angles`.
    #[inline(always)]
    pub(super) fn rotate(&mut self, tau: S, angles: Angles) {
        let w = &self.rate;
        let Angles { halvings, terms } = angles;
        let tau2 = tau * tau;
        let mut x = dot(w, w) * tau2;
        if halvings > 0 {
            x = x * tau.like(0.25f64.powi(halvings as i32));
        }
        let x2 = x * x;
        let x4 = x2 * x2;
        let mut sine = polynomial(&SINE, terms, x, x2, x4);
        let mut versine = polynomial(&VERSINE, terms, x, x2, x4);
        for _ in 0..halvings {
            // Double angle: cos = 1 - x versine.
            (sine, versine) = (sine * (x.like(1.0) - x * versine), sine * sine * x.like(0.5));
            x = x * x.like(4.0);
        }
        let (sine, versine) = (sine * tau, versine * tau2);
        let turn = cross(w, &self.axis);
        let bend = cross(w, &turn);
        for i in 0..3 {
            let change = turn[i].mul_add(sine, bend[i].mul_add(versine, self.axis_low[i]));
            (self.axis[i], self.axis_low[i]) = two_sum(self.axis[i], change);
        }
    }

    /// Kicks `w` at constant `n`; `tensor` has the traceless eigenvalues of `s^IJ`.
    #[inline(always)]
    pub(super) fn kick(&mut self, kick: &Kick<S>, tensor: &[S; 3]) {
        let [x, y, z] = self.axis;
        let products = [y * z, z * x, x * y];
        let mut factors = kick.plain;
        if let Some(gradient) = &kick.gradient {
            let potential = dot(&[x * x, y * y, z * z], tensor);
            for i in 0..3 {
                factors[i] = gradient[i].mul_add(potential, factors[i]);
            }
        }
        for i in 0..3 {
            let change = products[i].mul_add(factors[i], self.rate_low[i]);
            (self.rate[i], self.rate_low[i]) = two_sum(self.rate[i], change);
        }
    }
}

/// What the motion depends on: `2 C / I^xx`, the traceless eigenvalues of `s^IJ`, and `d`.
#[derive(Debug, Clone, Copy)]
pub(super) struct Field<S> {
    pub(super) strength: S,
    pub(super) tensor: [S; 3],
    pub(super) torque: [S; 3],
}

impl Field<f64> {
    /// From `2 C / I^xx` and the eigenvalues of `s^IJ`. An isotropic part exerts no torque and is taken off.
    pub(super) fn new(strength: f64, s: [f64; 3]) -> Self {
        let mean = (s[0] + s[1] + s[2]) / 3.0;
        let torque = [s[1] - s[2], s[2] - s[0], s[0] - s[1]].map(|difference| difference * strength);
        Self { strength, tensor: s.map(|value| value - mean), torque }
    }
}

impl<S: Ring> Field<S> {
    /// The kick by `b V - c tau^2 Gamma.Gamma / I^xx` over the time `tau`.
    #[inline(always)]
    pub(super) fn kick(&self, b: f64, c: f64, tau: S) -> Kick<S> {
        let inner = tau * tau * self.strength * tau.like(2.0 * c);
        let mut plain = self.torque;
        let mut gradient = self.torque;
        for i in 0..3 {
            plain[i] = self.torque[i] * tau * (inner * self.tensor[i] + tau.like(b));
            gradient[i] = self.torque[i] * tau * inner * tau.like(2.0);
        }
        Kick { plain, gradient: if c != 0.0 { Some(gradient) } else { None } }
    }
}

#[cfg(test)]
mod tests {
    use num_dual::Dual64;

    use super::*;

    /// `|Gamma|^2 / (I^xx)^2`, for `n` of any length.
    fn gradient_squared(field: &Field<f64>, n: [Dual64; 3]) -> Dual64 {
        let torque = [n[1] * n[2] * field.torque[0], n[2] * n[0] * field.torque[1], n[0] * n[1] * field.torque[2]];
        torque.iter().map(|x| x * x).sum()
    }

    #[test]
    fn kick_of_the_force_gradient_is_that_of_its_potential() {
        let field = Field::new(1.7, [0.3, -0.2, 0.5]);
        let n = [0.48, 0.6, 0.64];
        let slope: [f64; 3] = [0, 1, 2].map(|i| {
            let mut at = n.map(Dual64::from_re);
            at[i].eps = 1.0;
            gradient_squared(&field, at).eps
        });
        // The potential -c tau^3 |Gamma|^2 / I^xx changes w by +c tau^3 n x d/dn of it over I^xx.
        let expected = cross(&n, &slope);
        let mut pair = Pair::new(n, [0.0; 3]);
        pair.kick(&field.kick(0.0, 0.01, 0.7), &field.tensor);
        for i in 0..3 {
            assert!((pair.rate[i] - expected[i] * 0.01 * 0.7f64.powi(3)).abs() < 1e-16, "{i}: {pair:?}, {expected:?}");
        }
    }

    #[test]
    fn rotation_is_that_of_rodrigues_at_any_angle() {
        for angle in [0.0, 1e-9, 0.089, 0.189, 0.3, 0.69, 1.4, 3.0, 20.0] {
            let angles = Angles::up_to(angle);
            let mut pair = Pair::new([0.6, 0.0, 0.8], [0.0, 0.0, 2.0]);
            pair.rotate(angle / 2.0, angles);
            let expected = [0.6 * angle.cos(), 0.6 * angle.sin(), 0.8];
            let allowed = 1e-15 * (1.0 + 4f64.powi(angles.halvings as i32));
            for (component, expected) in pair.axis.iter().zip(expected) {
                assert!((component - expected).abs() < allowed, "{angle}: {pair:?}");
            }
        }
    }
}
