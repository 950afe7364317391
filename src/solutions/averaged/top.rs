//! A direction that moves like the angular velocity of a free asymmetric top, and the frame that it carries along.
//!
//! ```text
//! dl/dt = (k l) x l,    dA/dt = [k l] A,    A(0) = 1,    l(t) = A(t) l(0)
//! ```
//!
//! for a diagonal tensor `k`: the problem of Euler and Jacobi, with `l` in place of the angular momentum in the body and `A` in place
//! of the inverse of the attitude. With `m_3` along the principal axis that `l` circles and `a = k_1 - k_2`, `b = k_2 - k_3`, of one
//! sign,
//!
//! ```text
//! m = (A_1 cn u, -+ A_2 sn u, +- A_3 dn u),    u = u_0 + lambda t,    lambda = b A_2 A_3 / A_1,    k^2 = a A_1^2 / (b A_3^2)
//! ```
//!
//! and the frame rotates about `l`, relative to the meridian of `m_1`, at the rate `k_2 - b dn^2 u / (1 + (A_1/A_3)^2 sn^2 u)`. Its
//! integral, of the third kind, has the mean growth `k_2 - b <dn^2 u / (1 + (A_1/A_3)^2 sn^2 u)>` and, relative to the meridian of `m_3`,
//! the angle of `theta_1(z + i eta)`, `z = pi u / (2 K)`, `sc(2 K eta / pi, k')^2 = b / a`. No coordinate is singular: where `A_1` vanishes
//! the meridian is that of `m / A_1`.

use core::f64::consts::{FRAC_PI_2, PI};

use nalgebra::{Matrix3, Vector3};

use crate::numerics::elliptic::carlson::{rf, rf_of_roots};
use crate::numerics::elliptic::jacobi::ArithmeticGeometricMean;
use crate::numerics::elliptic::theta::{Nome, ThetaSeries};
use crate::numerics::scalar::{Real, length};

use super::averages::{mean_of_cn2, mean_of_ratio};

/// `k'^2` up to which a motion is treated as being on the separatrix, because it is within the rounding of its start.
const SEPARATRIX: f64 = 1e-32;

/// The motion of a free asymmetric top.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Top<S> {
    course: Course<S>,
    /// Principal axes in the order of `m`.
    places: [usize; 3],
    /// Three signs: that of `m_2` makes the order of the axes right-handed; that of `m_3` is the side on which `l` is; that of `m_1` counts on a
    /// separatrix.
    signs: [f64; 3],
    amplitudes: [S; 3],
    /// `A_2 / A_1`.
    elongation: S,
    /// `a` and `b`.
    differences: [S; 2],
    /// `A_1^2 / b`.
    share: S,
    /// Mean rates of the phases (rad per unit of time).
    pub rates: TopPhases<S>,
    /// The phase `z` at the start.
    pub start: S,
}

#[derive(Debug, Clone, Copy, PartialEq)]
#[allow(clippy::large_enum_variant, reason = "one top at a time, and nothing on the heap")]
enum Course<S> {
    /// Neither `l` nor the quantities on which it depends change.
    Still { direction: Vector3<S> },
    /// `l` circles an axis. `parameter` is `k^2`, `complement_squared` is `k'^2`, `mean` is `pi / (2 K)` and `mean_cn2` the mean of `cn^2`.
    Round { theta: ThetaSeries<S>, nome: Nome<S>, parameter: S, complement_squared: S, mean: S, mean_cn2: S },
    /// `l` moves from one end of the middle axis to the other. `root_ratio` is `sqrt(a / b)`.
    Separatrix { root_ratio: S },
}

/// The quantities that grow with time: the phase `z` (on a separatrix `u`), and the angle about `l` without its periodic
/// part (rad).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TopPhases<S> {
    /// `z`, which grows by a turn when `l` circles its axis once, in either sense.
    pub slow: S,
    /// The angle about `l`.
    pub about: S,
}

/// A top at a phase.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TopShape<S> {
    /// Columns: along the meridian of the axis that `l` circles, along its parallel, and `l`.
    pub frame: Matrix3<S>,
    /// Cosine and sine of the periodic part of the angle about `l`, times a positive number.
    pub turned: [S; 2],
    /// Periodic part of the integral of `(A_1^2 / b) sn^2 u` over time: see [`Top::squares`].
    pub integral: S,
}

