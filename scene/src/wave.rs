//! The gravitational wave of a star at its observer.

use nalgebra::Matrix3;
use twofold::dynamics::AxisState;
use twofold::dynamics::RigidSpheroid;
use twofold::observables::Observer;
use twofold::observables::gravitational_wave::{Polarizations, strain_unit, wave_of_state};

use crate::scene_file::Scene;

/// `h_+` and `h_x` of a star in a state, Eq. (71), multiplied by `unit`, the strain that corresponds to `h = 1` at the
/// observer.
pub fn spheroid_wave(
    spheroid: &RigidSpheroid<f64>,
    violation: &Matrix3<f64>,
    state: &AxisState<f64>,
    observer: &Observer<f64>,
    unit: f64,
) -> Polarizations<f64> {
    let wave = wave_of_state(spheroid, violation, state, observer);
    Polarizations { plus: wave.plus * unit, cross: wave.cross * unit }
}

impl Scene {
    /// The strain that corresponds to `h = 1` at the distance of the observer; one if none is given.
    pub fn strain_unit(&self) -> f64 {
        let distance = self.observer.and_then(|observer| observer.distance);
        distance.map_or(1.0, |distance| strain_unit(self.units.inertia_in_si(), self.units.time, distance))
    }
}
