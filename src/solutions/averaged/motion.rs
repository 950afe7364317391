//! The averaged motion in closed form, and the osculating motion that follows from it.

use core::f64::consts::TAU;

use nalgebra::Vector3;

use super::generator::{Axes, transformation};
use super::hamiltonian::{AveragingOrder, MeanPotential};
use super::phases::{OfRotations, Turns, excess_of_length, turning};
use super::top::{Top, TopPhases, TopShape};
use crate::dynamics::{BodyState, Problem, RigidSpheroid};
use crate::error::Error;
use crate::numerics::double_double::DoubleDouble;
use crate::numerics::scalar::{Real, length};

/// Largest strength of the torque: up to this strength the energy determined `G` for 4,000 random scenes; at 0.3 it failed
/// for 7.
const LARGEST_STRENGTH: f64 = 0.2;

/// Maximum number of corrections of `G`; each squares its error.
const MOST_CORRECTIONS: usize = 12;

/// A motion of a spheroid to a given order in `s^IJ`. The state costs the same at any time.
///
/// Averaged over the fast rotation of `n` about `L`, the direction `l` of `L` moves like that of a free asymmetric top with the tensor
/// `(2 / G) (by_h s + by_m s^2)`, where `by_h` and `by_m` are the slopes of the mean potential with respect to `h = l.(s l)` and `m = |s l|^2`.
/// The body rotates with the frame that `l` carries along, about `l` and about `n`. To second order the slopes are evaluated at the start: the
/// neglected term, `(h - h_0)^2`, is of fourth order in the energy and of third order in the rates. All vectors are in the principal frame of `s`.
/// The state at the time zero is the initial one up to the neglected periodic part, which is of the next higher order.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AveragedSolution<S> {
    /// `C I^xx`.
    strength: S,
    /// Traceless principal values of `s`.
    s: Vector3<S>,
    momentum: S,
    top: Top<S>,
    /// Symmetry axis of the body at the start, in the frame of the top there.
    axis: Vector3<S>,
    equatorial_axis: Vector3<S>,
    start: TopShape<S>,
    starts: OfRotations<S>,
    /// Rates of the phases (turns per unit of time), with the free rotation to 32 digits.
    turning: OfRotations<DoubleDouble>,
    /// `n.n - 1` of the given initial axis.
    excess_of_length: f64,
    pub(crate) rates: OfRotations<S>,
    /// Periodic parts of the angles about `l` and about `n`, per unit of the integral of the top.
    periodic: [S; 2],
    pub(crate) order: AveragingOrder,
    /// Principal values of the tensor of the asymmetric top that describes the motion of `l`.
    tensor: Vector3<S>,
    pub(crate) relative_strength: S,
    /// `|b| (s_max - s_min) I^xx`.
    bulge_strength: S,
}

fn require_round<S: Real>(top: &Top<S>) -> Result<(), Error> {
    let complement = if top.goes_round() { top.complement() } else { 0.0 };
    Error::ensure(
        complement > 0.0,
        "distance k' of L from rest and from the separatrix",
        complement,
        "above zero, for derivatives",
    )
}

/// The principal values of `s` less a third of their sum, for a problem in the principal frame.
fn traceless_principal_values<S: Real>(problem: &Problem<S>) -> Result<Vector3<S>, Error> {
    let off_diagonal = [(0, 1), (0, 2), (1, 2)].map(|place| problem.coefficients()[place].re().abs());
    let largest = off_diagonal.into_iter().fold(0.0, f64::max);
    Error::ensure(largest == 0.0, "largest s^IJ off the diagonal", largest, "zero; use the principal frame of s^IJ")?;
    let values = problem.coefficients().diagonal();
    Ok(values.map(|value| value - (values.x + values.y + values.z) / 3.0))
}

