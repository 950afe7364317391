//! The tangent maps of the exact flows: derivatives of a state in many directions, carried along with it.
//!
//! With the rotation `v -> v + p a x v + q a x (a x v)` of [`Turn`] by the vector `a = w tau`, and `dp = p' (a.da)`, `dq = q' (a.da)`, the
//! derivative of a rotated vector changes by
//!
//! ```text
//! dv -> R dv + M da,    R = 1 - q a^2 + p [a] + q a a^T
//!                       M = q (a.v) - [p v + q c] + (p' c + q' b - q v) a^T,    c = a x v,  b = a x c
//! ```
//!
//! and with `sigma = 2 C s / I^xx` a kick `w -> w + P x n`, `P = A sigma n + B (2 (n.sigma n) sigma n - sigma^2 n)`, changes `dw`
//! by `dP x n + P x dn`. The motion of `n` and `w` depends on the body and the field only through `sigma`.

use crate::numerics::ring::{FusedDouble, Ring};
use crate::propagation::splitting::flows::{AXIS, Angles, Kick, Moved, Moving, RATE, SINE, Turn, VERSINE};

/// Derivatives in several directions, one at each position of `T`.
#[derive(Clone, Copy)]
pub(super) struct Tangents<T, const V: usize> {
    /// Derivatives of the vectors of a state.
    pub(super) vectors: [[T; 3]; V],
    /// Derivatives of `sigma`, constant: the components xx, yy, zz, yz, zx, xy.
    pub(super) tensor: [T; 6],
}

/// A state with its derivatives.
#[derive(Clone, Copy)]
pub(super) struct WithTangents<T, const V: usize> {
    pub(super) state: Moving<FusedDouble, V>,
    pub(super) tangents: Tangents<T, V>,
    /// Principal values of `sigma`.
    pub(super) sigma: [f64; 3],
}

impl<T: Ring, const V: usize> Moved<FusedDouble> for WithTangents<T, V> {
    #[inline(always)]
    fn rotate(&mut self, tau: FusedDouble, angles: Angles) {
        let turn = Turn::new(self.state.vectors[RATE], tau, angles);
        self.tangents.rotate(&self.state, &turn, tau.0, angles);
        self.state.turn(&turn);
    }

    #[inline(always)]
    fn kick(&mut self, kick: &Kick<FusedDouble>) {
        self.tangents.kick(&doubles(&self.state.vectors[AXIS]), kick, self.sigma);
        self.state.kick(kick);
    }

    /// The derivatives are left unchanged: their rounding is relative to their size.
    #[inline(always)]
    fn project(&mut self, casimir: FusedDouble) {
        self.state.project(casimir);
    }
}

#[inline(always)]
fn doubles([x, y, z]: &[FusedDouble; 3]) -> [f64; 3] {
    [x.0, y.0, z.0]
}

type Matrix = [[f64; 3]; 3];

/// `[v]`, the matrix of `v x`.
#[inline(always)]
fn of_cross(v: [f64; 3]) -> Matrix {
    [[0.0, -v[2], v[1]], [v[2], 0.0, -v[0]], [-v[1], v[0], 0.0]]
}

// Loops and functions, not closures: closures given to `map` are compiled separately, without the instructions of the
// registers.

/// `to + matrix v`.
#[inline(always)]
fn add_product<T: Ring>(mut to: [T; 3], matrix: &Matrix, v: &[T; 3]) -> [T; 3] {
    for i in 0..3 {
        for j in 0..3 {
            to[i] = v[j].mul_add(v[j].like(matrix[i][j]), to[i]);
        }
    }
    to
}

/// `v.w` for doubles `w`.
#[inline(always)]
fn product<T: Ring>(v: &[T; 3], w: &[f64; 3]) -> T {
    v[2].mul_add(v[2].like(w[2]), v[1].mul_add(v[1].like(w[1]), v[0] * v[0].like(w[0])))
}

/// `sum k c_k x^(k-1)`: the slope of the polynomial of those coefficients, with as many terms as the polynomial itself.
#[inline(always)]
fn slope(c: &[f64; 8], x: f64, terms: u32) -> f64 {
    let x2 = x * x;
    let low = x2.mul_add((4.0 * c[4]).mul_add(x, 3.0 * c[3]), (2.0 * c[2]).mul_add(x, c[1]));
    if terms == 5 {
        return low;
    }
    (x2 * x2).mul_add((7.0 * c[7]).mul_add(x2, (6.0 * c[6]).mul_add(x, 5.0 * c[5])), low)
}

