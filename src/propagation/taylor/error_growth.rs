//! Growth of errors up to a later time.

use nalgebra::{Matrix3, Vector3};

use crate::propagation::taylor::linearised_flow::LinearMap;

/// Safety factor for errors of known sign: the defects are given by their leading term, the linearised flow is accurate to
/// some per cent.
const KNOWN_SAFETY: f64 = 3.0;

/// Number of standard deviations for errors known only by their size. An error in one direction exceeds it with the probability 2e-9, and a
/// growing error approaches one direction.
const UNKNOWN_SAFETY: f64 = 6.0;

/// Rounding of the covariance in a step, relative.
const COVARIANCE_ROUNDING: f64 = 32.0 * f64::EPSILON;

/// Rounding of the evaluation of the state: some units in the last place of one.
pub(super) const READING: f64 = 4.0 * f64::EPSILON;

/// No error is larger: components of `n` and `e_x` differ by two at most, and `|L|` stays below 1.2 times its unit, since
/// `L.L <= L_0.L_0 + 2 sqrt(2) I^xx C |s|`.
pub(super) const LARGEST: f64 = 2.5;

/// A difference of two rotations that are close to each other, that is, an error.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Difference {
    /// Small rotation of the body about an inertial vector (rad).
    pub(super) rotation: Vector3<f64>,
    /// Difference of `L / I^xx`, per unit of time.
    pub(super) momentum: Vector3<f64>,
    /// Relative difference of the length of `n`.
    pub(super) length: f64,
    /// Relative difference of the length of the vector carried along, and of its cosine with `n`; both are constant.
    pub(super) off_frame: [f64; 2],
}

impl Difference {
    /// Its size, with the momentum in the given unit.
    pub(super) fn size(&self, momentum_unit: f64) -> f64 {
        let momentum = self.momentum / momentum_unit;
        let lengths = self.length * self.length + self.off_frame.iter().map(|x| x * x).sum::<f64>();
        (self.rotation.norm_squared() + momentum.norm_squared() + lengths).sqrt()
    }

    /// Carries the difference along by a map.
    pub(super) fn carry(&mut self, map: &LinearMap) {
        let Self { rotation, momentum, length, .. } = self;
        match map {
            LinearMap::Kick { from_rotation, from_length, .. } => {
                *momentum += from_rotation * *rotation + from_length * *length;
            }
            LinearMap::Rotation { from_rotation, from_momentum, .. } => {
                *rotation = from_rotation * *rotation + from_momentum * *momentum;
            }
        }
    }
}

/// The accumulated error of one motion.
///
/// The part of the error of a step that is known with its sign (truncation) is carried along the motion as a [`Difference`]
/// by the linearised flow; the part whose size only is known (rounding) as the covariance of one; and errors that do not
/// grow are summed. Each step requires one call of [`carry`](Self::carry) for each [`LinearMap`], then one of
/// [`add`](Self::add), then [`estimate`](Self::estimate).
#[derive(Debug, Clone)]
pub(super) struct ErrorGrowth {
    momentum_unit: f64,
    known: Difference,
    covariance: Covariance,
    /// Once an error is of order one, the linearised flow no longer describes its growth.
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
    /// Variances of both components of `off_frame`.
    off_frame: f64,
}

impl ErrorGrowth {
    /// No error yet; `momentum_unit` is the unit of `L / I^xx` in which errors count.
    pub(super) fn none(momentum_unit: f64) -> Self {
        let (known, covariance) = (Difference::default(), Covariance::default());
        Self { momentum_unit, known, covariance, lost: false }
    }

    /// The errors accumulated so far, for a state that has been made orthonormal: converted to a unit of time `longer` times as long, in which
    /// `momentum_unit` is the unit of `L / I^xx`.
    pub(super) fn of_orthonormal_state(mut self, longer: f64, momentum_unit: f64) -> Self {
        self.momentum_unit = momentum_unit;
        (self.known.length, self.known.off_frame) = (0.0, [0.0; 2]);
        (self.covariance.length, self.covariance.off_frame) = (0.0, 0.0);
        self.covariance.with_length = [Vector3::zeros(); 2];
        self.known.momentum *= longer;
        self.covariance.mixed *= longer;
        self.covariance.momentum *= longer * longer;
        self
    }

