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

use crate::rounding::two_sum;
use crate::scalar::Scalar;

/// `n` and `w = L / I^xx` in the principal frame, with what their last additions lost.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Pair<S> {
    pub(super) axis: [S; 3],
    pub(super) rate: [S; 3],
    pub(super) axis_low: [S; 3],
    pub(super) rate_low: [S; 3],
}

/// The kick of one stage: `w_x += n_y n_z (plain_x + gradient_x n.(s n))`, with the eigenvalues of `s` beside the gradient.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Kick<S> {
    plain: [S; 3],
    gradient: Option<([S; 3], [S; 3])>,
}

/// Largest angle (rad) at which the series below are full: their first omitted terms are `x^8 / 17!`, 1e-17 at `x = 0.49`.
pub(super) const LARGEST_ANGLE: f64 = 0.7;

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

/// A polynomial with seven powers of `x`, in pairs (Estrin): a chain of operations half as long as Horner's.
#[inline(always)]
fn polynomial<S: Scalar>(c: &[f64; 8], x: S, x2: S, x4: S) -> S {
    let pair = |k: usize| S::from_f64(c[k]) + x * c[k + 1];
    (pair(0) + x2 * pair(2)) + x4 * (pair(4) + x2 * pair(6))
}

#[inline(always)]
fn cross<S: Scalar>(a: &[S; 3], b: &[S; 3]) -> [S; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

#[inline(always)]
pub(super) fn dot<S: Scalar>(a: &[S; 3], b: &[S; 3]) -> S {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

impl<S: Scalar> Pair<S> {
    pub(super) fn new(axis: [S; 3], rate: [S; 3]) -> Self {
        let zero = [S::zero(); 3];
        Self { axis, rate, axis_low: zero, rate_low: zero }
    }

    /// Turns `n` about `w` by the angle `|w| tau`. The series of sine and cosine hold for an angle up to
    /// [`LARGEST_ANGLE`]` 2^halvings`: they are taken of the halved angle and doubled.
    #[inline(always)]
    pub(super) fn rotate(&mut self, tau: S, halvings: u32) {
        let w = &self.rate;
        let part = 0.5f64.powi(halvings as i32);
        let mut x = dot(w, w) * (tau * tau * (part * part));
        let x2 = x * x;
        let x4 = x2 * x2;
        let mut sine = polynomial(&SINE, x, x2, x4);
        let mut versine = polynomial(&VERSINE, x, x2, x4);
        for _ in 0..halvings {
            // Double angle: cos = 1 - x versine.
            (sine, versine) = (sine * (S::one() - x * versine), sine * sine * 0.5);
            x = x * 4.0;
        }
        let (sine, versine) = (sine * tau, versine * (tau * tau));
        let turn = cross(w, &self.axis);
        let bend = cross(w, &turn);
        for i in 0..3 {
            let change = turn[i] * sine + bend[i] * versine;
            (self.axis[i], self.axis_low[i]) = two_sum(self.axis[i], change + self.axis_low[i]);
        }
    }
}

impl<S: Scalar> Pair<S> {
    /// Kicks `w` at constant `n`.
    #[inline(always)]
    pub(super) fn kick(&mut self, kick: &Kick<S>) {
        let [x, y, z] = self.axis;
        let products = [y * z, z * x, x * y];
        let factors = match &kick.gradient {
            None => kick.plain,
            Some((tensor, gradient)) => {
                let potential = (x * x) * tensor[0] + (y * y) * tensor[1] + (z * z) * tensor[2];
                [0, 1, 2].map(|i| kick.plain[i] + gradient[i] * potential)
            }
        };
        for i in 0..3 {
            let change = products[i] * factors[i];
            (self.rate[i], self.rate_low[i]) = two_sum(self.rate[i], change + self.rate_low[i]);
        }
    }
}

/// What the motion depends on: `2 C / I^xx`, the traceless eigenvalues of `s^IJ`, and `d`.
#[derive(Debug, Clone, Copy)]
pub(super) struct Field<S> {
    strength: S,
    tensor: [S; 3],
    torque: [S; 3],
}

impl<S: Scalar> Field<S> {
    /// From `2 C / I^xx` and the eigenvalues of `s^IJ`. An isotropic part exerts no torque and is taken off.
    pub(super) fn new(strength: S, s: [S; 3]) -> Self {
        let mean = (s[0] + s[1] + s[2]) / 3.0;
        let torque = [s[1] - s[2], s[2] - s[0], s[0] - s[1]].map(|difference| difference * strength);
        Self { strength, tensor: s.map(|value| value - mean), torque }
    }

    /// The kick by `b V - c tau^2 Gamma.Gamma / I^xx` over the time `tau`.
    pub(super) fn kick(&self, b: f64, c: f64, tau: S) -> Kick<S> {
        let inner = tau * tau * self.strength * (2.0 * c);
        let plain = [0, 1, 2].map(|i| self.torque[i] * tau * (inner * self.tensor[i] + S::from_f64(b)));
        let gradient = (c != 0.0).then(|| (self.tensor, self.torque.map(|d| d * tau * inner * 2.0)));
        Kick { plain, gradient }
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
        pair.kick(&field.kick(0.0, 0.01, 0.7));
        for i in 0..3 {
            assert!((pair.rate[i] - expected[i] * 0.01 * 0.7f64.powi(3)).abs() < 1e-16, "{i}: {pair:?}, {expected:?}");
        }
    }

    #[test]
    fn rotation_is_that_of_rodrigues_at_any_angle() {
        for angle in [0.0, 1e-9, 0.3, 0.69, 1.4, 3.0, 20.0] {
            let halvings = (angle / LARGEST_ANGLE).log2().ceil().max(0.0) as u32;
            let mut pair = Pair::new([0.6, 0.0, 0.8], [0.0, 0.0, 2.0]);
            pair.rotate(angle / 2.0, halvings);
            let expected = [0.6 * angle.cos(), 0.6 * angle.sin(), 0.8];
            for i in 0..3 {
                assert!(
                    (pair.axis[i] - expected[i]).abs() < 1e-15 * (1.0 + 4f64.powi(halvings as i32)),
                    "{angle}: {pair:?}"
                );
            }
        }
    }
}