/// `|C| (s_max - s_min) I^xx / |L|^2` and `|b| (s_max - s_min) I^xx`, for traceless `s` and `|L| = size`.
fn strengths<S: Real>(problem: &Problem<S>, s: &Vector3<S>, size: S) -> Result<[S; 2], Error> {
    let RigidSpheroid { inertia_xx, constant_c, .. } = *problem.spheroid();
    let reals = s.map(S::re);
    let spread = reals.max() - reals.min();
    Error::ensure(size.re() > 0.0, "angular momentum |L|", size.re(), "above zero")?;
    let of_torque = constant_c.abs() * spread * inertia_xx / (size * size);
    Error::ensure(
        of_torque.re() < LARGEST_STRENGTH,
        "|C| (s_max - s_min) I^xx / |L|^2",
        of_torque.re(),
        "below 0.2; the body must turn fast compared with the torque",
    )?;
    let of_bulge = problem.bulge().abs() * spread * inertia_xx;
    let together = (of_torque + of_bulge).re();
    Error::ensure(
        together < LARGEST_STRENGTH,
        "(|C| / |L|^2 + |b|) (s_max - s_min) I^xx of a star with a bulge",
        together,
        "below 0.2; the body must turn fast compared with the motion of L",
    )?;
    Ok([of_torque, of_bulge])
}

/// `G - |L|`, which is small and known to its own digits. The mean energy equals that of the motion, and determines `G` to one order higher than the
/// transformation, which gives the `guess`. To first order this would only introduce the terms that the mean energy lacks, and the guess is kept.
fn excess_of_mean_momentum<S: Real>(
    potential: &MeanPotential<S>,
    pull: S,
    [size, along_axis, h, m]: [S; 4],
    guess: S,
) -> Result<S, Error> {
    let corrections = if potential.order == AveragingOrder::First { 0 } else { MOST_CORRECTIONS };
    let (mut excess, mut last) = (guess, S::zero());
    for _ in 0..corrections {
        let g = size + excess;
        let c = along_axis / g;
        let slopes = potential.at(g, c, h, m);
        let off = excess * (size + g) / (potential.inertia * 2.0) + slopes.value - pull;
        last = off / (g / potential.inertia + slopes.about_momentum(g, c));
        excess -= last;
    }
    let g = size + excess;
    Error::ensure(
        g.re() > 0.0 && last.re().abs() <= 1e-12 * g.re(),
        "last correction of the mean |L|, relative",
        last.re() / g.re(),
        "below 1e-12; the mean energy must determine it",
    )?;
    Ok(excess)
}

fn rotated_about<S: Real>(axis: &Vector3<S>, v: &Vector3<S>, angle: S) -> Vector3<S> {
    let (sin, cos) = angle.sin_cos();
    v * cos + axis.cross(v) * sin + axis * (axis.dot(v) * (S::one() - cos))
}

impl<S: Real> AveragedSolution<S> {
    /// Mean rates.
    pub fn rates(&self) -> OfRotations<S> {
        self.rates
    }

    /// `|C| (s_max - s_min) I^xx / |L|^2` at the start, the expansion parameter: errors are of its size (first order) or of its square
    /// (second), and grow with its square, or its cube, times the rotation angle. For a bulge the parameter is `|b| (s_max - s_min) I^xx`.
    pub fn relative_strength(&self) -> S {
        self.relative_strength
    }

    /// `|b| (s_max - s_min) I^xx`, for a star with a bulge. It appears only together with the strength of the torque: the motion with a bulge
    /// alone is exact.
    pub(crate) fn bulge_strength(&self) -> S {
        self.bulge_strength
    }

    /// The motion of a problem in the principal frame of its `s`, from its initial state at the time zero.
    ///
    /// # Errors
    /// [`Error::Domain`] for `s` that is not diagonal, and if the motion is not a fast rotation with a slow precession:
    /// `(|C| / |L|^2 + |b|) (s_max - s_min) I^xx` must be below 0.2, and the mean energy must determine `G`. With derivatives (duals), also if `L`
    /// rests or is on a separatrix, where the elliptic functions have no derivatives.
    pub fn new(problem: &Problem<S>, order: AveragingOrder) -> Result<Self, Error> {
        Self::with_free_rotation_of(problem.initial(), problem, order)
    }