/// The theta functions of a motion, shifted by `r = exp(-pi v / K)`, `v = F(arctan sqrt(b/a), k')`; for small `a` and with
/// `elongated = A_1^2 / A_3^2` that is `a (1 + sqrt(1 + elongated))^2 / (16 b)`.
fn series<S: Real>(nome: &Nome<S>, mean: S, a: S, b: S, elongated: S) -> ThetaSeries<S> {
    let one = S::one();
    if a.re() == 0.0 {
        let root = one + (one + elongated).sqrt();
        let square = root * root;
        return ThetaSeries::new(nome.q, a / b * square / 16.0, elongated / square);
    }
    let whole = a + b;
    let v = (b / whole).sqrt() * rf(a / whole, (a + a * elongated) / whole, one);
    if let Some(decay) = nome.decay {
        // pi eta / decay = pi v / (2 K')
        return ThetaSeries::transformed(decay, v * mean * S::from_f64(PI) / decay);
    }
    let r = (v * mean * -2.0).exp();
    ThetaSeries::new(nome.q, r, nome.q / r)
}

impl<S: Real> Top<S> {
    /// The motion from the unit vector `l`, for the principal values `k` of the tensor.
    ///
    /// For `k'^2` up to 1e-32, which is within the rounding of the start, the motion is taken to be on the separatrix.
    ///
    /// First derivatives exist if `l` circles an axis at a distance from it, also for two equal principal values.
    /// On an axis, at rest and on the separatrix there are none.
    pub fn new(k: [S; 3], l: &Vector3<S>) -> Self {
        let (zero, one) = (S::zero(), S::one());
        let mut order = [0, 1, 2];
        order.sort_by(|&i, &j| k[j].re().total_cmp(&k[i].re()));
        let [x, _, z] = order.map(|i| l[i]);
        let (upper, lower) = (k[order[0]] - k[order[1]], k[order[1]] - k[order[2]]);
        // k_2 - l.(k l): positive if l circles the axis of the smallest value.
        let margin = lower * z * z - upper * x * x;
        let round_third = margin.re() > 0.0;
        let (places, a, b) =
            if round_third { (order, upper, lower) } else { ([order[2], order[1], order[0]], -lower, -upper) };
        let odd = [[0, 2, 1], [2, 1, 0], [1, 0, 2]].contains(&places);
        let handed = if odd { -1.0 } else { 1.0 };
        let m = [l[places[0]], l[places[1]] * handed, l[places[2]]];
        let side = if m[2].re() < 0.0 { -1.0 } else { 1.0 };
        let energy = k[0] * l.x * l.x + k[1] * l.y * l.y + k[2] * l.z * l.z;
        let still = Self {
            course: Course::Still { direction: *l },
            places,
            signs: [handed, side, 1.0],
            amplitudes: m,
            elongation: one,
            differences: [a, b],
            share: zero,
            rates: TopPhases { slow: zero, about: energy },
            start: zero,
        };
        let whole = a + b;
        let on_middle = m[0].re() * m[0].re() == 0.0 && m[2].re() * m[2].re() == 0.0;
        if whole.re() == 0.0 || on_middle || (margin.re() == 0.0 && b.re() == 0.0) {
            return still;
        }
        let [first_squared, third_squared] =
            [m[0] * m[0] + m[1] * m[1] * (b / whole), m[2] * m[2] + m[1] * m[1] * (a / whole)];
        let elongation = (whole / b).sqrt();
        if third_squared.re() <= 0.0 {
            return still;
        }
        let first = if first_squared.re() > 0.0 { first_squared.sqrt() } else { zero };
        let third = third_squared.sqrt();
        let amplitudes = [first, first * elongation, third];
        let sense = if b.re() < 0.0 { -1.0 } else { 1.0 };
        let lambda = (b * whole).sqrt() * third * sense;
        let complement_squared = margin.abs() / (b.abs() * third_squared);
        let elongated = first_squared / third_squared;
        let parameter = a / b * elongated;
        // If the amplitude vanishes, the phase is arbitrary.
        let (cn, sn) = if first.re() > 0.0 { (m[0] / first, m[1] / amplitudes[1] * -side) } else { (one, zero) };
        let dn = m[2].abs() / third;
        let share = if first.re() > 0.0 { first_squared / b } else { zero };
        let moving = Self { amplitudes, elongation, share, ..still };
        if complement_squared.re() <= SEPARATRIX {
            let root_ratio = (a / b).sqrt();
            // sn = tanh u, dn = 1 / cosh u, and also cn, which does not change its sign: on the far side m_1 and m_2 have
            // the opposite sign.
            let front = if m[0].re() < 0.0 { -1.0 } else { 1.0 };
            let u = ((one + sn.abs()) / dn).ln() * if sn.re() < 0.0 { -front } else { front };
            return Self {
                course: Course::Separatrix { root_ratio },
                rates: TopPhases { slow: lambda, about: k[places[1]] },
                start: u,
                signs: [handed, side, front],
                ..moving
            };
        }
        let complement = complement_squared.sqrt();
        let mean = ArithmeticGeometricMean::new(one, complement).limit();
        let mean_cn2 = mean_of_cn2(parameter, complement);
        let nome = Nome::new(parameter, complement_squared);
        let theta = series(&nome, mean, a, b, elongated);
        let quarter = S::from_f64(FRAC_PI_2) / mean;
        // F(u) from its sine, with the root of cn^2 known.
        let first_half = sn * rf_of_roots(cn.abs(), dn + one, dn);
        let u = if cn.re() < 0.0 { quarter * 2.0 - first_half } else { first_half };
        let slow = lambda * mean;
        // Computed from the nearer value.
        let along = mean_of_ratio(complement, one + elongated, [one, complement_squared]);
        let about = if along.re() < 0.5 {
            k[places[1]] - b * along
        } else {
            k[places[2]] + whole * elongated * mean_of_ratio(complement, one + elongated, [zero, one])
        };
        Self {
            course: Course::Round { theta, nome, parameter, complement_squared, mean, mean_cn2 },
            rates: TopPhases { slow, about },
            start: u * mean,
            ..moving
        }
    }

