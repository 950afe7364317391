//! The mean motion in closed form, and the motion that follows from it.

use nalgebra::Vector3;

use super::generator::{Axes, transformed};
use super::hamiltonian::{MeanOrder, MeanPotential};
use super::top::{Top, TopPhases, TopShape};
use crate::dynamics::{BodyState, RigidSpheroid};
use crate::error::Error;
use crate::lorentz_violation::PrincipalCoefficients;
use crate::propagation::{ACCURACY_RANGE, check_input};
use crate::scalar::{Real, length};

/// Largest strength of the torque: up to it the energy determined `G` for 4,000 random scenes; at 0.3 it failed for 7.
const LARGEST_STRENGTH: f64 = 0.2;

/// Most corrections of `G`: each squares its error.
const MOST_CORRECTIONS: usize = 12;

/// A motion of a spheroid to a given order in `s^IJ`, at any time at the same cost.
///
/// Averaged over the fast rotation of `n` about `L` the direction `l` of `L` moves as that of a free asymmetric top with the tensor
/// `(2 / G) (by_h s + by_m s^2)`, the slopes of the mean potential by `h = l.(s l)` and `m = |s l|^2`; the body turns as the frame that
/// `l` carries along, about `l` and about `n`. To second order the slopes are taken at the start: what that leaves out, `(h - h_0)^2`, is of
/// fourth order in the energy and of third in the rates. All is in the principal frame of `s`. A state at the time zero is the initial one
/// up to the periodic part that is left out, of the order after the last.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MeanMotion<S> {
    /// `C I^xx`.
    strength: S,
    /// Traceless principal values of `s`.
    s: Vector3<S>,
    momentum: S,
    top: Top<S>,
    /// At the start, in the frame of the shape there.
    axis: Vector3<S>,
    equatorial_axis: Vector3<S>,
    start: TopShape<S>,
    rates: MeanRates<S>,
    /// Of the angles about `l` and about `n`, by the integrals of `h` and `m` about their means.
    periodic: [[S; 2]; 2],
    order: MeanOrder,
    relative_strength: S,
}

/// Mean rates of a motion (rad per unit of time).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MeanRates<S> {
    /// Of the phase of the slow precession, which grows by a turn when `L` goes once round its axis, in either sense; `lambda` on a
    /// separatrix.
    pub slow: S,
    /// Of the frame about `L`, but for its periodic part.
    pub about_momentum: S,
    /// Of the body about its symmetry axis against the frame.
    pub about_axis: S,
}

/// Phases of a motion at a time (rad), each modulo a turn if that suits.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MeanPhases<S> {
    /// As [`MeanRates::slow`], with its start.
    pub slow: S,
    /// As [`MeanRates::about_momentum`].
    pub about_momentum: S,
    /// As [`MeanRates::about_axis`].
    pub about_axis: S,
}

fn rotated_about<S: Real>(axis: &Vector3<S>, v: &Vector3<S>, angle: S) -> Vector3<S> {
    let (sin, cos) = angle.sin_cos();
    v * cos + axis.cross(v) * sin + axis * (axis.dot(v) * (S::one() - cos))
}