    /// As [`new`](Self::new), for an initial state that was `given` in another frame. In that frame `|L|` and `L.n` have all their digits. A
    /// rotation to the principal frame loses the last one, and over 1e10 turns this costs ten more digits of the phases.
    ///
    /// # Errors
    /// As for [`new`](Self::new).
    pub fn with_free_rotation_of(
        given: &BodyState<S>,
        problem: &Problem<S>,
        order: AveragingOrder,
    ) -> Result<Self, Error> {
        let (spheroid, initial) = (problem.spheroid(), problem.initial());
        let RigidSpheroid { inertia_xx, inertia_zz, constant_c } = *spheroid;
        let bulge = problem.bulge();
        let s = traceless_principal_values(problem)?;
        // The rotation from the given frame would introduce its rounding, and that of its derivatives, which are as large as the inverse of
        // `s`.
        let size = length(&given.momentum);
        let [relative_strength, bulge_strength] = strengths(problem, &s, size)?;
        let strength = constant_c * inertia_xx;
        let pull = constant_c * initial.axis.dot(&s.component_mul(&initial.axis))
            + bulge * initial.momentum.dot(&s.component_mul(&initial.momentum));
        let along_axis = given.momentum.dot(&given.axis);
        let start = [initial.axis, initial.momentum, initial.equatorial_axis];
        let change = transformation(strength, &s, &start, -1.0);
        let [n, momentum, equatorial] = [0, 1, 2].map(|i| start[i] + change[i]);
        let l = momentum / length(&momentum);
        let (h, m) = (l.dot(&s.component_mul(&l)), s.component_mul(&l).dot(&s.component_mul(&l)));
        let potential = MeanPotential { order, constant_c, inertia: inertia_xx, bulge, square: s.dot(&s) };
        // G - |L| to the order of the transformation.
        let guess = change[1].dot(&(initial.momentum * S::from_f64(2.0) + change[1])) / (length(&momentum) + size);
        let excess = excess_of_mean_momentum(&potential, pull, [size, along_axis, h, m], guess)?;
        let g = size + excess;
        let c = along_axis / g;
        let here = potential.at(g, c, h, m);
        let tensor = here.tensor(&s, g);
        let top = Top::new(tensor.into(), &l);
        if S::HAS_DERIVATIVES {
            require_round(&top)?;
        }
        let squares = top.mean_squares();
        let (mean_h, mean_m) = (s.dot(&squares), s.component_mul(&s).dot(&squares));
        let mean = potential.at(g, c, mean_h, mean_m);
        let energy_of_top = tensor.dot(&l.component_mul(&l));
        let TopPhases { slow, about } = top.rates;
        let added = OfRotations {
            slow,
            about_momentum: excess / inertia_xx + about + mean.about_momentum(g, c) - energy_of_top,
            about_axis: mean.about_axis(g),
        };
        let free = [size / inertia_xx, -(spheroid.oblateness() * along_axis / inertia_zz)];
        let rates = OfRotations {
            slow,
            about_momentum: free[0] + added.about_momentum,
            about_axis: free[1] + added.about_axis,
        };
        // The periodic parts of h and m are the integral of the top times the product, times v_m and -v_h. Sums over their components would cancel
        // where v_m is small.
        let product = top.product_of_differences(&s) * 2.0 / g;
        let (by_h, by_m) = (here.by_m * product, -(here.by_h * product));
        let periodic = [
            (mean.by_size_h - mean.by_c_h * c / g) * by_h + (mean.by_size_m - mean.by_c_m * c / g) * by_m,
            (mean.by_c_h * by_h + mean.by_c_m * by_m) / g,
        ];
        let shape = top.at(top.start);
        let to_shape = shape.frame.transpose();
        let [n, equatorial_axis] = [n, equatorial].map(|v| to_shape * v);
        let starts = OfRotations { slow: top.start, about_momentum: S::zero(), about_axis: S::zero() };
        Ok(Self {
            strength,
            s,
            momentum: g,
            axis: n / length(&n),
            equatorial_axis,
            start: shape,
            starts,
            turning: turning(spheroid, given, &added),
            excess_of_length: excess_of_length(&given.axis),
            rates,
            periodic,
            order,
            tensor,
            relative_strength,
            bulge_strength,
            top,
        })
    }