    /// Whether `l` circles an axis, at a distance from it and from the separatrix.
    pub(crate) fn goes_round(&self) -> bool {
        matches!(self.course, Course::Round { .. }) && self.amplitudes[0].re() > 0.0
    }

    /// The principal axis that `l` circles.
    pub(crate) fn axis(&self) -> usize {
        self.places[2]
    }

    /// Mean rate (rad per unit of time) at which `l` circles that axis.
    pub(crate) fn rate_about_axis(&self) -> S {
        self.rates.slow * -self.signs[1]
    }

    /// `k'`: one if the phase grows uniformly and zero on the separatrix, the only place where the motion is not periodic in the phase.
    pub fn complement(&self) -> f64 {
        match &self.course {
            Course::Still { .. } => 1.0,
            Course::Round { complement_squared, .. } => complement_squared.re().sqrt(),
            Course::Separatrix { .. } => 0.0,
        }
    }

    /// Whether both tops circle the same axis on the same side, or both are at rest.
    pub(super) fn is_beside(&self, other: &Self) -> bool {
        let same_side = self.places[2] == other.places[2] && self.signs[1] == other.signs[1];
        match (&self.course, &other.course) {
            (Course::Round { .. }, Course::Round { .. }) => same_side,
            (Course::Still { .. }, Course::Still { .. }) => true,
            _ => false,
        }
    }

    /// Largest speed of `l`, where it crosses the plane of `m_2` and `m_3`, or of `m_1` and `m_3`.
    pub(super) fn largest_speed(&self) -> f64 {
        let rates = self.rates.slow.re().abs();
        let [first, second, _] = self.amplitudes.map(S::re);
        match &self.course {
            Course::Still { .. } => 0.0,
            // |dm/du| is at most A_2 for sn, A_1 for cn and k^2 A_3 / 2 for dn, which is less.
            Course::Round { mean, .. } => rates / mean.re() * (first * first + second * second).sqrt(),
            Course::Separatrix { .. } => rates * (first * first + second * second).sqrt(),
        }
    }

    /// Mean of the squares of the components of `l`.
    pub fn mean_squares(&self) -> Vector3<S> {
        match &self.course {
            Course::Still { direction } => direction.component_mul(direction),
            // dn^2 = cn^2 + k'^2 sn^2
            Course::Round { mean_cn2, complement_squared, .. } => {
                let mean_sn2 = S::one() - *mean_cn2;
                self.in_places([*mean_cn2, mean_sn2, *mean_cn2 + *complement_squared * mean_sn2])
            }
            Course::Separatrix { .. } => self.in_places([S::zero(), S::one(), S::zero()]),
        }
    }

