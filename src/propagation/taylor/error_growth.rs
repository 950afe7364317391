//! How errors made on the way have grown by a later time.

use nalgebra::{Matrix3, Vector3};

use crate::propagation::taylor::linearised_flow::LinearMap;

/// Factor of safety on what is known: the defects are their leading term, the linearised flow is good to some per cent.
const KNOWN_SAFETY: f64 = 3.0;

/// Standard deviations of what is known by its size alone.
const UNKNOWN_SAFETY: f64 = 4.0;

/// What reading the state off rounds: some units in the last place of one.
const READING: f64 = 4.0 * f64::EPSILON;

/// No error is larger: components of `n` and `e_x` differ by two at most, and `|L|` stays below 1.2 times its unit, since
/// `L.L <= L_0.L_0 + 2 sqrt(2) I^xx C |s|`.
const LARGEST: f64 = 2.5;

/// A difference of two rotations that are close to each other: an error.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Difference {
    /// Small rotation of the body about an inertial vector (rad).
    pub(super) rotation: Vector3<f64>,
    /// Difference of `L / I^xx`, per unit of time.
    pub(super) momentum: Vector3<f64>,
    /// Relative difference of the length of `n`.
    pub(super) length: f64,
}

impl Difference {
    /// Its size, the momentum in the given unit.
    pub(super) fn size(&self, momentum_unit: f64) -> f64 {
        let momentum = self.momentum / momentum_unit;
        (self.rotation.norm_squared() + self.length * self.length + momentum.norm_squared()).sqrt()
    }
}

/// The error of one motion by now.
///
/// Of what goes wrong at a step, the part known with its sign (truncation) is carried along the motion as a
/// [`Difference`] by the linearised flow; the part of which only the size is known (rounding) as the covariance of one; and
/// what does not grow is summed up. One call of [`carry`](Self::carry) for each [`LinearMap`] of a step, then one of
/// [`add`](Self::add), then [`estimate`](Self::estimate).
#[derive(Debug, Clone)]
pub(super) struct ErrorGrowth {
    momentum_unit: f64,
    known: Difference,
    covariance: Covariance,
    drift: f64,
    /// Once an error is of order one the linearised flow says no more about what becomes of it.
    lost: bool,
}

/// Covariance of a [`Difference`] with components `theta`, `w`, `rho`.
#[derive(Debug, Clone, Default)]
struct Covariance {
    rotation: Matrix3<f64>,
    /// `<theta w^T>`.
    mixed: Matrix3<f64>,
    momentum: Matrix3<f64>,
    /// `<theta rho>` and `<w rho>`.
    with_length: [Vector3<f64>; 2],
    length: f64,
}

impl ErrorGrowth {
    /// No error yet; `momentum_unit` is that of `L / I^xx` in which errors count.
    pub(super) fn none(momentum_unit: f64) -> Self {
        let (known, covariance) = (Difference::default(), Covariance::default());
        Self { momentum_unit, known, covariance, drift: 0.0, lost: false }
    }

    /// Carries the errors made so far along the motion.
    pub(super) fn carry(&mut self, map: &LinearMap) {
        let Difference { rotation, momentum, length } = &mut self.known;
        match map {
            LinearMap::Kick { from_rotation, from_length } => {
                *momentum += from_rotation * *rotation + from_length * *length;
                self.covariance.kick(from_rotation, from_length);
            }
            LinearMap::Rotation { from_rotation, from_momentum } => {
                *rotation = from_rotation * *rotation + from_momentum * *momentum;
                self.covariance.rotate(from_rotation, from_momentum);
            }
        }
    }

    /// Adds an error made now: `known` with its sign; one of unknown sign and direction with standard deviations
    /// `[rotation, momentum]` of each component, the rotation's for the length of `n` as well; and `drift`, the size of
    /// one that adds up and does not grow.
    pub(super) fn add(&mut self, known: &Difference, deviations: [f64; 2], drift: f64) {
        self.known.rotation += known.rotation;
        self.known.momentum += known.momentum;
        self.known.length += known.length;
        let [rotation, momentum] = deviations.map(|x| Matrix3::from_diagonal_element(x * x));
        self.covariance.rotation += rotation;
        self.covariance.momentum += momentum;
        self.covariance.length += deviations[0] * deviations[0];
        self.drift += drift;
    }

    /// The estimated error by now. Where only the `axis` is followed, a rotation about it is no error.
    pub(super) fn estimate(&mut self, axis: Option<&Vector3<f64>>) -> f64 {
        let Covariance { rotation, momentum, length, .. } = &self.covariance;
        let mut known = self.known;
        let mut variance = rotation.trace() + length + momentum.trace() / self.momentum_unit / self.momentum_unit;
        if let Some(n) = axis {
            known.rotation -= n * n.dot(&known.rotation);
            variance -= n.dot(&(rotation * n));
        }
        let known = known.size(self.momentum_unit) + self.drift;
        let error = KNOWN_SAFETY * known + UNKNOWN_SAFETY * variance.max(0.0).sqrt() + READING;
        self.lost |= error >= 1.0 || error.is_nan();
        if self.lost { LARGEST } else { error }
    }

    /// An error of this size, added now, as [`estimate`](Self::estimate) would count it.
    pub(super) fn counted(size: f64) -> f64 {
        KNOWN_SAFETY * size
    }
}

impl Covariance {
    /// Of `w + K theta + k rho` instead of `w`.
    fn kick(&mut self, from_rotation: &Matrix3<f64>, from_length: &Vector3<f64>) {
        let [rotation, momentum] = &mut self.with_length;
        let across = from_rotation * self.mixed + from_length * momentum.transpose();
        let kicked = from_rotation * self.rotation + from_length * rotation.transpose();
        let change = from_rotation * *rotation + from_length * self.length;
        self.momentum +=
            across + across.transpose() + kicked * from_rotation.transpose() + change * from_length.transpose();
        self.mixed += kicked.transpose();
        *momentum += change;
    }

    /// Of `A theta + B w` instead of `theta`.
    fn rotate(&mut self, from_rotation: &Matrix3<f64>, from_momentum: &Matrix3<f64>) {
        let [rotation, momentum] = &mut self.with_length;
        let turned = from_rotation * self.rotation + from_momentum * self.mixed.transpose();
        let mixed = from_rotation * self.mixed + from_momentum * self.momentum;
        *rotation = from_rotation * *rotation + from_momentum * *momentum;
        self.rotation = turned * from_rotation.transpose() + mixed * from_momentum.transpose();
        self.mixed = mixed;
    }
}