    /// Refuses a motion that has no derivatives with respect to some of its parameters.
    ///
    /// # Errors
    /// [`Error::Domain`] if `L` rests or is on a separatrix, and for three equal eigenvalues of `s`.
    pub fn require_derivatives(&self) -> Result<(), Error> {
        let s = self.s.map(S::re);
        let spread = s.max() - s.min();
        Error::ensure(
            spread > 0.0,
            "largest difference of two eigenvalues of s^IJ",
            spread,
            "above zero; derivatives of the averaged motion need an anisotropic s^IJ",
        )?;
        require_round(&self.top)
    }

    /// Uncertainty of the rate about `n`, because the length of `n` is rounded (rad per unit of time).
    pub(super) fn rounding_of_rate_about_axis(&self) -> f64 {
        (self.turning.about_axis.high * TAU * self.excess_of_length).abs()
    }

    /// `G / I^xx`, the rotation rate of the axis.
    pub(super) fn turning_rate(&self) -> f64 {
        self.turning.about_momentum.high.abs() * TAU
    }

    pub(super) fn tensor(&self) -> &Vector3<S> {
        &self.tensor
    }

    pub(crate) fn top(&self) -> &Top<S> {
        &self.top
    }

    /// `l` at the start.
    pub(super) fn direction(&self) -> Vector3<S> {
        self.start.frame.column(2).into()
    }

    /// Phases at the time `t[0] + t[1]`, a sum of two doubles: accurate to some 1e-16 turn, and to 1e-16 of the contribution of Lorentz
    /// violation, after any number of turns.
    pub fn turns(&self, t: [f64; 2]) -> OfRotations<Turns> {
        let time = DoubleDouble::sum(t[0], t[1]);
        self.starts.with(&self.turning, |start, rate| Turns::at(start.re() / TAU, rate, time))
    }

    /// Rates of the phases in turns, to 32 digits: about `L`, of `L` about its axis, and of `e_x` about `n`.
    pub(crate) fn turns_per_time(&self) -> [DoubleDouble; 3] {
        let OfRotations { slow, about_momentum, about_axis } = self.turning;
        [about_momentum, slow, about_axis]
    }

    /// Phases at the time `t[0] + t[1]`, modulo a turn.
    pub fn phases_at(&self, t: [f64; 2]) -> OfRotations<S> {
        let OfRotations { slow, about_momentum, about_axis } = self.turns(t);
        let slow = if self.top.complement() > 0.0 { slow.angle() } else { slow.angle() + slow.whole as f64 * TAU };
        let angles = [slow, about_momentum.angle(), about_axis.angle()];
        let [slow, about_momentum, about_axis] = angles.map(S::from_f64);
        let real = OfRotations { slow, about_momentum, about_axis };
        if !S::HAS_DERIVATIVES {
            return real;
        }
        let t = S::from_f64(t[0]) + S::from_f64(t[1]);
        real.with(&self.starts.later(&self.rates, t), |angle, whole| angle + (whole - S::from_f64(whole.re())))
    }

    /// Phases at the time `t`, modulo a turn.
    fn phases(&self, t: S) -> OfRotations<S> {
        let phases = self.phases_at([t.re(), 0.0]);
        if S::HAS_DERIVATIVES { phases.later(&self.rates, t - S::from_f64(t.re())) } else { phases }
    }

