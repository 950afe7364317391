//! The two exact flows of the reduced motion, in the principal frame of `s^IJ`, by ring operations alone.
//!
//! With `w = L / I^xx` (a rate) and `d_x = 2 C (s^YY - s^ZZ) / I^xx` and its cyclic partners the reduced motion is
//!
//! ```text
//! dn/dt = w x n,    dw_x/dt = d_x n_y n_z    (cyclic)
//! ```
//!
//! and its Hamiltonian `H = T(L) + V(n)`, `T = L.L / (2 I^xx)`, `V = C n.(s n)`, has two parts that are each solved exactly: `T`
//! rotates `n` about the constant `w`, `V` changes `w` at constant `n`. The double bracket of both is a function of `n` alone,
//!
//! ```text
//! {V, {T, V}} = Gamma.Gamma / I^xx,    Gamma = -2 C n x (s n)
//! ```
//!
//! so that it also only kicks `w` (Chin 1997 for particles; here the metric is that of the sphere). On the unit sphere and
//! with traceless `s` the kick by `b V - c tau^2 Gamma.Gamma / I^xx` over a time `tau` is
//!
//! ```text
//! w_x += tau d_x n_y n_z [ b + 2 c tau^2 (2 C / I^xx) (s^XX + 2 n.(s n)) ]    (cyclic)
//! ```
//!
//! which costs eight operations more than the kick without gradient.

use crate::numerics::ring::{Double, Ring};
use crate::numerics::rounding::quick_two_sum;

/// Index of `n` among the vectors of a state.
pub(super) const AXIS: usize = 0;

/// Index of `w = L / I^xx`.
pub(super) const RATE: usize = 1;

/// Index of a vector normal to `n` that rotates about `w` like `n`, if it is carried; `e_x` follows from it.
pub(super) const COMPANION: usize = 2;

/// The quantities that the flows act on.
pub(super) trait Moved<S>: Copy {
    /// Rotates about `w` by the angle `|w| tau`, which must be among the `angles`.
    fn rotate(&mut self, tau: S, angles: Angles);
    /// Kicks `w` at constant `n`.
    fn kick(&mut self, kick: &Kick<S>);
    /// Removes rounding from the constants of every flow: `n.n = 1`, `w.n = casimir`.
    fn project(&mut self, casimir: S);
}

/// `n`, `w = L / I^xx` and, with `V = 3`, the vector carried along, in the principal frame, with the rounding errors of their
/// last additions.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Moving<S, const V: usize = 2> {
    pub(super) vectors: [[S; 3]; V],
    pub(super) low: [[S; 3]; V],
}

/// The kick of one stage: `w_x += n_y n_z (plain_x + gradient_x[0] n_x^2 + gradient_x[1] n_y^2)`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Kick<S> {
    plain: [S; 3],
    gradient: Option<[[S; 2]; 3]>,
    /// `b tau`.
    pub(super) of_potential: S,
    /// `2 c tau^3`.
    pub(super) of_bracket: S,
}

/// A rotation by the vector `theta = w tau`, given by its action on any vector:
/// `v + theta x v sine + theta x (theta x v) versine`.
#[derive(Debug, Clone, Copy)]
pub(super) struct Turn<S> {
    pub(super) angle: [S; 3],
    /// `theta^2`.
    pub(super) square: S,
    /// `sin(theta) / theta`.
    pub(super) sine: S,
    /// `(1 - cos(theta)) / theta^2`.
    pub(super) versine: S,
}

/// Largest angle (rad) at which the series below are accurate: their first omitted terms are `x^8 / 17!`, 1e-17 at
/// `x = 0.49`.
const LARGEST_ANGLE: f64 = 0.7;

/// Inverse factorials `1 / (2k+1)!` with alternating signs: `sin(theta) / theta` in powers of `theta^2`.
pub(super) const SINE: [f64; 8] = [
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
pub(super) const VERSINE: [f64; 8] = [
    0.5,
    -1.0 / 24.0,
    1.0 / 720.0,
    -1.0 / 40_320.0,
    1.0 / 3_628_800.0,
    -1.0 / 479_001_600.0,
    1.0 / 87_178_291_200.0,
    -1.0 / 20_922_789_888_000.0,
];

/// The evaluation of sine and cosine in rotations, identical for all motions side by side.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Angles {
    /// Halvings of the angle before the series, and doublings after them.
    halvings: u32,
    /// Terms of the series: 5, 6 or 8.
    pub(super) terms: u32,
}

/// The square of an angle with this many halvings is near the largest double.
const MOST_HALVINGS: f64 = 512.0;

impl Angles {
    /// The evaluation for angles up to `longest` (rad). Fewer than eight terms are used if the omitted ones are below 1e-19. Angles
    /// without any significant digit, including infinite ones, give no finite result.
    pub(super) fn up_to(longest: f64) -> Self {
        let halvings = (longest / LARGEST_ANGLE).log2().ceil().clamp(0.0, MOST_HALVINGS) as u32;
        let terms = match longest {
            ..0.09 => 5,
            0.09..0.19 => 6,
            _ => 8,
        };
        Self { halvings, terms }
    }
}