    /// Carries the errors accumulated so far along the motion.
    pub(super) fn carry(&mut self, map: &LinearMap) {
        self.known.carry(map);
        match map {
            LinearMap::Kick { from_rotation, from_length, made } => {
                self.known.momentum += made;
                self.covariance.kick(from_rotation, from_length);
            }
            LinearMap::Rotation { from_rotation, from_momentum, made } => {
                self.known.rotation += made;
                self.covariance.rotate(from_rotation, from_momentum);
            }
        }
    }

    /// Adds a new error: `known` with its sign, and one of unknown sign and direction with standard deviations
    /// `[rotation, momentum]` of each component; the rotation's is used for the lengths as well.
    pub(super) fn add(&mut self, known: &Difference, deviations: [f64; 2]) {
        self.known.rotation += known.rotation;
        self.known.momentum += known.momentum;
        self.known.length += known.length;
        for (sum, made) in self.known.off_frame.iter_mut().zip(known.off_frame) {
            *sum += made;
        }
        let squared_unit = self.momentum_unit * self.momentum_unit;
        let Covariance { rotation, momentum, length, off_frame, .. } = &mut self.covariance;
        // The rounding of the covariance itself must not exceed the remainder after a contraction.
        let rounded = COVARIANCE_ROUNDING * (rotation.trace() + momentum.trace() / squared_unit);
        let variances = deviations.map(|x| x * x);
        *rotation += Matrix3::from_diagonal_element(variances[0] + rounded);
        *momentum += Matrix3::from_diagonal_element(variances[1] + rounded * squared_unit);
        *length += variances[0];
        *off_frame += 2.0 * variances[0];
    }

    /// The current error estimate. If only the `axis` is followed, a rotation about it is not an error.
    pub(super) fn estimate(&mut self, axis: Option<&Vector3<f64>>) -> f64 {
        let Covariance { rotation, momentum, length, off_frame, .. } = &self.covariance;
        let mut known = self.known;
        let mut variance = rotation.trace() + length + off_frame;
        variance += momentum.trace() / self.momentum_unit / self.momentum_unit;
        if let Some(n) = axis {
            known.rotation -= n * n.dot(&known.rotation);
            variance -= n.dot(&(rotation * n)) + off_frame;
        }
        let known = known.size(self.momentum_unit);
        let error = KNOWN_SAFETY * known + UNKNOWN_SAFETY * variance.max(0.0).sqrt() + READING;
        self.lost |= error >= 1.0 || error.is_nan();
        if self.lost { LARGEST } else { error }
    }

    /// The error of the length of `n`.
    pub(super) fn of_length(&self) -> f64 {
        KNOWN_SAFETY * self.known.length.abs() + UNKNOWN_SAFETY * self.covariance.length.max(0.0).sqrt()
    }

    /// The error of `w.n` at the state `n`, `w = L / I^xx`.
    pub(super) fn of_spin(&self, n: &Vector3<f64>, w: &Vector3<f64>) -> f64 {
        let Covariance { rotation, mixed, momentum, .. } = &self.covariance;
        let across = n.cross(w);
        let known = self.known.momentum.dot(n) + self.known.rotation.dot(&across);
        let variance = n.dot(&(momentum * n)) + across.dot(&(rotation * across + mixed * n * 2.0));
        KNOWN_SAFETY * known.abs() + UNKNOWN_SAFETY * variance.max(0.0).sqrt()
    }

    /// What an error of this size, added now, contributes to [`estimate`](Self::estimate).
    pub(super) fn counted(size: f64) -> f64 {
        KNOWN_SAFETY * size
    }

    /// What an error with this standard deviation, added now, contributes.
    pub(super) fn counted_deviation(deviation: f64) -> f64 {
        UNKNOWN_SAFETY * deviation
    }
}