    /// The mean state at given phases, in the principal frame of `s`.
    fn mean_axes(&self, phases: &OfRotations<S>) -> Axes<S> {
        let shape = self.top.at(phases.slow);
        let OfRotations { mut about_momentum, mut about_axis, .. } = *phases;
        if self.order == AveragingOrder::Second {
            let change = shape.integral - self.start.integral;
            let [about_l, about_n] = self.periodic.map(|rate| rate * change);
            (about_momentum, about_axis) = (about_momentum + about_l, about_axis + about_n);
        }
        // The rotation of the frame since the start: the quotient of two complex numbers, times the rotation by the angle.
        let ([x, y], [x0, y0]) = (shape.turned, self.start.turned);
        let turn = [x * x0 + y * y0, y * x0 - x * y0];
        let size = (turn[0] * turn[0] + turn[1] * turn[1]).sqrt();
        let (sin, cos) = about_momentum.sin_cos();
        let (cos, sin) = ((cos * turn[0] - sin * turn[1]) / size, (sin * turn[0] + cos * turn[1]) / size);
        let placed = |v: &Vector3<S>| shape.frame * Vector3::new(v.x * cos - v.y * sin, v.x * sin + v.y * cos, v.z);
        let equatorial = rotated_about(&self.axis, &self.equatorial_axis, about_axis);
        let l: Vector3<S> = shape.frame.column(2).into();
        [placed(&self.axis), l * self.momentum, placed(&equatorial)]
    }

    /// The state of the body at given phases, in the principal frame of `s`.
    pub fn state_at(&self, phases: &OfRotations<S>) -> BodyState<S> {
        let mean = self.mean_axes(phases);
        let change = transformation(self.strength, &self.s, &mean, 1.0);
        let [axis, momentum, equatorial_axis] = [0, 1, 2].map(|i| mean[i] + change[i]);
        BodyState { axis, momentum, equatorial_axis }
    }

    /// The state of the body at the time `t`, in the principal frame of `s`.
    pub fn state(&self, t: S) -> BodyState<S> {
        self.state_at(&self.phases(t))
    }
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;
    use nalgebra::Matrix3;
    use num_dual::Dual64;

    use super::*;
    use crate::dynamics::RotationState;

    fn about<S: Real>(axis: [f64; 3], values: [f64; 3], momentum: [S; 3]) -> AveragedSolution<S> {
        let [inertia_xx, inertia_zz, constant_c] = [1.3, 1.6, 0.8].map(S::from_f64);
        let [axis, equatorial_axis] = [axis, [0.0, 1.0, 0.0]].map(|v| Vector3::from(v.map(S::from_f64)));
        let initial = BodyState { axis, momentum: momentum.into(), equatorial_axis };
        let s = Matrix3::from_diagonal(&values.map(S::from_f64).into());
        let spheroid = RigidSpheroid { inertia_xx, inertia_zz, constant_c };
        AveragedSolution::new(&Problem::new(spheroid, s, initial).unwrap(), AveragingOrder::First).unwrap()
    }

    fn motion<S: Real>(values: [f64; 3], momentum: [S; 3]) -> AveragedSolution<S> {
        about([0.6, 0.0, 0.8], values, momentum)
    }

    /// A tensor so weak that `L` keeps its bits in the transformation to the averaged motion.
    const WEAK: [f64; 3] = [1e-17, 0.0, -1e-17];

    /// The derivatives are compared with central differences of states.
    #[test]
    fn derivatives_by_the_time_are_rates() {
        let (values, momentum) = ([0.02, 0.01, -0.03], [0.3, -0.5, 2.0]);
        let found = motion(values, momentum.map(Dual64::from)).state(Dual64::from(7.3).derivative());
        let h = 1e-4;
        let [before, after] = [-h, h].map(|step| motion(values, momentum).state(7.3 + step));
        for ((found, before), after) in found.vectors().iter().zip(before.vectors()).zip(after.vectors()) {
            let slope = (after - before) / (2.0 * h);
            assert!((found.map(|x| x.eps) - slope).amax() < 1e-7, "{found} {slope}");
        }
        // Only the torque changes L, by some thousandths.
        assert!(found.momentum.map(|x| x.eps).amax() > 1e-3);
    }