/// A polynomial in `x`, evaluated in pairs of its powers (Estrin): a chain of operations half as long as Horner's.
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
pub(super) fn cross<S: Ring>(a: &[S; 3], b: &[S; 3]) -> [S; 3] {
    [a[1].mul_sub(b[2], a[2] * b[1]), a[2].mul_sub(b[0], a[0] * b[2]), a[0].mul_sub(b[1], a[1] * b[0])]
}

#[inline(always)]
pub(super) fn dot<S: Ring>(a: &[S; 3], b: &[S; 3]) -> S {
    a[2].mul_add(b[2], a[1].mul_add(b[1], a[0] * b[0]))
}

impl<S> Kick<S> {
    /// Whether the kick has a force gradient.
    #[inline(always)]
    pub(super) fn has_gradient(&self) -> bool {
        self.gradient.is_some()
    }
}

impl<S: Ring> Turn<S> {
    /// The rotation about `w` by the angle `|w| tau`, which must be among the `angles`.
    #[inline(always)]
    pub(super) fn new(rate: [S; 3], tau: S, angles: Angles) -> Self {
        let Angles { halvings, terms } = angles;
        let angle = [rate[0] * tau, rate[1] * tau, rate[2] * tau];
        let mut x = dot(&angle, &angle);
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
        Self { angle, square: x, sine, versine }
    }

    /// Rotates a vector, including the rounding errors of its additions.
    #[inline(always)]
    pub(super) fn apply(&self, vector: &mut [S; 3], low: &mut [S; 3]) {
        let turn = cross(&self.angle, vector);
        let bend = cross(&self.angle, &turn);
        for i in 0..3 {
            let change = turn[i].mul_add(self.sine, bend[i].mul_add(self.versine, low[i]));
            (vector[i], low[i]) = quick_two_sum(vector[i], change);
        }
    }
}

impl<S: Ring, const V: usize> Moving<S, V> {
    pub(super) fn new(vectors: [[S; 3]; V]) -> Self {
        let zero = [vectors[AXIS][0].like(0.0); 3];
        Self { vectors, low: [zero; V] }
    }

    /// The same numbers in another type.
    #[inline(always)]
    pub(super) fn convert<T: Double>(&self) -> Moving<T, V>
    where
        S: Double,
    {
        let mut moving = Moving::new([[T::of(0.0); 3]; V]);
        for v in 0..V {
            for i in 0..3 {
                moving.vectors[v][i] = T::of(self.vectors[v][i].value());
                moving.low[v][i] = T::of(self.low[v][i].value());
            }
        }
        moving
    }

    /// Applies a rotation about `w`.
    #[inline(always)]
    pub(super) fn turn(&mut self, turn: &Turn<S>) {
        turn.apply(&mut self.vectors[AXIS], &mut self.low[AXIS]);
        if V > COMPANION {
            turn.apply(&mut self.vectors[COMPANION], &mut self.low[COMPANION]);
        }
    }
}

impl<S: Ring, const V: usize> Moved<S> for Moving<S, V> {
    #[inline(always)]
    fn rotate(&mut self, tau: S, angles: Angles) {
        self.turn(&Turn::new(self.vectors[RATE], tau, angles));
    }

    #[inline(always)]
    fn kick(&mut self, kick: &Kick<S>) {
        let [x, y, z] = self.vectors[AXIS];
        let products = [y * z, z * x, x * y];
        let mut factors = kick.plain;
        if let Some(gradient) = &kick.gradient {
            let (x2, y2) = (x * x, y * y);
            for i in 0..3 {
                factors[i] = gradient[i][0].mul_add(x2, gradient[i][1].mul_add(y2, factors[i]));
            }
        }
        let (rate, low) = (&mut self.vectors[RATE], &mut self.low[RATE]);
        for i in 0..3 {
            let change = products[i].mul_add(factors[i], low[i]);
            (rate[i], low[i]) = quick_two_sum(rate[i], change);
        }
    }

    #[inline(always)]
    fn project(&mut self, casimir: S) {
        project(self, casimir);
    }
}

/// Weight of a change of `w` relative to one of `n` when the value of `w.n` is corrected.
const SHARE_OF_RATE: f64 = 1e-4;