/// Derivatives with respect to `theta^2` of `sin(theta) / theta` and `(1 - cos(theta)) / theta^2`.
#[inline(always)]
fn slopes(turn: &Turn<FusedDouble>, terms: u32) -> [f64; 2] {
    let (x, sine, versine) = (turn.square.0, turn.sine.0, turn.versine.0);
    if x < 0.49 {
        [slope(&SINE, x, terms), slope(&VERSINE, x, terms)]
    } else {
        [(1.0 - x * versine - sine) / (2.0 * x), (0.5 * sine - versine) / x]
    }
}

/// `a x b`, fused.
#[inline(always)]
fn plain_cross(a: &[f64; 3], b: &[f64; 3]) -> [f64; 3] {
    [a[1].mul_add(b[2], -(a[2] * b[1])), a[2].mul_add(b[0], -(a[0] * b[2])), a[0].mul_add(b[1], -(a[1] * b[0]))]
}

/// `a.b`, fused.
#[inline(always)]
fn plain_dot(a: &[f64; 3], b: &[f64; 3]) -> f64 {
    a[2].mul_add(b[2], a[1].mul_add(b[1], a[0] * b[0]))
}

/// `M`, the matrix by which the derivative of `w tau` enters that of a rotated vector `v`.
#[inline(always)]
fn by_angle(v: &[f64; 3], turn: &Turn<FusedDouble>, [p_slope, q_slope]: [f64; 2]) -> Matrix {
    let (a, p, q) = (&doubles(&turn.angle), turn.sine.0, turn.versine.0);
    let c = plain_cross(a, v);
    let b = plain_cross(a, &c);
    let mut across = [0.0; 3];
    for i in 0..3 {
        across[i] = -p.mul_add(v[i], q * c[i]);
    }
    let mut matrix = of_cross(across);
    let along = q * plain_dot(a, v);
    for i in 0..3 {
        let stretch = p_slope.mul_add(c[i], q_slope.mul_add(b[i], -q * v[i]));
        for j in 0..3 {
            matrix[i][j] = stretch.mul_add(a[j], matrix[i][j]);
        }
        matrix[i][i] += along;
    }
    matrix
}

impl<T: Ring, const V: usize> Tangents<T, V> {
    #[inline(always)]
    fn rotate(&mut self, state: &Moving<FusedDouble, V>, turn: &Turn<FusedDouble>, tau: f64, angles: Angles) {
        let (w, p, q, square) = (doubles(&turn.angle), turn.sine.0, turn.versine.0, turn.square.0);
        let [of_sine, of_versine] = slopes(turn, angles.terms);
        let of_square = [2.0 * of_sine, 2.0 * of_versine];
        let mut turned = of_cross([p * w[0], p * w[1], p * w[2]]);
        let still = 1.0 - q * square;
        for i in 0..3 {
            let share = q * w[i];
            for j in 0..3 {
                turned[i][j] = share.mul_add(w[j], turned[i][j]);
            }
            turned[i][i] += still;
        }
        let zero = [self.tensor[0].like(0.0); 3];
        let mut of_angle = self.vectors[RATE];
        for component in &mut of_angle {
            *component = *component * component.like(tau);
        }
        for place in 0..V {
            if place != RATE {
                let matrix = by_angle(&doubles(&state.vectors[place]), turn, of_square);
                let by_itself = add_product(zero, &turned, &self.vectors[place]);
                self.vectors[place] = add_product(by_itself, &matrix, &of_angle);
            }
        }
    }