    /// Periodic part of the integral of the squares of the components of `l` over time, from the periodic integral of a
    /// [shape](TopShape::integral).
    pub fn squares(&self, integral: S) -> Vector3<S> {
        let [a, b] = self.differences;
        let mut squares = Vector3::zeros();
        for (place, factor) in self.places.into_iter().zip([-b, a + b, -a]) {
            squares[place] = integral * factor;
        }
        squares
    }

    /// The product of the differences of values along the principal axes, in the order of `m`: `(v_1 - v_2) (v_2 - v_3) (v_1 - v_3)`.
    pub(super) fn product_of_differences(&self, values: &Vector3<S>) -> S {
        let [first, second, third] = self.places.map(|place| values[place]);
        (first - second) * (second - third) * (first - third)
    }

    /// Multiples of the squares of the amplitudes, in the order of the given axes.
    fn in_places(&self, factors: [S; 3]) -> Vector3<S> {
        let mut squares = Vector3::zeros();
        for ((place, factor), amplitude) in self.places.into_iter().zip(factors).zip(self.amplitudes) {
            squares[place] = amplitude * amplitude * factor;
        }
        squares
    }

    /// The top at a phase `z`, on a separatrix `u`; any phase if it is at rest.
    pub fn at(&self, phase: S) -> TopShape<S> {
        let (sn, cn, dn, turned, sn2_integral) = match &self.course {
            Course::Still { direction } => return still_shape(direction),
            Course::Round { theta, nome, parameter, mean, .. } => {
                let (sin, cos) = phase.sin_cos();
                let at = theta.at(sin, cos);
                let zeta_over_m = if parameter.re() > 0.0 {
                    at.slope / *parameter
                } else {
                    // 4 (q sin 2z + q^2 sin 4z) / m, which has the first derivative by m.
                    nome.q_over_m * sin * cos * (S::one() + nome.q * (cos * cos - sin * sin) * 2.0) * 8.0
                };
                // The angle is minus that of the shifted function.
                (at.sn, at.cn, at.dn, [at.shifted[0], -at.shifted[1]], -(zeta_over_m * *mean * *mean / self.rates.slow))
            }
            Course::Separatrix { root_ratio } => {
                let sign = if phase.re() < 0.0 { -1.0 } else { 1.0 };
                let down = (phase * -sign).exp();
                let whole = S::one() + down * down;
                let (sech, tanh) = (down * 2.0 / whole, (S::one() - down * down) / whole * sign);
                (tanh, sech, sech, [S::one(), *root_ratio * tanh], -tanh / self.rates.slow)
            }
        };
        let [handed, side, front] = self.signs;
        let across = [cn * front, sn * self.elongation * -side * front];
        let size = (across[0] * across[0] + across[1] * across[1]).sqrt();
        let (x, y) = (across[0] / size, across[1] / size);
        let (rho, height) = (self.amplitudes[0] * size, self.amplitudes[2] * dn * side);
        let columns = [[height * x, height * y, -rho], [-y, x, S::zero()], [rho * x, rho * y, height]];
        let mut frame = Matrix3::zeros();
        for (j, column) in columns.into_iter().enumerate() {
            for (i, component) in column.into_iter().enumerate() {
                frame[(self.places[i], j)] = if i == 1 { component * handed } else { component };
            }
        }
        TopShape { frame, turned, integral: sn2_integral * self.share }
    }
}