/// Corrects the effect of rounding on `n.n = 1` and `w.n = casimir`, both constant along every flow, and on the vector carried
/// along, which has length one and is normal to `n`. First order is sufficient, because the defects are of the size of rounding.
///
/// The rotations round in the same sense step after step, from `n` to the direction perpendicular to `w`. Therefore `n` is corrected,
/// in the plane of both; a change of `w` would add energy step by step. If `n` is nearly along `w`, correcting `n` alone would amplify
/// the rounding, and `w` takes a share.
#[inline(always)]
fn project<S: Ring, const V: usize>(state: &mut Moving<S, V>, casimir: S) {
    let (n, w) = (state.vectors[AXIS], state.vectors[RATE]);
    let (n_n, n_w, w_w) = (dot(&n, &n), dot(&n, &w), dot(&w, &w));
    let (one, half) = (casimir.like(1.0), casimir.like(0.5));
    let grow = (one - n_n) * half;
    let missing = casimir - n_w * (one + grow);
    let mut across = w;
    for i in 0..3 {
        across[i] = w[i] - n[i] * n_w;
    }
    let share = w_w * casimir.like(SHARE_OF_RATE);
    // No correction if the body does not rotate.
    let part = missing.over(dot(&across, &across) + share);
    for i in 0..3 {
        state.low[AXIS][i] = state.low[AXIS][i] + (n[i] * grow + across[i] * part);
        state.low[RATE][i] = state.low[RATE][i] + n[i] * (share * part);
    }
    if V > COMPANION {
        let u = state.vectors[COMPANION];
        let (grow, along) = ((one - dot(&u, &u)) * half, dot(&u, &n));
        for i in 0..3 {
            state.low[COMPANION][i] = state.low[COMPANION][i] + (u[i] * grow - n[i] * along);
        }
    }
}

/// The parameters of the motion: `2 C / I^xx`, the traceless eigenvalues of `s^IJ`, and `d`.
#[derive(Debug, Clone, Copy)]
pub(super) struct Field<S> {
    pub(super) strength: S,
    pub(super) tensor: [S; 3],
    pub(super) torque: [S; 3],
}

impl Field<f64> {
    /// The field from `2 C / I^xx` and the eigenvalues of `s^IJ`. An isotropic part exerts no torque and is subtracted.
    pub(super) fn new(strength: f64, s: [f64; 3]) -> Self {
        let mean = (s[0] + s[1] + s[2]) / 3.0;
        let torque = [s[1] - s[2], s[2] - s[0], s[0] - s[1]].map(|difference| difference * strength);
        Self { strength, tensor: s.map(|value| value - mean), torque }
    }

    /// The same numbers in another type.
    pub(super) fn convert<T: Double>(&self) -> Field<T> {
        Field { strength: T::of(self.strength), tensor: self.tensor.map(T::of), torque: self.torque.map(T::of) }
    }
}

impl<S: Ring> Field<S> {
    /// The kick by `b V - c tau^2 Gamma.Gamma / I^xx` over the time `tau`.
    #[inline(always)]
    pub(super) fn kick(&self, b: f64, c: f64, tau: S) -> Kick<S> {
        let inner = tau * tau * self.strength * tau.like(2.0 * c);
        let [x, y, z] = self.tensor;
        let two = tau.like(2.0);
        // On the unit sphere n.(s n) = s^ZZ + (s^XX - s^ZZ) n_x^2 + (s^YY - s^ZZ) n_y^2.
        let slopes = [(x - z) * two * inner, (y - z) * two * inner];
        let mut plain = self.torque;
        let mut gradient = [slopes; 3];
        for i in 0..3 {
            let share = self.torque[i] * tau;
            plain[i] = share * (inner * (self.tensor[i] + z * two) + tau.like(b));
            gradient[i] = [share * slopes[0], share * slopes[1]];
        }
        Kick {
            plain,
            gradient: if c != 0.0 { Some(gradient) } else { None },
            of_potential: tau * tau.like(b),
            of_bracket: tau * tau * tau * tau.like(2.0 * c),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rotation_is_that_of_rodrigues_at_any_angle() {
        for angle in [0.0, 1e-9, 0.029, 0.089, 0.189, 0.3, 0.69, 1.4, 3.0, 20.0] {
            let angles = Angles::up_to(angle);
            let mut moving = Moving::new([[0.6, 0.0, 0.8], [0.0, 0.0, 2.0]]);
            moving.rotate(angle / 2.0, angles);
            let expected = [0.6 * angle.cos(), 0.6 * angle.sin(), 0.8];
            let allowed = 1e-15 * (1.0 + 4f64.powi(angles.halvings as i32));
            for (component, expected) in moving.vectors[AXIS].iter().zip(expected) {
                assert!((component - expected).abs() < allowed, "{angle}: {moving:?}");
            }
        }
    }

    #[test]
    fn angles_are_halved_below_seven_tenths_and_their_series_cut_where_it_may() {
        let found = |angle| {
            let Angles { halvings, terms } = Angles::up_to(angle);
            (halvings, terms)
        };
        assert_eq!([0.05, 0.15, 0.5, 0.69].map(found), [(0, 5), (0, 6), (0, 8), (0, 8)]);
        assert_eq!([0.8, 1.3, 1.5, 2.7, 2.9].map(found), [(1, 8), (1, 8), (2, 8), (2, 8), (3, 8)]);
        // The square of a larger angle is not finite.
        assert_eq!(found(f64::INFINITY), (512, 8));
    }

    #[test]
    fn a_kick_has_a_gradient_if_its_weight_is_not_zero() {
        let field = Field::new(1.7, [0.3, -0.2, 0.5]);
        assert!([0.01, 1.0].iter().all(|&c| field.kick(0.5, c, 0.7).has_gradient()));
        assert!(!field.kick(0.5, 0.0, 0.7).has_gradient());
    }
}