    #[inline(always)]
    fn kick(&mut self, n: &[f64; 3], kick: &Kick<FusedDouble>, sigma: [f64; 3]) {
        let (a, b) = (kick.of_potential.0, kick.of_bracket.0);
        let pulled = [sigma[0] * n[0], sigma[1] * n[1], sigma[2] * n[2]];
        let potential = 2.0 * plain_dot(n, &pulled);
        // P = f sigma n, f_i = A + B (2 n.(sigma n) - sigma_i), and
        // dP_i = f_i sigma_i dn_i + sum_j dsigma_ij (f_i n_j - B sigma_j n_j) + 2 B sigma_i n_i d(n.(sigma n)).
        let (mut pull, mut of_axis, mut of_tensor) = ([0.0; 3], [0.0; 3], [[0.0; 3]; 3]);
        for i in 0..3 {
            let share = b.mul_add(potential - sigma[i], a);
            of_axis[i] = share * sigma[i];
            pull[i] = share * pulled[i];
            for j in 0..3 {
                of_tensor[i][j] = share.mul_add(n[j], -b * pulled[j]);
            }
        }
        let [xx, yy, zz, yz, zx, xy] = self.tensor;
        let rows = [[xx, xy, zx], [xy, yy, yz], [zx, yz, zz]];
        let axis = self.vectors[AXIS];
        let mut y = axis;
        for i in 0..3 {
            y[i] = product(&rows[i], &of_tensor[i]);
            y[i] = axis[i].mul_add(xx.like(of_axis[i]), y[i]);
        }
        if kick.has_gradient() {
            let diagonal = product(&[xx, yy, zz], &[n[0] * n[0], n[1] * n[1], n[2] * n[2]]);
            let off_diagonal = product(&[yz, zx, xy], &[n[1] * n[2], n[2] * n[0], n[0] * n[1]]);
            let by_axis = product(&axis, &pulled);
            let change = (off_diagonal + by_axis).mul_add(xx.like(2.0), diagonal);
            for i in 0..3 {
                y[i] = change.mul_add(xx.like(2.0 * b * pulled[i]), y[i]);
            }
        }
        // dP x n + P x dn.
        for (i, rate) in self.vectors[RATE].iter_mut().enumerate() {
            let (j, k) = ((i + 1) % 3, (i + 2) % 3);
            let of_pull = y[k].mul_add(xx.like(-n[j]), y[j].mul_add(xx.like(n[k]), *rate));
            *rate = axis[j].mul_add(xx.like(-pull[k]), axis[k].mul_add(xx.like(pull[j]), of_pull));
        }
    }
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;

    use super::*;

    /// The exact slopes are `d/dx sin(t)/t = (cos(t) - sin(t)/t) / (2 x)` and
    /// `d/dx (1 - cos(t))/x = (sin(t)/t - 2 (1 - cos(t))/x) / (2 x)`, `x = t^2`.
    #[test]
    fn slopes_of_the_sine_and_the_versine_meet_where_the_series_end() {
        for angle in [0.2, 0.5, 0.699_999, 0.700_001, 0.9, 1.7, 3.0, 7.0_f64] {
            let x = angle * angle;
            let (sine, versine) = (angle.sin() / angle, 2.0 * (angle / 2.0).sin().powi(2) / x);
            let of = |v: f64| FusedDouble(v);
            let turn =
                Turn { angle: [of(angle), of(0.0), of(0.0)], square: of(x), sine: of(sine), versine: of(versine) };
            let found = slopes(&turn, 8);
            let exact = [(angle.cos() - sine) / (2.0 * x), (sine - 2.0 * versine) / (2.0 * x)];
            for (found, exact) in found.iter().zip(exact) {
                // The quotients cancel two digits for small angles.
                assert_relative_eq!(*found, exact, epsilon = 4e-16 / x, max_relative = 1e-15);
            }
        }
    }

    #[test]
    fn rounding_is_taken_out_of_the_state_and_not_of_its_derivatives() {
        let of = |v: [f64; 3]| v.map(FusedDouble);
        let state = Moving::new([of([0.48 + 1e-9, 0.6, 0.64]), of([0.3, -0.7, 1.1])]);
        let tangents = Tangents { vectors: [of([0.1, 0.2, 0.3]), of([0.4, 0.5, 0.6])], tensor: [FusedDouble(0.7); 6] };
        let mut moving = WithTangents { state, tangents, sigma: [0.3, -0.2, 0.5] };
        let casimir = FusedDouble(0.48 * 0.3 - 0.6 * 0.7 + 0.64 * 1.1);
        moving.project(casimir);
        let mut expected = state;
        expected.project(casimir);
        assert_eq!(moving.state, expected);
        assert_ne!(moving.state, state);
        assert_eq!(moving.tangents.vectors, tangents.vectors);
    }
}