/// An arbitrary frame with `l` as its third axis.
fn still_shape<S: Real>(l: &Vector3<S>) -> TopShape<S> {
    let least = (0..3).min_by(|&i, &j| l[i].re().abs().total_cmp(&l[j].re().abs())).unwrap_or_default();
    let mut pole = Vector3::zeros();
    pole[least] = S::one();
    let parallel = pole.cross(l);
    let parallel = parallel / length(&parallel);
    let frame = Matrix3::from_columns(&[parallel.cross(l), parallel, *l]);
    TopShape { frame, turned: [S::one(), S::zero()], integral: S::zero() }
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;

    use super::*;

    const K: [f64; 3] = [4.5, 0.5, -0.5];

    /// `l` and the frame about it rotate at the rate `k l`: on both sides of each axis, and on the separatrix, before and after `l` crosses the plane
    /// normal to the middle axis.
    #[test]
    fn frames_turn_at_the_rate_of_the_top() {
        // (k_1 - k_2) x^2 = (k_2 - k_3) z^2 is the separatrix.
        let [upper, lower] = [K[0] - K[1], K[1] - K[2]];
        let on_separatrix = |x: f64, y: f64, z: f64| {
            let l = Vector3::new(x * lower.sqrt(), y, z * upper.sqrt()).normalize();
            // Within the range that counts as the separatrix.
            let top = Top::new(K, &l);
            assert_eq!(top.complement(), 0.0, "{l}");
            top
        };
        let tops = [
            Top::new(K, &Vector3::new(0.9, 0.2, 0.3).normalize()),
            Top::new(K, &Vector3::new(-0.1, 0.2, -0.9).normalize()),
            on_separatrix(1.0, 0.3, 1.0),
            on_separatrix(-1.0, 0.3, 1.0),
            on_separatrix(1.0, -0.9, -1.0),
            on_separatrix(-1.0, -0.2, -1.0),
        ];
        for top in tops {
            let at = |t: f64| {
                let shape = top.at(top.start + top.rates.slow * t);
                let angle = top.rates.about * t + shape.turned[1].atan2(shape.turned[0]);
                shape.frame * nalgebra::Rotation3::from_axis_angle(&Vector3::z_axis(), angle)
            };
            for t in [-5.0, -0.7, 0.0, 0.4, 6.0] {
                let h = 1e-5;
                let (before, frame, after) = (at(t - h), at(t), at(t + h));
                let l = frame.column(2).into_owned();
                let rate = Vector3::from(K).component_mul(&l);
                for i in 0..3 {
                    let slope = (after.column(i) - before.column(i)) / (2.0 * h);
                    assert!((slope - rate.cross(&frame.column(i))).amax() < 1e-8, "{top:?} at {t}");
                }
            }
        }
        // Nothing moves on the middle axis, nor where the squares of the other components underflow.
        assert_eq!(Top::new(K, &Vector3::new(1e-170, 1.0, 1e-170)).rates.slow, 0.0);
    }

    #[test]
    fn tops_are_beside_each_other_on_one_side_of_one_axis() {
        let top = |direction: [f64; 3]| Top::new(K, &Vector3::from(direction).normalize());
        let (round_x, round_z) = (top([0.9, 0.2, 0.3]), top([0.1, 0.2, 0.9]));
        assert!(round_x.is_beside(&top([0.8, -0.3, 0.1])) && round_z.is_beside(&top([0.2, -0.3, 0.8])));
        assert!(!round_x.is_beside(&round_z) && !round_x.is_beside(&top([-0.9, 0.2, 0.3])));
        // At rest at all points, as for a sphere.
        let still = |direction: [f64; 3]| Top::new([0.5; 3], &Vector3::from(direction).normalize());
        assert!(still([0.9, 0.2, 0.3]).is_beside(&still([0.1, 0.2, -0.9])));
        assert!(!still([0.9, 0.2, 0.3]).is_beside(&round_x) && !round_x.is_beside(&still([0.9, 0.2, 0.3])));
        assert_eq!(still([0.9, 0.2, 0.3]).largest_speed(), 0.0);
    }

    /// For `l` in the plane of the outer axes, with `A_2 = 1`: `|k l x l|` there is `(k_1 - k_3) m_1 m_3`.
    #[test]
    fn the_largest_speed_on_the_separatrix_bounds_that_along_it() {
        let (x, z) = (0.3125_f64, 0.625_f64);
        let top = Top::new(K, &Vector3::new(x, (1.0 - x * x - z * z).sqrt(), z));
        assert_eq!(top.complement(), 0.0);
        let (first, third) = (0.2_f64.sqrt(), 0.8_f64.sqrt());
        let fastest = 5.0 * first * third;
        // The bound adds the largest speeds of both parts: it is determined by the axis of the largest value, with the component along the
        // third for m_1.
        assert_relative_eq!(top.largest_speed(), fastest * (1.0 + third * third).sqrt(), max_relative = 1e-12);
    }

    /// Long before and long after its passage, `l` is at the ends of the middle axis to the last bit.
    #[test]
    fn on_the_separatrix_the_top_ends_on_the_middle_axis() {
        let l = Vector3::new((K[1] - K[2]).sqrt(), 0.3, (K[0] - K[1]).sqrt()).normalize();
        let top = Top::new(K, &l);
        assert_eq!(top.complement(), 0.0);
        let [before, after] = [-800.0, 800.0].map(|phase| top.at(phase).frame.column(2).into_owned());
        assert_eq!(before, -after);
        assert_eq!((after.y.abs(), after.x, after.z), (1.0, 0.0, 0.0));
    }
}