impl MeanMotion<f64> {
    /// The motion from `initial`, in the principal frame of `s`, at the time zero. In doubles: at symmetric tensors and steady motions
    /// derivatives have other forms.
    ///
    /// # Errors
    /// [`Error::Domain`] for a state or parameter that is not finite, axes that are not orthonormal (to 1e-9), moments of inertia that are
    /// not positive; and where the motion is not a fast rotation with a slow precession: `|C| (s_max - s_min) I^xx / |L|^2` must be
    /// below 0.2, and the mean energy must determine `G`.
    pub fn new(
        spheroid: &RigidSpheroid<f64>,
        s: &PrincipalCoefficients<f64>,
        initial: &BodyState<f64>,
        order: MeanOrder,
    ) -> Result<Self, Error> {
        let vectors = [initial.axis, initial.momentum, initial.equatorial_axis];
        check_input(spheroid, &s.tensor(), &vectors, (0.0, 0.0), ACCURACY_RANGE.0)?;
        let RigidSpheroid { inertia_xx, inertia_zz, constant_c } = *spheroid;
        let values = Vector3::new(s.xx, s.yy, s.zz);
        let s = values.map(|value| value - (values.x + values.y + values.z) / 3.0);
        let size = length(&initial.momentum);
        let spread = s.max() - s.min();
        Error::unless(size > 0.0, "angular momentum |L|", size, "above zero")?;
        let relative_strength = constant_c.abs() * spread * inertia_xx / (size * size);
        Error::unless(
            relative_strength < LARGEST_STRENGTH,
            "|C| (s_max - s_min) I^xx / |L|^2",
            relative_strength,
            "below 0.2: the body must turn fast against the torque",
        )?;
        let strength = constant_c * inertia_xx;
        let n_s_n = initial.axis.dot(&s.component_mul(&initial.axis));
        let energy = size * size / (inertia_xx * 2.0) + constant_c * n_s_n;
        let along_axis = initial.momentum.dot(&initial.axis);
        let axes = transformed(strength, &s, &[initial.axis, initial.momentum, initial.equatorial_axis], -1.0);
        let l = axes[1] / length(&axes[1]);
        let (h, m) = (l.dot(&s.component_mul(&l)), s.component_mul(&l).norm_squared());
        let potential = MeanPotential { order, constant_c, inertia: inertia_xx, square: s.norm_squared() };
        // The mean energy is that of the motion, and tells G one order better than the transformation does. To first order that would
        // only bring in what the mean energy lacks.
        let mut momentum = length(&axes[1]);
        let corrections = if order == MeanOrder::First { 0 } else { MOST_CORRECTIONS };
        let mut change = 0.0_f64;
        for _ in 0..corrections {
            let c = along_axis / momentum;
            let slopes = potential.at(momentum, c, h, m);
            let off = momentum * momentum / (inertia_xx * 2.0) + slopes.value - energy;
            let by_size = momentum / inertia_xx + slopes.by_size - slopes.by_c * c / momentum;
            change = off / by_size;
            momentum -= change;
        }
        Error::unless(
            momentum > 0.0 && change.abs() <= 1e-12 * momentum,
            "last correction of the mean |L|, relative",
            change / momentum,
            "below 1e-12: the mean energy must determine it",
        )?;
        let c = along_axis / momentum;
        let here = potential.at(momentum, c, h, m);
        let tensor = s.map(|value| (here.by_h * value + here.by_m * value * value) * 2.0 / momentum);
        let top = Top::new(tensor.into(), &l);
        let squares = top.mean_squares();
        let (mean_h, mean_m) = (s.dot(&squares), s.component_mul(&s).dot(&squares));
        let mean = potential.at(momentum, c, mean_h, mean_m);
        let energy_of_top = tensor.dot(&l.component_mul(&l));
        let TopPhases { slow, about } = top.rates();
        let rates = MeanRates {
            slow,
            about_momentum: about + momentum / inertia_xx + mean.by_size - mean.by_c * c / momentum - energy_of_top,
            about_axis: mean.by_c / momentum - spheroid.oblateness() * along_axis / inertia_zz,
        };
        let periodic = [
            [-(mean.by_c_h * c / momentum), mean.by_size_m - mean.by_c_m * c / momentum],
            [mean.by_c_h / momentum, mean.by_c_m / momentum],
        ];
        let start = top.at(top.start());
        let to_shape = start.frame.transpose();
        let [n, _, equatorial] = axes;
        let [n, equatorial_axis] = [n, equatorial].map(|v| to_shape * v);
        let axis = n / length(&n);
        Ok(Self { strength, s, momentum, top, axis, equatorial_axis, start, rates, periodic, order, relative_strength })
    }
}

impl<S: Real> MeanMotion<S> {
    /// Mean rates.
    pub fn rates(&self) -> &MeanRates<S> {
        &self.rates
    }

    /// `|C| (s_max - s_min) I^xx / |L|^2` at the start, whose powers the orders are in: errors are of its size (first order) or of its square (second), and
    /// grow with its square, or its cube, times the angle turned.
    pub fn relative_strength(&self) -> S {
        self.relative_strength
    }

    /// Phases at the time `t`.
    pub fn phases(&self, t: S) -> MeanPhases<S> {
        MeanPhases {
            slow: self.top.start() + self.rates.slow * t,
            about_momentum: self.rates.about_momentum * t,
            about_axis: self.rates.about_axis * t,
        }
    }

    /// The mean state at given phases, in the principal frame of `s`.
    fn mean_axes(&self, phases: &MeanPhases<S>) -> Axes<S> {
        let shape = self.top.at(phases.slow);
        let MeanPhases { mut about_momentum, mut about_axis, .. } = *phases;
        if self.order == MeanOrder::Second {
            let change = shape.squares - self.start.squares;
            let of_square = self.s.component_mul(&self.s);
            let integrals = [self.s.dot(&change), of_square.dot(&change)];
            let [about_l, about_n] = self.periodic.map(|[by_h, by_m]| by_h * integrals[0] + by_m * integrals[1]);
            (about_momentum, about_axis) = (about_momentum + about_l, about_axis + about_n);
        }
        // The turn of the frame since the start: the quotient of two complex numbers, times that of the angle.
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
    pub fn state_at(&self, phases: &MeanPhases<S>) -> BodyState<S> {
        let [axis, momentum, equatorial_axis] = transformed(self.strength, &self.s, &self.mean_axes(phases), 1.0);
        BodyState { axis, momentum, equatorial_axis }
    }

    /// The state of the body at the time `t`, in the principal frame of `s`.
    pub fn state(&self, t: S) -> BodyState<S> {
        self.state_at(&self.phases(t))
    }
}