impl Covariance {
    /// Replaces `w` by `w + K theta + k rho`.
    fn kick(&mut self, from_rotation: &Matrix3<f64>, from_length: &Vector3<f64>) {
        let [rotation, momentum] = &mut self.with_length;
        let across = from_rotation * self.mixed + from_length * momentum.transpose();
        let kicked = from_rotation * self.rotation + from_length * rotation.transpose();
        let change = from_rotation * *rotation + from_length * self.length;
        let half = across + (kicked * from_rotation.transpose() + change * from_length.transpose()) * 0.5;
        self.momentum += half + half.transpose();
        self.mixed += kicked.transpose();
        *momentum += change;
    }

    /// Replaces `theta` by `A theta + B w`.
    fn rotate(&mut self, from_rotation: &Matrix3<f64>, from_momentum: &Matrix3<f64>) {
        let [rotation, momentum] = &mut self.with_length;
        let turned = from_rotation * self.rotation + from_momentum * self.mixed.transpose();
        let mixed = from_rotation * self.mixed + from_momentum * self.momentum;
        *rotation = from_rotation * *rotation + from_momentum * *momentum;
        let rotation = turned * from_rotation.transpose() + mixed * from_momentum.transpose();
        // `kick` would apply an asymmetry due to rounding with the wrong sign, and it would grow exponentially.
        self.rotation = (rotation + rotation.transpose()) * 0.5;
        self.mixed = mixed;
    }
}

#[cfg(test)]
mod tests {
    use approx::assert_relative_eq;

    use super::*;

    fn matrix(seed: f64) -> Matrix3<f64> {
        Matrix3::from_fn(|i, j| (seed + 1.7 * i as f64 - 0.9 * j as f64 + (i * j) as f64).sin())
    }

    /// The remainder after a contraction contains the rounding of the earlier covariance: 32 units of all of it.
    #[test]
    fn the_rounding_of_a_covariance_is_added() {
        let unit = 3.7;
        let mut growth = ErrorGrowth::none(unit);
        growth.add(&Difference::default(), [1.0, 2.0]);
        let nothing = Matrix3::zeros();
        growth.carry(&LinearMap::Rotation { from_rotation: nothing, from_momentum: nothing, made: Vector3::zeros() });
        growth.add(&Difference::default(), [0.0, 0.0]);
        let rounded = 32.0 * f64::EPSILON * 3.0 * 4.0 / (unit * unit);
        assert_relative_eq!(growth.covariance.rotation[(1, 1)], rounded, epsilon = 0.0, max_relative = 1e-13);
        assert_relative_eq!(growth.covariance.momentum[(2, 2)], 4.0 + rounded * unit * unit, max_relative = 1e-16);
        assert_eq!((growth.covariance.length, growth.covariance.off_frame), (1.0, 2.0));
        // The rounding of the rotation itself is added too.
        let mut growth = ErrorGrowth::none(unit);
        growth.add(&Difference::default(), [1.0, 0.0]);
        growth.add(&Difference::default(), [0.0, 0.0]);
        assert_relative_eq!(
            growth.covariance.momentum[(0, 0)],
            96.0 * f64::EPSILON * unit * unit,
            max_relative = 1e-13
        );
    }

    /// In a unit of time twice as long, a rate is twice the number. Errors that orthonormal vectors cannot have are gone.
    #[test]
    fn the_error_of_an_orthonormal_state_has_no_lengths() {
        let mut growth = ErrorGrowth::none(1.5);
        let vector = Vector3::new(1e-3, -2e-3, 3e-3);
        let known = Difference { rotation: vector, momentum: vector, length: 0.1, off_frame: [0.1, 0.2] };
        growth.add(&known, [1e-4, 2e-4]);
        growth.covariance.mixed = matrix(0.3) * 1e-8;
        growth.covariance.with_length = [vector, vector];
        let taken = growth.clone().of_orthonormal_state(2.0, 3.0);
        assert_eq!((taken.known.rotation, taken.known.momentum), (vector, vector * 2.0));
        assert_eq!((taken.known.length, taken.known.off_frame), (0.0, [0.0; 2]));
        let Covariance { rotation, mixed, momentum, with_length, length, off_frame } = &taken.covariance;
        assert_eq!((rotation, *mixed), (&growth.covariance.rotation, growth.covariance.mixed * 2.0));
        assert_eq!(*momentum, growth.covariance.momentum * 4.0);
        assert_eq!((*with_length, *length, *off_frame), ([Vector3::zeros(); 2], 0.0, 0.0));
        // Rotation and momentum count as before, in the momentum's new unit.
        growth.known.length = 0.0;
        growth.known.off_frame = [0.0; 2];
        (growth.covariance.length, growth.covariance.off_frame) = (0.0, 0.0);
        assert_relative_eq!(growth.estimate(None), taken.clone().estimate(None), max_relative = 1e-14);
    }

