//! Random states for the checks of the averaged motion.

use core::f64::consts::TAU;

use nalgebra::Vector3;
use twofold::dynamics::{BodyState, RigidSpheroid};

use crate::check::{largest, largest_component};
use crate::random::Random;

/// A body, a diagonal tensor and a state.
pub(super) struct State {
    pub(super) body: RigidSpheroid<f64>,
    pub(super) s: Vector3<f64>,
    pub(super) n: Vector3<f64>,
    pub(super) momentum: Vector3<f64>,
}

pub(super) fn random_state(random: &mut Random) -> State {
    let s = Vector3::from_fn(|_, _| random.within(-1.0, 1.0));
    let s = s.map(|value| value - s.mean());
    let mut direction = || {
        let z: f64 = random.within(-1.0, 1.0);
        let (sin, cos) = random.within(0.0, TAU).sin_cos();
        let rho = (1.0 - z * z).sqrt();
        Vector3::new(rho * cos, rho * sin, z)
    };
    let (n, l) = (direction(), direction());
    let momentum = l * random.within(0.5, 3.0);
    let mut body = RigidSpheroid::in_units_of_tc(1.1);
    body.inertia_xx = random.within(0.5, 2.0);
    body.constant_c = random.within(0.5, 2.0);
    State { body, s, n, momentum }
}

/// Largest difference of n, e_x and L in units of its size.
pub(super) fn difference(a: &BodyState<f64>, b: &BodyState<f64>) -> f64 {
    let axis = largest_component(&(a.axis - b.axis));
    let momentum = largest_component(&((a.momentum - b.momentum) / b.momentum.norm()));
    largest([axis, momentum, largest_component(&(a.equatorial_axis - b.equatorial_axis))])
}