    #[test]
    fn errors_are_at_most_two_and_twice_the_strength() {
        let motion = motion([0.02, 0.01, -0.03], [0.3, -0.5, 2.0]);
        assert_eq!(motion.error_estimate(-40.0), motion.error_estimate(40.0));
        assert_relative_eq!(motion.error_estimate(1e30), 2.0 + 2.0 * motion.relative_strength, max_relative = 1e-14);
        assert!(motion.relative_strength > 1e-3);
    }

    #[test]
    fn on_the_separatrix_the_phase_is_not_taken_modulo_a_turn() {
        let motion = motion(WEAK, [1.0, 1.0, 1.0]);
        assert_eq!(motion.top.complement(), 0.0);
        let rate = motion.rates.slow;
        for angle in [0.4, 3.0, 9.7, 20.0, -20.0, -4.1] {
            let found = motion.phases_at([angle / rate, 0.0]).slow;
            assert_relative_eq!(found, motion.top.start + angle, max_relative = 1e-13);
        }
    }

    /// The rounding at the start is `16 eps` of a rotation, divided by the root of `k'`, which is taken to be at least `1e-16`; once for `n` and
    /// once for `L`.
    #[test]
    fn rounding_is_magnified_near_the_separatrix() {
        let motion = motion(WEAK, [1.0, 1.0, 1.0]);
        assert_relative_eq!(motion.rounding(0.0), 2.0 * 16.0 * f64::EPSILON / 1e-8, max_relative = 1e-12);
    }

    #[test]
    fn a_resting_momentum_and_an_isotropic_tensor_have_no_derivatives() {
        let refused = |motion: AveragedSolution<f64>| match motion.require_derivatives() {
            Err(Error::Domain { value, .. }) => Some(value),
            _ => None,
        };
        assert_eq!(refused(about([0.0, 0.0, 1.0], [0.02, 0.01, -0.03], [0.0, 0.0, 2.0])), Some(0.0));
        assert_eq!(refused(motion([0.02, 0.01, -0.03], [0.3, -0.5, 2.0])), None);
        // Equal values leave equal remainders, of either sign, when their rounded mean is subtracted: the traceless values do not differ.
        let left = [0.1, 0.2, 0.3, 0.7, 1.1, 1.7, -0.1, -0.7].map(|value: f64| {
            assert_eq!(refused(motion([value; 3], [0.3, -0.5, 2.0])), Some(0.0), "{value}");
            value - (value + value + value) / 3.0
        });
        assert!(left.iter().any(|left| *left > 0.0) && left.iter().any(|left| *left < 0.0), "{left:?}");
    }

    #[test]
    fn a_turning_rate_has_no_sign() {
        let motion = motion([0.02, 0.01, -0.03], [0.3, -0.5, 2.0]);
        let rate = motion.turning_rate();
        assert_relative_eq!(rate, motion.rates.about_momentum, max_relative = 1e-14);
        let mut turning = motion.turning;
        turning.about_momentum = DoubleDouble::default() - turning.about_momentum;
        assert_eq!(AveragedSolution { turning, ..motion }.turning_rate(), rate);
    }

    /// The slopes of phases grow with the sum of both parts of a time.
    #[test]
    fn derivatives_of_phases_take_the_whole_time() {
        let momentum = [Dual64::new(0.3, 1.0), Dual64::from(-0.5), Dual64::new(2.0, 0.5)];
        let motion = motion([0.02, 0.01, -0.03], momentum);
        let rates = motion.rates;
        let found = motion.phases_at([30.0, 12.0]);
        assert!((motion.starts.slow + rates.slow * 42.0).eps.abs() > 0.1);
        assert_relative_eq!(found.slow.eps, (motion.starts.slow + rates.slow * 42.0).eps, max_relative = 1e-12);
        assert_relative_eq!(found.about_momentum.eps, rates.about_momentum.eps * 42.0, max_relative = 1e-12);
        assert_relative_eq!(found.about_axis.eps, rates.about_axis.eps * 42.0, max_relative = 1e-12);
    }
}