    /// `w.n` changes by the component of `w`'s error along `n`, and by the rotation of `n` towards `w`.
    #[test]
    fn the_error_of_the_spin_is_that_of_both_vectors() {
        let (n, w) = (Vector3::new(0.6, 0.0, 0.8), Vector3::new(0.3, -0.7, 1.1));
        let of = |rotation: Vector3<f64>, momentum: Vector3<f64>| {
            let mut growth = ErrorGrowth::none(1.0);
            growth.add(&Difference { rotation, momentum, ..Difference::default() }, [0.0; 2]);
            growth.of_spin(&n, &w)
        };
        let (rotation, momentum) = (Vector3::new(2e-4, 1e-4, -3e-4), Vector3::new(-1e-4, 5e-4, 2e-4));
        let change = (w + momentum).dot(&(n + rotation.cross(&n))) - w.dot(&n);
        assert_relative_eq!(of(rotation, momentum), 3.0 * change.abs(), max_relative = 2e-3);
        assert_relative_eq!(of(-rotation, -momentum), of(rotation, momentum), max_relative = 1e-12);
        // Independent deviations of each component add up in squares; correlated ones have the mixed terms.
        let mut growth = ErrorGrowth::none(1.0);
        growth.add(&Difference::default(), [3e-4, 2e-4]);
        let deviation = (3e-4 * n.cross(&w).norm()).hypot(2e-4);
        assert_relative_eq!(growth.of_spin(&n, &w), 6.0 * deviation, max_relative = 1e-9);
        growth.covariance.mixed = Matrix3::identity() * 4e-8;
        assert_relative_eq!(growth.of_spin(&n, &w), 6.0 * deviation, max_relative = 1e-9);
        growth.covariance.mixed = n.cross(&w) * n.transpose() * 1e-7;
        let squared = deviation * deviation + 2e-7 * n.cross(&w).norm_squared();
        assert_relative_eq!(growth.of_spin(&n, &w), 6.0 * squared.sqrt(), max_relative = 1e-9);
    }

    #[test]
    fn the_error_of_the_length_is_the_sum_of_the_known_and_the_unknown_one() {
        let mut growth = ErrorGrowth::none(1.5);
        growth.known.length = -1e-3;
        assert_relative_eq!(growth.of_length(), 3e-3, max_relative = 1e-14);
        growth.covariance.length = 4e-6;
        assert_relative_eq!(growth.of_length(), 3e-3 + 12e-3, max_relative = 1e-14);
    }

    #[test]
    fn an_error_of_order_one_is_lost_for_good() {
        let error = |size: f64| Difference { length: size, ..Difference::default() };
        let mut growth = ErrorGrowth::none(2.0);
        growth.add(&error(0.333), [0.0; 2]);
        assert_relative_eq!(growth.estimate(None), 0.999, max_relative = 1e-12);
        growth.add(&error(0.001), [0.0; 2]);
        assert_eq!(growth.estimate(None), 2.5);
        growth.add(&error(-0.334), [0.0; 2]);
        assert_eq!(growth.estimate(None), 2.5);
        let mut growth = ErrorGrowth::none(2.0);
        growth.add(&error(f64::NAN), [0.0; 2]);
        assert_eq!(growth.estimate(None), 2.5);
    }

    /// An asymmetry due to rounding is removed: `kick` would carry it with the wrong sign.
    #[test]
    fn a_covariance_is_symmetric_after_a_rotation() {
        let given = matrix(0.7);
        let mut covariance = Covariance { rotation: given, ..Covariance::default() };
        covariance.rotate(&Matrix3::identity(), &Matrix3::zeros());
        assert_relative_eq!(covariance.rotation, (given + given.transpose()) / 2.0, max_relative = 1e-14);
        assert!((given - given.transpose()).amax() > 0.1);
    }
}
