//! The gravitational wave of a star over a turn: two harmonics of the rotation of its axis about the angular momentum. Eqs. (59), (68),
//! (71).
//!
//! ```
//! use nalgebra::Vector3;
//! use twofold::observables::wave_harmonics::WaveHarmonics;
//! use twofold::{AxisState, Observer, RigidSpheroid};
//!
//! let state = AxisState { axis: Vector3::new(0.6, 0.0, 0.8_f64), momentum: Vector3::new(-0.7, 0.1, 1.5) };
//! let found = WaveHarmonics::of(&RigidSpheroid::in_units_of_tc(1.1), &state, &Observer::at(0.8, 0.4))?;
//! assert!(found.wobble > 0.9 && found.twice > found.once && found.polarizations().plus.abs() < found.once + found.twice);
//! # Ok::<(), twofold::Error>(())
//! ```

use crate::dynamics::AxisState;
use crate::dynamics::RigidSpheroid;
use crate::error::Error;
use crate::numerics::scalar::{Real, length};
use crate::observables::Observer;
use crate::observables::gravitational_wave::Polarizations;
use crate::observables::pulsar::position_angle::position_angle;

/// Amplitudes and phase of the wave for constant `L`, which is a good approximation over one turn:
///
/// ```text
/// h_+' = -(1/2) h_1 sin 2i cos Phi + (1/2) h_2 (1 + cos^2 i) cos 2 Phi
/// h_x' =      -h_1 sin i sin Phi   +      h_2 cos i sin 2 Phi
/// h_1 = 2 (I^zz - I^xx) (|L| / I^xx)^2 sin theta cos theta,    h_2 = 4 (I^zz - I^xx) (|L| / I^xx)^2 sin^2 theta
/// ```
///
/// at unit distance, with the primed polarizations along the projection of `L` on the sky (M. Zimmermann and E. Szedenits, Phys. Rev. D
/// 20, 351 (1979)).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WaveHarmonics<S> {
    /// `h_1`, the amplitude at the frequency of the symmetry axis about `L`.
    pub once: S,
    /// `h_2`, the amplitude at twice that frequency.
    pub twice: S,
    /// `Phi`, azimuth of the symmetry axis about `L` from that of the observer, from -pi to pi (rad).
    pub phase: S,
    /// `i`, angle of `L` to the direction to the observer (rad).
    pub inclination: S,
    /// Position angle of `L` on the sky (rad), defined as for [`position_angle`].
    pub orientation: S,
    /// `theta`, angle of the symmetry axis to `L` (rad): the wobble.
    pub wobble: S,
}

impl<S: Real> WaveHarmonics<S> {
    /// The harmonics for a state.
    ///
    /// # Errors
    /// [`Error::Domain`] where `L` is along the line of sight.
    pub fn of(spheroid: &RigidSpheroid<S>, state: &AxisState<S>, observer: &Observer<S>) -> Result<Self, Error> {
        let size = length(&state.momentum);
        let (l, n, o) = (state.momentum / size, &state.axis, &observer.direction);
        let (across, beside) = (l.cross(n), l.cross(o));
        let (sin, cos) = (length(&across), l.dot(n));
        let rate = size / spheroid.inertia_xx;
        let scale = (spheroid.inertia_zz - spheroid.inertia_xx) * rate * rate * 2.0;
        Ok(Self {
            once: scale * sin * cos,
            twice: scale * sin * sin * 2.0,
            // Both from `l x n`, so that nothing cancels however small the wobble is.
            phase: (-o.dot(&across)).atan2(across.dot(&beside)),
            inclination: length(&beside).atan2(l.dot(o)),
            orientation: position_angle(&l, observer)?,
            wobble: sin.atan2(cos),
        })
    }

    /// `h_+` and `h_x` at the observer, at unit distance.
    pub fn polarizations(&self) -> Polarizations<S> {
        let ((s, c), (s_i, c_i)) = (self.phase.sin_cos(), self.inclination.sin_cos());
        let (cos_2, sin_2) = (c * c - s * s, s * c * 2.0);
        let plus = self.twice * (c_i * c_i + S::one()) * cos_2 / 2.0 - self.once * s_i * c_i * c;
        let cross = self.twice * c_i * sin_2 - self.once * s_i * s;
        let (sin, cos) = (self.orientation * 2.0).sin_cos();
        Polarizations { plus: plus * cos - cross * sin, cross: plus * sin + cross * cos }
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::{Matrix3, Vector3};

    use super::*;
    use crate::observables::gravitational_wave::wave_of_state;

    #[test]
    fn harmonics_add_up_to_the_wave() {
        let spheroid = RigidSpheroid { inertia_xx: 1.3, inertia_zz: 1.7, constant_c: 1.0 };
        let momentum = Vector3::new(0.3, -1.1, 0.8);
        for axis in [Vector3::new(0.1, 0.7, -0.4), Vector3::new(-0.9, 0.2, 0.3), Vector3::new(0.3, -1.1, 0.7)] {
            let state = AxisState { axis: axis.normalize(), momentum };
            for observer in [Observer::at(0.8, 0.3), Observer::at(2.4, -1.9), Observer::at(0.0, 0.4)] {
                let found = WaveHarmonics::of(&spheroid, &state, &observer)
                    .expect("L is off the line of sight")
                    .polarizations();
                let exact = wave_of_state(&spheroid, &Matrix3::zeros(), &state, &observer);
                let error = f64::abs(found.plus - exact.plus).max(f64::abs(found.cross - exact.cross));
                assert!(error < 1e-14, "{found:?} {exact:?}");
            }
        }
        let along = AxisState { axis: Vector3::x(), momentum: Vector3::z() };
        assert!(WaveHarmonics::of(&spheroid, &along, &Observer::at(0.0, 0.0)).is_err());
    }
}
